"""The objects of a file as it was read, before they have a kind."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import shapely


@dataclass(frozen=True, slots=True)
class ExtraRecord:
    """An object of a file."""

    row: str  # in source ids: "17", "node/123"
    title: str  # in errors: "row 17"
    geometry: shapely.Geometry | None  # in degrees, longitude first; None without a position
    properties: Mapping[str, Any]
