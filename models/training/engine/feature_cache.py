"""Features of the frozen text encoder, computed once for a list of sentences and kept on disk."""

import hashlib
import json
import logging
from collections.abc import Sequence
from pathlib import Path

import torch
from filelock import FileLock
from safetensors import SafetensorError
from safetensors.torch import load_file, save
from torch import Tensor

from models.files import cache_directory, replace_file
from models.language.text_encoder import TextEncoder, TokenFeatures

ENCODE_BATCH = 256  # sentences
_FORMAT = 1  # of the files; counted up when what is in them changes
_log = logging.getLogger(__name__)


def frozen_features(encoder: TextEncoder, sentences: Sequence[str]) -> TokenFeatures:
    """Token features of sentences, padded to the longest, from disk where they were computed before.

    Of processes that want the same at the same time, one computes and the others wait. A cache that cannot be read or
    written is done without.

    Args:
        encoder: the frozen text encoder, on any device; its fingerprint is part of the file's name.
        sentences: S of them; so are they, in their order.

    Returns:
        [S, T, W] float16 values, [S, T] mask, [S, T] ids, on the CPU.
    """
    key = json.dumps([_FORMAT, encoder.fingerprint, list(sentences)])
    path = cache_directory() / "tokens" / f"{hashlib.sha256(key.encode()).hexdigest()}.safetensors"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with FileLock(path.with_suffix(".lock")):
            return _read(path) or _write(path, _compute(encoder, sentences))
    except OSError as error:
        _log.warning("no cache in %s (%s)", path.parent, error)
        return _compute(encoder, sentences)


def _read(path: Path) -> TokenFeatures | None:
    if not path.is_file():
        return None
    try:
        return TokenFeatures(**load_file(path))
    except (SafetensorError, TypeError) as error:
        _log.warning("%s is broken and computed again (%s)", path, error)
        return None


def _write(path: Path, features: TokenFeatures) -> TokenFeatures:
    replace_file(path, save({"values": features.values, "mask": features.mask, "ids": features.ids}))
    return features


def _compute(encoder: TextEncoder, sentences: Sequence[str]) -> TokenFeatures:
    batches = (encoder(sentences[i : i + ENCODE_BATCH]) for i in range(0, len(sentences), ENCODE_BATCH))
    parts = [(batch.values.half().cpu(), batch.mask.cpu(), batch.ids.cpu()) for batch in batches]
    longest = max(mask.shape[1] for _, mask, _ in parts)
    return TokenFeatures(*(torch.cat([_pad(x, longest) for x in column]) for column in zip(*parts, strict=True)))


def _pad(x: Tensor, length: int) -> Tensor:
    missing = length - x.shape[1]
    return torch.nn.functional.pad(x, (0, 0, 0, missing) if x.ndim == 3 else (0, missing))
