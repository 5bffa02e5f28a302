"""Read raw KITTI-360 (docs/formats.md, raw): a scene's points from PLY tiles, as instances, and its trajectory.

A scene is read and thinned tile by tile, so that memory holds one tile and the thinned points.
"""

import gzip
import io
import re
import shutil
import tempfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np
import numpy.typing as npt
import plyfile

from models.citymap.points import first_in_voxel
from models.citymap.types import Floats, Instance
from models.errors import DataError
from models.sources.kitti360.rules import CLASSES, ClassRule
from models.sources.kitti360pose.files import short_name

TILES, POSES = "data_3d_semantics", "data_poses"
PROPERTIES = {"x": "f", "y": "f", "z": "f", "red": "u", "green": "u", "blue": "u", "semantic": "iu", "instance": "iu"}
TYPE_NAMES = {"f": "float", "u": "uchar", "iu": "int"}
HEADER_BYTES = 1 << 16
MAX_COORDINATE_M = 1e7  # UTM coordinates are below 1e7 m
POSE_COLUMNS = 13  # frame and a 3x4 matrix, row by row


@dataclass(frozen=True, slots=True, eq=False)
class RawScene:
    """A scene as instances in one frame, thinned by class."""

    name: str  # "0003" for the folder "2013_05_28_drive_0003_sync"; any other folder's name as it is
    instances: tuple[Instance, ...]  # in the order of the tiles; `points_m` float32 [P, 3], `rgb` float32 [P, 3]
    stuff: frozenset[str]  # labels that are clipped to cells
    trajectory_m: Floats  # [F, 3] float64, world metres, in order of frame


@dataclass(frozen=True, slots=True, eq=False)
class Tile:
    """The points of one PLY file: [P, 3] float32 metres, [P, 3] uint8 colours, [P] class and instance numbers."""

    xyz: Floats
    rgb: npt.NDArray[np.uint8]
    semantic: npt.NDArray[np.int64]
    instance: npt.NDArray[np.int64]


@dataclass(slots=True, eq=False)
class _PartialInstance:
    """An instance while its tiles are read."""

    rule: ClassRule
    xyz: Floats
    rgb: npt.NDArray[np.uint8]


def list_raw_scenes(root: Path) -> tuple[str, ...]:
    """Return the names of the scenes' folders of a raw data set, in order; raise DataError if there is none."""
    scenes = tuple(sorted(_scene_folders(root)))
    if not scenes:
        raise DataError(f"{root / TILES}: no scene; the raw layout is {TILES}/<scene>/static/*.ply")
    return scenes


def load_raw_scene(
    root: Path,
    scene: str,
    classes: tuple[ClassRule, ...] = CLASSES,
    step: Callable[[int], None] = lambda size: None,
) -> RawScene:
    """Read a scene's tiles and trajectory, and keep the points of some classes.

    The scene is the name of its folder, or the drive's digits ("0003"); `step` gets the bytes of each tile that was
    read. Raise DataError if there is no such scene, no instance in it, or a file that cannot be read.
    """
    folder = scene_folder(root, scene)
    grown: dict[int, _PartialInstance] = {}
    for path in tile_paths(folder):
        _merge(grown, read_tile(path), classes)
        step(path.stat().st_size)
    instances = tuple(
        Instance(number, g.rule.label, g.xyz, g.rgb.astype(np.float32) / np.float32(255))
        for number, g in grown.items()
        if len(g.xyz) >= g.rule.min_points
    )
    if not instances:
        raise DataError(f"{folder / 'static'}: field 'semantic': no instance of a known class has enough points")
    stuff = frozenset(rule.label for rule in classes if rule.is_stuff)
    trajectory = read_trajectory(root / POSES / folder.name / "poses.txt")
    return RawScene(short_name(folder.name), instances, stuff, trajectory)


def _scene_folders(root: Path) -> dict[str, Path]:
    """Return the folder of each scene's tiles; downloads have them in train/ and test/, older ones at the top."""
    folders = [path.parent for pattern in ("*/static", "*/*/static") for path in (root / TILES).glob(pattern)]
    return {path.name: path for path in folders if (path / "static").is_dir()}


def scene_folder(root: Path, scene: str) -> Path:
    """Return the folder of a scene's tiles, given its name or the drive's digits; raise DataError if there is none."""
    for name, folder in sorted(_scene_folders(root).items()):
        if scene in (name, short_name(name)):
            return folder
    raise DataError(f"{root / TILES}: no scene '{scene}'; there are: {', '.join(list_raw_scenes(root))}")


def tile_paths(folder: Path) -> list[Path]:
    """Return the tiles of a scene's folder in order; a gzipped one is used if the plain one is missing."""
    static = folder / "static"
    by_name = {path.name.removesuffix(".gz"): path for ending in ("*.ply.gz", "*.ply") for path in static.glob(ending)}
    if not by_name:
        raise DataError(f"{static}: no tiles; expected *.ply")
    return [by_name[name] for name in sorted(by_name)]


def _merge(grown: dict[int, _PartialInstance], tile: Tile, classes: tuple[ClassRule, ...]) -> None:
    """Add a tile's points to their instances, and thin these."""
    for rule in classes:
        of_class = np.flatnonzero(tile.semantic == rule.semantic)
        rows = of_class[np.argsort(tile.instance[of_class], kind="stable")]
        numbers, starts, counts = np.unique(tile.instance[rows], return_index=True, return_counts=True)
        for number, start, count in zip(numbers.tolist(), starts, counts, strict=True):
            members = rows[start : start + count]
            xyz, rgb = tile.xyz[members], tile.rgb[members]
            if number in grown:
                xyz = np.concatenate([grown[number].xyz, xyz])
                rgb = np.concatenate([grown[number].rgb, rgb])
            merged = grown.setdefault(number, _PartialInstance(rule, xyz, rgb))
            rows_left = slice(None) if merged.rule.voxel_m is None else first_in_voxel(xyz, merged.rule.voxel_m)
            merged.xyz, merged.rgb = xyz[rows_left], rgb[rows_left]


def read_tile(path: Path) -> Tile:
    """Read the points of one binary PLY file, plain or gzipped; raise DataError with file and field if it is broken."""
    try:
        with _open_mappable(path) as stream:
            _check_header(path, stream)
            vertex = plyfile.PlyData.read(stream)["vertex"].data
            xyz = np.column_stack([vertex[axis] for axis in "xyz"]).astype(np.float32)
            rgb = np.column_stack([vertex[channel] for channel in ("red", "green", "blue")])
            semantic, instance = (vertex[name].astype(np.int64) for name in ("semantic", "instance"))
    except (plyfile.PlyParseError, UnicodeDecodeError) as error:
        raise DataError(f"{path}: field '{_failed_element(error)}': {error}") from error
    except (OSError, EOFError, zlib.error, ValueError, OverflowError, MemoryError) as error:
        raise DataError(f"{path}: cannot be read as PLY: {error}") from error
    bad = ~(np.abs(xyz) <= MAX_COORDINATE_M)
    if bad.any():
        row, axis = np.argwhere(bad)[0]
        raise DataError(f"{path}: field '{'xyz'[axis]}' of vertex {row} is {xyz[row, axis]}, not a position in metres")
    return Tile(xyz, rgb, semantic, instance)


@contextmanager
def _open_mappable(path: Path) -> Iterator[IO[bytes]]:
    """Yield a file that can be mapped into memory: the file itself, or a temporary one with the unpacked content."""
    if path.suffix != ".gz":
        with path.open("rb") as plain:
            yield plain
        return
    with gzip.open(path) as packed, tempfile.TemporaryFile() as unpacked:
        shutil.copyfileobj(packed, unpacked)
        unpacked.seek(0)
        yield unpacked


def _check_header(path: Path, stream: IO[bytes]) -> None:
    """Check by the header alone, whatever counts it claims, that the points have the right properties."""
    head = stream.read(HEADER_BYTES)
    stream.seek(0)
    end = re.search(rb"[\r\n]end_header(\r\n|\r|\n)", head)
    if end is None:
        raise DataError(f"{path}: field 'header': no 'end_header' in the first {HEADER_BYTES} bytes; not a PLY file?")
    without_counts = re.sub(rb"([\r\n]element[ \t]+\S+[ \t]+)[^\r\n]*", rb"\g<1>0", head[: end.end()])
    header = plyfile.PlyData.read(io.BytesIO(without_counts))
    if header.text:
        raise DataError(f"{path}: field 'format': ascii PLY; write it as binary_little_endian, as KITTI-360 does")
    if [element.name for element in header] != ["vertex"]:
        raise DataError(f"{path}: field 'element': expected one element 'vertex', found {[e.name for e in header]}")
    types = {p.name: None if isinstance(p, plyfile.PlyListProperty) else p.dtype() for p in header["vertex"].properties}
    if None in types.values():
        raise DataError(f"{path}: field 'property list': points have no lists")
    for name, kinds in PROPERTIES.items():
        if name not in types:
            raise DataError(f"{path}: field '{name}' is missing; it has {', '.join(types)}")
        kind = np.dtype(types[name])
        if kind.kind not in kinds or (kinds == "u" and kind.itemsize != 1):
            raise DataError(f"{path}: field '{name}' is {kind.name}, expected {TYPE_NAMES[kinds]}")


def _failed_element(error: Any) -> str:
    element = getattr(error, "element", None)
    return "header" if element is None else str(element.name)


def read_trajectory(path: Path) -> Floats:
    """Read the world positions [F, 3] (float64) of the vehicle, in order of line; raise DataError if malformed."""
    try:
        lines = path.read_text(encoding="ascii").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise DataError(f"{path}: field 'trajectory': {error}") from error
    positions = [_position(path, number, line) for number, line in enumerate(lines, start=1) if line.strip()]
    if len(positions) < 2:
        raise DataError(f"{path}: field 'pose': a trajectory has at least two lines, this has {len(positions)}")
    return np.array(positions, dtype=np.float64)


def _position(path: Path, number: int, line: str) -> list[float]:
    words = line.split()
    if len(words) != POSE_COLUMNS:
        raise DataError(
            f"{path}: field 'pose' in line {number}: {len(words)} numbers, expected a frame and a 3x4 matrix, 13 in all"
        )
    try:
        pose = [float(word) for word in words]
    except ValueError as error:
        raise DataError(f"{path}: field 'pose' in line {number}: {error}") from error
    if not all(abs(value) <= MAX_COORDINATE_M for value in pose):
        raise DataError(f"{path}: field 'pose' in line {number}: a value is not finite, or not a position in metres")
    return pose[4::4]
