"""Colour words: from rgb to the word of the nearest palette centre, and from a mapped colour to rgb."""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from PIL import ImageColor

COLOURS_PER_BLOCK: Final = 65_536  # colours that are compared with all centres at once, to bound memory


@dataclass(frozen=True, slots=True)
class Palette:
    """Colour words and the rgb centres (0..255) that they stand for; a word may have several centres."""

    name: str
    words: tuple[str, ...]
    centers: tuple[tuple[float, float, float], ...]

    def word_index(self, rgb: npt.NDArray[np.floating[Any]]) -> npt.NDArray[np.intp]:
        """Return the index [...] of the centre nearest to rgb [..., 3] in 0..1; -1 where a channel is NaN (unknown)."""
        centers, shape = np.asarray(self.centers).T / 255.0, np.shape(rgb)[:-1]
        flat = np.reshape(rgb, (-1, 3))
        nearest = np.empty(len(flat), np.intp)
        for first in range(0, len(flat), COLOURS_PER_BLOCK):
            block = slice(first, first + COLOURS_PER_BLOCK)
            squared = sum((flat[block, n, None] - centers[n]) ** 2 for n in range(3))
            nearest[block] = np.where(np.isnan(squared).any(axis=-1), -1, np.argmin(squared, axis=-1))
        return nearest.reshape(shape)

    def word(self, rgb: npt.NDArray[np.floating[Any]]) -> str | None:
        """Return the word for one colour, or None if it is unknown."""
        index = int(self.word_index(rgb))
        return None if index < 0 else self.words[index]


# docs/formats.md, rule 7. "gray" names two centres.
KITTI360_PALETTE = Palette(
    "kitti360",
    ("dark-green", "gray", "gray-green", "bright-gray", "gray", "black", "green", "beige"),
    (
        (47.26, 49.75, 42.42), (136.33, 136.95, 126.03), (87.50, 91.69, 80.15), (213.91, 216.25, 207.25),
        (110.39, 112.92, 103.69), (27.48, 28.44, 25.17), (66.66, 70.22, 60.20), (171.01, 170.06, 155.00),
    ),
)  # fmt: skip

# The basic colour terms of English, plus beige, for maps whose colours are named by people.
BASIC_PALETTE = Palette(
    "basic",
    ("black", "gray", "gray", "gray", "white", "red", "red", "brown", "brown", "brown", "beige", "beige",
     "orange", "yellow", "green", "green", "blue", "blue", "purple", "pink"),
    (
        (20, 20, 20), (75, 75, 75), (128, 128, 128), (190, 190, 190), (252, 252, 252), (225, 25, 25), (150, 5, 20),
        (165, 42, 42), (150, 90, 50), (95, 60, 35), (225, 212, 180), (245, 245, 220), (245, 150, 25),
        (240, 220, 50), (45, 140, 55), (170, 200, 130), (45, 85, 200), (130, 185, 230), (130, 40, 145), (250, 175, 195),
    ),
)  # fmt: skip

PALETTES = {palette.name: palette for palette in (KITTI360_PALETTE, BASIC_PALETTE)}

# What the materials of OpenStreetMap's material, building:material and surface tags look like.
MATERIAL_RGB: dict[str, tuple[int, int, int]] = {
    "asphalt": (75, 75, 75),
    "concrete": (160, 160, 155),
    "concrete:plates": (160, 160, 155),
    "paving_stones": (170, 168, 162),
    "sett": (115, 112, 108),
    "cobblestone": (115, 112, 108),
    "unhewn_cobblestone": (115, 112, 108),
    "gravel": (150, 145, 135),
    "fine_gravel": (205, 190, 160),
    "compacted": (200, 185, 155),
    "sand": (225, 205, 160),
    "ground": (120, 90, 60),
    "dirt": (120, 90, 60),
    "earth": (120, 90, 60),
    "wood": (140, 95, 55),
    "brick": (150, 70, 55),
    "grass": (80, 140, 70),
    "stone": (150, 148, 140),
    "granite": (140, 138, 136),
    "metal": (140, 142, 145),
    "steel": (140, 142, 145),
    "gold": (212, 175, 55),
    "tartan": (170, 65, 50),
}


def parse_colour(text: str) -> tuple[float, float, float] | None:
    """Return the rgb (0..1) of a mapped colour ("#cd7f32", "light_grey", "white;red"), or None if it is unusable."""
    first = text.split(";", maxsplit=1)[0].strip().lower().replace("_", "").replace(" ", "")
    try:
        red, green, blue = ImageColor.getrgb(first)[:3]
    except ValueError:
        return None
    return red / 255, green / 255, blue / 255


def material_colour(material: str) -> tuple[float, float, float] | None:
    """Return the rgb (0..1) that a material usually has, or None for one without a usual colour (glass, plaster)."""
    rgb = MATERIAL_RGB.get(material.split(";", maxsplit=1)[0].strip())
    return None if rgb is None else (rgb[0] / 255, rgb[1] / 255, rgb[2] / 255)
