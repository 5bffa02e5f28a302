"""Saving and loading models of the fine stage: weights as safetensors, the configuration as JSON beside them."""

import json
from pathlib import Path
from typing import Any

import pydantic
import safetensors
from safetensors.torch import load_file, save_file

from models.errors import WeightsError
from models.language.text_encoder import load_text_encoder
from models.localization.fine_model import FineModel
from models.localization.matching import Matching
from models.localization.regressor import Regressor

FINE_METHODS: dict[str, type[FineModel]] = {"regressor": Regressor, "matching": Matching}
DEFAULT_WEIGHTS = Path(__file__).parent.parent / "weights" / "regressor"
WEIGHTS_FILE = "model.safetensors"
CONFIG_FILE = "config.json"


def save_fine(model: FineModel, directory: Path, training: dict[str, Any]) -> None:
    """Write a model of the fine stage.

    Args:
        model: the frozen text encoder is named, not saved.
        directory: made if it is missing.
        training: how it came about, for the record.
    """
    directory.mkdir(parents=True, exist_ok=True)
    save_file({name: tensor.contiguous() for name, tensor in model.state_dict().items()}, directory / WEIGHTS_FILE)
    record = {
        "method": model.method,
        "fine": model.config.model_dump(),
        "fingerprint": model.fingerprint,
        "training": training,
    }
    (directory / CONFIG_FILE).write_text(json.dumps(record, indent=2) + "\n")


def load_fine(directory: Path | None = None) -> FineModel:
    """Read a model of the fine stage, ready to predict.

    Args:
        directory: with model.safetensors and config.json; None for the weights that ship with the package.

    Raises:
        WeightsError: a file is missing or broken, or the weights do not fit the configuration.
    """
    directory = directory or DEFAULT_WEIGHTS
    advice = "train some with 'hereabouts train --method regressor', or leave the position at the cell's centre"
    for name in (CONFIG_FILE, WEIGHTS_FILE):
        if not (directory / name).is_file():
            raise WeightsError(f"no weights of the fine stage in {directory} ({name} is missing); {advice}")
    try:
        record = json.loads((directory / CONFIG_FILE).read_text())
        method = FINE_METHODS[record["method"]]
        config = method.config_type.model_validate(record["fine"])
        weights = load_file(directory / WEIGHTS_FILE)
    except (safetensors.SafetensorError, ValueError, KeyError, TypeError, pydantic.ValidationError) as error:
        raise WeightsError(f"the weights in {directory} cannot be read ({type(error).__name__}); {advice}") from error
    model = method(load_text_encoder(config.text_encoder), config)
    try:
        model.load_state_dict(weights, strict=True)
    except RuntimeError as error:
        raise WeightsError(
            f"the weights in {directory} are not of the model its {CONFIG_FILE} names; {advice}"
        ) from error
    return model.eval()
