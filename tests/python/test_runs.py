"""run() and train() do what the command line does, and say what became of it."""
import csv
import json

import gramloom
import pytest

CONFIG = """
seeds = [1, 2]
size = [32, 24]
[[exemplar]]
name = "e"
image = "e.png"
[[method]]
name = "q"
kind = "quilting"
patch_size = 8
[[method]]
name = "h"
kind = "histogram"
"""

# A training of one level that takes a second.
MODEL = """
size = 64
tile = "both"
scores = false
[[exemplar]]
name = "e"
image = "e.png"
[[model]]
name = "g"
kind = "generator"
coarsest_side = 32
hidden = [8]
layers = [2]
noise = [4]
steps = [10]
batch = [1]
directions = 8
adversary_hidden = [4]
adversary_layers = [2]
"""


@pytest.fixture
def quilts(pebbles, tmp_path, config):
    gramloom.write_image(tmp_path / "e.png", pebbles)
    return config(CONFIG)


def test_a_run_leaves_what_the_command_line_leaves(quilts, tmp_path, command_line):
    command_line("run", "c.toml", "--output", "by_command", "--quiet")
    told = []
    records = gramloom.run(quilts, tmp_path / "by_python", progress=told.append)
    assert [record["name"] for record in records] == ["e/q/seed1", "e/q/seed2", "e/h/seed1",
                                                      "e/h/seed2"]
    # A job may be over before anyone looks.
    assert all(progress.job.startswith("e/") for progress in told)
    for record in records:
        assert record["status"] == "done" and record["metrics"]
        file = tmp_path / "by_python" / record["name"]
        assert record["folder"] == str(file.parent)
        same = tmp_path / "by_command" / record["name"]
        assert file.with_suffix(".png").read_bytes() == same.with_suffix(".png").read_bytes()
    assert (tmp_path / "by_python/index.html").exists()
    with open(tmp_path / "by_python/scores.csv", encoding="utf-8") as file:
        assert len(list(csv.DictReader(file))) == 4


def pictures_of(folder):
    return {file.relative_to(folder): file.read_bytes() for file in folder.rglob("*.png")}


def test_jobs_at_once_are_the_same(quilts, tmp_path):
    gramloom.run(quilts, tmp_path / "one")
    told = []
    records = gramloom.run(quilts, tmp_path / "two", jobs=2, progress=told.append)
    assert [record["status"] for record in records] == 4 * ["done"]
    assert pictures_of(tmp_path / "two") == pictures_of(tmp_path / "one")
    assert told and all(0 <= progress.step <= progress.steps == 4 for progress in told)
    assert any("/seed" in progress.job for progress in told)
    with open(tmp_path / "two/run.json", encoding="utf-8") as file:
        assert json.load(file)["command"] == ["gramloom", "run", str(quilts),
                                              f"--output={tmp_path / 'two'}", "--jobs=2"]


def test_shards_together_are_the_whole_run(quilts, tmp_path, command_line):
    gramloom.run(quilts, tmp_path / "one")
    records = [record["name"] for k in (1, 2)
               for record in gramloom.run(quilts, tmp_path / "all", shard=f"{k}/2")]
    assert sorted(records) == ["e/h/seed1", "e/h/seed2", "e/q/seed1", "e/q/seed2"]
    assert not (tmp_path / "all/index.html").exists()
    assert pictures_of(tmp_path / "all") == pictures_of(tmp_path / "one")


def test_the_folder_is_that_of_the_config_by_default(quilts, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    records = gramloom.run("c.toml", only="*/h/seed1", set={"method.h.kind": "histogram"})
    assert len(records) == 1
    assert (tmp_path / "out/c/e/h/seed1.png").exists()


def test_values_are_set(quilts, tmp_path):
    records = gramloom.run(quilts, tmp_path / "out", only="e/q",
                           set={"size": [16, 8], "seeds": [5], "method.q.patch_size": 4})
    assert [record["size"] for record in records] == [[16, 8]]
    assert records[0]["seed"] == 5
    assert records[0]["settings"]["method"]["patch_size"] == 4
    assert gramloom.run(quilts, tmp_path / "out2", only="e/h", set=["seeds=3"])[0]["seed"] == 3


def test_a_job_that_fails_is_told_and_stops_no_other(quilts, tmp_path):
    (tmp_path / "e.png").write_bytes(b"no picture")
    with pytest.warns(RuntimeWarning, match="e/q/seed1"):
        records = gramloom.run(quilts, tmp_path / "out")
    assert {record["status"] for record in records} == {"failed"}
    assert "e.png" in records[0]["error"]


def test_mistakes_are_said_as_on_the_command_line(quilts, tmp_path, config):
    with pytest.raises(gramloom.ConfigError, match=r"d.toml:\d+:\d+: unknown key 'siez'"):
        gramloom.run(config(CONFIG.replace("size =", "siez ="), "d"), tmp_path / "out")
    with pytest.raises(gramloom.ConfigError, match="none.toml"):
        gramloom.run(tmp_path / "none.toml")
    with pytest.raises(gramloom.ConfigError, match="--only nothing"):
        gramloom.run(quilts, tmp_path / "out", only="nothing")
    with pytest.raises(gramloom.ConfigError, match="--jobs -1: allowed are 0 to 1024"):
        gramloom.run(quilts, tmp_path / "out", jobs=-1)
    with pytest.raises(gramloom.ConfigError, match="--shard: '3/2' is no shard"):
        gramloom.run(quilts, tmp_path / "out", shard="3/2")
    with pytest.raises(gramloom.ConfigError, match=r"there is no \[\[model\]\] to train"):
        gramloom.train(quilts, tmp_path / "out")
    with pytest.raises(gramloom.Error, match="none.png"):
        gramloom.read_image(tmp_path / "none.png")


def test_models_are_trained_and_run(pebbles, tmp_path, config):
    gramloom.write_image(tmp_path / "e.png", pebbles)
    file = config(MODEL)
    told = []
    records = gramloom.train(file, tmp_path / "out", progress=told.append)
    assert [record["status"] for record in records] == ["done"]
    assert any("training e_g" in progress.job for progress in told)
    model = tmp_path / "out/models/e_g.safetensors"
    made = gramloom.synthesise(kind="generator", model=model, size=64)
    assert (made == gramloom.read_image(tmp_path / "out" / (records[0]["name"] + ".png"))).all()

