import numpy as np
import pytest

from index.evaluation.localizers import count_parts
from models.citymap.map_geometry import build_geometry, cut_cells
from models.errors import IndexBroken
from models.posterior.neighbours import nodes as nodes_module
from models.posterior.neighbours.neighbour_index import build_neighbour_index, load_neighbour_index
from models.posterior.neighbours.neighbours import STEP_M
from models.posterior.neighbours.nodes import SPACING_M
from models.posterior.neighbours.scan_index import ScanNeighbourIndex
from models.sources.source import MapSource, open_source


@pytest.fixture(scope="module")
def scanned(osm_file, scan, cells):
    """The town's cells, and what lies around them, from points."""
    bodies = build_geometry(scan)
    cells = cut_cells(scan, bodies)
    clouds = MapSource(osm_file, scan, bodies, cells).geometry()
    return cells, clouds, ScanNeighbourIndex.build(clouds, cells)


@pytest.fixture(scope="module")
def around(source, cells):
    bodies = source.geometry()
    return cells, bodies, build_neighbour_index(bodies, cells)


def test_nodes_are_the_same_however_many_columns_are_looked_at(around, monkeypatch):
    cells, bodies, expected = around
    monkeypatch.setattr(nodes_module, "COLUMNS_PER_SLICE", 7)
    again = build_neighbour_index(bodies, cells)
    assert np.array_equal(again.offset, expected.offset)
    assert np.array_equal(again.cell_starts, expected.cell_starts)


def test_ground_of_a_map_is_vague_and_a_scan_is_told_of_by_its_points(source, around, scanned) -> None:
    things = around[2].objects
    labels = np.array(source.data.gallery.labels)[things.instance]
    assert things.is_vague[labels == "road"].all()
    assert not things.is_vague[labels == "building"].any()
    assert scanned[2].objects.is_flat.any()
    assert not scanned[2].objects.is_vague.any()


def nodes_of(s):
    """[M, 2] where all nodes are."""
    return s.positions_m(np.arange(s.cell_starts[-1]))


def test_every_node_belongs_to_its_nearest_cell(around) -> None:
    cells, _, s = around
    owner = np.repeat(np.arange(len(cells)), np.diff(s.cell_starts))
    nodes_m = nodes_of(s)
    assert (s.owner(np.arange(len(nodes_m))) == owner).all()
    distance = np.linalg.norm(nodes_m[:, None] - cells.center_m[None, :, :2], axis=2)
    assert distance.min(axis=1).max() <= 15.0 + 1e-3
    assert np.allclose(distance[np.arange(len(owner)), owner], distance.min(axis=1), atol=1e-3)
    assert len(np.unique(np.round(nodes_m / SPACING_M), axis=0)) == len(nodes_m)


@pytest.mark.parametrize("kind", ["scanned", "around"])
def test_the_middle_of_a_cell_is_its_node_nearest_to_the_centre(kind, request) -> None:
    cells, _, s = request.getfixturevalue(kind)
    centers_m = cells.center_m[:, :2] + [0.3, -0.2]
    apart = np.hypot(*(nodes_of(s) - np.repeat(centers_m, np.diff(s.cell_starts), axis=0)).T)
    runs = zip(s.cell_starts[:-1].tolist(), s.cell_starts[1:].tolist(), strict=True)
    naive = [first + int(apart[first:last].argmin()) for first, last in runs if last > first]
    assert s.middles(centers_m).tolist() == naive
    assert len(naive) > 100


def test_ways_are_those_of_a_naive_search(scanned, scan) -> None:
    cells, bodies, s = scanned
    owner = np.repeat(np.arange(len(cells)), np.diff(s.cell_starts))
    shown = set(bodies.part_instances.tolist())
    for node in np.random.default_rng(0).choice(len(s.nodes_m), 12, replace=False):
        node_m = np.array([*s.nodes_m[node], cells.center_m[owner[node], 2]])
        naive = {}
        for i in range(len(scan.instances)):
            xyz = bodies.xyz[bodies.starts[i] : bodies.starts[i + 1]]
            distance = np.linalg.norm(xyz - node_m, axis=1)
            offset_m = node_m[:2] - xyz[distance.argmin(), :2]
            if i in shown and np.hypot(*offset_m) <= 15.0 and distance.min() <= 30.0:
                inside = (np.abs(xyz[:, :2] - node_m[:2]) <= cells.size_m / 2).all(axis=1).sum()
                large = np.ptp(xyz[:, :2], axis=0).max() > 8.0
                whole = not (bodies.is_thing[i] and large) or inside >= scan.rules.thing_share * len(xyz)
                naive[i] = np.hypot(*offset_m), whole
        rows = slice(s.starts[node], s.starts[node + 1])
        instances = bodies.part_instances[s.part[rows]].tolist()
        assert sorted(instances) == sorted(naive)
        for i, offset_m, whole in zip(instances, s.offset[rows], s.whole[rows], strict=True):
            assert np.hypot(*(offset_m * STEP_M)) == pytest.approx(naive[i][0], abs=STEP_M)
            assert whole == naive[i][1]


def test_rows_are_sorted_and_parts_are_of_the_owner_where_it_has_them(scanned) -> None:
    cells, bodies, s = scanned
    owner = np.repeat(np.arange(len(cells)), np.diff(s.cell_starts))
    cube = cells.parts.cube
    for node in np.random.default_rng(1).choice(len(s.nodes_m), 20, replace=False):
        rows = np.arange(s.starts[node], s.starts[node + 1])
        radius = (s.offset[rows].astype(int) ** 2).sum(axis=1)
        key = list(zip((~s.whole[rows]).tolist(), radius.tolist(), strict=True))
        assert key == sorted(key)
        in_owner = set(bodies.part_instances[cube == owner[node]].tolist())
        for part in s.part[rows]:
            assert cube[part] == owner[node] or bodies.part_instances[part] not in in_owner


@pytest.mark.parametrize("kind", ["around", "scanned"])
def test_taking_cells_keeps_their_nodes_and_what_they_show(kind, request) -> None:
    cells, s = request.getfixturevalue(kind)[::2]
    chosen = np.array([7, 2, 30])
    subset = s.take(chosen, count_parts(s.objects, cells, chosen))
    of_chosen = np.concatenate([np.arange(s.cell_starts[c], s.cell_starts[c + 1]) for c in chosen])
    assert (nodes_of(subset) == s.positions_m(of_chosen)).all()
    assert np.diff(subset.cell_starts).tolist() == np.diff(s.cell_starts)[chosen].tolist()
    before, after = s.around(of_chosen), subset.around(np.arange(len(of_chosen)))
    is_kept = subset.objects.parts[before.part] > 0
    assert 0 < is_kept.sum() < len(is_kept)
    for name in ("node", "part", "offset", "whole"):
        assert (getattr(before, name)[is_kept] == getattr(after, name)).all()


@pytest.mark.parametrize("kind", ["around", "scanned"])
def test_saved_surroundings_come_back_and_broken_ones_are_named(kind, request, tmp_path) -> None:
    cells, s = request.getfixturevalue(kind)[::2]
    s.save(tmp_path)
    again = load_neighbour_index(tmp_path, cells)
    nodes = np.arange(s.cell_starts[-1])
    assert (again.cell_starts == s.cell_starts).all()
    assert (nodes_of(again) == nodes_of(s)).all()
    for name in ("node", "part", "offset", "whole"):
        assert (getattr(again.around(nodes), name) == getattr(s.around(nodes), name)).all()
    for name in ("instance", "rgb", "parts", "is_flat"):
        assert np.array_equal(getattr(again.objects, name), getattr(s.objects, name), equal_nan=name == "rgb")
    [file] = tmp_path.iterdir()
    assert 0.9 * file.stat().st_size < s.num_bytes < file.stat().st_size
    file.write_bytes(b"no")
    with pytest.raises(IndexBroken, match="hereabouts index"):
        load_neighbour_index(tmp_path, cells)


def test_what_is_around_nodes_does_not_depend_on_which_are_asked_for(around) -> None:
    cells, _, s = around
    every = s.around(np.arange(s.cell_starts[-1]))
    rng = np.random.default_rng(2)
    chosen = np.concatenate(
        [np.arange(s.cell_starts[c], s.cell_starts[c + 1]) for c in rng.permutation(len(cells))[:9]]
    )
    chosen = chosen[rng.random(len(chosen)) < 0.4]
    subset = s.around(chosen)
    for n, node in enumerate(chosen):
        ours, theirs = subset.node == n, every.node == node
        for name in ("part", "offset"):
            assert (getattr(subset, name)[ours] == getattr(every, name)[theirs]).all()
    nothing = s.around(chosen[:0])
    assert len(nothing.node) == 0


def test_a_data_set_has_the_points_that_its_cells_show(streets) -> None:
    source = open_source(streets, "train")
    cells, bodies = source.data.cells, source.geometry()
    for part in range(0, len(cells.parts.instance), 17):
        i = bodies.part_instances[part]
        xyz = bodies.xyz[bodies.starts[i] : bodies.starts[i + 1]]
        gap = np.linalg.norm(xyz - cells.parts.closest_m[part], axis=1).min()
        assert gap < 0.4, "one point a voxel of 0.2 m is kept"
    s = ScanNeighbourIndex.build(bodies, cells)
    assert len(s.starts) == len(s.nodes_m) + 1
