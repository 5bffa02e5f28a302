"""Sharing work over forked processes, which see the parent's arrays without a copy."""

import multiprocessing
import os
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial
from multiprocessing.connection import Connection
from typing import Any, TypeVar

from models.errors import DataError
from models.memory import drop_pages, frozen_objects, release_memory

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
    release_memory()
    try:
        context = multiprocessing.get_context("fork")
        with frozen_objects(), ProcessPoolExecutor(mp_context=context, initializer=_begin) as pool:
            yield from pool.map(_call, tasks)
    finally:
        _work = None


@contextmanager
def forked(work: Callable[[], Result]) -> Iterator[Callable[[], Result]]:
    """Have work done in a process of its own while the block runs; what is given waits for its result.

    Args:
        work: what to do; it shares nothing out to further processes.

    Raises:
        DataError: the process was killed.
    """
    if _alone:
        yield work
        return
    ours, its = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.get_context("fork").Process(target=_do, args=(work, its))
    process.start()
    its.close()
    try:
        yield partial(_result_of, ours)
    finally:
        process.terminate()
        process.join()
        ours.close()


def _do(work: Callable[[], Any], result: Connection) -> None:
    """What the process of `forked` does."""
    _begin()
    try:
        with one_process():
            done = True, work()
    except Exception as error:  # whoever waits for it raises it
        done = False, error
    result.send(done)


def _result_of(result: Connection) -> Any:
    try:
        is_done, value = result.recv()
    except EOFError as error:
        raise DataError(
            "a process of this job was killed; give it more memory, or take a part of the map (--within)"
        ) from error
    if is_done:
        return value
    raise value


def _begin() -> None:
    """What a forked process does first.

    It uses one thread: the others of the parent's libraries are not in it, and it would wait for them for ever.
    """
    if "torch" in sys.modules:
        sys.modules["torch"].set_num_threads(1)
    _watch_parent()


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
    result = _work(task)
    drop_pages()  # the next task reads other rows of mapped columns
    return result
