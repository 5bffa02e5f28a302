import pytest
from structlog.testing import capture_logs


@pytest.fixture
def lines():
    with capture_logs() as captured:
        yield captured


def requests(lines):
    return [line for line in lines if line["event"] == "request"]


def test_line_has_the_route_and_the_id_but_not_the_text(api, lines):
    response = api.post("/localize", json={"description": "I am beside the opera."})
    [line] = requests(lines)
    assert (line["method"], line["route"], line["status"]) == ("POST", "/localize", 200)
    assert line["ms"] > 0
    assert line["request_id"] == response.headers["x-request-id"] == response.json()["request_id"]
    assert "opera" not in str(lines)


def test_line_has_the_template_and_not_the_path(api, lines):
    api.get("/cells/elsewhere")
    api.get("/nothing/here")
    api.get("/localize")
    assert [(line["route"], line["status"]) for line in requests(lines)] == [
        ("/cells/{cell_id}", 404),
        ("other", 404),
        ("/localize", 405),
    ]


def test_fault_is_logged_with_the_id(api, lines):
    response = api.post("/localize", json={"description": "a bad tree"})
    [fault] = [line for line in lines if line["event"] == "internal error"]
    assert fault["request_id"] == response.headers["x-request-id"]
    assert fault["exc_info"]
    assert requests(lines)[0]["status"] == 500


def test_sane_request_id_of_the_client_is_kept(api):
    response = api.get("/healthz", headers={"X-Request-ID": "trace-1.A_b"})
    assert response.headers["x-request-id"] == "trace-1.A_b"


@pytest.mark.parametrize("bad", ["a b", "x" * 65, 'a"b', "<script>", "a,b"])
def test_other_request_id_is_replaced(api, bad):
    response = api.get("/nothing", headers={"X-Request-ID": bad})
    assert response.headers["x-request-id"] != bad
    assert response.json()["request_id"] == response.headers["x-request-id"]
