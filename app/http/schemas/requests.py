"""The bodies of requests. Numbers are strict and finite; unknown fields are refused."""

from typing import Annotated, Any, Self

from pydantic import AfterValidator, ConfigDict, Field, JsonValue, Strict, StringConstraints, model_validator

from app.http.schemas.areas import PriorPosition, Within
from app.http.schemas.fields import (
    Body,
    IndexName,
    Length,
    Point,
    check_degrees,
    check_text,
    field_error,
    one_of,
)
from app.limits import (
    DEFAULT_DEADLINE_MS,
    MAX_DEADLINE_MS,
    MAX_DESCRIPTION_CHARACTERS,
    MAX_EVALUATE_QUERIES,
    MAX_HINTS,
    MAX_PLACES,
    MAX_SENTENCES,
    MAX_TOP_K,
)
from index.answering.query import (
    DEFAULT_REFINE,
    DEFAULT_TOP_K,
    MAX_REPLIES,
    Crs,
    Query,
    Refine,
    Reply,
)
from index.build.artifact import DEFAULT_ALIAS
from models.errors import DescriptionError
from models.language.sentences import split_hints

EXAMPLE: JsonValue = {"description": "I am north of a gray building. A black pole is to my west.", "top_k": 3}
DESCRIPTION_OR_HINTS = one_of("description", "string", "hints", "array")
QUERIES_OR_DATA = one_of("queries", "array", "data", "string")
DESCRIBE_EXAMPLE: JsonValue = {"position": [105.0, -35.0]}
CORRECTION_EXAMPLE: JsonValue = {"request": EXAMPLE, "position": [105.0, -35.0], "place_rank": 2}
EVALUATE_EXAMPLE: JsonValue = {
    "queries": [
        {"description": "I am north of a gray building. A black pole is to my west.", "position": [105.0, -35.0]},
        {"hints": ["I stand on a gray road.", "There is a park to my west."], "position": [340.0, 200.0]},
    ],
    "crs": "map",
}
MAX_ID_CHARACTERS = 1000  # far longer than any name or any question with four colours
MAX_RADII = 8  # of a growing gallery


class GivenAnswer(Body):
    """A reply to the `question` of an earlier answer to the same description."""

    question: Annotated[str, Strict(), StringConstraints(min_length=1, max_length=MAX_ID_CHARACTERS)] = Field(
        description="the id of the question"
    )
    choice: Annotated[str, Strict(), StringConstraints(min_length=1, max_length=MAX_ID_CHARACTERS)] = Field(
        description="the value of one of its choices; for an open question also a name that is not listed"
    )


def check_sentences(description: str) -> str:
    """Refuse a description with too many sentences or with none; the message does not quote it."""
    try:
        count = len(split_hints(description))
    except DescriptionError as error:
        raise field_error(str(error)) from None
    if count > MAX_SENTENCES:
        raise field_error(f"has {count} sentences, but at most {MAX_SENTENCES} are allowed; shorten it")
    return description


def check_hints(hints: list[str]) -> list[str]:
    """Refuse hints that are too long in total."""
    if sum(map(len, hints)) > MAX_DESCRIPTION_CHARACTERS:
        raise field_error(
            f"have more than {MAX_DESCRIPTION_CHARACTERS} characters in total; send fewer or shorter hints"
        )
    check_sentences("\n".join(hints))
    return hints


Text = Annotated[str, Strict(), StringConstraints(max_length=MAX_DESCRIPTION_CHARACTERS), AfterValidator(check_text)]
Description = Annotated[Text, AfterValidator(check_sentences)]
Hints = Annotated[list[Text], Field(min_length=1, max_length=MAX_HINTS), AfterValidator(check_hints)]
DeadlineMs = Annotated[
    int,
    Strict(),
    Field(ge=1, le=MAX_DEADLINE_MS, description="milliseconds to answer; after that the request fails with 504"),
]


class DescriptionFields(Body):
    """A description in free text, or its sentences as a list."""

    model_config = ConfigDict(json_schema_extra=DESCRIPTION_OR_HINTS)

    description: Description | None = Field(None, description="what is around the speaker, in plain words")
    hints: Hints | None = Field(None, description="the same as a list of sentences")

    @model_validator(mode="after")
    def _is_one_text(self) -> Self:
        if (self.description is None) == (self.hints is None):
            raise field_error("give either description or hints", "description")
        return self

    def text(self) -> str:
        """Return the description; hints are joined, one per line."""
        return "\n".join(self.hints or ()) if self.description is None else self.description


REFINE: Any = Field(
    DEFAULT_REFINE,
    description="how the position is found. posterior: a position distribution from all hints and the map; regressor: "
    "vector search, then a regressor; matching: vector search, then a network that matches hints with a cell's "
    "instances; none: vector search alone, which gives the centres of cells. Except for posterior, ranking uses all "
    "levels of the retriever, unless the index was built with --no-levels",
)


class LocalizeRequest(DescriptionFields):
    """One description and where to search."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE], **DESCRIPTION_OR_HINTS})

    top_k: Annotated[int, Strict(), Field(ge=1, le=MAX_TOP_K, description="candidates in the answer")] = DEFAULT_TOP_K
    within: Within | None = None
    prior: PriorPosition | None = None
    listener: Point | None = Field(
        None,
        description="position of whom the description guides to a meeting point, [x, y] or [lon, lat]: 'north of you' "
        "is then from there; give a prior as well if the meeting point is near",
    )
    crs: Crs = Field(
        "map",
        description="the reference system of within, prior and listener: metres of the map, or longitude and latitude",
    )
    refine: Refine = REFINE
    heat_map: Annotated[bool, Strict()] = Field(False, description="whether to add the position distribution")
    ros: Annotated[bool, Strict()] = Field(False, description="whether to add the estimate as a ROS pose")
    answers: Annotated[list[GivenAnswer], Field(max_length=MAX_REPLIES)] = Field(
        [], description="replies to the questions of all earlier answers: the service keeps no conversation"
    )
    deadline_ms: DeadlineMs = DEFAULT_DEADLINE_MS
    index: IndexName = DEFAULT_ALIAS

    @model_validator(mode="after")
    def _is_on_earth(self) -> Self:
        check_degrees(self.crs, self.points())
        return self

    @model_validator(mode="after")
    def _has_one_reply_per_question(self) -> Self:
        if self.answers and self.refine != "posterior":
            raise field_error("works only with refine posterior; leave one of them out", "answers")
        questions = [answer.question for answer in self.answers]
        repeated = next((n for n, question in enumerate(questions) if question in questions[:n]), None)
        if repeated is not None:
            raise field_error("is answered twice; send one answer per question", f"answers.{repeated}.question")
        return self

    def to_query(self) -> Query:
        """Return the query as the localizer takes it."""
        return Query(
            description=self.text(),
            top_k=self.top_k,
            within=self.within.to_filter() if self.within else None,
            prior=self.prior.to_prior() if self.prior else None,
            listener=self.listener,
            crs=self.crs,
            refine=self.refine,
            heat_map=self.heat_map,
            replies=tuple(Reply(answer.question, answer.choice) for answer in self.answers),
        )

    def points(self) -> list[tuple[str, tuple[float, float]]]:
        """Return all (x, y) or (lon, lat) of the request, each with the name of its field."""
        points = self.within.corners() if self.within else []
        if self.within and self.within.circle:
            points.append(("within.circle.center", self.within.circle.center))
        if self.prior:
            points.append(("prior.position", self.prior.position))
        if self.listener:
            points.append(("listener", self.listener))
        return points


class PositionFields(Body):
    """A position with its reference system."""

    position: Point = Field(description="[x, y] in metres, or [lon, lat] with crs wgs84")
    crs: Crs = Field("map", description="the reference system of position")

    @model_validator(mode="after")
    def _is_on_earth(self) -> Self:
        check_degrees(self.crs, self.points())
        return self

    def points(self) -> list[tuple[str, Point]]:
        """Return the (x, y) or (lon, lat) of the request with the name of its field."""
        return [("position", self.position)]


class DescribeRequest(PositionFields):
    """A position to describe."""

    model_config = ConfigDict(json_schema_extra={"examples": [DESCRIBE_EXAMPLE]})

    deadline_ms: DeadlineMs = DEFAULT_DEADLINE_MS
    index: IndexName = DEFAULT_ALIAS


class CorrectionRequest(PositionFields):
    """A request to POST /localize and the true position of its speaker."""

    model_config = ConfigDict(json_schema_extra={"examples": [CORRECTION_EXAMPLE]})

    request: LocalizeRequest
    place_rank: Annotated[int, Strict(), Field(ge=1, le=MAX_PLACES)] | None = Field(
        None, description="which of the answer's places is right, from 1; null if none is"
    )


class EvaluateQuery(DescriptionFields):
    """A description and its true position: [x, y] in metres, or [lon, lat] with crs wgs84."""

    position: Point


class EvaluateRequest(Body):
    """Queries with known positions, or the name of a data set of the service."""

    model_config = ConfigDict(json_schema_extra={"examples": [EVALUATE_EXAMPLE], **QUERIES_OR_DATA})

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
