"""Agents find a place by the tools, over every way to reach them."""

import asyncio
import os
import subprocess
import sys
from dataclasses import replace

import pytest
from fake_localizer import FakeLocalizer
from mcp import Client as Agent
from mcp import StdioServerParameters, stdio_client

from app.client import AsyncClient
from app.main import create_app
from app.mcp import build_server
from app.settings import Settings
from index.answering.answers import Choice, Question

TEXT = "I am north of a gray building. A black pole is to my west."
QUESTION = Question("q-bank", "Do you see a bank?", (Choice("yes", "yes"), Choice("no", "no")), False)


class Asking(FakeLocalizer):
    """Not sure until somebody says whether there is a bank."""

    def _answer(self, query):
        answer = super()._answer(query)
        if answer.estimate is None:
            return answer
        if query.replies:
            first, *others = answer.places
            return replace(answer, places=(replace(first, place="on Main Street"), *others))
        return replace(answer, status="ambiguous", question=QUESTION)


@pytest.fixture(scope="module")
def url(in_a_thread):
    with in_a_thread(create_app(Settings(), Asking)) as port:
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
    server = subprocess.Popen(command, stderr=subprocess.DEVNULL)

    def is_there():
        with socket.socket() as client:
            return client.connect_ex(("127.0.0.1", port)) == 0

    async def run():
        async with Agent(f"http://127.0.0.1:{port}/mcp") as agent:
            return await session(agent)

    try:
        until(is_there)
        check(*asyncio.run(run()))
    finally:
        server.terminate()
        server.wait(60)


def test_a_refusal_tells_the_agent_what_to_do(url):
    async def run():
        async with AsyncClient(url) as client, Agent(build_server(client)) as agent:
            return await agent.call_tool("localize", {"description": "..."}), await agent.call_tool(
                "describe_place", {"lat": 0.0, "lon": 0.0}
            )

    for refused in asyncio.run(run()):
        assert refused.is_error
        assert "invalid_request" in refused.content[0].text


def test_nothing_found_is_said(url):
    async def run():
        async with AsyncClient(url) as client, Agent(build_server(client)) as agent:
            return (await agent.call_tool("localize", {"description": "nowhere"})).structured_content

    result = asyncio.run(run())
    assert (result["status"], result["best"]) == ("no_match", None)
    assert result["summary"] == "Not found. nothing there"


def test_a_rough_position_is_a_bias(url):
    async def run():
        async with AsyncClient(url) as client, Agent(build_server(client)) as agent:
            arguments = {"description": TEXT, "near": [60.17, 24.94], "near_m": 100.0}
            return await agent.call_tool("localize", arguments)

    assert not asyncio.run(run()).is_error
