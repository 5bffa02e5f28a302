import numpy as np
import pytest

from index.answering.filters import is_inside, nodes_inside
from index.answering.query import Box, Circle, Query

WORLD = Box(-180.0, -90.0, 180.0, 90.0)


def regions(localizer, crs):
    """Boxes and circles of many sizes on a map, and about it."""
    rng, centers_m = np.random.default_rng(0), localizer.gallery.cells.center_m[:, :2]
    for _ in range(20):
        (x, y), half = rng.uniform(centers_m.min(axis=0) - 30, centers_m.max(axis=0) + 30), rng.uniform(1, 90, 2)
        corners = np.array([[x - half[0], y - half[1]], [x + half[0], y + half[1]]])
        if crs == "wgs84":
            lat, lon = localizer.frame.to_wgs84(np.vstack([corners, [[x, y]]]))
            corners, x, y = np.column_stack([lon, lat])[:2], lon[2], lat[2]
        yield Box(*corners[0], *corners[1])
        yield Circle(center=(float(x), float(y)), radius_m=float(half[0]))


@pytest.mark.parametrize("crs", ["map", "wgs84"])
def test_the_cells_inside_are_those_of_which_a_node_is(localizer, crs) -> None:
    surroundings, centers_m = localizer.posterior.surroundings, localizer.gallery.cells.center_m[:, :2]
    nodes = np.arange(surroundings.cell_starts[-1])
    positions_m, shares = surroundings.positions_m(nodes), []
    for within in regions(localizer, crs):
        query = Query("a tree", within=within, crs=crs)
        inside = nodes_inside(query, surroundings, centers_m, localizer.frame)
        every = is_inside(query, positions_m, localizer.frame)
        assert (inside.contains(positions_m) == every).all()
        naive = np.bincount(surroundings.owner(nodes[every]), minlength=len(centers_m)) > 0
        assert (inside.has_node == naive).all()
        shares.append(naive.mean())
    assert min(shares) < 0.1
    assert max(shares) > 0.3


def test_few_nodes_are_looked_at_however_many_there_are(localizer) -> None:
    surroundings, looked = localizer.posterior.surroundings, []

    class Looked:
        def __getattr__(self, name):
            return getattr(surroundings, name)

        def positions_m(self, nodes):
            looked.append(len(nodes))
            return surroundings.positions_m(nodes)

    centers_m = localizer.gallery.cells.center_m[:, :2]
    box = Box(*(centers_m.min(axis=0) + 40).tolist(), *(centers_m.max(axis=0) - 40).tolist())
    inside = nodes_inside(Query("a tree", within=box, crs="map"), Looked(), centers_m, localizer.frame)
    assert inside.has_node.sum() > 20
    assert sum(looked) < 0.8 * surroundings.cell_starts[-1], "those at the border alone"


def test_a_box_round_the_world_has_all_of_a_map_and_one_elsewhere_nothing(localizer) -> None:
    surroundings, centers_m = localizer.posterior.surroundings, localizer.gallery.cells.center_m[:, :2]
    owning = np.diff(surroundings.cell_starts) > 0
    for within, expected in ((WORLD, owning), (Box(-70.0, -40.0, -60.0, -30.0), np.zeros_like(owning))):
        query = Query("a tree", within=within, crs="wgs84")
        assert (nodes_inside(query, surroundings, centers_m, localizer.frame).has_node == expected).all()
    assert nodes_inside(Query("a tree"), surroundings, centers_m, localizer.frame) is None
