"""Columns that are built from blocks of rows and lie in temporary files if they are large.

While a city is indexed, its columns would take more memory than everything else.
"""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory, TemporaryFile, gettempdir
from typing import IO, Any, Final

import numpy as np
import numpy.typing as npt

from models.errors import DataError
from models.files import scratch_directory
from models.memory import drop_pages, map_file

Column = npt.NDArray[Any]
MAX_BYTES_IN_MEMORY: Final = 2**20  # a larger column goes to a file
ROWS_PER_BLOCK: Final = 2**20
_directory: Path | None = None  # of the temporary files; None for TMPDIR


@contextmanager
def spooling_in(directory: Path) -> Iterator[None]:
    """Put temporary files into a directory while the block runs, because TMPDIR may be in memory."""
    global _directory  # noqa: PLW0603 - read deep inside the job
    before, _directory = _directory, directory
    try:
        yield
    finally:
        _directory = before


@contextmanager
def spool_directory() -> Iterator[Path]:
    """Yield an empty directory among the temporary files; raise DataError if it cannot be created."""
    with ExitStack() as stack:
        with disk_errors():
            if _directory is None:
                directory = Path(stack.enter_context(TemporaryDirectory()))
            else:
                directory = stack.enter_context(scratch_directory(_directory))
        yield directory


@contextmanager
def disk_errors() -> Iterator[None]:
    """Raise a DataError if a temporary file cannot be written."""
    try:
        yield
    except OSError as error:
        advice = "give another directory" if _directory else "have TMPDIR name another directory"
        raise DataError(f"{_directory or gettempdir()} cannot be written: {error}; make room, or {advice}") from error


class Spool:
    """Columns that grow; large ones are unnamed temporary files, which disappear with the arrays.

    Their pages are read on access; `models.memory.drop_pages` releases them.
    """

    def __init__(self) -> None:
        self._columns = dict[str, _GrowingColumn]()

    def add(self, rows: Mapping[str, Column]) -> None:
        """Append rows to each column, of one type and shape per column; raise DataError if the disk is full."""
        for name, values in rows.items():
            self._columns.setdefault(name, _GrowingColumn()).append(values)

    def columns(self) -> dict[str, Column]:
        """Return all rows; nothing can be added afterwards."""
        return {name: column.array() for name, column in self._columns.items()}


class _GrowingColumn:
    """A column that moves to a file once it is large."""

    def __init__(self) -> None:
        self._blocks, self._bytes, self._rows = list[Column](), 0, 0
        self._file: IO[bytes] | None = None

    def append(self, rows: Column) -> None:
        self._blocks.append(rows)
        self._bytes += rows.nbytes
        self._rows += len(rows)
        if self._file is not None or self._bytes > MAX_BYTES_IN_MEMORY:
            with disk_errors():
                self._file = self._file or TemporaryFile(dir=_directory)  # noqa: SIM115 - `array` closes it
                for block in self._blocks:
                    self._file.write(np.ascontiguousarray(block).data)
            self._blocks = [rows[:0].copy()]  # keeps the type

    def array(self) -> Column:
        if self._file is None:
            return self._blocks[0] if len(self._blocks) == 1 else np.concatenate(self._blocks)
        empty = self._blocks[0]
        with disk_errors(), self._file as file:
            file.flush()
            return map_file(file, empty.dtype, (self._rows, *empty.shape[1:]))


def spooled(tables: Iterable[Mapping[str, Column]]) -> dict[str, Column]:
    """Return the concatenated columns of one or more tables, through a `Spool`."""
    spool = Spool()
    for table in tables:
        spool.add(table)
    return spool.columns()


def spooled_zeros(rows: int, dtype: npt.DTypeLike) -> Column:
    """Return zeros to overwrite in any order, in a temporary file if many; raise DataError if the disk is full."""
    size = rows * np.dtype(dtype).itemsize
    if size <= MAX_BYTES_IN_MEMORY:
        return np.zeros(rows, dtype)
    with disk_errors(), TemporaryFile(dir=_directory) as file:
        # A sparse file would kill the process that later writes into the array of a full disk.
        for first in range(0, size, MAX_BYTES_IN_MEMORY):
            file.write(bytes(min(MAX_BYTES_IN_MEMORY, size - first)))
        file.flush()
        return map_file(file, dtype, (rows,), "r+")


def starts_of(sizes: Column) -> Column:
    """Return the start of each of n consecutive runs, and the end of the last, [n + 1] int32.

    Raises:
        DataError: the disk is full, or there are too many rows for int32.
    """
    starts, end = spooled_zeros(len(sizes) + 1, np.int32), 0
    for first in range(0, len(sizes), ROWS_PER_BLOCK):
        ends = np.cumsum(sizes[first : first + ROWS_PER_BLOCK], dtype=np.int64) + end
        starts[first + 1 : first + 1 + len(ends)], end = ends, int(ends[-1])
    if end > np.iinfo(np.int32).max:
        raise DataError(
            f"the map is too large for one index: it has {end} rows of a kind; take a part of it (--within)"
        )
    return starts


def row_blocks(columns: Mapping[str, Column]) -> Iterator[dict[str, Column]]:
    """Yield blocks of rows of columns of one length, and drop the pages of each block afterwards."""
    for first in range(0, max(map(len, columns.values())), ROWS_PER_BLOCK):
        yield {name: column[first : first + ROWS_PER_BLOCK] for name, column in columns.items()}
        drop_pages()
