"""Columns that are made some rows at a time and lie on disk: of a city they are larger than all else of a job."""

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
HELD: Final = 2**20  # bytes of a column, up to which it stays in memory
AT_ONCE: Final = 2**20  # rows
_room: Path | None = None


@contextmanager
def spooling_in(directory: Path) -> Iterator[None]:
    """Have what is spooled lie in a directory while the block runs: where temporary files lie may be in memory."""
    global _room  # noqa: PLW0603  # deep below who knows of it
    before, _room = _room, directory
    try:
        yield
    finally:
        _room = before


@contextmanager
def scratch() -> Iterator[Path]:
    """An empty directory where what is spooled lies, which is removed when the block ends.

    Raises:
        DataError: there is no room.
    """
    with ExitStack() as made:
        with spooling():
            if _room is None:
                directory = Path(made.enter_context(TemporaryDirectory()))
            else:
                directory = made.enter_context(scratch_directory(_room))
        yield directory


def spooled(parts: Iterable[Mapping[str, Column]]) -> dict[str, Column]:
    """The columns of some tables, at least one, one after the other; see Spool."""
    spool = Spool()
    for part in parts:
        spool.add(part)
    return spool.columns()


def on_disk(rows: int, dtype: npt.DTypeLike) -> Column:
    """Numbers to be written in any order, in a file without a name if they are many; at first zeros.

    Raises:
        DataError: there is no room.
    """
    size = rows * np.dtype(dtype).itemsize
    if size <= HELD:
        return np.zeros(rows, dtype)
    with spooling(), TemporaryFile(dir=_room) as file:
        # Written, not left out: where there is no room, who writes into the array later would be killed.
        for first in range(0, size, HELD):
            file.write(bytes(min(HELD, size - first)))
        file.flush()
        return map_file(file, dtype, (rows,), "r+")


def starts_of(sizes: Column) -> Column:
    """[n + 1] int32 where each of n runs of some sizes begins, and the end; on disk if they are many.

    Raises:
        DataError: there is no room, or the end is no int32.
    """
    found, end = on_disk(len(sizes) + 1, np.int32), 0
    for first in range(0, len(sizes), AT_ONCE):
        some = np.cumsum(sizes[first : first + AT_ONCE], dtype=np.int64) + end
        found[first + 1 : first + 1 + len(some)], end = some, int(some[-1])
    if end > np.iinfo(np.int32).max:
        raise DataError(
            f"the map is too large for one index: it has {end} rows of a kind; take a part of it (--within)"
        )
    return found


def in_turn(columns: Mapping[str, Column]) -> Iterator[dict[str, Column]]:
    """Columns of one length, some rows after the other; what was looked at takes no memory any more."""
    for first in range(0, max(map(len, columns.values())), AT_ONCE):
        yield {name: column[first : first + AT_ONCE] for name, column in columns.items()}
        drop_pages()


@contextmanager
def spooling() -> Iterator[None]:
    """Say so where a temporary file cannot be written."""
    try:
        yield
    except OSError as error:
        advice = "give another directory" if _room else "have TMPDIR name another directory"
        raise DataError(f"{_room or gettempdir()} cannot be written: {error}; make room, or {advice}") from error


class Spool:
    """Columns that grow, large ones in files without names, which go with their readers.

    The files lie where `spooling_in` says, else in the directory of temporary files (TMPDIR). Their pages are read on
    access; `models.memory.drop_pages` releases them.
    """

    def __init__(self) -> None:
        self._columns = dict[str, _Growing]()

    def add(self, part: Mapping[str, Column]) -> None:
        """Put some rows at the end of columns; of each all have the same type, and rows of the same shape.

        Raises:
            DataError: there is no room.
        """
        for name, rows in part.items():
            self._columns.setdefault(name, _Growing()).append(rows)

    def columns(self) -> dict[str, Column]:
        """All rows; nothing is added after that."""
        return {name: column.array() for name, column in self._columns.items()}


class _Growing:
    """A column that grows."""

    def __init__(self) -> None:
        self._held, self._bytes, self._rows = list[Column](), 0, 0
        self._file: IO[bytes] | None = None

    def append(self, rows: Column) -> None:
        """Put some at the end."""
        self._held.append(rows)
        self._bytes += rows.nbytes
        self._rows += len(rows)
        if self._file is not None or self._bytes > HELD:
            with spooling():
                self._file = self._file or TemporaryFile(dir=_room)  # noqa: SIM115 - `array` closes it
                for held in self._held:
                    self._file.write(np.ascontiguousarray(held).data)
            self._held = [rows[:0].copy()]  # it tells the type

    def array(self) -> Column:
        """All of them."""
        if self._file is None:
            return self._held[0] if len(self._held) == 1 else np.concatenate(self._held)
        like = self._held[0]
        with spooling(), self._file as file:
            file.flush()
            return map_file(file, like.dtype, (self._rows, *like.shape[1:]))
