"""What directs a texture: the same pixels by arrays in tables as by files in a config."""
import json

import gramloom
import numpy
import pytest

PARAMETERS = {"quilting": {"patch_size": 12},
              "neural": {"preset": "fast", "iterations": [2, 3], "levels": 2}}


def by_ability():
    """What a texture of 40 by 24 pixels is asked, by the ability that a method needs for it."""
    random = numpy.random.default_rng(2)
    picture, other = random.integers(0, 255, (2, 40, 48, 3), dtype="uint8")
    half = numpy.zeros((40, 48), bool)
    half[:, 20:] = True
    label = numpy.uint8(255) * half
    ramp = numpy.tile(numpy.linspace(0, 65535, 40).astype("uint16"), (24, 1))
    hole = numpy.zeros((40, 48), bool)
    hole[12:28, 10:30] = True
    height = picture[:, :, 0].astype("float32") - 40
    return {
        "several exemplars": {"exemplar": [picture, {"image": other}], "size": [40, 24],
                              "tile": "x"},
        "mask": {"exemplar": {"image": picture, "mask": half}, "size": [40, 24], "tile": "both"},
        "guide": {"exemplar": {"image": picture, "guide": label},
                  "guide": {"image": label[:24, :40], "weight": 2, "weight_image": ramp}},
        "mix": {"exemplar": [picture, other], "mix": {"images": [ramp]}},
        "turn": {"exemplar": picture, "turn": {"angle": ramp, "angles": [0, 90]}},
        "fill": {"fill": {"image": picture, "mask": hole, "maps": {"height": height},
                          "seamless": "x", "band": 4}},
    }


ASKED = by_ability()


def in_files(value, folder, name):
    """The value with a file in place of each array."""
    if isinstance(value, dict):
        return {key: in_files(entry, folder, f"{name}-{key}") for key, entry in value.items()}
    if isinstance(value, list):
        return [in_files(entry, folder, f"{name}-{i}") for i, entry in enumerate(value)]
    if not isinstance(value, numpy.ndarray):
        return value
    file = name + (".exr" if value.dtype == "float32" else ".png")
    gramloom.write_image(folder / file,
                         value * numpy.uint8(255) if value.dtype == bool else value)
    return file


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value)


def text_of(kind, parameters, asked):
    """The config that asks this of a method."""
    asked = dict(asked)
    exemplar = asked.pop("exemplar", None)
    if isinstance(exemplar, list):
        exemplar = {"images": exemplar}
    elif isinstance(exemplar, str):
        exemplar = {"image": exemplar}
    # Arrays and tables in place of values, so that no order of the lines is wrong.
    asked["exemplar"] = [{"name": "e", **exemplar}] if exemplar else None
    asked["method"] = [{"name": "m", "kind": kind, **parameters}]
    return "seeds = 3\nscores = false\n" + "".join(
        f"{key} = {toml(value)}\n" for key, value in asked.items() if value is not None)


@pytest.mark.parametrize("ability, kind", [
    (ability, method["name"]) for ability in ASKED for method in gramloom.methods()
    if ability in method["abilities"] and "exemplar" in method["abilities"]])
def test_same_pixels_as_by_a_config(ability, kind, tmp_path, config, command_line):
    asked, parameters = ASKED[ability], PARAMETERS.get(kind, {})
    config(text_of(kind, parameters, in_files(asked, tmp_path, "e")))
    command_line("run", "c.toml", "--quiet", "--output", "out")
    made, maps = gramloom.synthesise(kind=kind, seed=3, maps={}, **asked, **parameters)
    file, = tmp_path.glob("out/*/m/seed3.png")
    numpy.testing.assert_array_equal(made, gramloom.read_image(file))
    for name, array in maps.items():
        numpy.testing.assert_array_equal(
            array, gramloom.read_image(file.with_name(f"seed3_{name}.exr")))


def test_abilities_are_called_so():
    called = {ability for method in gramloom.methods() for ability in method["abilities"]}
    assert set(ASKED) <= called


def test_what_a_fill_leaves_is_as_it_was():
    asked = ASKED["fill"]["fill"]
    picture, hole = asked["image"], asked["mask"]
    filled = gramloom.synthesise(fill={"image": picture, "mask": hole})
    assert filled.dtype == picture.dtype and filled.shape == picture.shape
    numpy.testing.assert_array_equal(filled[~hole], picture[~hole])
    assert (filled[hole] != picture[hole]).any()
    assert gramloom.synthesise(fill={"image": picture, "extend": 8}).shape == (56, 64, 3)


def test_files_stand_beside_arrays(tmp_path):
    asked = ASKED["guide"]
    file = tmp_path / "guide.png"
    gramloom.write_image(file, asked["guide"]["image"])
    guide = {**asked["guide"], "image": file}
    numpy.testing.assert_array_equal(
        gramloom.synthesise(asked["exemplar"], guide=guide),
        gramloom.synthesise(**asked))


@pytest.mark.parametrize("changes, words", [
    ({"guide": {"imgae": 1}}, "synthesise: unknown key 'imgae' (did you mean 'image'?)"),
    ({"guide": {}}, "synthesise: key 'image' is missing"),
    ({"guide": None}, "the exemplar 'exemplar' has a 'guide', and there is no [guide]"),
    ({"exemplar": ASKED["turn"]["exemplar"]}, "has no 'guide' for exemplar.image"),
    ({"size": (8, 8)}, "the guide guide.image has 40×24 pixels and the texture 8×8"),
    ({"kind": "pyramid"}, "pyramid"),
    ({"kind": "procedural", "texture": "marble"}, "procedural"),
    ({"exemplar": {"folder": "."}}, "there is no picture"),
    ({"fill": {"image": ASKED["turn"]["exemplar"]}}, "makes nothing anew"),
    ({"mix": {"weights": [1, 2]}}, "[mix] needs several 'images'"),
])
def test_what_is_wrong_is_said(changes, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(gramloom.ConfigError) as caught:
        gramloom.synthesise(**{**ASKED["guide"], **changes})
    assert words in str(caught.value)
    assert str(caught.value).startswith("synthesise: ") and "\n" not in str(caught.value)
