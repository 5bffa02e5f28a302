"""The service as tools for agents (Model Context Protocol): find a person from what they say they see."""

from typing import Any, Final, Literal

from mcp.server import MCPServer
from mcp.server.mcpserver.exceptions import ToolError
from pydantic import BaseModel, Field

from app.client import AsyncClient, ServiceError
from app.http.formats.nominatim import apart
from app.http.schemas.responses import LocalizeResponse
from index.answering.answers import Candidate, Evidence, Question

INSTRUCTIONS: Final = """Finds where in a city somebody is from what they say is around them.
Call `localize` with their words. If it is not sure it gives a question: put it to them (or answer it yourself if you
know), then call `ask` with the same words and all answers so far, until there is no question. `describe_place` says in
words what is at a position."""
ALTERNATIVES: Final = 3


class Spot(BaseModel):
    """A place that it could be."""

    place: str | None = Field(None, description="in words")
    lat: float | None
    lon: float | None
    x: float = Field(description="metres east in the map")
    y: float = Field(description="metres north in the map")
    probability: float


class Asked(BaseModel):
    """A question to put to the person."""

    id: str
    text: str
    choices: dict[str, str] = Field(description="what to send as the answer, and what it means")
    may_be_another: bool = Field(description="whether words that are no choice may be sent too")


class Found(BaseModel):
    """Where the person is."""

    status: Literal["ok", "ambiguous", "no_match"]
    summary: str
    best: Spot | None
    within_m: float | None = Field(description="90 % sure that the person is no further from `best`")
    others: list[Spot]
    question: Asked | None
    understood: list[str] = Field(description="what was read in the words, each with what explains it")


class Described(BaseModel):
    """A position in words."""

    place: str | None
    description: str
    lat: float | None
    lon: float | None


def build_server(client: AsyncClient) -> MCPServer[Any]:
    """The server; its tools ask the service through a client."""
    server: MCPServer[Any] = MCPServer("hereabouts", instructions=INSTRUCTIONS, log_level="WARNING")

    async def locate(words: str, answers: dict[str, str], near: tuple[float, float] | None, near_m: float) -> Found:
        options: dict[str, Any] = {"answers": answers}
        if near is not None:
            options |= {"prior": {"position": [near[1], near[0]], "sigma_m": near_m}, "crs": "wgs84"}
        try:
            return found_of(await client.localize(words, **options))
        except ServiceError as error:
            raise ToolError(str(error)) from None

    @server.tool()
    async def localize(description: str, near: tuple[float, float] | None = None, near_m: float = 500.0) -> Found:
        """Where somebody is who says what is around them, in their own words: streets, shops, left and right.

        Args:
            description: their words, all of them, in English.
            near: (latitude, longitude) of a rough position, if one is known.
            near_m: how rough it is, metres.
        """
        return await locate(description, {}, near, near_m)

    @server.tool()
    async def ask(
        description: str,
        answers: dict[str, str],
        near: tuple[float, float] | None = None,
        near_m: float = 500.0,
    ) -> Found:
        """The same with answers to the questions so far; gives the next question, or none when there is enough.

        Args:
            description: the same words as before.
            answers: of every question so far its id, and the choice (or the words) that answers it.
            near: as `localize`.
            near_m: as `localize`.
        """
        return await locate(description, answers, near, near_m)

    @server.tool()
    async def describe_place(lat: float, lon: float) -> Described:
        """What somebody would see and say who stands at a position."""
        try:
            said = await client.describe((lon, lat), "wgs84")
        except ServiceError as error:
            raise ToolError(str(error)) from None
        at = said.wgs84
        return Described(place=said.place, description=said.description, lat=at and at.lat, lon=at and at.lon)

    return server


def found_of(said: LocalizeResponse) -> Found:
    """An answer of the service, as an agent reads it."""
    best, radius_m = None, None
    if said.estimate is not None:
        at, (x, y) = said.estimate.wgs84, said.estimate.position
        best = Spot(
            place=said.estimate.place, lat=at and at.lat, lon=at and at.lon, x=x, y=y,
            probability=said.estimate.probability,
        )  # fmt: skip
        radius_m = said.estimate.radius_m.p90
    positions = [one.position for one in said.candidates]
    if said.estimate is not None:
        positions.insert(0, said.estimate.position)
    others = [_other(said.candidates[n - 1]) for n in apart(positions)[1 : 1 + ALTERNATIVES]]
    return Found(
        status=said.status,
        summary=_summary(said, best, radius_m),
        best=best,
        within_m=radius_m,
        others=others,
        question=_question(said.question) if said.question else None,
        understood=[_understood(one) for one in said.evidence],
    )


def _other(one: Candidate) -> Spot:
    at, (x, y) = one.wgs84, one.position
    return Spot(lat=at and at.lat, lon=at and at.lon, x=x, y=y, probability=one.probability)


def _summary(said: LocalizeResponse, best: Spot | None, radius_m: float | None) -> str:
    if best is None or radius_m is None:
        return " ".join(["Not found.", *said.warnings])
    where = f"{best.lat}, {best.lon}" if best.lat is not None else f"{best.x:.0f}, {best.y:.0f} m in the map"
    sure = "Found" if said.status == "ok" else "Not sure; most likely"
    more = f" Ask: {said.question.text}" if said.question else ""
    return f"{sure}: {best.place or where} ({where}), within {radius_m:.0f} m (90 %).{more}"


def _understood(one: Evidence) -> str:
    explained = one.name or one.instance
    away = f", {one.away_m:.0f} m away" if one.away_m is not None else ""
    return f"{one.text}: {explained}{away}" if explained else f"{one.text}: nothing on the map explains it there"


def _question(question: Question) -> Asked:
    return Asked(
        id=question.id,
        text=question.text,
        choices={choice.value: choice.text for choice in question.choices},
        may_be_another=question.is_open,
    )
