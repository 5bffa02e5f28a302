import numpy as np
import pytest

from models.posterior.modes import MAX_MODES, find_modes

SPACING_M, CELL_M = 2.0, 10.0


def modes_of(*blobs):
    """Return the modes of blobs (east, standard deviation, mass) on a line from west to east."""
    points_m = np.column_stack([np.arange(-500.0, 2000.0, SPACING_M), np.zeros(1250)])
    weight = np.zeros(len(points_m))
    for east, spread, mass in blobs:
        blob = np.exp(-0.5 * ((points_m[:, 0] - east) / spread) ** 2)
        weight += mass * blob / blob.sum()
    cells, cell = np.unique(np.floor(points_m[:, 0] / CELL_M), return_inverse=True)
    probability = np.bincount(cell, weight)
    positions_m = np.column_stack([(cells + 0.5) * CELL_M, np.zeros(len(cells))])
    order = np.argsort(-probability, kind="stable")
    return find_modes(positions_m[order], probability[order], points_m, weight, SPACING_M)


def test_two_places_have_their_own_masses() -> None:
    one, two = modes_of((0, 10, 0.6), (200, 10, 0.3))
    assert (one.probability, two.probability) == (pytest.approx(0.6, abs=0.01), pytest.approx(0.3, abs=0.01))
    assert abs(one.position_m[0]) < CELL_M
    assert abs(two.position_m[0] - 200) < CELL_M
    assert one.radius_m == pytest.approx(1.64 * 10, abs=CELL_M / 2), "nine tenths of a normal distribution"


@pytest.mark.parametrize("blobs", [[(0, 60, 1.0)], [(0, 8, 0.6), (40, 8, 0.4)]])
def test_a_slope_or_a_near_peak_is_no_other_place(blobs) -> None:
    [mode] = modes_of(*blobs)
    assert mode.probability == pytest.approx(1.0)


def test_the_rest_lies_elsewhere() -> None:
    modes = modes_of(*((200 * n, 10, 0.1) for n in range(9)))
    assert len(modes) == MAX_MODES
    assert sum(mode.probability for mode in modes) == pytest.approx(0.5, abs=0.01)
    assert len(modes_of((0, 10, 0.97), (200, 10, 0.02))) == 1


def test_a_point_has_half_the_width_of_its_square() -> None:
    one = np.zeros((1, 2))
    [mode] = find_modes(one, np.ones(1), one, np.ones(1), spacing_m=10.0)
    assert (mode.cell, mode.probability, mode.radius_m) == (0, 1.0, 5.0)
