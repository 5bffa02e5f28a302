"""Objects drawn on a grid, beside their points one by one."""

from itertools import pairwise

import numpy as np
import pytest

from models.citymap.gazetteer.closest_points import is_inside
from models.citymap.gazetteer.rasterize import PixelGrid, draw_areas, draw_lines, pixels_at
from tests.models.citymap.gazetteer.made_town import line, point

GRID = PixelGrid(100.0, -50.0, 10.0, 3, 4)
FINE = PixelGrid(-40.0, -40.0, 0.5, 161, 161)


def test_points_fall_on_the_nearest_pixel_or_outside() -> None:
    points = np.array([(100, -50), (104.9, -50), (105.1, -50), (124.9, -15.1), (94.9, -50), (125.1, -20), (100, -14.9)])
    assert pixels_at(GRID, points).tolist() == [0, 0, 4, 11, -1, -1, -1]
    assert pixels_at(GRID, np.zeros((0, 2))).tolist() == []


def test_lines_are_drawn_object_by_object_where_they_are_inside() -> None:
    objects = [line((100, -50), (100, -20)), point(120, -30), line((110, -90), (110, -10)), point(0, 0)]
    segments = np.concatenate(objects).astype(np.float32)
    starts = np.concatenate([[0], np.cumsum([len(one) for one in objects])])
    pixels, until = draw_lines(GRID, segments, starts, np.array([1, 0, 3, 2]), 6.0)
    assert pixels.dtype == np.int32
    assert [pixels[a:b].tolist() for a, b in pairwise(until)] == [
        [10],
        [0, 1, 2, 3],
        [],
        [4, 5, 6, 7],
    ]


@pytest.mark.parametrize("seed", range(4))
def test_lines_have_the_pixels_of_points_no_farther_apart_than_was_said(seed) -> None:
    rng = np.random.default_rng(seed)
    segments = rng.uniform(-45, 45, (30, 4)).astype(np.float32)
    pixels, _ = draw_lines(FINE, segments, np.array([0, 30]), np.array([0]), 0.2)
    dense = np.linspace(0, 1, 2001)[:, None]
    points = np.concatenate(
        [start + dense * (end - start) for start, end in segments.astype(np.float64).reshape(-1, 2, 2)]
    )
    reached = np.unique(pixels_at(FINE, points))
    result = np.unique(pixels)
    assert np.isin(result, reached).mean() > 0.99, "nothing else, but for pixels that a corner of is met"
    assert np.isin(reached, result).mean() > 0.9


@pytest.mark.parametrize("seed", range(4))
def test_areas_have_the_points_of_a_lattice_that_are_inside_one_by_one(seed) -> None:
    rng, apart_m = np.random.default_rng(seed), 2.5
    rings = []
    for reach in (30.0, 12.0):  # a ragged area, and a ragged hole in it
        angle = np.sort(rng.uniform(0, 2 * np.pi, 17))
        xy = rng.uniform(0.6, 1.0, (17, 1)) * reach * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        rings.append(np.concatenate([xy, np.roll(xy, -1, axis=0)], axis=1))
    outer, hole = rings
    segments = np.concatenate([outer + 100.0, outer, hole]).astype(np.float32)
    starts = np.array([0, len(outer), len(segments)])
    result, until = draw_areas(FINE, segments, starts, np.array([1, 0]), apart_m)
    ends = segments[starts[1] :].astype(np.float64)
    low, high = (edge(ends.reshape(-1, 2), axis=0) for edge in (np.min, np.max))
    xs, ys = (np.arange(low[axis] + apart_m / 2, high[axis], apart_m) for axis in (0, 1))
    naive = np.array([(x, y) for x in xs for y in ys if is_inside(x, y, ends)])
    assert result.tolist() == pixels_at(FINE, naive).tolist()
    assert len(naive) > 50
    assert until.tolist() == [0, len(naive), len(naive)], "the other is outside"
