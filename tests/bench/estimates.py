#!/usr/bin/env python3
"""What `check` says against what a process takes: memory and time, for every method.

  tests/bench/estimates.py GRAMLOOM [KIND...]

Each case is a run of its own of one job, without scores. On a quiet machine: a ratio is measured by
estimated, 1 is right. The exemplars are procedural pebbles; needs Pillow and NumPy.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy
from PIL import Image

# kind, its keys, and the largest products of exemplar side and result side that are worth the wait
METHODS = [
    ("histogram", "", 1e9),
    ("markov", "", 1e9),
    ("phase", "", 1e9),
    ("tiling", "", 1e9),
    ("procedural", 'texture = "marble"', 1e9),
    ("procedural", 'texture = "brick"', 1e9),
    ("pyramid", "", 1e9),
    ("patchmatch", "", 1e9),
    ("quilting", "", 6e5),
    ("quilting", "patch_size = 64", 6e5),
    ("pixel", "", 6e5),
    ("pixel", 'algorithm = "lefebvre_hoppe"', 6e5),
    ("generator", 'model = "pebbles"', 1e9),
    ("neural", "", 8e4),
    ("neural", 'preset = "fast"', 3e5),
    ("neural", 'preset = "gatys"\niterations = 20', 1e5),
]
# keys of an inference, side and number of its pictures
TRAININGS = [
    ("steps = 200", 64, 32),
    ("steps = 200", 128, 128),
    ("steps = 100\nbatch = 32", 128, 32),
    ("steps = 100\nhidden = [64, 32]", 256, 16),
]
SIZES = [(128, 128), (128, 512), (512, 512), (512, 1024), (1024, 512), (256, 2048)]  # exemplar, result
CHANNELS = [1, 3, 4]


def exemplar(gramloom, folder, side, channels):
    """Stones of the same size whatever the side is: no part of it is repeated."""
    file = folder / f"pebbles_{side}_{channels}.png"
    if file.exists():
        return file
    config = folder / f"pebbles_{side}.toml"
    config.write_text(f'size = {side}\nscores = false\n[[method]]\nname = "pebbles"\nkind = "procedural"\n'
                      f'texture = "pebbles"\nscale = {side / 24}\n')
    subprocess.run([gramloom, "run", config, "--output", folder / "made", "--quiet"], check=True)
    values = numpy.asarray(Image.open(next((folder / "made").rglob("seed1.png"))).convert("RGB"))
    subprocess.run(["rm", "-rf", folder / "made"], check=True)
    if channels == 1:
        values = values[..., 1]
    if channels == 4:
        values = numpy.dstack([values, values[..., :1]])
    Image.fromarray(values).save(file)
    return file


def measured(gramloom, folder, config, command="run"):
    process = subprocess.Popen([gramloom, command, config, "--output", folder / "out", "--quiet"],
                               stderr=subprocess.PIPE)
    began = time.monotonic()
    errors = process.stderr.read().decode()
    _, status, used = os.wait4(process.pid, 0)
    subprocess.run(["rm", "-rf", folder / "out"], check=True)
    if status:
        return None, None, None, errors.strip()
    return (used.ru_maxrss * 1024, time.monotonic() - began, used.ru_utime + used.ru_stime, "")


def compare(gramloom, folder, kind, keys, side, channels, size):
    config = folder / "case.toml"
    takes_exemplar = kind not in ("procedural", "generator")
    config.write_text(
        f"size = [{size}, {size}]\nscores = false\n"
        + (f'[[exemplar]]\nname = "e"\nimage = "{exemplar(gramloom, folder, side, channels)}"\n' if takes_exemplar else "")
        + f'[[method]]\nname = "m"\nkind = "{kind}"\n{keys}\n')
    checked = subprocess.run([gramloom, "check", config, "--json"], capture_output=True, text=True)
    if checked.returncode:
        return f"{kind}: {checked.stderr.strip()}"
    checked = json.loads(checked.stdout)
    memory_expected, time_expected = checked["jobs"][0]["memory"], checked["seconds"]
    memory, wall, cpu, errors = measured(gramloom, folder, config)
    if errors:
        return f"{kind}: {errors}"
    what = kind + (" " + " ".join(keys.split()) if keys else "")
    return (f"{what:42} {side:5}² × {channels} {size:5}²  memory {memory / 1e6:7.0f} MB {memory / memory_expected:5.2f}"
            f"   time {wall:7.2f} s {wall / time_expected:5.2f}   cpu {cpu:7.2f} s {cpu / time_expected:5.2f}")


def compare_training(gramloom, folder, keys, side, count):
    """Of an inference from one number to pictures, each noise of its own."""
    generator = numpy.random.default_rng(1)
    rows = ["picture,bend"]
    for i in range(count):
        picture = folder / f"pair_{i}.png"
        Image.fromarray(generator.integers(0, 256, (side, side, 3), numpy.uint8)).save(picture)
        rows.append(f"{picture},{i}")
    (folder / "pairs.csv").write_text("\n".join(rows) + "\n")
    config = folder / "training.toml"
    config.write_text(f'[[model]]\nname = "m"\nkind = "inference"\npairs = "pairs.csv"\n{keys}\n')
    checked = json.loads(subprocess.run([gramloom, "check", config, "--json"], capture_output=True, check=True).stdout)
    expected = checked["models"][0]
    memory, wall, _, errors = measured(gramloom, folder, config, "train")
    if errors:
        return f"inference: {errors}"
    what = "inference " + " ".join(keys.split())
    return (f"{what:42} {count:5} pairs of {side}²  memory {memory / 1e6:7.0f} MB {memory / expected['memory']:5.2f}"
            f"   time {wall:7.2f} s {wall / expected['seconds']:5.2f}")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    gramloom, wanted = sys.argv[1], sys.argv[2:]
    with tempfile.TemporaryDirectory() as folder:
        for kind, keys, most in METHODS:
            if wanted and kind not in wanted:
                continue
            for side, size in SIZES:
                takes_exemplar = kind not in ("procedural", "generator")
                if side * size > most or not takes_exemplar and (side, size) not in ((128, 128), (512, 1024), (256, 2048)):
                    continue
                for channels in CHANNELS if takes_exemplar else [3]:
                    print(compare(gramloom, Path(folder), kind, keys, side, channels, size), flush=True)
        if not wanted or "inference" in wanted:
            for keys, side, count in TRAININGS:
                print(compare_training(gramloom, Path(folder), keys, side, count), flush=True)


main()
