"""Arithmetic as machine code."""

from typing import Any, Final

import numba
import numpy as np
import numpy.typing as npt

HALVES: Final = np.arange(1 << 16, dtype=np.uint16).view(np.float16).astype(np.float32)  # it knows no half precision


def compiled(function: Any) -> Any:
    """A function as machine code, kept for the next process where it may be written; x / 0 is as NumPy has it."""
    try:
        return numba.njit(cache=True, error_model="numpy", nogil=True)(function)
    except RuntimeError:  # a read-only installation, and no home
        return numba.njit(error_model="numpy", nogil=True)(function)


@compiled
def longer(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """An array with room for as many rows again."""
    return np.concatenate((array, np.empty_like(array)))
