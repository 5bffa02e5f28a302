"""Tables in CSV: read with checks, written without formulas."""

import csv
import io
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import BinaryIO, Final

from app.http.formats.darwin_core import COLUMNS
from models.errors import DataError
from models.language.languages.translation import REPLY_LANGUAGES

BOM: Final = "\ufeff"  # spreadsheets begin UTF-8 with it, and need it to read UTF-8
DELIMITERS: Final = ",;\t"
ROW_END: Final = b"\r\n"  # RFC 4180
MAX_LISTED_COLUMNS: Final = 20  # in an error message
# Spreadsheets read text that begins so as a formula (OWASP, CSV injection); the last four are full-width forms.
FORMULA_STARTS: Final = tuple("=+-@\t\r\n\uff1d\uff0b\uff0d\uff20")
BLANKS: Final = " \xa0\ufeff"  # before a formula; spreadsheets may drop them
_NUMBER: Final = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?", re.A | re.I)
_PLAIN_NAME: Final = re.compile(r"[\w ().:-]{1,64}")
_NOT_UTF8: Final = re.compile("[\udc80-\udcff]")  # how `surrogateescape` decodes other bytes


@dataclass(frozen=True, slots=True)
class CsvTable:
    """A table that was checked from its first to its last row; it is read again, row by row, with `rows`."""

    open_bytes: Callable[[], BinaryIO]
    delimiter: str
    has_bom: bool
    header: list[str]
    text_column: int
    language_column: int | None
    num_rows: int

    @classmethod
    def check(cls, open_bytes: Callable[[], BinaryIO], text: str, language: str | None = None) -> "CsvTable":
        """Find the columns called `text` and `language`, and check all rows; DataError names a wrong row.

        The header is row 1, as in a spreadsheet. The delimiter is the one with which the header has a column `text`.
        """
        headers = {delimiter: _read_header(open_bytes, delimiter) for delimiter in DELIMITERS}
        delimiter = max(DELIMITERS, key=lambda each: (text in headers[each], len(headers[each])))
        with open_bytes() as file:
            has_bom = file.read(3) == BOM.encode()
        rows = _read(open_bytes, delimiter)
        number, header = next(rows, (1, []))
        if clashes := [name for name in COLUMNS if name in map(str.strip, header)]:
            raise DataError(f"row {number}: the columns {', '.join(clashes)} would be added; rename or remove them")
        text_column = _column(number, header, text, "text")
        language_column = None if language is None else _column(number, header, language, "language")
        num_rows = 0
        for number, row in rows:
            num_rows += 1
            if len(row) != len(header):
                raise DataError(
                    f"row {number}: has {len(row)} cells, but the header has {len(header)}; correct the row, and put "
                    "cells that contain the delimiter in double quotes"
                )
        return cls(open_bytes, delimiter, has_bom, header, text_column, language_column, num_rows)

    def rows(self) -> Iterator[list[str]]:
        """Yield the rows below the header, without blank lines."""
        rows = _read(self.open_bytes, self.delimiter)
        next(rows)
        return (row for _, row in rows)

    def language_of(self, row: Sequence[str]) -> str | None:
        """Return the language of replies in a row ("sv" or "sv-FI"); None if it names none of `REPLY_LANGUAGES`."""
        code = "" if self.language_column is None else re.split("[-_]", row[self.language_column].strip().lower())[0]
        return code if code in REPLY_LANGUAGES else None

    def encoded_header(self) -> bytes:
        """Return the header with the added columns."""
        return (BOM if self.has_bom else "").encode() + self.encode([*self.header, *COLUMNS])

    def encode(self, cells: Sequence[str]) -> bytes:
        """Return a row in UTF-8; cells that a spreadsheet would take for formulas get a leading apostrophe."""
        buffer = io.StringIO(newline="")
        csv.writer(buffer, delimiter=self.delimiter).writerow(map(_without_formula, cells))
        return buffer.getvalue().encode()


def _without_formula(cell: str) -> str:
    is_formula = cell.lstrip(BLANKS).startswith(FORMULA_STARTS) and not _NUMBER.fullmatch(cell)
    return f"'{cell}" if is_formula else cell


def _open_text(open_bytes: Callable[[], BinaryIO]) -> io.TextIOWrapper:
    return io.TextIOWrapper(open_bytes(), "utf-8-sig", "surrogateescape", newline="")


def _read_header(open_bytes: Callable[[], BinaryIO], delimiter: str) -> list[str]:
    with _open_text(open_bytes) as file, suppress(csv.Error):
        return [name.strip() for name in next(filter(None, csv.reader(file, delimiter=delimiter)), [])]
    return []


def _read(open_bytes: Callable[[], BinaryIO], delimiter: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the number and the cells of each row that is not a blank line."""
    number = 0
    with _open_text(open_bytes) as file:
        try:
            for number, row in enumerate(csv.reader(file, delimiter=delimiter, strict=True), 1):
                if any(map(_NOT_UTF8.search, row)):
                    raise DataError(f"row {number}: is not UTF-8; save the table as 'CSV UTF-8'")
                if row:
                    yield number, row
        except csv.Error as error:
            raise DataError(
                f"row {number + 1}: cannot be read ({error}); close each double quote, and double those inside"
            ) from None


def _column(number: int, header: Sequence[str], name: str, content: str) -> int:
    """Return the position of the column with the text or the language in the header, which is row `number`."""
    names = [each.strip() for each in header]
    if names.count(name) > 1:
        raise DataError(f"row {number}: {names.count(name)} columns have the name given for the {content}; rename one")
    if name not in names:
        listed = ", ".join(filter(_PLAIN_NAME.fullmatch, names[:MAX_LISTED_COLUMNS]))
        raise DataError(f"row {number}: no column has the name given for the {content}; the columns are {listed}")
    return names.index(name)
