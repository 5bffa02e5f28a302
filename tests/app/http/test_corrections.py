"""POST /corrections: what is written is what `hereabouts evaluate --data` reads."""

import json
from concurrent.futures import ThreadPoolExecutor

import pytest
from fake_localizer import FakeLocalizer

from app.settings import Settings
from models.citymap.frame import Frame
from models.files import append_line
from models.sources.place_texts import PlaceText, load_place_texts

PATH = "/corrections"
TEXT = "Caller: a tree\nDispatcher: which?"
BODY = {"request": {"description": TEXT, "top_k": 3}, "position": [12.0, 34.0], "place_rank": 2}


@pytest.fixture
def file(tmp_path):
    return tmp_path / "logs" / "corrections.jsonl"


@pytest.fixture
def correcting(start, fake, file):
    """A client of a service that stores corrections."""
    with start(Settings(corrections_file=file), fake) as api:
        yield api


def test_a_correction_is_a_text_to_evaluate(correcting, file, fake):
    lat, lon = map(float, fake.frame.to_wgs84([12.0, 34.0]))
    assert correcting.get("/info").json()["corrections"] is True
    response = correcting.post(PATH, json=BODY)
    assert response.status_code == 201, response.text
    degrees = {"position": [lon, lat], "crs": "wgs84", "request": {"hints": ["a", "b"], "listener": [0, 0]}}
    assert correcting.post(PATH, json=degrees).status_code == 201
    first, second = load_place_texts(file)
    assert first == PlaceText(TEXT, pytest.approx((lat, lon), abs=1e-7))
    assert second.text == "a\nb"
    assert second.goal == pytest.approx((lat, lon), abs=1e-7)
    assert second.start == pytest.approx((60.17, 24.94))
    row = json.loads(file.read_text().splitlines()[0])
    assert row == response.json()
    assert row["request"] == BODY["request"]
    assert (row["place_rank"], row["map"], row["index_version"]) == (2, "fakeville", "v1")


def test_concurrent_corrections_are_all_stored(correcting, file):
    with ThreadPoolExecutor(8) as pool:
        statuses = pool.map(lambda _: correcting.post(PATH, json=BODY).status_code, range(24))
    assert set(statuses) == {201}
    assert len(load_place_texts(file)) == 24


def test_a_torn_line_stays_alone(file):
    append_line(file, b'{"text": "a"}')
    assert file.stat().st_mode & 0o777 == 0o600
    with file.open("ab") as torn:
        torn.write(b'{"te')
    append_line(file, b'{"text": "b"}')
    assert file.read_bytes() == b'{"text": "a"}\n{"te\n{"text": "b"}\n'


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"position": [5000, 0]}, "position"),
        ({"position": [24.94, 60.17]}, "position"),
        ({"position": [60.17, 24.94], "crs": "wgs84"}, "position"),
        ({"position": [0, 91], "crs": "wgs84"}, "position"),
        ({"place_rank": 0}, "place_rank"),
        ({"place_rank": 6}, "place_rank"),
        ({"request": {"description": "?"}}, "request.description"),
        ({"request": {"description": "a tree", "prior": {"position": [60.17, 24.94], "sigma_m": 5}}}, "prior.position"),
        ({"extra": 1}, "extra"),
    ],
)
def test_a_wrong_field_is_named_and_nothing_is_stored(correcting, file, problem, change, field):
    problem(correcting.post(PATH, json=BODY | change), 422, "invalid_request", field)
    assert not file.exists()


def test_a_service_without_a_file_or_a_georeference_stores_none(api, start, file, problem):
    assert "HEREABOUTS_CORRECTIONS_FILE" in problem(api.post(PATH, json=BODY), 404, "corrections_off")["detail"]
    with start(Settings(corrections_file=file), FakeLocalizer(Frame())) as unreferenced:
        problem(unreferenced.post(PATH, json=BODY), 404, "corrections_off")
        assert unreferenced.get("/info").json()["corrections"] is False


def test_behind_a_proxy_a_correction_needs_the_key(correcting, file, problem, start):
    proxied = {"X-Forwarded-For": "203.0.113.7"}
    problem(correcting.post(PATH, json=BODY, headers=proxied), 403, "key_not_set")
    with start(Settings(corrections_file=file, read_key="correct-horse"), FakeLocalizer()) as api:
        problem(api.post(PATH, json=BODY, headers=proxied), 401, "key_required")
        assert not file.exists()
        assert api.post(PATH, json=BODY, headers=proxied | {"X-API-Key": "correct-horse"}).status_code == 201


def test_a_file_that_cannot_be_written_is_a_problem(start, fake, tmp_path, problem):
    with start(Settings(corrections_file=tmp_path), fake) as api:
        problem(api.post(PATH, json=BODY), 409, "not_writable")
