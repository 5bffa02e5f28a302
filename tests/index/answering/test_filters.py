from math import cos, log, radians, sin

import numpy as np
import pytest
from scipy.stats import chi2

from app.http.schemas.areas import PriorPosition
from index.answering.filters import is_inside, log_prior, nodes_inside
from index.answering.query import Box, Circle, Polygons, Prior, Query
from models.citymap.frame import Frame

WORLD = Box(-180.0, -90.0, 180.0, 90.0)


def regions(localizer, crs):
    """Boxes, circles and polygons of many sizes on a map, and about it."""
    rng, centers_m = np.random.default_rng(0), localizer.gallery.cells.center_m[:, :2]
    for _ in range(20):
        (x, y), half = rng.uniform(centers_m.min(axis=0) - 30, centers_m.max(axis=0) + 30), rng.uniform(1, 90, 2)
        corners = np.array([[x - half[0], y - half[1]], [x + half[0], y + half[1]]])
        if crs == "wgs84":
            lat, lon = localizer.frame.to_wgs84(np.vstack([corners, [[x, y]]]))
            corners, x, y = np.column_stack([lon, lat])[:2], lon[2], lat[2]
        yield Box(*corners[0], *corners[1])
        yield Circle(center=(float(x), float(y)), radius_m=float(half[0]))
        (west, south), (east, north) = corners
        star = ((west, y), (x, north), (east, south), (x, y), (west, y))  # not convex
        hole = tuple((0.9 * x + 0.1 * a, 0.8 * y + 0.1 * north + 0.1 * b) for a, b in star)
        elsewhere = tuple((a + 2 * (east - west), b) for a, b in star)
        yield Polygons(((star, hole), (elsewhere,), (star, hole)))


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
    ring = ((-170.0, -80.0), (170.0, -80.0), (170.0, 85.0), (-170.0, 85.0), (-170.0, -80.0))
    query = Query("a tree", within=Polygons(((ring,),)), crs="wgs84")
    assert (nodes_inside(query, surroundings, centers_m, localizer.frame).has_node == owning).all()
    query = Query("a tree", within=Polygons(((tuple((x / 9, y / 9) for x, y in ring),),)), crs="wgs84")
    assert not nodes_inside(query, surroundings, centers_m, localizer.frame).has_node.any()
    assert nodes_inside(Query("a tree"), surroundings, centers_m, localizer.frame) is None


def test_a_polygon_is_what_lies_in_its_outer_ring_and_in_no_hole() -> None:
    square, hole = (((0, 0), (9, 0), (9, 9), (0, 9), (0, 0)), ((3, 3), (6, 3), (6, 6), (3, 6), (3, 3)))
    points_m = np.array([[1.0, 1], [4, 4], [9, 9], [10, 1], [21, 1], [31, 1]])
    moved = tuple((x + 20, y) for x, y in square)
    query = Query("a tree", within=Polygons(((square, hole), (moved,))))
    assert is_inside(query, points_m, Frame()).tolist() == [True, False, True, False, True, False]


@pytest.mark.parametrize("crs", ["map", "wgs84"])
def test_an_ellipse_contains_its_confidence_and_points_clockwise_from_north(crs) -> None:
    frame, angle = Frame("map", 60.17, 24.94), 30.0
    position = (24.94, 60.17) if crs == "wgs84" else (0.0, 0.0)
    given = {"position": position, "semi_major_m": 90.0, "semi_minor_m": 30.0, "orientation_deg": angle}
    for confidence in (0.5, 0.68, 0.95):
        prior = PriorPosition(**given, confidence=confidence).to_prior()
        major = np.array([sin(radians(angle)), cos(radians(angle))])
        minor = np.array([major[1], -major[0]])
        ends = np.array([[0.0, 0.0], 90 * major, -90 * major, 30 * minor, -30 * minor])
        drop = -log_prior(Query("a tree", prior=prior, crs=crs), ends, frame)
        assert drop == pytest.approx([0.0, *[chi2.ppf(confidence, 2) / 2] * 4], abs=1e-6)
        assert 1 - np.exp(-drop[1]) == pytest.approx(confidence), "of a Gaussian lies inside"


def test_the_forms_of_a_prior_are_the_same_gaussian() -> None:
    plain = Prior((1.0, 2.0), 10.0)
    radius_m = 10 * (-2 * log(1 - 0.68)) ** 0.5
    circle = PriorPosition(position=(1.0, 2.0), radius_m=radius_m).to_prior()
    round_ellipse = {"semi_major_m": radius_m, "semi_minor_m": radius_m, "orientation_deg": 77.0}
    points_m = np.random.default_rng(0).normal(0, 20, (9, 2))
    expected = -((points_m - [1, 2]) ** 2).sum(axis=1) / 200
    for prior in (plain, circle, PriorPosition(position=(1.0, 2.0), **round_ellipse).to_prior()):
        assert log_prior(Query("a tree", prior=prior), points_m, Frame()) == pytest.approx(expected)
