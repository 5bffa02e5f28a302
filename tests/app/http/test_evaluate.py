"""Requests that POST /evaluate accepts and refuses; nothing is run."""

import json
from pathlib import Path

import pytest
from fake_localizer import TRUE_FRAME, FakeLocalizer

from app import limits as limits_module
from app.http.schemas.requests import EvaluateRequest
from app.jobs import runner
from app.jobs.evaluation import build_evaluation, find_data, read_evaluation
from app.settings import Settings
from models.citymap.frame import Frame
from models.errors import DataError

QUERY = {"description": "I am north of a gray building. A pole is to my west.", "position": [1.0, 2.0]}


@pytest.fixture
def submitted(monkeypatch):
    """The evaluations that reached the jobs, which run nothing."""
    evaluations = []

    async def submit(self, evaluation):
        from app.jobs.job import EvaluationJob

        evaluations.append(evaluation)
        return EvaluationJob(Path("/nowhere"))

    monkeypatch.setattr(runner.EvaluationJobs, "submit", submit)
    return evaluations


@pytest.fixture
def data_dir(tmp_path):
    for name in ("town.osm", "city.osm.pbf", "notes.txt", ".hidden.osm"):
        (tmp_path / "data" / name).parent.mkdir(exist_ok=True)
        (tmp_path / "data" / name).touch()
    (tmp_path / "data" / "kitti").mkdir()
    (tmp_path / "outside.osm").touch()
    return tmp_path / "data"


def test_queries_become_texts_and_metres(api, submitted):
    body = {"queries": [QUERY, {"hints": [" a tree "], "position": [3, 4]}], "grow": [200, 300.5]}
    response = api.post("/evaluate", json=body)
    assert response.status_code == 202
    accepted = response.json()
    assert response.headers["location"] == accepted["links"]["status"] == f"/evaluate/{accepted['job']}"
    assert accepted["links"]["events"] == f"/evaluate/{accepted['job']}/events"
    assert accepted["status"] == "queued"
    [evaluation] = submitted
    assert evaluation.descriptions == ["I am north of a gray building. A pole is to my west.", " a tree "]
    assert evaluation.positions_m == [(1, 2), (3, 4)]
    assert evaluation.grow_m == [200, 300.5]
    assert evaluation.index_dir.is_absolute()


def test_wgs84_is_projected(api, submitted):
    body = {"queries": [QUERY | {"position": [24.941, 60.171]}, QUERY | {"position": [24.94, 60.17]}], "crs": "wgs84"}
    assert api.post("/evaluate", json=body).status_code == 202
    assert submitted[0].positions_m[0] == pytest.approx((55.5, 111.4), abs=0.2)
    assert submitted[0].positions_m[1] == pytest.approx((0, 0), abs=1e-6)


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({}, "queries"),
        ({"queries": []}, "queries"),
        ({"queries": [QUERY], "data": "town"}, "queries"),
        ({"queries": [QUERY], "split": "test"}, "split"),
        ({"data": "town", "crs": "map"}, "crs"),
        ({"queries": [QUERY, QUERY | {"position": [1]}]}, "queries[1].position[1]"),
        ({"queries": [QUERY | {"position": [1, "2"]}]}, "queries[0].position[1]"),
        ({"queries": [QUERY | {"position": [1, True]}]}, "queries[0].position[1]"),
        ({"queries": [QUERY | {"position": [1, 1e9]}]}, "queries[0].position[1]"),
        ({"queries": [QUERY | {"description": " . "}]}, "queries[0].description"),
        ({"queries": [QUERY | {"description": "a\u0085tree"}]}, "queries[0].description"),
        ({"queries": [QUERY | {"description": "A tree. " * 201}]}, "queries[0].description"),
        ({"queries": [QUERY | {"description": "a" * 4001}]}, "queries[0].description"),
        ({"queries": [QUERY | {"hints": ["a tree"]}]}, "queries[0].description"),
        ({"queries": [{"position": [1, 2]}]}, "queries[0].description"),
        ({"queries": [{"description": "a tree"}]}, "queries[0].position"),
        ({"queries": [{"hints": ["a"] * 33, "position": [1, 2]}]}, "queries[0].hints"),
        ({"queries": [QUERY | {"pose": 1}]}, "queries[0].pose"),
        ({"queries": [QUERY], "path": "/etc"}, "path"),
        ({"queries": [QUERY] * 10_001}, "queries"),
        ({"queries": [QUERY], "crs": "utm"}, "crs"),
        ({"queries": [QUERY, QUERY | {"position": [181, 2]}], "crs": "wgs84"}, "queries[1].position"),
        ({"queries": [QUERY, QUERY | {"position": [115, 0]}], "crs": "wgs84"}, "queries[1].position"),
        ({"queries": [QUERY], "grow": [0]}, "grow[0]"),
        ({"queries": [QUERY], "grow": []}, "grow"),
        ({"queries": [QUERY], "grow": list(range(1, 10))}, "grow"),
        ({"data": "town", "split": "../x"}, "split"),
        ({"data": "town"}, "data"),
    ],
)
def test_what_cannot_be_used_is_named(refused, body, field):
    fields, message = refused(
        lambda body: build_evaluation(EvaluateRequest.model_validate(body), Settings(), Path("/nowhere"), TRUE_FRAME),
        body,
    )
    assert field in fields
    assert "utm" not in message


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({}, "queries"),
        ({"queries": [QUERY, QUERY | {"position": [1]}]}, "queries[1].position[1]"),
        ({"queries": [QUERY | {"hints": ["a tree"]}]}, "queries[0].description"),
        ({"queries": [QUERY | {"description": "A tree. " * 201}]}, "queries[0].description"),
        ({"queries": [QUERY | {"pose": 1}]}, "queries[0].pose"),
        ({"queries": [QUERY] * 10_001}, "queries"),
        ({"queries": [QUERY], "crs": "utm"}, "crs"),
        ({"queries": [QUERY, QUERY | {"position": [115, 0]}], "crs": "wgs84"}, "queries[1].position"),
        ({"data": "town"}, "data"),
    ],
)
def test_what_cannot_be_used_is_a_422_and_no_job(api, submitted, problem, body, field):
    """One of each kind of the errors above."""
    response = api.post("/evaluate", json=body)
    problem(response, 422, "invalid_request", field)
    assert "utm" not in response.text
    assert submitted == []


def test_wgs84_needs_a_georeference(settings, start, submitted, problem):
    with start(settings, FakeLocalizer(Frame())) as api:
        body = {"queries": [QUERY], "crs": "wgs84"}
        problem(api.post("/evaluate", json=body), 422, "invalid_request", "crs")


def test_nan_is_no_json(api, problem):
    content = b'{"queries": [{"description": "a tree", "position": [NaN, 1]}]}'
    response = api.post("/evaluate", content=content, headers={"Content-Type": "application/json"})
    problem(response, 400, "invalid_json")


def test_its_own_limit_of_bytes(settings, fake, start, submitted, problem, monkeypatch):
    monkeypatch.setattr(limits_module, "MAX_BODY_BYTES", 100)
    monkeypatch.setattr(limits_module, "MAX_EVALUATE_BODY_BYTES", 100_000)
    with start(settings, fake) as api:
        body = {"queries": [QUERY] * 800}
        assert 65_536 < len(json.dumps(body)) < 100_000
        assert api.post("/evaluate", json=body).status_code == 202
        problem(api.post("/evaluate", json={"queries": [QUERY] * 1200}), 413, "body_too_large")
        problem(api.post("/localize", json={"description": "a tree" * 30}), 413, "body_too_large")
        limits = api.get("/info").json()["limits"]
        assert (limits["max_evaluate_bytes"], limits["max_queries"], limits["max_jobs"]) == (100_000, 10_000, 8)


def test_refused_until_ready_and_while_draining(settings, fake, start, submitted, problem):
    with start(settings, fake) as api:
        api.app.state.indexes.drain()
        problem(api.post("/evaluate", json={"queries": [QUERY]}), 503, "draining")


@pytest.mark.parametrize(
    ("name", "file"), [("town", "town.osm"), ("town.osm", "town.osm"), ("city", "city.osm.pbf"), ("kitti", "kitti")]
)
def test_data_set_by_name(settings, fake, start, submitted, data_dir, name, file):
    with start(settings.model_copy(update={"data_dir": data_dir}), fake) as api:
        assert api.get("/info").json()["data_sets"] == ["city.osm.pbf", "kitti", "town.osm"]
        assert api.post("/evaluate", json={"data": name, "split": "test"}).status_code == 202
    assert (submitted[0].data, submitted[0].split) == (data_dir / file, "test")


@pytest.mark.parametrize(
    "name", ["../outside", "../outside.osm", "..", ".", "/etc", "kitti/../town", "./town", ".hidden", "notes.txt", "x"]
)
def test_no_path_is_a_data_set(refused, data_dir, name):
    for given in (name, str(data_dir / name)):
        fields, message = refused(lambda given: find_data(data_dir, given), given)
        assert fields == ["data"]
        assert str(data_dir) not in message


def test_a_path_is_a_422(settings, fake, start, submitted, data_dir, problem):
    with start(settings.model_copy(update={"data_dir": data_dir}), fake) as api:
        for given in ("../outside.osm", str(data_dir / "town.osm")):
            response = api.post("/evaluate", json={"data": given})
            problem(response, 422, "invalid_request", "data")
            assert str(data_dir) not in response.text
    assert submitted == []


def test_folder_and_file_of_one_name(data_dir):
    (data_dir / "town").mkdir()
    assert find_data(data_dir, "town") == data_dir / "town"
    assert find_data(data_dir, "town.osm") == data_dir / "town.osm"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("{", "not JSON"),
        ('{"queries": NaN}', "NaN"),
        ("{}", "queries: give either"),
        ('{"queries": [{"description": "a tree", "position": [1]}]}', r"queries\[0\].position\[1\]"),
        ('{"data": "town"}', "pass its path as --data"),
    ],
)
def test_file_that_is_no_such_body(settings, tmp_path, content, message):
    (tmp_path / "q.json").write_text(content)
    with pytest.raises(DataError, match=message):
        read_evaluation(tmp_path / "q.json", settings, None, [])


def test_file_has_no_split_and_has_to_be_there(settings, tmp_path):
    with pytest.raises(DataError, match="no split"):
        read_evaluation(tmp_path / "q.json", settings, "test", [])
    with pytest.raises(DataError, match="cannot be read"):
        read_evaluation(tmp_path / "q.json", settings, None, [])
