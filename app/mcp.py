"""The service as tools for agents (Model Context Protocol)."""

import re
from collections.abc import Sequence
from importlib.metadata import version
from typing import Annotated, Any, Final, Literal

from mcp.server import MCPServer
from mcp.server.mcpserver.exceptions import ToolError
from mcp.server.transport_security import TransportSecuritySettings
from mcp_types import ToolAnnotations
from pydantic import BaseModel, BeforeValidator, Field

from app.client import AsyncClient, ServiceError
from app.http.schemas.responses import LocalizeResponse
from app.replies import choose
from index.answering.answers import LikelyPlace, Question
from index.answering.query import MAX_REPLIES

INSTRUCTIONS: Final = """Finds where in a city a person is from a description of what is around them, in any language.
Call `localize` with the person's words. If the position is uncertain, the result has a question: ask the person (or
answer it yourself if you know), then call `ask` with the same words and all answers so far, each in the person's own
words. Repeat until there is no question. Read the warnings. `describe_place` describes a position in words."""
READ_ONLY: Final = ToolAnnotations(read_only_hint=True, idempotent_hint=True, open_world_hint=False)
LOCAL_HOSTS: Final = ("127.0.0.1", "localhost", "[::1]")
_COORDINATES: Final = (("lat", "lon"), ("lat", "lng"), ("latitude", "longitude"))
_ARGUMENTS: Final = {
    "prior.position": "near",
    "prior.sigma_m": "near_m",
    "position": "lat, lon",
}  # by the service's names
_DEGREES = re.compile(
    r"(?:geo:)?\s*([+-]?\d{1,3}(?:\.\d+)?)\s*°?\s*([NS]?)\s*[\s,;]\s*([+-]?\d{1,3}(?:\.\d+)?)\s*°?\s*([EW]?)", re.I
)


def parse_lat_lon(value: object) -> object:
    """Return (latitude, longitude) of a text or an object; other values stay as they are."""
    if isinstance(value, dict):
        names = next((names for names in _COORDINATES if value.keys() == set(names)), ())
        return tuple(value[name] for name in names)
    if isinstance(value, str):
        if not (match := _DEGREES.fullmatch(" ".join(value.split()))):  # runs of spaces would take seconds
            raise ValueError('must be latitude and longitude in degrees, such as "60.165, 24.939"')
        lat, north, lon, east = match.groups()
        return float(lat) * (-1 if north.upper() == "S" else 1), float(lon) * (-1 if east.upper() == "W" else 1)
    return value


Near = Annotated[
    tuple[Annotated[float, Field(ge=-90, le=90)], Annotated[float, Field(ge=-180, le=180)]],
    BeforeValidator(parse_lat_lon, json_schema_input_type=str | tuple[float, float] | dict[str, float]),
]


class PossiblePlace(BaseModel):
    """A place where the person may be."""

    place: str | None = Field(None, description="the place in words")
    lat: float | None
    lon: float | None
    x: float = Field(description="metres east in the map frame")
    y: float = Field(description="metres north in the map frame")
    probability: float
    supports: list[str] = Field(description="what in the text speaks for it")
    contradicts: list[str] = Field(description="what in the text speaks against it")


class FollowUpQuestion(BaseModel):
    """A question to ask the person."""

    id: str
    text: str
    choices: dict[str, str] = Field(description="the possible answers, each with its text")
    may_be_another: bool = Field(description="whether any other name is an answer too")


class LocatedPerson(BaseModel):
    """The position of the person."""

    status: Literal["ok", "ambiguous", "no_match"]
    summary: str
    best: PossiblePlace | None
    within_m: float | None = Field(description="distance from `best` that is not exceeded with 90 % probability")
    others: list[PossiblePlace] = Field(description="at most four other places, likeliest first")
    question: FollowUpQuestion | None
    understood: list[str] = Field(description="the mentions in the text, each with how it fits `best`")
    warnings: list[str] = Field(description="what the service could not use")


class PlaceDescription(BaseModel):
    """A position in words."""

    place: str | None
    description: str
    lat: float | None
    lon: float | None


def build_server(client: AsyncClient) -> MCPServer[Any]:
    """Build the MCP server, whose tools call the service through a client."""
    server: MCPServer[Any] = MCPServer(
        "hereabouts", instructions=INSTRUCTIONS, version=version("hereabouts"), log_level="WARNING"
    )

    async def locate(words: str, replies: dict[str, str], near: Near | None, near_m: float) -> LocatedPerson:
        options: dict[str, Any] = {}
        if near is not None:
            options = {"prior": {"position": [near[1], near[0]], "sigma_m": near_m}, "crs": "wgs84"}
        if len(replies) > MAX_REPLIES:
            raise ToolError(f"answers: has {len(replies)} answers, but at most {MAX_REPLIES} are allowed")
        answers = dict[str, str]()
        try:
            answer = await client.localize(words, **options)
            # The service asks again what it asked before, so that each reply is read with the choices of its question.
            while len(answers) < len(replies):
                question = answer.question
                if question is None or question.id not in replies:
                    break
                answers[question.id] = _choice(question, replies[question.id])
                answer = await client.localize(words, answers=answers, **options)
            if len(answers) < len(replies):  # another text or position led to the questions that are left
                left = {name: _unlisted(name, reply) for name, reply in replies.items() if name not in answers}
                answer = await client.localize(words, answers=answers | left, **options)
        except ServiceError as error:
            raise _tool_error(error) from None
        return agent_answer(answer)

    @server.tool(annotations=READ_ONLY)
    async def localize(description: str, near: Near | None = None, near_m: float = 500.0) -> LocatedPerson:
        """Find a person from their own words about what is around them: streets, shops, left and right.

        Args:
            description: the person's words, complete and in their language; do not translate them.
            near: latitude and longitude of a rough position, if known: "60.165, 24.939", [60.165, 24.939] or
                {"lat": 60.165, "lon": 24.939}.
            near_m: standard deviation of the rough position in metres.
        """
        return await locate(description, {}, near, near_m)

    @server.tool(annotations=READ_ONLY)
    async def ask(
        description: str, answers: dict[str, str], near: Near | None = None, near_m: float = 500.0
    ) -> LocatedPerson:
        """Continue after `localize` with answers to all questions so far; returns the next question, if any.

        Args:
            description: the same words as before.
            answers: for each question so far, its id and the answer: a choice or the person's own words, such as
                "on Bulevardi", "nope", "the second one" or "I don't know".
            near: as in `localize`.
            near_m: as in `localize`.
        """
        return await locate(description, answers, near, near_m)

    @server.tool(annotations=READ_ONLY)
    async def describe_place(lat: float, lon: float) -> PlaceDescription:
        """Describe what a person at a position would see."""
        try:
            response = await client.describe((lon, lat), "wgs84")
        except ServiceError as error:
            raise _tool_error(error) from None
        wgs84 = response.wgs84
        return PlaceDescription(
            place=response.place,
            description=response.description,
            lat=wgs84 and wgs84.lat,
            lon=wgs84 and wgs84.lon,
        )

    return server


def allow_hosts(hosts: Sequence[str]) -> TransportSecuritySettings:
    """Accept HTTP requests to these hosts and this machine alone, which stops DNS rebinding."""
    allowed = [form for host in (*LOCAL_HOSTS, *hosts) for form in (host, f"{host}:*")]
    origins = [f"{scheme}://{host}" for host in allowed for scheme in ("http", "https")]
    return TransportSecuritySettings(allowed_hosts=allowed, allowed_origins=origins)


def _choice(question: Question, reply: str) -> str:
    value = choose(question, reply)
    if value is None:
        choices = ", ".join(choice.value for choice in question.choices)
        another = " or another name" if question.is_open else ""
        raise ToolError(f'answers: "{question.text}" has no clear answer; send one of: {choices}{another}')
    return value


def _unlisted(name: str, reply: str) -> str:
    """Return a reply without the choices of its question; ids of open questions have no colon."""
    return reply if ":" in name else choose(Question(name, "", (), is_open=True), reply) or reply


def _tool_error(error: ServiceError) -> ToolError:
    """Return an error that names the arguments of the tool."""
    problems = []
    for item in error.errors:
        name = _ARGUMENTS.get(item["field"], item["field"])
        is_position = item["field"] in ("prior.position", "position")
        problems.append(f"{name}: {'is not on the map, or swapped' if is_position else item['message']}")
    return ToolError(f"{error.code}: {'; '.join(problems)}" if problems else str(error))


def agent_answer(answer: LocalizeResponse) -> LocatedPerson:
    """Convert an answer of the service for an agent."""
    places = [_possible_place(place) for place in answer.places]
    best = places[0] if places else None
    radius_m = answer.estimate.radius_m.p90 if answer.estimate else None
    return LocatedPerson(
        status=answer.status,
        summary=_summary(answer, best, radius_m),
        best=best,
        within_m=radius_m,
        others=places[1:],
        question=_question(answer.question) if answer.question else None,
        understood=[one.fit for one in answer.evidence],
        warnings=list(answer.warnings),
    )


def _possible_place(place: LikelyPlace) -> PossiblePlace:
    wgs84, (x, y) = place.wgs84, place.position
    return PossiblePlace(
        place=place.place,
        lat=wgs84 and wgs84.lat,
        lon=wgs84 and wgs84.lon,
        x=x,
        y=y,
        probability=place.probability,
        supports=list(place.supports),
        contradicts=list(place.contradicts),
    )


def _summary(answer: LocalizeResponse, best: PossiblePlace | None, radius_m: float | None) -> str:
    parts = ["Not found."]
    if best is not None and radius_m is not None:
        where = f"{best.lat}, {best.lon}" if best.lat is not None else f"{best.x:.0f}, {best.y:.0f} m in the map frame"
        verdict = "Found" if answer.status == "ok" else "Not sure; most likely"
        parts = [f"{verdict}: {best.place or where} ({where}), within {radius_m:.0f} m (90 %)."]
    if answer.question:
        parts.append(f"Ask: {answer.question.text}")
    return " ".join([*parts, *answer.warnings])


def _question(question: Question) -> FollowUpQuestion:
    return FollowUpQuestion(
        id=question.id,
        text=question.text,
        choices={choice.value: choice.text for choice in question.choices},
        may_be_another=question.is_open,
    )
