"""What the service is asked. Numbers are strict and finite, unknown fields are refused."""

import unicodedata
from typing import Annotated, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    JsonValue,
    Strict,
    StringConstraints,
    create_model,
    model_validator,
)
from pydantic_core import PydanticCustomError

from app.settings import Settings
from index.answers import Box, Circle, Crs, Prior

EXAMPLE: JsonValue = {"description": "I am north of a gray building. A black pole is to my west.", "top_k": 3}
DEFAULT_TOP_K = 5
TEXT_WHITESPACE = "\t\n\r"
# No map is wider than the Earth or finer than a millimetre, and the squares of these stay numbers.
MAX_METRES = 1e8
MIN_METRES = 1e-3

Coordinate = Annotated[float, Strict(), Field(allow_inf_nan=False, ge=-MAX_METRES, le=MAX_METRES)]
Length = Annotated[float, Strict(), Field(allow_inf_nan=False, ge=MIN_METRES, le=MAX_METRES)]
Point = tuple[Coordinate, Coordinate]


def _wrong(message: str, field: str = "") -> PydanticCustomError:
    return PydanticCustomError("hereabouts", "{message}", {"message": message, "field": field})


def check_text(text: str) -> str:
    """Refuse a text that nobody typed: no words, or control characters.

    Raises:
        PydanticCustomError: what is wrong, without the text.
    """
    if any(unicodedata.category(character) == "Cc" and character not in TEXT_WHITESPACE for character in text):
        raise _wrong("holds a control character; send plain text")
    if not any(character.isalnum() for character in text):
        raise _wrong("has no words; say what is around you")
    return text


def check_bbox(bbox: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    """Refuse a box that is inside out.

    Raises:
        PydanticCustomError: which side is wrong.
    """
    west, south, east, north = bbox
    if west > east:
        raise _wrong("west is greater than east; give [west, south, east, north]")
    if south > north:
        raise _wrong("south is greater than north; give [west, south, east, north]")
    return bbox


class _Body(BaseModel):
    model_config = ConfigDict(extra="forbid")


class WithinCircle(_Body):
    """A circle; `center` is [x, y] in metres, or [lon, lat] with crs wgs84."""

    center: Point
    radius_m: Length


class Within(_Body):
    """A filter: nothing outside it is answered. Give `bbox` or `circle`."""

    bbox: Annotated[tuple[Coordinate, Coordinate, Coordinate, Coordinate], AfterValidator(check_bbox)] | None = Field(
        None, description="[west, south, east, north] in metres, or in degrees with crs wgs84"
    )
    circle: WithinCircle | None = None

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        if (self.bbox is None) == (self.circle is None):
            raise _wrong("give either bbox or circle")
        return self

    def filter(self) -> Box | Circle:
        """As the localizer takes it."""
        if self.circle is not None:
            return Circle(self.circle.center, self.circle.radius_m)
        assert self.bbox is not None
        return Box(*self.bbox)


class PriorPosition(_Body):
    """A bias, for example a poor GPS fix; `position` is [x, y] in metres, or [lon, lat] with crs wgs84."""

    position: Point
    sigma_m: Length

    def prior(self) -> Prior:
        """As the localizer takes it."""
        return Prior(self.position, self.sigma_m)


class LocalizeRequest(_Body):
    """What to localize; `request_model` adds the limits of a service."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE]})

    description: str | None
    hints: list[str] | None
    top_k: int
    within: Within | None = None
    prior: PriorPosition | None = None
    crs: Crs = Field("map", description="what the coordinates of within and prior mean")
    deadline_ms: int
    index: Literal["default"] = "default"

    @model_validator(mode="after")
    def _is_one_text(self) -> Self:
        if (self.description is None) == (self.hints is None):
            raise _wrong("give either description or hints", "description")
        return self

    @model_validator(mode="after")
    def _is_on_earth(self) -> Self:
        if self.crs == "wgs84":
            for field, (lon, lat) in self.points():
                if not (-180 <= lon <= 180 and -90 <= lat <= 90):
                    raise _wrong("is not [longitude -180..180, latitude -90..90]; or did you mean crs map?", field)
        return self

    def points(self) -> list[tuple[str, tuple[float, float]]]:
        """All (x, y) or (lon, lat) of the request, each with the name of its field."""
        points = []
        if self.within and self.within.bbox:
            west, south, east, north = self.within.bbox
            points += [("within.bbox", (west, south)), ("within.bbox", (east, north))]
        if self.within and self.within.circle:
            points.append(("within.circle.center", self.within.circle.center))
        if self.prior:
            points.append(("prior.position", self.prior.position))
        return points


def request_model(settings: Settings) -> type[LocalizeRequest]:
    """LocalizeRequest with a service's limits in its fields, so that they are checked and in OpenAPI."""
    text = Annotated[str, Strict(), StringConstraints(max_length=settings.max_characters), AfterValidator(check_text)]

    def check_total(hints: list[str]) -> list[str]:
        if sum(map(len, hints)) > settings.max_characters:
            raise _wrong(f"have more than {settings.max_characters} characters together; send fewer or shorter ones")
        return hints

    hints = Annotated[list[text], Field(min_length=1, max_length=settings.max_hints), AfterValidator(check_total)]
    top_k = Annotated[int, Strict(), Field(ge=1, le=settings.max_top_k, description="candidates to list")]
    deadline_ms = Annotated[int, Strict(), Field(ge=1, le=settings.max_deadline_ms)]
    return create_model(
        "LocalizeRequest",
        __base__=LocalizeRequest,
        __doc__="One description, or its sentences as hints, and where to look.",
        description=(text | None, Field(None, description="what is around the speaker, in plain words")),
        hints=(hints | None, Field(None, description="the same in sentences, one hint each")),
        top_k=(top_k, min(DEFAULT_TOP_K, settings.max_top_k)),
        deadline_ms=(deadline_ms, Field(settings.deadline_ms, description="504 if there is no answer by then")),
    )
