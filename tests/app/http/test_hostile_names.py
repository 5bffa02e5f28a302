"""Attacks as names on the map leave the service as plain text in JSON, which no browser takes for anything else."""

import asyncio
import json
from xml.etree.ElementTree import fromstring

import httpx
import pytest
from mcp import Client as Agent

from app.client import AsyncClient
from app.main import create_app
from app.mcp import build_server
from app.settings import Settings
from tests.app.hostile import KINDS, MAP, PLACES, SCRIPT, STREETS, hostile_index

pytestmark = pytest.mark.slow  # the weights that ship

NUMBER = next(tags["addr:housenumber"] for *_, tags in PLACES if "addr:housenumber" in tags)


@pytest.fixture(scope="module")
def url(made_once, in_a_thread, warm_workers):
    with in_a_thread(create_app(Settings(index_dir=hostile_index(made_once), workers=1))) as port:
        yield f"http://127.0.0.1:{port}"


@pytest.fixture
def here(url):
    with httpx.Client(base_url=url, timeout=60) as here:
        yield here


def plain(response):
    """The body of a response that is nothing but JSON."""
    kind = response.headers["content-type"]
    assert kind in ("application/json", "application/geo+json", "application/problem+json")
    assert response.headers["x-content-type-options"] == "nosniff"
    assert response.headers["content-security-policy"] == "default-src 'none'; frame-ancestors 'none'"
    return response.json()


@pytest.mark.parametrize(("kind", "name"), KINDS.items())
def test_answers_in_all_forms_have_the_name_to_the_letter(here, kind, name):
    text = f"I am on the street, right outside a {kind}."
    answer = plain(here.post("/localize", json={"description": text}))
    assert name in answer["estimate"]["place"]
    assert [one["name"] for one in answer["evidence"]] == [name]
    [item] = plain(here.post("/localize/batch", json={"items": [{"description": text}]}))["items"]
    assert item["result"]["estimate"]["place"] == answer["estimate"]["place"]
    drawn = plain(here.post("/localize", json={"description": text}, headers={"Accept": "application/geo+json"}))
    assert answer["estimate"]["place"] in [feature["properties"].get("place") for feature in drawn["features"]]
    for form in ("json", "jsonv2", "geojson"):
        result = plain(here.get("/search", params={"q": text, "format": form}))
        first = result["features"][0]["properties"] if form == "geojson" else result[0]
        assert first["display_name"] == answer["estimate"]["place"]


@pytest.mark.parametrize("place", [place for place in PLACES if place[2] in KINDS.values()], ids=lambda place: place[2])
def test_what_is_said_of_a_place_has_its_name_to_the_letter(here, place):
    x, y, name, _ = place
    position = (x - 150, y - 150)
    described = plain(here.post("/describe", json={"position": position}))
    assert name in described["description"]
    assert name in [fact["name"] for fact in described["hints"]]
    where = {"lat": described["wgs84"]["lat"], "lon": described["wgs84"]["lon"]}
    result = plain(here.get("/reverse", params={**where, "format": "jsonv2"}))
    assert name in result["display_name"]
    assert name in fromstring(here.get("/reverse", params=where).content).findtext("result")
    assert name in result["extratags"]["description"]


def test_questions_offer_the_names_to_the_letter_and_take_them(here):
    body = {"description": "There is a tree to my north. There is a bench to my east."}
    question = plain(here.post("/localize", json=body))["question"]
    hostile = [choice for choice in question["choices"] if choice["text"] in STREETS]
    assert hostile, "else this tests nothing"
    reply = {"question": question["id"], "choice": hostile[0]["value"]}
    assert hostile[0]["text"] in plain(here.post("/localize", json=body | {"answers": [reply]}))["estimate"]["place"]
    house = {"question": "address", "choice": f"{NUMBER} {STREETS[1]}"}
    assert plain(here.post("/localize", json=body | {"answers": [house]}))["status"] in ("ok", "ambiguous")


def test_a_map_with_such_a_name_is_reached_by_it(here):
    info = plain(here.get("/info"))
    assert info["index"]["provenance"]["map"] == MAP
    [cell] = plain(here.get("/cells", params={"limit": 1}))["cells"]
    assert cell["cell_id"].startswith(MAP)
    assert plain(here.get(f"/cells/{cell['cell_id']}"))["scene"] == MAP
    points = here.get(f"/maps/{MAP}/points")
    assert (points.status_code, points.headers["x-content-type-options"]) == (200, "nosniff")
    assert "html" not in points.headers["content-type"]
    assert SCRIPT in points.text, "names come with the map"


@pytest.mark.parametrize("attack", KINDS.values())
def test_a_refusal_says_nothing_of_what_was_sent(here, attack):
    refusals = [
        here.post("/localize", json={"description": "a tree", attack: attack, "index": attack, "refine": attack}),
        here.post("/localize", json={"description": "a tree", "answers": [{"question": attack, "choice": attack}]}),
        here.get("/search", params={"q": "a tree", "viewbox": attack, "format": attack, "limit": attack}),
        here.get(f"/cells/{attack}"),
        here.get("/reverse", params={"lat": attack, "lon": attack, "index": attack}),
    ]
    for refusal in refusals:
        assert refusal.status_code in (404, 422)
        assert "hacked" not in json.dumps(plain(refusal))
        assert not any("hacked" in value for value in refusal.headers.values())


def test_agents_read_the_names_to_the_letter(url):
    async def run():
        async with AsyncClient(url) as client, Agent(build_server(client)) as agent:
            result, described = [], []
            for kind in KINDS:
                arguments = {"description": f"I am on the street, right outside a {kind}."}
                result.append((await agent.call_tool("localize", arguments)).structured_content)
                where = {"lat": result[-1]["best"]["lat"], "lon": result[-1]["best"]["lon"]}
                described.append((await agent.call_tool("describe_place", where)).structured_content)
            return result, described

    for name, result, described in zip(KINDS.values(), *asyncio.run(run()), strict=True):
        assert name in result["best"]["place"]
        assert name in result["summary"]
        assert result["understood"][0].split(": ", 1)[1].startswith(name)
        assert name in described["description"]
