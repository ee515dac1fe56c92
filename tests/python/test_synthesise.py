"""synthesise() makes what the command line makes, of arrays of every type and shape."""
import inspect
import json

import gramloom
import numpy
import pytest

QUILTING = {"kind": "quilting", "size": (40, 24), "patch_size": 8}
# Parameters that make small pictures of small exemplars; all else by its defaults.
SMALL = {"quilting": {"patch_size": 12}, "neural": {"iterations": [2, 3], "levels": 2}}


def of_exemplar():
    return [m["name"] for m in gramloom.methods() if "exemplar" in m["abilities"]]


def same(array, file):
    written = gramloom.read_image(file)
    assert array.dtype == written.dtype
    numpy.testing.assert_array_equal(array, written)


@pytest.mark.parametrize("kind", of_exemplar())
def test_same_pixels_as_the_command_line(kind, pebbles, tmp_path, command_line):
    gramloom.write_image(tmp_path / "e.png", pebbles)
    parameters = SMALL.get(kind, {})
    options = [f"--set={key}={value}" for key, value in parameters.items()]
    if kind == "neural":
        parameters = {"preset": "fast", **parameters}
    command_line("make", "e.png", "--kind", kind, "--size", "40,24", "--seed", 7, *options,
                 "--output", "made.png", "--quiet")
    made = gramloom.synthesise(pebbles, kind, size=(40, 24), seed=7, **parameters)
    assert made.shape == (24, 40, 3)
    same(made, tmp_path / "made.png")


PATTERNS = [p["name"] for p in gramloom.patterns()]


@pytest.fixture(scope="module")
def patterns_of_a_run(run_of):
    methods = [f"[[method]]\nname = '{p}'\nkind = 'procedural'\ntexture = '{p}'\n" for p in PATTERNS]
    return run_of("size = 32\ntile = 'both'\nscores = false\n" + "".join(methods)) / "procedural"


@pytest.mark.parametrize("pattern", PATTERNS)
def test_textures_without_exemplar(pattern, patterns_of_a_run):
    made, maps = gramloom.synthesise(kind="procedural", texture=pattern, size=32, maps={})
    same(made, patterns_of_a_run / pattern / "seed1.png")
    for name, array in maps.items():
        same(array, patterns_of_a_run / pattern / f"seed1_{name}.png")


KINDS = ["quilting", "pyramid"]
TYPES = {"uint8": "png", "uint16": "png", "float16": "exr", "float32": "exr"}
CHANNELS = [None, 1, 2, 3, 4]


def exemplar_of(pebbles, dtype, channels):
    values = pebbles.astype("float64") / 255
    values = values[:, :, 0] if channels is None else \
        numpy.concatenate([values, values[:, :, :1]], axis=2)[:, :, :channels]
    most = {"uint8": 255, "uint16": 65535}.get(dtype)
    return numpy.rint(values * most).astype(dtype) if most else (3 * values - 1).astype(dtype)


@pytest.fixture(scope="module")
def types_of_a_run(pebbles, run_of):
    exemplars = [(f"{dtype}_{channels}", ending, exemplar_of(pebbles, dtype, channels))
                 for dtype, ending in TYPES.items() for channels in CHANNELS]
    text = "seeds = 3\nsize = [40, 24]\ntile = 'x'\nscores = false\n"
    text += "".join(f"[[exemplar]]\nname = '{name}'\nimage = '{name}.{ending}'\n"
                    for name, ending, _ in exemplars)
    text += "".join(f"[[method]]\nname = '{kind}'\nkind = '{kind}'\n" for kind in KINDS)

    def write(folder):
        for name, ending, array in exemplars:
            gramloom.write_image(folder / f"{name}.{ending}", array)
    return run_of(text, write)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("channels", CHANNELS)
def test_types_and_shapes(kind, dtype, channels, pebbles, types_of_a_run):
    exemplar = exemplar_of(pebbles, dtype, channels)
    made = gramloom.synthesise(exemplar, kind, size=(40, 24), tile="x", seed=3)
    assert made.dtype == exemplar.dtype
    assert made.shape == ((24, 40) if channels is None else (24, 40, channels))
    same(made[:, :, 0] if channels == 1 else made,
         types_of_a_run / f"{dtype}_{channels}" / kind / f"seed3.{TYPES[dtype]}")


def test_several_exemplars_and_maps(pebbles, tmp_path, config, command_line):
    other = pebbles[::-1].copy()
    height = pebbles[:, :, 0].astype("float32") - 40  # metres, say
    heights = [height, height[::-1].copy()]
    made, maps = gramloom.synthesise([pebbles, other], **QUILTING,
                                     maps=[{"height": h} for h in heights])
    for name, array in (("a.png", pebbles), ("b.png", other), ("a.exr", heights[0]),
                        ("b.exr", heights[1])):
        gramloom.write_image(tmp_path / name, array)
    config("size = [40, 24]\ntile = 'both'\nscores = false\n[[exemplar]]\nname = 'e'\nimages = ["
           "{ image = 'a.png', maps = { height = 'a.exr' } }, "
           "{ image = 'b.png', maps = { height = 'b.exr' } }]\n"
           "[[method]]\nname = 'm'\nkind = 'quilting'\npatch_size = 8\n")
    command_line("run", "c.toml", "--quiet", "--set", "format=tif")
    same(made, tmp_path / "out/c/e/m/seed1.tif")
    same(maps["height"], tmp_path / "out/c/e/m/seed1_height.tif")


def test_arrays_in_any_order_of_memory(pebbles):
    expected = gramloom.synthesise(pebbles, **QUILTING)
    numpy.testing.assert_array_equal(
        gramloom.synthesise(numpy.asfortranarray(pebbles), **QUILTING), expected)
    wide = numpy.repeat(pebbles, 2, axis=1)[:, ::2]
    numpy.testing.assert_array_equal(gramloom.synthesise(wide, **QUILTING), expected)


def test_parameters_may_be_of_numpy(pebbles):
    made = gramloom.synthesise(pebbles, "quilting", size=numpy.array([40, 24]), seed=numpy.int64(1),
                               patch_size=numpy.uint8(8), overlap=None)
    numpy.testing.assert_array_equal(made, gramloom.synthesise(pebbles, **QUILTING))


def test_another_type_of_result(pebbles):
    made = gramloom.synthesise(pebbles, **QUILTING, dtype=numpy.float32)
    assert made.dtype == numpy.float32
    numpy.testing.assert_array_equal(numpy.rint(made * 255).astype("uint8"),
                                     gramloom.synthesise(pebbles, **QUILTING))
    assert gramloom.synthesise(kind="procedural", texture="marble", size=8,
                               dtype="uint16").dtype == numpy.uint16


def test_scores_are_those_of_the_command_line(pebbles, tmp_path, command_line):
    texture = gramloom.synthesise(pebbles, **QUILTING)
    gramloom.write_image(tmp_path / "e.png", pebbles)
    gramloom.write_image(tmp_path / "t.png", texture)
    printed = json.loads(command_line("score", "e.png", "t.png", "--tile", "both", "--json"))
    scores = gramloom.score(pebbles, texture, tile="both")
    assert scores == printed["t.png"]
    assert "seam_x" in scores and "seam_x" not in gramloom.score(pebbles, texture)


@pytest.mark.parametrize("arguments, words", [
    ({"patch_size": -1}, "synthesise: 'patch_size' = -1: allowed are"),
    ({"patch_size": "large"}, "'patch_size' is a text, allowed is a whole number"),
    ({"patch_sise": 8}, "unknown key 'patch_sise' (did you mean 'patch_size'?)"),
    ({"kind": "quiltin"}, "unknown kind 'quiltin' (did you mean 'quilting'?)"),
    ({"tile": "all"}, "unknown tile 'all'"),
    ({"size": (0, 8)}, "'size' = 0: allowed are"),
    ({"seed": -1}, "'seed' = -1"),
    ({"name": "x"}, "name"),
    ({"threads": -1}, "threads = -1"),
    ({"patch_size": object()}, "no values of type object"),
    ({"dtype": "int32"}, "dtype: values of type int32: allowed are uint8"),
    ({"maps": {"height": numpy.zeros((3, 3), "uint8")}},
     "the map exemplar.maps.height has 3×3 pixels and its picture exemplar.image 48×40"),
    ({"exemplar": numpy.zeros((4, 4, 3))}, "exemplar.image: values of type float64"),
    ({"exemplar": numpy.zeros((4,), "uint8")}, "an array of 1 dimensions"),
    ({"exemplar": numpy.zeros((4, 4, 3, 1), "uint8")}, "an array of 4 dimensions"),
    ({"exemplar": numpy.zeros((0, 4), "uint8")}, "empty"),
    ({"exemplar": numpy.full((4, 4), numpy.nan, "float32")}, "exemplar.image: "),
    ({"exemplar": None}, "synthesise: method 'quilting' needs an exemplar"),
    ({"exemplar": "none.png"}, "synthesise: there is no file none.png"),
    ({"size": 65536}, "GB of memory"),
    ({"fill": "hole.png"}, "fill is a table"),
    ({"guide": numpy.zeros((4, 4), numpy.uint8)}, "guide is a table"),
])
def test_what_is_wrong_is_said(arguments, words, pebbles):
    with pytest.raises(gramloom.ConfigError) as caught:
        gramloom.synthesise(**{"exemplar": pebbles, **QUILTING, **arguments})
    assert words in str(caught.value)
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, gramloom.Error)


def test_an_exemplar_that_nobody_needs_is_refused(pebbles):
    with pytest.raises(gramloom.ConfigError, match="procedural"):
        gramloom.synthesise(pebbles, "procedural", texture="marble", size=8)


def test_a_score_of_other_channels_is_refused(pebbles):
    with pytest.raises(gramloom.ConfigError, match="has 1 channels, the exemplar has 3"):
        gramloom.score(pebbles, pebbles[:, :, 0])


def test_every_table_is_an_argument():
    assert {table["name"] for table in gramloom.tables()} == {"exemplar", "guide", "mix", "turn",
                                                              "fill"}
    assert all(table["name"] in inspect.signature(gramloom.synthesise).parameters
               for table in gramloom.tables())


def test_no_parameter_has_the_name_of_an_argument():
    named = set(inspect.signature(gramloom.synthesise).parameters) - {"parameters", "exemplar"}
    keys = {key["name"] for entry in gramloom.methods() + gramloom.patterns()
            for key in entry["parameters"]}
    assert named & keys == {"turn"}  # of a procedural texture a number, else a table
    marble = {"kind": "procedural", "texture": "marble", "size": 16, "tile": "none"}
    assert (gramloom.synthesise(**marble, turn=90) != gramloom.synthesise(**marble)).any()


def test_help_has_every_parameter():
    text = inspect.getdoc(gramloom.synthesise)
    for key in (key for table in gramloom.tables() for key in table["parameters"]):
        assert key["description"] in text
    for entry in gramloom.methods() + gramloom.patterns():
        assert f"'{entry['name']}': {entry['summary']}" in text
        for key in entry["parameters"]:
            assert key["description"] in text
