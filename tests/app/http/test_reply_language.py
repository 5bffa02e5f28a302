import pytest
from starlette.requests import Request

from app.http.formats.negotiation import negotiate_language

TEXT = "I am north of a gray building."


@pytest.mark.parametrize(
    ("header", "code"),
    [
        ("fi", "fi"),
        ("fi-FI,fi;q=0.9,en-US;q=0.8", "fi"),
        ("en;q=0.5, sv;q=0.7", "sv"),
        ("ja, DE-at;q=0.3", "de"),
        ("fr;q=0, es;q=0.1", "es"),
        ("fi;q=high, sv;q=0.1", "sv"),
        ("ja", None),
        ("*", None),
        ("", None),
        (";;,=", None),
    ],
)
def test_the_language_that_a_client_prefers(header, code) -> None:
    request = Request({"type": "http", "headers": [(b"accept-language", header.encode())]})
    assert negotiate_language(request) == code
    assert negotiate_language(Request({"type": "http", "headers": []})) is None


def requests_of(api, headers):
    yield api.post("/localize", json={"description": TEXT}, headers=headers)
    yield api.post("/localize", json={"description": TEXT}, headers={**headers, "Accept": "application/geo+json"})
    yield api.post("/localize/batch", json={"items": [{"description": TEXT}, {"description": TEXT}]}, headers=headers)
    yield api.get("/search", params={"q": TEXT}, headers=headers)


@pytest.mark.parametrize(
    ("headers", "preferred", "content"), [({"Accept-Language": "fi"}, "fi", "fi"), ({}, None, "en")]
)
def test_every_route_of_descriptions_answers_in_it(api, fake, headers, preferred, content) -> None:
    for response in requests_of(api, headers):
        assert response.status_code == 200
        assert response.headers["content-language"] == content
        assert response.headers["vary"].startswith("Accept, Accept-Language")
    assert {query.language for batch in fake.batches for query in batch} == {preferred}
