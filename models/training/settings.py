"""The settings of a training: a TOML file a method in configs/, single values overridden on the command line."""

import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic.fields import FieldInfo

from models.errors import TrainingError
from models.paper.checkpoint import METHODS
from models.paper.fine.checkpoint import FINE_METHODS
from models.posterior.model import PosteriorConfig, PosteriorModel
from models.training.engine.loop import LoopConfig
from models.training.retrieval_data import Wording


class PointsConfig(BaseModel):
    """The point encoder has no settings."""

    model_config = ConfigDict(frozen=True, extra="forbid")


CONFIG_TYPES: dict[str, type[BaseModel]] = {
    **{name: method.config_type for name, method in METHODS.items()},
    **{name: method.config_type for name, method in FINE_METHODS.items()},
    PosteriorModel.method: PosteriorConfig,
    "points": PointsConfig,
}
CONFIGS = Path(__file__).parent / "configs"
C = TypeVar("C", bound=BaseModel)
EXAMPLE = "--set training.steps=500"


class TrainingConfig(LoopConfig):
    """How to train a retriever or a fine stage.

    Attributes:
        cluster: of the descriptions of a batch, how many lie near each other (hard negatives).
        spacing_m: of an OpenStreetMap file: one training position a square of this size.
        wording: "varied" teaches any number of hints in many words; "published" those of the benchmark alone.
        pmc: of the fine stage: prototype-based map cloning (Text2Loc): half of the time the cell is not the best one
            but another that contains the position.
        points: directory of a point encoder that `hereabouts train --method points` made, for models that take points;
            None trains one first.
    """

    cluster: int = Field(default=4, ge=1)
    spacing_m: float = Field(default=4.0, gt=0)
    wording: Wording = "varied"
    pmc: bool = True
    points: Path | None = None


def settings_record(method: str, model: BaseModel, config: TrainingConfig) -> dict[str, Any]:
    """Settings as a run's config.json says them: what it depends on, wherever it is done and its files are."""
    training = config.model_dump(mode="json", exclude={"device", "points"})
    return {"method": method, "model": model.model_dump(mode="json"), "training": training}


def load_settings(method: str, changes: Sequence[str] = ()) -> tuple[BaseModel, TrainingConfig]:
    """Settings of a method: (of its `config_type`, how to train it).

    Args:
        method: key of METHODS or of FINE_METHODS.
        changes: "model.FIELD=VALUE" or "training.FIELD=VALUE"; lists are separated by commas, "none" is no value;
            a later one wins.

    Raises:
        TrainingError: there is no such method or field, or a value does not fit.
    """
    if method not in CONFIG_TYPES:
        raise TrainingError(f"there is no method '{method}'; take one of {', '.join(CONFIG_TYPES)}")
    types: dict[str, type[BaseModel]] = {"model": CONFIG_TYPES[method], "training": TrainingConfig}
    tables = tomllib.loads((CONFIGS / f"{method}.toml").read_text())
    for change in changes:
        part, field, value = _parse(change, types)
        tables.setdefault(part, {})[field] = value
    model = _validated(CONFIG_TYPES[method], tables.get("model", {}), "model")
    return model, _validated(TrainingConfig, tables.get("training", {}), "training")


def _parse(change: str, types: dict[str, type[BaseModel]]) -> tuple[str, str, Any]:
    """(part, field, value) of "part.field=value"."""
    name, equals, text = change.partition("=")
    part, _, field = name.strip().partition(".")
    if not equals or part not in types or not field:
        raise TrainingError(f"--set {change}: give it as model.NAME=VALUE or training.NAME=VALUE, as in {EXAMPLE}")
    fields = types[part].model_fields
    if field not in fields:
        raise TrainingError(f"--set {change}: {part} has no '{field}'; it has {', '.join(fields) or 'no settings'}")
    return part, field, _value(text.strip(), fields[field])


def _value(text: str, field: FieldInfo) -> Any:
    if get_origin(field.annotation) in (tuple, list):
        return [item.strip() for item in text.split(",") if item.strip()]
    if text.lower() == "none" and type(None) in get_args(field.annotation):
        return None
    return text  # pydantic reads numbers and truth values out of it


def _validated(config_type: type[C], table: dict[str, Any], part: str) -> C:
    try:
        return config_type.model_validate(table)
    except ValidationError as error:
        wrong = "; ".join(
            f"{'.'.join([part, *map(str, e['loc'])])}={e['input']!r}: {e['msg'][0].lower() + e['msg'][1:]}"
            for e in error.errors()
        )
        raise TrainingError(f"settings cannot be trained with: {wrong}") from error
