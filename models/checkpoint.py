"""Models on disk: weights as safetensors, the configuration as JSON beside them."""

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

SHIPPED = Path(__file__).parent / "weights"
WEIGHTS_FILE = "model.safetensors"
CONFIG_FILE = "config.json"
LARGE = 4096  # values; a tensor of more is kept in half precision, or in eight bits
SCALE = ".scale"  # after the name of a tensor in eight bits: what a step is worth in each of its rows
STEPS = 127  # to either side of 0
SMALLEST = 2.0**-24  # above 0, of half precision


class Model(Protocol):
    """What is kept: a module on a frozen text encoder, which is named and not saved."""

    method: ClassVar[Any]
    config_type: ClassVar[type[Any]]
    config: Any

    def __init__(self, text_encoder: TextEncoder, config: Any) -> None: ...

    @property
    def fingerprint(self) -> str:
        """sha256 of all weights, the text encoder's included."""

    def state_dict(self) -> dict[str, Tensor]: ...  # noqa: D102

    def load_state_dict(self, state_dict: Mapping[str, Any]) -> Any: ...  # noqa: D102

    def eval(self) -> Any: ...  # noqa: D102


M = TypeVar("M", bound=Model)


@dataclass(frozen=True, slots=True)
class Checkpoints(Generic[M]):
    """One kind of models on disk.

    Attributes:
        kind: key of the configuration in config.json.
        methods: the models of this kind by name.
        default: directory of the weights that ship with the package.
        advice: what to do where there are no good weights.
        eight_bits: whether large tensors are kept in eight bits and all others in half precision, so that more models
            fit into what ships; else large ones in half precision and all others as they are.
    """

    kind: str
    methods: Mapping[str, type[M]]
    default: Path
    advice: str
    eight_bits: bool = False

    def save(self, model: M, directory: Path, training: dict[str, Any]) -> None:
        """Write a model; its weights are rounded as they are kept, in the model too: it then is as it will be read.

        Args:
            model: on the CPU.
            directory: made if it is missing.
            training: how it came about, for the record.
        """
        kept = round_weights(model, self.eight_bits)
        replace_file(directory / WEIGHTS_FILE, save({name: tensor.contiguous() for name, tensor in kept.items()}))
        record = {
            "method": model.method,
            self.kind: model.config.model_dump(),
            "fingerprint": model.fingerprint,
            "training": training,
        }
        replace_file(directory / CONFIG_FILE, (json.dumps(record, indent=2) + "\n").encode())

    def load(self, directory: Path | None = None) -> M:
        """Read a model, ready to answer.

        Args:
            directory: with model.safetensors and config.json; None for the weights that ship with the package.

        Raises:
            WeightsError: a file is missing or broken, or the weights do not fit the configuration.
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
            model.load_state_dict(_read(weights))
        except (RuntimeError, KeyError) as error:
            problem = f"are not of the model its {CONFIG_FILE} names"
            raise WeightsError(f"the weights in {directory} {problem}; {self.advice}") from error
        model.eval()
        return model


def round_weights(model: Model, eight_bits: bool = False) -> dict[str, Tensor]:
    """Round the weights of a model as they are kept (see `Checkpoints`); what is stored of it."""
    kept = _in_eight_bits(model.state_dict()) if eight_bits else _in_half(model.state_dict())
    model.load_state_dict(_read(kept))
    model.eval()  # forgets what it computed with the weights unrounded
    return kept


def _in_half(state: Mapping[str, Tensor]) -> dict[str, Tensor]:
    return {name: tensor.half() if _is_large(tensor) else tensor for name, tensor in state.items()}


def _in_eight_bits(state: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Whole steps of each row's own size (absmax quantisation, LLM.int8(), NeurIPS 2022), and that size."""
    kept: dict[str, Tensor] = {}
    for name, tensor in state.items():
        if _is_large(tensor) and tensor.dim() > 1:
            scale = (tensor.abs().flatten(1).amax(dim=1) / STEPS).clamp(min=SMALLEST).half()
            steps = tensor / _along_rows(scale, tensor)
            kept |= {name: steps.round().clamp(-STEPS, STEPS).to(torch.int8), name + SCALE: scale}
        else:
            kept[name] = tensor.half() if tensor.dtype is torch.float32 else tensor
    return kept


def _read(kept: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """The weights as a model takes them."""
    state = {name: tensor.float() if tensor.dtype is torch.float16 else tensor for name, tensor in kept.items()}
    for name, tensor in kept.items():
        if tensor.dtype is torch.int8:
            state[name] = tensor * _along_rows(state.pop(name + SCALE), tensor)
    return state


def _along_rows(scale: Tensor, tensor: Tensor) -> Tensor:
    """[R] in float32, so that it multiplies the rows of a tensor [R, ...]."""
    return scale.float().view(-1, *[1] * (tensor.dim() - 1))


def _is_large(tensor: Tensor) -> bool:
    return tensor.dtype is torch.float32 and tensor.numel() > LARGE
