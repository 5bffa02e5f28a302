"""The basic types of a map: Instance, MapShape, CityMap, Pose, Hint, Description.

Coordinates are metres in the map's frame (east, north, up); an `offset` is a position inside a cell in 0..1.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from models.citymap.colours import KITTI360_PALETTE, Palette
from models.citymap.frame import Frame

if TYPE_CHECKING:
    import shapely

    from models.citymap.geometry.pieces import PieceTable
    from models.citymap.scenery.shapes import Outlines

Floats = npt.NDArray[np.floating[Any]]
Progress = Callable[[str, int, int], None]  # stage, done, total (0 if unknown)
Direction = Literal["north", "south", "east", "west", "on-top"]
DIRECTIONS: tuple[Direction, ...] = ("north", "south", "east", "west", "on-top")


@dataclass(frozen=True, slots=True, eq=False)
class Instance:
    """One object of the map: a building, a tree, a stretch of road."""

    id: int  # unique in its map
    label: str  # class in plain words, open vocabulary ("street lamp")
    points_m: Floats  # [P, 3] float32, metres, map frame; empty for a map of lines and areas (`CityMap.pieces`)
    rgb: Floats | None = None  # [3] for one colour, [P, 3] for a colour of each point, 0..1; None if unknown
    name: str | None = None  # for display only ("Mannerheimintie")
    source_id: str | None = None  # the element it was read from ("way/1234")
    shape: str | None = None  # its form ("outline") in a map of lines and areas


@dataclass(frozen=True, slots=True)
class MapShape:
    """An object as it is drawn."""

    label: str
    geometry: "shapely.Geometry"  # a point, lines or areas, metres, map frame
    base_m: float = 0.0  # height above the ground
    top_m: float = 0.0  # height above the ground
    width_m: float = 0.0  # of lines that stand for a strip of ground, else 0
    name: str | None = None  # for display
    source_id: str | None = None  # the element it was read from ("way/1234")


@dataclass(frozen=True, slots=True)
class CutRules:
    """The rules for cutting a map into cells (docs/formats.md, rule 4); the defaults are the released set's."""

    cell_size_m: float = 30.0  # edge of a cell's cube
    grid_m: float = 10.0  # distance between the centres of neighbouring cells
    reach_m: float = 30.0  # a centre farther than this from every location makes no cell
    thing_share: float = 1 / 3  # a thing belongs to a cell if at least this share of its points is inside
    eps_m: float = 0.75  # of DBSCAN, which splits clipped stuff into parts
    min_samples: int = 5  # of DBSCAN
    min_part_points: int = 250  # smaller parts of stuff are dropped
    min_instances: int = 6  # a cell with fewer is dropped


@dataclass(frozen=True, slots=True, eq=False)
class CityMap:
    """A city (or a scene of one) as instances in one metric frame."""

    name: str  # scene name; cells are called "<name>_<number>"
    instances: Sequence[Instance]  # in order of id
    # Labels without a shape of their own (roads, walls, greens): clipped to cells and split into connected parts.
    # Instances of all other labels are things, kept whole
    stuff: frozenset[str]
    locations_m: Floats  # [L, 3] where a person can stand: a trajectory, or points of walkable ground
    frame: Frame = field(default_factory=Frame)
    palette: Palette = KITTI360_PALETTE  # the colour words used for this map
    rules: CutRules = CutRules()
    attribution: str = ""  # the text that the data's licence asks to show
    outlines: "Outlines | None" = None  # how to draw it; None for a scan
    pieces: "PieceTable | None" = None  # its geometry, for a map of lines and areas


@dataclass(frozen=True, slots=True)
class Hint:
    """One statement about the speaker's position: "I am {direction} of a {colour} {label}"."""

    direction: Direction  # of the speaker, seen from the instance
    label: str
    colour: str | None = None  # colour word, None if unknown or not mentioned
    instance_id: int | None = None  # the instance meant, None if unknown


@dataclass(frozen=True, slots=True)
class Description:
    """The hints about one position, in any number and order."""

    hints: tuple[Hint, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """A true position with a description of what is around it (ground truth, never an answer)."""

    position_m: Floats  # [3] metres, map frame
    cell_id: str  # the best cell: the one whose centre is nearest
    description: Description
    strategy: str  # how the hints were chosen ("closest", "class", "direction")
