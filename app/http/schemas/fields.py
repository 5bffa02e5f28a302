"""Types and checks that the fields of requests share."""

import re
from collections.abc import Iterable
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, JsonValue, Strict, StringConstraints
from pydantic_core import PydanticCustomError

from index.answering.query import Crs
from index.build.manifest import NAME_PATTERN

_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f]")  # Unicode's category Cc except tabs and line ends
# Larger than the Earth and finer than any map; their squares do not overflow.
MAX_METRES = 1e8
MIN_METRES = 1e-3

Coordinate = Annotated[float, Strict(), Field(allow_inf_nan=False, ge=-MAX_METRES, le=MAX_METRES)]
Length = Annotated[float, Strict(), Field(allow_inf_nan=False, ge=MIN_METRES, le=MAX_METRES)]
Point = tuple[Coordinate, Coordinate]
IndexName = Annotated[
    str, Strict(), StringConstraints(pattern=NAME_PATTERN), Field(description="an index that GET /info lists")
]


class Body(BaseModel):
    """The body of a request or a part of it; unknown fields are refused."""

    model_config = ConfigDict(extra="forbid")

    def given(self) -> set[str]:
        """Return the names of the fields that are given; null counts as absent."""
        return {name for name in self.model_fields_set if getattr(self, name) is not None}


def field_error(message: str, field: str = "") -> PydanticCustomError:
    """Return a validation error with a message for the client; `field` names another field than the checked one."""
    return PydanticCustomError("hereabouts", "{message}", {"message": message, "field": field})


def check_text(text: str) -> str:
    """Refuse a text without words or with control characters; the message does not quote it."""
    if _CONTROL.search(text):
        raise field_error("contains a control character; send plain text")
    if not any(character.isalnum() for character in text):
        raise field_error("contains no words; describe what is around you")
    return text


def check_degrees(crs: Crs, points: Iterable[tuple[str, Point]]) -> None:
    """Refuse longitudes and latitudes out of range; each point comes with the name of its field."""
    for field, (lon, lat) in points if crs == "wgs84" else ():
        if not (-180 <= lon <= 180 and -90 <= lat <= 90):
            raise field_error("must be [longitude -180..180, latitude -90..90]; for metres, send crs map", field)


def one_of(first: str, first_type: str, second: str, second_type: str) -> dict[str, JsonValue]:
    """Return the JSON schema of two fields of which exactly one is given; null counts as absent."""
    types = {first: first_type, second: second_type}
    return {
        "oneOf": [
            {
                "required": [chosen],
                "properties": {name: {"type": kind if name == chosen else "null"} for name, kind in types.items()},
            }
            for chosen in types
        ]
    }
