"""The service as it is put together by default, on a real (tiny, untrained) index."""

import json
import shutil

import pytest
from fastapi.testclient import TestClient
from typer.testing import CliRunner

from app.cli import main as cli
from app.main import create_app
from app.settings import Settings
from models.paper.fine.checkpoint import FINE_METHODS, load_refiner
from models.posterior.model import load_posterior


@pytest.fixture(scope="module")  # its processes are started as users' are, and not forked from one of the tests
def served(index_dir, weights_dir, until):
    with TestClient(create_app(Settings(index_dir=index_dir, weights_dir=weights_dir))) as served:
        until(lambda: served.get("/readyz").status_code == 200)
        yield served


def test_description_gets_a_position_and_cells_that_exist(served, text):
    response = served.post("/localize", json={"description": text, "top_k": 3})
    assert response.status_code == 200, response.text
    body = response.json()
    assert len(body["candidates"]) == 3
    assert sum(c["probability"] for c in body["candidates"]) + body["other_probability"] == pytest.approx(1)
    cell = served.get(f"/cells/{body['candidates'][0]['cell_id']}").json()
    assert cell["bbox"] == body["candidates"][0]["bbox"]
    assert cell["instances"]
    indexed = served.get("/info").json()["index"]["provenance"]
    shipped = load_posterior()
    assert body["provenance"] == indexed | {"model": shipped.name, "model_sha256": shipped.fingerprint}
    vectors = served.post("/localize", json={"description": text, "refine": "none"}).json()
    assert vectors["provenance"] == indexed


@pytest.mark.parametrize("refine", FINE_METHODS)
def test_every_fine_stage_ships(served, text, refine):
    response = served.post("/localize", json={"description": text, "refine": refine})
    assert response.status_code == 200, response.text
    body = response.json()
    assert body["estimate"]["method"] == refine
    assert body["provenance"]["model_sha256"] == load_refiner(refine).fingerprint


@pytest.mark.parametrize(
    "where",
    [
        {"prior": {"position": [-155, -60], "sigma_m": 0.001}, "crs": "wgs84"},
        {"prior": {"position": [25.001, 60.001], "sigma_m": 30}, "crs": "wgs84"},
        {"prior": {"position": [1e8, -1e8], "sigma_m": 0.001}},
        {"prior": {"position": [0, 0], "sigma_m": 1e8}, "within": {"circle": {"center": [100, 100], "radius_m": 60}}},
        {"within": {"bbox": [-180, -90, 180, 90]}, "crs": "wgs84"},
    ],
)
def test_any_place_that_passes_the_checks_is_answered(served, text, where):
    response = served.post("/localize", json={"description": text, **where})
    assert response.status_code == 200, response.text
    assert response.json()["status"] in {"ok", "ambiguous", "no_match"}


def test_a_place_that_is_described_is_found_again(served):
    described = served.post("/describe", json={"position": [64.0, -57.0]})
    assert described.status_code == 200, described.text
    body = described.json()
    assert served.get(f"/cells/{body['cell_id']}").status_code == 200
    estimate = served.post("/localize", json={"description": body["description"]}).json()["estimate"]
    assert estimate["position"] == pytest.approx([64.0, -57.0], abs=10)
    degrees = {"position": [body["wgs84"]["lon"], body["wgs84"]["lat"]], "crs": "wgs84"}
    assert served.post("/describe", json=degrees).json()["description"] == body["description"]


@pytest.mark.parametrize("position", [[-400, 0], [1e8, -1e8]])
def test_a_place_off_the_map_is_not_described(served, problem, position):
    problem(served.post("/describe", json={"position": position}), 422, "invalid_request", "position")


def test_filter_off_the_map_is_no_match(served, text):
    response = served.post("/localize", json={"description": text, "within": {"bbox": [9e5, 9e5, 1e6, 1e6]}})
    assert (response.json()["status"], response.json()["estimate"]) == ("no_match", None)


def test_a_question_is_answered_and_another_is_asked(served):
    request = {"description": "I am north of a tree.", "top_k": 40}
    body = served.post("/localize", json=request).json()
    assert body["status"] == "ambiguous"
    question = body["question"]
    answers = [{"question": question["id"], "choice": question["choices"][0]["value"]}]
    after = served.post("/localize", json={**request, "answers": answers}).json()
    assert after["candidates"] != body["candidates"]
    assert after["question"] is None or after["question"]["id"] != question["id"]
    geojson = served.post("/localize", json={**request, "answers": answers}, headers={"Accept": "application/geo+json"})
    assert geojson.status_code == 200
    unsure = served.post("/localize", json={**request, "answers": [answers[0] | {"choice": "unknown"}]}).json()
    assert unsure["candidates"] == body["candidates"]
    assert unsure["question"]["id"] != question["id"]


def test_a_text_that_is_refused_can_be_rescued_by_a_reply(served):
    request = {"description": "There is a building near me, and a road."}
    body = served.post("/localize", json=request).json()
    assert (body["status"], body["estimate"], body["question"]["id"]) == ("no_match", None, "street")
    reply = {"question": "street", "choice": "east street 3"}
    after = served.post("/localize", json={**request, "answers": [reply]}).json()
    assert after["status"] in {"ok", "ambiguous"}
    assert "East Street 3" in after["estimate"]["place"]
    unsure = served.post("/localize", json={**request, "answers": [reply | {"choice": "unknown"}]}).json()
    assert unsure["status"] == "no_match"
    assert unsure["question"]["id"] != "street"


@pytest.mark.parametrize(
    ("question", "choice", "field"),
    [
        ("near:dragon", "yes", "answers[0].question"),
        ("street:Elm Street|East Street 1", "Elm Street", "answers[0].question"),
        ("street", "Elm Street", "answers[0].choice"),
        ("near:tree", "perhaps", "answers[0].choice"),
    ],
)
def test_an_answer_that_fits_no_question_is_refused(served, text, problem, question, choice, field):
    answers = [{"question": question, "choice": choice}]
    response = served.post("/localize", json={"description": text, "answers": answers})
    problem(response, 422, "invalid_request", field)


def test_geojson_is_where_the_estimate_is(served, text):
    ask = {"json": {"description": text}}
    place = served.post("/localize", **ask).json()["estimate"]["wgs84"]
    features = served.post("/localize", **ask, headers={"Accept": "application/geo+json"}).json()["features"]
    assert features[0]["geometry"]["coordinates"] == pytest.approx([place["lon"], place["lat"]], abs=1e-6)


def test_command_line_answers_the_same(served, text, index_dir, weights_dir, monkeypatch):
    monkeypatch.setenv("HEREABOUTS_WEIGHTS_DIR", str(weights_dir))
    for name in ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        monkeypatch.setenv(name, "1")
    result = CliRunner().invoke(cli.app, ["localize", text, "--index", str(index_dir), "--json"])
    assert result.exit_code == 0, result.output
    described = json.loads(result.stdout)["estimate"]
    assert described["position"] == served.post("/localize", json={"description": text}).json()["estimate"]["position"]


@pytest.mark.usefixtures("warm_workers")
def test_index_that_was_changed_is_not_served(index_dir, weights_dir, tmp_path, until, problem):
    shutil.copytree(index_dir, tmp_path / "index")
    for file in (tmp_path / "index").rglob("*.safetensors"):
        file.write_bytes(file.read_bytes()[:-1])
    settings = Settings(index_dir=tmp_path / "index", weights_dir=weights_dir)
    with TestClient(create_app(settings)) as api:
        until(lambda: api.get("/readyz").json()["code"] != "not_ready")
        problem(api.get("/readyz"), 503, "load_failed")
