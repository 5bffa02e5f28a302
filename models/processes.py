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
from typing import Any, Final, TypeVar

from models.errors import DataError
from models.memory import drop_pages, frozen_objects, release_memory

Task = TypeVar("Task")
Result = TypeVar("Result")

MIN_FORKED_TASKS: Final = 4  # for fewer, starting processes takes longer than the work

_work: Callable[[Any], Any] | None = None  # set before workers are forked, so that they inherit it
_in_one_process = False


@contextmanager
def one_process() -> Iterator[None]:
    """Do all work in this process while the block runs, because it has threads or other processes use the CPUs."""
    global _in_one_process  # noqa: PLW0603 - read deep inside the job
    before, _in_one_process = _in_one_process, True
    try:
        yield
    finally:
        _in_one_process = before


def map_forked(work: Callable[[Task], Result], tasks: Sequence[Task]) -> Iterator[Result]:
    """Yield the results of tasks in order, from forked processes if there are several tasks.

    Tasks and results are pickled, the work is not; it may be a partial function that holds large arrays.
    """
    global _work  # noqa: PLW0603 - an argument would be pickled for each task
    if _in_one_process or len(tasks) < MIN_FORKED_TASKS:
        yield from map(work, tasks)
        return
    _work = work
    release_memory()
    try:
        context = multiprocessing.get_context("fork")
        with frozen_objects(), ProcessPoolExecutor(mp_context=context, initializer=_prepare_process) as pool:
            yield from pool.map(_run_task, tasks)
    finally:
        _work = None


def _run_task(task: Any) -> Any:
    assert _work is not None
    result = _work(task)
    drop_pages()  # the next task reads other rows of mapped columns
    return result


@contextmanager
def forked(work: Callable[[], Result]) -> Iterator[Callable[[], Result]]:
    """Run work in a forked process while the block runs; yield a function that waits for the result.

    The work itself runs in one process.

    Raises:
        DataError: the process was killed.
    """
    if _in_one_process:
        yield work
        return
    receiver, sender = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.get_context("fork").Process(target=_run_and_send, args=(work, sender))
    process.start()
    sender.close()
    try:
        yield partial(_receive, receiver)
    finally:
        process.terminate()
        process.join()
        receiver.close()


def _run_and_send(work: Callable[[], Any], sender: Connection) -> None:
    _prepare_process()
    try:
        with one_process():
            outcome = True, work()
    except Exception as error:  # `_receive` raises it in the parent
        outcome = False, error
    sender.send(outcome)


def _receive(receiver: Connection) -> Any:
    try:
        has_succeeded, value = receiver.recv()
    except EOFError as error:
        raise DataError(
            "a process of this job was killed; give it more memory, or take a part of the map (--within)"
        ) from error
    if has_succeeded:
        return value
    raise value


def _prepare_process() -> None:
    """Use one thread, because those of the parent's libraries were not forked, and end when the parent is killed."""
    if "torch" in sys.modules:
        sys.modules["torch"].set_num_threads(1)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)
