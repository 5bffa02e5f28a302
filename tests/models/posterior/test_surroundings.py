import numpy as np
import pytest

from models.city.source import open_source
from models.errors import IndexBroken
from models.posterior.surroundings import SPACING_M, STEP_M, Surroundings


@pytest.fixture(scope="module")
def around(source, cells):
    bodies = source.bodies()
    return bodies, Surroundings.of(bodies, cells)


def test_every_node_belongs_to_its_nearest_cell(around, cells) -> None:
    _, s = around
    owner = np.repeat(np.arange(len(cells)), np.diff(s.cell_starts))
    distance = np.linalg.norm(s.nodes_m[:, None] - cells.center_m[None, :, :2], axis=2)
    assert distance.min(axis=1).max() <= 15.0 + 1e-3
    assert np.allclose(distance[np.arange(len(owner)), owner], distance.min(axis=1), atol=1e-3)
    assert len(np.unique(np.round(s.nodes_m / SPACING_M), axis=0)) == len(s.nodes_m)


def test_ways_are_those_of_a_naive_search(around, cells, city) -> None:
    bodies, s = around
    owner = np.repeat(np.arange(len(cells)), np.diff(s.cell_starts))
    shown = set(bodies.part_instance.tolist())
    for node in np.random.default_rng(0).choice(len(s.nodes_m), 12, replace=False):
        at = np.array([*s.nodes_m[node], cells.center_m[owner[node], 2]])
        naive = {}
        for i in range(len(city.instances)):
            xyz = bodies.xyz[bodies.starts[i] : bodies.starts[i + 1]]
            distance = np.linalg.norm(xyz - at, axis=1)
            way = at[:2] - xyz[distance.argmin(), :2]
            if i in shown and np.hypot(*way) <= 15.0 and distance.min() <= 30.0:
                inside = (np.abs(xyz[:, :2] - at[:2]) <= cells.size_m / 2).all(axis=1).sum()
                large = np.ptp(xyz[:, :2], axis=0).max() > 8.0
                whole = not (bodies.is_thing[i] and large) or inside >= city.rules.thing_share * len(xyz)
                naive[i] = np.hypot(*way), whole
        rows = slice(s.starts[node], s.starts[node + 1])
        instances = bodies.part_instance[s.part[rows]].tolist()
        assert sorted(instances) == sorted(naive)
        for i, way, whole in zip(instances, s.way[rows], s.whole[rows], strict=True):
            assert np.hypot(*(way * STEP_M)) == pytest.approx(naive[i][0], abs=STEP_M)
            assert whole == naive[i][1]


def test_rows_are_sorted_and_parts_are_of_the_owner_where_it_has_them(around, cells) -> None:
    bodies, s = around
    owner = np.repeat(np.arange(len(cells)), np.diff(s.cell_starts))
    cube = cells.parts.cube
    for node in np.random.default_rng(1).choice(len(s.nodes_m), 20, replace=False):
        rows = np.arange(s.starts[node], s.starts[node + 1])
        radius = (s.way[rows].astype(int) ** 2).sum(axis=1)
        key = list(zip((~s.whole[rows]).tolist(), radius.tolist(), strict=True))
        assert key == sorted(key)
        in_owner = set(bodies.part_instance[cube == owner[node]].tolist())
        for part in s.part[rows]:
            assert cube[part] == owner[node] or bodies.part_instance[part] not in in_owner


def test_taking_cells_keeps_their_nodes(around, cells) -> None:
    _, s = around
    chosen = np.array([7, 2, 30])
    rows = np.concatenate([np.arange(cells.parts.starts[c], cells.parts.starts[c + 1]) for c in chosen])
    part_of = np.full(len(cells.parts.instance), -1)
    part_of[rows] = np.arange(len(rows))
    some = s.take(chosen, part_of)
    for n, c in enumerate(chosen):
        ours, theirs = (t.nodes_m[t.cell_starts[i] : t.cell_starts[i + 1]] for t, i in ((some, n), (s, c)))
        assert (ours == theirs).all()
    kept = part_of[s.part] >= 0
    node = np.repeat(np.arange(len(s.nodes_m)), np.diff(s.starts))
    of_chosen = np.concatenate([np.arange(s.cell_starts[c], s.cell_starts[c + 1]) for c in chosen])
    assert np.diff(some.starts).tolist() == [int(kept[node == n].sum()) for n in of_chosen]


def test_saved_surroundings_come_back_and_broken_ones_are_named(around, tmp_path) -> None:
    _, s = around
    s.save(tmp_path)
    again = Surroundings.load(tmp_path)
    for name in ("cell_starts", "nodes_m", "starts", "part", "way", "whole"):
        assert (getattr(again, name) == getattr(s, name)).all()
    assert 100 < s.bytes_a_cell < 50_000
    (tmp_path / "surroundings.safetensors").write_bytes(b"no")
    with pytest.raises(IndexBroken, match="hereabouts index"):
        Surroundings.load(tmp_path)


def test_a_data_set_has_the_points_that_its_cells_show(streets) -> None:
    source = open_source(streets, "train")
    cells, bodies = source.data.cells, source.bodies()
    for part in range(0, len(cells.parts.instance), 17):
        i = bodies.part_instance[part]
        xyz = bodies.xyz[bodies.starts[i] : bodies.starts[i + 1]]
        gap = np.linalg.norm(xyz - cells.parts.closest_m[part], axis=1).min()
        assert gap < 0.4, "one point a voxel of 0.2 m is kept"
    s = Surroundings.of(bodies, cells)
    assert len(s.starts) == len(s.nodes_m) + 1
