"""Saving and loading of models: weights in model.safetensors, the configuration in config.json."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Generic, Protocol, TypeVar

import pydantic
import safetensors
import torch
from safetensors.torch import load_file, save
from torch import Tensor

from models.errors import WeightsError
from models.files import replace_file
from models.language.text_encoder import TextEncoder, load_text_encoder

SHIPPED_WEIGHTS_DIR = Path(__file__).parent / "weights"
WEIGHTS_FILE = "model.safetensors"
CONFIG_FILE = "config.json"
# Tensors with more values are stored in float16 or int8; smaller ones, such as norms and temperatures, save little.
MAX_UNROUNDED_VALUES = 4096
SCALE_SUFFIX = ".scale"  # of the float16 tensor with the scale of each row of an int8 tensor
INT8_MAX = 127
MIN_FLOAT16 = 2.0**-24  # smallest positive value of float16; keeps the scale of an all-zero row above 0


class Model(Protocol):
    """A module on a frozen text encoder; the encoder is stored by name, not by weights."""

    method: ClassVar[Any]
    config_type: ClassVar[type[Any]]
    config: Any

    def __init__(self, text_encoder: TextEncoder, config: Any) -> None: ...

    @property
    def fingerprint(self) -> str:
        """The sha256 of all weights, including the text encoder's."""

    def state_dict(self) -> dict[str, Tensor]: ...  # noqa: D102

    def load_state_dict(self, state_dict: Mapping[str, Any]) -> Any: ...  # noqa: D102

    def eval(self) -> Any: ...  # noqa: D102


M = TypeVar("M", bound=Model)


@dataclass(frozen=True, slots=True)
class Checkpoints(Generic[M]):
    """The on-disk format of one kind of model."""

    kind: str  # key of the configuration in config.json
    methods: Mapping[str, type[M]]
    default: Path  # directory of the weights that ship with the package
    advice: str  # what to do if the weights cannot be used; part of error messages
    is_int8: bool = False  # store large tensors in int8, others in float16; else large in float16, others unchanged

    def save(self, model: M, directory: Path, training: dict[str, Any]) -> None:
        """Write a model on the CPU and how it was trained, and round its own weights to the stored precision."""
        stored = round_weights(model, self.is_int8)
        replace_file(directory / WEIGHTS_FILE, save({name: tensor.contiguous() for name, tensor in stored.items()}))
        record = {
            "method": model.method,
            self.kind: model.config.model_dump(),
            "fingerprint": model.fingerprint,
            "training": training,
        }
        replace_file(directory / CONFIG_FILE, (json.dumps(record, indent=2) + "\n").encode())

    def load(self, directory: Path | None = None) -> M:
        """Load a model in evaluation mode; None for the weights that ship with the package.

        Raises:
            WeightsError: a file is missing or broken, or the weights do not match the configuration.
        """
        directory = directory or self.default
        for name in (CONFIG_FILE, WEIGHTS_FILE):
            if not (directory / name).is_file():
                raise WeightsError(f"no weights in {directory} ({name} is missing); {self.advice}")
        try:
            record = json.loads((directory / CONFIG_FILE).read_text())
            method = self.methods[record["method"]]
            config = method.config_type.model_validate(record[self.kind])
            weights = load_file(directory / WEIGHTS_FILE)
        except (safetensors.SafetensorError, ValueError, KeyError, TypeError, pydantic.ValidationError) as error:
            problem = f"cannot be read ({type(error).__name__})"
            raise WeightsError(f"the weights in {directory} {problem}; {self.advice}") from error
        model = method(load_text_encoder(config.text_encoder), config)
        try:
            model.load_state_dict(_to_float32(weights))
        except (RuntimeError, KeyError) as error:
            problem = f"do not match its {CONFIG_FILE}"
            raise WeightsError(f"the weights in {directory} {problem}; {self.advice}") from error
        model.eval()
        return model


def round_weights(model: Model, is_int8: bool = False) -> dict[str, Tensor]:
    """Round the weights of a model to the precision of `Checkpoints`, in place, and return the tensors to store."""
    stored = _to_int8(model.state_dict()) if is_int8 else _to_float16(model.state_dict())
    model.load_state_dict(_to_float32(stored))
    model.eval()  # drops features cached from the unrounded weights
    return stored


def _to_float16(state: Mapping[str, Tensor]) -> dict[str, Tensor]:
    return {name: tensor.half() if _is_large(tensor) else tensor for name, tensor in state.items()}


def _to_int8(state: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Quantize large tensors to int8 with one scale per row (absmax quantisation, LLM.int8(), NeurIPS 2022)."""
    stored: dict[str, Tensor] = {}
    for name, tensor in state.items():
        if _is_large(tensor) and tensor.dim() > 1:
            scale = (tensor.abs().flatten(1).amax(dim=1) / INT8_MAX).clamp(min=MIN_FLOAT16).half()
            steps = tensor / _along_rows(scale, tensor)
            stored |= {name: steps.round().clamp(-INT8_MAX, INT8_MAX).to(torch.int8), name + SCALE_SUFFIX: scale}
        else:
            stored[name] = tensor.half() if tensor.dtype is torch.float32 else tensor
    return stored


def _to_float32(stored: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Return the state dict that a model loads."""
    state = {name: tensor.float() if tensor.dtype is torch.float16 else tensor for name, tensor in stored.items()}
    for name, tensor in stored.items():
        if tensor.dtype is torch.int8:
            state[name] = tensor * _along_rows(state.pop(name + SCALE_SUFFIX), tensor)
    return state


def _along_rows(scale: Tensor, tensor: Tensor) -> Tensor:
    """Reshape a scale [R] so that it multiplies the rows of a tensor [R, ...]."""
    return scale.float().view(-1, *[1] * (tensor.dim() - 1))


def _is_large(tensor: Tensor) -> bool:
    return tensor.dtype is torch.float32 and tensor.numel() > MAX_UNROUNDED_VALUES
