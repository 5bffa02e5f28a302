"""Sharing work over forked processes, which see the parent's arrays without a copy."""

import multiprocessing
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")

FEW = 4  # tasks that are done at once in this process

_work: Callable[[Any], Any] | None = None  # what forked workers inherit, set before they start
_alone = False


@contextmanager
def one_process() -> Iterator[None]:
    """Have all work done in this process: it has threads, of which a fork knows nothing, or its neighbours the CPUs."""
    global _alone  # noqa: PLW0603  # deep below who knows of it
    before, _alone = _alone, True
    try:
        yield
    finally:
        _alone = before


def map_forked(work: Callable[[Task], Result], tasks: Sequence[Task]) -> Iterator[Result]:
    """The results of some tasks, in order; tasks and results travel between processes, the work does not.

    Args:
        work: a function, or a partial one that holds the arrays it reads.
        tasks: what it is called with; few of them are done without other processes.
    """
    global _work  # noqa: PLW0603  # forked workers inherit it; an argument would be copied a task
    if _alone or len(tasks) < FEW:
        yield from map(work, tasks)
        return
    _work = work
    try:
        context = multiprocessing.get_context("fork")
        with ProcessPoolExecutor(mp_context=context, initializer=_watch_parent) as pool:
            yield from pool.map(_call, tasks)
    finally:
        _work = None


def _watch_parent() -> None:
    """Have a worker end when its parent is killed: it has both ends of the pipe at which it waits for tasks."""
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


def _call(task: Any) -> Any:
    assert _work is not None
    return _work(task)
