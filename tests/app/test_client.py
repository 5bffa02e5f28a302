import asyncio
import json
import subprocess
import sys

import httpx
import pytest
from fake_localizer import FakeLocalizer

from app import client as client_module
from app.client import AsyncClient, Client, ServiceError
from app.main import create_app
from app.settings import Settings

TEXT = "I am north of a gray building. A black pole is to my west."


@pytest.fixture(scope="module")
def url(in_a_thread):
    with in_a_thread(create_app(Settings(read_key="a-read-key"), FakeLocalizer)) as port:
        yield f"http://127.0.0.1:{port}"


def both(url, ask, **options):
    """Return the answers, or errors, of both kinds of client."""

    async def ask_async():
        async with AsyncClient(url, "a-read-key", **options) as client:
            return await ask(client)

    def outcome(work):
        try:
            return work()
        except ServiceError as error:
            return error

    with Client(url, "a-read-key", **options) as client:
        return outcome(lambda: ask(client)), outcome(lambda: asyncio.run(ask_async()))


def test_answers_are_typed(url):
    for result in both(url, lambda client: client.localize(TEXT, top_k=1)):
        assert result.status == "ok"
        assert result.estimate.wgs84.lat == 60.17
        assert result.candidates[0].cell_id == "fakeville_00001"
        assert len(result.candidates) == 1
    for described in both(url, lambda client: client.describe((24.94, 60.17), "wgs84")):
        assert described.place == "on Main Street"
    for info in both(url, lambda client: client.info()):
        assert info.key_required


def test_hints_and_options_arrive(url):
    options = {
        "prior": {"position": [1.0, 2.0], "sigma_m": 50.0}, "within": {"bbox": [-9.0, -9.0, 9.0, 9.0]},
        "refine": "posterior", "heat_map": True, "answers": {"q1": "yes"}, "deadline_ms": 5000, "index": "default",
    }  # fmt: skip
    for result in both(url, lambda client: client.localize(["a tree", "a pole"], **options)):
        assert result.status == "ok"


def test_polygons_and_ellipses_arrive(url):
    ring = [[24.9, 60.1], [25.0, 60.1], [24.9, 60.2], [24.9, 60.1]]
    ellipse = {"position": [24.94, 60.17], "semi_major_m": 90.0, "semi_minor_m": 30.0, "orientation_deg": 20.0}
    options = {"within": {"type": "Polygon", "coordinates": [ring]}, "prior": ellipse, "crs": "wgs84"}
    for result in both(url, lambda client: client.localize(TEXT, **options)):
        assert result.status == "ok"
    options["within"] = {"type": "Polygon", "coordinates": [ring[:3]]}
    for error in both(url, lambda client: client.localize(TEXT, **options)):
        assert error.errors[0]["field"] == "within.coordinates"


def test_what_is_refused_says_why(url):
    for error in both(url, lambda client: client.localize(TEXT, top_k=0)):
        assert (error.status, error.code) == (422, "invalid_request")
        assert error.errors[0]["field"] == "top_k"
        assert error.request_id
    with Client(url, "another-key") as client, pytest.raises(ServiceError, match="key_wrong"):
        client.localize(TEXT)


def test_nobody_there_says_so(monkeypatch):
    monkeypatch.setattr(client_module.time, "sleep", lambda _s: None)
    for error in both("http://127.0.0.1:9", lambda client: client.info(), tries=2):
        assert (error.status, error.code) == (0, "no_answer")
        assert "is the service running" in error.detail


def test_another_service_is_not_taken_for_this_one():
    other = httpx.MockTransport(lambda _request: httpx.Response(404, text="<html>"))
    with Client("http://x", transport=other) as client, pytest.raises(ServiceError, match="another service"):
        client.info()


@pytest.mark.parametrize(("status", "code"), [(429, "queue_full"), (503, "not_ready")])
def test_what_is_busy_is_asked_again_when_it_says(url, monkeypatch, status, code):
    waited = []
    monkeypatch.setattr(client_module.time, "sleep", waited.append)
    problem = {"code": code, "detail": "busy", "request_id": "r"}
    answers = [httpx.Response(status, json=problem, headers={"Retry-After": str(n)}) for n in (2, 90)]
    answers.append(httpx.Response(200, content=httpx.get(f"{url}/info").content))
    requests = []

    def answer(request):
        requests.append(json.loads(request.content or b"null"))
        return answers[len(requests) - 1]

    with Client("http://x", transport=httpx.MockTransport(answer)) as client:
        assert client.info().service == "hereabouts"
    assert waited == [2, 30]
    requests.clear()
    few = Client("http://x", tries=2, transport=httpx.MockTransport(answer))
    with few as client, pytest.raises(ServiceError, match=code):
        client.info()
    assert len(requests) == 2


def test_it_brings_no_torch():
    script = "import sys, app.client; assert not {'torch', 'faiss', 'transformers'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", script], check=True)
