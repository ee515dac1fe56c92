"""An installed module finds the program's libraries and its networks."""
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

BUILD = os.environ.get("GRAMLOOM_BUILD")


@pytest.mark.skipif(not BUILD, reason="ctest says where the build is")
def test_installed_below_a_prefix(tmp_path):
    subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix", tmp_path],
                   check=True, capture_output=True)
    package, = tmp_path.glob("lib/python3*/dist-packages/gramloom")
    libraries = tmp_path / "lib/gramloom"
    libraries.mkdir()
    for name in ("core", "signal", "io"):
        shutil.copy(pathlib.Path(BUILD, f"libgramloom_{name}.so"), libraries)
    models = tmp_path / "share/gramloom/models"
    models.mkdir(parents=True)
    (models / "own.toml").touch()
    script = """
import gramloom, numpy
exemplar = numpy.zeros((16, 16, 3), "uint8")
try:
    gramloom.synthesise(exemplar, "neural", size=16, preset="gatys", network="none")
except gramloom.ConfigError as error:
    print(error)
open("c.toml", "w").write("method = [{ name = 'm', kind = 'procedural', texture = 'marble' }]")
try:
    gramloom.run("c.toml", jobs=2)
except gramloom.ConfigError as error:
    print(error)
print(open("/proc/self/maps").read())
"""
    environment = {**os.environ, "PYTHONPATH": str(package.parent)}
    environment.pop("GRAMLOOM_MODELS", None)
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env=environment,
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert f"(in {models} are own)" in done.stdout
    assert f"nor {tmp_path}/bin/gramloom" in done.stdout
    for name in ("core", "signal", "io"):
        assert str(libraries / f"libgramloom_{name}.so") in done.stdout
    assert f"{BUILD}/libgramloom" not in done.stdout
