"""New textures from a small picture of one.

    import gramloom
    pebbles = gramloom.read_image("pebbles.png")
    texture = gramloom.synthesise(pebbles, kind="quilting", size=(512, 512), patch_size=48)
    gramloom.write_image("texture.png", texture)

synthesise() makes one texture, score() compares one with its exemplar, run() and train() do what a
config file says, methods(), patterns() and tables() list what there is. What is wrong with values
is a ConfigError (a ValueError), all else an Error (a RuntimeError). Ctrl-C stops the work.
"""

import os as _os

# Threads of libgomp that have nothing to do shall sleep soon (core/spinning.h). It reads this when
# it is loaded; what this process starts later shall not see it.
_spins = not {"GOMP_SPINCOUNT", "OMP_WAIT_POLICY"} & _os.environ.keys()
if _spins:
    _os.environ["GOMP_SPINCOUNT"] = "1000"
try:
    from . import _gramloom
finally:
    if _spins:
        del _os.environ["GOMP_SPINCOUNT"]
from ._gramloom import ConfigError, Error, Progress

__version__ = _gramloom.version
__all__ = [
    "ConfigError", "Error", "Progress", "methods", "patterns", "read_image", "run", "score",
    "synthesise", "tables", "train", "write_image",
]
for _name in (ConfigError, Error, Progress):
    _name.__module__ = __name__


def _toml(value):
    """A value as a config writes it."""
    import json
    import numbers

    if isinstance(value, _os.PathLike):
        value = _os.fspath(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, bool) or type(value).__name__ in ("bool_", "bool"):  # NumPy has its own
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, dict):
        entries = (f"{_toml(str(key))} = {_toml(entry)}" for key, entry in value.items())
        return "{ " + ", ".join(entries) + " }"
    if hasattr(value, "tolist"):  # an array
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(entry) for entry in value) + "]"
    raise ConfigError(f"a config has no values of type {type(value).__name__}: {value!r}")


def _table(values):
    """The lines of a table of a config; None: not set."""
    return "".join(f"{_toml(key)} = {_toml(value)}\n" for key, value in values.items()
                   if value is not None)


def _named(value, name, pictures):
    """A value of a table with names in place of its arrays that are pictures; these by the names."""
    import numpy

    if isinstance(value, dict):
        return {key: _named(entry, f"{name}.{key}", pictures) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_named(entry, f"{name}[{i}]", pictures) for i, entry in enumerate(value)]
    stands_as_picture = name.endswith(".image") and isinstance(value, numpy.ndarray)
    if numpy.ndim(value) < 2 and not stands_as_picture:
        return value
    array = numpy.asarray(value)
    pictures[name] = array * numpy.uint8(255) if array.dtype == bool else array
    return name


def _exemplar(exemplar, maps):
    """The table of an exemplar, which may be a picture alone."""
    table = exemplar if isinstance(exemplar, dict) else {"image": exemplar}
    if maps and "maps" in table:
        raise ConfigError("maps: the exemplar's table has some too")
    return {**table, "maps": maps} if maps else table


def _exemplars(exemplar, maps):
    """The table of all exemplars, or None."""
    several = isinstance(exemplar, (list, tuple))
    exemplars = [] if exemplar is None else list(exemplar) if several else [exemplar]
    all_maps = [] if not maps else list(maps) if isinstance(maps, (list, tuple)) else [maps]
    if len(all_maps) not in (0, len(exemplars)):
        raise ConfigError(f"maps: of {len(all_maps)} exemplars, and there are {len(exemplars)}")
    tables = [_exemplar(*pair) for pair in zip(exemplars, all_maps or [None] * len(exemplars))]
    if several:
        return {"images": tables}
    return tables[0] if tables else None


def synthesise(exemplar=None, kind="patchmatch", size=None, tile=None, seed=1, *, maps=None,
               guide=None, mix=None, turn=None, fill=None, dtype=None, threads=0, progress=None,
               **parameters):
    if turn is not None and not isinstance(turn, dict):  # of a procedural texture
        parameters["turn"], turn = turn, None
    directions = {"guide": guide, "mix": mix, "turn": turn, "fill": fill}
    if all(table is None for table in directions.values()):
        size, tile = (512, 512) if size is None else size, "both" if tile is None else tile
    for name, table in directions.items():
        if table is not None and not isinstance(table, dict):
            raise ConfigError(f"{name} is a table, as {name}={{\"image\": array}}")
    pixel_type = None if dtype is None else _gramloom.pixel_type(dtype)
    config = _table({"size": size, "tile": tile, "seeds": [seed], "pixel_type": pixel_type})
    pictures = {}
    exemplars = _named(_exemplars(exemplar, maps), "exemplar", pictures)
    if exemplars is not None:
        config += "[[exemplar]]\n" + _table({"name": "exemplar", **exemplars})
    for name, table in directions.items():
        if table is not None:
            config += f"[{name}]\n" + _table(_named(table, name, pictures))
    config += "[[method]]\n" + f"name = {_toml(kind)}\n" + _table({"kind": kind, **parameters})
    texture, made = _gramloom.synthesise(config, pictures, threads, progress)
    return texture if maps is None else (texture, made)


synthesise.__doc__ = """A texture of one or several exemplars, as a NumPy array.

    exemplar: an array of shape (height, width) or (height, width, channels) with values of type
        uint8, uint16, float16 or float32; of 2 or 4 channels the last is alpha. Or a table as the
        config's [[exemplar]], {"image": array, "mask": array}: a dict in which arrays stand for
        pictures. Several pictures of one material as a list of these. None for kinds that need no
        exemplar, and with fill.
    kind, parameters: the method and its parameters, as in a config; None: not set. See below and
        methods().
    size: width and height, in pixels. tile: which edges meet: none, x, y, both. None: 512 × 512 and
        both; with guide, mix, turn or fill as in a config: those of their pictures.
    seed: of the random numbers. The same arguments give the same texture, and that of the command
        line.
    maps: further arrays of the same surface by their names ("height", "normal"), made together with
        the picture; of several exemplars, a list. Then (texture, maps by name) is returned; with {}
        too, for maps that tables name or that a method makes by itself.
    guide, mix, turn, fill: what goes where, as the config's tables: guide={"image": array}. See
        below and tables(). In place of an array a file can be named. Masks may be bool.
    dtype: type of the result's values; the exemplar's, or uint8.
    threads: 0: as many as there are cores.
    progress: called with a Progress now and then; when it raises, the work stops.
""" + _gramloom.documentation()


def score(exemplar, texture, tile="none", *, threads=0, progress=None):
    """The scores of a texture against the exemplar that it was made from, by name: those of
    'gramloom score'. Both are arrays as for synthesise(); tile: the axes on which it tiles."""
    return _gramloom.score(exemplar, texture, tile, threads, progress)


def _set(values):
    if isinstance(values, dict):
        return [f"{key}={_toml(value)}" for key, value in values.items()]
    return [str(value) for value in values or ()]


def _do(work, config, output, only, resume, set, jobs, shard, threads, progress):
    import json
    import warnings

    folder = "" if output is None else _os.fsencode(output)
    records, complaints = work(_os.fsencode(config), folder, only, resume, _set(set), jobs, shard,
                               threads, progress)
    for complaint in complaints:
        warnings.warn(complaint, RuntimeWarning, stacklevel=3)
    return json.loads(records)


def run(config, output=None, only="", resume=False, set=None, *, jobs=1, shard=None, threads=0,
        progress=None):
    """Does the jobs of a config file, as 'gramloom run' does, and returns their records: a dict
    each, with the job's "name", the "folder" of its "files", its "status", "metrics", "settings".
    A job that fails does not stop the others: its "status" is "failed", its "error" says why, and
    there is a warning.

    output: the folder of the results; None: out/NAME. only: a pattern of jobs' names. resume: keep
    finished jobs. set: values in place of the config's, {"size": 256, "method.NAME.key": value} or
    ["key=value"]. jobs: so many at once, each in a process of the program gramloom; 0: as many as
    threads. shard: "K/N", this call does the K-th of N parts of the jobs, others do the rest into
    the same folder; "": what Slurm says. progress: called with a Progress now and then; when it
    raises, the work stops.
    """
    return _do(_gramloom.run, config, output, only, resume, set, jobs, shard, threads, progress)


def train(config, output=None, resume=False, set=None, *, only="", threads=0, progress=None):
    """Trains the models of a config file, as 'gramloom train' does, then makes and scores textures
    by them. Arguments and result are those of run(); the models lie in OUTPUT/models."""
    return _do(_gramloom.train, config, output, only, resume, set, 1, None, threads, progress)


def methods():
    """Every method as a dict: its name, summary, abilities and parameters, each of these with name,
    type, default, allowed, min, max, words, unit and description."""
    import json
    return json.loads(_gramloom.methods())


def patterns():
    """Every texture of the kind 'procedural', in the same form."""
    import json
    return json.loads(_gramloom.patterns())


def tables():
    """What synthesise() takes as a dict (exemplar, guide, mix, turn, fill), with its keys in the
    same form."""
    import json
    return json.loads(_gramloom.tables())


def read_image(file):
    """A picture file as an array with the type of its values, of shape (height, width) when it has
    one channel, else (height, width, channels)."""
    return _gramloom.read_image(_os.fsencode(file))


def write_image(file, image):
    """Writes an array as a picture file, by its ending. Returns notes: where the file has less."""
    return _gramloom.write_image(_os.fsencode(file), image)
