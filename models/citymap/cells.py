"""Cut a map into cells: the instances, whole or clipped, inside cubes around given centres.

The same code cuts the cells of the grid and the cube around a pose for its hints (docs/formats.md, rules 4 and 5).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, partial
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from models.citymap.point_sample import FIXED_SAMPLING, PointSampling, Sampler, sample_points, stack_samples
from models.citymap.points import Ints, PointTable, ranges
from models.citymap.types import CutRules, Floats
from models.processes import map_forked

CUBES_PER_TASK = 128  # cubes that one worker process cuts at a time
GRID_POINTS_PER_BLOCK: Final = 100_000  # grid points that share one search tree of the locations near them
CELLS_PER_BLOCK: Final = 1024  # encoded or tabulated together; no result depends on a cell of another block


@dataclass(frozen=True, slots=True, eq=False)
class PartTable:
    """The parts of instances in N cubes: one row for each instance (or connected part of it) and cube."""

    starts: Ints  # [N + 1] cube n has the rows starts[n] to starts[n + 1]
    instance: Ints  # [R] int32, row in `CityMap.instances`
    count: Ints  # [R] int32, points of the part
    low_m: Floats  # [R, 3] float32, the part's bounding box, map frame
    high_m: Floats
    closest_m: Floats  # [R, 3] float32, the part's point nearest to the centre of the cube, map frame
    rgb: Floats  # [R, 3] float32 mean colour, NaN where unknown

    @property
    def center_m(self) -> Floats:
        """Return the centres [R, 3] of the bounding boxes."""
        return (self.low_m + self.high_m) / 2

    @property
    def cube(self) -> Ints:
        """Return the cube [R] of each row."""
        return np.repeat(np.arange(len(self.starts) - 1), np.diff(self.starts))

    def take(self, cubes: Ints) -> "PartTable":
        """Return the rows of the given cubes, in their order."""
        begin, end = self.starts[cubes], self.starts[cubes + 1]
        is_all = len(cubes) and (begin[1:] == end[:-1]).all() and end[-1] - begin[0] == len(self.instance)
        if is_all:  # the cubes left out are empty
            return replace(self, starts=np.append(begin, end[-1]))
        rows = ranges(begin, end)
        columns = {f.name: getattr(self, f.name)[rows] for f in fields(self) if f.name != "starts"}
        return PartTable(starts=np.concatenate([[0], np.cumsum(end - begin)]), **columns)


@dataclass(frozen=True, eq=False)
class CellTable:
    """The cells of one or more maps, in columns."""

    ids: Sequence[str]  # N names "<scene>_<number>"
    scenes: tuple[str, ...]  # N scene names
    center_m: Floats  # [N, 3] float64, map frame
    size_m: float  # edge of the cubes
    content: PartTable | Callable[[Ints], PartTable]  # the parts, or a function that cuts those of some rows
    # Returns sampled points of the parts; None where points are not available, as in an index
    sample: Sampler | None = field(default=None, repr=False)

    def __len__(self) -> int:
        return len(self.ids)

    @cached_property
    def parts(self) -> PartTable:
        """Return the parts in all cells; cutting them takes seconds for a city, so `content` cuts single cells."""
        return self.content if isinstance(self.content, PartTable) else self.content(np.arange(len(self)))

    @property
    def extent_m(self) -> float:
        """Return the radius of a circle that holds the whole map from any position in it."""
        return float(np.linalg.norm(np.ptp(self.center_m[:, :2], axis=0)) + self.size_m)

    def take(self, rows: Ints) -> "CellTable":
        """Return the given cells, in their order."""
        sample, content = self.sample, self.content
        return CellTable(
            ids=tuple(self.ids[r] for r in rows),
            scenes=tuple(self.scenes[r] for r in rows),
            center_m=self.center_m[rows],
            size_m=self.size_m,
            content=content.take(rows) if isinstance(content, PartTable) else (lambda chosen: content(rows[chosen])),
            sample=sample and (lambda cells, sampling=FIXED_SAMPLING: sample(rows[cells], sampling)),
        )


def grid_centers(locations_m: Floats, rules: CutRules) -> Floats:
    """Return the grid centres [N, 3] (float64) within reach of a location, at that location's height."""
    low = np.floor(locations_m[:, :2].min(axis=0) / rules.grid_m).astype(int)
    high = np.ceil(locations_m[:, :2].max(axis=0) / rules.grid_m).astype(int)
    column, row = _squares_of(locations_m, rules.grid_m)
    # A location in square n has the grid points n - reach to n + 1 + reach around it.
    reach = int(rules.reach_m // rules.grid_m)
    row, column = _spread(row, column, range(-reach, reach + 2), (low[1], high[1]))
    column, row = _spread(column, row, range(-reach, reach + 2), (low[0], high[0]))
    return centers_within_reach(np.column_stack([column, row]) * rules.grid_m, locations_m, rules.reach_m)


def _squares_of(locations_m: Floats, edge_m: float) -> tuple[Ints, Ints]:
    """Return the columns and rows [S] of the squares in which there are locations."""
    return _unique_pairs(*np.floor(locations_m[:, :2] / edge_m).astype(np.int64).T)


def _spread(moved: Ints, other: Ints, steps: range, ends: tuple[int, int]) -> tuple[Ints, Ints]:
    """Return the distinct pairs that arise by adding each of some steps to `moved`, from `ends[0]` to `ends[1]`."""
    moved, other = (moved[:, None] + np.array(steps)).ravel(), np.repeat(other, len(steps))
    is_inside = (moved >= ends[0]) & (moved <= ends[1])
    return _unique_pairs(moved[is_inside], other[is_inside])


def _unique_pairs(first: Ints, second: Ints) -> tuple[Ints, Ints]:
    """Return the distinct pairs of two columns of integers, ascending."""
    low, span = second.min(), np.ptp(second) + 1
    first, second = np.divmod(np.unique(first * span + (second - low)), span)
    return first, second + low


def centers_within_reach(grid_m: Floats, locations_m: Floats, reach_m: float) -> Floats:
    """Return the points of a grid [G, 2] within reach of a location, as [N, 3] with the nearest location's height.

    Fast if the points ascend from west to east.
    """
    centers = [np.zeros((0, 3))]
    eastward = np.argsort(locations_m[:, 0], kind="stable")
    easting_m = locations_m[eastward, 0].astype(np.float64)
    for n in range(0, len(grid_m), GRID_POINTS_PER_BLOCK):
        block = grid_m[n : n + GRID_POINTS_PER_BLOCK]
        begin, end = np.searchsorted(easting_m, [block[:, 0].min() - reach_m, block[:, 0].max() + reach_m])
        nearby = locations_m[np.sort(eastward[begin:end])]
        if len(nearby):
            distance, nearest = cKDTree(nearby[:, :2]).query(block, distance_upper_bound=reach_m)
            near = np.isfinite(distance)
            centers.append(np.column_stack([block[near], nearby[nearest[near], 2]]))
    return np.concatenate(centers)


def cut_cubes(
    points: PointTable, centers_m: Floats, rules: CutRules, progress: Callable[[int, int], None] | None = None
) -> PartTable:
    """Cut the cubes around centres [N, 3], in several processes if there are many; `progress` gets (cubes cut, N)."""
    done, results = 0, []
    chunks = [centers_m[i : i + CUBES_PER_TASK] for i in range(0, len(centers_m), CUBES_PER_TASK)]
    for result in map_forked(partial(_cut_chunk, points, rules), chunks):
        results.append(result)
        done += len(result[0])
        if progress:
            progress(done, len(centers_m))
    sizes = np.concatenate([result[0] for result in results]) if results else np.zeros(0, dtype=np.int64)
    columns = [
        np.concatenate(column) for column in zip(*(r[1:] for r in results), strict=True)
    ] or _concatenate_columns([])
    return PartTable(np.concatenate([[0], np.cumsum(sizes)]), *columns)


def sample_cubes(
    points: PointTable, rules: CutRules, centers_m: Floats, cubes: Ints, sampling: PointSampling = FIXED_SAMPLING
) -> Floats:
    """Return sampled points [R, 256, 6] of the parts in some cubes, in order of `PartTable`."""
    return stack_samples(
        [
            sample_points(points.xyz[rows], points.colours(rows), sampling, center, rules.cell_size_m)
            for center in centers_m[cubes].astype(np.float64)
            for rows in _unordered_parts(points, center, rules)
        ]
    )


def _cut_chunk(points: PointTable, rules: CutRules, centers: Floats) -> tuple[Any, ...]:
    """Return the number of rows of each cube, followed by the columns of `PartTable`."""
    members = [_unordered_parts(points, center, rules) for center in centers.astype(np.float64)]
    sizes = np.array([len(rows) for rows in members], dtype=np.int64)
    summaries = [_summarise(points, rows, center) for rows, center in zip(members, centers, strict=True) if rows]
    return (sizes, *_concatenate_columns(summaries))


def _concatenate_columns(summaries: list[tuple[Any, ...]]) -> list[npt.NDArray[Any]]:
    empty = (
        *(np.zeros(0, dtype=np.int32),) * 2,
        *(np.zeros((0, 3), dtype=np.float32),) * 4,
    )
    return [np.concatenate(column) for column in zip(empty, *summaries, strict=True)]


def _summarise(points: PointTable, members: list[Ints], center: Floats) -> tuple[Any, ...]:
    """Return the columns of `PartTable` for the parts of one cube."""
    count = np.array([len(m) for m in members], dtype=np.int32)
    starts = np.cumsum(count) - count
    rows = np.concatenate(members)
    xyz = points.xyz[rows]
    distance = ((xyz - center) ** 2).sum(axis=1)
    part = np.repeat(np.arange(len(members)), count)
    # The first row of each part when sorted by distance within the part.
    closest = np.lexsort((distance, part))[starts]
    instance = points.instance[rows[starts]]
    rgb = points.instance_rgb[instance]
    if points.rgb is not None:
        rgb = np.add.reduceat(points.rgb[rows], starts) / count[:, None]
    return (
        instance,
        count,
        np.minimum.reduceat(xyz, starts),
        np.maximum.reduceat(xyz, starts),
        xyz[closest],
        rgb.astype(np.float32),
    )


def cut_parts(points: PointTable, center_m: Floats, rules: CutRules) -> list[Ints]:
    """Return the point rows of each part in one cube, ordered by instance, then by DBSCAN number."""
    return sorted(_unordered_parts(points, center_m, rules), key=lambda rows: int(points.instance[rows[0]]))


def _unordered_parts(points: PointTable, center: Floats, rules: CutRules) -> list[Ints]:
    """Return the point rows of each part in one cube: things first, then stuff."""
    half = rules.cell_size_m / 2
    inside = points.inside(center - half, center + half)
    stuff = points.is_stuff[points.instance[inside]]
    present, counts = np.unique(points.instance[inside[~stuff]], return_counts=True)
    whole = np.diff(points.starts)[present]
    things = present[counts >= rules.thing_share * whole]
    parts = [np.arange(points.starts[i], points.starts[i + 1]) for i in things]
    labels = _dbscan(points, inside[stuff], rules.min_samples)
    order = np.argsort(labels, kind="stable")
    sizes = np.bincount(labels[labels >= 0])
    rows = inside[stuff][order[(labels < 0).sum() :]]
    clipped = np.split(rows, np.cumsum(sizes)[:-1]) if len(sizes) else []
    clipped = [part for part in clipped if len(part) >= rules.min_part_points]
    return parts + sorted(clipped, key=lambda part: int(points.instance[part[0]]))


def _dbscan(points: PointTable, rows: Ints, min_samples: int) -> Ints:
    """Return DBSCAN labels [M] of ascending point rows, numbered as by scikit-learn; -1 for noise.

    Only neighbours among these rows count. A cluster never crosses from one instance to another.
    """
    source, target = _neighbour_pairs_among(points, rows)
    degree = 1 + np.bincount(source, minlength=len(rows)) + np.bincount(target, minlength=len(rows))
    core = degree >= min_samples
    from_core, to_core = core[source], core[target]
    both = from_core & to_core
    number = np.cumsum(core, dtype=np.int32) - 1  # core points among themselves
    starts = np.concatenate([[0], np.cumsum(np.bincount(source[both], minlength=len(rows)))[core]]).astype(np.int32)
    graph = csr_array((np.ones(starts[-1]), number[target[both]], starts), shape=(core.sum(),) * 2)
    labels = np.full(len(rows), len(rows), dtype=np.int64)
    labels[core] = connected_components(graph, directed=False)[1]
    # A border point joins the first cluster that reaches it: the least number among its core neighbours.
    result = labels.copy()
    leaving, arriving = from_core & ~to_core, to_core & ~from_core
    np.minimum.at(result, target[leaving], labels[source[leaving]])
    np.minimum.at(result, source[arriving], labels[target[arriving]])
    return np.where(result == len(rows), -1, result)


def _neighbour_pairs_among(points: PointTable, rows: Ints) -> tuple[Ints, Ints]:
    """Return the positions [E], [E] in `rows`, ascending, of neighbour pairs within it; the first ascends."""
    if not len(rows):
        return rows, rows
    begin, end = points.pair_starts[rows], points.pair_starts[rows + 1]
    source = np.repeat(np.arange(len(rows)), end - begin)
    target_row = points.pairs[ranges(begin, end)]
    # A table over the rows from the first to the last of each instance gives the position of a row.
    first = np.flatnonzero(np.diff(points.instance[rows], prepend=-1))
    last = np.append(first[1:], len(rows)) - 1
    span = rows[last] - rows[first] + 1
    shift = np.repeat(np.cumsum(span) - span - rows[first], last - first + 1)
    position = np.zeros(span.sum(), dtype=np.int64)
    position[rows + shift] = np.arange(len(rows))
    within = np.minimum(target_row, np.repeat(rows[last], last - first + 1)[source])
    target = position[within + shift[source]]
    valid = rows[target] == target_row
    return source[valid], target[valid]
