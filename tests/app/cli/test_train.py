"""train, on the tiny town."""

import json

import pytest
from typer.testing import CliRunner

from app.cli.main import app
from models.language.text_encoder import loaded
from models.training import validation


@pytest.fixture
def run(monkeypatch, weights_dir):
    monkeypatch.setenv("HEREABOUTS_WEIGHTS_DIR", str(weights_dir))
    monkeypatch.setenv("COLUMNS", "160")
    return lambda *args: CliRunner().invoke(app, [str(arg) for arg in args])


def test_train_writes_weights_that_index_and_evaluate_take(run, osm_file, tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(validation, "CALIBRATION_QUERIES_PER_SOURCE", 20)
    result = run("train", "--data", osm_file, "--out", tmp_path / "w", "--steps", "1")
    assert result.exit_code == 0, result.output
    assert "recall@1/3/5" in result.output
    record = json.loads((tmp_path / "w" / "config.json").read_text())
    assert record["training"]["config"]["steps"] == 1
    assert record["training"]["sources"][0]["validation"]["queries"] > 0


def test_a_fine_stage_is_trained_and_refines_what_is_evaluated(run, osm_file, tmp_path, monkeypatch) -> None:
    small = ("--set", "model.width=16", "--set", "training.batch_size=8", "--set", "training.validate_every=1")
    result = run("train", "--method", "regressor", "--data", osm_file, "--out", tmp_path / "w", "--steps", "2", *small)
    assert result.exit_code == 0, result.output
    assert "within_5m" in result.output
    monkeypatch.setenv("HEREABOUTS_FINE_WEIGHTS_DIR", str(tmp_path / "w"))
    args = ("evaluate", "--data", osm_file, "--split", "val", "--report", tmp_path / "r", "--refine", "regressor")
    assert run(*args).exit_code == 0
    report = json.loads((tmp_path / "r" / "report.json").read_text())
    assert report["method"] == "regressor"
    assert report["localization"] != report["cell_center"]


def test_texts_go_with_the_method_places_and_each_with_a_map(run, osm_file, tmp_path) -> None:
    texts = tmp_path / "texts.jsonl"
    for method, given in (("posterior", ("--texts", texts)), ("places", ())):
        result = run("train", "--method", method, "--data", osm_file, *given, "--out", tmp_path / "w")
        assert result.exit_code == 1


@pytest.mark.slow
def test_a_point_encoder_is_made_alone(run, osm_file, tmp_path) -> None:
    few = ("--set", "training.batch_size=8", "--set", "training.validate_every=1")
    asked_for = loaded.cache_info()
    result = run("train", "--method", "points", "--data", osm_file, "--out", tmp_path / "p", "--steps", "2", *few)
    assert result.exit_code == 0, result.output
    assert "label" in result.output
    assert loaded.cache_info() == asked_for, "points are told apart without words"
    assert json.loads((tmp_path / "p" / "config.json").read_text())["validation"].keys() == {"label", "colour"}
    result = run("train", "--method", "text2loc", "--data", osm_file, "--out", tmp_path / "w", "--steps", "1",
                 "--set", f"training.points={tmp_path / 'p'}")  # fmt: skip
    assert result.exit_code == 1
    assert "models with point inputs" in result.output
