"""A disk cache of the frozen text encoder's features for lists of sentences."""

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

SENTENCES_PER_BATCH = 256
_CACHE_FORMAT = 1  # increase when the content of the files changes
_log = logging.getLogger(__name__)


def frozen_features(encoder: TextEncoder, sentences: Sequence[str]) -> TokenFeatures:
    """Return token features of sentences, padded to the longest, from the cache if possible.

    If several processes need the same features, one computes them and the others wait. If the cache cannot be read or
    written, the features are computed.

    The key is the encoder's fingerprint and the S sentences in order. Returns values [S, T, W] float16, mask [S, T] and
    ids [S, T], on the CPU.
    """
    key = json.dumps([_CACHE_FORMAT, encoder.fingerprint, list(sentences)])
    path = cache_directory() / "tokens" / f"{hashlib.sha256(key.encode()).hexdigest()}.safetensors"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with FileLock(path.with_suffix(".lock")):
            return _read(path) or _write(path, _compute(encoder, sentences))
    except OSError as error:
        _log.warning("cannot use the cache in %s (%s)", path.parent, error)
        return _compute(encoder, sentences)


def _read(path: Path) -> TokenFeatures | None:
    if not path.is_file():
        return None
    try:
        return TokenFeatures(**load_file(path))
    except (SafetensorError, TypeError) as error:
        _log.warning("%s is broken; computing it again (%s)", path, error)
        return None


def _write(path: Path, features: TokenFeatures) -> TokenFeatures:
    replace_file(path, save({"values": features.values, "mask": features.mask, "ids": features.ids}))
    return features


def _compute(encoder: TextEncoder, sentences: Sequence[str]) -> TokenFeatures:
    batches = (encoder(sentences[i : i + SENTENCES_PER_BATCH]) for i in range(0, len(sentences), SENTENCES_PER_BATCH))
    parts = [(batch.values.half().cpu(), batch.mask.cpu(), batch.ids.cpu()) for batch in batches]
    longest = max(mask.shape[1] for _, mask, _ in parts)
    return TokenFeatures(*(torch.cat([_pad(x, longest) for x in column]) for column in zip(*parts, strict=True)))


def _pad(x: Tensor, length: int) -> Tensor:
    missing = length - x.shape[1]
    return torch.nn.functional.pad(x, (0, 0, 0, missing) if x.ndim == 3 else (0, missing))
