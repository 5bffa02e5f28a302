"""Raw KITTI-360 for tests: a made-up street, in memory and on disk."""

from pathlib import Path

import numpy as np
import plyfile

from models.citymap.types import Instance
from models.sources.kitti360.raw import RawScene
from models.sources.kitti360.rules import CLASSES

FOLDER = "2013_05_28_drive_0042_sync"
TRAIN_STREETS = ("2013_05_28_drive_0000_sync", "2013_05_28_drive_0002_sync")
TEST_STREET, VAL_STREET = "2013_05_28_drive_0003_sync", "2013_05_28_drive_0010_sync"
STUFF = frozenset(rule.label for rule in CLASSES if rule.is_stuff)
VERTEX = [(axis, "f4") for axis in "xyz"] + [(c, "u1") for c in ("red", "green", "blue")]
VERTEX += [("semantic", "i4"), ("instance", "i4"), ("visible", "u1"), ("confidence", "f4")]


def write_ply(path: Path, vertex: np.ndarray, **how: object) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    plyfile.PlyData([plyfile.PlyElement.describe(vertex, "vertex")], **({"byte_order": "<"} | how)).write(str(path))
    return path


def write_trajectory(root: Path, positions: np.ndarray, folder: str = FOLDER) -> Path:
    path = root / "data_poses" / folder / "poses.txt"
    path.parent.mkdir(parents=True, exist_ok=True)
    rows = [[n, 1, 0, 0, p[0], 0, 1, 0, p[1], 0, 0, 1, p[2]] for n, p in enumerate(positions)]
    path.write_text("".join(" ".join(f"{value:.6f}" for value in row) + "\n" for row in rows))
    return path


def town(seed: int) -> RawScene:
    """A street of 64 m with a bend: road, two fences in pieces and a hedge (stuff), houses and street furniture.

    West of it there is little; the ground rises towards the east.
    """
    rng = np.random.default_rng(seed)

    def blob(count: int, center: tuple[float, float, float], size: tuple[float, float, float]):
        return (rng.uniform(-0.5, 0.5, (count, 3)) * size + np.array(center)).astype(np.float32)

    pieces = [blob(400, (x, y, 1), (5, 0.3, 1.6)) for x in range(0, 64, 8) for y in (-7, 9)]
    clouds = [("building", blob(500, (x, y, 3), (8, 6, 6))) for x in range(4, 64, 15) for y in (-14, 16)]
    clouds += [
        ("pole", blob(60, (-28, 3, 1), (0.5, 0.5, 2))),
        ("fence", np.concatenate(pieces[0::2])),
        ("road", blob(9000, (32, 0, 0), (76, 8, 0.1))),
    ]
    clouds += [
        (("pole", "lamp", "trash bin", "box")[n % 4], blob(60, (x, (-5, 6)[n % 2], 1), (0.5, 0.5, 2)))
        for n, x in enumerate(rng.uniform(0, 64, 14))
    ]
    clouds += [("fence", np.concatenate(pieces[1::2])), ("vegetation", blob(5000, (40, 3, 1), (50, 2.5, 2)))]
    clouds += [("traffic light", blob(60, (x, 8, 14), (0.5, 0.5, 1))) for x in range(5, 64, 12)]  # high above
    numbers = rng.permutation(len(clouds)) + 100
    shades = rng.uniform(0, 1, (len(clouds), 3))
    instances = tuple(
        Instance(int(number), label, xyz, np.clip(shade + rng.normal(0, 0.1, xyz.shape), 0, 1).astype(np.float32))
        for number, shade, (label, xyz) in zip(numbers, shades, clouds, strict=True)
    )
    t = np.arange(-30.5, 64, 0.9)
    path = np.column_stack([t, np.where(t < 40, -0.4, (t - 40) / 2 - 0.4), 1 + t / 50])
    return RawScene("town", instances, STUFF, path)


def write_town(root: Path, folder: str, seed: int = 0) -> None:
    """`town` as a scene of the raw layout, in two tiles."""
    raw, rng = town(seed), np.random.default_rng(seed)
    semantic = {rule.label: rule.semantic for rule in CLASSES}
    vertex = np.zeros(sum(len(instance.points_m) for instance in raw.instances), dtype=VERTEX)
    for names, values in (
        ("xyz", np.concatenate([i.points_m for i in raw.instances])),
        (("red", "green", "blue"), np.concatenate([i.rgb for i in raw.instances]) * 255),
    ):
        for name, column in zip(names, values.T, strict=True):
            vertex[name] = column
    counts = [len(i.points_m) for i in raw.instances]
    vertex["semantic"] = np.repeat([semantic[i.label] for i in raw.instances], counts)
    vertex["instance"] = np.repeat([i.id for i in raw.instances], counts)
    for n, tile in enumerate(np.array_split(rng.permutation(vertex), 2)):
        write_ply(root / "data_3d_semantics" / folder / "static" / f"{n:010d}.ply", tile)
    write_trajectory(root, raw.trajectory_m, folder)


def write_towns(root: Path, *folders: str) -> None:
    """Towns of their own, which lie over each other."""
    for seed, folder in enumerate(folders):
        write_town(root, folder, seed)
