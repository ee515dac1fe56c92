"""An installed module finds the program's libraries and its networks, and works with those of its own build
alone."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest
from conftest import PROGRAM

BUILD = os.environ.get("GRAMLOOM_BUILD")
CONFIG = "method = [{ name = 'm', kind = 'procedural', texture = 'marble' }]"
JOBS = f"""
import gramloom
open("c.toml", "w").write("{CONFIG}")
try:
    gramloom.run("c.toml", jobs=2)
except gramloom.ConfigError as error:
    print(error)
"""


@pytest.fixture
def prefix(tmp_path):
    """A folder that the module is installed below, with some of the libraries and without the program."""
    if not BUILD:
        pytest.skip("ctest says where the build is")
    subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix", tmp_path],
                   check=True, capture_output=True)
    libraries = tmp_path / "lib/gramloom"
    libraries.mkdir()
    for name in ("core", "signal", "io"):
        shutil.copy(pathlib.Path(BUILD, f"libgramloom_{name}.so"), libraries)
    return tmp_path


def python(prefix, script):
    package, = prefix.glob("lib/python3*/dist-packages/gramloom")
    environment = {**os.environ, "PYTHONPATH": str(package.parent)}
    environment.pop("GRAMLOOM_MODELS", None)
    return subprocess.run([sys.executable, "-c", script], cwd=prefix, env=environment,
                          capture_output=True, text=True, check=False)


def test_installed_below_a_prefix(prefix):
    models = prefix / "share/gramloom/models"
    models.mkdir(parents=True)
    (models / "own.toml").touch()
    done = python(prefix, JOBS + """
import numpy
try:
    gramloom.synthesise(numpy.zeros((16, 16, 3), "uint8"), "neural", size=16, preset="gatys", network="none")
except gramloom.ConfigError as error:
    print(error)
print(open("/proc/self/maps").read())
""")
    assert done.returncode == 0, done.stderr
    assert f"(in {models} are own)" in done.stdout
    assert f"nor {prefix}/bin/gramloom" in done.stdout
    for name in ("core", "signal", "io"):
        assert str(prefix / f"lib/gramloom/libgramloom_{name}.so") in done.stdout
    assert f"{BUILD}/libgramloom" not in done.stdout


@pytest.mark.parametrize("says", ["gramloom 0.0.9 (build 0123456789ab)", ""])
def test_a_program_of_another_build_does_no_jobs(prefix, says):
    program = prefix / "bin/gramloom"
    program.parent.mkdir()
    program.write_text(f"#!/bin/sh\necho '{says}'\n", encoding="utf-8")
    program.chmod(0o755)
    done = python(prefix, JOBS)
    assert done.returncode == 0, done.stderr
    own = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout
    assert done.stdout == (f"jobs: {program} is {says or 'no gramloom'}, Python's module is of {own.strip()}: "
                           "install all of one version, or in a checkout run ./bootstrap build\n")
    assert not (prefix / "out").exists()


def test_libraries_of_another_build_are_refused(prefix):
    own = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout
    stamp = re.search(r"\(build ([0-9a-f]{12})\)", own)[1].encode()
    core = prefix / "lib/gramloom/libgramloom_core.so"
    assert stamp in core.read_bytes()
    core.write_bytes(core.read_bytes().replace(stamp, b"0123456789ab"))
    done = python(prefix, "import gramloom")
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1].startswith(
        f"ImportError: gramloom: {core} is of another build than Python's module: ")
