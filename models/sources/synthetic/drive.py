"""Synthetic towns, part 5: a drive through the streets that passes some number of cells."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, dijkstra

from models.citymap.types import Floats
from models.sources.kitti360.prepare import grid_centers, spaced_rows
from models.sources.kitti360.rules import PrepareConfig
from models.sources.synthetic.layout import Land, Node, Plan
from models.sources.synthetic.shapes import Rng

CAMERA_HEIGHT_M = 0.9  # above the road
SMOOTHING_WINDOW_M = 9  # corners are rounded over this length
CELLS_PER_M = 0.6  # of street, at most: a band of 60 m, a cell for each 100 square metres


def draw_drive(rng: Rng, plan: Plan, land: Land, cells: float) -> Floats:
    """Draw a drive along the streets, each once where possible, until some number of cells is passed.

    Return poses [F, 3] (float64) about a metre apart, plan frame, with heights above the ground; all the plan's streets
    if these are too few.
    """
    walk = Walk(rng, plan)
    length_m = cells / CELLS_PER_M
    while True:
        is_longer = walk.extend(length_m)
        drive = smooth_track(np.concatenate(walk.track))
        end = _end_row(land.to_world(drive), cells)
        if end is not None or not is_longer:
            return drive[:end]
        length_m *= 1.15


def _end_row(world_m: Floats, cells: float) -> int | None:
    """Return how many poses of a drive pass about some number of cells; None if all of them pass fewer."""
    config = PrepareConfig()
    rows = spaced_rows(world_m, config.spacing_m)
    before = (0, 0)
    for n in range(2, len(rows) + 1):
        if n * config.spacing_m * CELLS_PER_M + 30 < cells:
            continue
        passed = len(grid_centers(world_m[rows[:n]], config))
        if passed >= cells:
            is_nearer = passed - cells <= cells - before[0]
            return int(rows[n - 1]) + 1 if is_nearer or not before[1] else before[1]
        before = (passed, int(rows[n - 1]) + 1)
    return None


class Walk:
    """A growing path from crossing to crossing."""

    def __init__(self, rng: Rng, plan: Plan) -> None:
        self._rng, self._plan = rng, plan
        self._graph = _street_graph(plan)
        self._node = _start_node(plan, self._graph)
        self._start = plan.position_m(self._node)
        self._visited: set[frozenset[Node]] = set()
        self._length_m = 0.0
        self.track = [self._start[None]]

    def extend(self, length_m: float) -> bool:
        """Extend the path to a length of distinct streets; return False if no street is left."""
        while self._length_m < length_m:
            route = self._next_route()
            if not route:
                return False
            for next_node in route:
                street = frozenset((self._node, next_node))
                points = _lane_points(self._plan, self._node, next_node)
                self._length_m += len(points) * (street not in self._visited)
                self._visited.add(street)
                self._node = next_node
                self.track.append(points)
        return True

    def _unvisited_neighbours(self, node: Node) -> list[Node]:
        return [b for b in self._plan.neighbours(node) if frozenset((node, b)) not in self._visited]

    def _cost(self, a: Node, b: Node) -> float:
        """Return a cost that is least for streets near the start, so that the walk stays compact."""
        middle = (self._plan.position_m(a) + self._plan.position_m(b)) / 2
        return float(np.linalg.norm(middle - self._start)) + float(self._rng.uniform(0, 40))

    def _next_route(self) -> list[Node]:
        """Return the next crossings: over a street not yet walked, or over old ones to such a street; may be empty."""
        node, size = self._node, len(self._plan.north)
        if unvisited := self._unvisited_neighbours(node):
            return [min(unvisited, key=lambda b: self._cost(node, b))]
        distances, before = dijkstra(self._graph, indices=node[0] * size + node[1], return_predecessors=True)
        reachable = [(int(n) // size, int(n) % size) for n in np.flatnonzero(np.isfinite(distances))]
        ends = [
            (self._cost(a, b) + 0.5 * float(distances[a[0] * size + a[1]]), a, b)
            for a in reachable
            for b in self._unvisited_neighbours(a)
        ]
        if not ends:
            return []
        _, a, b = min(ends)
        route, n = [b], a[0] * size + a[1]
        while n != node[0] * size + node[1]:
            route.append((n // size, n % size))
            n = int(before[n])
        return route[::-1]


def _start_node(plan: Plan, graph: coo_array) -> Node:
    """Return the crossing nearest to the middle of the plan from which most others can be reached."""
    part = connected_components(graph)[1]
    largest = np.flatnonzero(part == np.bincount(part).argmax())
    nodes = [(int(n) // len(plan.north), int(n) % len(plan.north)) for n in largest]
    return min(nodes, key=lambda node: float(np.linalg.norm(plan.position_m(node))))


def _street_graph(plan: Plan) -> coo_array:
    """Return the lengths of the open streets between crossings, which are numbered from south to north, then east."""
    size = len(plan.north)
    rows = [
        (a[0] * size + a[1], b[0] * size + b[1], float(np.abs(plan.position_m(a) - plan.position_m(b)).sum()))
        for a in [(e, n) for e in range(len(plan.east)) for n in range(size)]
        for b in plan.neighbours(a)
    ]
    source, target, length = zip(*rows, strict=True)
    return coo_array((length, (source, target)), shape=(len(plan.east) * size,) * 2)


def _lane_points(plan: Plan, a: Node, b: Node) -> Floats:
    """Return positions [M, 2] a metre apart from crossing to crossing, in the right-hand lane."""
    start, end = plan.position_m(a), plan.position_m(b)
    length = float(np.linalg.norm(end - start))
    ahead = (end - start) / length
    line = plan.north[a[1]] if a[1] == b[1] else plan.east[a[0]]
    lane_m = line.road_m / 4
    steps = np.arange(min(4.0, length / 4), length - min(4.0, length / 4))
    return start + steps[:, None] * ahead + lane_m * np.array([ahead[1], -ahead[0]])


def smooth_track(track: Floats) -> Floats:
    """Return a track [F, 3] with rounded corners, about a metre apart, at the height of the camera."""
    travelled_m = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(track, axis=0), axis=1))])
    even = np.column_stack([np.interp(np.arange(0, travelled_m[-1] + 1e-9), travelled_m, axis) for axis in track.T])
    half = SMOOTHING_WINDOW_M // 2
    padded = np.pad(even, ((half, half), (0, 0)), mode="edge")
    rounded = np.lib.stride_tricks.sliding_window_view(padded, SMOOTHING_WINDOW_M, axis=0).mean(axis=-1)
    return np.column_stack([rounded, np.full(len(rounded), CAMERA_HEIGHT_M)])
