"""The body of POST /evaluate."""

from typing import Annotated, Self

from pydantic import ConfigDict, Field, JsonValue, Strict, StringConstraints, model_validator

from app.http.schemas.fields import IndexName, Length, Point, either, wrong
from app.http.schemas.requests import REFINE, Body, DescriptionFields
from app.limits import MAX_EVALUATE_QUERIES
from index.answering.query import Crs, Refine
from index.build.artifact import DEFAULT_ALIAS

EXAMPLE: JsonValue = {
    "queries": [
        {"description": "I am north of a gray building. A black pole is to my west.", "position": [105.0, -35.0]},
        {"hints": ["I stand on a gray road.", "There is a park to my west."], "position": [340.0, 200.0]},
    ],
    "crs": "map",
}
MAX_RADII = 8


class EvaluateQuery(DescriptionFields):
    """A description and where it was said: [x, y] in metres, or [lon, lat] with crs wgs84."""

    position: Point


class EvaluateRequest(Body):
    """Queries with known positions, or a data set of the service by its name."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE], **either("queries", "array", "data", "string")})

    queries: Annotated[list[EvaluateQuery], Field(min_length=1, max_length=MAX_EVALUATE_QUERIES)] | None = Field(
        None, description="asked of the index that is served"
    )
    crs: Crs = Field("map", description="what the positions of queries mean")
    data: Annotated[str, Strict(), StringConstraints(min_length=1, max_length=255)] | None = Field(
        None, description="instead of queries: a data set of the service, by its name in /info"
    )
    split: Annotated[str, Strict(), StringConstraints(pattern=r"^[A-Za-z0-9_,-]{1,255}$")] | None = Field(
        None, description="of data: train, val or test, or a comma list of scenes; everything if it is left out"
    )
    grow: Annotated[list[Length], Field(min_length=1, max_length=MAX_RADII)] | None = Field(
        None, description="radii in metres of a growing gallery, for example [200, 300, 400, 500]"
    )
    refine: Refine = REFINE
    index: IndexName = DEFAULT_ALIAS

    @model_validator(mode="after")
    def _is_one_source(self) -> Self:
        if (self.queries is None) == (self.data is None):
            raise wrong("give either queries or data", "queries")
        if self.queries is not None and self.split is not None:
            raise wrong("goes with data, not with queries; leave it out", "split")
        if self.data is not None and "crs" in self.model_fields_set:
            raise wrong("goes with queries, not with data; leave it out", "crs")
        return self
