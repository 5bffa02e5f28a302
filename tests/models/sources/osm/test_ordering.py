"""Files of any tool: they are read as the sorted file of the newest elements that they stand for."""

import bz2
import gzip
import os
import re
import resource
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import osmium
import pytest

from models.errors import DataError, MapError
from models.sources.osm import ordering, reading
from models.sources.osm.extent import read_extent
from models.sources.osm.extract import Region, extracted_file
from models.sources.osm.gazetteer import load_gazetteer
from models.sources.osm.map import load_osm
from models.sources.osm.ordering import ordered_file
from models.sources.osm.reading import original_id, positive_id

HEADER = "<?xml version='1.0' encoding='UTF-8'?>\n<osm version='0.6' generator='hand'>\n"
BOX = '<bounds minlat="59.999" minlon="24.999" maxlat="60.003" maxlon="25.003"/>\n'
NODES = [
    '<node id="1" version="2" lat="60.0" lon="25.0"/>',
    '<node id="2" version="1" lat="60.0" lon="25.002"/>',
    '<node id="3" version="1" lat="60.001" lon="25.0"/>',
    '<node id="4" version="1" lat="60.001" lon="25.001"/>',
    '<node id="5" version="1" lat="60.002" lon="25.001"/>',
    '<node id="6" version="1" lat="60.0005" lon="25.0005"><tag k="amenity" v="cafe"/><tag k="name" v="Blue Door"/>'
    "</node>",
    '<node id="7" version="1" lat="60.0003" lon="25.0007"><tag k="amenity" v="bench"/></node>',
]
WAYS = [
    '<way id="1" version="1"><nd ref="1"/><nd ref="2"/><tag k="highway" v="residential"/>'
    '<tag k="name" v="Mill Street"/></way>',
    '<way id="2" version="1"><nd ref="3"/><nd ref="4"/><nd ref="5"/></way>',
    '<way id="3" version="1"><nd ref="5"/><nd ref="3"/></way>',
]
RELATIONS = [
    '<relation id="1" version="1"><member type="way" ref="2" role="outer"/><member type="way" ref="3" role="outer"/>'
    '<tag k="type" v="multipolygon"/><tag k="leisure" v="park"/><tag k="name" v="Green Park"/></relation>'
]
GHOST = (
    '<node id="6" version="{}" {} lat="60.001" lon="25.001"><tag k="amenity" v="cafe"/><tag k="name" v="Ghost"/></node>'
)


def joined(*parts: list[str] | str) -> str:
    return "\n".join("\n".join([part] if isinstance(part, str) else part) for part in parts)


def negative(body: str) -> str:
    return re.sub(r'(id|ref)="(\d+)"', r'\1="-\2"', re.sub(r' version="\d+"', " action='modify' visible='true'", body))


PLAIN = joined(NODES, WAYS, RELATIONS)
FILES = {
    "reversed": joined(RELATIONS, WAYS[::-1], NODES[::-1]),
    "nodes after ways": joined(NODES[2:], WAYS, NODES[:2], RELATIONS),
    "JOSM": negative(PLAIN),
    "JOSM, some new": joined(negative(joined(NODES[5:])), NODES[:5], WAYS, RELATIONS),
    "JOSM, deleted": joined(NODES, '<node id="9" action="delete" version="2" lat="60" lon="25.001">'
                            '<tag k="amenity" v="bench"/></node>', WAYS, RELATIONS),
    "history": joined(GHOST.format(0, 'visible="true"').replace('id="6"', 'id="5"'), NODES[:5], NODES[5:],
                      GHOST.format(1, 'visible="true"').replace('id="6"', 'id="8"'),
                      '<node id="8" version="3" visible="false"/>',
                      GHOST.format(2, 'visible="true"').replace('id="6"', 'id="8"'), WAYS, RELATIONS),
    "deleted": joined(NODES, GHOST.format(1, 'visible="false"').replace('id="6"', 'id="8"'), WAYS, RELATIONS),
    "duplicates": joined(NODES, NODES, WAYS, WAYS, RELATIONS, RELATIONS),
    "an older duplicate": joined(GHOST.format(0, ""), NODES, WAYS, RELATIONS),
}  # fmt: skip


def content(path: Path) -> tuple[set, set]:
    """Return the labels and names of instances, and the names and kinds of the gazetteer."""
    city = load_osm(path)
    gazetteer = load_gazetteer(path, city.frame)
    return {(i.label, i.name) for i in city.instances}, {(item.kinds, item.names) for item in gazetteer.objects}


@pytest.fixture(scope="module")
def expected(tmp_path_factory) -> tuple[set, set]:
    path = tmp_path_factory.mktemp("plain") / "town.osm"
    path.write_text(HEADER + BOX + PLAIN + "</osm>")
    with ordered_file(path) as ordered:
        assert ordered == path, "it is read as it is"
    result = content(path)
    assert result[0] == {("road", "Mill Street"), ("bench", None), ("park", "Green Park")}
    return result


@pytest.fixture(autouse=True)
def _small_runs(monkeypatch) -> None:
    monkeypatch.setattr(ordering, "ELEMENTS_PER_RUN", 3)


@pytest.fixture
def temporary(tmp_path, monkeypatch) -> Path:
    """A directory for temporary files, which is empty before and after each test."""
    directory = tmp_path / "temporary"
    directory.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(directory))
    return directory


@pytest.mark.parametrize("name", FILES)
def test_a_file_of_a_tool_is_the_map_that_it_stands_for(tmp_path, temporary, expected, name) -> None:
    path = tmp_path / "town.osm"
    path.write_text(HEADER + BOX + FILES[name] + "</osm>")
    assert content(path) == expected
    assert read_extent(path).box == pytest.approx((24.999, 59.999, 25.003, 60.003))
    assert not list(temporary.iterdir())


def write_pbf(text: str, path: Path) -> None:
    source = path.with_name("source.osm")
    source.write_text(text)
    with osmium.SimpleWriter(str(path)) as writer:
        for element in osmium.FileProcessor(str(source)):
            writer.add(element)


WRITERS: dict[str, Callable[[str, Path], object]] = {
    "TOWN.OSM": lambda text, path: path.write_text(text),
    "town.osm.gz": lambda text, path: path.write_bytes(gzip.compress(text.encode())),
    "Town.Osm.BZ2": lambda text, path: path.write_bytes(bz2.compress(text.encode())),
    "town.osh.pbf": write_pbf,
}


@pytest.mark.parametrize(
    ("name", "body"),
    [*((name, "JOSM, deleted") for name in list(WRITERS)[:-1]), *((name, "history") for name in WRITERS)],
)
def test_suffixes(tmp_path, temporary, expected, name, body) -> None:
    path = tmp_path / name
    WRITERS[name](HEADER + BOX + FILES[body] + "</osm>", path)
    assert content(path)[0] == expected[0]
    assert not list(temporary.iterdir())


def test_an_upper_case_pbf(tmp_path, expected) -> None:
    path = tmp_path / "map.osm.pbf"
    write_pbf(HEADER + BOX + PLAIN + "</osm>", path)
    path = path.rename(tmp_path / "MAP.OSM.PBF")
    assert content(path)[0] == expected[0]
    assert load_osm(path).name == "MAP"


def test_a_negative_id_stays_in_the_source_of_an_object(tmp_path) -> None:
    path = tmp_path / "town.osm"
    path.write_text(HEADER + BOX + FILES["JOSM"] + "</osm>")
    city = load_osm(path)
    assert {i.source_id for i in city.instances} == {"way/-1", "node/-7", "relation/-1"}
    assert {item.source_id for item in load_gazetteer(path, city.frame).objects} >= {"node/-6", "way/-1", "relation/-1"}
    assert [original_id(positive_id(number)) for number in (-5, 0, 7)] == [-5, 0, 7]


def test_a_sorted_pbf_with_negative_ids(tmp_path, expected) -> None:
    path, negatives = tmp_path / "town.osm.pbf", tmp_path / "source.osm"
    negatives.write_text(HEADER + BOX + FILES["JOSM"] + "</osm>")
    header = osmium.io.Header()
    header.set("sorting", "Type_then_ID")
    with osmium.SimpleWriter(str(path), header=header) as writer:
        for element in osmium.FileProcessor(str(negatives)):
            writer.add(element)
    assert content(path)[0] == expected[0]


def test_the_box_of_several_downloads_is_around_all(tmp_path) -> None:
    path = tmp_path / "town.osm"
    west, east = (
        f'<bounds minlat="59.999" minlon="{a}" maxlat="60.003" maxlon="{b}"/>'
        for a, b in ((24.999, 25.001), (25.001, 25.003))
    )
    path.write_text(HEADER + west + east + PLAIN + "</osm>")
    assert read_extent(path).box == pytest.approx((24.999, 59.999, 25.003, 60.003))


def test_a_region_of_an_unsorted_file(tmp_path, temporary) -> None:
    path = tmp_path / "town.osm"
    path.write_text(HEADER + BOX + FILES["reversed"] + "</osm>")
    with extracted_file(path, Region.parse("25.0004,60.0001,25.001,60.0008", path)) as part:
        assert {item.id for item in osmium.FileProcessor(str(part), osmium.osm.NODE)} == {6, 7}
    assert not list(temporary.iterdir())


def test_positions_of_a_large_file_are_on_disk(tmp_path, temporary, expected, monkeypatch) -> None:
    path = tmp_path / "town.osm"
    path.write_text(HEADER + BOX + PLAIN + "</osm>")
    monkeypatch.setattr(reading, "MIN_LARGE_FILE_BYTES", 0)
    assert content(path) == expected
    assert not list(temporary.iterdir())
    monkeypatch.setattr(reading, "POSITION_BYTES_PER_BYTE", 1e15)
    with pytest.raises(DataError, match=rf"{temporary} has .* GB left, but .* town.osm needs .* GB .*; make room"):
        content(path)
    assert not list(temporary.iterdir())


@pytest.mark.parametrize("cut", [0.2, 0.9])
@pytest.mark.parametrize("compress", [str.encode, lambda text: gzip.compress(text.encode())])
def test_a_file_that_is_cut_short_is_named(tmp_path, temporary, cut, compress) -> None:
    whole = compress(HEADER + BOX + FILES["JOSM, deleted"] * 30 + "</osm>")
    path = tmp_path / ("town.osm" if whole.startswith(b"<") else "town.osm.gz")
    path.write_bytes(whole[: int(len(whole) * cut)])
    with pytest.raises(MapError, match=rf"^{path}: cannot be read .* cut short"):
        load_osm(path)
    assert not list(temporary.iterdir())


@pytest.mark.parametrize(
    ("name", "advice"),
    [("map.osm.zst", "zstd -d map.osm.zst"), ("map.osm.xz", "unxz map.osm.xz"), ("map.zip", "unzip map.zip")],
)
def test_an_unknown_compression_says_how_to_unpack(tmp_path, name, advice) -> None:
    path = tmp_path / name
    path.write_bytes(b"x")
    with pytest.raises(MapError, match=re.escape(advice)):
        load_osm(path)


def test_a_full_disk_is_named_and_does_not_end_the_process(tmp_path) -> None:
    path, limit = tmp_path / "town.osm", 100
    path.write_text(HEADER + BOX + FILES["reversed"] + "</osm>")

    def restrict() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    code = f"""
from pathlib import Path
from models.errors import DataError
from models.sources.osm.ordering import ordered_file
try:
    with ordered_file(Path({str(path)!r})):
        pass
except DataError as error:
    print(error)
"""
    environment = {**os.environ, "TMPDIR": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, preexec_fn=restrict, capture_output=True, text=True, check=True
    )
    assert re.match(rf"{tmp_path} cannot be written: .*File too large; make room, or have TMPDIR", done.stdout)
    assert os.listdir(tmp_path) == ["town.osm"]
