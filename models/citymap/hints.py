"""Describe positions by hints (docs/formats.md, rules 3, 5 and 6), and choose positions to describe."""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from models.citymap.cells import CellTable, PartTable
from models.citymap.colours import Palette
from models.citymap.map_geometry import MapGeometry
from models.citymap.points import thin_to_spacing
from models.citymap.types import DIRECTIONS, CityMap, Description, Direction, Floats, Hint, Pose

Strategy = Literal["closest", "class", "direction"]
STRATEGIES: tuple[Strategy, ...] = ("closest", "class", "direction")
NUM_HINTS = 6  # in a description of KITTI360Pose
HINT_REACH_M = 15.0  # farthest instance that a hint mentions (rule 5)
BEST_CELL_REACH_M = 15.0  # a pose farther than this from every cell's centre has no best cell (rule 5)
ON_TOP_M = 1.5  # 0.05 of a 30 m cell (rule 6)


def direction_index(offset_m: Floats, on_top_m: float = ON_TOP_M) -> npt.NDArray[np.intp]:
    """Return the index [...] into DIRECTIONS of positions as seen from instances (docs/formats.md, rule 6).

    Offsets [..., 2 or 3] are the position minus the instance's closest point; nearer than `on_top_m` is "on-top".
    """
    x, y = np.asarray(offset_m)[..., 0], np.asarray(offset_m)[..., 1]
    north_south = np.where(y > 0, 0, 1)
    east_west = np.where(x > 0, 2, 3)
    sector = np.where(np.abs(x) > np.abs(y), east_west, north_south)
    return np.where(np.hypot(x, y) < on_top_m, 4, sector)


@dataclass(frozen=True, slots=True, eq=False)
class HintTable:
    """All true hints at N positions, in columns."""

    starts: npt.NDArray[Any]  # [N + 1] position n has the rows starts[n] to starts[n + 1], nearest first
    instance: npt.NDArray[Any]  # [R] row in `CityMap.instances`
    direction: npt.NDArray[Any]  # [R] index into DIRECTIONS
    colour: npt.NDArray[Any]  # [R] index into the palette's words, -1 if unknown


def build_hint_table(palette: Palette, parts: PartTable, positions_m: Floats) -> HintTable:
    """Build the table of all hints that are true at positions [N, 3], from the parts in the cubes around them."""
    cube = parts.cube
    offset = positions_m[cube] - parts.closest_m
    distance = np.hypot(offset[:, 0], offset[:, 1])
    near = np.flatnonzero(distance <= HINT_REACH_M)
    near = near[np.lexsort((distance[near], cube[near]))]
    sizes = np.bincount(cube[near], minlength=len(positions_m))
    return HintTable(
        starts=np.concatenate([[0], np.cumsum(sizes)]),
        instance=parts.instance[near],
        direction=direction_index(offset[near]),
        colour=palette.word_index(parts.rgb[near]),
    )


def choose_hints(
    table: HintTable, n: int, labels: npt.NDArray[Any], strategy: Strategy, count: int
) -> npt.NDArray[Any]:
    """Return the rows of at most `count` hints that one strategy picks at position n, given labels [I] of instances.

    "closest" takes the nearest; "class" and "direction" take the nearest of each in turn, so that the hints differ.
    """
    rows = np.arange(table.starts[n], table.starts[n + 1])
    if strategy == "closest":
        return rows[:count]
    keys = labels[table.instance[rows]] if strategy == "class" else table.direction[rows]
    return rows[np.argsort(_occurrence_number(keys), kind="stable")[:count]]


def _occurrence_number(keys: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return how many earlier entries [M] have the same key; sorting by it takes the keys in turn."""
    order = np.argsort(keys, kind="stable")
    starts = np.flatnonzero(np.diff(keys[order], prepend=-1))
    nth = np.empty(len(keys), dtype=np.intp)
    nth[order] = np.arange(len(keys)) - np.repeat(starts, np.diff(starts, append=len(keys)))
    return nth


def round_robin(keys: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return the order [M] in which the keys take turns, each with its next entry, starting with the first key."""
    _, first, key = np.unique(keys, return_index=True, return_inverse=True)
    return np.lexsort((first[key], _occurrence_number(keys)))


def sample_positions(locations_m: Floats, spacing_m: float, rng: np.random.Generator) -> Floats:
    """Return random locations [N, 3] in random order, one in each square block of `spacing_m`."""
    return thin_to_spacing(rng.permutation(locations_m), spacing_m)


def describe_poses(
    city_map: CityMap, geometry: MapGeometry, cells: CellTable, positions_m: Floats, num_hints: int = NUM_HINTS
) -> list[Pose]:
    """Return poses with descriptions at positions [N, 3], by each strategy (docs/formats.md, rule 5).

    Poses are in order of position, then strategy. A position without a cell centre within 15 m, or with fewer than
    `num_hints` instances around it, is left out; so is a description of the same instances as another.
    """
    distance, best = cKDTree(cells.center_m).query(positions_m)
    reachable = np.flatnonzero(distance <= BEST_CELL_REACH_M)
    positions, best = positions_m[reachable], best[reachable]
    table = build_hint_table(city_map.palette, geometry.cut(positions), positions)
    labels = np.unique([i.label for i in city_map.instances], return_inverse=True)[1]
    poses = []
    for n in np.flatnonzero(np.diff(table.starts) >= num_hints):
        mentioned: set[frozenset[int]] = set()
        for strategy in STRATEGIES:
            rows = choose_hints(table, int(n), labels, strategy, num_hints)
            instances = frozenset(table.instance[rows].tolist())
            if instances not in mentioned:
                mentioned.add(instances)
                hints = tuple(_hint(city_map, table, int(row)) for row in rows)
                poses.append(Pose(positions[n], cells.ids[best[n]], Description(hints), strategy))
    return poses


def _hint(city_map: CityMap, table: HintTable, row: int) -> Hint:
    instance, colour = int(table.instance[row]), int(table.colour[row])
    direction: Direction = DIRECTIONS[table.direction[row]]
    word = None if colour < 0 else city_map.palette.words[colour]
    return Hint(direction, city_map.instances[instance].label, word, city_map.instances[instance].id)
