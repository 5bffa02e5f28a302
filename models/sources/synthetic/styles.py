"""Synthetic towns, part 3: the differences between towns, and the greyish colours of their instances."""

from dataclasses import dataclass

import numpy as np

from models.citymap.colours import KITTI360_PALETTE
from models.citymap.types import Floats
from models.sources.kitti360.rules import CLASSES
from models.sources.synthetic.shapes import Rng

# How often a class has each centre of the palette:
# dark-green, gray, gray-green, bright-gray, gray, black, green, beige.
COLOUR_WEIGHTS: dict[str, tuple[float, ...]] = {
    "building": (3, 22, 14, 10, 18, 2, 6, 25),
    "pole": (12, 12, 24, 4, 20, 6, 18, 4),
    "traffic light": (26, 5, 20, 2, 8, 20, 19, 2),
    "traffic sign": (6, 24, 20, 12, 22, 2, 8, 8),
    "garage": (5, 24, 18, 16, 20, 2, 6, 9),
    "stop": (10, 20, 24, 4, 22, 4, 12, 4),
    "smallpole": (12, 16, 18, 14, 14, 10, 10, 6),
    "lamp": (18, 10, 24, 3, 18, 6, 18, 3),
    "trash bin": (22, 8, 18, 3, 12, 16, 18, 3),
    "vending machine": (10, 16, 18, 10, 18, 8, 10, 10),
    "box": (6, 26, 16, 10, 22, 3, 7, 10),
    "road": (1, 26, 22, 2, 40, 0, 6, 3),
    "sidewalk": (0, 36, 8, 6, 28, 0, 2, 20),
    "parking": (1, 28, 20, 4, 32, 0, 6, 9),
    "wall": (8, 24, 18, 6, 20, 3, 9, 12),
    "fence": (16, 12, 22, 4, 16, 6, 20, 4),
    "guard rail": (4, 26, 22, 8, 24, 2, 8, 6),
    "bridge": (6, 20, 20, 4, 26, 4, 12, 8),
    "tunnel": (16, 8, 20, 2, 16, 12, 20, 6),
    "vegetation": (30, 3, 18, 0, 7, 14, 28, 0),
    "terrain": (10, 12, 32, 0, 14, 2, 26, 4),
}


@dataclass(frozen=True, slots=True)
class Style:
    """A type of town. Pairs are least and greatest values, of which each town or street draws its own."""

    lots: dict[str, float]  # how often a block is of a kind (`lots.LOT_KINDS`)
    block_m: tuple[float, float]  # between streets
    road_m: tuple[float, float]  # width of the carriageway; a main street's is half as much again
    sidewalk_m: tuple[float, float]  # width
    missing: float  # share of the streets between two crossings that are left out
    bend: float  # greatest slope by which streets deviate from a straight line
    fan: bool  # true if all streets bend the same way, as around a centre
    relief_m: float  # height of its hills
    parking: float  # share of street sides with bays
    verge: float  # share of street sides with a strip of grass


STYLES: dict[str, Style] = {
    "suburb": Style(
        {"houses": 7, "flats": 1, "park": 1, "row": 0.5}, (64, 92), (5.5, 7.5), (1.5, 2.5), 0.15, 0.24, False, 5,
        0.25, 0.2,
    ),
    "grid": Style(
        {"row": 5, "flats": 2, "houses": 1, "park": 0.7, "works": 0.5}, (66, 88), (7, 10), (2.5, 4), 0.05, 0.0, False,
        2, 0.5, 0.15,
    ),
    "village": Style(
        {"farm": 5, "houses": 3, "park": 1, "row": 0.5}, (58, 96), (4.8, 6.5), (1.2, 1.8), 0.22, 0.4, False, 9,
        0.1, 0.35,
    ),
    "works": Style(
        {"works": 4, "flats": 2, "houses": 1.5, "row": 1, "park": 0.6}, (76, 104), (7.5, 10), (1.8, 3), 0.12, 0.1,
        False, 2, 0.35, 0.4,
    ),
    "ring": Style(
        {"row": 3, "houses": 3, "flats": 2, "park": 1.2, "works": 0.4}, (60, 90), (6, 9), (1.8, 3.2), 0.12, 0.18, True,
        4, 0.35, 0.25,
    ),
    "mixed": Style(
        {"houses": 3, "row": 2.5, "flats": 1.5, "farm": 1, "works": 1, "park": 1}, (60, 96), (5.5, 9), (1.5, 3.2), 0.14,
        0.32, False, 6, 0.3, 0.25,
    ),
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Habits:
    """The random parameters of one town."""

    lots: dict[str, float]  # as in the style, perturbed
    # Factor on how often an object occurs: a class of furniture, or "tree", "hedge", "fence", "wall", "garage", "bush"
    rates: dict[str, float]
    spacing_m: float  # between the points of well-scanned surfaces
    colours: Floats  # [21, 8] how often a class has each centre of the palette, in order of `CLASSES`
    exposure: float  # factor on all colours

    def rate(self, kind: str, base_rate: float) -> float:
        """Return how often an object occurs here, given its base rate."""
        return base_rate * self.rates.get(kind, 1.0)


RATED_OBJECTS = (
    *("pole", "smallpole", "lamp", "traffic sign", "trash bin", "vending machine", "box", "stop"),
    *("tree", "hedge", "fence", "wall", "garage", "bush"),
)


def draw_habits(rng: Rng, style: Style) -> Habits:
    """Draw the habits of a town of some style."""
    colours = np.array([COLOUR_WEIGHTS[rule.label] for rule in CLASSES], dtype=np.float64)
    colours *= rng.gamma(2.5, 1 / 2.5, colours.shape)
    return Habits(
        lots={kind: weight * float(rng.uniform(0.6, 1.4)) for kind, weight in style.lots.items()},
        rates={kind: float(np.exp(rng.uniform(-0.4, 0.4))) for kind in RATED_OBJECTS},
        spacing_m=float(rng.uniform(0.3, 0.36)),
        colours=colours / colours.sum(axis=1, keepdims=True),
        exposure=float(rng.uniform(0.94, 1.06)),
    )


def draw_shade(rng: Rng, habits: Habits, class_row: int) -> tuple[Floats, float]:
    """Draw the mean colour [3] (0..255) of an instance, and the standard deviation of its points' brightness."""
    center = KITTI360_PALETTE.centers[int(rng.choice(len(habits.colours[0]), p=habits.colours[class_row]))]
    mean = np.array(center) * habits.exposure + rng.normal(0, 5) + rng.normal(0, 1.8, 3)
    return np.clip(mean, 6, 249), float(min(rng.uniform(6, 26), mean.mean() / 2.5))


def speckle(rng: Rng, mean: Floats, spread: Floats) -> Floats:
    """Return the colours [P, 3] (uint8) of points, given the mean [P, 3] and the spread [P] of the instance of each."""
    light = rng.standard_normal(len(mean), dtype=np.float32) * spread
    grain = rng.standard_normal((len(mean), 3), dtype=np.float32) * 3
    return np.clip(np.rint(mean + light[:, None] + grain), 0, 255).astype(np.uint8)
