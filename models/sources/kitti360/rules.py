"""The rules for making KITTI360Pose from KITTI-360, in numbers (docs/formats.md, preparation rules)."""

from dataclasses import dataclass, field

from models.citymap.hints import STRATEGIES, Strategy
from models.citymap.types import CutRules


@dataclass(frozen=True, slots=True)
class ClassRule:
    """How points of one class become instances (docs/formats.md, rules 1 and 2).

    Attributes:
        label: class in words.
        semantic: KITTI-360's number of it.
        is_stuff: True if clipped to cells, False for things, which are kept whole.
        voxel_m: one point is kept in each cube of this edge; None keeps all.
        min_points: an instance with fewer is dropped.
    """

    label: str
    semantic: int
    is_stuff: bool
    voxel_m: float | None
    min_points: int


# In the order of instances within a tile.
CLASSES = (
    ClassRule("building", 11, is_stuff=False, voxel_m=0.25, min_points=250),
    ClassRule("pole", 17, is_stuff=False, voxel_m=None, min_points=25),
    ClassRule("traffic light", 19, is_stuff=False, voxel_m=None, min_points=25),
    ClassRule("traffic sign", 20, is_stuff=False, voxel_m=None, min_points=25),
    ClassRule("garage", 34, is_stuff=False, voxel_m=0.125, min_points=250),
    ClassRule("stop", 36, is_stuff=False, voxel_m=None, min_points=25),
    ClassRule("smallpole", 37, is_stuff=False, voxel_m=None, min_points=25),
    ClassRule("lamp", 38, is_stuff=False, voxel_m=None, min_points=25),
    ClassRule("trash bin", 39, is_stuff=False, voxel_m=None, min_points=25),
    ClassRule("vending machine", 40, is_stuff=False, voxel_m=None, min_points=25),
    ClassRule("box", 41, is_stuff=False, voxel_m=None, min_points=25),
    ClassRule("road", 7, is_stuff=True, voxel_m=0.25, min_points=1000),
    ClassRule("sidewalk", 8, is_stuff=True, voxel_m=0.25, min_points=1000),
    ClassRule("parking", 9, is_stuff=True, voxel_m=0.25, min_points=1000),
    ClassRule("wall", 12, is_stuff=True, voxel_m=0.125, min_points=250),
    ClassRule("fence", 13, is_stuff=True, voxel_m=0.125, min_points=250),
    ClassRule("guard rail", 14, is_stuff=True, voxel_m=0.125, min_points=250),
    ClassRule("bridge", 15, is_stuff=True, voxel_m=0.25, min_points=1000),
    ClassRule("tunnel", 16, is_stuff=True, voxel_m=0.25, min_points=1000),
    ClassRule("vegetation", 21, is_stuff=True, voxel_m=0.25, min_points=250),
    ClassRule("terrain", 22, is_stuff=True, voxel_m=0.25, min_points=250),
)
# KITTI-360 numbers all ground of a class in a scene 0, so that it is one instance.
GROUND = frozenset({"road", "sidewalk", "parking", "terrain"})


@dataclass(frozen=True, slots=True)
class PrepareConfig:
    """Every option of the preparation; the defaults are the released set's.

    Attributes:
        classes: which points are kept, and how (rules 1 and 2).
        spacing_m: least distance between locations (rule 3).
        thing_reach_m: a location farther from every thing is left out (rule 3).
        cut: how cells are cut, and the cube around a position (rule 4).
        copies: positions for each location (rule 5).
        shift_divisor: a position is moved by up to the cell's size over this, in x and in y (rule 5).
        best_cell_reach_m: a position farther from every cell's centre is left out (rule 5).
        strategies: how hints are chosen; each gives a description (rule 5).
        num_hints: hints in a description; a position with fewer instances in reach is left out.
        hint_reach_m: instances farther away are not mentioned (rule 5).
        on_top_share: nearer than this share of a cell is "on-top" (rule 6).
    """

    classes: tuple[ClassRule, ...] = CLASSES
    spacing_m: float = 10.0
    thing_reach_m: float = 15.0
    cut: CutRules = field(default_factory=CutRules)
    copies: int = 4
    shift_divisor: float = 2.1
    best_cell_reach_m: float = 15.0
    strategies: tuple[Strategy, ...] = STRATEGIES
    num_hints: int = 6
    hint_reach_m: float = 15.0
    on_top_share: float = 0.05
