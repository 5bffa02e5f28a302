"""prepare, convert, synth, and the commands that take what they make, on a made-up street."""

import json
import os
import shutil

import pytest
from typer.testing import CliRunner

from app.cli.main import app
from models.sources.synthetic import towns
from tests.models.sources.raw_scenes import VAL_STREET


@pytest.fixture
def run(monkeypatch, weights_dir):
    monkeypatch.setenv("HEREABOUTS_WEIGHTS_DIR", str(weights_dir))
    monkeypatch.setenv("COLUMNS", "160")
    return lambda *args: CliRunner().invoke(app, [str(arg) for arg in args])


@pytest.fixture(scope="module")
def prepared(raw_root, tmp_path_factory):
    out = tmp_path_factory.mktemp("prepared")
    result = CliRunner().invoke(app, ["prepare", "--raw", str(raw_root), "--out", str(out)])
    assert result.exit_code == 0, result.output
    return out


def test_prepare_makes_one_scene_alone(run, raw_root, prepared, tmp_path) -> None:
    result = run("prepare", "--raw", raw_root, "--out", tmp_path, "--scene", "0010")
    assert result.exit_code == 0, result.output
    assert os.listdir(tmp_path / "cells") == [f"{VAL_STREET}.pkl"]
    name = f"cells/{VAL_STREET}.pkl"
    assert (tmp_path / name).read_bytes() == (prepared / name).read_bytes()


@pytest.mark.slow
def test_what_prepare_made_is_converted_indexed_and_asked(run, prepared, tmp_path) -> None:
    store, index = tmp_path / "store", tmp_path / "index"
    assert run("convert", "--data", prepared, "--out", store).exit_code == 0
    assert run("index", "--map", store, "--out", index).exit_code == 0
    answer = run("localize", "The pose is north of a gray road.", "--index", index, "--json")
    scenes = {c["cell_id"].split("_")[0] for c in json.loads(answer.output)["candidates"]}
    assert scenes <= {"0003", "0010"}
    reports = []
    for data in (prepared, store):
        result = run("evaluate", "--data", data, "--split", "test", "--report", tmp_path / "r")
        assert result.exit_code == 0, result.output
        reports.append(json.loads((tmp_path / "r" / "report.json").read_text()) | {"data": ""})
    assert reports[0] == reports[1]
    assert set(reports[0]["by_scene"]) == {"0003"}


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("evaluate",), "--data"),
        (("evaluate", "--data", "DATA", "--grow", "near,far"), "not a list of metres"),
        (("evaluate", "--data", "DATA", "--split", "train"), "no scene of split 'train'"),
        (("evaluate", "--data", "NOTHING"), "NOTHING"),
        (("index", "--map", "DATA", "--out", "OUT", "--split", "0042"), "0042"),
        (("prepare", "--raw", "DATA", "--out", "OUT"), "published layout"),
        (("convert", "--data", "DATA", "--out", "DATA"), "not empty"),
        (("synth", "--out", "OUT", "--scale", "huge"), "demo, full"),
        (("synth", "--out", "OUT", "--pieces", "some"), "official, own"),
    ],
)
def test_mistakes_get_one_line_that_helps(run, prepared, tmp_path, args, message) -> None:
    places = {"DATA": prepared, "OUT": tmp_path / "out"}
    result = run(*(places.get(arg, arg) for arg in args))
    assert result.exit_code == 1
    assert message in result.output
    assert not (tmp_path / "out").exists()


def test_a_reader_is_kept_by_the_posterior_alone(run, prepared, tmp_path) -> None:
    args = ("train", "--data", prepared, "--out", tmp_path / "out", "--reader", tmp_path)
    result = run(*args, "--method", "mncl")
    assert result.exit_code == 1
    assert "--reader is for --method posterior" in result.output
    assert "no weights in" in run(*args, "--method", "posterior").output


def test_synth_gives_ground_one_number_unless_told_otherwise(run, tmp_path, monkeypatch) -> None:
    calls = []
    monkeypatch.setattr(towns, "write_towns", lambda *args: calls.append(args) or ("one",))
    assert run("synth", "--out", tmp_path / "out").exit_code == 0
    assert run("synth", "--out", tmp_path / "out", "--pieces", "own").exit_code == 0
    assert [args[-1] for args in calls] == ["official", "own"]


def test_an_index_is_verified_whole_or_by_version(run, index_dir, tmp_path) -> None:
    root = tmp_path / "index"
    shutil.copytree(index_dir, root)
    [version] = json.loads((root / "aliases.json").read_text())["versions"]
    for named in (root, root / version):
        result = run("verify", "--index", named)
        assert result.exit_code == 0, result.output
        assert f"index {version} of tinytown is intact" in result.output
    file = root / version / "statements.safetensors"
    content = bytearray(file.read_bytes())
    content[-1] ^= 1
    file.write_bytes(content)
    for named in (root, root / version):
        result = run("verify", "--index", named)
        assert result.exit_code == 1
        assert "statements.safetensors was changed" in result.output
    assert "no index" in run("verify", "--index", tmp_path / "nothing").output


@pytest.mark.slow
def test_an_index_that_fits_is_kept(run, prepared, tmp_path) -> None:
    versions = []
    for split in ("0003", "0003", "0010"):
        args = ("index", "--map", prepared, "--out", tmp_path, "--split", split, "--keep-current")
        assert run(*args).exit_code == 0
        versions.append(json.loads((tmp_path / "aliases.json").read_text())["aliases"]["default"])
    assert versions[0] == versions[1] != versions[2]
