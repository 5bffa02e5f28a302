import pytest

from models.sources.osm.reading_counts import ReadingCounts, script_of
from models.sources.osm.summary import load_gazetteer_and_summary


def test_a_town_is_summarized_by_its_size_and_what_has_a_name(osm_file) -> None:
    summary = load_gazetteer_and_summary(osm_file)[1]
    assert [summary.width_km, summary.height_km] == pytest.approx([0.3, 0.3], rel=0.02)
    assert summary.walkable_km == pytest.approx(12 * 0.3, rel=0.01), "six streets and six paths of 300 m"
    assert (summary.streets, summary.named_objects, summary.house_numbers) == (12, 0, 0)
    assert summary.kinds.keys() >= {"tree", "bench", "street lamp"}
    assert list(summary.kinds.values()) == sorted(summary.kinds.values(), reverse=True)
    assert (summary.scripts, summary.dropped) == ({"latin": 18}, {})


def test_what_is_outside_the_box_is_not_walkable_there(osm_file, tmp_path) -> None:
    text = osm_file.read_text(encoding="utf-8")
    box = '<bounds minlat="59.99" minlon="24.99" maxlat="60.01" maxlon="25.0012"/>'  # the western 67 m
    path = tmp_path / "west.osm"
    path.write_text(text.replace("<node", f"{box}<node", 1), encoding="utf-8")
    summary = load_gazetteer_and_summary(path)[1]
    assert summary.bbox == pytest.approx((24.99, 59.99, 25.0012, 60.01))
    assert summary.walkable_km == pytest.approx(0.6, rel=0.01), "two paths; the middles of streets are outside"


def test_names_are_counted_by_script_and_language(tmp_path) -> None:
    tags = [
        {"name": "Café 9", "name:fr": "Café 9", "name:zh-Hant": "咖啡", "name:etymology": "x", "amenity": "cafe"},
        {"name": "Музей", "name:fr": "Musée", "tourism": "museum"},
        {"name": "مدرسة", "amenity": "school"},
        {"name": "1234", "shop": "books"},
        {"amenity": "bench"},
    ]
    nodes = "".join(
        f'<node id="{n}" version="1" lat="60.{n}" lon="25.0">'
        + "".join(f'<tag k="{key}" v="{value}"/>' for key, value in each.items())
        + "</node>"
        for n, each in enumerate(tags, start=1)
    )
    path = tmp_path / "names.osm"
    way = (
        '<way id="1" version="1"><nd ref="98"/><nd ref="99"/><tag k="highway" v="primary"/><tag k="name" v="A"/></way>'
    )
    path.write_text(f'<osm version="0.6">{nodes}{way}</osm>', encoding="utf-8")
    summary = load_gazetteer_and_summary(path)[1]
    assert summary.scripts == {"latin": 1, "cyrillic": 1, "arabic": 1}
    assert summary.languages == {"fr": 2, "zh": 1}
    assert (summary.named_objects, sum(summary.dropped.values())) == (4, 1)
    assert summary.kinds == dict.fromkeys(["bench", "bookstore", "cafe", "museum", "school"], 1)


def test_a_script_is_that_of_the_first_letter() -> None:
    assert [script_of(name) for name in ("12 Öö", "東京", "", "7/9", "ひら")] == [
        "latin",
        "cjk",
        None,
        None,
        "hiragana",
    ]


def test_counts_begin_at_nothing_in_each_reading() -> None:
    ReadingCounts().dropped["a reason"] += 1
    assert not ReadingCounts().dropped


def test_strays_and_useless_bounds_are_counted(tmp_path) -> None:
    path = tmp_path / "town.osm"
    street = '<way id="1"><nd ref="1"/><nd ref="2"/><tag k="highway" v="residential"/></way>'
    bench = '<tag k="amenity" v="bench"/></node>'
    path.write_text(
        '<osm version="0.6"><bounds minlat="1" minlon="1" maxlat="2" maxlon="2"/><node id="1" lat="60" lon="25"/>'
        f'<node id="2" lat="60" lon="25.001"/><node id="3" lat="0" lon="0">{bench}{street}</osm>'
    )
    summary = load_gazetteer_and_summary(path)[1]
    assert summary.dropped == {"more than 50 km from the rest, such as node/3 at latitude 0, longitude 0": 1}
    assert summary.repaired == {"bounds that have none of the nodes inside": 1}
