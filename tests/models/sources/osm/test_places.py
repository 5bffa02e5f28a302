"""Named areas in a file of two towns of 200 x 200 m, side by side and with a border in common."""

import re

import osmium
import pytest
import shapely

from models.errors import MapError
from models.sources.osm.extract import Region, extracted_file
from models.sources.osm.places import find_place, list_places

WEST, SOUTH, SIDE = 25.0, 60.0, 0.002
# Corners of the towns from the southwest, around the western one, and a hole in the eastern one; 0 is not in the file
CORNERS = {1: (0, 0), 2: (1, 0), 3: (1, 1), 4: (0, 1), 5: (2, 0), 6: (2, 1)}
HOLE = {7: (1.4, 0.4), 8: (1.6, 0.4), 9: (1.6, 0.6), 10: (1.4, 0.6)}
STREETS = {11: (0.1, 0.5), 12: (0.9, 0.5), 13: (1.1, 0.2), 14: (1.9, 0.2)}
WAYS = {1: [3, 4, 1, 2], 2: [2, 3], 3: [2, 5, 6, 3], 4: [7, 8, 9, 10, 7]}


def town(number, members, **tags):
    body = "".join(f'<member type="way" ref="{way}" role="{role}"/>' for way, role in members)
    tags = {key.replace("__", ":"): value for key, value in tags.items()} | {"type": "boundary"}
    body += "".join(f'<tag k="{key}" v="{value}"/>' for key, value in tags.items())
    return f'<relation id="{number}" version="1">{body}</relation>'


def way(number, nodes, **tags):
    body = "".join(f'<nd ref="{node}"/>' for node in nodes)
    body += "".join(f'<tag k="{key}" v="{value}"/>' for key, value in tags.items())
    return f'<way id="{number}" version="1">{body}</way>'


ADMINISTRATIVE = {"boundary": "administrative", "admin_level": "8"}
WESTBURY = town(
    1, [(1, "outer"), (2, "outer")], name="Westbury", name__fr="Ouestbourg", alt_name="Óld; Villa", **ADMINISTRATIVE
)
EASTON = town(2, [(2, "outer"), (3, "outer"), (4, "inner")], name="Easton", **ADMINISTRATIVE)
FARAWAY = town(3, [(2, ""), (99, "")], name="Faraway", boundary="administrative", admin_level="6")
REGION = town(4, [(1, "outer"), (3, "outer")], name="WESTBURY", boundary="administrative", admin_level="6")
OPEN = town(5, [(1, "outer")], name="Open", boundary="administrative")
SUBURB = way(5, WAYS[4], name="Holm", place="suburb")
SQUARE = way(6, WAYS[4], name="Main Square", place="square")


@pytest.fixture
def write(tmp_path):
    """Write a file with the towns' ways, two streets, and other elements."""

    def write_file(*elements):
        nodes = "".join(
            f'<node id="{n}" version="1" lon="{WEST + SIDE * x:.7f}" lat="{SOUTH + SIDE * y:.7f}"/>'
            for n, (x, y) in (CORNERS | HOLE | STREETS).items()
        )
        ways = [way(number, refs) for number, refs in WAYS.items()]
        ways += [way(7, [11, 12], highway="residential", name="West Street")]
        ways += [way(8, [13, 14], highway="residential", name="East Street")]
        ways += [each for each in elements if each.startswith("<way")]
        relations = [each for each in elements if each.startswith("<relation")]
        path = tmp_path / "towns.osm"
        path.write_text(f'<osm version="0.6">{nodes}{"".join(ways)}{"".join(relations)}</osm>', encoding="utf-8")
        return path

    return write_file


def square(west, east):
    return shapely.box(WEST + SIDE * west, SOUTH, WEST + SIDE * east, SOUTH + SIDE)


@pytest.mark.parametrize("name", ["Westbury", "wESTBURY", "ouestbourg", "old", "Villa", "relation/1"])
def test_a_place_is_chosen_by_any_of_its_names_or_its_id(write, name) -> None:
    path = write(WESTBURY, EASTON)
    assert shapely.equals_exact(shapely.normalize(find_place(path, name)), shapely.normalize(square(0, 1)), 1e-9)


def test_holes_are_outside(write) -> None:
    path = write(EASTON)
    shape = find_place(path, "easton")
    assert shape.area == pytest.approx(SIDE**2 * 0.96)
    assert not shape.contains(shapely.Point(WEST + 1.5 * SIDE, SOUTH + 0.5 * SIDE))


def test_a_region_of_a_place_has_its_streets_alone(write) -> None:
    path = write(WESTBURY, EASTON)
    with extracted_file(path, Region.parse("place:Westbury", path)) as part:
        names = {element.tags.get("name") for element in osmium.FileProcessor(str(part), osmium.osm.WAY)}
        assert "West Street" in names
        assert "East Street" not in names


def test_places_of_one_name_are_listed_with_how_to_choose(write) -> None:
    path = write(WESTBURY, EASTON, REGION)
    with pytest.raises(MapError, match="names 2 places") as error:
        Region.parse("place:westbury", path)
    assert "WESTBURY (admin_level 6, 0.0" in str(error.value)
    assert "Westbury (admin_level 8, 0.0" in str(error.value)
    assert "--within place:relation/4" in str(error.value)
    assert Region.parse("place:relation/4", path).shape.area == pytest.approx(2 * SIDE**2)


def test_the_only_complete_place_of_a_name_is_chosen(write) -> None:
    path = write(WESTBURY, town(9, [(1, ""), (99, "")], name="Westbury", **ADMINISTRATIVE))
    assert find_place(path, "westbury").area == pytest.approx(SIDE**2)


@pytest.mark.parametrize(
    ("relation", "name", "reason"),
    [(FARAWAY, "faraway", "1 of its 2 ways are not in the file"), (OPEN, "open", "do not close to a ring")],
)
def test_an_incomplete_boundary_is_refused_with_what_it_lacks(write, relation, name, reason) -> None:
    with pytest.raises(MapError, match=reason) as error:
        Region.parse(f"place:{name}", write(relation))
    assert "GeoJSON" in str(error.value)


def test_an_unknown_place_gets_similar_names(write) -> None:
    path = write(WESTBURY, EASTON)
    with pytest.raises(MapError, match=r"no place 'Eston'; did you mean Easton\?.*--list-places"):
        Region.parse("place:Eston", path)
    with pytest.raises(MapError, match=r"no place 'Tokyo'; '.*--list-places"):
        Region.parse("place:Tokyo", path)


def test_places_are_listed_by_size_and_incomplete_ones_last(write) -> None:
    areas = list_places(write(FARAWAY, EASTON, SUBURB, SQUARE, REGION))
    assert [area.names[0] for area in areas] == ["WESTBURY", "Easton", "Holm", "Faraway"]
    assert [area.size for area in areas][-1] == "incomplete"
    assert (areas[2].place, areas[2].source_id, areas[2].size) == ("suburb", "way/5", "0.001 km2")
    assert areas[1].area_km2 == pytest.approx(0.96 * 0.2224 * 0.1112, rel=0.01)


def test_only_a_map_file_has_places(tmp_path) -> None:
    with pytest.raises(MapError, match="give such a file"):
        list_places(tmp_path)
    (tmp_path / "bad.osm.pbf").write_bytes(b"no" * 100)
    with pytest.raises(MapError, match=re.escape("bad.osm.pbf")):
        list_places(tmp_path / "bad.osm.pbf")
