"""The page's files over HTTP; a folder with small ones stands in for what the build makes."""

import gzip
from urllib.parse import quote

import pytest
from local_client import local_client

from app.http.routes.page import PageFile
from app.main import create_app
from app.settings import Settings

INDEX = "<!doctype html><title>Hereabouts</title>" + "<p>ä</p>" * 50
FILES = {
    "index.html": INDEX,
    "page.js": "console.log(1);\n" * 50,
    "style.css": "a{}",
    "page.js.LEGAL.txt": "MIT",
    "icon.svg": "<svg/>",
    "data.unknown": "?",
}
TYPES = {
    "/": "text/html; charset=utf-8",
    "/page.js": "text/javascript; charset=utf-8",
    "/style.css": "text/css; charset=utf-8",
    "/page.js.LEGAL.txt": "text/plain; charset=utf-8",
    "/icon.svg": "image/svg+xml",
    "/data.unknown": "application/octet-stream",
}
PLAIN = {"Accept-Encoding": "identity"}


@pytest.fixture
def page_dir(tmp_path):
    folder = tmp_path / "page"
    (folder / "folder.js").mkdir(parents=True)
    for name, text in FILES.items():
        (folder / name).write_text(text)
    (folder / ".hidden").write_text("secret")
    (tmp_path / "outside.js").write_text("secret")
    return folder


@pytest.fixture
def page(fake, page_dir):
    with local_client(create_app(Settings(), lambda: fake, page_dir)) as api:
        yield api


@pytest.mark.parametrize("path", TYPES)
def test_files_with_their_types_and_what_browsers_are_told(page, path):
    response = page.get(path)
    assert response.status_code == 200
    assert response.text == FILES[path[1:] or "index.html"]
    assert response.headers["content-type"] == TYPES[path]
    assert response.headers["cache-control"] == "no-cache"
    assert response.headers["content-security-policy"] == (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
        "font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )
    assert response.headers["x-content-type-options"] == "nosniff"
    assert response.headers["referrer-policy"] == "no-referrer"
    assert response.headers["cross-origin-opener-policy"] == "same-origin"
    assert response.headers["vary"] == "Accept-Encoding"


def test_gzip_for_who_takes_it_and_if_it_is_smaller(page):
    zipped, plain = page.get("/page.js"), page.get("/page.js", headers=PLAIN)
    assert zipped.headers["content-encoding"] == "gzip"
    assert int(zipped.headers["content-length"]) < int(plain.headers["content-length"]) == len(FILES["page.js"])
    assert "content-encoding" not in plain.headers
    assert zipped.content == plain.content
    assert zipped.headers["etag"] != plain.headers["etag"]
    assert "content-encoding" not in page.get("/style.css").headers


def test_compressed_alike_each_time(page_dir):
    first, again = (PageFile.load(page_dir / "page.js") for _ in range(2))
    assert first == again
    assert gzip.decompress(first.zipped) == first.plain


@pytest.mark.parametrize("headers", [{}, PLAIN])
def test_head_says_what_get_does(page, headers):
    head, get = page.head("/", headers=headers), page.get("/", headers=headers)
    assert (head.status_code, head.content) == (200, b"")
    assert set(head.headers.items()) ^ set(get.headers.items()) == {
        ("x-request-id", r.headers["x-request-id"]) for r in (head, get)
    }


@pytest.mark.parametrize("method", ["GET", "HEAD"])
def test_what_the_client_has_is_304(page, method):
    tag = page.get("/").headers["etag"]
    for known in (tag, f'"x", W/{tag}', "*"):
        again = page.request(method, "/", headers={"If-None-Match": known})
        assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", tag)
        assert "content-security-policy" in again.headers
    assert page.get("/", headers={"If-None-Match": '"x"'}).status_code == 200
    assert page.get("/", headers={"If-None-Match": tag, **PLAIN}).status_code == 200, "other bytes have another tag"


def test_a_changed_file_has_another_tag(page, page_dir, fake):
    (page_dir / "page.js").write_text(FILES["page.js"] + "\n")
    assert page.get("/page.js").text == FILES["page.js"], "it was read at the start"
    changed = local_client(create_app(Settings(), lambda: fake, page_dir))
    assert changed.get("/page.js").headers["etag"] != page.get("/page.js").headers["etag"]


@pytest.mark.parametrize(
    "path",
    [
        "/index.html",
        "/folder.js",
        "/.hidden",
        "/outside.js",
        "/../outside.js",
        "/page.js/..",
        "/page.js/../../outside.js",
        "/page.js\0",
        "/PAGE.JS",
        "//page.js",
        "/web/page/page.js",
    ],
)
def test_nothing_else_is_sent(page, problem, path):
    built = page.build_request(
        "GET", f"/{quote(path[1:], safe='')}"
    )  # whole, as a client that tidies up no path sends it
    problem(page.send(built), 404, "not_found")


def test_other_methods_are_405(page, problem):
    problem(page.post("/", content=b"x"), 405, "method_not_allowed")


@pytest.mark.parametrize("folder", ["missing", ""])
def test_without_a_page_it_starts_and_says_how_to_build_it(fake, problem, tmp_path, folder):
    (tmp_path / "page.js").write_text("half a build")
    with local_client(create_app(Settings(), lambda: fake, tmp_path / folder)) as api:
        assert "npm ci && npm run build" in problem(api.get("/"), 404, "not_found")["detail"]
        problem(api.get("/page.js"), 404, "not_found")
        assert api.get("/healthz").status_code == 200


def test_every_answer_is_taken_for_what_it_says_it_is(api, fake):
    for response in (api.get("/healthz"), api.get("/nothing"), api.post("/localize", json={"description": "bad"})):
        assert response.headers["x-content-type-options"] == "nosniff"
    assert "content-security-policy" not in api.get("/docs").headers


def test_page_is_not_of_the_api(page):
    assert not {"/", "/page.js"} & set(page.get("/openapi.json").json()["paths"])
