"""Where to search: filters and priors."""

import math
from collections.abc import Sequence
from itertools import chain
from typing import Annotated, Any, Final, Literal, Self

from pydantic import (
    AfterValidator,
    BeforeValidator,
    FailFast,
    Field,
    JsonValue,
    Strict,
    TypeAdapter,
    ValidationError,
    model_validator,
)

from app.http.errors import field_message
from app.http.schemas.fields import Body, Coordinate, Length, Point, field_error
from app.limits import MAX_VERTICES
from index.answering.query import Box, Circle, Polygons, Prior

DEFAULT_CONFIDENCE: Final = 0.68  # of circles and ellipses, as in Advanced Mobile Location (ETSI TS 103 625)
# GeoJSON positions may have a height, which is ignored.
Vertex = Annotated[
    Point, BeforeValidator(lambda value: value[:2] if isinstance(value, list) and len(value) == 3 else value)
]
Ring = Annotated[tuple[Vertex, ...], FailFast()]  # thousands of errors would take seconds
PolygonRings = Annotated[tuple[Ring, ...], FailFast()]
POLYGONS: Final = TypeAdapter(Annotated[tuple[PolygonRings, ...], FailFast()])


def check_bbox(bbox: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    """Refuse a box whose sides are in the wrong order."""
    west, south, east, north = bbox
    if west > east:
        raise field_error("west is greater than east; send [west, south, east, north]")
    if south > north:
        raise field_error("south is greater than north; send [west, south, east, north]")
    return bbox


def check_polygons(coordinates: Sequence[Any], is_multiple: bool) -> tuple[PolygonRings, ...]:
    """Return the polygons of GeoJSON coordinates: each an outer ring, then its holes. Refuse invalid ones."""
    import shapely  # noqa: PLC0415  # heavy, and few requests have polygons

    try:
        polygons = POLYGONS.validate_python(coordinates if is_multiple else [coordinates])
    except ValidationError as error:
        first = error.errors()[0]
        steps = ("coordinates", *(first["loc"] if is_multiple else first["loc"][1:]))
        raise field_error(field_message(first), ".".join(map(str, steps))) from None
    rings = list(chain.from_iterable(polygons))
    if sum(map(len, rings)) > MAX_VERTICES:
        raise field_error(f"have more than {MAX_VERTICES} vertices; simplify them", "coordinates")
    if not all(polygons) or not polygons:
        raise field_error("must have a ring for each polygon", "coordinates")
    if any(len(ring) < 4 or ring[0] != ring[-1] for ring in rings):
        raise field_error("must have rings of 4 or more positions, of which the last repeats the first", "coordinates")
    if not all(shapely.is_valid([shapely.Polygon(outer, holes) for outer, *holes in polygons])):
        advice = "must have rings that do not cross or touch themselves, and holes inside their polygon"
        raise field_error(advice, "coordinates")
    return polygons


class WithinCircle(Body):
    """A circle; `center` is [x, y] in metres, or [lon, lat] with crs wgs84."""

    center: Point
    radius_m: Length


class Within(Body):
    """A filter on positions: answers lie inside it. Give `bbox`, `circle`, or a GeoJSON geometry (RFC 7946)."""

    bbox: Annotated[tuple[Coordinate, Coordinate, Coordinate, Coordinate], AfterValidator(check_bbox)] | None = Field(
        None, description="[west, south, east, north] in metres, or in degrees with crs wgs84"
    )
    circle: WithinCircle | None = None
    type: Literal["Polygon", "MultiPolygon"] | None = None
    coordinates: list[JsonValue] | None = Field(
        None,
        description="with type: rings of a Polygon or polygons of a MultiPolygon, in metres, or [lon, lat] with "
        "crs wgs84",
    )
    _polygons: tuple[PolygonRings, ...] = ()

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        if self.given() not in ({"bbox"}, {"circle"}, {"type", "coordinates"}):
            raise field_error("give exactly one of bbox, circle, and type with coordinates (a GeoJSON polygon)")
        if self.coordinates is not None:
            self._polygons = check_polygons(self.coordinates, is_multiple=self.type == "MultiPolygon")
        return self

    def to_filter(self) -> Box | Circle | Polygons:
        """Return the filter as the localizer takes it."""
        if self.circle is not None:
            return Circle(self.circle.center, self.circle.radius_m)
        return Polygons(self._polygons) if self.bbox is None else Box(*self.bbox)

    def corners(self) -> list[tuple[str, Point]]:
        """Return two opposite corners of the box or of the polygons' extent; none of a circle."""
        if self.bbox is not None:
            west, south, east, north = self.bbox
            return [("within.bbox", (west, south)), ("within.bbox", (east, north))]
        vertices = [vertex for rings in self._polygons for ring in rings for vertex in ring]
        extremes = [tuple(choose(axis) for axis in zip(*vertices, strict=True)) for choose in (min, max) if vertices]
        return [("within.coordinates", (x, y)) for x, y in extremes]


class PriorPosition(Body):
    """A prior, for example a poor GPS fix; `position` is [x, y] in metres, or [lon, lat] with crs wgs84.

    Give its error as a standard deviation, a circle or an ellipse; these contain the true position with `confidence`.
    """

    position: Point
    sigma_m: Length | None = Field(None, description="standard deviation in every direction")
    radius_m: Length | None = Field(None, description="radius of the circle")
    semi_major_m: Length | None = None
    semi_minor_m: Length | None = None
    orientation_deg: Annotated[float, Strict(), Field(allow_inf_nan=False, ge=-360, le=360)] | None = Field(
        None, description="direction of the major axis, clockwise from north"
    )
    confidence: Annotated[float, Strict(), Field(allow_inf_nan=False, ge=0.01, le=0.999)] | None = Field(
        None, description=f"by default {DEFAULT_CONFIDENCE}"
    )

    @model_validator(mode="after")
    def _is_one_form(self) -> Self:
        given = self.given() - {"position", "confidence"}
        ellipse = {"semi_major_m", "semi_minor_m", "orientation_deg"}
        if given == ellipse and (self.semi_minor_m or 0) > (self.semi_major_m or 0):
            raise field_error("is greater than semi_major_m; exchange them", "semi_minor_m")
        if given not in ({"sigma_m"}, {"radius_m"}, ellipse):
            forms = "sigma_m; radius_m; or semi_major_m, semi_minor_m and orientation_deg"
            raise field_error(f"give exactly one form of the error: {forms}", "" if given else "sigma_m")
        if self.sigma_m is not None and self.confidence is not None:
            raise field_error("works only with radius_m or an ellipse; leave it out", "confidence")
        return self

    def to_prior(self) -> Prior:
        """Return the Gaussian whose circle or ellipse contains `confidence` of it."""
        if self.sigma_m is not None:
            return Prior(self.position, self.sigma_m)
        # the quantile of chi-square with two degrees of freedom
        sigmas = math.sqrt(-2 * math.log(1 - (self.confidence or DEFAULT_CONFIDENCE)))
        major_m, minor_m = self.semi_major_m or self.radius_m, self.semi_minor_m or self.radius_m
        assert major_m is not None
        assert minor_m is not None
        return Prior(self.position, major_m / sigmas, minor_m / sigmas, self.orientation_deg or 0.0)
