"""A second thread for one text: machine code and NumPy let go of the interpreter while they work."""

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Final, TypeVar

THREADS: Final = 2
T = TypeVar("T")
R = TypeVar("R")


@cache
def _second() -> ThreadPoolExecutor:
    """The second thread of this process: to start one for every text takes longer than some of what it does."""
    return ThreadPoolExecutor(1, "beside")


os.register_at_fork(after_in_child=_second.cache_clear)  # a forked process has none


def end_second_thread() -> None:
    """End it until there is work for it: who forks next should have one thread."""
    if _second.cache_info().currsize:
        _second().shutdown()
        _second.cache_clear()


def beside(work: Callable[[], R]) -> Callable[[], R]:
    """Do something on the second thread, when it is free; what is given waits for it."""
    return _second().submit(work).result


def shared_out(function: Callable[[T], R], tasks: Iterable[T], is_much: bool) -> list[R]:
    """What a function makes of each task, in order; if it is much, the second thread takes tasks as well, when free."""
    if not is_much:
        return [function(task) for task in tasks]
    numbered = enumerate(list(tasks))
    found: dict[int, R] = {}

    def work() -> None:
        for number, task in numbered:  # whoever is next takes the next
            found[number] = function(task)

    helped = _second().submit(work)
    try:
        work()
    finally:
        if not helped.cancel():
            helped.result()
    return [found[number] for number in range(len(found))]
