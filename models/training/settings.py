"""Training settings: one TOML file per method in configs/, with overrides from the command line."""

import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic.fields import FieldInfo

from models.errors import TrainingError
from models.paper.checkpoint import METHODS
from models.paper.fine.checkpoint import FINE_METHODS
from models.paper.point_encoder import PointArchitecture
from models.posterior.model import PosteriorConfig, PosteriorModel
from models.training.engine.loop import LoopConfig
from models.training.fine_data import CloningMode
from models.training.retrieval_data import WordingMode


class PointsConfig(BaseModel):
    """The model settings of the point encoder."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    point_encoder: PointArchitecture = "small"


CONFIG_TYPES: dict[str, type[BaseModel]] = {
    **{name: method.config_type for name, method in METHODS.items()},
    **{name: method.config_type for name, method in FINE_METHODS.items()},
    PosteriorModel.method: PosteriorConfig,
    "points": PointsConfig,
}
CONFIG_DIR = Path(__file__).parent / "configs"
C = TypeVar("C", bound=BaseModel)


class TrainingConfig(LoopConfig):
    """Training settings of a retriever or a fine stage."""

    cluster: int = Field(default=4, ge=1)  # descriptions of a batch near each other, hard negatives
    spacing_m: float = Field(default=4.0, gt=0)  # of the training positions in an OpenStreetMap file
    # "varied" draws the number of hints and their wording; "published" is that of the benchmark.
    wording: WordingMode = "varied"
    # Share of the training hints replaced by hints of other positions of the batch: noise in the descriptions.
    wrong_hints: float = Field(default=0.0, ge=0, le=1)
    pmc: CloningMode = "containing"  # prototype-based map cloning, see `FineSet`
    # Directory of a point encoder (`hereabouts train --method points`) for point inputs; None trains one.
    points: Path | None = None


def settings_record(method: str, model: BaseModel, config: TrainingConfig) -> dict[str, Any]:
    """Return the settings for the config.json of a run, without the device and paths."""
    training = config.model_dump(mode="json", exclude={"device", "points"})
    return {"method": method, "model": model.model_dump(mode="json"), "training": training}


def load_settings(method: str, changes: Sequence[str] = ()) -> tuple[BaseModel, TrainingConfig]:
    """Load the settings of a method: its model configuration, and how to train it.

    Args:
        method: key of METHODS or of FINE_METHODS.
        changes: "model.FIELD=VALUE" or "training.FIELD=VALUE", with commas in lists and "none" for no value; later
            changes override earlier ones.

    Raises:
        TrainingError: the method or a field does not exist, or a value is invalid.
    """
    if method not in CONFIG_TYPES:
        raise TrainingError(f"there is no method '{method}'; use one of {', '.join(CONFIG_TYPES)}")
    types: dict[str, type[BaseModel]] = {"model": CONFIG_TYPES[method], "training": TrainingConfig}
    tables = tomllib.loads((CONFIG_DIR / f"{method}.toml").read_text())
    for change in changes:
        part, field, value = _parse(change, types)
        tables.setdefault(part, {})[field] = value
    model = _validated(CONFIG_TYPES[method], tables.get("model", {}), "model")
    return model, _validated(TrainingConfig, tables.get("training", {}), "training")


def _parse(change: str, types: dict[str, type[BaseModel]]) -> tuple[str, str, Any]:
    """Parse "part.field=value" into (part, field, value)."""
    name, equals, text = change.partition("=")
    part, _, field = name.strip().partition(".")
    if not equals or part not in types or not field:
        raise TrainingError(
            f"--set {change}: write model.NAME=VALUE or training.NAME=VALUE, for example training.steps=500"
        )
    fields = types[part].model_fields
    if field not in fields:
        raise TrainingError(f"--set {change}: {part} has no '{field}'; it has {', '.join(fields) or 'no settings'}")
    return part, field, _value(text.strip(), fields[field])


def _value(text: str, field: FieldInfo) -> Any:
    if get_origin(field.annotation) in (tuple, list):
        return [item.strip() for item in text.split(",") if item.strip()]
    if text.lower() == "none" and type(None) in get_args(field.annotation):
        return None
    return text  # pydantic converts numbers and booleans


def _validated(config_type: type[C], table: dict[str, Any], part: str) -> C:
    try:
        return config_type.model_validate(table)
    except ValidationError as error:
        problems = "; ".join(
            f"{'.'.join([part, *map(str, e['loc'])])}={e['input']!r}: {e['msg'][0].lower() + e['msg'][1:]}"
            for e in error.errors()
        )
        raise TrainingError(f"invalid settings: {problems}") from error
