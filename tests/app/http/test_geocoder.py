"""Clients of Nominatim are pointed here, and find what they look for in the fields that they know."""

import pytest
from fake_localizer import FakeLocalizer
from geopy.adapters import URLLibAdapter
from geopy.geocoders import Nominatim

from app.main import create_app
from app.settings import Settings
from models.citymap.frame import Frame

TEXT = "I am north of a gray building. A black pole is to my west."
HERE = (60.17, 24.94)


@pytest.fixture
def served(in_a_thread):
    with in_a_thread(create_app(Settings(), FakeLocalizer)) as port:
        yield port


@pytest.fixture
def geocoder(served):
    return Nominatim(user_agent="a test", domain=f"127.0.0.1:{served}", scheme="http", adapter_factory=URLLibAdapter)


def test_geopy_finds_a_description(geocoder):
    result = geocoder.geocode(TEXT)
    assert (result.latitude, result.longitude) == pytest.approx(HERE, abs=1e-4)
    assert result.address == "on Main Street"
    assert result.raw["importance"] == 0.8
    assert result.raw["class"] == "place"


def test_geopy_lists_and_biases(geocoder):
    result = geocoder.geocode(TEXT, exactly_one=False, limit=3, viewbox=[(60.1, 24.9), (60.2, 25.0)], language="en")
    assert len(result) == 2
    assert geocoder.geocode(TEXT, viewbox=[(60.1, 24.9), (60.2, 25.0)], bounded=True).latitude


def test_geopy_finds_nothing(geocoder):
    assert geocoder.geocode("nowhere at all") is None
    assert geocoder.reverse((10.0, 10.0)) is None


def test_geopy_reverses(geocoder):
    result = geocoder.reverse(HERE)
    assert result.address == "on Main Street"
    assert (result.latitude, result.longitude) == pytest.approx(HERE, abs=1e-3)
    assert result.raw["extratags"]["description"].startswith("A green tree")


@pytest.mark.parametrize("form", ["json", "jsonv2", "geojson"])
def test_formats_have_nominatims_fields(api, form):
    listed = api.get("/search", params={"q": TEXT, "format": form})
    one = api.get("/reverse", params={"lat": HERE[0], "lon": HERE[1], "format": form})
    assert listed.status_code == one.status_code == 200
    if form == "geojson":
        assert listed.headers["content-type"] == "application/geo+json"
        for result in (listed.json(), one.json()):
            feature = result["features"][0]
            west, south, east, north = feature["bbox"]
            lon, lat = feature["geometry"]["coordinates"]
            assert west < lon < east
            assert south < lat < north
            assert feature["properties"]["display_name"] == "on Main Street"
            assert result["licence"] == "© nobody"
        return
    for place in (listed.json()[0], one.json()):
        south, north, west, east = map(float, place["boundingbox"])
        assert south < float(place["lat"]) < north
        assert west < float(place["lon"]) < east
        assert ("category" in place, "class" in place) == (form == "jsonv2", form == "json")
        assert {"place_id", "licence", "display_name", "importance", "place_rank", "addresstype"} <= set(place)


def test_what_nominatim_knows_and_this_does_not_is_passed_over(api, fake):
    unknown = {"addressdetails": 1, "accept-language": "fi", "countrycodes": "fi", "email": "a@b", "dedupe": 0}
    assert api.get("/search", params={"q": TEXT, **unknown}).status_code == 200
    assert api.get("/reverse", params={"lat": HERE[0], "lon": HERE[1], "zoom": 18, **unknown}).status_code == 200


def test_a_viewbox_is_a_bias_or_a_bound(api, fake):
    params = {"q": TEXT, "viewbox": "24.9,60.2,25.0,60.1", "limit": 2}
    api.get("/search", params=params)
    api.get("/search", params=params | {"bounded": 1})
    [[bias], [bound]] = fake.batches
    assert bias.prior.position == pytest.approx((24.95, 60.15))
    assert 5000 < bias.prior.sigma_m < 8000
    assert bias.within is None
    assert (bound.within.west, bound.within.south, bound.within.east, bound.within.north) == (24.9, 60.1, 25.0, 60.2)
    assert (bias.crs, bias.top_k) == ("wgs84", 2)


@pytest.mark.parametrize(
    ("path", "field"),
    [
        ("/search", "q"),
        ("/search?q=", "q"),
        ("/search?q=%00", "q"),
        ("/search?q=" + "a" * 4001, "q"),
        ("/search?q=a+tree&format=xml", "format"),
        ("/search?q=a+tree&limit=0", "limit"),
        ("/search?q=a+tree&limit=many", "limit"),
        ("/search?q=a+tree&viewbox=1,2,3", "viewbox"),
        ("/search?q=a+tree&viewbox=a,b,c,d", "viewbox"),
        ("/search?q=a+tree&viewbox=nan,nan,nan,nan", "viewbox"),
        ("/search?q=a+tree&viewbox=0,0,500,500", "viewbox"),
        ("/search?q=a+tree&viewbox=0,0,500,500&bounded=1", "viewbox"),
        ("/reverse", "lat"),
        ("/reverse?lat=91&lon=0", "lat"),
        ("/reverse?lat=nan&lon=0", "lat"),
        ("/reverse?lat=1&lon=inf", "lon"),
        ("/reverse?lat=1&lon=1&format=html", "format"),
        ("/reverse?lat=1&lon=1&index=../x", "index"),
    ],
)
def test_what_cannot_be_asked_is_refused_by_name(api, problem, path, field):
    problem(api.get(path), 422, "invalid_request", field)


def test_a_map_without_latitude_says_what_to_ask_instead(settings, start, problem):
    with start(settings, FakeLocalizer(frame=Frame("map", None, None))) as api:
        for path in ("/search?q=a+tree", "/reverse?lat=1&lon=1"):
            assert "POST /localize" in problem(api.get(path), 406, "no_georeference")["detail"]
