"""Clients of Nominatim are pointed here, and find what they look for in the fields that they know."""

from dataclasses import replace
from xml.etree import ElementTree

import pytest
from fake_localizer import ADDRESS, FakeLocalizer
from geopy.adapters import URLLibAdapter
from geopy.geocoders import Nominatim

from app.http.schemas.geocoder import parse_position
from app.main import create_app
from app.settings import Settings
from models.citymap.frame import Frame

TEXT = "I am north of a gray building. A black pole is to my west."
HERE = (60.17, 24.94)
WHERE = {"lat": HERE[0], "lon": HERE[1]}
HOSTILE = "</place>\"'&<script>\x00\x0b\ufffe\ud800]]>"


@pytest.fixture
def fake_served():
    return FakeLocalizer()


@pytest.fixture
def served(in_a_thread, fake_served):
    with in_a_thread(create_app(Settings(), lambda: fake_served)) as port:
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


def test_geopy_sends_the_parts_of_an_address(geocoder, fake_served):
    query = {"street": "Main Street 1", "city": "Fakeville", "postalcode": "00100", "country": "Finland"}
    result = geocoder.geocode(query, addressdetails=True, namedetails=True, extratags=True, language="fi")
    assert result.raw["address"] == ADDRESS
    assert result.raw["namedetails"] == {"name": result.address} == {"name": "Main Streetillä"}
    assert result.raw["extratags"]["description"]
    [[query]] = fake_served.batches
    assert (query.description, query.language) == ("Main Street 1", "fi")
    assert geocoder.geocode({"city": "Fakeville", "country": "Finland"}, geometry="geojson", country_codes="fi")
    assert fake_served.batches[1][0].description == "Fakeville, Finland"


def test_geopy_finds_nothing(geocoder):
    assert geocoder.geocode("nowhere at all") is None
    assert geocoder.reverse((10.0, 10.0)) is None


def test_geopy_reverses(geocoder):
    result = geocoder.reverse(HERE)
    assert result.address == "on Main Street"
    assert (result.latitude, result.longitude) == pytest.approx(HERE, abs=1e-3)
    assert result.raw["extratags"]["description"].startswith("A green tree")
    assert result.raw["address"] == ADDRESS
    assert (result.raw["osm_type"], result.raw["osm_id"]) == ("way", 2)
    [other] = geocoder.reverse(HERE, exactly_one=False, language="fi", addressdetails=False, namedetails=True, zoom=18)
    assert other.address == other.raw["namedetails"]["name"] == "Main Streetillä"
    assert "address" not in other.raw


@pytest.mark.parametrize("form", ["json", "jsonv2"])
def test_json_has_nominatims_fields(api, form):
    [place, other] = api.get("/search", params={"q": TEXT, "format": form}).json()
    one = api.get("/reverse", params=WHERE | {"format": form}).json()
    for each in (place, other, one):
        south, north, west, east = map(float, each["boundingbox"])
        assert south < float(each["lat"]) < north
        assert west < float(each["lon"]) < east
        assert ("category" in each, "class" in each) == (form == "jsonv2", form == "json")
        assert {"place_id", "licence", "display_name", "importance", "place_rank", "addresstype"} <= set(each)
    assert one["address"] == ADDRESS
    assert "address" not in place
    assert "namedetails" not in place
    assert (place["osm_type"], place["osm_id"]) == ("node", 1)
    assert "osm_id" not in other, "it is about an object of the city's own data"


def test_geojson_has_nominatims_fields(api):
    listed = api.get("/search", params={"q": TEXT, "format": "geojson", "addressdetails": 1})
    one = api.get("/reverse", params=WHERE | {"format": "geojson"})
    for response in (listed, one):
        assert response.headers["content-type"] == "application/geo+json"
        feature = response.json()["features"][0]
        west, south, east, north = feature["bbox"]
        lon, lat = feature["geometry"]["coordinates"]
        assert west < lon < east
        assert south < lat < north
        assert feature["properties"]["display_name"] == "on Main Street"
        assert feature["properties"]["address"] == ADDRESS
        assert response.json()["licence"] == "© nobody"


def test_geocodejson_follows_its_specification(api):
    listed = api.get("/search", params={"q": TEXT, "format": "geocodejson", "addressdetails": 1}).json()
    one = api.get("/reverse", params=WHERE | {"format": "geocodejson"}).json()
    assert len(listed["features"]) == 2
    for content in (listed, one):
        assert content["geocoding"] == {"version": "0.1.0", "licence": "© nobody", "attribution": "© nobody"}
        fields = content["features"][0]["properties"]["geocoding"]
        assert {"place_id", "osm_type", "osm_id", "osm_key", "osm_value", "type"} <= fields.keys()
        assert (fields["label"], fields["name"]) == ("on Main Street", "on Main Street")
        assert (fields["housenumber"], fields["street"], fields["postcode"]) == ("1", "Main Street", "00100")


def test_xml_is_nominatims(api):
    response = api.get("/search", params={"q": TEXT, "format": "xml", "addressdetails": 1, "namedetails": 1})
    assert response.headers["content-type"] == "text/xml; charset=utf-8"
    assert response.headers["content-security-policy"] == "default-src 'none'; frame-ancestors 'none'"
    root = ElementTree.fromstring(response.content)
    assert (root.tag, root.attrib) == ("searchresults", {"attribution": "© nobody"})
    place = root[0]
    assert (place.tag, place.get("class"), place.get("osm_type"), place.get("osm_id")) == (
        "place",
        "place",
        "node",
        "1",
    )
    assert len(place.get("boundingbox").split(",")) == 4
    assert place.get("display_name") == place.findtext("namedetails/name") == "on Main Street"
    assert {part: place.findtext(part) for part in ADDRESS} == ADDRESS
    assert place.find("extratags/tag").get("key") == "description"
    root = ElementTree.fromstring(api.get("/reverse", params=WHERE).content)
    assert (root.tag, root.findtext("result")) == ("reversegeocode", "on Main Street")
    assert {part.tag: part.text for part in root.find("addressparts")} == ADDRESS
    assert root.find("result").get("osm_id") == "2"
    root = ElementTree.fromstring(api.get("/reverse", params=WHERE | {"addressdetails": 0}).content)
    assert root.find("addressparts") is None
    nowhere = ElementTree.fromstring(api.get("/reverse", params={"lat": 1, "lon": 1}).content)
    assert nowhere.findtext("error") == "Unable to geocode"


def test_xml_is_well_formed_whatever_names_are(api, fake, monkeypatch):
    described = fake.describe((0.0, 0.0))
    hostile = replace(described, place=HOSTILE, description=HOSTILE, address={"road": HOSTILE})
    monkeypatch.setattr(fake, "describe", lambda *_: hostile)
    plain = "</place>\"'&<script>]]>"
    for path, params in (("/search", {"q": TEXT}), ("/reverse", WHERE), ("/lookup", {"osm_ids": "N1"})):
        more = {"format": "xml", "addressdetails": 1, "namedetails": 1}
        root = ElementTree.fromstring(api.get(path, params=params | more).content)
        texts = [part for one in root.iter() for part in (one.text, *one.attrib.values())]
        assert texts.count(plain) >= 4


def test_objects_are_looked_up(api, fake):
    response = api.get("/lookup", params={"osm_ids": "N1,w2, R9,W3,,x,N1,way", "format": "jsonv2", "addressdetails": 1})
    assert [(place["osm_type"], place["osm_id"]) for place in response.json()] == [("node", 1), ("way", 2)]
    assert response.json()[0]["address"] == ADDRESS
    assert fake.positions == [(3.0, 0.0), (0.0, 0.0), (5000.0, 0.0)]
    assert ElementTree.fromstring(api.get("/lookup?osm_ids=N9").content).tag == "searchresults"


def test_places_keep_their_id(api):
    ids = [place["place_id"] for _ in range(2) for place in api.get("/search", params={"q": TEXT}).json()]
    assert ids[:2] == ids[2:]
    assert ids[0] != ids[1]
    one = api.get("/reverse", params=WHERE | {"format": "json"}).json()
    assert one["place_id"] == ids[0], "the same position"
    assert all(0 < number < 2**53 for number in ids)


def test_the_service_has_nominatims_status(api):
    text, report = api.get("/status"), api.get("/status?format=json")
    assert (text.text, text.headers["content-type"]) == ("OK", "text/plain; charset=utf-8")
    assert (report.json()["status"], report.json()["message"]) == (0, "OK")


def test_every_path_of_nominatim_is_there(api):
    queries = {"search": {"q": TEXT}, "reverse": WHERE, "lookup": {"osm_ids": "N1"}, "status": {}}
    for name, params in queries.items():
        first, *others = (api.get(f"/{name}{end}", params=params) for end in ("", "/", ".php"))
        assert first.status_code == 200
        assert [other.content for other in others] == [first.content] * 2


CLIENTS = {  # what they send, from their sources
    "leaflet-control-geocoder": "/search?q=TEXT&limit=5&format=json&addressdetails=1",
    "leaflet-control-geocoder reverse": "/reverse?lat=60.17&lon=24.94&zoom=18&addressdetails=1&format=json",
    "maplibre-gl-geocoder": "/search?q=TEXT&format=geojson&polygon_geojson=1&addressdetails=1",
    "QGIS": "/search?format=json&addressdetails=1&viewbox=24.9,60.1,25,60.2&countrycodes=fi&q=TEXT",
    "QGIS that shows the Earth": "/search?format=json&addressdetails=1&viewbox=-180,-90,180,90&q=TEXT",
    "empty": "/search?q=TEXT&limit=&viewbox=&countrycodes=&street=&bounded=&email=&format=&index=",
    "unknown": "/search?q=TEXT&dedupe=0&email=a@b&polygon_text=1&layer=poi&featureType=city&exclude_place_ids=1&x=y",
}


@pytest.mark.parametrize("sent", CLIENTS.values(), ids=CLIENTS)
def test_clients_are_answered(api, sent):
    response = api.get(sent.replace("TEXT", TEXT))
    assert response.status_code == 200
    content = response.json()
    if "geojson" in sent:
        for feature in content["features"]:
            assert len(feature["bbox"]) == 4
            assert feature["properties"]["display_name"]
        return
    for place in content if isinstance(content, list) else [content]:
        assert len(place["boundingbox"]) == 4
        assert ("address" in place) == ("addressdetails" in sent)


def test_limits_are_clamped(api, fake):
    counts = [len(api.get("/search", params={"q": TEXT, "limit": limit}).json()) for limit in (-3, 0, 1, 2, 41, 10**9)]
    assert counts == [1, 1, 1, 2, 2, 2]
    assert [batch[0].top_k for batch in fake.batches] == [1, 1, 1, 2, 40, 40]


@pytest.mark.parametrize(
    "text",
    [
        "60.17, 24.94", "60.17 24.94", "[60.17,24.94]", "+60.17;24.94", "N 60.17 E 24.94", "60.17n 24.94e",
        "60° 10.2 N, 24° 56.4 E", "N 60° 10.2' E 24° 56.4'", "60°10'12\"N 24°56'24\"E",
        "60°10\u203212\u2033N 24°56\u203224\u2033E",
    ],
)  # fmt: skip
def test_coordinates_are_described(api, fake, text):
    [place] = api.get("/search", params={"q": text, "addressdetails": 1, "accept-language": "fi"}).json()
    assert (float(place["lat"]), float(place["lon"])) == pytest.approx(HERE)
    assert (place["display_name"], place["address"]) == ("Main Streetillä", ADDRESS)
    assert fake.batches == []


def test_what_are_no_coordinates():
    assert parse_position("S 60° 10' W 24.5") == pytest.approx((-60 - 1 / 6, -24.5))
    assert parse_position("-60,-24.5") == (-60, -24.5)
    for text in ("60", "60 24 30", "91, 24", "60, 181", "60.1 24.9 a tree", "60,17 24,94", "", "9" * 4000, "1 " * 2000):
        assert parse_position(text) is None


@pytest.mark.parametrize("text", ["...", "\0", "\x01a tree", "🌳", " ", "?" * 5000, "10.0, 10.0", "nowhere"])
def test_nonsense_has_no_places(api, text):
    for form in ("jsonv2", "geojson", "geocodejson", "xml"):
        response = api.get("/search", params={"q": text, "format": form})
        assert response.status_code == 200
        places = response.json() if form != "xml" else [*ElementTree.fromstring(response.content)]
        assert (places["features"] if form.startswith("geo") else places) == []


def test_the_parameter_of_the_language_replaces_the_header(api, fake):
    headers = {"Accept-Language": "sv"}
    for language, expected in (("fi,en;q=0.5", "fi"), ("", "sv"), ("xx", None)):
        response = api.get("/search", params={"q": TEXT, "accept-language": language}, headers=headers)
        assert response.headers["content-language"] == (expected or "en")
    assert [batch[0].language for batch in fake.batches] == ["fi", "sv", None]
    assert api.get("/reverse", params=WHERE | {"accept-language": "fi"}).headers["content-language"] == "fi"


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
        ("/search?q=a+tree&street=b", "q"),
        ("/search?amenity=" + "a" * 201, "amenity"),
        ("/search?q=" + "a" * 4001, "q"),
        ("/search?q=a+tree&format=html", "format"),
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
        ("/reverse?lat=&lon=1", "lat"),
        ("/lookup", "osm_ids"),
        ("/lookup?osm_ids=" + ",".join(f"N{n}" for n in range(51)), "osm_ids"),
        ("/status?format=xml", "format"),
        ("/reverse?lat=1&lon=1&format=html", "format"),
        ("/reverse?lat=1&lon=1&index=../x", "index"),
    ],
)
def test_what_cannot_be_asked_is_refused_by_name(api, problem, path, field):
    problem(api.get(path), 422, "invalid_request", field)


def test_a_map_without_latitude_says_what_to_ask_instead(settings, start, problem):
    with start(settings, FakeLocalizer(frame=Frame("map", None, None))) as api:
        for path in ("/search?q=a+tree", "/reverse?lat=1&lon=1", "/lookup?osm_ids=N1"):
            assert "POST /localize" in problem(api.get(path), 406, "no_georeference")["detail"]
