"""Everything that the hint posterior has learned, in one model: reader, names of labels, likelihood."""

import hashlib
import json
from pathlib import Path
from typing import Any, ClassVar

import pydantic
import safetensors
import torch
from safetensors.torch import load_file, save_file
from torch import nn

from models.errors import WeightsError
from models.language.labels import LabelMatcher
from models.language.reader import Reader, ReaderConfig
from models.language.text_encoder import TextEncoder, fingerprint_of, load_text_encoder
from models.posterior.likelihood import Likelihood

DEFAULT_WEIGHTS = Path(__file__).parent.parent / "weights" / "posterior"
WEIGHTS_FILE = "model.safetensors"
CONFIG_FILE = "config.json"


class PosteriorConfig(ReaderConfig):
    """Shape and calibration.

    Attributes:
        radius_scale: what the radii are multiplied with; fitted on validation data.
    """

    radius_scale: float = 1.0


class PosteriorModel(nn.Module):
    """The parts of the hint posterior that do not depend on a map."""

    method: ClassVar[str] = "posterior"

    def __init__(self, text_encoder: TextEncoder, config: PosteriorConfig) -> None:
        super().__init__()
        self.config = config
        self.reader = Reader(text_encoder, config)
        self.matcher = LabelMatcher(text_encoder)
        self.likelihood = Likelihood()

    @property
    def fingerprint(self) -> str:
        """sha256 of all weights, the frozen ones included."""
        return hashlib.sha256((fingerprint_of(self) + self.reader.text_encoder.fingerprint).encode()).hexdigest()


def save_posterior(model: PosteriorModel, directory: Path, training: dict[str, Any]) -> None:
    """Write a model, the reader in half precision.

    Args:
        model: the frozen text encoder is named, not saved.
        directory: made if it is missing.
        training: how it came about, for the record.
    """
    directory.mkdir(parents=True, exist_ok=True)
    state = model.state_dict()
    halved = {n: t.half() if n.startswith("reader.") and t.is_floating_point() else t for n, t in state.items()}
    save_file({name: tensor.contiguous() for name, tensor in halved.items()}, directory / WEIGHTS_FILE)
    model.load_state_dict({name: tensor.to(state[name].dtype) for name, tensor in halved.items()})  # as it will be read
    record = {
        "method": model.method,
        "posterior": model.config.model_dump(),
        "fingerprint": model.fingerprint,
        "training": training,
    }
    (directory / CONFIG_FILE).write_text(json.dumps(record, indent=2) + "\n")


def load_posterior(directory: Path | None = None) -> PosteriorModel:
    """Read a model, ready to answer.

    Args:
        directory: with model.safetensors and config.json; None for the weights that ship with the package.

    Raises:
        WeightsError: a file is missing or broken, or the weights do not fit the configuration.
    """
    directory = directory or DEFAULT_WEIGHTS
    advice = "train some with 'hereabouts train --method posterior', or ask with refine none"
    for name in (CONFIG_FILE, WEIGHTS_FILE):
        if not (directory / name).is_file():
            raise WeightsError(f"no weights of the posterior in {directory} ({name} is missing); {advice}")
    try:
        record = json.loads((directory / CONFIG_FILE).read_text())
        config = PosteriorConfig.model_validate(record["posterior"])
        weights = load_file(directory / WEIGHTS_FILE)
    except (safetensors.SafetensorError, ValueError, KeyError, TypeError, pydantic.ValidationError) as error:
        raise WeightsError(f"the weights in {directory} cannot be read ({type(error).__name__}); {advice}") from error
    model = PosteriorModel(load_text_encoder(config.text_encoder), config)
    try:
        model.load_state_dict({name: t.float() if t.dtype is torch.float16 else t for name, t in weights.items()})
    except RuntimeError as error:
        raise WeightsError(
            f"the weights in {directory} are not of the model its {CONFIG_FILE} names; {advice}"
        ) from error
    return model.eval()
