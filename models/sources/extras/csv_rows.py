"""Read a table of points."""

import csv
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import shapely

from models.errors import DataError
from models.sources.extras.records import ExtraRecord

LATITUDES: Final = ("lat", "latitude", "y")
LONGITUDES: Final = ("lon", "lng", "long", "longitude", "x")
DELIMITERS: Final = ",;\t|"


def read_rows(path: Path, text: str) -> Iterator[ExtraRecord]:
    """Yield the rows of a table, numbered as a spreadsheet shows them: the header is row 1.

    Raise DataError that names a wrong row, or the columns if there are no coordinates.
    """
    header = text.partition("\n")[0]
    delimiter = max(DELIMITERS, key=header.count)
    rows = csv.reader(text.splitlines(keepends=True), delimiter=delimiter)
    columns = [column.strip().lower() for column in next(rows, ())]
    latitude, longitude = (_column(path, columns, names) for names in (LATITUDES, LONGITUDES))
    for number, row in enumerate(rows, 2):
        if not any(map(str.strip, row)):
            continue
        cells = dict(zip(columns, map(str.strip, row), strict=False))
        values = [cells.get(columns[latitude], ""), cells.get(columns[longitude], "")]
        if delimiter != ",":
            values = [value.replace(",", ".") for value in values]
        point = None if not all(values) else shapely.Point(_degrees(path, number, values)[::-1])
        yield ExtraRecord(str(number), f"row {number}", point, cells)


def _column(path: Path, columns: Sequence[str], names: Sequence[str]) -> int:
    row = next((columns.index(name) for name in names if name in columns), None)
    if row is None:
        listed = ", ".join(columns)[:200]
        raise DataError(
            f"{path}, row 1: no column is called {', '.join(names[:-1])} or {names[-1]}, only {listed}; rename one"
        )
    return row


def _degrees(path: Path, number: int, values: Sequence[str]) -> list[float]:
    try:
        return [float(value) for value in values]
    except ValueError:
        raise DataError(
            f"{path}, row {number}: latitude '{values[0][:40]}' and longitude '{values[1][:40]}' are not both numbers; "
            "write degrees such as 60.1699, or leave both empty"
        ) from None
