"""Maps that are cut at a box, and rings that are broken: what is known of an object keeps its name."""

from pathlib import Path

import numpy as np
import osmium
import pytest
import shapely

import models
from models.sources.osm.extent import read_extent
from models.sources.osm.gazetteer import load_gazetteer
from models.sources.osm.map import load_osm
from models.sources.osm.reading_counts import ReadingCounts

HELSINKI = Path(models.__file__).parent / "maps" / "helsinki.osm.pbf"
HEADER = "<?xml version='1.0' encoding='UTF-8'?><osm version='0.6'>"
POSITIONS = {  # of nodes by id: metres east and north, about
    1: (0, 0), 2: (60, 0), 3: (120, 0), 4: (180, 0), 5: (240, 0),
    11: (20, 20), 12: (60, 20), 13: (60, 60), 14: (20, 60), 15: (20, 40),
    21: (100, 20), 22: (200, 20), 23: (200, 90), 24: (100, 90),
}  # fmt: skip
ROAD = {"highway": "residential", "name": "Mill Street"}


def way(number: int, refs: list[int], **tags: str) -> str:
    return f'<way id="{number}">' + "".join(f'<nd ref="{ref}"/>' for ref in refs) + written(tags) + "</way>"


def relation(members: dict[int, str], **tags: str) -> str:
    body = "".join(f'<member type="way" ref="{ref}" role="{role}"/>' for ref, role in members.items())
    return f'<relation id="7">{body}{written(tags)}</relation>'


def written(tags: dict[str, str]) -> str:
    return "".join(f'<tag k="{key}" v="{value}"/>' for key, value in tags.items())


class Town:
    """A map of a street and of one more object, read into instances and a gazetteer."""

    def __init__(self, folder: Path, body: str) -> None:
        nodes = "".join(
            f'<node id="{n}" lat="{60 + y / 111_412:.7f}" lon="{25 + x / 55_800:.7f}"/>'
            for n, (x, y) in POSITIONS.items()
        )
        path = folder / "town.osm"
        path.write_text(HEADER + nodes + way(1, [1, 2, 3, 4, 5], highway="service") + body + "</osm>", "utf-8")
        self.city = load_osm(path)
        self.counts = ReadingCounts()
        self.gazetteer = load_gazetteer(path, self.city.frame, self.counts)

    def shape(self, name: str) -> shapely.Geometry:
        """Return the geometry of the instances with a name."""
        numbers = [instance.id for instance in self.city.instances if instance.name == name]
        return shapely.union_all(self.city.pieces.geometry(np.flatnonzero(np.isin(self.city.pieces.instance, numbers))))

    def segments(self, name: str) -> tuple[np.ndarray, bool]:
        """Return the lengths of the segments of the object with a name, and whether it is an area."""
        (number,) = (n for n, item in enumerate(self.gazetteer.objects) if name in item.names)
        ends = self.gazetteer.segments_m[self.gazetteer.starts[number] : self.gazetteer.starts[number + 1]]
        return np.hypot(*(ends[:, 2:] - ends[:, :2]).T), bool(self.gazetteer.is_area[number])

    def names(self) -> set[str]:
        return {name for item in self.gazetteer.objects for name in item.names}


def test_a_street_keeps_its_parts_between_unknown_nodes(tmp_path) -> None:
    town = Town(tmp_path, way(2, [901, 1, 2, 902, 4, 5, 903], **ROAD))
    assert shapely.area(town.shape("Mill Street")) == pytest.approx(2 * 60 * 6, rel=0.02)
    lengths, is_area = town.segments("Mill Street")
    assert lengths == pytest.approx([60, 60], abs=0.5)
    assert not is_area
    assert (town.counts.cut.total(), town.counts.dropped.total()) == (1, 0)


def test_a_street_with_one_known_node_is_named_there(tmp_path) -> None:
    town = Town(tmp_path, way(2, [1, 901, 902], **ROAD) + way(3, [1, 11], highway="residential", name="Oak Avenue"))
    lengths, _ = town.segments("Mill Street")
    assert lengths.tolist() == [0]
    assert len(town.gazetteer.corners_m) == 1, "its only node is a corner with the other street"
    assert "Mill Street" not in {instance.name for instance in town.city.instances}


def test_a_street_without_known_nodes_is_left_out(tmp_path) -> None:
    town = Town(tmp_path, way(2, [901, 902], **ROAD))
    assert town.names() == set()
    assert (town.counts.cut.total(), town.counts.dropped.total()) == (0, 1)


HALL = {"building": "yes", "amenity": "townhall", "name": "City Hall"}
PARK = {"leisure": "park", "name": "Green Park"}


def test_an_outline_with_a_small_gap_is_closed(tmp_path) -> None:
    town = Town(tmp_path, way(2, [11, 12, 13, 14, 901, 11], **HALL))
    lengths, is_area = town.segments("City Hall")
    assert is_area
    assert lengths.sum() == pytest.approx(160, rel=0.01)
    assert town.shape("City Hall").length == pytest.approx(160, rel=0.05)


def test_an_outline_with_a_large_gap_is_a_line(tmp_path) -> None:
    town = Town(tmp_path, way(2, [12, 901, 902, 11, 12], **HALL))
    lengths, is_area = town.segments("City Hall")
    assert not is_area
    assert lengths == pytest.approx([40], abs=0.5), "the ring starts in the middle of what is known"
    assert town.shape("City Hall").length > 35


def test_an_area_with_one_known_node_is_named_there(tmp_path) -> None:
    lengths, is_area = Town(tmp_path, way(2, [11, 901, 902, 11], **PARK)).segments("Green Park")
    assert (lengths.tolist(), is_area) == ([0], False)


def test_a_ring_that_crosses_itself_is_what_it_encloses(tmp_path) -> None:
    town = Town(tmp_path, way(2, [21, 23, 22, 24, 21], **PARK))
    assert town.segments("Green Park")[1]
    assert shapely.area(town.shape("Green Park")) == pytest.approx(100 * 70 / 2, rel=0.02)
    assert (town.counts.cut.total(), town.counts.repaired.total()) == (0, 1)


def test_a_ring_that_is_a_line_keeps_its_name(tmp_path) -> None:
    lengths, is_area = Town(tmp_path, way(2, [21, 22, 21], **PARK)).segments("Green Park")
    assert lengths.sum() >= 99
    assert not is_area


def test_a_closed_way_that_is_tagged_as_no_area_is_left_out(tmp_path) -> None:
    assert Town(tmp_path, way(2, [21, 22, 23, 24, 21], area="no", **PARK)).names() == set()


OUTER = way(2, [21, 22, 23]) + way(3, [23, 24, 21])


@pytest.mark.parametrize(
    ("ways", "expected_m2"),
    [
        (OUTER, 100 * 70),
        (way(2, [21, 22, 23]) + way(3, [23, 24, 901, 21]), 100 * 70),  # one node is not there
        (way(2, [21, 22, 23, 24]), 100 * 70),  # one way is not there
        (way(2, [21, 22, 23]), 2 * 170),  # the gap is too large: a strip of two metres
    ],
)
def test_a_multipolygon_keeps_what_is_known_of_it(tmp_path, ways, expected_m2) -> None:
    town = Town(tmp_path, ways + relation({2: "outer", 3: "outer"}, type="multipolygon", **PARK))
    assert shapely.area(town.shape("Green Park")) == pytest.approx(expected_m2, rel=0.03)
    assert town.segments("Green Park")[1] == (expected_m2 > 1000)


def test_a_hole_stays_a_hole(tmp_path) -> None:
    ways = way(2, [21, 22, 23, 24, 901, 21]) + way(3, [11, 12, 13, 14, 11])
    shifted = ways.replace('ref="1', 'ref="12')  # inside the other
    inside = "".join(
        f'<node id="{n}" lat="{60 + y / 111_412:.7f}" lon="{25 + x / 55_800:.7f}"/>'
        for n, x, y in ((121, 120, 40), (122, 160, 40), (123, 160, 60), (124, 120, 60))
    )
    town = Town(tmp_path, inside + shifted + relation({2: "outer", 3: "inner"}, type="multipolygon", **PARK))
    assert shapely.area(town.shape("Green Park")) == pytest.approx(100 * 70 - 40 * 20, rel=0.02)


@pytest.mark.parametrize("tags", [{"boundary": "administrative"}, {"place": "suburb"}])
def test_a_district_is_not_its_border(tmp_path, tags) -> None:
    body = way(2, [21, 22, 901, 902, 21], name="Oldtown", tourism="attraction", **tags)
    assert Town(tmp_path, body).names() == set()
    body = way(2, [21, 22, 23, 24, 901, 21], name="Oldtown", tourism="attraction", **tags)
    assert Town(tmp_path, body).segments("Oldtown")[1]


def test_an_area_across_180_degrees_is_closed(tmp_path) -> None:
    nodes = "".join(
        f'<node id="{n}" lat="{lat}" lon="{lon}"/>'
        for n, lat, lon in ((1, -16, 179.999), (2, -16, -179.999), (3, -15.998, -179.999), (4, -15.998, 179.999))
    )
    path = tmp_path / "fiji.osm"
    path.write_text(
        HEADER + nodes + way(1, [1, 2], **ROAD) + way(2, [1, 2, 3, 4, 901, 1], **PARK) + "</osm>", encoding="utf-8"
    )
    gazetteer = load_gazetteer(path, read_extent(path).frame)
    assert gazetteer.is_area[0]
    assert np.ptp(gazetteer.segments_m[:, 0]) < 300


def test_the_names_of_cut_ways_are_found_in_helsinki() -> None:
    gazetteer = load_gazetteer(HELSINKI, read_extent(HELSINKI).frame)
    names = {name for item in gazetteer.objects for name in item.names}
    processor = osmium.FileProcessor(str(HELSINKI), osmium.osm.NODE | osmium.osm.WAY).with_locations()
    cut = {
        element.id: element.tags["name"]
        for element in processor.with_filter(osmium.filter.EntityFilter(osmium.osm.WAY))
        if "name" in element.tags and not all(node.location.valid() for node in element.nodes)
    }
    assert len(cut) == 78
    ferry = 170463494  # a route: what goes along it passes, and no description is given from there
    assert {number for number, name in cut.items() if name not in names} == {ferry}
    whole = {"Iso Roobertinkatu", "Narinkkatori", "Pääesikunta", "Musiikkitalo", "Helsinki City Hall"}
    assert whole <= names
