import pytest
from fastapi import Request

from app.http.formats.negotiation import accepts_gzip, choose_media_type

JSON, GEO = "application/json", "application/geo+json"


@pytest.mark.parametrize(
    ("accept", "chosen"),
    [
        ("", JSON),
        ("*/*", JSON),
        ("application/*", JSON),
        ("APPLICATION/GEO+JSON", GEO),
        ("application/geo+json; charset=utf-8", GEO),
        ("application/json, application/geo+json", JSON),
        ("application/json;q=0.5, application/geo+json", GEO),
        ("application/json;q=0, */*", GEO),
        ("*/*;q=0.1, application/geo+json;q=0.2", GEO),
        ("application/*;q=0.9, application/json;q=0.1", GEO),
        ("text/html,application/xhtml+xml,*/*;q=0.8", JSON),
        ("text/html", None),
        ("application/json;q=0", None),
        ("*/*;q=0", None),
        ("nonsense", None),
        ("application/json;q=high, application/geo+json", GEO),
        ("*/json", None),
    ],
)
def test_choice(accept, chosen):
    assert choose_media_type(accept, (JSON, GEO)) == chosen


@pytest.mark.parametrize(
    ("accepts", "takes"),
    [
        ([], False),
        ([""], False),
        (["gzip"], True),
        (["br, GZIP;q=0.5"], True),
        (["br", "gzip"], True),
        (["*"], True),
        (["*, gzip;q=0"], False),
        (["gzip;q=0.000"], False),
        (["gzip;q=high"], False),
        (["identity, x-gzipped"], False),
    ],
)
def test_gzip_is_taken_by_who_says_so(accepts, takes):
    headers = [(b"accept-encoding", each.encode()) for each in accepts]
    assert accepts_gzip(Request({"type": "http", "headers": headers})) == takes
