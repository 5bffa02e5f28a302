from threading import Thread

import pytest
from fake_localizer import FakeLocalizer
from fastapi.testclient import TestClient

from app import main
from app.main import create_app
from app.settings import Settings
from models.errors import IndexBroken

TEXT = "I am north of a gray building. A black pole is to my west."


def test_answers_come_in_order_and_a_bad_item_fails_alone(api, fake):
    items = [
        {"description": TEXT, "top_k": 1},
        {"description": ""},
        {"description": "nowhere"},
        {"hints": ["a tree"], "top_k": 0},
        {"description": "a tree", "index": "paris"},
        {"description": "a tree", "crs": "wgs84", "prior": {"position": [24.9, 95.0], "sigma_m": 5.0}},
        {"description": "a bank", "unknown": 1},
        *("a tree", 5, None, [], True),
        {"description": "a tree", "within": {"type": "Polygon", "coordinates": [[[0, 0]]]}},
        {"description": "a tree"},
    ]
    response = api.post("/localize/batch", json={"items": items})
    assert response.status_code == 200
    batch_items = response.json()["items"]
    outcomes = [one["result"]["status"] if one["result"] else one["error"]["code"] for one in batch_items]
    assert outcomes == [
        "ok", "invalid_request", "no_match", "invalid_request", "index_not_found", "invalid_request",
        *["invalid_request"] * 7, "ok",
    ]  # fmt: skip
    assert len(batch_items[0]["result"]["candidates"]) == 1
    assert [one["error"]["errors"][0]["field"] for one in batch_items if one["error"] and one["error"]["errors"]] == [
        "description", "top_k", "prior.position", "unknown", *["(body)"] * 5, "within.coordinates",
    ]  # fmt: skip
    assert sorted(query.description for batch in fake.batches for query in batch) == sorted([TEXT, "nowhere", "a tree"])


@pytest.mark.parametrize("fault", ["bad", "nan"])
def test_a_fault_is_a_fault_of_all(api, problem, fault):
    body = {"items": [{"description": "a tree"}, {"description": fault}]}
    problem(api.post("/localize/batch", json=body), 500, "internal_error")


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({}, "items"),
        ({"items": []}, "items"),
        ({"items": [{}] * 65}, "items"),
        ({"items": {"description": "a tree"}}, "items"),
        ({"items": [{"description": "a tree"}], "more": 1}, "more"),
    ],
)
def test_a_body_that_is_no_batch_is_refused(api, problem, body, field):
    problem(api.post("/localize/batch", json=body), 422, "invalid_request", field)


def test_a_full_batch_does_not_crowd_the_queue(api, fake, until):
    fake.gate.clear()
    answers = []
    body = {"items": [{"description": f"a tree {n}"} for n in range(64)]}
    thread = Thread(target=lambda: answers.append(api.post("/localize/batch", json=body)))
    thread.start()
    queue = api.app.state.indexes.queue()
    until(lambda: queue.num_waiting + queue._computing == 4)
    fake.gate.set()
    thread.join(60)
    assert all(one["result"] for one in answers[0].json()["items"])


def test_items_of_an_index_that_answers_do_not_wait_for_one_that_cannot(monkeypatch, until, problem):
    def open_workers(spec, _count):
        if spec.index_dir.name == "v1":
            raise IndexBroken("cut short")
        return [FakeLocalizer()]

    async def check_version(_index_dir, _version):
        pass  # there are no files, which it would say soon or late

    monkeypatch.setattr(main, "open_workers", open_workers)
    monkeypatch.setattr(main, "check_version", check_version)
    monkeypatch.setattr(main, "_read_aliases", lambda _dir: {"default": "v1", "berlin": "v2"})
    here, there = {"description": TEXT}, {"description": TEXT, "index": "berlin"}
    with TestClient(create_app(Settings())) as api:
        until(lambda: api.post("/localize", json=there).status_code == 200)
        until(lambda: api.get("/readyz").json()["code"] == "load_failed")
        problem(api.post("/localize/batch", json={"items": [here]}), 503, "load_failed")
        batch_items = api.post("/localize/batch", json={"items": [here, there]}).json()["items"]
    assert batch_items[0]["error"]["code"] == "load_failed"
    assert batch_items[1]["result"]["status"] == "ok"
