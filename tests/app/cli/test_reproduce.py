"""reproduce, as far as it comes without training."""

import pytest
import torch
from typer.testing import CliRunner

from app.cli.main import app
from app.cli.reproduce import _override
from models.errors import DataError
from models.sources.source import open_source
from models.training.experiments import SCALES
from models.training.paper_tables import TABLE_2
from models.training.settings import load_settings

SCALE = SCALES["demo"]
WITHOUT_GPU = pytest.mark.skipif(torch.cuda.is_available(), reason="there is a GPU here")


def test_a_configuration_and_options_change_every_training(tmp_path) -> None:
    config = tmp_path / "paper.toml"
    config.write_text("""
[retriever.model]
text_encoder = "/models/flan-t5-large"
[retriever.training]
steps = 5
[points.training]
steps = 6
""")
    scale = _override(SCALE, config, None, "cpu")
    model, training = load_settings("mncl", scale.retriever)
    assert model.text_encoder == "/models/flan-t5-large"
    assert (training.steps, training.device, training.batch_size) == (5, "cpu", 64)
    assert load_settings("points", scale.points)[1].steps == 6
    assert load_settings("regressor", scale.fine)[1].steps == load_settings("regressor", SCALE.fine)[1].steps
    overridden = _override(SCALE, config, 40, None)
    assert load_settings("mncl", overridden.retriever)[1].steps == 40, "an option wins"
    assert load_settings("mncl", overridden.retriever)[1].validate_every == 2
    assert load_settings("points", overridden.points)[1].steps == 6


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[coarse.model]\nwidth = 3", "unknown table 'coarse'"),
        ("width", "cannot be read"),
        ("[retriever]\nwidth = 3", "retriever.model"),
        ("retriever = 3", "retriever.model"),
        ("[fine.model]\ninputs = ['points']", "the tables compare inputs"),
    ],
)
def test_a_configuration_that_is_none_is_refused(tmp_path, text, message) -> None:
    (tmp_path / "c.toml").write_text(text)
    with pytest.raises(DataError, match=message):
        _override(SCALE, tmp_path / "c.toml", None, None)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--steps", "3", "--epochs", "2"), "one of them"),
        (("--tables", "7"), "--tables 7: unknown"),
        (("--seeds", "one"), "--seeds one"),
        (("--device", "tpu"), "device"),
        pytest.param(
            ("--device", "cuda"), "no GPU", marks=pytest.mark.skipif(torch.cuda.is_available(), reason="a GPU")
        ),
    ],
)
def test_what_cannot_be_made_is_said_in_one_line_before_any_work(tmp_path, options, message) -> None:
    result = CliRunner().invoke(app, ["reproduce", "--out", str(tmp_path / "runs"), *options])
    assert result.exit_code != 0
    assert message in result.output
    assert not (tmp_path / "runs").exists()


def test_a_dry_run_lists_trainings_and_writes_nothing(tmp_path) -> None:
    out = tmp_path / "runs"
    options = ("--tables", "2", "--seeds", "0,1", "--workers", "3", "--dry-run")
    result = CliRunner().invoke(app, ["reproduce", "--out", str(out), *options])
    assert result.exit_code == 0, result.output
    rows, trainings = result.output.splitlines(), 1 + 2 * 2 * len({row.run for row in TABLE_2.rows})  # 1 for points
    assert [row.split()[-1] for row in rows[:-1]] == ["missing"] * trainings
    assert f"{trainings} trainings, {trainings} missing: about" in rows[-1]
    assert "shared by 3 workers" in rows[-1]
    assert not out.exists()
    result = CliRunner().invoke(app, ["reproduce", "--out", str(out), *options, "--epochs", "2"])
    assert result.exit_code != 0
    assert "--epochs counts in batches" in result.output
    result = CliRunner().invoke(app, ["reproduce", "--out", str(out), "--data", str(out), "--dry-run"])
    assert "no such file" in result.output


def test_a_dry_run_uses_the_data_that_exist(osm_file, tmp_path) -> None:
    options = ("--tables", "2", "--dry-run", "--epochs", "2")
    result = CliRunner().invoke(app, ["reproduce", "--out", str(tmp_path), "--data", str(osm_file), *options])
    assert result.exit_code == 0, result.output
    steps = 2 * (len(open_source(osm_file, "train").queries()) // 64)
    assert f" {steps} steps  missing" in result.output
