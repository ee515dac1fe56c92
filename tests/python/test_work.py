"""Long work: progress, Ctrl-C, other threads of Python, and what an import brings along."""
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import gramloom
import numpy
import pytest

LONG = {"kind": "neural", "size": 64, "preset": "fast", "iterations": 1000000}


def interrupt_after(seconds):
    timer = threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


def test_interrupt_stops_the_work(pebbles):
    start = time.monotonic()
    timer = interrupt_after(1)
    with pytest.raises(KeyboardInterrupt):
        gramloom.synthesise(pebbles, **LONG)
    timer.join()
    assert time.monotonic() - start < 60
    gramloom.synthesise(pebbles, "histogram", size=16)  # the next one works


def test_interrupt_stops_a_run_that_can_go_on(pebbles, tmp_path, config):
    gramloom.write_image(tmp_path / "e.png", pebbles)
    file = config("size = 32\nscores = false\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
                  "[[method]]\nname = 'first'\nkind = 'histogram'\n"
                  "[[method]]\nname = 'n'\nkind = 'neural'\nlevels = 1\niterations = 1000000\n")
    timer = interrupt_after(2)
    with pytest.raises(KeyboardInterrupt):
        gramloom.run(file, tmp_path / "out")
    timer.join()
    # A state goes on only with what it was begun with, so the rest is another job.
    records = gramloom.run(file, tmp_path / "out", resume=True, set={"iterations": 2})
    assert [record["status"] for record in records] == ["done", "done"]


def children_of(process):
    """Those that are at work, by /proc."""
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            state, parent = stat.read_text(encoding="utf-8").rpartition(")")[2].split()[:2]
        except OSError:
            continue  # it has ended
        if int(parent) == process and state != "Z":
            found.append(stat)
    return found


def test_interrupt_stops_the_processes_of_a_run(pebbles, tmp_path, config):
    gramloom.write_image(tmp_path / "e.png", pebbles)
    file = config("seeds = [1, 2]\nsize = 400\nscores = false\n[[exemplar]]\nname = 'e'\n"
                  "image = 'e.png'\n[[method]]\nname = 'long'\nkind = 'patchmatch'\n"
                  "iterations = 1000\n")
    seen = []

    def look_and_interrupt():
        deadline = time.monotonic() + 60
        while len(children_of(os.getpid())) < 2 and time.monotonic() < deadline:
            time.sleep(0.05)
        seen.extend(children_of(os.getpid()))
        os.kill(os.getpid(), signal.SIGINT)

    other = threading.Thread(target=look_and_interrupt)
    other.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        gramloom.run(file, tmp_path / "out", jobs=2)
    other.join()
    assert len(seen) == 2 and not children_of(os.getpid())
    assert time.monotonic() - start < 60


def test_other_threads_run_meanwhile(pebbles):
    turns = []
    done = threading.Event()

    def count():
        while not done.is_set():
            turns.append(time.monotonic())
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    start = time.monotonic()
    gramloom.synthesise(pebbles, "neural", size=64, preset="fast", levels=1, iterations=20)
    end = time.monotonic()
    done.set()
    other.join()
    within = [start] + [turn for turn in turns if start < turn < end] + [end]
    # Its longest wait is a small part of the work: nothing held the lock from beginning to end.
    assert max(b - a for a, b in zip(within, within[1:])) < 0.5 * (end - start)


def test_two_threads_make_what_one_makes(pebbles):
    alone = [gramloom.synthesise(pebbles, "quilting", size=64, patch_size=12, seed=seed)
             for seed in range(4)]
    made = [None] * 4

    def make(seed):
        made[seed] = gramloom.synthesise(pebbles, "quilting", size=64, patch_size=12, seed=seed)

    threads = [threading.Thread(target=make, args=(seed,)) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for one, other in zip(alone, made):
        numpy.testing.assert_array_equal(one, other)


def test_progress_is_told(pebbles):
    told = []
    gramloom.synthesise(pebbles, "neural", size=32, preset="fast", levels=1, iterations=5,
                        progress=told.append)
    assert told and all(0 <= p.step <= p.steps and p.job == "" for p in told)
    assert told[-1].loss > 0
    assert "gramloom.Progress" in repr(told[-1])


def test_progress_that_raises_stops_the_work(pebbles):
    class Enough(Exception):
        pass

    def stop(_):
        raise Enough("enough")

    with pytest.raises(Enough, match="enough"):
        gramloom.synthesise(pebbles, **LONG, progress=stop)


def libraries_after(code):
    script = code + "\nprint(open('/proc/self/maps').read())"
    return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                          check=True).stdout


def test_an_import_brings_no_large_library():
    libraries = libraries_after("import gramloom")
    assert "_gramloom" in libraries
    for large in ("torch", "OpenImageIO", "embree"):
        assert large not in libraries
    script = "import sys, gramloom; assert 'numpy' not in sys.modules"
    subprocess.run([sys.executable, "-c", script], check=True)


def test_classic_methods_need_no_torch():
    libraries = libraries_after("import gramloom\ngramloom.synthesise("
                                "kind='procedural', texture='marble', size=8)")
    assert "torch" not in libraries
