"""Two threads for one text: machine code and NumPy let go of the interpreter while they work."""

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Final, TypeVar

THREADS: Final = 2
T = TypeVar("T")
R = TypeVar("R")


def shared_out(function: Callable[[T], R], tasks: Iterable[T], is_much: bool) -> Iterator[R]:
    """What a function makes of each task, in order; if it is much, by threads that take one after another."""
    if not is_much:
        yield from map(function, tasks)
        return
    with ThreadPoolExecutor(THREADS) as threads:
        yield from threads.map(function, tasks)
