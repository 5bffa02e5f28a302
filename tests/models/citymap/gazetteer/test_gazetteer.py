import numpy as np
import pytest
from safetensors.numpy import load_file, save_file

from models.citymap.gazetteer.gazetteer import ADDRESS_KIND, EMPTY_GAZETTEER, GAZETTEER_FILE, Gazetteer, build_gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.errors import IndexBroken
from tests.models.citymap.gazetteer.made_town import EAST_WEST, MARKET, NORTH_SOUTH, made_gazetteer, numbered

ARRAYS = ("segments_m", "starts", "is_area", "corner_streets", "corners_m")


@pytest.fixture
def town() -> Gazetteer:
    return made_gazetteer()


def test_objects_have_their_segments(town) -> None:
    market, street = numbered(town, "Whole Foods"), numbered(town, "West 25th Street")
    assert np.diff(town.starts)[[market, street]].tolist() == [4, 1]
    assert town.is_area[market]
    assert not town.is_area[street]
    assert town.segments_m[town.starts[street]].tolist() == [-50, 80, 450, 80]
    assert town.starts[-1] == len(town.segments_m)


def test_objects_of_a_kind_count_for_its_parents(town) -> None:
    shops = {town.objects[n].names[0] for n in town.by_kind["shop"]}
    assert shops == {"T-Optik", "Whole Foods Market", "Rossi Bakery"}
    assert {town.objects[n].names[0] for n in town.by_kind["shop/bakery"]} == {"Rossi Bakery"}
    assert len(town.by_kind[STREET_KIND]) == len(EAST_WEST) + len(NORTH_SOUTH) + 1
    assert {town.objects[n].number for n in town.by_kind[ADDRESS_KIND]} == {"402", "410", "450", "401", "449"}


def test_middles_and_reaches_are_those_of_the_boxes(town) -> None:
    market = numbered(town, "Whole Foods")
    low_x, low_y, high_x, high_y = MARKET
    assert town.middles_m[market] == pytest.approx([(low_x + high_x) / 2, (low_y + high_y) / 2])
    assert town.reach_m[market] == pytest.approx(np.hypot(high_x - low_x, high_y - low_y) / 2)
    assert town.reach_m[numbered(town, "Bottino")] == 0


def test_what_is_saved_is_loaded(town, tmp_path) -> None:
    town.save(tmp_path)
    loaded = Gazetteer.load(tmp_path)
    assert list(loaded.objects) == list(town.objects), "accents, Cyrillic and Chinese too"
    for name in ARRAYS:
        was, result = getattr(town, name), getattr(loaded, name)
        assert (was == result).all()
        assert was.dtype == result.dtype


def test_a_gazetteer_of_nothing_is_saved_and_loaded(tmp_path) -> None:
    EMPTY_GAZETTEER.save(tmp_path)
    loaded = Gazetteer.load(tmp_path)
    assert len(loaded) == 0
    assert loaded.by_kind == {}
    assert loaded.middles_m.shape == (0, 2)
    assert loaded.corner_streets.shape == loaded.corners_m.shape == (0, 2)


def test_words_without_number_street_and_source_stay_without(tmp_path) -> None:
    build_gazetteer([GazetteerObject(("shop",), ("A", "B"), source_id="way/7")], [np.zeros((1, 4))], [False]).save(
        tmp_path
    )
    (words,) = Gazetteer.load(tmp_path).objects
    assert words == GazetteerObject(("shop",), ("A", "B"), None, None, "way/7")


@pytest.mark.parametrize("content", [None, b"", b"\x00\xff\xfe noise", b"[]", b"{}"])
def test_missing_and_broken_files_are_refused(town, tmp_path, content) -> None:
    town.save(tmp_path)
    (tmp_path / GAZETTEER_FILE).unlink()
    if content is not None:
        (tmp_path / GAZETTEER_FILE).write_bytes(content)
    with pytest.raises(IndexBroken, match="rebuild it"):
        Gazetteer.load(tmp_path)


def test_files_cut_short_are_refused(town, tmp_path) -> None:
    town.save(tmp_path)
    whole = (tmp_path / GAZETTEER_FILE).read_bytes()
    (tmp_path / GAZETTEER_FILE).write_bytes(whole[: len(whole) // 2])
    with pytest.raises(IndexBroken):
        Gazetteer.load(tmp_path)


@pytest.mark.parametrize("name", ["segments_m", "strings.text", "kinds", "written"])
def test_a_file_without_a_column_is_refused(town, tmp_path, name) -> None:
    town.save(tmp_path)
    columns = load_file(tmp_path / GAZETTEER_FILE)
    del columns[name]
    save_file(columns, tmp_path / GAZETTEER_FILE)
    with pytest.raises(IndexBroken):
        Gazetteer.load(tmp_path)


def test_columns_that_disagree_are_refused(town, tmp_path) -> None:
    town.save(tmp_path)
    columns = load_file(tmp_path / GAZETTEER_FILE)
    save_file(columns | {"written": columns["written"][:5].copy()}, tmp_path / GAZETTEER_FILE)
    with pytest.raises(IndexBroken):
        Gazetteer.load(tmp_path)


def test_what_was_opened_can_be_changed_and_the_file_stays(town, tmp_path) -> None:
    town.save(tmp_path)
    before = (tmp_path / GAZETTEER_FILE).read_bytes()
    loaded = Gazetteer.load(tmp_path)
    loaded.segments_m[:] = 7.0
    assert (tmp_path / GAZETTEER_FILE).read_bytes() == before
    assert (loaded.segments_m == 7.0).all()


def test_an_object_is_found_by_its_element() -> None:
    names = [("way/1",), ("A",), ()]
    objects = [
        GazetteerObject(("shop",), name, source_id=source)
        for name, source in zip(names, ("node/7", "way/1", "way/12"), strict=True)
    ]
    table = build_gazetteer(objects, [np.zeros((1, 4))] * 3, [False] * 3).objects
    assert [table.find_source(source) for source in ("node/7", "way/1", "way/12", "way/2", "1")] == [
        0,
        1,
        2,
        None,
        None,
    ]
