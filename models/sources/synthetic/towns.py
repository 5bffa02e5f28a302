"""Synthetic towns in KITTI-360's raw format; nothing in them was scanned.

They stand in for KITTI-360, which cannot be redistributed, with its classes, greyish colours and point densities, so
that they pass through the same preparation (docs/formats.md) and give similar cells. They have the names of its drives,
so that the standard split works. Every number drawn comes from the seed: one seed, one set of files.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import plyfile

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.errors import DataError
from models.files import new_directory
from models.sources.kitti360.raw import POSES, TILES
from models.sources.kitti360pose.files import STANDARD_SPLITS
from models.sources.synthetic.drive import draw_drive
from models.sources.synthetic.layout import draw_land, draw_plan
from models.sources.synthetic.lots import build_blocks
from models.sources.synthetic.site import Scan, Site
from models.sources.synthetic.streets import build_streets
from models.sources.synthetic.styles import STYLES, Style, draw_habits

# Cells of each town, in order of STANDARD_SPLITS; "full" is KITTI360Pose's size: 11,259 / 1,434 / 4,308.
SIZES: dict[str, dict[str, tuple[int, ...]]] = {
    "demo": {"train": (540, 330, 450, 270, 410), "val": (450,), "test": (520, 340, 440)},
    "full": {"train": (3050, 1750, 2650, 1450, 2359), "val": (1434,), "test": (1750, 1050, 1508)},
}
SCALES = tuple(SIZES)
PIECES = ("official", "own")  # ground is one instance of its class, as in KITTI-360, or one for each piece
# The style of each town, in the same order; each town also draws its own streets, habits and colours.
TOWN_STYLES = {
    "train": ("suburb", "grid", "mixed", "village", "ring"),
    "val": ("mixed",),
    "test": ("ring", "village", "mixed"),
}
KEPT_CELL_SHARE = 0.985  # share of the cells around a drive that hold enough instances
TILE_POSES = 250  # poses of the drive in each tile
POINT = [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("red", "u1"), ("green", "u1"), ("blue", "u1")]
POINT += [("semantic", "<i4"), ("instance", "<i4"), ("visible", "u1"), ("confidence", "<f4")]


@dataclass(frozen=True, slots=True, eq=False)
class Town:
    """A synthetic town as it would have been scanned."""

    scan: Scan
    drive_m: Floats  # [F, 3] float64 poses about a metre apart, world metres


def write_towns(
    out: Path,
    scale: str,
    seed: int,
    progress: Callable[[int, int], None] | None = None,
    pieces: str = PIECES[0],
) -> tuple[str, ...]:
    """Make the towns of one of SCALES and write them as KITTI-360's raw files; return the scenes' folders.

    The same seed gives the same bytes, and the same points with each of PIECES. `progress` gets (towns written, towns
    to write). Raise DataError, and leave nothing, if an argument is wrong, or the folder is not empty or cannot be
    written.
    """
    if scale not in SIZES:
        raise DataError(f"scale '{scale}' is unknown; choose from: {', '.join(SCALES)}")
    if pieces not in PIECES:
        raise DataError(f"pieces '{pieces}' are unknown; choose from: {', '.join(PIECES)}")
    if seed < 0:
        raise DataError(f"seed {seed} is negative; take 0 or more")
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise DataError(f"{out}: is not an empty folder; name a new one, or empty it")
    towns = [
        (f"2013_05_28_drive_{drive}_sync", STYLES[style], cells)
        for split, drives in STANDARD_SPLITS.items()
        for drive, style, cells in zip(drives, TOWN_STYLES[split], SIZES[scale][split], strict=True)
    ]
    seeds = np.random.SeedSequence(seed).spawn(len(towns))
    try:
        with new_directory(out.absolute()) as root:
            for n, ((scene, style, cells), of_town) in enumerate(zip(towns, seeds, strict=True), start=1):
                write_town(root, scene, build_town(np.random.default_rng(of_town), style, cells, pieces == "own"))
                if progress:
                    progress(n, len(towns))
    except OSError as error:
        raise DataError(f"{out}: cannot be written: {error.strerror or error}") from error
    return tuple(scene for scene, _, _ in towns)


def build_town(rng: np.random.Generator, style: Style, cells: float, own_pieces: bool = False) -> Town:
    """Make one town with about some number of cells; see `Site.scan` for `own_pieces`."""
    plan, land, habits = draw_plan(rng, style, cells), draw_land(rng, style), draw_habits(rng, style)
    drive = land.to_world(draw_drive(rng, plan, land, cells / KEPT_CELL_SHARE))
    site = Site(rng, habits, land, drive)
    build_streets(site, plan)
    build_blocks(site, plan)
    return Town(site.scan(own_pieces), drive)


def write_town(root: Path, scene: str, town: Town) -> None:
    """Write one town as a scene of the raw layout; each tile holds the points nearest to a part of the drive."""
    tiles, poses = root / TILES / scene / "static", root / POSES / scene
    tiles.mkdir(parents=True)
    poses.mkdir(parents=True)
    tile = town.scan.pose // TILE_POSES
    order = np.argsort(tile, kind="stable")
    numbers, starts = np.unique(tile[order], return_index=True)
    for number, rows in zip(numbers.tolist(), np.split(order, starts[1:]), strict=True):
        first = number * TILE_POSES
        _write_tile(tiles / f"{first:010d}_{first + TILE_POSES - 1:010d}.ply", town.scan, rows)
    lines = [f"{n} " + " ".join(f"{value:.6f}" for value in row) for n, row in enumerate(_matrices(town.drive_m))]
    (poses / "poses.txt").write_text("\n".join(lines) + "\n", encoding="ascii")


def _write_tile(path: Path, scan: Scan, rows: Ints) -> None:
    vertex = np.zeros(len(rows), dtype=POINT)
    for axis, (place, colour) in enumerate(zip("xyz", ("red", "green", "blue"), strict=True)):
        vertex[place], vertex[colour] = scan.xyz[rows, axis], scan.rgb[rows, axis]
    vertex["semantic"], vertex["instance"] = scan.semantic[rows], scan.instance[rows]
    vertex["visible"], vertex["confidence"] = 1, 1.0
    plyfile.PlyData([plyfile.PlyElement.describe(vertex, "vertex")], byte_order="<").write(path)


def _matrices(drive_m: Floats) -> Floats:
    """Return the poses [F, 12]: a rotation by the heading and the position, row by row."""
    ahead = np.gradient(drive_m[:, :2], axis=0)
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    rows = np.zeros((len(drive_m), 3, 4))
    rows[:, 0, 0], rows[:, 0, 1] = ahead[:, 0], -ahead[:, 1]
    rows[:, 1, 0], rows[:, 1, 1] = ahead[:, 1], ahead[:, 0]
    rows[:, 2, 2] = 1
    rows[:, :, 3] = drive_m
    return rows.reshape(-1, 12)
