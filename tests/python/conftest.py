import os
import pathlib
import subprocess

import numpy
import pytest

PROGRAM = os.environ.get("GRAMLOOM_EXECUTABLE", "gramloom")


@pytest.fixture(scope="session")
def pebbles():
    """48 by 40 pixels with some structure, as uint8."""
    random = numpy.random.default_rng(1)
    y, x = numpy.mgrid[0:40, 0:48]
    waves = numpy.stack([numpy.sin(x / 3 + c) + numpy.cos(y / 4 - c) for c in range(3)], axis=2)
    noisy = 128 + 50 * waves + random.integers(-20, 20, waves.shape)
    return numpy.clip(noisy, 0, 255).astype(numpy.uint8)


def run_program(folder, *words):
    """Runs the program in a folder; returns what it prints."""
    done = subprocess.run([PROGRAM, *map(str, words)], cwd=folder, capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture
def command_line(tmp_path):
    """Runs the program in a folder of the test's own."""
    return lambda *words: run_program(tmp_path, *words)


@pytest.fixture(scope="module")
def run_of(tmp_path_factory):
    """Runs a config of many jobs at once, beside files that the test writes: one start of the program
    takes longer than its small jobs. Returns the folder of the results."""
    def run(text, write=lambda folder: None):
        folder = tmp_path_factory.mktemp("run")
        write(folder)
        (folder / "c.toml").write_text(text, encoding="utf-8")
        run_program(folder, "run", "c.toml", "--quiet")
        return folder / "out/c"
    return run


@pytest.fixture
def config(tmp_path):
    """Writes a config, and returns its path."""
    def write(text, name="c"):
        file = pathlib.Path(tmp_path, name + ".toml")
        file.write_text(text, encoding="utf-8")
        return file
    return write
