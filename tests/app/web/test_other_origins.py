"""Maps of other sites that use the service as their geocoder, as it comes from npm."""

from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import pytest
from fake_localizer import FakeLocalizer

from app.main import create_app
from app.settings import Settings

pytestmark = pytest.mark.slow
PACKAGES = Path(__file__).parents[3] / "app/web/source/node_modules"
TEXT = "a church on my left"
LEAFLET = """
<link rel="stylesheet" href="/leaflet/dist/leaflet.css">
<link rel="stylesheet" href="/leaflet-control-geocoder/dist/Control.Geocoder.css">
<div id="map" style="height: 300px"></div>
<script src="/leaflet/dist/leaflet.js"></script>
<script src="/leaflet-control-geocoder/dist/Control.Geocoder.js"></script>
<script>
    const map = L.map("map").setView([0, 0], 3);
    const geocoder = L.Control.Geocoder.nominatim({{ serviceUrl: "{service}/" }});
    L.Control.geocoder({{ geocoder, collapsed: false, defaultMarkGeocode: true }}).addTo(map);
</script>
"""
MAPLIBRE = """
<link rel="stylesheet" href="/@maplibre/maplibre-gl-geocoder/dist/maplibre-gl-geocoder.css">
<div id="geocoder"></div>
<script src="/@maplibre/maplibre-gl-geocoder/dist/maplibre-gl-geocoder.js"></script>
<script>
    const forwardGeocode = async ({{ query, limit }}) => {{
        const headers = {{ "Accept": "application/geo+json", "Content-Type": "application/json" }};
        const body = JSON.stringify({{ description: query, top_k: limit }});
        const response = await fetch("{service}/localize", {{ method: "POST", headers, body }});
        const {{ features }} = await response.json();
        return {{ features: features.filter(({{ geometry }}) => geometry.type === "Point").map((feature) => ({{
            ...feature, center: feature.geometry.coordinates, place_name: "Place", place_type: ["place"], text: "Place",
        }})) }};
    }};
    const geocoder = new MaplibreGeocoder({{ forwardGeocode }}, {{ marker: false, flyTo: false }});
    geocoder.on("result", ({{ result }}) => {{ document.title = result.center; }});
    geocoder.addTo("#geocoder");
</script>
"""


class QuietHandler(SimpleHTTPRequestHandler):
    def log_message(self, *_message):
        """Log nothing."""


@pytest.fixture(scope="module")
def origin():
    """The address of a site with the npm packages."""
    if not (PACKAGES / "leaflet-control-geocoder").is_dir():
        pytest.skip("no npm packages here: npm ci in app/web/source")
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(QuietHandler, directory=PACKAGES)) as server:
        Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@pytest.fixture
def open_page(browser, origin, in_a_thread):
    """HTML -> a page with it at the other origin, which the service allows."""
    errors = []
    with in_a_thread(create_app(Settings(cors_origins=(origin,)), FakeLocalizer)) as port:
        page = browser.new_page()
        page.set_default_timeout(10_000)
        page.on("pageerror", lambda error: errors.append(str(error)))

        def open_page(html):
            page.goto(f"{origin}/leaflet/package.json")
            page.set_content(html.format(service=f"http://127.0.0.1:{port}"))
            return page

        yield open_page
        page.close()
    assert errors == []


def test_leaflet_control_geocoder_finds_a_place(open_page):
    page = open_page(LEAFLET)
    page.fill(".leaflet-control-geocoder-form input", TEXT)
    with page.expect_response("**/search?**") as response:
        page.keyboard.press("Enter")
    assert response.value.ok
    page.click(".leaflet-control-geocoder-alternatives li >> nth=0")
    page.wait_for_selector(".leaflet-popup-content")
    centre = page.evaluate("[map.getCenter().lat, map.getCenter().lng]")
    assert centre == pytest.approx([60.17, 24.94], abs=0.01)


def test_maplibre_gl_geocoder_finds_a_place(open_page):
    page = open_page(MAPLIBRE)
    page.fill("#geocoder input", TEXT)
    with page.expect_response("**/localize") as response:
        page.keyboard.press("Enter")
    assert response.value.ok
    page.click(".suggestions li >> nth=0")
    page.wait_for_function("document.title !== ''")
    assert [float(part) for part in page.title().split(",")] == pytest.approx([24.94, 60.17], abs=0.01)
