"""Synthetic towns, part 7: lots, the pieces of land between streets, and the buildings on each kind of lot."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from models.citymap.types import Floats
from models.sources.synthetic.layout import Line, Plan
from models.sources.synthetic.objects import FURNITURE, building, bush, fence, garage, hedge, tree, wall
from models.sources.synthetic.shapes import LocalFrame, ground, pick
from models.sources.synthetic.site import SCAN_REACH_M, Site

QUARTER_TURN = np.pi / 2


class Lot(NamedTuple):
    """A lot: x along its street from 0 to the width, y away from the street from 0 to the depth, metres."""

    spot: LocalFrame
    width_m: float
    depth_m: float


def build_blocks(site: Site, plan: Plan) -> None:
    """Build on all blocks between the streets of a plan."""
    for west, east in zip(plan.east[:-1], plan.east[1:], strict=True):
        for south, north in zip(plan.north[:-1], plan.north[1:], strict=True):
            _build_block(site, west, east, south, north)


def _build_block(site: Site, west: Line, east: Line, south: Line, north: Line) -> None:
    """Build two rows of lots, back to back, along the longer sides of a block."""
    u = (west.position_m + west.reach_m, east.position_m - east.reach_m)
    v = (south.position_m + south.reach_m, north.position_m - north.reach_m)
    width, height = u[1] - u[0], v[1] - v[0]
    if site.distance_to_drive_m(LocalFrame(sum(u) / 2, sum(v) / 2)) > SCAN_REACH_M + np.hypot(width, height) / 2:
        return
    site.cut_chains()
    kind = pick(site.rng, site.habits.lots)
    if width >= height:
        rows = [LocalFrame(u[0], v[0]), LocalFrame(u[0], v[1], flip=-1)]
    else:
        rows = [LocalFrame(u[0], v[0], 0, 1, flip=-1), LocalFrame(u[1], v[0], 0, 1)]
        width, height = height, width
    middle = height * float(site.rng.uniform(0.42, 0.58))
    for spot, depth in zip(rows, (middle, height - middle), strict=True):
        _build_row(site, spot, width, depth, kind)


def _build_row(site: Site, spot: LocalFrame, width_m: float, depth_m: float, kind: str) -> None:
    width_range_m = LOT_KINDS[kind].width_m
    count = max(1, round(width_m / float(site.rng.uniform(*width_range_m))))
    share = site.rng.uniform(0.8, 1.25, count)
    edges = np.concatenate([[0], np.cumsum(share / share.sum())]) * width_m
    for begin, end in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        lot = Lot(spot.offset(begin, 0), end - begin, depth_m)
        if site.distance_to_drive_m(lot.spot.offset(lot.width_m / 2, depth_m / 2)) <= SCAN_REACH_M + depth_m / 2:
            site.cut_chains(0.15)
            LOT_KINDS[kind].build(site, lot)


def _draw_chance(site: Site, kind: str, base_rate: float) -> bool:
    return bool(site.rng.random() < site.habits.rate(kind, base_rate))


def _draw_count(site: Site, kind: str, base_rate: float) -> int:
    return int(site.rng.poisson(site.habits.rate(kind, base_rate)))


def _draw_between(site: Site, low: float, high: float) -> float:
    return float(site.rng.uniform(low, max(low, high)))


def _add_lawn(site: Site, lot: Lot, y: tuple[float, float], coarse: float = 1.0) -> None:
    """Add grass over the width of a lot, one instance with the neighbour's while the chain holds."""
    if y[1] - y[0] > 3:
        site.add(
            "terrain", lot.spot, ground(site.rng, (0, lot.width_m), y, site.spacing_m * 1.4 * coarse), chain="lawn"
        )


def _add_court(site: Site, lot: Lot, x: tuple[float, float], y: tuple[float, float]) -> None:
    """Add paved ground to park on, or grass where there is too little room."""
    is_large = (x[1] - x[0]) * (y[1] - y[0]) > 130
    label, coarse = ("parking", 1.0) if is_large else ("terrain", 1.15)
    site.add(label, lot.spot, ground(site.rng, x, y, site.spacing_m * coarse), chain="court")


def _add_plants(
    site: Site, lot: Lot, x: tuple[float, float], y: tuple[float, float], trees: float, bushes: float
) -> None:
    """Add trees and bushes to a part of a lot, some of them one instance with the last."""
    for kind, make, base_rate in (("tree", tree, trees), ("bush", bush, bushes)):
        for _ in range(_draw_count(site, kind, base_rate)):
            site.cut_chains(0.4, "vegetation")
            site.add(
                "vegetation",
                lot.spot.offset(_draw_between(site, *x), _draw_between(site, *y)),
                make(site.rng),
                chain="plants",
            )


def _add_border(site: Site, spot: LocalFrame, length_m: float, bare: float = 0.3) -> None:
    """Add a hedge, a fence, a wall or nothing, along x."""
    rates = site.habits.rates
    kind = pick(site.rng, {"hedge": rates["hedge"], "fence": rates["fence"], "wall": 0.8 * rates["wall"], "": 5 * bare})
    make: dict[str, Callable[..., Floats]] = {"hedge": hedge, "fence": fence, "wall": wall}
    if kind and length_m > 3.5:
        label = "vegetation" if kind == "hedge" else kind
        site.add(label, spot, make[kind](site.rng, length_m))


def _add_furniture(site: Site, lot: Lot, y: float, base_rates: dict[str, float]) -> None:
    for label, rate in base_rates.items():
        for _ in range(_draw_count(site, label, rate)):
            spot = lot.spot.offset(_draw_between(site, 0.8, lot.width_m - 0.8), y + _draw_between(site, 0, 1.5))
            site.add(label, spot, FURNITURE[label](site.rng))


def build_houses(site: Site, lot: Lot) -> None:
    """Build a house in its garden, often with a garage."""
    rng, (_, width, depth) = site.rng, lot
    front, d = _draw_between(site, 2.5, 7), _draw_between(site, 7.5, 11)
    w = min(_draw_between(site, 8, 13), width - 1.5)
    size = (w, d, _draw_between(site, 3, 7))
    is_left = rng.random() < 0.5
    x = w / 2 + 0.5 if is_left else width - w / 2 - 0.5
    site.add("building", lot.spot.offset(x, front), building(rng, size, site.spacing_m, bool(rng.random() < 0.85)))
    if rng.random() < 0.3:  # a shed or an extension
        shed = (_draw_between(site, 3, 5), _draw_between(site, 3, 5), _draw_between(site, 2.4, 3.2))
        frame = lot.spot.offset(x, front + d + float(rng.choice([0.1, 5.0])))
        site.add("building", frame, building(rng, shed, 0.28, bool(rng.random() < 0.5)))
    if width - w > 3.5 and _draw_chance(site, "garage", 0.55):
        aside = width - (width - w) / 2 + 0.8 if is_left else (width - w) / 2 - 0.8
        site.add("garage", lot.spot.offset(aside, front + _draw_between(site, 0, 5)), garage(rng, site.spacing_m * 0.8))
    _add_lawn(site, lot, (0.3, front))
    _add_lawn(site, lot, (front + d, depth), 1.25)
    gate = _draw_between(site, 0.55, 0.95) * width
    _add_border(site, lot.spot.offset(_draw_between(site, 0, width - gate), 0.2), gate)
    _add_border(site, lot.spot.offset(0, front + 2, QUARTER_TURN), depth - front - 2, 0.4)
    _add_border(site, lot.spot.offset(0, depth - 0.4), width, 0.35)
    _add_plants(site, lot, (1, width - 1), (front + d + 2, depth - 1.5), 0.9, 0.3)
    _add_plants(site, lot, (1, width - 1), (1, front - 1), 0.2, 0.3)
    _add_furniture(site, lot, 0.6, {"trash bin": 0.15, "box": 0.08, "smallpole": 0.1})


def build_row(site: Site, lot: Lot) -> None:
    """Build a house in a row, flush with the sidewalk, with a court behind."""
    rng, (_, width, depth) = site.rng, lot
    front, d = float(rng.choice([0.1, 0.1, 1.5])), min(_draw_between(site, 9, 13), depth - 2)
    size = (width - float(rng.choice([0.05, 0.05, 0.05, 3])), d, _draw_between(site, 7, 16))
    cloud = building(rng, size, site.spacing_m * 1.05, bool(rng.random() < 0.5))
    between = (np.abs(cloud[:, 0]) > size[0] / 2 - 0.1) & (np.abs(cloud[:, 1] - d / 2) < d / 2 - 0.5)
    site.add("building", lot.spot.offset(width / 2, front), cloud[~(between & (rng.random(len(cloud)) < 0.8))])
    yard = (front + d + 0.3, depth)
    if yard[1] - yard[0] > 3:
        if rng.random() < 0.45:
            _add_court(site, lot, (0, width), yard)
        else:
            _add_lawn(site, lot, yard, 1.2)
        _add_border(site, lot.spot.offset(0, yard[0], QUARTER_TURN), yard[1] - yard[0], 0.35)
        _add_border(site, lot.spot.offset(0, depth - 0.4), width, 0.35)
        if yard[1] - yard[0] > 8 and _draw_chance(site, "garage", 0.3):
            site.add("garage", lot.spot.offset(width * 0.6, yard[1] - 7), garage(rng, site.spacing_m * 0.8))
        _add_plants(site, lot, (1, width - 1), (yard[0] + 1.5, yard[1] - 1.5), 0.8, 0.3)
        _add_furniture(site, lot, yard[0], {"trash bin": 0.1})
    _add_furniture(site, lot, -0.6, {"trash bin": 0.1, "vending machine": 0.05, "box": 0.07})


def build_flats(site: Site, lot: Lot) -> None:
    """Build a slab of flats on a lawn, with parking and garages behind."""
    rng, (_, width, depth) = site.rng, lot
    front, d = _draw_between(site, 3, 8), _draw_between(site, 10, 12)
    w = width * _draw_between(site, 0.55, 0.85)
    cloud = building(rng, (w, d, _draw_between(site, 8, 14)), site.spacing_m * 1.15, pitched=False)
    site.add("building", lot.spot.offset(width / 2, front), cloud)
    _add_lawn(site, lot, (0.3, front))
    yard = (front + d + 0.5, depth)
    if yard[1] - yard[0] > 7 and rng.random() < 0.6:
        _add_court(site, lot, (0, width * 0.7), yard)
        for n in range(int(_draw_chance(site, "garage", 0.7)) * int(rng.integers(1, 4))):
            spot = lot.spot.offset(width * 0.72 + 3.2 * n, yard[0] + 0.5)
            site.add("garage", spot, garage(rng, site.spacing_m * 0.8))
    else:
        _add_lawn(site, lot, yard, 1.25)
    _add_border(site, lot.spot.offset(1, 0.3), width * 0.8, 0.6)
    _add_border(site, lot.spot.offset(0, depth - 0.4), width, 0.3)
    _add_plants(site, lot, (1, width - 1), (front + d + 2, depth - 1.5), 1.7, 0.4)
    _add_plants(site, lot, (1, width - 1), (1, front - 1), 0.6, 0.8)
    _add_furniture(site, lot, 0.8, {"trash bin": 0.4, "smallpole": 0.4, "lamp": 0.4, "box": 0.15})


def build_works(site: Site, lot: Lot) -> None:
    """Build a hall or workshop behind a yard to park in."""
    rng, (_, width, depth) = site.rng, lot
    front = _draw_between(site, 6, 13)
    size = (
        width * _draw_between(site, 0.5, 0.85),
        min(_draw_between(site, 10, 18), depth - front - 1),
        _draw_between(site, 4.5, 8),
    )
    site.add("building", lot.spot.offset(width / 2, front), building(rng, size, site.spacing_m * 1.15, pitched=False))
    site.add("building", lot.spot.offset(4, front - 4), building(rng, (6.0, 5.0, 3.2), site.spacing_m, pitched=False))
    verge = _draw_between(site, 0.8, 2.5)
    _add_lawn(site, lot, (0.2, verge))
    _add_court(site, lot, (0, width), (verge, front - 0.5))
    _add_lawn(site, lot, (front + size[1], depth), 1.25)
    gate = _draw_between(site, 0.3, 0.7) * width
    _add_border(site, lot.spot.offset(0, 0.3), gate, 0.1)
    _add_border(site, lot.spot.offset(gate + 5, 0.3), width - gate - 5, 0.2)
    _add_border(site, lot.spot.offset(0, verge, QUARTER_TURN), depth - verge, 0.1)
    _add_border(site, lot.spot.offset(0, depth - 0.4), width, 0.2)
    _add_plants(site, lot, (1, width - 1), (1, verge), 0.6, 0.6)
    _add_plants(site, lot, (1, width - 1), (front + size[1] + 1, depth - 1), 1.2, 1.0)
    _add_furniture(site, lot, verge, {"box": 0.5, "pole": 0.6, "lamp": 0.4, "smallpole": 0.6, "trash bin": 0.3})
    _add_furniture(site, lot, front - 2, {"box": 0.3, "traffic sign": 0.3, "vending machine": 0.05})


def build_farm(site: Site, lot: Lot) -> None:
    """Build a house and barns around a yard, with much green."""
    rng, (_, width, depth) = site.rng, lot
    front, w, d = _draw_between(site, 0.3, 6), min(_draw_between(site, 8, 12), width * 0.55), _draw_between(site, 8, 12)
    size = (w, d, _draw_between(site, 3.5, 6.5))
    site.add("building", lot.spot.offset(w / 2 + 0.5, front), building(rng, size, site.spacing_m, pitched=True))
    if rng.random() < 0.5:
        barn = (min(9.0, width - w - 2), _draw_between(site, 7, 10), _draw_between(site, 3.5, 6))
        frame = lot.spot.offset(width - barn[0] / 2 - 0.5, min(front + d, depth - barn[1]))
        site.add("building", frame, building(rng, barn, site.spacing_m * 1.2, pitched=True))
    elif _draw_chance(site, "garage", 0.7):
        site.add(
            "garage", lot.spot.offset(width - 4, front + _draw_between(site, 0, 6)), garage(rng, site.spacing_m * 0.8)
        )
    _add_lawn(site, lot, (0.2, front))
    _add_lawn(site, lot, (front + d, depth), 1.25)
    _add_border(site, lot.spot.offset(w + 1, 0.2), width - w - 4, 0.15)
    _add_border(site, lot.spot.offset(0, front + 1, QUARTER_TURN), depth - front - 1, 0.3)
    _add_border(site, lot.spot.offset(0, depth - 0.4), width, 0.3)
    _add_plants(site, lot, (1, width - 1), (front + d + 2, depth - 1.5), 1.1, 0.3)
    _add_plants(site, lot, (w + 1, width - 1), (1, front + 3), 0.3, 0.3)
    _add_furniture(site, lot, 0.8, {"trash bin": 0.15, "pole": 0.25, "box": 0.06})


def build_park(site: Site, lot: Lot) -> None:
    """Build grass, trees and a path."""
    rng, (_, width, depth) = site.rng, lot
    path = _draw_between(site, 0.3, 0.6) * depth
    _add_lawn(site, lot, (0.3, path), 1.1)
    _add_lawn(site, lot, (path + 2.2, depth), 1.25)
    site.add("sidewalk", lot.spot, ground(rng, (0, width), (path, path + 2.2), site.spacing_m), chain="path")
    _add_border(site, lot.spot.offset(0, 0.3), width * _draw_between(site, 0.4, 0.9), 0.3)
    _add_border(site, lot.spot.offset(0, depth - 0.4), width * 0.9, 0.3)
    _add_plants(site, lot, (1, width - 1), (1.5, depth - 1.5), 2.6, 1.2)
    _add_furniture(
        site, lot, path - 1, {"lamp": 0.8, "trash bin": 0.6, "pole": 0.3, "smallpole": 0.4, "traffic sign": 0.2}
    )
    _add_furniture(site, lot, 0.5, {"smallpole": 0.6, "box": 0.15, "lamp": 0.3})


class LotKind(NamedTuple):
    """A kind of lot: its usual width in metres, and the function that builds it."""

    width_m: tuple[float, float]
    build: Callable[[Site, Lot], None]


LOT_KINDS: dict[str, LotKind] = {
    "houses": LotKind((13, 18), build_houses),
    "row": LotKind((9, 15), build_row),
    "flats": LotKind((24, 34), build_flats),
    "works": LotKind((24, 34), build_works),
    "farm": LotKind((15, 23), build_farm),
    "park": LotKind((24, 36), build_park),
}
