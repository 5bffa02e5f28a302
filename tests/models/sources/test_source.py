from dataclasses import replace

import numpy as np
import pytest

from models.citymap.queries import Queries
from models.errors import DataError, MapError
from models.sources.kitti360.job import prepare_data
from models.sources.source import VALIDATION_SEED, VOXEL_M, MapSource, open_source, open_sources
from models.sources.store.files import convert
from tests.models.sources.raw_scenes import write_town

SCENE = "2013_05_28_drive_0010_sync"


@pytest.fixture(scope="module")
def prepared(tmp_path_factory):
    """One scene, a validation one."""
    raw, prepared = (tmp_path_factory.mktemp("door") / name for name in ("raw", "prepared"))
    write_town(raw, SCENE, 0)
    prepare_data(raw, prepared)
    return prepared


def test_a_map_is_cut_once_for_all_its_splits(osm_file, source, regions, monkeypatch) -> None:
    stages = []
    opened = open_sources(osm_file, (None, "train", "val"), lambda stage, done, total: stages.append((stage, done)))
    assert [stage for stage in stages if not stage[1]] == [("read map", 0)]
    for one, other in zip(opened, (source, *regions), strict=True):
        assert one.data.cells.ids == other.data.cells.ids
        assert one.queries().sentences == other.queries().sentences


def test_queries_are_true_and_in_their_region(source, regions) -> None:
    whole = source.queries()
    for part in regions:
        cells, queries = part.data.cells, part.queries()
        away = np.linalg.norm(cells.center_m[None, :, :2] - queries.positions_m[:, None], axis=2)
        assert 0 < len(queries) < len(whole)
        assert (away.argmin(axis=1) == queries.truth).all()
        west, east = part.facts["regions"][part.data.split]
        assert ((queries.positions_m[:, 0] >= west) & (queries.positions_m[:, 0] < east)).all()
    chosen_by = source.queries(VALIDATION_SEED).positions_m
    assert not np.array_equal(chosen_by[:9], whole.positions_m[:9]), "not what it is measured at"


def test_as_a_scan_shows_it_a_map_is_told_of_with_other_winds(source, prepared) -> None:
    known, scanned = (each.queries(VALIDATION_SEED) for each in (source, source.as_scan()))
    alike = _nearest_hints(known)
    differ = [text != alike[xy] for xy, text in _nearest_hints(scanned).items() if xy in alike]
    assert 0.02 < np.mean(differ) < 0.5
    both = Queries.concatenate([known, scanned])
    assert len(both) == len(known) + len(scanned)
    assert both.take(np.array([len(known)])).hints == scanned.take(np.array([0])).hints
    data = open_source(prepared)
    assert data.as_scan() is data, "it is one"


def _nearest_hints(queries):
    """Return the hints about the nearest instances by position."""
    rows = zip(queries.positions_m.tolist(), queries.hints, queries.strategies, strict=True)
    return {tuple(xy): {(h.label, h.direction) for h in hints} for xy, hints, how in rows if how == "closest"}


def test_a_data_set_and_its_store_are_one(prepared, tmp_path) -> None:
    convert(prepared, tmp_path / "store")
    published, stored = (open_source(path, "val") for path in (prepared, tmp_path / "store"))
    assert published.facts["scenes"] == stored.facts["scenes"] == {"val": [SCENE]}
    assert (published.data.name, published.data.grid_m) == ("prepared", stored.data.grid_m)
    assert published.data.cells.ids == stored.data.cells.ids
    rng = np.random.default_rng(0)
    one, other = (part.queries() for part in (published, stored))
    assert (one.sentences, one.hints) == (other.sentences, other.hints)
    statements = stored.statements(10.0, rng)
    assert (statements.positions_m[:, :2] == other.positions_m).all()
    assert (statements.best == other.truth).all()
    assert rng.random() == np.random.default_rng(0).random(), "nothing is drawn"


def test_a_scan_looks_like_its_points(prepared) -> None:
    source = open_source(prepared)
    (part,) = (part.tensors for part in source.scenery(source.gazetteer()))
    xyz = part["steps"].cumsum(axis=0) / 10
    geometry = source.geometry().xyz
    assert 0.5 * len(geometry) < len(xyz) <= len(geometry) + 1, "one point a cube, whatever cells it is in"
    assert np.abs(xyz.min(axis=0) - geometry.min(axis=0)).max() < VOXEL_M
    assert part["rgb"].std() > 0


def test_scenes_without_poses_can_be_indexed_but_not_asked(prepared, tmp_path) -> None:
    (tmp_path / "cells").symlink_to(prepared / "cells")
    cells_only = open_source(tmp_path)
    assert len(cells_only.data.cells)
    assert len(cells_only.geometry().scene)
    for ask in (cells_only.queries, lambda: cells_only.statements(10.0, np.random.default_rng(0))):
        with pytest.raises(DataError, match=rf"has no poses/{SCENE}\.pkl, only cells; add it"):
            ask()


def test_an_unknown_split_is_refused_before_a_map_is_read(tmp_path, prepared) -> None:
    with pytest.raises(
        MapError, match="'east' is not a split of a map; choose one of train, val, test, or leave it out"
    ):
        open_sources(tmp_path / "no.osm", ("train", "east"))
    with pytest.raises(MapError, match="no such file"):
        open_source(tmp_path / "no.osm", "train")
    with pytest.raises(DataError, match="no scene of split 'train'"):
        open_source(prepared, "train")
    with pytest.raises(DataError, match="neither a converted store"):
        open_source(tmp_path)


@pytest.mark.parametrize(
    "elsewhere",
    [lambda position: position[:0], lambda position: position + 1e4],
    ids=["nowhere", "far from every cell"],
)
def test_a_map_with_nothing_to_describe_says_so(osm_file, city, geometry, cells, elsewhere) -> None:
    moved = MapSource(osm_file, replace(city, locations_m=elsewhere(city.locations_m)), geometry, cells)
    with pytest.raises(MapError, match=r"tinytown\.osm: no position in split 'all' can be described; take"):
        moved.queries()
