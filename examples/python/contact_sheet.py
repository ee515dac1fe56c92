#!/usr/bin/env python3
"""A contact sheet of several methods, and their scores.

    python3 contact_sheet.py data/pebbles.png sheet.png

Makes a texture of the exemplar by each of METHODS, which Pillow puts side by side under their
names; then runs them all from a config for their scores, which pandas reads and sorts. Needs
python3-pil and python3-pandas.
"""
import argparse
import pathlib
import tempfile

import gramloom
import pandas
from PIL import Image, ImageDraw

METHODS = {
    "quilting": {"patch_size": 24},
    "patchmatch": {},
    "pyramid": {},
    "phase": {},
}
LABEL = 16  # pixels


def contact_sheet(exemplar, size):
    """The exemplar, then a texture by each method, as one picture."""
    pictures = {"exemplar": exemplar}
    for kind, parameters in METHODS.items():
        pictures[kind] = gramloom.synthesise(exemplar, kind, size=(size, size), **parameters)
    height = max(picture.shape[0] for picture in pictures.values())
    width = max(picture.shape[1] for picture in pictures.values())
    sheet = Image.new("RGB", (len(pictures) * width, LABEL + height), "white")
    draw = ImageDraw.Draw(sheet)
    for number, (name, picture) in enumerate(pictures.items()):
        sheet.paste(Image.fromarray(picture), (number * width, LABEL))
        draw.text((number * width + 2, 2), name, fill="black")
    return sheet


def scores(exemplar, size):
    """The scores of a run of these methods on the exemplar's file, the best first."""
    config = f"size = {size}\ntile = \"both\"\n[[exemplar]]\nname = \"e\"\nimage = \"e.png\"\n"
    for kind, parameters in METHODS.items():
        config += f"[[method]]\nname = \"{kind}\"\nkind = \"{kind}\"\n"
        config += "".join(f"{key} = {value}\n" for key, value in parameters.items())
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        gramloom.write_image(folder / "e.png", exemplar)
        (folder / "sheet.toml").write_text(config, encoding="utf-8")
        gramloom.run(folder / "sheet.toml", folder / "out")
        table = pandas.read_csv(folder / "out/scores.csv")
    return table.sort_values("stsim2", ascending=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("exemplar", help="a picture of 8 bits")
    parser.add_argument("sheet", help="the file to write")
    parser.add_argument("--size", type=int, default=192, help="of each texture, pixels")
    arguments = parser.parse_args()
    exemplar = gramloom.read_image(arguments.exemplar)
    contact_sheet(exemplar, arguments.size).save(arguments.sheet)
    table = scores(exemplar, arguments.size)
    print(table[["method", "stsim2", "colour_wasserstein", "copied_share", "seconds"]]
          .to_string(index=False))


if __name__ == "__main__":
    main()
