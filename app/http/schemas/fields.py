"""Of what the fields of requests are made: numbers, texts, and what is wrong with them in words that a client reads."""

import re
from collections.abc import Iterable, Sequence
from typing import Annotated

from pydantic import Field, JsonValue, Strict, StringConstraints
from pydantic_core import PydanticCustomError

from index.answering.query import Crs
from index.build.manifest import NAME_PATTERN

_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f]")  # Unicode's Cc, but for tab and line ends
# No map is wider than the Earth or finer than a millimetre, and the squares of these stay numbers.
MAX_METRES = 1e8
MIN_METRES = 1e-3

Coordinate = Annotated[float, Strict(), Field(allow_inf_nan=False, ge=-MAX_METRES, le=MAX_METRES)]
Length = Annotated[float, Strict(), Field(allow_inf_nan=False, ge=MIN_METRES, le=MAX_METRES)]
Point = tuple[Coordinate, Coordinate]
IndexName = Annotated[
    str,
    Strict(),
    StringConstraints(pattern=NAME_PATTERN),
    Field(description="which of the indexes that GET /info names"),
]


def wrong(message: str, field: str = "") -> PydanticCustomError:
    """What is wrong with a value, as the client reads it; `field` if it is not the one that is looked at."""
    return PydanticCustomError("hereabouts", "{message}", {"message": message, "field": field})


def check_text(text: str) -> str:
    """Refuse a text that nobody typed: no words, or control characters.

    Raises:
        PydanticCustomError: what is wrong, without the text.
    """
    if _CONTROL.search(text):
        raise wrong("holds a control character; send plain text")
    if not any(character.isalnum() for character in text):
        raise wrong("has no words; say what is around you")
    return text


def check_bbox(bbox: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    """Refuse a box that is inside out.

    Raises:
        PydanticCustomError: which side is wrong.
    """
    west, south, east, north = bbox
    if west > east:
        raise wrong("west is greater than east; give [west, south, east, north]")
    if south > north:
        raise wrong("south is greater than north; give [west, south, east, north]")
    return bbox


def check_degrees(crs: Crs, points: Iterable[tuple[str, Point]]) -> None:
    """Refuse degrees that are nowhere on Earth.

    Args:
        crs: what the coordinates of the points mean.
        points: (x, y) or (lon, lat), each with the name of its field.

    Raises:
        PydanticCustomError: which point is wrong.
    """
    for field, (lon, lat) in points if crs == "wgs84" else ():
        if not (-180 <= lon <= 180 and -90 <= lat <= 90):
            raise wrong("is not [longitude -180..180, latitude -90..90]; or did you mean crs map?", field)


def either(first: str, first_type: str, second: str, second_type: str) -> dict[str, JsonValue]:
    """OpenAPI's words for two fields of which a body has one; null is as if it were left out."""
    kinds = {first: first_type, second: second_type}
    return {
        "oneOf": [
            {
                "required": [one],
                "properties": {name: {"type": kind if name == one else "null"} for name, kind in kinds.items()},
            }
            for one in kinds
        ]
    }


DESCRIPTION_OR_HINTS = either("description", "string", "hints", "array")


def join_hints(hints: Sequence[str]) -> str:
    """Hints as one description, a line each."""
    return "\n".join(hints)
