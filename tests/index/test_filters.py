import numpy as np
import pytest

from index.filters import inside, nodes_inside
from index.query import Box, Circle, Query


@pytest.mark.parametrize("within", [Circle(center=(10.0, 20.0), radius_m=60.0), Box(-50.0, -40.0, 30.0, 90.0)])
def test_which_nodes_are_inside_does_not_depend_on_how_many_are_asked_at_once(localizer, monkeypatch, within) -> None:
    surroundings, query = localizer.posterior.surroundings, Query("a tree", within=within, crs="map")
    every = inside(query, surroundings.positions_m(np.arange(surroundings.cell_starts[-1])), localizer.frame)
    assert 0 < every.sum() < len(every)
    monkeypatch.setattr("index.filters.NODES_AT_ONCE", 1000)
    assert (nodes_inside(query, surroundings, localizer.frame) == every).all()
