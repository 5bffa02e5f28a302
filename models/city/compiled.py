"""Arithmetic as machine code."""

from typing import Any

import numba


def compiled(function: Any) -> Any:
    """A function as machine code, kept for the next process where it may be written."""
    try:
        return numba.njit(cache=True)(function)
    except RuntimeError:  # a read-only installation, and no home
        return numba.njit(function)
