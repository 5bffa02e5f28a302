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
LARGE = 4096  # values; a tensor of more is kept in half precision


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
    """

    kind: str
    methods: Mapping[str, type[M]]
    default: Path
    advice: str

    def save(self, model: M, directory: Path, training: dict[str, Any]) -> None:
        """Write a model; large tensors are rounded to half precision, in the model too: it then is as it will be read.

        Args:
            model: on the CPU.
            directory: made if it is missing.
            training: how it came about, for the record.
        """
        kept = round_large(model)
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
            model.load_state_dict({n: t.float() if t.dtype is torch.float16 else t for n, t in weights.items()})
        except RuntimeError as error:
            problem = f"are not of the model its {CONFIG_FILE} names"
            raise WeightsError(f"the weights in {directory} {problem}; {self.advice}") from error
        model.eval()
        return model


def round_large(model: Model) -> dict[str, Tensor]:
    """Round large tensors to half precision in a model, so that it is as it will be read; what is stored of it."""
    state = model.state_dict()
    kept = {name: tensor.half() if _is_large(tensor) else tensor for name, tensor in state.items()}
    model.load_state_dict({name: tensor.to(state[name].dtype) for name, tensor in kept.items()})
    model.eval()  # forgets what it computed with the weights unrounded
    return kept


def _is_large(tensor: Tensor) -> bool:
    return tensor.dtype is torch.float32 and tensor.numel() > LARGE
