"""The parameters of Nominatim's endpoints, and the coordinates that a search may consist of."""

import re
from typing import Annotated, Final, Literal

from pydantic import BaseModel, Field

from app.http.schemas.fields import IndexName
from index.build.artifact import DEFAULT_ALIAS

Format = Literal["xml", "json", "jsonv2", "geojson", "geocodejson"]
STRUCTURED: Final = (("amenity", "street"), ("postalcode",), ("city", "county", "state", "country"))
MAX_PART_CHARACTERS: Final = 200
_NUMBER: Final = r"(\d{{1,3}}(?:\.\d+)?)"
_ANGLE: Final = rf"({{0}})? ?([-+]?){_NUMBER} ?[°d]?(?: ?{_NUMBER} ?['\u2032]?(?: ?{_NUMBER} ?[\"\u2033]?)?)? ?({{0}})?"
_POSITION: Final = re.compile(rf"\[? ?{_ANGLE.format('[NSns]')} ?[,; ] ?{_ANGLE.format('[EWew]')} ?\]?")


class Output(BaseModel):
    """The form of an answer."""

    format: Format = "jsonv2"
    addressdetails: bool = Field(False, description="add the parts of the address")
    namedetails: bool = Field(False, description="add the name by itself")
    index: IndexName = DEFAULT_ALIAS


Part = Annotated[str | None, Field(max_length=MAX_PART_CHARACTERS)]


class SearchParameters(Output):
    """A description, or parts of an address in place of it."""

    q: str | None = Field(None, description="what is around the speaker, in plain words; or a latitude and a longitude")
    amenity: Part = Field(None, description="a name or a kind of place; this and the next six instead of q")
    street: Part = Field(None, description="house number and street")
    city: Part = None
    county: Part = None
    state: Part = None
    country: Part = None
    postalcode: Part = None
    limit: int = Field(10, description="more than 40 means 40, and less than 1 means 1")
    viewbox: str | None = Field(None, description="lon,lat,lon,lat: two corners of the preferred area")
    bounded: bool = Field(False, description="search only inside viewbox")


class ReverseParameters(Output):
    """A position to describe."""

    format: Format = "xml"
    addressdetails: bool = Field(True, description="add the parts of the address")
    lat: float = Field(ge=-90, le=90, allow_inf_nan=False)
    lon: float = Field(ge=-180, le=180, allow_inf_nan=False)


class LookupParameters(Output):
    """Objects of OpenStreetMap to describe."""

    format: Format = "xml"
    osm_ids: str = Field(description="N, W or R and an osm_id of an answer, at most 50, with commas: N123,W456")


def parse_position(text: str) -> tuple[float, float] | None:
    """Return the latitude and longitude that a text consists of: "60.165, 24.939" or "N 60° 9' 54" E 24° 56' 20"".

    None if it is anything else.
    """
    match = _POSITION.fullmatch(" ".join(text.split()))
    if match is None:
        return None
    lat, lon = _degrees(*match.groups()[:6]), _degrees(*match.groups()[6:])
    return (lat, lon) if lat is not None and lon is not None and abs(lat) <= 90 and abs(lon) <= 180 else None


def _degrees(
    before: str | None, sign: str, degrees: str, minutes: str | None, seconds: str | None, after: str | None
) -> float | None:
    """Return an angle in degrees; None for minutes without a letter, which may be anything."""
    letter = (before or after or "").upper()
    if minutes and not letter:
        return None
    value = float(degrees) + float(minutes or 0) / 60 + float(seconds or 0) / 3600
    return -value if sign == "-" or letter in ("S", "W") else value
