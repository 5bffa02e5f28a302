"""Saving and loading retrievers: weights as safetensors, the configuration as JSON beside them."""

import json
from pathlib import Path
from typing import Any

import pydantic
import safetensors
from safetensors.torch import load_file, save_file

from models.errors import WeightsError
from models.language.text_encoder import load_text_encoder
from models.retrieval.mncl import Mncl
from models.retrieval.ret import Ret
from models.retrieval.retriever import Retriever
from models.retrieval.text2loc import Text2Loc
from models.retrieval.text2pos import Text2Pos

METHODS: dict[str, type[Retriever]] = {"text2pos": Text2Pos, "ret": Ret, "text2loc": Text2Loc, "mncl": Mncl}
DEFAULT_WEIGHTS = Path(__file__).parent.parent / "weights" / "retriever"
WEIGHTS_FILE = "model.safetensors"
CONFIG_FILE = "config.json"


def save_retriever(retriever: Retriever, directory: Path, training: dict[str, Any]) -> None:
    """Write a retriever.

    Args:
        retriever: the model; the frozen text encoder is named, not saved.
        directory: made if it is missing.
        training: how it came about, for the record.
    """
    directory.mkdir(parents=True, exist_ok=True)
    save_file({name: tensor.contiguous() for name, tensor in retriever.state_dict().items()}, directory / WEIGHTS_FILE)
    config = retriever.config.model_dump()
    record = {
        "method": retriever.method,
        "retriever": config,
        "fingerprint": retriever.fingerprint,
        "training": training,
    }
    (directory / CONFIG_FILE).write_text(json.dumps(record, indent=2) + "\n")


def load_retriever(directory: Path | None = None) -> Retriever:
    """Read a retriever, ready to encode.

    Args:
        directory: with model.safetensors and config.json; None for the weights that ship with the package.

    Raises:
        WeightsError: a file is missing or broken, or the weights do not fit the configuration.
    """
    directory = directory or DEFAULT_WEIGHTS
    advice = "train some with 'hereabouts train', or take a fresh copy"
    for name in (CONFIG_FILE, WEIGHTS_FILE):
        if not (directory / name).is_file():
            raise WeightsError(f"no weights in {directory} ({name} is missing); {advice}")
    try:
        record = json.loads((directory / CONFIG_FILE).read_text())
        method = METHODS[record["method"]]
        config = method.config_type.model_validate(record["retriever"])
        weights = load_file(directory / WEIGHTS_FILE)
    except (safetensors.SafetensorError, ValueError, KeyError, pydantic.ValidationError) as error:
        raise WeightsError(f"the weights in {directory} cannot be read ({type(error).__name__}); {advice}") from error
    retriever = method(load_text_encoder(config.text_encoder), config)
    try:
        retriever.load_state_dict(weights, strict=True)
    except RuntimeError as error:
        raise WeightsError(
            f"the weights in {directory} are not of the model its {CONFIG_FILE} names; {advice}"
        ) from error
    return retriever.eval()
