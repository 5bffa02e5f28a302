"""Texts about places with their true positions, read from a .jsonl file."""

import gzip
import json
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from models.errors import DataError

SUFFIXES = (".jsonl", ".jsonl.gz")
START_SIGMA_M = 800.0  # standard deviation of the prior around a start; set by hand, not fitted
LatLon = tuple[float, float]  # degrees


@dataclass(frozen=True, slots=True)
class WrittenMention:
    """A stretch of a text that means an object."""

    start: int  # characters
    end: int
    object: str | None  # source id ("node/123") or name of a street; None if the map does not have it


@dataclass(frozen=True, slots=True)
class PlaceText:
    """A text about a place."""

    text: str
    goal: LatLon | None  # the place it describes; None if the map does not have it, so that every answer is wrong
    start: LatLon | None = None  # the listener's position; None if unknown
    mentions: tuple["WrittenMention", ...] = ()  # what the writer meant, if known


def load_place_texts(path: Path) -> list[PlaceText]:
    """Read .jsonl or .jsonl.gz, one object a line: `text`, `goal` [lat, lon] and optionally `start` [lat, lon].

    `lat` and `lon` may stand for `goal`; `"nowhere": true` says that the map does not have the place. `mentions`
    are labels: {"text", "object"}. Other fields are ignored. Raise DataError if the file cannot be read, or a line is
    wrong.
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
                raise ValueError("'text' is not a string")
            goal = None if row.get("nowhere") is True else _parse_lat_lon(row.get("goal") or (row["lat"], row["lon"]))
            mentions = tuple(_locate_mentions(row["text"], row.get("mentions", ())))
            text = PlaceText(row["text"], goal, None if start is None else _parse_lat_lon(start), mentions)
            if not any(c.isalnum() for c in text.text):
                raise ValueError("no words in 'text'")
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise DataError(
                f"{path}, line {number}: {type(error).__name__}: {error}; each line is a JSON object with 'text', "
                "'goal' [latitude, longitude] (or \"nowhere\": true) and optionally 'start'"
            ) from error
        yield text


def _locate_mentions(text: str, rows: Any) -> Iterator[WrittenMention]:
    """Find labelled words in a text, in its order."""
    end = 0
    for row in rows:
        start = text.find(row["text"], end)
        if start < 0:
            raise ValueError(f"'{row['text']}' is not in the text, or not in this order")
        end = start + len(row["text"])
        yield WrittenMention(start, end, row["object"])


def _parse_lat_lon(value: Any) -> LatLon:
    lat, lon = (float(v) for v in value)
    if not (-90 <= lat <= 90 and -180 <= lon <= 180):
        raise ValueError(f"{value} is not [latitude, longitude]")
    return lat, lon
