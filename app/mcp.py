"""The service as tools for agents (Model Context Protocol)."""

from typing import Any, Final, Literal

from mcp.server import MCPServer
from mcp.server.mcpserver.exceptions import ToolError
from pydantic import BaseModel, Field

from app.client import AsyncClient, ServiceError
from app.http.schemas.responses import LocalizeResponse
from index.answering.answers import LikelyPlace, Question

INSTRUCTIONS: Final = """Finds where in a city a person is from a description of what is around them.
Call `localize` with the person's words. If the position is uncertain, the result has a question: ask the person (or
answer it yourself if you know), then call `ask` with the same words and all answers so far. Repeat until there is no
question. `describe_place` describes a position in words."""


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
    choices: dict[str, str] = Field(description="values to send as the answer, each with its text")
    may_be_another: bool = Field(description="whether another answer than the choices may be sent")


class LocatedPerson(BaseModel):
    """The position of the person."""

    status: Literal["ok", "ambiguous", "no_match"]
    summary: str
    best: PossiblePlace | None
    within_m: float | None = Field(description="distance from `best` that is not exceeded with 90 % probability")
    others: list[PossiblePlace] = Field(description="at most four other places, likeliest first")
    question: FollowUpQuestion | None
    understood: list[str] = Field(description="the mentions in the text, each with how it fits `best`")


class PlaceDescription(BaseModel):
    """A position in words."""

    place: str | None
    description: str
    lat: float | None
    lon: float | None


def build_server(client: AsyncClient) -> MCPServer[Any]:
    """Build the MCP server, whose tools call the service through a client."""
    server: MCPServer[Any] = MCPServer("hereabouts", instructions=INSTRUCTIONS, log_level="WARNING")

    async def locate(
        words: str, answers: dict[str, str], near: tuple[float, float] | None, near_m: float
    ) -> LocatedPerson:
        options: dict[str, Any] = {"answers": answers}
        if near is not None:
            options |= {"prior": {"position": [near[1], near[0]], "sigma_m": near_m}, "crs": "wgs84"}
        try:
            return agent_answer(await client.localize(words, **options))
        except ServiceError as error:
            raise ToolError(str(error)) from None

    @server.tool()
    async def localize(
        description: str, near: tuple[float, float] | None = None, near_m: float = 500.0
    ) -> LocatedPerson:
        """Find a person from their own words about what is around them: streets, shops, left and right.

        Args:
            description: the person's words, complete and in English.
            near: (latitude, longitude) of a rough position, if known.
            near_m: standard deviation of the rough position in metres.
        """
        return await locate(description, {}, near, near_m)

    @server.tool()
    async def ask(
        description: str, answers: dict[str, str], near: tuple[float, float] | None = None, near_m: float = 500.0
    ) -> LocatedPerson:
        """Continue after `localize` with answers to all questions so far; returns the next question, if any.

        Args:
            description: the same words as before.
            answers: for each question so far, its id and the chosen value (or the person's own words).
            near: as in `localize`.
            near_m: as in `localize`.
        """
        return await locate(description, answers, near, near_m)

    @server.tool()
    async def describe_place(lat: float, lon: float) -> PlaceDescription:
        """Describe what a person at a position would see."""
        try:
            response = await client.describe((lon, lat), "wgs84")
        except ServiceError as error:
            raise ToolError(str(error)) from None
        wgs84 = response.wgs84
        return PlaceDescription(
            place=response.place,
            description=response.description,
            lat=wgs84 and wgs84.lat,
            lon=wgs84 and wgs84.lon,
        )

    return server


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
    if best is None or radius_m is None:
        return " ".join(["Not found.", *answer.warnings])
    where = f"{best.lat}, {best.lon}" if best.lat is not None else f"{best.x:.0f}, {best.y:.0f} m in the map frame"
    verdict = "Found" if answer.status == "ok" else "Not sure; most likely"
    question = f" Ask: {answer.question.text}" if answer.question else ""
    return f"{verdict}: {best.place or where} ({where}), within {radius_m:.0f} m (90 %).{question}"


def _question(question: Question) -> FollowUpQuestion:
    return FollowUpQuestion(
        id=question.id,
        text=question.text,
        choices={choice.value: choice.text for choice in question.choices},
        may_be_another=question.is_open,
    )
