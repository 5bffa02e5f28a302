"""What the service is asked. Numbers are strict and finite, unknown fields are refused."""

from typing import Annotated, Any, Self

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

from app.http.schemas.fields import (
    TOLD,
    Coordinate,
    IndexName,
    Length,
    Point,
    check_bbox,
    check_degrees,
    check_text,
    either,
    join_hints,
    wrong,
)
from app.settings import Settings
from index.answering.query import (
    DEFAULT_REFINE,
    DEFAULT_TOP_K,
    MOST_REPLIES,
    Box,
    Circle,
    Crs,
    Prior,
    Query,
    Refine,
    Reply,
)
from index.build.artifact import DEFAULT
from models.errors import DescriptionError
from models.language.sentences import split_hints

EXAMPLE: JsonValue = {"description": "I am north of a gray building. A black pole is to my west.", "top_k": 3}
DESCRIBE_EXAMPLE: JsonValue = {"position": [105.0, -35.0]}
MAX_ID = 1000  # characters; a name, and a question with four colours, are far shorter


class Body(BaseModel):
    """Of a request: fields that nobody knows are refused."""

    model_config = ConfigDict(extra="forbid")


class WithinCircle(Body):
    """A circle; `center` is [x, y] in metres, or [lon, lat] with crs wgs84."""

    center: Point
    radius_m: Length


class Within(Body):
    """A filter: nothing outside it is answered. Give `bbox` or `circle`."""

    model_config = ConfigDict(json_schema_extra=either("bbox", "array", "circle", "object"))

    bbox: Annotated[tuple[Coordinate, Coordinate, Coordinate, Coordinate], AfterValidator(check_bbox)] | None = Field(
        None, description="[west, south, east, north] in metres, or in degrees with crs wgs84"
    )
    circle: WithinCircle | None = None

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        if (self.bbox is None) == (self.circle is None):
            raise wrong("give either bbox or circle")
        return self

    def filter(self) -> Box | Circle:
        """As the localizer takes it."""
        if self.circle is not None:
            return Circle(self.circle.center, self.circle.radius_m)
        assert self.bbox is not None
        return Box(*self.bbox)


class PriorPosition(Body):
    """A bias, for example a poor GPS fix; `position` is [x, y] in metres, or [lon, lat] with crs wgs84."""

    position: Point
    sigma_m: Length

    def prior(self) -> Prior:
        """As the localizer takes it."""
        return Prior(self.position, self.sigma_m)


class GivenAnswer(Body):
    """An answer to the `question` of an earlier answer to the same description."""

    question: Annotated[str, Strict(), StringConstraints(min_length=1, max_length=MAX_ID)] = Field(description="its id")
    choice: Annotated[str, Strict(), StringConstraints(min_length=1, max_length=MAX_ID)] = Field(
        description="the value of one of its choices; to an open question also a name that is not listed"
    )


class Told(Body):
    """What somebody says; `told_fields` adds the limits of a service."""

    model_config = ConfigDict(json_schema_extra=TOLD)

    description: str | None
    hints: list[str] | None

    @model_validator(mode="after")
    def _is_one_text(self) -> Self:
        if (self.description is None) == (self.hints is None):
            raise wrong("give either description or hints", "description")
        return self

    def text(self) -> str:
        """All that is said, hints a line each."""
        return join_hints(self.hints or ()) if self.description is None else self.description


REFINE: Any = Field(
    DEFAULT_REFINE,
    description="posterior: hints are matched with the map; regressor: vector search, then a regressor; matching: "
    "vector search, then a network that matches hints with a cell's instances; none: vector search alone, cells' "
    "centres; these three rank by all of the retriever's levels only on an index that was built with --levels",
)


class LocalizeRequest(Told):
    """What to localize; `request_model` adds the limits of a service."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE], **TOLD})

    top_k: int
    within: Within | None = None
    prior: PriorPosition | None = None
    crs: Crs = Field("map", description="what the coordinates of within and prior mean")
    refine: Refine = REFINE
    heat_map: Annotated[bool, Strict()] = Field(False, description="the distribution behind the answer")
    ros: Annotated[bool, Strict()] = Field(False, description="the estimate as a pose of ROS too")
    answers: Annotated[list[GivenAnswer], Field(max_length=MOST_REPLIES)] = Field(
        [], description="to questions of earlier answers, all of them each time: the service remembers none"
    )
    deadline_ms: int
    index: IndexName = DEFAULT

    @model_validator(mode="after")
    def _is_on_earth(self) -> Self:
        check_degrees(self.crs, self.points())
        return self

    @model_validator(mode="after")
    def _asks_once(self) -> Self:
        if self.answers and self.refine != "posterior":
            raise wrong("goes with refine posterior; leave one of them out", "answers")
        asked = [answer.question for answer in self.answers]
        twice = next((n for n, one in enumerate(asked) if one in asked[:n]), None)
        if twice is not None:
            raise wrong("is answered twice; send one answer to each question", f"answers.{twice}.question")
        return self

    def query(self) -> Query:
        """As the localizer takes it."""
        return Query(
            description=self.text(),
            top_k=self.top_k,
            within=self.within.filter() if self.within else None,
            prior=self.prior.prior() if self.prior else None,
            crs=self.crs,
            refine=self.refine,
            heat_map=self.heat_map,
            replies=tuple(Reply(answer.question, answer.choice) for answer in self.answers),
        )

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


class DescribeRequest(Body):
    """What to describe; `describe_model` adds the limits of a service."""

    model_config = ConfigDict(json_schema_extra={"examples": [DESCRIBE_EXAMPLE]})

    position: Point = Field(description="[x, y] in metres, or [lon, lat] with crs wgs84")
    crs: Crs = Field("map", description="what the coordinates of position mean")
    deadline_ms: int
    index: IndexName = DEFAULT

    @model_validator(mode="after")
    def _is_on_earth(self) -> Self:
        check_degrees(self.crs, self.points())
        return self

    def points(self) -> list[tuple[str, Point]]:
        """The (x, y) or (lon, lat) of the request, with the name of its field."""
        return [("position", self.position)]


def told_fields(settings: Settings) -> dict[str, Any]:
    """The fields of `Told` with a service's limits."""
    text = Annotated[str, Strict(), StringConstraints(max_length=settings.max_characters), AfterValidator(check_text)]

    def check_sentences(said: str) -> str:
        try:
            count = len(split_hints(said))
        except DescriptionError as error:
            raise wrong(str(error)) from None
        if count > settings.max_hints:
            raise wrong(f"has {count} sentences, at most {settings.max_hints} are taken; shorten it")
        return said

    def check_together(hints: list[str]) -> list[str]:
        if sum(map(len, hints)) > settings.max_characters:
            raise wrong(f"have more than {settings.max_characters} characters together; send fewer or shorter ones")
        check_sentences(join_hints(hints))
        return hints

    hints = Annotated[list[text], Field(min_length=1, max_length=settings.max_hints), AfterValidator(check_together)]
    description = Annotated[text, AfterValidator(check_sentences)]
    return {
        "description": (description | None, Field(None, description="what is around the speaker, in plain words")),
        "hints": (hints | None, Field(None, description="the same in sentences, one hint each")),
    }


def request_model(settings: Settings) -> type[LocalizeRequest]:
    """LocalizeRequest with a service's limits in its fields, so that they are checked and in OpenAPI."""
    top_k = Annotated[int, Strict(), Field(ge=1, le=settings.max_top_k, description="candidates to list")]
    return create_model(
        "LocalizeRequest",
        __base__=LocalizeRequest,
        __doc__="One description, or its sentences as hints, and where to look.",
        **told_fields(settings),
        top_k=(top_k, min(DEFAULT_TOP_K, settings.max_top_k)),
        deadline_ms=_deadline(settings),
    )


def describe_model(settings: Settings) -> type[DescribeRequest]:
    """DescribeRequest with a service's limits in its fields."""
    return create_model(
        "DescribeRequest",
        __base__=DescribeRequest,
        __doc__="A position to describe.",
        deadline_ms=_deadline(settings),
    )


def _deadline(settings: Settings) -> tuple[Any, Any]:
    """The field of a deadline, with a service's limit and default."""
    deadline_ms = Annotated[int, Strict(), Field(ge=1, le=settings.max_deadline_ms)]
    return deadline_ms, Field(settings.deadline_ms, description="504 if there is no answer by then")
