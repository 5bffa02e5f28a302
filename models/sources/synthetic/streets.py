"""Synthetic towns, part 8: streets, their crossings, and the furniture along them."""

from typing import NamedTuple

import numpy as np

from models.sources.synthetic.layout import Line, Plan
from models.sources.synthetic.objects import FURNITURE, bridge, guard_rail, tree, tunnel
from models.sources.synthetic.shapes import LocalFrame, ground
from models.sources.synthetic.site import SCAN_REACH_M, Site

QUARTER_TURN = np.pi / 2
# Furniture per 100 m of a street's side; some comes in clusters of this many.
FURNITURE_RATES = {"lamp": 0.9, "pole": 0.85, "traffic sign": 0.95, "smallpole": 0.3, "trash bin": 0.2, "box": 0.28}
FURNITURE_RATES |= {"vending machine": 0.12, "stop": 0.12}
CLUSTER_SIZES = {"smallpole": (1, 5)}
# Classes that stand square to the street
FACING_STREET = frozenset({"stop", "vending machine", "box", "trash bin", "lamp"})
PAVEMENT_SPACING_M = 0.275  # between points of the pavement, scanned from near
DRIVEN_REACH_M = 6.0  # a street is driven if the drive comes this near to its middle


class Stretch(NamedTuple):
    """A street between two crossings: x along it, from carriageway to carriageway, y from its middle; metres."""

    spot: LocalFrame
    length_m: float
    line: Line
    over_m: float  # how far its carriageway goes back over the crossing at its start
    curbs_m: tuple[float, float]  # x from which to which its sidewalks go
    is_open: bool

    def side(self, flip: float) -> LocalFrame:
        """The frame of one side: y away from the middle."""
        return self.spot._replace(flip=flip)


def build_streets(site: Site, plan: Plan) -> None:
    """Build all streets that the drive comes near to."""
    stretches = []
    for line in _lines(plan):
        site.cut_chains()
        for stretch in line:
            length, half = stretch.length_m, stretch.line.reach_m
            if site.distance_to_drive_m(stretch.spot.offset(length / 2, 0)) <= SCAN_REACH_M + length / 2 + half:
                site.cut_chains(0.5)
                _build_stretch(site, stretch)
                stretches.append(stretch)
    driven = [s for s in stretches if site.distance_to_drive_m(s.spot.offset(s.length_m / 2, 0)) <= DRIVEN_REACH_M]
    _build_rarities(site, driven or stretches)
    _build_lights(site, plan)


def _lines(plan: Plan) -> list[list[Stretch]]:
    """Return the stretches of every street, those along the first axis first."""
    lines: list[list[Stretch]] = []
    for n, line in enumerate(plan.north):
        lines.append([])
        for e, (a, b) in enumerate(zip(plan.east[:-1], plan.east[1:], strict=True)):
            spot = LocalFrame(a.position_m + a.road_m / 2, line.position_m)
            length = b.position_m - b.road_m / 2 - spot.u
            lines[-1].append(Stretch(spot, length, line, a.road_m, (0, length), bool(plan.along_u[n, e])))
    for e, line in enumerate(plan.east):
        lines.append([])
        for n, (a, b) in enumerate(zip(plan.north[:-1], plan.north[1:], strict=True)):
            spot = LocalFrame(line.position_m, a.position_m + a.road_m / 2, 0, 1)
            length = b.position_m - b.road_m / 2 - spot.v
            is_crossed = e < len(plan.east) - 1 and plan.along_u[n, e]
            over = 0.0 if is_crossed else a.road_m
            curbs = (a.reach_m - a.road_m / 2, length - b.reach_m + b.road_m / 2)
            lines[-1].append(Stretch(spot, length, line, over, curbs, bool(plan.along_v[e, n])))
    return lines


def _build_stretch(site: Site, stretch: Stretch) -> None:
    rng, line, half = site.rng, stretch.line, stretch.line.road_m / 2
    if not stretch.is_open:  # a strip of green
        reach = line.reach_m
        site.add("terrain", stretch.spot, ground(rng, stretch.curbs_m, (-reach, reach), site.spacing_m * 1.2))
        for x in np.arange(4.0, stretch.length_m - 4, 9).tolist():
            site.cut_chains(0.6, "vegetation")
            spot = stretch.spot.offset(x, float(rng.uniform(-reach, reach)) / 2)
            site.add("vegetation", spot, tree(rng), chain="strip")
        return
    site.add(
        "road",
        stretch.spot,
        ground(rng, (-stretch.over_m, stretch.length_m), (-half, half), PAVEMENT_SPACING_M),
        chain="road",
    )
    has_trees = rng.random() < site.habits.rate("tree", 0.3)
    for flip in (1.0, -1.0):
        _build_side(site, stretch, flip)
        if has_trees:
            _build_trees(site, stretch, flip)
        _add_furniture(site, stretch, flip)


def _build_side(site: Site, stretch: Stretch, flip: float) -> None:
    """Build parking bays or grass next to the carriageway, then the sidewalk."""
    rng, line, (begin, end) = site.rng, stretch.line, stretch.curbs_m
    y, spot, name = line.road_m / 2, stretch.side(flip), str(flip)
    if line.strip_m:
        label = "parking" if rng.random() < 0.5 and end - begin > 38 else "terrain"
        inset = 3.0 if label == "parking" else 1.0
        strip = ground(rng, (begin + inset, end - inset), (y, y + line.strip_m), PAVEMENT_SPACING_M, z=0.05)
        site.add(label, spot, strip)
        y += line.strip_m
    walk = ground(rng, (begin, end), (y, y + line.sidewalk_m), PAVEMENT_SPACING_M, z=0.12)
    site.add("sidewalk", spot, walk, chain=name)


def _build_trees(site: Site, stretch: Stretch, flip: float) -> None:
    """Build a row of trees at the curb; some neighbours are one instance."""
    rng, line = site.rng, stretch.line
    step, size = float(rng.uniform(8, 14)), float(rng.uniform(0.6, 0.9))
    for x in np.arange(stretch.curbs_m[0] + 5, stretch.curbs_m[1] - 5, step).tolist():
        if rng.random() < 0.8:
            site.cut_chains(0.6, "vegetation")
            spot = stretch.side(flip).offset(
                x + float(rng.normal(0, 0.5)), line.road_m / 2 + max(0.8, line.strip_m / 2)
            )
            site.add("vegetation", spot, tree(rng, size), chain="row" + str(flip))


def _add_furniture(site: Site, stretch: Stretch, flip: float) -> None:
    """Add furniture of all classes along one side, at random places near the curb or near the lots."""
    for label, rate in FURNITURE_RATES.items():
        expected = site.habits.rate(label, rate) * stretch.length_m / 100 * (1.4 if stretch.line.is_main else 1)
        for _ in range(int(site.rng.poisson(expected))):
            _place_furniture(site, stretch, flip, label)


def _place_furniture(site: Site, stretch: Stretch, flip: float, label: str) -> None:
    """Place one piece of furniture, or a row of it, on a side; a sign often with a pole."""
    rng, line = site.rng, stretch.line
    x = float(rng.uniform(1, stretch.length_m - 1))
    at_curb = rng.random() < (0.3 if label in {"box", "vending machine", "stop"} else 0.7)
    y = line.road_m / 2 + line.strip_m + (0.5 if at_curb else max(0.5, line.sidewalk_m - 0.6))
    step = float(rng.uniform(1.3, 3.5))
    for n in range(int(rng.integers(*CLUSTER_SIZES.get(label, (1, 2))))):
        turn = 0.0 if label in FACING_STREET else QUARTER_TURN + float(rng.normal(0, 0.2))
        spot = stretch.side(flip).offset(x + n * step, y, turn)
        site.add(label, spot, FURNITURE[label](rng))
        if label == "traffic sign" and rng.random() < 0.6:
            site.add("pole", spot, FURNITURE["pole"](rng))


def _build_rarities(site: Site, stretches: list[Stretch]) -> None:
    """Build guard rails, bridges and tunnels, and at least one of each rare class, so that every town has them."""
    rng, base_count = site.rng, max(1, round(len(stretches) / 35))
    for label, count in (("guard rail", 3 * base_count), ("bridge", base_count), ("tunnel", base_count), ("stop", 1)):
        for row in rng.integers(len(stretches), size=count).tolist():
            stretch, flip = stretches[row], float(rng.choice([-1.0, 1.0]))
            line, length = stretch.line, stretch.length_m
            if label == "guard rail":
                rail = guard_rail(rng, length * float(rng.uniform(0.4, 0.9)))
                site.add(label, stretch.side(flip).offset(3, line.road_m / 2 + 0.2), rail)
            elif label == "bridge":
                spot = stretch.spot.offset(length * float(rng.uniform(0.3, 0.7)), 0)
                site.add(label, spot, bridge(rng, 2 * line.reach_m))
            elif label == "tunnel":
                tunnel_m = length * float(rng.uniform(0.3, 0.6))
                spot = stretch.spot.offset(float(rng.uniform(4, length - tunnel_m - 4)), 0)
                site.add(label, spot, tunnel(rng, tunnel_m, 2 * line.reach_m - 0.5))
            else:
                _place_furniture(site, stretch, flip, "stop")
                _place_furniture(site, stretch, flip, "vending machine")


def _build_lights(site: Site, plan: Plan) -> None:
    """Build traffic lights at the corners of some crossings, mostly of main streets, and of at least one."""
    rng = site.rng
    crossings = [(LocalFrame(e.position_m, n.position_m), e, n) for e in plan.east for n in plan.north]
    near = [c for c in crossings if site.distance_to_drive_m(c[0]) <= SCAN_REACH_M]
    with_lights = [c for c in near if rng.random() < (0.06, 0.45, 0.9)[c[1].is_main + c[2].is_main]]
    with_lights.append(min(crossings, key=lambda c: site.distance_to_drive_m(c[0])))
    for spot, east, north in with_lights:
        for su, sv in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
            if rng.random() < 0.8:
                u, v = su * (east.road_m / 2 + 0.6), sv * (north.road_m / 2 + 0.6)
                corner = spot.offset(u, v, float(rng.integers(4)) * QUARTER_TURN)
                site.add("traffic light", corner, FURNITURE["traffic light"](rng))
