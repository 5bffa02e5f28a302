"""The basic types of a map: Instance, MapShape, CityMap, Pose, Hint, Description.

Coordinates are metres in the map's frame (east, north, up) unless a name says `offset`, which is a
position inside a cell in 0..1.
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
    """One object of the map: a building, a tree, a stretch of road.

    Attributes:
        id: unique in its map.
        label: class in plain words, open vocabulary ("street lamp").
        points_m: [P, 3] float32, metres, map frame; empty for a map of lines and areas (`CityMap.pieces`).
        rgb: [3] for one colour, [P, 3] for a colour of each point, 0..1; None if unknown.
        name: for display only ("Mannerheimintie").
        source_id: the element it was read from ("way/1234").
        shape: its form ("outline") in a map of lines and areas.
    """

    id: int
    label: str
    points_m: Floats
    rgb: Floats | None = None
    name: str | None = None
    source_id: str | None = None
    shape: str | None = None


@dataclass(frozen=True, slots=True)
class MapShape:
    """An object as it is drawn.

    Attributes:
        label: its class.
        geometry: a point, lines or areas, metres, map frame.
        base_m, top_m: heights above the ground.
        width_m: of lines that stand for a strip of ground, else 0.
        name: for display.
        source_id: the element it was read from ("way/1234").
    """

    label: str
    geometry: "shapely.Geometry"
    base_m: float = 0.0
    top_m: float = 0.0
    width_m: float = 0.0
    name: str | None = None
    source_id: str | None = None


@dataclass(frozen=True, slots=True)
class CutRules:
    """The rules for cutting a map into cells (docs/formats.md, rule 4); the defaults are the released set's.

    Attributes:
        cell_size_m: edge of a cell's cube.
        grid_m: distance between the centres of neighbouring cells.
        reach_m: a centre farther than this from every location makes no cell.
        thing_share: a thing belongs to a cell if at least this share of its points is inside.
        eps_m, min_samples: parameters of DBSCAN, which splits clipped stuff into parts.
        min_part_points: smaller parts of stuff are dropped.
        min_instances: a cell with fewer is dropped.
    """

    cell_size_m: float = 30.0
    grid_m: float = 10.0
    reach_m: float = 30.0
    thing_share: float = 1 / 3
    eps_m: float = 0.75
    min_samples: int = 5
    min_part_points: int = 250
    min_instances: int = 6


@dataclass(frozen=True, slots=True, eq=False)
class CityMap:
    """A city (or a scene of one) as instances in one metric frame.

    Attributes:
        name: scene name; cells are called "<name>_<number>".
        instances: in order of id.
        frame: the metric frame and its place on Earth.
        stuff: labels without a shape of their own (roads, walls, greens): clipped to cells and split
            into connected parts. Instances of all other labels are things, kept whole.
        locations_m: [L, 3] where a person can stand: a trajectory, or points of walkable ground.
        palette: the colour words used for this map.
        rules: how to cut it; the least size of a part depends on how dense the points are.
        attribution: the text that the data's licence asks to show.
        outlines: how to draw it; None for a scan.
        pieces: its geometry, for a map of lines and areas.
    """

    name: str
    instances: Sequence[Instance]
    stuff: frozenset[str]
    locations_m: Floats
    frame: Frame = field(default_factory=Frame)
    palette: Palette = KITTI360_PALETTE
    rules: CutRules = CutRules()
    attribution: str = ""
    outlines: "Outlines | None" = None
    pieces: "PieceTable | None" = None


@dataclass(frozen=True, slots=True)
class Hint:
    """One statement about the speaker's position: "I am {direction} of a {colour} {label}".

    Attributes:
        direction: of the speaker, seen from the instance.
        label: class of the instance, in words.
        colour: colour word, None if unknown or not mentioned.
        instance_id: the instance meant, None if unknown.
    """

    direction: Direction
    label: str
    colour: str | None = None
    instance_id: int | None = None


@dataclass(frozen=True, slots=True)
class Description:
    """The hints about one position, in any number and order."""

    hints: tuple[Hint, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """A true position with a description of what is around it (ground truth, never an answer).

    Attributes:
        position_m: [3] metres, map frame.
        cell_id: the best cell: the one whose centre is nearest.
        description: hints true at this position.
        strategy: how the hints were chosen ("closest", "class", "direction").
    """

    position_m: Floats
    cell_id: str
    description: Description
    strategy: str
