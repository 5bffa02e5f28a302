"""The rules for making KITTI360Pose from KITTI-360, in numbers (docs/formats.md, preparation rules)."""

from dataclasses import dataclass, field

from models.citymap.hints import STRATEGIES, Strategy
from models.citymap.types import CutRules


@dataclass(frozen=True, slots=True)
class ClassRule:
    """How points of one class become instances (docs/formats.md, rules 1 and 2)."""

    label: str
    semantic: int  # KITTI-360's number of it
    is_stuff: bool  # True if clipped to cells, False for things, which are kept whole
    voxel_m: float | None  # one point is kept in each cube of this edge; None keeps all
    min_points: int  # an instance with fewer is dropped


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
    """Every option of the preparation; the defaults are the released set's."""

    classes: tuple[ClassRule, ...] = CLASSES  # which points are kept, and how (rules 1 and 2)
    spacing_m: float = 10.0  # least distance between locations (rule 3)
    thing_reach_m: float = 15.0  # a location farther from every thing is left out (rule 3)
    cut: CutRules = field(default_factory=CutRules)  # how cells are cut, and the cube around a position (rule 4)
    copies: int = 4  # positions for each location (rule 5)
    shift_divisor: float = 2.1  # a position is moved by up to the cell's size over this, in x and in y (rule 5)
    best_cell_reach_m: float = 15.0  # a position farther from every cell's centre is left out (rule 5)
    strategies: tuple[Strategy, ...] = STRATEGIES  # how hints are chosen; each gives a description (rule 5)
    num_hints: int = 6  # hints in a description; a position with fewer instances in reach is left out
    hint_reach_m: float = 15.0  # instances farther away are not mentioned (rule 5)
    on_top_share: float = 0.05  # nearer than this share of a cell is "on-top" (rule 6)
