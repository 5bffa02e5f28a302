"""Synthetic towns, part 2: the objects in them, each as points around its foot and drawn anew for every instance."""

from collections.abc import Callable

import numpy as np

from models.citymap.types import Floats
from models.sources.synthetic.shapes import Rng, blob, box, column, gable, patch, shift, subsample

STOREY_M = 3.1  # height of a storey


def building(rng: Rng, size: tuple[float, float, float], spacing_m: float, pitched: bool) -> Floats:
    """Return the points [P, 3] of a building: a street side with windows left out, and sparser other sides and roof."""
    w, d, h = size
    spacing_m *= 0.93
    walls = box(rng, size, spacing_m, hidden=float(rng.uniform(1.5, 2.2)))
    bay_m, open_m, sill_m = rng.uniform(2, 4), rng.uniform(0.5, 1.5), rng.uniform(0.6, 1.2)
    is_front = walls[:, 1] < 0.2
    in_bay = (walls[:, 0] + w / 2) % bay_m < open_m
    in_storey = np.abs(walls[:, 2] % STOREY_M - sill_m - 0.7) < 0.7
    parts = [walls[~(is_front & in_bay & in_storey)]]
    if pitched:
        parts.append(gable(rng, size, d * float(rng.uniform(0.25, 0.5)), spacing_m * 1.7))
    if rng.random() < 0.3:  # a porch, an oriel or a dormer
        porch = box(rng, (w * float(rng.uniform(0.15, 0.3)), 1.2, min(h, 3.0)), spacing_m)
        parts.append(shift(porch, w * float(rng.uniform(-0.3, 0.3)), -1.2))
    return subsample(rng, np.concatenate(parts), float(rng.uniform(0.75, 1)))


def garage(rng: Rng, spacing_m: float) -> Floats:
    """Return the points [P, 3] of a garage for one or two cars, or a shed."""
    size = (float(rng.uniform(2.8, 6.2)), float(rng.uniform(4.5, 7)), float(rng.uniform(2.2, 3)))
    parts = [box(rng, size, spacing_m, hidden=1.6)]
    if rng.random() < 0.3:
        parts.append(gable(rng, size, float(rng.uniform(0.6, 1.5)), spacing_m * 1.5))
    return np.concatenate(parts)


def tree(rng: Rng, size: float = 1.0) -> Floats:
    """Return the points [P, 3] of a tree: round, tall or conical, some with a trunk to be seen."""
    height, radius = size * rng.uniform(3.5, 9), size * rng.uniform(1.2, 2.6)
    bare = float(rng.uniform(0.1, 0.4)) * height
    density = rng.uniform(8, 15)
    parts = [column(rng, int(15 * bare), float(rng.uniform(0.1, 0.3)), (0, bare + 0.5))]
    crowns = int(rng.integers(1, 4))
    for n in range(crowns):
        narrow = 1 - 0.5 * n / crowns if rng.random() < 0.5 else 1
        radii = np.array([radius * narrow, radius * narrow, max(1.0, (height - bare) / 2 / crowns * 1.2)])
        center = [*rng.uniform(-0.3, 0.3, 2) * radius, bare + (height - bare) * (n + 0.5) / crowns]
        parts.append(blob(rng, int(density * 4.19 * radii.prod()), center, radii))
    return np.concatenate(parts)


def bush(rng: Rng) -> Floats:
    """Return the points [P, 3] of a bush, dense enough to count by itself."""
    radii = rng.uniform(0.7, 1.9, 3) * (1, 1, 0.7)
    return blob(rng, max(290, int(rng.uniform(15, 32) * 4.19 * radii.prod())), (0, 0, radii[2]), radii)


def hedge(rng: Rng, length_m: float) -> Floats:
    """Return the points [P, 3] of a hedge along x, from 0."""
    size = (length_m, float(rng.uniform(0.6, 1.4)), float(rng.uniform(0.9, 2.2)))
    body = shift(box(rng, size, float(rng.uniform(0.22, 0.3)), hidden=1.3), length_m / 2)
    return body + rng.normal(0, 0.12, body.shape) * (1, 1, 0.5)


def fence(rng: Rng, length_m: float) -> Floats:
    """Return the points [P, 3] of a fence along x: mesh, boards or rails with posts."""
    height, spacing = float(rng.uniform(0.9, 2)), float(rng.uniform(0.13, 0.19))
    mesh = patch(rng, (0, 0, 0.05), (length_m, 0, 0), (0, 0, height), spacing)
    kind = rng.random()
    if kind < 0.35:  # boards
        mesh = mesh[mesh[:, 0] % 0.4 < 0.28]
    elif kind < 0.6:  # rails and posts
        mesh = mesh[(np.abs(mesh[:, 2] % 0.5 - 0.25) < 0.16) | (mesh[:, 0] % 2.5 < 0.25)]
    return mesh


def wall(rng: Rng, length_m: float) -> Floats:
    """Return the points [P, 3] of a garden or retaining wall along x."""
    height, thick, spacing = float(rng.uniform(0.6, 2.5)), float(rng.uniform(0.15, 0.45)), float(rng.uniform(0.14, 0.2))
    face = patch(rng, (0, 0, 0), (length_m, 0, 0), (0, 0, height), spacing)
    top = patch(rng, (0, 0, height), (length_m, 0, 0), (0, thick, 0), spacing)
    return np.concatenate([face, top])


def guard_rail(rng: Rng, length_m: float) -> Floats:
    """Return the points [P, 3] of a guard rail along x."""
    height = float(rng.uniform(0.55, 0.85))
    band = patch(rng, (0, 0, height - 0.35), (length_m, 0, 0), (0, 0, 0.4), 0.13)
    posts = patch(rng, (0, 0.1, 0), (length_m, 0, 0), (0, 0, height), 0.14)
    return np.concatenate([band, posts[posts[:, 0] % 2.0 < 0.2]])


def bridge(rng: Rng, span_m: float) -> Floats:
    """Return the points [P, 3] of a deck over the street, its span along y and centred, with parapets."""
    width, clear, deep = float(rng.uniform(3.5, 9)), float(rng.uniform(4.6, 6)), float(rng.uniform(0.6, 1.3))
    body = shift(box(rng, (width, span_m, deep), 0.3, z=clear), y=-span_m / 2)
    under = patch(rng, (-width / 2, -span_m / 2, clear), (width, 0, 0), (0, span_m, 0), 0.3)
    rails = [
        patch(rng, (x, -span_m / 2, clear + deep), (0, span_m, 0), (0, 0, 1.1), 0.28) for x in (-width / 2, width / 2)
    ]
    feet = [shift(box(rng, (width, 0.8, clear), 0.3), y=side * (span_m / 2 - 0.5) - 0.4) for side in (-1, 1)]
    return np.concatenate([body, under, *rails, *feet])


def tunnel(rng: Rng, length_m: float, width_m: float) -> Floats:
    """Return the points [P, 3] of the two walls and the ceiling of a stretch of tunnel along x."""
    clear, half = float(rng.uniform(4.6, 6)), width_m / 2
    sides = [patch(rng, (0, y, 0), (length_m, 0, 0), (0, 0, clear), 0.3) for y in (-half, half)]
    faces = [patch(rng, (x, -half, clear), (0, width_m, 0), (0, 0, 1.5), 0.3) for x in (0, length_m)]
    return np.concatenate([*sides, *faces, patch(rng, (0, -half, clear), (length_m, 0, 0), (0, width_m, 0), 0.32)])


def pole(rng: Rng) -> Floats:
    """Return the points [P, 3] of a mast or post, as high as a house or as a sign."""
    height = float(rng.uniform(2.2, 4) if rng.random() < 0.5 else rng.uniform(4, 10))
    return column(rng, int(rng.uniform(12, 40) * height), float(rng.uniform(0.04, 0.2)), (0, height))


def smallpole(rng: Rng) -> Floats:
    """Return the points [P, 3] of a bollard or marker post."""
    return column(rng, int(rng.uniform(35, 130)), float(rng.uniform(0.04, 0.13)), (0, float(rng.uniform(0.6, 1.3))))


def lamp(rng: Rng) -> Floats:
    """Return the points [P, 3] of a street lamp: a post, often an arm, and a head."""
    height, arm = float(rng.uniform(3.2, 9)), float(rng.choice([0.0, rng.uniform(0.5, 2.5)]))
    post = column(rng, int(rng.uniform(10, 22) * height), float(rng.uniform(0.05, 0.12)), (0, height))
    beam = patch(rng, (0, 0, height), (0, -arm, 0.2), (0.08, 0, 0), 0.08) if arm else post[:0]
    head = blob(rng, int(rng.uniform(25, 90)), (0, -arm, height), (0.3, 0.45, 0.15 + 0.2 * (not arm)))
    return np.concatenate([post, beam, head])


def traffic_sign(rng: Rng) -> Floats:
    """Return the points [P, 3] of one to three plates, round, triangular or square, at head height or above."""
    plates, z = [], float(rng.uniform(1.8, 2.8))
    for _ in range(int(rng.choice([1, 1, 1, 2, 2, 3]))):
        w, h = float(rng.uniform(0.4, 0.9)), float(rng.uniform(0.35, 0.9))
        if rng.random() < 0.1:
            w, h = w * 2.2, h * 1.6  # a board with names of places
        plate = patch(rng, (-w / 2, -0.08, z), (w, 0, 0), (0, 0, h), float(rng.uniform(0.04, 0.075)))
        x, up = plate[:, 0] / w, (plate[:, 2] - z) / h
        form = rng.random()
        if form < 0.3:
            plate = plate[x**2 + (up - 0.5) ** 2 < 0.26]
        elif form < 0.5:
            plate = plate[np.abs(x) < 0.55 * (1 - up) + 0.05]
        plates.append(plate)
        z += h + 0.05
    return np.concatenate(plates)


def traffic_light(rng: Rng) -> Floats:
    """Return the points [P, 3] of a head of lights on its post, sometimes with a second head out over the road."""
    z, spacing = float(rng.uniform(2.1, 3)), float(rng.uniform(0.07, 0.11))
    parts = [box(rng, (0.3, 0.3, float(rng.uniform(0.7, 1.1))), spacing, z=z)]
    if rng.random() < 0.4:
        parts.append(shift(box(rng, (0.3, 0.3, 0.9), spacing, z=5.0), y=-float(rng.uniform(1.5, 4))))
    if rng.random() < 0.6:
        parts.append(column(rng, int(rng.uniform(30, 90)), 0.07, (0, z)))
    return np.concatenate(parts)


def trash_bin(rng: Rng) -> Floats:
    """Return the points [P, 3] of a bin: round, a wheeled one, or several in a row."""
    if rng.random() < 0.4:
        return column(
            rng, int(rng.uniform(80, 250)), float(rng.uniform(0.2, 0.35)), (0.2, float(rng.uniform(0.8, 1.3)))
        )
    count, spacing = int(rng.choice([1, 1, 2, 3])), float(rng.uniform(0.09, 0.14))
    return np.concatenate([shift(box(rng, (0.6, 0.7, 1.1), spacing, hidden=1.3), 0.75 * n) for n in range(count)])


def vending_machine(rng: Rng) -> Floats:
    """Return the points [P, 3] of a machine for cigarettes on a post, or one for tickets or drinks."""
    spacing = float(rng.uniform(0.07, 0.11))
    if rng.random() < 0.5:
        return box(rng, (0.8, 0.35, 0.9), spacing, z=0.9)
    return box(rng, (float(rng.uniform(0.7, 1.2)), 0.7, float(rng.uniform(1.5, 2))), spacing, hidden=1.4)


def cabinet(rng: Rng) -> Floats:
    """Return the points [P, 3] of a box: a cabinet of a telephone or power company, or a post box."""
    size = (float(rng.uniform(0.5, 1.9)), float(rng.uniform(0.3, 0.6)), float(rng.uniform(0.7, 1.6)))
    return box(rng, size, float(rng.uniform(0.08, 0.13)), hidden=1.5)


def stop(rng: Rng) -> Floats:
    """Return the points [P, 3] of the shelter of a bus stop."""
    w, d, spacing = float(rng.uniform(2.5, 5)), float(rng.uniform(1.2, 1.8)), float(rng.uniform(0.13, 0.2))
    shell = box(rng, (w, d, float(rng.uniform(2.2, 2.7))), spacing)
    return shell[shell[:, 1] > 0.1]  # open towards the street


FURNITURE: dict[str, Callable[[Rng], Floats]] = {
    "pole": pole,
    "smallpole": smallpole,
    "lamp": lamp,
    "traffic sign": traffic_sign,
    "traffic light": traffic_light,
    "trash bin": trash_bin,
    "vending machine": vending_machine,
    "box": cabinet,
    "stop": stop,
}
