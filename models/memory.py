"""Release memory between the steps of a long job, and before processes are forked.

Each function says what it saves. Figures of indexing are peaks of the proportional set size of all processes, for
`hereabouts index` on midtown Manhattan (55,800 cells, 780 MB with all of them, 990 MB without any).
"""

import ctypes
import gc
import mmap
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, Literal
from weakref import WeakSet

import numpy as np
import numpy.typing as npt

_mappings: WeakSet[mmap.mmap] = WeakSet()


def map_file(
    file: Path | IO[bytes],
    dtype: npt.DTypeLike = np.uint8,
    shape: tuple[int, ...] | None = None,
    mode: Literal["c", "r+"] = "c",
) -> npt.NDArray[Any]:
    """Map a file as an array; its pages are read on access, and `drop_pages` releases them.

    Mode "c" keeps changes out of the file, and `drop_pages` discards them; "r+" writes them to the file.
    """
    mapped = np.memmap(file, dtype, mode, shape=shape)
    _mappings.add(mapped._mmap)  # type: ignore[attr-defined]
    return mapped.view(np.ndarray)


def drop_pages() -> None:
    """Release the pages of all mapped files; they are read again on access.

    Saves 60 MB while midtown Manhattan is indexed, whose columns then stay in files (`models.spool`), and 88 MB of a
    served index: the float weights of the text encoder, once they are quantized.
    """
    for mapping in list(_mappings):
        mapping.madvise(mmap.MADV_DONTNEED)


def trim_heap() -> None:
    """Return free memory to the system: 65 MB while midtown Manhattan is indexed.

    glibc keeps free memory that lies between blocks in use.
    """
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
    if trim is not None:  # only glibc has it
        trim(0)


def release_memory() -> None:
    """Trim the heap and drop pages; for the end of a step of a job."""
    trim_heap()
    drop_pages()


def drop_code_pages() -> None:
    """Release the pages of program code; they are read again on execution.

    Saves 175 MB of a served index: most of the code of torch and LLVM runs once, while an index is opened.
    """
    if sys.platform != "linux":
        return
    madvise = ctypes.CDLL(None).madvise
    for line in Path("/proc/self/maps").read_text().splitlines():
        region, rights, *_, name = line.split(maxsplit=5)
        if rights == "r-xp" and name.startswith("/"):  # mapped from a file and never written
            start, end = (int(address, 16) for address in region.split("-"))
            madvise(ctypes.c_void_p(start), ctypes.c_size_t(end - start), mmap.MADV_DONTNEED)


@contextmanager
def frozen_objects() -> Iterator[None]:
    """Keep existing objects out of garbage collection while the block runs.

    Saves 75 MB and a sixth of the CPU time while midtown Manhattan is indexed: else each forked process writes to
    every page that holds an object, and gets a copy of it.
    """
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()
