"""The body of POST /evaluate."""

from typing import Annotated, Self

from pydantic import ConfigDict, Field, JsonValue, Strict, StringConstraints, model_validator

from app.http.schemas.fields import IndexName, Length, Point, field_error, one_of
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
    """A description and its true position: [x, y] in metres, or [lon, lat] with crs wgs84."""

    position: Point


class EvaluateRequest(Body):
    """Queries with known positions, or the name of a data set of the service."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE], **one_of("queries", "array", "data", "string")})

    queries: Annotated[list[EvaluateQuery], Field(min_length=1, max_length=MAX_EVALUATE_QUERIES)] | None = Field(
        None, description="queries to the served index"
    )
    crs: Crs = Field("map", description="the reference system of the positions of queries")
    data: Annotated[str, Strict(), StringConstraints(min_length=1, max_length=255)] | None = Field(
        None, description="instead of queries: the name of a data set that GET /info lists"
    )
    split: Annotated[str, Strict(), StringConstraints(pattern=r"^[A-Za-z0-9_,-]{1,255}$")] | None = Field(
        None, description="part of the data set: train, val, test, or scenes separated by commas; by default all"
    )
    grow: Annotated[list[Length], Field(min_length=1, max_length=MAX_RADII)] | None = Field(
        None, description="radii in metres of a growing gallery, for example [200, 300, 400, 500]"
    )
    refine: Refine = REFINE
    index: IndexName = DEFAULT_ALIAS

    @model_validator(mode="after")
    def _is_one_source(self) -> Self:
        if (self.queries is None) == (self.data is None):
            raise field_error("give either queries or data", "queries")
        if self.queries is not None and self.split is not None:
            raise field_error("works only with data, not with queries; leave it out", "split")
        if self.data is not None and "crs" in self.model_fields_set:
            raise field_error("works only with queries, not with data; leave it out", "crs")
        return self
