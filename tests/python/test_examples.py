"""The example in examples/python, where Pillow and pandas are."""
import pathlib
import subprocess
import sys

import pytest

EXAMPLE = pathlib.Path(__file__).parents[2] / "examples/python/contact_sheet.py"


def test_contact_sheet(pebbles, tmp_path):
    image = pytest.importorskip("PIL.Image")
    pytest.importorskip("pandas")
    import gramloom
    gramloom.write_image(tmp_path / "e.png", pebbles)
    done = subprocess.run([sys.executable, EXAMPLE, "e.png", "sheet.png", "--size", "64"],
                          cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert image.open(tmp_path / "sheet.png").size == (5 * 64, 64 + 16)
    lines = done.stdout.splitlines()
    assert "stsim2" in lines[0] and len(lines) == 5
