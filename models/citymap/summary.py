"""A summary of a map: how large it is, and what descriptions can name there."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

Counts = Mapping[str, int]  # in descending order


@dataclass(frozen=True, slots=True)
class MapSummary:
    """The size and content of a map from OpenStreetMap."""

    bbox: Annotated[
        tuple[float, float, float, float],
        Field(description="west, south, east, north in degrees; across 180 degrees east is beyond 180"),
    ]
    width_km: float
    height_km: float
    walkable_km: Annotated[float, Field(description="length of the streets and paths that people walk on")]
    objects: Annotated[int, Field(description="everything that a description can name, streets included")]
    streets: Annotated[int, Field(description="streets with a name")]
    named_objects: Annotated[int, Field(description="other objects with a name")]
    house_numbers: Annotated[int, Field(description="objects with a house number")]
    kinds: Annotated[Counts, Field(description="objects of the most frequent kinds")]
    scripts: Annotated[Counts, Field(description="names in each script")]
    languages: Annotated[
        Counts, Field(description="elements with a name tagged in each of the most frequent languages")
    ]
    extras: Annotated[Counts, Field(description="objects of the city's own data, by file and kind")]
    cut: Annotated[Counts, Field(description="objects that lost a part, by reason")]
    dropped: Annotated[Counts, Field(description="objects left out, by reason")]
    repaired: Annotated[Counts, Field(description="objects or tags that were corrected, by reason")]
