"""Sharing work over forked processes, which see the parent's arrays without a copy."""

import ctypes
import gc
import mmap
import multiprocessing
import os
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Final, TypeVar

from models.errors import DataError

Task = TypeVar("Task")
Result = TypeVar("Result")

FEW = 4  # tasks that are done at once in this process
_ARENA_MAX: Final = -8  # M_ARENA_MAX of malloc.h

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
    give_back()  # or every worker has it too
    was_frozen = gc.get_freeze_count() > 0
    gc.freeze()  # or every worker that looks for garbage gets a copy of each page that holds an object
    try:
        context = multiprocessing.get_context("fork")
        with ProcessPoolExecutor(mp_context=context, initializer=_begin) as pool:
            yield from pool.map(_call, tasks)
    finally:
        _work = None
        if not was_frozen:
            gc.unfreeze()
        give_back()


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


def give_back() -> None:
    """Give memory that is free back to the system.

    glibc keeps what lies free between what is not: of the arrays of unusual texts, a hundred megabytes in the end.
    """
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
    if trim is not None:  # glibc has it
        trim(0)


def share_one_heap() -> None:
    """Have all threads of this process take memory from one heap.

    glibc gives each its own, and what one has let go of is of no use to another.
    """
    set_option = getattr(ctypes.CDLL(None), "mallopt", None)
    if set_option is not None:  # glibc has it
        set_option(_ARENA_MAX, 1)


def forget_code() -> None:
    """Have the system forget the pages of program code that this process has run; what runs again comes back.

    Most of what torch and LLVM run, a hundred megabytes, runs once: while they are imported and an index is opened.
    """
    if sys.platform != "linux":
        return
    madvise = ctypes.CDLL(None).madvise
    for line in Path("/proc/self/maps").read_text().splitlines():
        region, rights, *_, name = line.split(maxsplit=5)
        if rights == "r-xp" and name.startswith("/"):  # of files, and never written: nothing is lost
            start, end = (int(address, 16) for address in region.split("-"))
            madvise(ctypes.c_void_p(start), ctypes.c_size_t(end - start), mmap.MADV_DONTNEED)


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
    return _work(task)
