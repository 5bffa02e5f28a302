"""Reader of .jsonl files: texts about places, each with the place."""

import gzip
import json
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from models.errors import DataError

SUFFIXES = (".jsonl", ".jsonl.gz")
START_SIGMA_M = 800.0  # of the prior round a start
LatLon = tuple[float, float]


@dataclass(frozen=True, slots=True)
class PlaceText:
    """A text about a place.

    Attributes:
        text: as it was written.
        goal: the place it tells of, degrees of latitude and longitude.
        start: where the listener is; None if that is not known.
    """

    text: str
    goal: LatLon
    start: LatLon | None = None


def load_place_texts(path: Path) -> list[PlaceText]:
    """Read texts, one JSON object a line: `text`, `goal` [lat, lon] and, if there is one, `start` [lat, lon].

    Args:
        path: .jsonl or .jsonl.gz; other fields are left alone.

    Raises:
        DataError: it cannot be read; says which line is wrong.
    """
    try:
        with gzip.open(path, "rt", encoding="utf-8") if path.suffix == ".gz" else path.open(encoding="utf-8") as file:
            texts = list(_read_texts(path, file))
    except (OSError, EOFError, zlib.error, UnicodeDecodeError) as error:
        raise DataError(f"{path}: cannot be read ({error}); give a .jsonl or .jsonl.gz file") from error
    if not texts:
        raise DataError(f"{path}: no texts in it")
    return texts


def _read_texts(path: Path, lines: Any) -> Iterator[PlaceText]:
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        try:
            row = json.loads(line)
            start = row.get("start")
            if not isinstance(row["text"], str):
                raise ValueError("'text' is no text")
            text = PlaceText(row["text"], _parse_lat_lon(row["goal"]), None if start is None else _parse_lat_lon(start))
            if not any(c.isalnum() for c in text.text):
                raise ValueError("no words in 'text'")
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise DataError(
                f"{path}, line {number}: {type(error).__name__}: {error}; each line is a JSON object with 'text', "
                "'goal' [latitude, longitude] and perhaps 'start'"
            ) from error
        yield text


def _parse_lat_lon(value: Any) -> LatLon:
    lat, lon = (float(v) for v in value)
    if not (-90 <= lat <= 90 and -180 <= lon <= 180):
        raise ValueError(f"{value} is not [latitude, longitude]")
    return lat, lon
