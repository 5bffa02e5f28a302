"""Arithmetic as machine code."""

from typing import Any

import numba
import numpy as np
import numpy.typing as npt


def compiled(function: Any) -> Any:
    """A function as machine code, kept for the next process where it may be written; x / 0 is as NumPy has it."""
    try:
        return numba.njit(cache=True, error_model="numpy")(function)
    except RuntimeError:  # a read-only installation, and no home
        return numba.njit(error_model="numpy")(function)


@compiled
def longer(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """An array with room for as many rows again."""
    return np.concatenate((array, np.empty_like(array)))
