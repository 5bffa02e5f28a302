"""Agents find a place by the tools, over every way to reach them."""

import asyncio
import os
import subprocess
import sys
import time
from dataclasses import replace
from importlib.metadata import version

import httpx
import jsonschema
import pytest
from fake_localizer import FakeLocalizer
from mcp import Client as Agent
from mcp import StdioServerParameters, stdio_client

from app.client import AsyncClient
from app.main import create_app
from app.mcp import build_server, parse_lat_lon
from app.settings import Settings
from index.answering.answers import Choice, Question

TEXT = "I am north of a gray building. A black pole is to my west."
QUESTION = Question("q-bank", "Do you see a bank?", (Choice("yes", "yes"), Choice("no", "no")), False)
STREETS = tuple(Choice(value, value) for value in ("Main Street", "Bulevardi", "unknown"))
STREET = Question("street", "Which street are you on?", STREETS, True)


class Asking(FakeLocalizer):
    """Not sure until somebody says whether there is a bank; of "streets" also which street it is."""

    def _answer(self, query):
        answer = replace(
            super()._answer(query), warnings=("I do not know 'xyz'",) if "xyz" in query.description else ()
        )
        if answer.estimate is None:
            return replace(
                answer, warnings=("nothing there",), question=STREET if "asked" in query.description else None
            )
        if "streets" in query.description and len(query.replies) == 1:
            return replace(answer, status="ambiguous", question=STREET)
        if query.replies:
            first, *others = answer.places
            return replace(answer, places=(replace(first, place="on Main Street"), *others))
        return replace(answer, status="ambiguous", question=QUESTION)


@pytest.fixture(scope="module")
def localizer():
    return Asking()


@pytest.fixture(scope="module")
def url(in_a_thread, localizer):
    with in_a_thread(create_app(Settings(), lambda: localizer)) as port:
        yield f"http://127.0.0.1:{port}"


async def session(agent):
    """An agent that finds somebody in three calls."""
    tools = {tool.name: tool for tool in (await agent.list_tools()).tools}
    first = (await agent.call_tool("localize", {"description": TEXT})).structured_content
    answers = {first["question"]["id"]: "yes"}
    second = (await agent.call_tool("ask", {"description": TEXT, "answers": answers})).structured_content
    where = {"lat": second["best"]["lat"], "lon": second["best"]["lon"]}
    third = (await agent.call_tool("describe_place", where)).structured_content
    return tools, first, second, third


def check(tools, first, second, third):
    assert set(tools) == {"localize", "ask", "describe_place"}
    assert all(tool.description and tool.output_schema for tool in tools.values())
    hints = [tool.annotations for tool in tools.values()]
    assert all(hint.read_only_hint and hint.idempotent_hint and hint.open_world_hint is False for hint in hints)
    assert first["status"] == "ambiguous"
    assert first["question"] == {
        "id": "q-bank", "text": "Do you see a bank?", "choices": {"yes": "yes", "no": "no"}, "may_be_another": False,
    }  # fmt: skip
    assert "Ask: Do you see a bank?" in first["summary"]
    assert (second["status"], second["question"]) == ("ok", None)
    assert second["best"]["place"] == "on Main Street"
    assert second["best"]["lat"] == pytest.approx(60.17)
    assert second["best"]["supports"] == ["tree: 3 m to the east"]
    assert [place["probability"] for place in second["others"]] == [0.1]
    assert second["within_m"] == 21
    assert third["place"] == "on Main Street"
    assert third["description"].startswith("A green tree")


@pytest.fixture
def call(url):
    """(tool, arguments) -> the result, over an agent's own client."""

    async def run(tool, arguments):
        async with AsyncClient(url) as client, Agent(build_server(client)) as agent:
            schemas = {tool.name: tool.input_schema for tool in (await agent.list_tools()).tools}
            jsonschema.validate(arguments, schemas[tool])  # as agents do before they call
            return await agent.call_tool(tool, arguments)

    return lambda tool, **arguments: asyncio.run(run(tool, arguments))


def test_an_agent_finds_a_place_in_three_calls(url):
    async def run():
        async with AsyncClient(url) as client, Agent(build_server(client)) as agent:
            return await session(agent)

    check(*asyncio.run(run()))


def test_the_command_speaks_to_an_agent_over_its_pipes(url):
    command = StdioServerParameters(
        command=sys.executable, args=["-m", "app.cli.main", "mcp", "--url", url], env=dict(os.environ)
    )

    async def run():
        async with Agent(stdio_client(command)) as agent:
            return await session(agent)

    check(*asyncio.run(run()))


def test_the_command_speaks_to_an_agent_over_http(url, until):
    import socket

    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "app.cli.main", "mcp", "--url", url, "--http-port", str(port)]
    command += ["--allowed-host", "maps.example"]
    server = subprocess.Popen(command, stderr=subprocess.DEVNULL)

    def is_there():
        with socket.socket() as client:
            return client.connect_ex(("127.0.0.1", port)) == 0

    async def run():
        async with Agent(f"http://127.0.0.1:{port}/mcp") as agent:
            return await session(agent)

    def status(**headers):
        ping = {"jsonrpc": "2.0", "id": 1, "method": "ping"}
        headers |= {"Accept": "application/json, text/event-stream"}
        return httpx.post(f"http://127.0.0.1:{port}/mcp", json=ping, headers=headers).status_code

    try:
        until(is_there)
        check(*asyncio.run(run()))
        assert status(host="evil.example") == 421
        assert status(origin="https://evil.example") == 403
        assert {status(host="maps.example", origin="https://maps.example"), status(host="localhost:1")} & {
            421,
            403,
        } == set()
    finally:
        server.terminate()
        server.wait(60)


def test_a_refusal_tells_the_agent_what_to_do(call):
    for refused, field in (
        (call("localize", description="..."), "description"),
        (call("describe_place", lat=0.0, lon=0.0), "invalid_request: lat, lon: is not on the map"),
        (call("localize", description=TEXT, near="60.17, 24.94", near_m=-1.0), "near_m"),
        (call("localize", description=TEXT, near=[24.94, 60.17]), "near: is not on the map, or swapped"),
        (call("ask", description=TEXT, answers={str(n): "yes" for n in range(9)}), "at most 8"),
    ):
        assert refused.is_error
        assert field in refused.content[0].text


def test_nothing_found_is_said(call):
    result = call("localize", description="nowhere").structured_content
    assert (result["status"], result["best"], result["question"]) == ("no_match", None, None)
    assert (result["summary"], result["warnings"]) == ("Not found. nothing there", ["nothing there"])
    other = call("localize", description="nowhere asked").structured_content
    assert other["question"]["id"] == "street"
    assert other["summary"] == "Not found. Ask: Which street are you on? nothing there"


def test_warnings_are_passed_on(call):
    result = call("localize", description=f"{TEXT} xyz").structured_content
    assert result["warnings"] == ["I do not know 'xyz'"]
    assert "I do not know 'xyz'" in result["summary"]


@pytest.mark.parametrize(
    "near",
    [
        "60.17, 24.94", "60.17 24.94", "geo:60.17,24.94", "60.17° N, 24.94° E", [60.17, 24.94], "[60.17, 24.94]",
        {"lat": 60.17, "lon": 24.94}, {"latitude": 60.17, "longitude": 24.94}, '{"lat": 60.17, "lon": 24.94}',
    ],
)  # fmt: skip
def test_a_rough_position_has_many_forms(call, localizer, near):
    assert not call("localize", description=TEXT, near=near, near_m=100.0).is_error
    query = localizer.batches[-1][0]
    assert (query.prior.position, query.prior.sigma_m, query.crs) == ((24.94, 60.17), 100.0, "wgs84")


@pytest.mark.parametrize(
    "near", ["here", "60.17", "91, 24.94", "60.17, 24.94, 3", "0x10, 1e999", "nan, nan", "{}", "60.17, 24.94\n60, 24"]
)
def test_other_positions_are_refused(call, near):
    refused = call("localize", description=TEXT, near=near)
    assert refused.is_error
    assert "near" in refused.content[0].text


def test_a_position_with_many_spaces_is_refused_at_once():
    start_s = time.process_time()
    with pytest.raises(ValueError, match="degrees"):
        parse_lat_lon(f"60.17{' ' * 4000}here")
    assert time.process_time() - start_s < 1


def test_replies_are_read_with_the_choices_of_their_questions(call, localizer):
    text = f"{TEXT} streets"
    result = call("ask", description=text, answers={"street": "the second one", "q-bank": "nope"}).structured_content
    assert (result["status"], result["question"]) == ("ok", None)
    sent = {reply.question: reply.choice for reply in localizer.batches[-1][0].replies}
    assert sent == {"q-bank": "no", "street": "Bulevardi"}


def test_an_unclear_reply_is_refused_with_the_choices(call):
    refused = call("ask", description=TEXT, answers={"q-bank": "purple"})
    assert refused.is_error
    assert 'answers: "Do you see a bank?" has no clear answer; send one of: yes, no' in refused.content[0].text


def test_a_reply_to_a_question_that_is_not_asked_is_sent_as_it_is(call, localizer):
    call("ask", description=TEXT, answers={"q-bank": "yes", "near:tree": "no", "corner": "at Main Street"})
    sent = {reply.question: reply.choice for reply in localizer.batches[-1][0].replies}
    assert sent == {"q-bank": "yes", "near:tree": "no", "corner": "main street"}


def test_the_server_has_the_version_of_the_package(url):
    async def run():
        async with AsyncClient(url) as client, Agent(build_server(client)) as agent:
            return agent.server_info

    assert asyncio.run(run()).version == version("hereabouts")
