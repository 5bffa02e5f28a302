import numpy as np
import pytest

from models.posterior.nearby_objects import FAR_M, NEAR_M, NearbyObjects
from models.posterior.neighbours.map_objects import MapObjects
from models.posterior.neighbours.neighbours import STEP_M
from models.posterior.neighbours.scan_index import ScanNeighbourIndex

TREE, LAMP = 0, 1
LABEL = np.array([TREE, TREE, LAMP])
OBJECTS = MapObjects(np.arange(3), np.zeros((3, 3)), np.ones(3, np.int32), np.zeros(3, np.bool_))
WORDS = np.array([[0.9, 0.1], [0.2, 0.8], [0.5, 0.5]])


def nearby_objects(*nodes):
    """Return the objects around nodes, given as (part, metres east, metres north) from the node."""
    rows = [row for node in nodes for row in node]
    offset_steps = np.array([(-east / STEP_M, -north / STEP_M) for _, east, north in rows]).reshape(-1, 2)
    surroundings = ScanNeighbourIndex(
        objects=OBJECTS,
        cell_starts=np.array([0, len(nodes)]),
        nodes_m=np.zeros((len(nodes), 2), np.float32),
        starts=np.concatenate([[0], np.cumsum([len(node) for node in nodes])]),
        part=np.array([part for part, *_ in rows], np.int32),
        offset=np.rint(offset_steps).astype(np.int8),
        whole=np.ones(len(rows), np.bool_),
    )
    return NearbyObjects(surroundings, LABEL, WORDS.__getitem__)


def test_near_is_what_is_near():
    objects = nearby_objects([(0, 2.0, 0.0)], [(0, NEAR_M, 0.0)], [(0, 14.0, 0.0)], [(2, 1.0, 0.0)], []).around(
        np.arange(5), [TREE]
    )
    yes, no = objects.is_near(TREE).T
    assert yes == pytest.approx([1.0, 0.5, 0.1, 0.0, 0.0], abs=0.05)
    assert yes + no == pytest.approx(np.ones(5))
    assert objects.share(TREE, np.array([0.1, 0.2, 0.3, 0.2, 0.2])) == pytest.approx(0.6)


@pytest.mark.parametrize(("east", "north", "quarter"), [(0, 5, 0), (5, 0, 1), (0, -5, 2), (-5, 0, 3), (4, 6, 0)])
def test_the_quarter_is_where_the_nearest_is_seen_from_the_node(east, north, quarter):
    objects = nearby_objects([(0, east, north), (1, -2 * north, 2 * east + 1), (2, 1.0, 1.0)]).around(
        np.array([0]), [TREE]
    )
    [chance] = objects.quarter(TREE)
    assert chance.argmax() == quarter
    assert chance.sum() == pytest.approx(1.0)


def test_between_two_winds_and_two_things_nobody_knows():
    objects = nearby_objects([(0, 5.0, 5.0)], [(0, 0.0, 6.0), (1, 0.0, -6.0)]).around(np.array([0, 1]), [TREE])
    chance = objects.quarter(TREE)
    assert chance[0, :4] == pytest.approx([0.5, 0.5, 0.0, 0.0], abs=0.02)
    assert chance[1, :4] == pytest.approx([0.5, 0.0, 0.5, 0.0], abs=0.02)


def test_where_none_is_none_is_said_and_no_colour_is_likelier():
    objects = nearby_objects([], [(0, FAR_M - 0.5, 0.0)]).around(np.array([0, 1]), [TREE])
    assert objects.quarter(TREE)[0] == pytest.approx([0, 0, 0, 0, 1])
    assert 0.3 < objects.quarter(TREE)[1, 4] < 0.6
    assert objects.colour(TREE, np.array([1]))[0] == pytest.approx([0.5, 0.5])


def test_the_colour_is_that_of_the_nearest():
    objects = nearby_objects([(1, 1.0, 0.0), (0, 12.0, 0.0)]).around(np.array([0]), [TREE])
    assert objects.colour(TREE, np.array([1]))[0] == pytest.approx([0.8, 0.2], abs=0.01)
    assert objects.colours(TREE, np.array([1.0])) == pytest.approx([0.2, 0.8], abs=0.01)


def test_classes_that_are_asked_for_alone_are_looked_at():
    nearby = nearby_objects([(0, 3.0, 0.0), (2, 1.0, 0.0)], [(2, 0.0, 2.0)])
    both, lamps = nearby.around(np.array([1, 0]), [TREE, LAMP]), nearby.around(np.array([1, 0]), [LAMP])
    assert (both.quarter(LAMP) == lamps.quarter(LAMP)).all()
    assert lamps.quarter(LAMP).argmax(axis=1).tolist() == [0, 1]
