"""The lines of Python in the documents, and the example in examples/python, where Pillow and pandas are."""
import pathlib
import re
import subprocess
import sys

import gramloom
import pytest

SOURCE = pathlib.Path(__file__).parents[2]
EXAMPLE = SOURCE / "examples/python/contact_sheet.py"


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
def test_the_lines_of_the_documents(page, tmp_path):
    lines = re.findall(r"```python\n(import gramloom\n.*?)```",
                       (SOURCE / page).read_text("utf-8"), re.DOTALL)
    assert lines
    for folder in ("data", "configs"):
        (tmp_path / folder).symlink_to(SOURCE / folder)
    done = subprocess.run([sys.executable, "-c", "\n".join(lines)], cwd=tmp_path,
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    if page == "docs/python.md":
        assert "stsim2" in done.stdout and "histogram/seed1 done" in done.stdout
    assert gramloom.read_image(tmp_path / "texture.png").shape == (512, 512, 3)


def test_contact_sheet(pebbles, tmp_path):
    image = pytest.importorskip("PIL.Image")
    pytest.importorskip("pandas")
    gramloom.write_image(tmp_path / "e.png", pebbles)
    done = subprocess.run([sys.executable, EXAMPLE, "e.png", "sheet.png", "--size", "64"],
                          cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert image.open(tmp_path / "sheet.png").size == (5 * 64, 64 + 16)
    lines = done.stdout.splitlines()
    assert "stsim2" in lines[0] and len(lines) == 5
