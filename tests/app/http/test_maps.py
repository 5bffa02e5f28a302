import gzip
import json
from dataclasses import asdict, replace
from hashlib import sha256

import pytest
from fake_localizer import FakeLocalizer

from models.citymap.scenery.files import SceneryPart
from models.citymap.summary import MapSummary

PATH = "/maps/fakeville/points"
SUMMARY = MapSummary(
    bbox=(24.9, 60.1, 25.0, 60.2),
    width_km=5.5,
    height_km=11.1,
    walkable_km=320.5,
    objects=4000,
    streets=93,
    named_objects=1868,
    house_numbers=1445,
    kinds={"cafe": 82},
    scripts={"latin": 2656},
    languages={"fi": 1068},
    extras={"bins.geojson as amenity=waste_basket": 380},
    cut={},
    dropped={"the outline is broken": 2},
    repaired={},
)
BLOBS = b"geometry" * 100, b"more"


@pytest.fixture
def drawn(settings, start, tmp_path):
    parts = []
    for number, blob in enumerate(BLOBS):
        path = tmp_path / f"{number}.gz"
        path.write_bytes(gzip.compress(blob, mtime=0))
        parts.append(SceneryPart(path, sha256(path.read_bytes()).hexdigest()))
    with start(settings, FakeLocalizer(parts=parts)) as api:
        yield api


def test_a_map_says_what_it_is_good_for(settings, start):
    fake = FakeLocalizer()
    fake.facts = replace(fake.facts, summary=SUMMARY)
    with start(settings, fake) as api:
        body = api.get("/maps/fakeville").json()
    assert (body["name"], body["num_cells"], body["provenance"]["map"]) == ("fakeville", 2, "fakeville")
    assert body["summary"] == json.loads(json.dumps(asdict(SUMMARY)))


def test_a_data_set_has_no_summary(api, problem):
    assert api.get("/maps/fakeville").json()["summary"] is None
    problem(api.get("/maps/elsewhere"), 404, "map_not_found")


@pytest.mark.parametrize("accepts", ["gzip, br", "identity"])
def test_parts_come_as_the_client_can_read_them(drawn, accepts):
    for part, blob in enumerate(BLOBS):
        response = drawn.get(PATH, params={"part": part}, headers={"Accept-Encoding": accepts})
        assert response.status_code == 200
        assert response.content == blob, "the client has it decompressed"
        assert response.headers["content-type"] == "application/octet-stream"
        assert ("content-encoding" in response.headers) == ("gzip" in accepts)
        assert response.headers["vary"] == "Accept-Encoding"


def test_what_the_client_has_is_304(drawn):
    first = drawn.get(PATH)
    again = drawn.get(PATH, headers={"If-None-Match": first.headers["etag"]})
    assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", first.headers["etag"])
    plain = drawn.get(PATH, headers={"Accept-Encoding": "identity", "If-None-Match": first.headers["etag"]})
    assert plain.status_code == 200, "other bytes have another tag"
    assert drawn.get(PATH, params={"part": 1}).headers["etag"] != first.headers["etag"]


@pytest.mark.parametrize("path", [f"{PATH}?part=2", "/maps/elsewhere/points", "/maps/..%2f/points"])
def test_no_such_map_or_part_is_404(drawn, problem, path):
    response = drawn.get(path)
    problem(response, 404, "not_found" if "%2f" in path else "map_not_found")


@pytest.mark.parametrize("part", ["-1", "x", "1e9", "99999999999999999999"])
def test_part_that_is_no_number_is_422(drawn, problem, part):
    problem(drawn.get(PATH, params={"part": part}), 422, "invalid_request")
