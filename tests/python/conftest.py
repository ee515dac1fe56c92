import os
import pathlib
import subprocess

import numpy
import pytest

PROGRAM = os.environ.get("GRAMLOOM_EXECUTABLE", "gramloom")


@pytest.fixture
def pebbles():
    """48 by 40 pixels with some structure, as uint8."""
    random = numpy.random.default_rng(1)
    y, x = numpy.mgrid[0:40, 0:48]
    waves = numpy.stack([numpy.sin(x / 3 + c) + numpy.cos(y / 4 - c) for c in range(3)], axis=2)
    noisy = 128 + 50 * waves + random.integers(-20, 20, waves.shape)
    return numpy.clip(noisy, 0, 255).astype(numpy.uint8)


@pytest.fixture
def command_line(tmp_path):
    """Runs the program in a folder of the test's own; returns what it prints."""
    def run(*words):
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=tmp_path, capture_output=True,
                              text=True, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout
    return run


@pytest.fixture
def config(tmp_path):
    """Writes a config, and returns its path."""
    def write(text, name="c"):
        file = pathlib.Path(tmp_path, name + ".toml")
        file.write_text(text, encoding="utf-8")
        return file
    return write
