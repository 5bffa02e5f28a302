"""The rows of a table, answered by all workers and written in order to a file that can be continued."""

import csv
import fcntl
import hashlib
import os
import re
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from itertools import islice
from pathlib import Path
from queue import SimpleQueue
from typing import BinaryIO, Final

from pydantic import ValidationError

from app.http.formats.csv_table import BOM, ROW_END, CsvTable
from app.http.formats.darwin_core import COLUMNS, ERROR, georeference, to_request, without_position
from app.http.protocol import LocalizerLike
from app.http.schemas.responses import LocalizeResponse
from app.workers.messages import WorkerFault
from models.errors import DataError, DescriptionError
from models.files import sha256, sync

ROWS_AHEAD: Final = 16  # per worker, so that a slow row does not leave the others idle


@contextmanager
def unfinished(out: Path, table_path: Path, work: Sequence[object]) -> Iterator[BinaryIO]:
    """Open the unfinished output of the same work; it becomes `out` when the block ends, and stays on an error."""
    parts = sha256(table_path), version("hereabouts"), *work
    path = out.with_name(f"{out.name}.{hashlib.sha256(repr(parts).encode()).hexdigest()[:12]}.partial")
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        for other in out.parent.iterdir():
            if re.fullmatch(rf"{re.escape(out.name)}\.[0-9a-f]{{12}}\.partial", other.name) and other != path:
                raise DataError(
                    f"{other} is the unfinished output of another table, other options or another index; delete it to "
                    "start again, or give another --out"
                )
        with path.open("a+b") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise DataError(f"{out} is being written by another process; wait for it") from None
            yield file
            file.flush()
            os.fsync(file.fileno())
            path.replace(out)
            sync(out.parent)
    except OSError as error:
        raise DataError(f"{out} cannot be written: {error}; correct that, and run this again to continue") from error


def write_rows(
    table: CsvTable, localizers: Sequence[LocalizerLike], file: BinaryIO, show: Callable[[int], None]
) -> Counter[str]:
    """Append the rows that the file lacks, in order; return how many rows have each status."""
    statuses = _resume(file, table)
    if not statuses:
        file.write(table.encoded_header())
        statuses[COLUMNS[-1]] += 1
    first = statuses.total() - 1
    rows = islice(table.rows(), first, None)
    for done, row in enumerate(_in_order(partial(_answered_row, table), rows, localizers), first + 1):
        file.write(table.encode(row))
        file.flush()
        statuses[row[-1]] += 1
        show(done)
    del statuses[COLUMNS[-1]]
    return statuses


def _resume(file: BinaryIO, table: CsvTable) -> Counter[str]:
    """Cut the file after its last complete row; return how many rows have each last cell, the header included."""
    statuses, end_bytes, read_bytes, line = Counter[str](), 0, 0, b""

    def lines() -> Iterator[str]:
        nonlocal read_bytes, line
        for line in file:
            read_bytes += len(line)
            yield line.decode("utf-8", "surrogateescape").removeprefix(BOM)

    file.seek(0)
    with suppress(csv.Error):  # the end of the file is inside a cell
        for row in csv.reader(lines(), delimiter=table.delimiter, strict=True):
            if line.endswith(ROW_END):
                end_bytes = read_bytes
                statuses[row[-1]] += 1
    file.seek(end_bytes)
    file.truncate()
    return statuses


def _answered_row(table: CsvTable, row: list[str], localizer: LocalizerLike) -> list[str]:
    """Return a row with the added cells."""
    try:
        query = replace(to_request(row[table.text_column]).to_query(), language=table.language_of(row))
        [answer] = localizer.localize([query])
        response = LocalizeResponse.build(answer, localizer, "", {})
    except DescriptionError as error:
        return [*row, *without_position(ERROR, [str(error)])]
    except (WorkerFault, ValidationError):
        return [*row, *without_position(ERROR, ["internal error; please report it with this text"])]
    return [*row, *georeference(response, localizer.frame)]


def _in_order(
    work: Callable[[list[str], LocalizerLike], list[str]],
    rows: Iterable[list[str]],
    localizers: Sequence[LocalizerLike],
) -> Iterator[list[str]]:
    """Yield work(row, localizer) for each row, in order; a bounded number of rows is in memory."""
    idle = SimpleQueue[LocalizerLike]()
    for localizer in localizers:
        idle.put(localizer)

    def run(row: list[str]) -> list[str]:
        localizer = idle.get()
        try:
            return work(row, localizer)
        finally:
            idle.put(localizer)

    pool = ThreadPoolExecutor(len(localizers))
    waiting = deque[Future[list[str]]]()
    try:
        for row in rows:
            waiting.append(pool.submit(run, row))
            if len(waiting) == ROWS_AHEAD * len(localizers):
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        pool.shutdown(cancel_futures=True)
