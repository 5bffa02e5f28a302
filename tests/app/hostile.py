"""A tiny town whose names are attacks on whoever reads them as more than text."""

from html import escape

from index.build.build import IndexJob
from tests.conftest import LAT, LAT_M, LON, LON_M, tiny_osm

SCRIPT = "<script>window.hacked=1</script>"
IMAGE = '"><img src=x onerror=window.hacked=1>'
TITLE = "</title></textarea><svg onload=window.hacked=1>"
LINK = "javascript:window.hacked=1"
ATTRIBUTE = "' onmouseover='window.hacked=1' autofocus onfocus='window.hacked=1"
TEMPLATE = "${window.hacked=1}${7*7}"
BRACES = "{{constructor.constructor('window.hacked=1')()}}{{7*7}}"
MARKDOWN = "[Inn](javascript:window.hacked=1)"
MAP = "<img src=x onerror=alert(1)>"
STREETS = [f"{attack} Street" for attack in (SCRIPT, IMAGE, TITLE, LINK, TEMPLATE, BRACES)]  # from south to north
KINDS = {
    "bakery": SCRIPT, "café": IMAGE, "museum": TITLE, "pharmacy": LINK, "book shop": ATTRIBUTE, "cinema": TEMPLATE,
    "supermarket": BRACES, "hotel": MARKDOWN,
}  # fmt: skip  # what to ask for, and what it goes by
PLACES = (  # metres east and north, name, tags
    (37, 5, SCRIPT, {"shop": "bakery"}),
    (157, 117, IMAGE, {"amenity": "cafe"}),
    (216, 187, TITLE, {"tourism": "museum"}),
    (97, 247, LINK, {"amenity": "pharmacy"}),
    (262, 66, ATTRIBUTE, {"shop": "books"}),
    (37, 187, TEMPLATE, {"amenity": "cinema"}),
    (277, 247, BRACES, {"shop": "supermarket"}),
    (157, 5, MARKDOWN, {"tourism": "hotel"}),
    (97, 66, "Odd Shop", {"shop": SCRIPT, "operator": IMAGE, "brand": TITLE, "description": SCRIPT}),
    (217, 66, "", {"addr:housenumber": '7"><b>', "addr:street": STREETS[1]}),
)


def hostile_town():
    """OpenStreetMap's XML of it."""
    nodes = "".join(
        f'<node id="{10_000_000 + n}" version="1" lat="{LAT + y * LAT_M:.7f}" lon="{LON + x * LON_M:.7f}">'
        + "".join(f'<tag k="{k}" v="{escape(v)}"/>' for k, v in {**tags, "name": name}.items() if v)
        + "</node>"
        for n, (x, y, name, tags) in enumerate(PLACES)
    )
    town = tiny_osm()
    for n, name in enumerate(STREETS):
        town = town.replace(f'"East Street {n}"', f'"{escape(name)}"')
    head, way, rest = town.partition("<way ")  # nodes come before ways
    return head + nodes + way + rest


def hostile_index(made_once):
    """An index of it, whose map has such a name too."""

    def make(out):
        (out / f"{MAP}.osm").write_text(hostile_town())
        IndexJob(out / f"{MAP}.osm", out / "index").build()

    return made_once("hostile-town", make) / "index"
