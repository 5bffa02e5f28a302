import pytest
from fake_localizer import FakeLocalizer

from app.http.routes.localize import check_positions
from app.http.schemas.requests import LocalizeRequest
from models.citymap.frame import Frame

RING = [[0, 0], [1, 0], [0, 1], [0, 0]]
FAR_RING = [[0, 0], [181, 0], [0, 1], [0, 0]]
SWAPPED_RING = [[60.165, 24.93], [60.175, 24.93], [60.17, 24.95], [60.165, 24.93]]
ELLIPSE = {"semi_major_m": 50, "semi_minor_m": 20, "orientation_deg": 30}
TREE = {"question": "near:tree", "choice": "yes"}


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({}, "description"),
        ({"description": "a tree", "hints": ["a tree"]}, "description"),
        ({"description": ""}, "description"),
        ({"description": " \n\t "}, "description"),
        ({"description": "?!."}, "description"),
        ({"description": "a\u0000tree"}, "description"),
        ({"description": "a\u0007tree"}, "description"),
        ({"description": "a\u0085tree"}, "description"),
        ({"description": 5}, "description"),
        ({"description": True}, "description"),
        ({"description": ["a tree"]}, "description"),
        ({"description": "x" * 4001}, "description"),
        ({"description": "a tree. " * 201}, "description"),
        ({"hints": []}, "hints"),
        ({"hints": ["1. "]}, "hints"),
        ({"hints": ["I see a tree. " * 201]}, "hints"),
        ({"hints": ["a.\n" * 101, "b.\n" * 100]}, "hints"),
        ({"hints": ["a tree"] * 33}, "hints"),
        ({"hints": "a tree"}, "hints"),
        ({"hints": ["a tree", " "]}, "hints[1]"),
        ({"hints": ["a tree", 7]}, "hints[1]"),
        ({"hints": ["x" * 2001, "y" * 2000]}, "hints"),
        ({"top_k": 0}, "top_k"),
        ({"top_k": 41}, "top_k"),
        ({"top_k": True}, "top_k"),
        ({"top_k": 5.0}, "top_k"),
        ({"top_k": "5"}, "top_k"),
        ({"deadline_ms": 0}, "deadline_ms"),
        ({"deadline_ms": 60_001}, "deadline_ms"),
        ({"crs": "utm"}, "crs"),
        ({"index": "../other"}, "index"),
        ({"refine": "guess"}, "refine"),
        ({"heat": False}, "heat"),
        ({"explain": True}, "explain"),
        ({"within": {}}, "within"),
        ({"within": {"bbox": [0, 0, 1, 1], "circle": {"center": [0, 0], "radius_m": 1}}}, "within"),
        ({"within": {"bbox": [0, 0, 1]}}, "within.bbox[3]"),
        ({"within": {"bbox": [0, 0, 1, True]}}, "within.bbox[3]"),
        ({"within": {"bbox": [0, 0, 1, 10**400]}}, "within.bbox[3]"),
        ({"within": {"bbox": [0, 0, 1, 1, 1]}}, "within.bbox"),
        ({"within": {"bbox": [1, 0, 0, 1]}}, "within.bbox"),
        ({"within": {"bbox": [0, 1, 1, 0]}}, "within.bbox"),
        ({"within": {"bbox": [0, 0, 200, 1]}, "crs": "wgs84"}, "within.bbox"),
        ({"within": {"type": "Polygon"}}, "within"),
        ({"within": {"coordinates": [RING]}}, "within"),
        ({"within": {"type": "Polygon", "coordinates": [RING], "bbox": [0, 0, 1, 1]}}, "within"),
        ({"within": {"type": "Point", "coordinates": [0, 0]}}, "within.type"),
        ({"within": {"type": "Feature", "geometry": {}}}, "within.geometry"),
        *(
            ({"within": {"type": "Polygon", "coordinates": coordinates}}, "within.coordinates")
            for coordinates in (
                *([], [[]], [RING[:3]], [[*RING, [5, 5]]], [RING, []], [[*RING, *RING] * 500]),
                [[[0, 0], [1, 1], [1, 0], [0, 1], [0, 0]]],
                [[[0, 0], [1, 1], [2, 2], [0, 0]]],
                [RING, [[8, 8], [9, 8], [9, 9], [8, 8]]],
            )
        ),
        ({"within": {"type": "MultiPolygon", "coordinates": [[RING], []]}}, "within.coordinates"),
        ({"within": {"type": "Polygon", "coordinates": RING}}, "within.coordinates[0][0]"),
        ({"within": {"type": "MultiPolygon", "coordinates": [RING]}}, "within.coordinates[0][0][0]"),
        ({"within": {"type": "Polygon", "coordinates": [[[0, True], *RING]]}}, "within.coordinates[0][0][1]"),
        ({"within": {"type": "Polygon", "coordinates": [[[0, 0, 0, 0], *RING]]}}, "within.coordinates[0][0]"),
        ({"within": {"type": "Polygon", "coordinates": [[[0, 1e9], *RING]]}}, "within.coordinates[0][0][1]"),
        ({"within": {"type": "Polygon", "coordinates": [FAR_RING]}, "crs": "wgs84"}, "within.coordinates"),
        ({"within": {"type": "Polygon", "coordinates": [SWAPPED_RING]}, "crs": "wgs84"}, "within.coordinates"),
        ({"within": {"bbox": [0, -91, 1, 1]}, "crs": "wgs84"}, "within.bbox"),
        ({"within": {"circle": {"center": [0, 0], "radius_m": 0}}}, "within.circle.radius_m"),
        ({"within": {"circle": {"center": [0, 0], "radius_m": 1, "x": 1}}}, "within.circle.x"),
        ({"within": {"circle": {"center": [0, 91], "radius_m": 1}}, "crs": "wgs84"}, "within.circle.center"),
        ({"prior": {"position": [0, 0], "sigma_m": -1}}, "prior.sigma_m"),
        ({"prior": {"position": [0, 0], "sigma_m": 1e-200}}, "prior.sigma_m"),
        ({"prior": {"position": [0, 0]}}, "prior.sigma_m"),
        ({"prior": {"position": [0, 0], "sigma_m": 5, "radius_m": 5}}, "prior"),
        ({"prior": {"position": [0, 0], "semi_major_m": 5, "semi_minor_m": 5}}, "prior"),
        ({"prior": {"position": [0, 0], **ELLIPSE, "radius_m": 5}}, "prior"),
        ({"prior": {"position": [0, 0], **ELLIPSE, "semi_minor_m": 90}}, "prior.semi_minor_m"),
        ({"prior": {"position": [0, 0], **ELLIPSE, "orientation_deg": 361}}, "prior.orientation_deg"),
        ({"prior": {"position": [0, 0], **ELLIPSE, "orientation_deg": "N"}}, "prior.orientation_deg"),
        ({"prior": {"position": [0, 0], **ELLIPSE, "confidence": 68}}, "prior.confidence"),
        ({"prior": {"position": [0, 0], "radius_m": 5, "confidence": 0}}, "prior.confidence"),
        ({"prior": {"position": [0, 0], "radius_m": 5, "confidence": 1}}, "prior.confidence"),
        ({"prior": {"position": [0, 0], "sigma_m": 5, "confidence": 0.5}}, "prior.confidence"),
        ({"prior": {"position": [181, 0], "sigma_m": 1}, "crs": "wgs84"}, "prior.position"),
        ({"prior": {"position": [114.94, 0], "sigma_m": 1}, "crs": "wgs84"}, "prior.position"),
        ({"prior": {"position": [60.17, 24.94], "sigma_m": 1}, "crs": "wgs84"}, "prior.position"),
        ({"prior": {"position": [24.94, 60.17], "sigma_m": 1}}, "prior.position"),
        ({"prior": {"position": [60.17, 24.94], "sigma_m": 1}}, "prior.position"),
        ({"listener": [60.17, 24.94], "crs": "wgs84"}, "listener"),
        ({"within": {"circle": {"center": [60.17, 24.94], "radius_m": 1}}, "crs": "wgs84"}, "within.circle.center"),
        ({"within": {"bbox": [60.165, 24.93, 60.175, 24.95]}, "crs": "wgs84"}, "within.bbox"),
        ({"answers": None}, "answers"),
        ({"answers": [TREE] * 9}, "answers"),
        ({"answers": [{"question": "near:tree"}]}, "answers[0].choice"),
        ({"answers": [{**TREE, "sure": True}]}, "answers[0].sure"),
        ({"answers": [TREE, {"question": 7, "choice": "yes"}]}, "answers[1].question"),
        ({"answers": [{"question": "near:tree", "choice": True}]}, "answers[0].choice"),
        ({"answers": [{"question": "n" * 1001, "choice": "yes"}]}, "answers[0].question"),
        ({"answers": [TREE, {"question": "near:tree", "choice": "no"}]}, "answers[1].question"),
        ({"answers": [TREE], "refine": "none"}, "answers"),
    ],
)
def test_wrong_field_is_named(refused, body, field):
    if not {"description", "hints"} & set(body) and body:
        body = {"description": "a tree", **body}
    fields, _ = refused(lambda body: check_positions(LocalizeRequest.model_validate(body), FakeLocalizer()), body)
    assert field in fields


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({}, "description"),  # a check of several fields
        ({"description": "a\u0085tree"}, "description"),  # of the characters of one
        ({"description": 5}, "description"),
        ({"description": "x" * 4001}, "description"),
        ({"description": "a tree. " * 201}, "description"),  # after the request's model
        ({"hints": ["a tree", 7]}, "hints[1]"),
        ({"description": "a", "top_k": 41}, "top_k"),
        ({"description": "a", "refine": "guess"}, "refine"),
        ({"description": "a", "heat": False}, "heat"),
        ({"description": "a", "within": {"bbox": [0, 0, 1]}}, "within.bbox[3]"),
        ({"description": "a", "within": {"bbox": [0, 0, 1, 10**400]}}, "within.bbox[3]"),
        ({"description": "a", "within": {"bbox": [1, 0, 0, 1]}}, "within.bbox"),
        ({"description": "a", "within": {"circle": {"center": [0, 91], "radius_m": 1}}, "crs": "wgs84"},
         "within.circle.center"),
        ({"description": "a", "prior": {"position": [0, 0]}}, "prior.sigma_m"),
        ({"description": "a", "prior": {"position": [114.94, 0], "sigma_m": 1}, "crs": "wgs84"}, "prior.position"),
    ],
)  # fmt: skip
def test_wrong_field_is_a_422_and_nothing_is_computed(api, fake, problem, body, field):
    """One of each kind of the errors above."""
    problem(api.post("/localize", json=body), 422, "invalid_request", field)
    assert fake.batches == []


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"top_k": "x"}, "top_k: must be a whole number"),
        ({"top_k": 41}, "top_k: must be at most 40"),
        ({"refine": "guess"}, "refine: must be 'none', 'matching', 'regressor' or 'posterior'"),
        ({"hints": []}, "hints: must have 1 or more items"),
        ({"description": 5}, "description: must be a string"),
        ({"heat_map": 1}, "heat_map: must be true or false"),
        ({"within": []}, "within: must be a JSON object"),
        ({"prior": {"position": 7, "sigma_m": 1}}, "prior.position: must be a list"),
        ({"prior": {"position": ["x", 1], "sigma_m": 1}}, "prior.position[0]: must be a number"),
    ],
)
def test_wrong_type_says_what_to_send(api, problem, wrong, message):
    body = {**({} if "hints" in wrong else {"description": "a tree"}), **wrong}
    assert problem(api.post("/localize", json=body), 422, "invalid_request")["detail"] == message


def test_body_that_is_no_object_is_422(api, problem):
    problem(api.post("/localize", json=["a tree"]), 422, "invalid_request", "(body)")


def test_box_may_reach_where_the_projection_does_not(api):
    far = {"within": {"bbox": [-180, -90, 114.94, 0]}, "crs": "wgs84"}
    assert api.post("/localize", json={"description": "a tree", **far}).status_code == 200


def test_text_in_any_script_passes(api, fake):
    body = {"description": "我在一栋灰色建筑的北边。\n나무 옆에 있어요 🌳"}
    assert api.post("/localize", json=body).status_code == 200
    assert fake.batches[0][0].description == body["description"]


def test_largest_values_pass_and_are_in_the_document(api, fake):
    limits = api.get("/info").json()["limits"]
    most = {"top_k": limits["max_top_k"], "deadline_ms": limits["max_deadline_ms"]}
    for body in (
        {"description": "a" * limits["max_characters"]},
        {"description": "a tree. " * 200},
        {"hints": ["a tree"] * limits["max_hints"]},
        {"hints": ["x" * (limits["max_characters"] - 1), "y"]},
    ):
        assert api.post("/localize", json=body | most).status_code == 200
    assert {query.top_k for [query] in fake.batches} == {limits["max_top_k"]}
    schema = api.get("/openapi.json").json()["components"]["schemas"]["LocalizeRequest"]["properties"]
    assert schema["top_k"]["maximum"] == limits["max_top_k"]
    assert schema["deadline_ms"]["maximum"] == limits["max_deadline_ms"]
    assert schema["deadline_ms"]["default"] == limits["deadline_ms"]
    assert schema["description"]["anyOf"][0]["maxLength"] == limits["max_characters"]
    assert schema["hints"]["anyOf"][0]["maxItems"] == limits["max_hints"]


def test_degrees_on_a_map_that_is_not_on_earth(settings, start, problem):
    with start(settings, FakeLocalizer(Frame())) as api:
        problem(api.post("/localize", json={"description": "a tree", "crs": "wgs84"}), 422, "invalid_request", "crs")
        answer = api.post("/localize", json={"description": "a tree"}).json()
    assert answer["estimate"]["wgs84"] is None
    assert answer["crs"]["origin"] is None


def test_a_request_names_its_index(api, fake, problem, text):
    assert api.post("/localize", json={"description": text, "index": "default"}).status_code == 200
    for path, body in (
        ("/localize", {"description": text}),
        ("/describe", {"position": [0.0, 0.0]}),
        ("/evaluate", {"queries": [{"description": text, "position": [0.0, 0.0]}]}),
    ):
        problem(api.post(path, json=body | {"index": "paris"}), 404, "index_not_found")
    problem(api.get("/cells/fakeville_00001?index=paris"), 404, "index_not_found")
    problem(api.get("/cells/fakeville_00001?index=../x"), 422, "invalid_request", "index")
    assert api.get("/cells/fakeville_00001?index=default").status_code == 200
    assert api.get("/info").json()["indexes"] == ["default"]
