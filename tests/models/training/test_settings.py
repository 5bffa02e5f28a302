import pytest

from models.errors import TrainingError
from models.paper.checkpoint import METHODS
from models.paper.instance_encoder import PAPER_INPUTS
from models.training.experiments import POINTS, TrainingRun
from models.training.settings import TrainingConfig, load_settings


@pytest.mark.parametrize("method", list(METHODS))
def test_every_method_has_settings(method) -> None:
    model, training = load_settings(method)
    assert isinstance(model, METHODS[method].config_type)
    assert training == TrainingConfig()


def test_settings_are_changed_one_by_one() -> None:
    changes = [
        "model.levels=global, instance",
        "model.dropout=0",
        "training.steps=500",
        "training.patience=3",
        "training.learning_rate=1e-4",
        "training.schedule=step",
        "training.steps=600",
    ]
    model, training = load_settings("mncl", changes)
    assert (model.levels, model.dropout) == (("global", "instance"), 0.0)
    assert (training.steps, training.patience, training.learning_rate) == (600, 3, 1e-4)
    assert training.schedule == "step"
    assert load_settings("mncl", ["training.patience=none"])[1].patience is None
    model, _ = load_settings("regressor", ["model.points_frozen=false", "model.inputs=points"])
    assert not model.points_frozen


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("steps=5", "training.NAME=VALUE"),
        ("training.steps", "training.NAME=VALUE"),
        ("training.stepz=5", "it has seed, steps"),
        ("model.margin=1", "model has no 'margin'"),
        ("training.steps=many", r"training.steps='many': input should be a valid integer"),
        ("training.steps=0", "greater than or equal to 1"),
        ("training.steps=none", "valid integer"),
        ("model.levels=global,street", "'global', 'instance' or 'relation'"),
        ("model.levels=instance", "write 'global' first"),
        ("model.levels=instance,global", "write 'global' first"),
        ("model.levels=global,global", "each once"),
        ("model.levels=", "write 'global' first"),
        ("model.graph_layers=-1", r"model.graph_layers='-1': input should be greater than or equal to 0"),
        ("model.exponent=-1", r"model.exponent='-1': input should be greater than or equal to 0"),
        ("model.loss_temperature=0", "greater than 0"),
        ("model.dropout=1", "less than 1"),
        ("model.cell_layers=-1", "greater than or equal to 0"),
        ("model.width=30", "multiple of 4"),
        ("model.point_encoder=large", "'small' or 'official'"),
        ("model.point_encoder=official", "add points to model.inputs"),
        ("model.points_frozen=false", "add points to model.inputs"),
        ("model.point_relations=true", "add points to model.inputs"),
    ],
)
def test_what_is_wrong_with_a_setting_is_said(change, message) -> None:
    with pytest.raises(TrainingError, match=message):
        load_settings("mncl", [change])


def test_an_unknown_method() -> None:
    with pytest.raises(TrainingError, match="text2loc"):
        load_settings("bm25")


def test_a_run_needs_a_point_encoder_of_its_own_architecture() -> None:
    run = TrainingRun("mncl", (("inputs", PAPER_INPUTS),))
    assert run.point_run == TrainingRun(POINTS)
    official = run.with_changes((("point_encoder", "official"), ("points_frozen", False)))
    assert load_settings(POINTS, official.point_run.settings)[0].point_encoder == "official"
    assert not load_settings("mncl", official.settings)[0].points_frozen
