"""The page in a real browser, against a real service with the weights that ship, on a tiny town with names."""

import asyncio
import shutil
import threading
from contextlib import contextmanager
from html import escape
from urllib.parse import urlsplit

import pytest
import uvicorn
from playwright.sync_api import sync_playwright

from app.main import create_app
from app.settings import Settings
from index.build.build import IndexJob
from tests.app.conftest import forked_from, is_ready, wait_until
from tests.conftest import LAT, LAT_M, LON, LON_M, tiny_osm

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
SOFTWARE = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
CHIPS = "#chips .chip >> nth=2"  # the map and its examples are there
EVIL = "<img src=x onerror=\"document.title='broken'\">"
PLACES = (  # metres east and north, name, tags
    (37, 5, "Bakery Aurora", {"shop": "bakery"}),
    (157, 117, "Café Sirius", {"amenity": "cafe"}),
    (216, 187, "Museum of Salt", {"tourism": "museum"}),
    (97, 247, "Vega Pharmacy", {"amenity": "pharmacy"}),
    (262, 66, EVIL, {"shop": "books"}),
)


PIXEL = """([x, y]) => {
    const canvas = document.querySelector("#map .over"), ratio = canvas.width / canvas.clientWidth;
    return [...canvas.getContext("2d").getImageData(x * ratio, y * ratio, 1, 1).data];
}"""


def named_town():
    """The tiny town with a few places that have names, one of them with markup for a name."""
    nodes = "".join(
        f'<node id="{10_000_000 + n}" version="1" lat="{LAT + y * LAT_M:.7f}" lon="{LON + x * LON_M:.7f}">'
        + "".join(f'<tag k="{k}" v="{escape(v)}"/>' for k, v in {**tags, "name": name}.items())
        + "</node>"
        for n, (x, y, name, tags) in enumerate(PLACES)
    )
    head, way, rest = tiny_osm().partition("<way ")  # nodes come before ways
    return head + nodes + way + rest


@pytest.fixture(scope="session")
def town_index(made_once):
    def make(out):
        (out / "town.osm").write_text(named_town())
        IndexJob(out / "town.osm", out / "index").build()

    return made_once("named-town", make) / "index"


@contextmanager
def served(settings, warm):
    """Serve in a thread and yield the address; the service's processes are forked from `warm`."""
    with forked_from(warm):
        server = uvicorn.Server(uvicorn.Config(create_app(settings), port=0, log_level="warning"))
        thread = threading.Thread(target=lambda: asyncio.run(server.serve()), daemon=True)
        thread.start()
        wait_until(lambda: server.started)
        url = f"http://127.0.0.1:{server.servers[0].sockets[0].getsockname()[1]}/"
        wait_until(lambda: is_ready(url.rstrip("/")))
    try:
        yield url
    finally:
        server.should_exit = True
        thread.join(60)


@pytest.fixture(scope="session")
def corrections_file(tmp_path_factory):
    return tmp_path_factory.mktemp("corrections") / "corrections.jsonl"


@pytest.fixture(scope="session")
def service(town_index, warm, corrections_file):
    with served(Settings(index_dir=town_index, corrections_file=corrections_file), warm) as url:
        yield url


@pytest.fixture(scope="module")  # while it lives no other test can run an event loop
def playwright():
    if CHROMIUM is None:
        pytest.skip("no chromium here: apt-get install chromium")
    with sync_playwright() as playwright:
        yield playwright


@pytest.fixture(scope="module")
def browser(playwright):
    browser = playwright.chromium.launch(executable_path=CHROMIUM, args=SOFTWARE)
    yield browser
    browser.close()


class Visitor:
    """Somebody at the page, who notes what must never happen."""

    def __init__(self, page, url):
        self.page, self.url = page, url
        self.wrong = []
        self.posted = []
        page.set_default_timeout(60_000)
        page.on("request", self._note)
        page.on("pageerror", lambda error: self.wrong.append(str(error)))
        page.on("console", self._hear)
        page.on("dialog", lambda dialog: (self.wrong.append("a dialog"), dialog.dismiss()))

    def _hear(self, message):
        # where the page looks for an example may be nothing to describe
        if message.type == "error" and not message.location["url"].endswith("/describe"):
            self.wrong.append(message.text)

    def _note(self, request):
        here, there = urlsplit(self.url), urlsplit(request.url)
        if there.scheme not in ("data", "blob") and there.netloc != here.netloc:
            self.wrong.append(f"left the origin: {request.url}")
        if request.method == "POST":
            is_json = request.headers.get("content-type") == "application/json"
            self.posted.append((there.path, request.post_data_json if is_json else request.post_data))

    def open(self, fragment=""):
        """Open the page, and wait for its map and its chips."""
        self.page.goto(self.url + fragment)
        self.page.wait_for_selector(CHIPS)
        return self

    def ask(self, text):
        """Type, press Enter, and wait for the answer."""
        self.page.fill("#said", text)
        with self.page.expect_response("**/localize") as response:
            self.page.keyboard.press("Enter")
        self.page.wait_for_selector("#answer[aria-busy=false] h2")
        return response.value.json()

    def shows(self, x, y, colour):
        """Whether a colour lies over the map at a place of the window, once flights have ended."""
        for _ in range(40):
            pixel = self.page.evaluate(PIXEL, [x, y])
            if max(abs(a - b) for a, b in zip(pixel, colour, strict=False)) < 12:
                return True
            self.page.wait_for_timeout(200)
        return False

    def middle(self):
        """Where in the window the map's middle is."""
        box, size = self.page.locator("#panel").bounding_box(), self.page.viewport_size
        if size["width"] <= 640:
            return size["width"] / 2, max(size["height"] / 2, box["y"]) / 2
        return (box["x"] + box["width"] + size["width"]) / 2, size["height"] / 2


@pytest.fixture
def visit(browser, service):
    """(url, expected errors, context options) -> a visitor; in the end nothing may have gone wrong."""
    visitors = []

    def visit(url=service, errors=(), **options):
        context = browser.new_context(**{"viewport": {"width": 1200, "height": 760}, **options})
        visitor = Visitor(context.new_page(), url)
        visitors.append((visitor, context, tuple(errors)))
        return visitor

    yield visit
    for visitor, context, errors in visitors:
        context.close()
        left = [wrong for wrong in visitor.wrong if not any(error in wrong for error in errors)]
        assert left == []
