"""The local metric frame of a map and its place on Earth."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from pyproj import CRS, Transformer

Floats = npt.NDArray[np.floating[Any]]


@dataclass(frozen=True, slots=True)
class Frame:
    """A local east-north-up frame in metres (ROS REP-103), with an optional place on Earth."""

    frame_id: str = "map"  # in answers
    origin_lat: float | None = None  # WGS84 degrees of the point (0, 0); None if the map has no georeference
    origin_lon: float | None = None
    # Projected system whose axes the frame's are parallel to; None for a transverse Mercator projection centred on the
    # origin, which is true north and true to scale there
    epsg: int | None = None

    @property
    def is_georeferenced(self) -> bool:
        """Whether positions have a latitude and longitude."""
        return self.origin_lat is not None and self.origin_lon is not None

    def position_m(self, position: tuple[float, float], crs: Literal["map", "wgs84"]) -> Floats:
        """Return a position [2] in metres, given as (x, y), or (lon, lat) with crs "wgs84"; errors as `from_wgs84`."""
        return np.asarray(position, np.float64) if crs == "map" else self.from_wgs84(position[1], position[0])

    def from_wgs84(self, lat: Floats | float, lon: Floats | float) -> Floats:
        """Return metres (east, north) [..., 2] for WGS84 degrees; raise ValueError if the map has no georeference."""
        transformer, easting, northing = self._projection()
        x, y = transformer.transform(lon, lat)
        return np.stack([np.asarray(x) - easting, np.asarray(y) - northing], axis=-1)

    def to_wgs84(self, position_m: Floats) -> tuple[Floats, Floats]:
        """Return (lat, lon) in degrees for positions [..., 2 or 3] in metres; errors as `from_wgs84`."""
        transformer, easting, northing = self._projection()
        position = np.asarray(position_m, dtype=np.float64)
        lon, lat = transformer.transform(position[..., 0] + easting, position[..., 1] + northing, direction="INVERSE")
        return np.asarray(lat), np.asarray(lon)

    def _projection(self) -> tuple[Transformer, float, float]:
        if self.origin_lat is None or self.origin_lon is None:
            raise ValueError("this map has no georeference, so its positions have no latitude and longitude")
        return _projection(self.origin_lat, self.origin_lon, self.epsg)


@lru_cache(maxsize=64)
def _projection(origin_lat: float, origin_lon: float, epsg: int | None) -> tuple[Transformer, float, float]:
    if epsg is None:
        projected = CRS.from_dict(
            {"proj": "tmerc", "lat_0": origin_lat, "lon_0": origin_lon, "datum": "WGS84", "units": "m"}
        )
    else:
        projected = CRS.from_epsg(epsg)
    transformer = Transformer.from_crs("EPSG:4326", projected, always_xy=True)
    easting, northing = transformer.transform(origin_lon, origin_lat)
    return transformer, easting, northing
