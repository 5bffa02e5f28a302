from dataclasses import replace

import pytest
from fake_localizer import FakeLocalizer

from models.citymap.frame import Frame

PATH = "/cells/fakeville_00001"
GEO = {"Accept": "application/geo+json"}


def test_cell_and_what_is_in_it(api):
    response = api.get(PATH)
    body = response.json()
    assert response.headers["content-type"] == "application/json"
    assert body["cell_id"] == "fakeville_00001"
    assert body["center"] == [0, 0, 1]
    assert body["bbox"] == [-15, -15, 15, 15]
    assert body["instances"] == [
        {
            "label": "tree",
            "name": None,
            "source_id": "node/1",
            "colour": "green",
            "points": 12,
            "center": [1, 2, 3],
            "size": [2, 2, 6],
            "closest": [0.5, 1, 0],
        }
    ]
    assert body["provenance"]["index_version"] == "v1"


def test_geojson_has_the_cell_and_its_instances(api, fake):
    cell, tree = api.get(PATH, headers=GEO).json()["features"]
    assert (cell["geometry"]["type"], cell["properties"]["scene"]) == ("Polygon", "fakeville")
    lat, lon = fake.frame.to_wgs84([1.0, 2.0])
    assert tree["geometry"]["coordinates"] == pytest.approx([float(lon), float(lat)])
    assert tree["properties"]["label"] == "tree"


def test_unknown_cell_is_404(api, problem):
    problem(api.get("/cells/elsewhere"), 404, "cell_not_found")
    problem(api.get("/cells/%00%ff"), 404, "cell_not_found")


def test_map_without_georeference_has_no_geojson(settings, start, problem):
    with start(settings, FakeLocalizer(Frame())) as api:
        problem(api.get(PATH, headers=GEO), 406, "no_georeference")
        problem(api.get(PATH, headers={"Accept": "image/png"}), 406, "not_acceptable")
        assert api.get(PATH).json()["wgs84"] is None


@pytest.mark.parametrize("form", ["{}", "W/{}", '"other", {}', "*"])
def test_cell_that_the_client_has_is_304(api, form):
    etag = api.get(PATH).headers["etag"]
    response = api.get(PATH, headers={"If-None-Match": form.format(etag.removeprefix("W/"))})
    assert (response.status_code, response.content, response.headers["etag"]) == (304, b"", etag)


def test_etag_is_of_the_index_the_cell_and_the_format(api, fake):
    etag = api.get(PATH).headers["etag"]
    assert api.get(PATH).headers["etag"] == etag
    assert api.get(PATH, headers=GEO).headers["etag"] != etag
    fake.facts = replace(fake.facts, version="v2")
    response = api.get(PATH, headers={"If-None-Match": etag})
    assert response.status_code == 200
    assert response.headers["etag"] != etag


def test_cells_are_listed_a_page_at_a_time(api):
    first = api.get("/cells?limit=1").json()
    assert [cell["cell_id"] for cell in first["cells"]] == ["fakeville_00001"]
    assert first["total"] == 2
    second = api.get(first["next"]).json()
    assert [cell["cell_id"] for cell in second["cells"]] == ["fakeville_00002"]
    assert second["next"] is None
    beyond = api.get("/cells?offset=99").json()
    assert (beyond["cells"], beyond["next"]) == ([], None)
    assert len(api.get("/cells").json()["cells"]) == 2


def test_a_page_has_its_etag_and_its_geojson(api):
    first_page = api.get("/cells?limit=1")
    assert api.get("/cells?limit=1", headers={"If-None-Match": first_page.headers["etag"]}).status_code == 304
    assert api.get("/cells?limit=2", headers={"If-None-Match": first_page.headers["etag"]}).status_code == 200
    drawn = api.get("/cells?limit=1", headers=GEO)
    assert drawn.headers["etag"] != first_page.headers["etag"]
    [feature] = drawn.json()["features"]
    assert (feature["geometry"]["type"], feature["id"]) == ("Polygon", "fakeville_00001")
    assert drawn.json()["next"] == first_page.json()["next"]


@pytest.mark.parametrize("query", ["offset=-1", "offset=x", "limit=0", "limit=1001", "offset=1e9", "index=../x"])
def test_a_page_that_cannot_be_is_refused(api, problem, query):
    problem(api.get(f"/cells?{query}"), 422, "invalid_request", query.partition("=")[0])
