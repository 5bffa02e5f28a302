"""Every status and code that the OpenAPI document promises is provoked here, and it promises what is provoked."""

import asyncio
import errno
import gzip
from contextlib import ExitStack
from functools import partial

import httpx
import pytest
from fake_localizer import FakeLocalizer
from good_requests import GOOD, JSON, WITH_BODY, ask
from service_states import Services, raises

from app import limits, main
from app.http import bodies, queue
from app.http.routes import corrections
from app.jobs import store
from app.jobs.runner import EvaluationJobs
from app.main import create_app
from app.settings import Settings
from models.citymap.frame import Frame
from models.citymap.scenery.files import SceneryPart
from models.errors import StoreUnavailable

READ = "read-key-1"
GEO, PICTURE = {"Accept": "application/geo+json"}, {"Accept": "image/png"}
GEOCODER = ("GET /search", "GET /reverse", "GET /lookup", "GET /status")
CORRECTIONS, BATCH = "POST /corrections", "POST /localize/batch"
CSV = {"Content-Type": "text/csv"}
QUEUED = ("POST /localize", "POST /localize/batch", "POST /describe", "POST /evaluate", *GEOCODER, CORRECTIONS)
DRAWN = ("GET /cells", "GET /cells/{cell_id}")
CACHED = (*DRAWN, "GET /maps/{name}/points")
OF_MAP = (*CACHED, "GET /maps/{name}")
OF_ONE_INDEX = (*(operation for operation in QUEUED if operation not in ("POST /localize/batch", CORRECTIONS)), *OF_MAP)
OF_JOB = ("GET /evaluate/{job}", "DELETE /evaluate/{job}", "GET /evaluate/{job}/events")
OPEN = ("GET /healthz", "GET /readyz", "GET /metrics", "GET /info")
CLOSED = tuple(operation for operation in GOOD if operation not in OPEN)
WORK = {  # what a localizer does for an operation
    "POST /localize": "localize",
    "POST /localize/batch": "localize",
    "POST /describe": "describe",
    "GET /search": "localize",
    "GET /reverse": "describe",
    "GET /lookup": "position_of",
    "GET /cells": "cells",
    "GET /cells/{cell_id}": "cell",
    "GET /maps/{name}/points": "scenery",
}
PROVOKED = {}  # (operation, status, code or None) -> what provokes it: (services, operation, monkeypatch) -> response


def provokes(status, code, *operations):
    def note(function):
        assert not PROVOKED.keys() & {(operation, status, code) for operation in operations}
        PROVOKED.update({(operation, status, code): function for operation in operations})
        return function

    return note


@pytest.fixture(scope="module")
def services(until, versions_dir, tmp_path_factory):
    part = tmp_path_factory.mktemp("parts") / "0.gz"
    part.write_bytes(gzip.compress(b"geometry", mtime=0))
    with ExitStack() as stack, pytest.MonkeyPatch.context() as patch:
        patch.setattr(main, "EvaluationJobs", partial(EvaluationJobs, command=("true",)))
        yield Services(stack, until, versions_dir, SceneryPart(part, "ab" * 32))


def of_index(api, operation, name):
    where = "json" if operation in WITH_BODY else "params"
    return ask(api, operation, **{where: GOOD[operation].get(where, {}) | {"index": name}})


@provokes(202, None, "POST /evaluate")
@provokes(200, None, *(op for op in GOOD if op not in ("POST /evaluate", CORRECTIONS, *OF_JOB)))
def good_request(services, operation, patch):
    return ask(services(), operation)


@provokes(201, None, CORRECTIONS)
def correction(services, operation, patch):
    return ask(services("correcting", corrections_file=services.root / "corrections.jsonl"), operation)


@provokes(200, None, *OF_JOB)
def job_that_is_there(services, operation, patch):
    job = ask(services(), "POST /evaluate").json()["job"]
    return ask(services(), operation, {"job": job})


@provokes(304, None, *CACHED)
def client_has_it(services, operation, patch):
    return ask(services(), operation, headers={"If-None-Match": "*"})


@provokes(400, "invalid_json", *WITH_BODY)
def body_cut_short(services, operation, patch):
    return ask(services(), operation, content=b"{", headers=JSON)


@provokes(401, "key_required", *CLOSED)
def no_key(services, operation, patch):
    return ask(services(read_key=READ), operation)


@provokes(401, "key_wrong", *CLOSED)
def another_key(services, operation, patch):
    return ask(services(read_key=READ), operation, headers={"X-API-Key": "another-key"})


@provokes(403, "key_not_set", "POST /evaluate", CORRECTIONS, "DELETE /evaluate/{job}")
def forwarded_request(services, operation, patch):
    return ask(services(), operation, headers={"X-Forwarded-For": "192.0.2.1"})


@provokes(404, "index_not_found", *OF_ONE_INDEX)
def another_index(services, operation, patch):
    return of_index(services(), operation, "paris")


def table(services, **params):
    return ask(services, BATCH, params={"text": "a", **params}, content=b"a\r\na tree\r\n", headers=CSV)


@provokes(404, "index_not_found", BATCH)
def another_index_of_a_table(services, operation, patch):
    return table(services(), index="paris")


@provokes(406, "no_georeference", BATCH)
def table_of_a_map_that_is_nowhere(services, operation, patch):
    return table(services("nowhere", lambda: FakeLocalizer(Frame())))


@provokes(404, "index_not_found", CORRECTIONS)
def another_index_in_a_request(services, operation, patch):
    return ask(services(), operation, json={"request": {"description": "a", "index": "paris"}, "position": [0, 0]})


@provokes(404, "corrections_off", CORRECTIONS)
def service_without_a_file(services, operation, patch):
    return ask(services(), operation)


@provokes(404, "cell_not_found", "GET /cells/{cell_id}")
@provokes(404, "map_not_found", "GET /maps/{name}", "GET /maps/{name}/points")
@provokes(404, "job_not_found", *OF_JOB)
def another_name(services, operation, patch):
    return ask(services(), operation, {"cell_id": "none", "name": "none", "job": "none"})


@provokes(406, "not_acceptable", "POST /localize", *DRAWN)
def another_format(services, operation, patch):
    return ask(services(), operation, headers=PICTURE)


@provokes(406, "no_georeference", "POST /localize", *GEOCODER[:3], *DRAWN)
def map_that_is_nowhere(services, operation, patch):
    return ask(services("nowhere", lambda: FakeLocalizer(Frame())), operation, headers=GEO)


@provokes(408, "body_too_slow", *WITH_BODY)
def body_that_does_not_come(services, operation, patch):
    patch.setattr(bodies, "BODY_TIMEOUT_S", 0.01)

    async def late():
        await asyncio.sleep(60)
        yield b""

    async def send(app):
        async with httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://127.0.0.1") as client:
            return await ask(client, operation, content=late(), headers=JSON)

    return asyncio.run(send(services().app))


@provokes(409, "index_broken", "GET /indexes")
def broken_aliases(services, operation, patch):
    torn = services.root / "torn"
    torn.mkdir(exist_ok=True)
    (torn / "aliases.json").write_text("{")
    return ask(services(index_dir=torn), operation)


@provokes(409, "not_writable", "POST /evaluate")
def full_disk_of_jobs(services, operation, patch):
    patch.setattr(store.JobStore, "add", raises(OSError(errno.ENOSPC, "full")))
    return ask(services(), operation)


@provokes(409, "not_writable", CORRECTIONS)
def file_that_is_a_directory(services, operation, patch):
    return ask(services("broken", corrections_file=services.root), operation)


@provokes(413, "body_too_large", *WITH_BODY)
def body_above_the_limit(services, operation, patch):
    for limit in ("BODY", "BATCH_BODY", "EVALUATE_BODY"):
        patch.setattr(limits, f"MAX_{limit}_BYTES", 1)  # read when the service starts
    return ask(services("small"), operation)


@provokes(415, "unsupported_media_type", *WITH_BODY)
def body_of_a_form(services, operation, patch):
    return ask(services(), operation, headers={"Content-Type": "application/x-www-form-urlencoded"})


@provokes(422, "invalid_request", *WITH_BODY)
def unknown_field(services, operation, patch):
    return ask(services(), operation, json={"unknown": 1})


@provokes(422, "invalid_request", *GEOCODER, *OF_MAP)
def index_that_is_no_name(services, operation, patch):
    return of_index(services(), operation, "../x")


@provokes(429, "queue_full", "POST /localize", "GET /search")
def queue_without_a_place(services, operation, patch):
    patch.setattr(queue, "REFUSAL_DELAY_S", 0)
    patch.setattr(services().app.state.indexes.queue(), "_max_queue", 0)
    return ask(services(), operation)


@provokes(429, "jobs_full", "POST /evaluate")
def jobs_without_a_place(services, operation, patch):
    patch.setattr(services().app.state.jobs, "_max_waiting", 0)
    return ask(services(), operation)


@provokes(429, "bodies_full", *WITH_BODY)
def memory_without_a_place(services, operation, patch):
    patch.setattr(bodies, "MAX_LARGE_BODIES", 0)  # read when the service starts
    return ask(services("crowded"), operation, content=b" " * 65_536, headers=JSON)


@provokes(500, "internal_error", *WORK)
def fault_of_the_localizer(services, operation, patch):
    patch.setattr(services.fake, WORK[operation], raises(RuntimeError("a fault")))
    return ask(services(), operation)


@provokes(500, "internal_error", "POST /evaluate")
def fault_of_the_store(services, operation, patch):
    patch.setattr(store.JobStore, "add", raises(RuntimeError("a fault")))
    return ask(services(), operation)


@provokes(500, "internal_error", CORRECTIONS)
def fault_of_the_file(services, operation, patch):
    patch.setattr(corrections, "append_line", raises(RuntimeError("a fault")))
    return correction(services, operation, patch)


@provokes(503, "not_ready", *QUEUED, *OF_MAP, "GET /readyz")
def index_that_is_being_opened(services, operation, patch):
    return ask(services.loading(), operation)


@provokes(503, "load_failed", *QUEUED, *OF_MAP, "GET /readyz")
def index_that_cannot_be_opened(services, operation, patch):
    return ask(services.failed(), operation)


@provokes(503, "store_unavailable", "POST /localize", "GET /search")
def vectors_that_cannot_be_asked(services, operation, patch):
    patch.setattr(services.fake, "localize", raises(StoreUnavailable("Milvus is down")))
    response = ask(services(), operation)
    assert response.headers["Retry-After"] == "2"
    return response


@provokes(503, "draining", *QUEUED, "GET /readyz")
def service_that_ends(services, operation, patch):
    return ask(services.draining(), operation)


@provokes(504, "deadline_exceeded", "POST /localize", "POST /describe", "GET /search")
def slow_localizer(services, operation, patch):
    patch.setattr(limits, "DEFAULT_DEADLINE_MS", 50)  # of GET /search, which takes none
    late = {"json": GOOD[operation]["json"] | {"deadline_ms": 50}} if operation in WITH_BODY else {}
    api = services()
    services.fake.gate.clear()
    try:
        return ask(api, operation, **late)
    finally:
        services.fake.gate.set()


@pytest.mark.parametrize(
    ("operation", "status", "code"), PROVOKED, ids=[f"{op} {status} {code}" for op, status, code in PROVOKED]
)
def test_it_is_answered(services, monkeypatch, problem, operation, status, code):
    response = PROVOKED[operation, status, code](services, operation, monkeypatch)
    if code is None:
        assert response.status_code == status, response.text
    else:
        problem(response, status, code)


def promised(**settings):
    """(operation, status, code or None) of all that a document lists."""
    documented = set()
    for path, operations in create_app(Settings(**settings)).openapi()["paths"].items():
        for method, operation in operations.items():
            for status, response in operation["responses"].items():
                if int(status) < 400:
                    codes = [None]
                else:
                    codes = response["content"]["application/problem+json"]["examples"]
                    assert codes, (method, path, status)
                documented |= {(f"{method.upper()} {path}", int(status), code) for code in codes}
    return documented


def test_the_document_promises_what_is_provoked_and_nothing_else():
    assert promised(read_key=READ) == set(PROVOKED)
    assert promised() == {key for key in PROVOKED if key[1] != 401}
