"""Compilation of numeric loops to machine code by numba."""

import hashlib
import os
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

import numba
import numpy as np
import numpy.typing as npt

_CONFIG: Final[Any] = numba.config
_CACHE_DIR: Final = _CONFIG.CACHE_DIR  # from NUMBA_CACHE_DIR

# The float32 value of each float16 bit pattern, because numba does not support half precision.
FLOAT16_VALUES: Final = np.arange(1 << 16, dtype=np.uint16).view(np.float16).astype(np.float32)


def compiled(function: Any) -> Any:
    """Compile a function, cached on disk where possible; division by zero gives inf or NaN, as in NumPy."""
    function.stamp = _stamp(function)
    _CONFIG.CACHE_DIR = str(_cache_parent(function) / function.stamp)
    try:
        return numba.njit(cache=True, error_model="numpy", nogil=True)(function)
    except RuntimeError:  # neither the installation nor the home directory is writable
        return numba.njit(error_model="numpy", nogil=True)(function)
    finally:
        _CONFIG.CACHE_DIR = _CACHE_DIR


def _stamp(function: Any) -> str:
    """Return a hash of the function's file and of the globals that it uses; numba checks the file only."""
    digest = hashlib.sha256(_source(function.__code__.co_filename))
    for name in function.__code__.co_names:
        value = function.__globals__.get(name)
        if hasattr(value, "py_func"):
            digest.update(value.py_func.stamp.encode())
        elif isinstance(value, np.ndarray):
            digest.update(value.tobytes())
        elif isinstance(value, int | float | tuple | np.generic):
            digest.update(repr(value).encode())
    return digest.hexdigest()[:16]


@lru_cache
def _source(path: str) -> bytes:
    return Path(path).read_bytes()


def _cache_parent(function: Any) -> Path:
    folder = Path(function.__code__.co_filename).parent
    if _CACHE_DIR or os.access(folder, os.W_OK):
        return Path(_CACHE_DIR or folder / "__pycache__")
    return Path("~/.cache/hereabouts").expanduser()


@compiled
def longer(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return an array with room for twice as many rows."""
    return np.concatenate((array, np.empty_like(array)))
