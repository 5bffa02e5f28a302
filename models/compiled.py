"""Arithmetic as machine code."""

import hashlib
import os
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

import numba
import numpy as np
import numpy.typing as npt

_NUMBA: Final[Any] = numba.config
_CHOSEN: Final = _NUMBA.CACHE_DIR  # by NUMBA_CACHE_DIR

HALVES: Final = np.arange(1 << 16, dtype=np.uint16).view(np.float16).astype(np.float32)  # it knows no half precision


def compiled(function: Any) -> Any:
    """A function as machine code, kept for the next process where it may be written; x / 0 is as NumPy has it."""
    function.stamp = _stamp(function)
    _NUMBA.CACHE_DIR = str(_room(function) / function.stamp)
    try:
        return numba.njit(cache=True, error_model="numpy", nogil=True)(function)
    except RuntimeError:  # a read-only installation, and no home
        return numba.njit(error_model="numpy", nogil=True)(function)
    finally:
        _NUMBA.CACHE_DIR = _CHOSEN


def _stamp(function: Any) -> str:
    """What of the sources its machine code depends on; numba itself looks at its own file alone."""
    known = hashlib.sha256(_source(function.__code__.co_filename))
    for name in function.__code__.co_names:
        used = function.__globals__.get(name)
        if hasattr(used, "py_func"):
            known.update(used.py_func.stamp.encode())
        elif isinstance(used, np.ndarray):
            known.update(used.tobytes())
        elif isinstance(used, int | float | tuple | np.generic):
            known.update(repr(used).encode())
    return known.hexdigest()[:16]


@lru_cache
def _source(path: str) -> bytes:
    return Path(path).read_bytes()


def _room(function: Any) -> Path:
    """Where its machine code may be kept."""
    beside = Path(function.__code__.co_filename).parent
    if _CHOSEN or os.access(beside, os.W_OK):
        return Path(_CHOSEN or beside / "__pycache__")
    return Path("~/.cache/hereabouts").expanduser()


@compiled
def longer(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """An array with room for as many rows again."""
    return np.concatenate((array, np.empty_like(array)))
