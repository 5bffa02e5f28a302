"""Shared by the tests of data sets: published records made by hand or at random."""

import io
import pickle
import sys
import types
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
import pytest

from models.citymap.types import DIRECTIONS
from models.sources.kitti360 import job as kitti360_job
from models.sources.kitti360.job import prepare_data
from models.sources.kitti360.rules import PrepareConfig
from models.sources.kitti360pose.files import save_scene
from models.sources.kitti360pose.pickle_values import RECORD_CLASSES, RECORD_MODULE, PickledRecord
from models.sources.kitti360pose.pickle_writer import write_records
from models.sources.kitti360pose.records import PublishedCell, PublishedHint, PublishedObject, PublishedPose
from models.sources.store.pose_store import PoseStore
from tests.models.sources.published import Scene
from tests.models.sources.raw_scenes import TEST_STREET, VAL_STREET

MINI = Path(__file__).parents[4] / "shared/data/k360-mini"
needs_mini = pytest.mark.skipif(not MINI.is_dir(), reason="../shared/data/k360-mini is not on this machine")
LONG, VAL = TEST_STREET, VAL_STREET
QUICK = PrepareConfig(copies=1)
LABELS = ["building", "pole", "trash bin", "road"]
COLOURS = ["gray", "green", "beige"]


class Anything:
    """A stand-in that the oracle makes for the reference package's classes."""


def oracle(data: bytes, names: set[tuple[str, str]] | None = None):
    """A plain unpickle that trusts its input, to compare with."""
    kinds = {kind: type(kind, (Anything,), {}) for kind in RECORD_CLASSES}

    class Permissive(pickle.Unpickler):
        def find_class(self, module: str, name: str):
            if names is not None:
                names.add((module, name))
            return kinds[name] if module == RECORD_MODULE else super().find_class(module, name)

    return Permissive(io.BytesIO(data)).load()


def assert_as_stored(ours: object, theirs: object) -> None:
    """Every field of ours is what the oracle read; a float64 vector may come from any dtype."""
    value: Any
    stored: Any
    for field in fields(ours):
        value, stored = getattr(ours, field.name), getattr(theirs, field.name, None)
        if isinstance(value, tuple):
            assert len(value) == len(stored)
            for a, b in zip(value, stored, strict=True):
                assert_as_stored(a, b)
        elif isinstance(value, np.ndarray):
            assert value.shape == stored.shape
            assert value.dtype == stored.dtype
            assert np.array_equal(value, stored), field.name
        else:
            assert value == stored, field.name
            assert not isinstance(value, np.generic)


def assert_same(a: object, b: object) -> None:
    """Two published records are equal, dtypes included."""
    assert type(a) is type(b)
    if isinstance(a, list | tuple):
        assert len(a) == len(b)
        for x, y in zip(a, b, strict=True):
            assert_same(x, y)
    elif is_dataclass(a):
        for field in fields(a):
            assert_same(getattr(a, field.name), getattr(b, field.name))
    elif isinstance(a, np.ndarray):
        assert a.dtype == b.dtype
        assert np.array_equal(a, b)
    else:
        assert a == b


def assert_kept(store: PoseStore, cells: list[PublishedCell], poses: list[PublishedPose]) -> None:
    """A store shows published cells and poses, all of its points and numbers to the last bit."""
    table, result = store.cell_table(), store.poses
    assert [*zip(table.ids, table.scenes, strict=True)] == [(cell.id, cell.scene_name) for cell in cells]
    assert np.array_equal(table.center_m, [(cell.bbox_w[:3] + cell.bbox_w[3:]) / 2 for cell in cells])
    assert np.diff(table.parts.starts).tolist() == [len(cell.objects) for cell in cells]
    items = [item for cell in cells for item in cell.objects]
    assert table.parts.instance.tolist() == list(range(len(items)))
    assert [*zip(store.instance_ids, store.labels, strict=True)] == [(item.instance_id, item.label) for item in items]
    for row, item in enumerate(items):
        assert_same(store.instance_points(row), (item.xyz, item.rgb))
    assert np.array_equal(result.positions_m, [pose.pose_w for pose in poses])
    assert result.strategies == tuple(pose.described_by for pose in poses)
    for q, pose in enumerate(poses):
        cell, start = cells[result.cell[q]], table.parts.starts[result.cell[q]]
        assert cell.id == pose.cell_id
        for hint, ours in zip(pose.descriptions, result.hints(q), strict=True):
            text = hint.direction, hint.object_label, hint.object_color_text
            assert (ours.direction, ours.label, ours.colour) == text
            meant = None if ours.instance_id is None else cell.objects[ours.instance_id - start].id
            assert meant == (hint.object_id if hint.is_matched else None)


def make_cell(number: int = 0, num_objects: int = 3, num_points: int = 7) -> PublishedCell:
    rng = np.random.default_rng(number)
    objects = tuple(
        PublishedObject(
            n,
            1000 + n,
            rng.uniform(-0.2, 1.2, (num_points + n, 3)),
            (rng.integers(0, 256, (num_points + n, 3)) / 255).astype(np.float32),
            ["building", "pole", "trash bin"][n % 3],
        )
        for n in range(num_objects)
    )
    low = np.array([10.0 * number, 20.0, -5.0])
    return PublishedCell(f"0003_{number:05d}", "0003", objects, 30.0, np.concatenate([low, low + 30]))


def make_hint(object_id: int | None) -> PublishedHint:
    matched = object_id is not None
    best = np.array([0.1, -0.2]) if matched else None
    colour = np.array([0.4, 0.41, 0.39], dtype=np.float32)
    offsets = np.array([0.1, 0.2]), np.array([0.05, 0.1]), np.array([0.4, 0.5])
    return PublishedHint(
        object_id, 1000 + (object_id or 0), "building", colour, "gray-green", "on-top", *offsets, best, best, matched
    )


def make_pose(cell: PublishedCell) -> PublishedPose:
    offset = np.array([0.3, 0.4, 0.5])
    world = offset * cell.cell_size + cell.bbox_w[:3]
    return PublishedPose(offset, world, cell.id, cell.scene_name, "closest", (make_hint(1), make_hint(None)))


@pytest.fixture
def root(tmp_path: Path) -> Path:
    cells = [make_cell(0), make_cell(1)]
    save_scene(tmp_path / "data", "0003", cells, [make_pose(cell) for cell in cells])
    return tmp_path / "data"


def dump(path: Path, records: list[PickledRecord]) -> Path:
    with path.open("wb") as file:
        write_records(file, records)
    return path


def reference_pickle(cell: PublishedCell, protocol: int) -> bytes:
    """A cell as the reference package pickles it: its classes, numpy scalars, arrays in any order of bytes and axes."""
    names = ["datapreparation", "datapreparation.kitti360pose", RECORD_MODULE]
    modules = {name: types.ModuleType(name) for name in names}
    kinds = {kind: type(kind, (), {"__module__": RECORD_MODULE}) for kind in RECORD_CLASSES}
    modules[RECORD_MODULE].__dict__.update(kinds)

    def made(kind: str, source: object, **changes: object):
        record = kinds[kind]()
        record.__dict__ = {field.name: getattr(source, field.name) for field in fields(source)} | changes
        return record

    objects = [
        made("Object3d", o, instance_id=np.int32(o.instance_id), xyz=np.asfortranarray(o.xyz), closest_point=None)
        for o in cell.objects
    ]
    box = cell.bbox_w.astype(">f8")
    theirs = made("Cell", cell, objects=objects, cell_size=np.float64(30), bbox_w=box)
    with mock.patch.dict(sys.modules, modules):
        return pickle.dumps([theirs], protocol=protocol)


def random_object(n: int, low: np.ndarray, rng: np.random.Generator) -> PublishedObject:
    """Points in each way that files may hold them: from float32 metres and bytes, as released, or any other."""
    count = int(rng.integers(1, 9))
    units = rng.uniform(-0.2, 1.2, (count, 3))
    metres = (units * 30 + low).astype(np.float32)
    xyz = [(metres - low) / 30, units, units.astype(np.float32)][n % 3]
    byte = (rng.integers(0, 256, (count, 3)) / 255).astype(np.float32)
    rgb = [byte, rng.uniform(0, 1, (count, 3)).astype(np.float32), rng.uniform(0, 1, (count, 3))][n // 3 % 3]
    return PublishedObject(n + 3, 1000 + n, xyz, rgb, LABELS[n % 4])


def random_hint(cell: PublishedCell, n: int, rng: np.random.Generator) -> PublishedHint:
    item = cell.objects[n]
    matched = bool(rng.integers(2))
    colour = rng.uniform(0, 1, 3)
    return PublishedHint(
        object_id=item.id if matched else None,
        object_instance_id=item.instance_id,
        object_label=item.label,
        object_color_rgb=colour.astype(np.float32) if n % 2 else colour,
        object_color_text=COLOURS[n % 3],
        direction=DIRECTIONS[rng.integers(5)],
        offset_center=rng.normal(size=2),
        offset_closest=rng.normal(size=2),
        closest_point=rng.normal(size=3 if n % 2 else 2),
        best_offset_center=rng.normal(size=2) if matched else None,
        best_offset_closest=rng.normal(size=2) if matched else None,
        is_matched=matched,
    )


def random_scene(name: str, num_cells: int, seed: int, num_objects: int = 10) -> Scene:
    rng = np.random.default_rng(seed)
    cells, poses = [], []
    for n in range(num_cells):
        low = np.array([10.0 * n + 500, 3000.0, -12.5])
        objects = tuple(random_object(i, low, rng) for i in range(num_objects - n))
        cells.append(PublishedCell(f"{name}_{n:05d}", name, objects, 30.0, np.concatenate([low, low + 30])))
    for n in range(2 * num_cells):
        cell = cells[(n * 7) % num_cells]
        offset = rng.uniform(0, 1, 3)
        hints = tuple(random_hint(cell, i, rng) for i in range(2 + (n + seed) % 3))
        world = offset * 30 + cell.bbox_w[:3]
        poses.append(PublishedPose(offset, world, cell.id, name, ["closest", "class"][n % 2], hints))
    return Scene(f"2013_05_28_drive_{name}_sync", cells, poses)


@pytest.fixture
def scenes() -> list[Scene]:
    return [random_scene("0003", 4, 0), random_scene("0010", 3, 1)]


@pytest.fixture
def data(scenes: list[Scene], tmp_path: Path) -> Path:
    for scene in scenes:
        save_scene(tmp_path / "data", scene.name, scene.cells, scene.poses)
    return tmp_path / "data"


@pytest.fixture(scope="session")
def prepared(raw_root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Prepare the scene for this process alone, because preparing locks it."""
    out = tmp_path_factory.mktemp("prepared")
    assert prepare_data(raw_root, out, config=QUICK) == (LONG, VAL)
    return out


def contents(root: Path, scene: str = "") -> dict[str, bytes]:
    return {str(p.relative_to(root)): p.read_bytes() for p in root.rglob(f"*{scene}*" if scene else "*") if p.is_file()}


def forbid(monkeypatch: pytest.MonkeyPatch) -> None:
    def load(*args: object):
        raise AssertionError("a finished scene is read again")

    monkeypatch.setattr(kitti360_job, "load_raw_scene", load)
