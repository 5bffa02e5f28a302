"""The converted store: every value as published, opened without reading it, refused when it is not whole."""

import json
import lzma
import time
from dataclasses import fields, is_dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from models.city.kitti360pose import Scene, load_scene, save_scene
from models.city.pose_files import convert, load_data, open_store, verify_store
from models.city.pose_layout import COLUMNS
from models.city.pose_store import PoseStore
from models.city.published import PublishedCell, PublishedHint, PublishedObject, PublishedPose
from models.city.types import DIRECTIONS
from models.errors import DataError

MINI = Path(__file__).parents[4] / "shared/data/k360-mini"
LABELS = ["building", "pole", "trash bin", "road"]
COLOURS = ["gray", "green", "beige"]


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


def make_object(n: int, low: np.ndarray, rng: np.random.Generator) -> PublishedObject:
    """Points in each way that files may hold them: from float32 metres and bytes, as released, or any other."""
    count = int(rng.integers(1, 9))
    units = rng.uniform(-0.2, 1.2, (count, 3))
    metres = (units * 30 + low).astype(np.float32)
    xyz = [(metres - low) / 30, units, units.astype(np.float32)][n % 3]
    byte = (rng.integers(0, 256, (count, 3)) / 255).astype(np.float32)
    rgb = [byte, rng.uniform(0, 1, (count, 3)).astype(np.float32), rng.uniform(0, 1, (count, 3))][n // 3 % 3]
    return PublishedObject(n + 3, 1000 + n, xyz, rgb, LABELS[n % 4])


def make_hint(cell: PublishedCell, n: int, rng: np.random.Generator) -> PublishedHint:
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


def make_scene(name: str, num_cells: int, seed: int, num_objects: int = 10) -> Scene:
    rng = np.random.default_rng(seed)
    cells, poses = [], []
    for n in range(num_cells):
        low = np.array([10.0 * n + 500, 3000.0, -12.5])
        objects = tuple(make_object(i, low, rng) for i in range(num_objects - n))
        cells.append(PublishedCell(f"{name}_{n:05d}", name, objects, 30.0, np.concatenate([low, low + 30])))
    for n in range(2 * num_cells):
        cell = cells[(n * 7) % num_cells]
        offset = rng.uniform(0, 1, 3)
        hints = tuple(make_hint(cell, i, rng) for i in range(2 + (n + seed) % 3))
        world = offset * 30 + cell.bbox_w[:3]
        poses.append(PublishedPose(offset, world, cell.id, name, ["closest", "class"][n % 2], hints))
    return Scene(f"2013_05_28_drive_{name}_sync", cells, poses)


@pytest.fixture
def scenes() -> list[Scene]:
    return [make_scene("0003", 4, 0), make_scene("0010", 3, 1)]


@pytest.fixture
def data(scenes: list[Scene], tmp_path: Path) -> Path:
    for scene in scenes:
        save_scene(tmp_path / "data", scene.name, scene.cells, scene.poses)
    return tmp_path / "data"


@pytest.fixture(params=["converted", "published"])
def store(request: pytest.FixtureRequest, data: Path, tmp_path: Path) -> PoseStore:
    """The same data either way."""
    if request.param == "published":
        return load_data(data)
    convert(data, tmp_path / "store")
    return load_data(tmp_path / "store")


def published(store: PoseStore) -> tuple[list[PublishedCell], list[PublishedPose]]:
    cells = [store.published_cell(n) for n in range(len(store.cell_ids))]
    return cells, [store.published_pose(q) for q in range(len(store.poses))]


def test_every_value_is_as_published(store: PoseStore, scenes: list[Scene]) -> None:
    cells, poses = published(store)
    assert_same(cells, [cell for scene in scenes for cell in scene.cells])
    assert_same(poses, [pose for scene in scenes for pose in scene.poses])


def test_all_ways_to_keep_points_occur(store: PoseStore) -> None:
    """Or the test above would prove less."""
    for kinds in ("object_xyz_kind", "object_rgb_kind"):
        assert set(store.columns[kinds].tolist()) == {0, 1, 2}


@pytest.mark.parametrize(("split", "names"), [("test", ["0003"]), ("0010", ["0010"]), ("0010,0003", ["0003", "0010"])])
def test_a_split_is_a_view_with_rows_of_its_own(
    store: PoseStore, scenes: list[Scene], split: str, names: list[str]
) -> None:
    view = store.split(split)
    chosen = [scene for scene in scenes if scene.cells[0].scene_name in names]
    cells, poses = published(view)
    assert [scene.scene_name for scene in view.scenes] == names
    assert_same(cells, [cell for scene in chosen for cell in scene.cells])
    assert_same(poses, [pose for scene in chosen for pose in scene.poses])
    table = view.cell_table()
    assert list(table.ids) == [cell.id for cell in cells]
    assert table.parts.instance.tolist() == list(range(sum(len(cell.objects) for cell in cells)))
    assert [view.cell_ids[row] for row in view.poses.cell] == [pose.cell_id for pose in poses]
    assert_instances(view, poses)
    assert_same(published(view.split(None))[0], cells)


def test_a_split_without_scenes_is_refused(store: PoseStore) -> None:
    for split in ("train", "0005"):
        with pytest.raises(DataError, match="2013_05_28_drive_0003_sync"):
            store.split(split)
    with pytest.raises(DataError, match="2013_05_28_drive_0010_sync"):
        store.split("val").split("0003")


def test_the_cell_table_is_what_a_slow_reading_gives(store: PoseStore, scenes: list[Scene]) -> None:
    table, row = store.cell_table(), 0
    for n, cell in enumerate(cell for scene in scenes for cell in scene.cells):
        center = (cell.bbox_w[:3] + cell.bbox_w[3:]) / 2
        assert (table.ids[n], table.scenes[n]) == (cell.id, cell.scene_name)
        assert np.array_equal(table.center_m[n], center)
        assert table.parts.starts[n] == row
        for item in cell.objects:
            world = np.array([[low + 30 * float(x) for low, x in zip(cell.bbox_w, p, strict=False)] for p in item.xyz])
            closest = min(world, key=lambda p: ((p - center) ** 2).sum())
            assert store.labels[row] == item.label
            assert table.parts.instance[row] == row
            assert table.parts.count[row] == len(item.xyz)
            for value, naive in (
                (table.parts.low_m, world.min(axis=0)),
                (table.parts.high_m, world.max(axis=0)),
                (table.parts.closest_m, closest),
                (table.parts.rgb, item.rgb.astype(float).mean(axis=0)),
            ):
                assert value.dtype == np.float32
                assert np.allclose(value[row], naive, rtol=1e-6)
            row += 1
    assert table.size_m == 30
    assert table.parts.starts[-1] == row == len(store.labels)


def test_poses_have_hints_and_texts(store: PoseStore, scenes: list[Scene]) -> None:
    table = store.poses
    poses = [pose for scene in scenes for pose in scene.poses]
    assert np.array_equal(table.positions_m, [pose.pose_w for pose in poses])
    assert table.strategies == tuple(pose.described_by for pose in poses)
    for q, pose in enumerate(poses):
        stored = [(h.direction, h.object_label, h.object_color_text) for h in pose.descriptions]
        assert [(h.direction, h.label, h.colour) for h in table.hints(q)] == stored
        assert table.text(q) == " ".join(f"The pose is {d} of a {c} {label}." for d, label, c in stored)
        assert store.pose(q).cell_id == pose.cell_id
        assert store.pose(q).description.hints == table.hints(q)
    assert_instances(store, poses)


def assert_instances(store: PoseStore, poses: list[PublishedPose]) -> None:
    """Matched hints name the row of the object meant, others none."""
    table, starts = store.poses, store.cell_table().parts.starts
    for q, pose in enumerate(poses):
        cell = store.published_cell(int(table.cell[q]))
        for hint, ours in zip(pose.descriptions, table.hints(q), strict=True):
            if hint.is_matched:
                assert cell.objects[ours.instance_id - starts[table.cell[q]]].id == hint.object_id
            else:
                assert ours.instance_id is None


def test_points_of_an_instance(store: PoseStore, scenes: list[Scene]) -> None:
    items = [item for scene in scenes for cell in scene.cells for item in cell.objects]
    for row, item in enumerate(items):
        xyz, rgb = store.instance_points(row)
        assert np.array_equal(xyz, item.xyz)
        assert np.array_equal(rgb, item.rgb)


def test_the_released_form_takes_15_bytes_a_point(tmp_path: Path) -> None:
    """Points that were float32 metres and bytes are kept as such, and come back to the last bit."""
    rng = np.random.default_rng(0)
    low = np.array([1374.25, 3987.5, 101.0])
    xyz = ((low + rng.uniform(-10, 40, (5000, 3))).astype(np.float32) - low) / 30
    rgb = rng.integers(0, 256, (5000, 3)).astype(np.float32) / np.float32(255)
    item = PublishedObject(0, 11, xyz, rgb, "building")
    cell = PublishedCell("0003_00000", "0003", (item,), 30.0, np.concatenate([low, low + 30]))
    save_scene(tmp_path / "data", "0003", [cell], [])
    store = convert(tmp_path / "data", tmp_path / "store")
    assert_same(store.published_cell(0), cell)
    assert sum(path.stat().st_size for path in (tmp_path / "store").iterdir()) < 15 * 5000 + 20_000


def test_columns_are_mapped_not_read(data: Path, tmp_path: Path) -> None:
    convert(data, tmp_path / "store")
    columns = open_store(tmp_path / "store").columns
    assert all(isinstance(column.base, np.memmap) and not column.flags.writeable for column in columns.values())
    assert set(columns) == set(COLUMNS)


def test_some_scenes_and_progress(data: Path, tmp_path: Path) -> None:
    calls: list[tuple[int, int]] = []
    store = convert(data, tmp_path / "store", "val", lambda done, total: calls.append((done, total)))
    assert [scene.scene_name for scene in store.scenes] == ["0010"]
    done, totals = zip(*calls, strict=True)
    assert list(done) == sorted(set(done))
    assert set(totals) == {(data / "cells/2013_05_28_drive_0010_sync.pkl").stat().st_size}
    assert 0 < done[-1] <= totals[0]
    assert [scene.scene_name for scene in load_data(data, "val").scenes] == ["0010"]


def test_a_full_directory_is_not_overwritten(data: Path, tmp_path: Path) -> None:
    out = tmp_path / "store"
    out.mkdir()
    (out / "thesis.tex").write_text("years of work")
    for target in (out, out / "thesis.tex"):
        with pytest.raises(DataError, match="not empty"):
            convert(data, target)
    assert (out / "thesis.tex").read_text() == "years of work"
    (out / "thesis.tex").unlink()
    convert(data, out)
    verify_store(out)


def test_a_failed_conversion_leaves_nothing(data: Path, tmp_path: Path) -> None:
    broken = data / "poses/2013_05_28_drive_0010_sync.pkl"
    broken.write_bytes(broken.read_bytes()[:-100])
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(DataError, match=r"poses/2013_05_28_drive_0010_sync\.pkl"):
        convert(data, tmp_path / "store")
    assert sorted(tmp_path.rglob("*")) == before
    assert len(load_data(data, "0003").poses) == 8


def test_cells_without_poses(data: Path, tmp_path: Path) -> None:
    (data / "poses/2013_05_28_drive_0010_sync.pkl").unlink()
    convert(data, tmp_path / "store")
    for path in (data, tmp_path / "store"):
        store = load_data(path)
        assert [scene.poses for scene in store.scenes] == [8, None]
        assert len(store.cell_table()) == 7
        assert len(store.split("0003").poses) == 8
        with pytest.raises(DataError, match=r"poses/2013_05_28_drive_0010_sync\.pkl"):
            _ = store.poses


def test_poses_of_missing_cells_are_refused(data: Path, scenes: list[Scene], tmp_path: Path) -> None:
    save_scene(data, "0003", scenes[0].cells, [])
    poses = data / "poses"
    (poses / "2013_05_28_drive_0010_sync.pkl").rename(poses / "2013_05_28_drive_0003_sync.pkl")
    for load in (lambda: load_data(data), lambda: convert(data, tmp_path / "store")):
        with pytest.raises(DataError, match=r"0003_sync\.pkl: poses\[0\]\.cell_id: cell '0010_"):
            load()


def test_one_id_in_two_scenes_is_refused(data: Path, scenes: list[Scene]) -> None:
    save_scene(data, "town", scenes[0].cells, [])
    with pytest.raises(DataError, match=r"town\.pkl: cells\[0\]\.id '0003_00000' is taken by another scene"):
        load_data(data)


def test_cells_of_two_sizes_make_no_table(data: Path, scenes: list[Scene]) -> None:
    small = [replace(cell, id=f"s{cell.id}", cell_size=20.0) for cell in scenes[0].cells]
    save_scene(data, "small", small, [])
    store = load_data(data)
    with pytest.raises(DataError, match="cells of 20 m and of 30 m"):
        store.cell_table()
    assert store.split("small").cell_table().size_m == 20


def test_what_is_no_data_set(tmp_path: Path) -> None:
    with pytest.raises(DataError, match="neither a converted store"):
        load_data(tmp_path)
    with pytest.raises(DataError, match=r"manifest\.json: cannot be read"):
        open_store(tmp_path)


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-10])


def rewrite(path: Path, change) -> None:
    """Change a column or JSON, and let the manifest agree on its size."""
    if path.suffix == ".npy":
        np.save(path, change(np.load(path)))
    else:
        path.write_text(json.dumps(change(json.loads(path.read_text()))))
    manifest = json.loads((path.parent / "manifest.json").read_text())
    if path.name != "manifest.json":
        manifest["files"][path.name]["bytes"] = path.stat().st_size
        (path.parent / "manifest.json").write_text(json.dumps(manifest))


def filled(value: int):
    return lambda column: np.full_like(column, value)


def emptied(points: np.ndarray) -> np.ndarray:
    """Give the points of one object to another of the same kind."""
    points[9] += points[0]
    points[0] = 0
    return points


DAMAGE = {
    r"xyz_world\.npy: missing": lambda s: (s / "xyz_world.npy").unlink(),
    r"rgb_u1\.npy: missing or cut": lambda s: cut(s / "rgb_u1.npy"),
    r"manifest\.json: cannot": lambda s: (s / "manifest.json").unlink(),
    r"manifest\.json: .*JSON": lambda s: cut(s / "manifest.json"),
    "format: ": lambda s: rewrite(s / "manifest.json", lambda m: m | {"format": 2}),
    "kind: ": lambda s: rewrite(s / "manifest.json", lambda m: m | {"kind": "index"}),
    "files: unexpected or missing xyz_f4": lambda s: rewrite(
        s / "manifest.json", lambda m: m | {"files": {k: v for k, v in m["files"].items() if k != "xyz_f4.npy"}}
    ),
    r"files: unexpected or missing \.\./x": lambda s: rewrite(
        s / "manifest.json", lambda m: m | {"files": m["files"] | {"../x": {"sha256": "", "bytes": 1}}}
    ),
    r"strings\.json: ": lambda s: rewrite(s / "strings.json", lambda t: t | {"words": 7}),
    "6 cell ids, not 7": lambda s: rewrite(s / "strings.json", lambda t: t | {"cell_ids": t["cell_ids"][1:]}),
    "hint_label points outside|object_label points outside": lambda s: rewrite(
        s / "strings.json", lambda t: t | {"words": t["words"][:2]}
    ),
    "pose_world_m has dtype": lambda s: rewrite(s / "pose_world_m.npy", lambda c: c.astype(np.float32)),
    "pose_offset has dtype .* shape": lambda s: rewrite(s / "pose_offset.npy", lambda c: c[1:]),
    "object_id.* has dtype": lambda s: rewrite(s / "object_id.npy", lambda c: c.astype(object)),
    "cell_objects does not add up": lambda s: rewrite(s / "cell_objects.npy", lambda c: c + 1),
    "pose_hints does not add up": lambda s: rewrite(s / "pose_hints.npy", filled(-1)),
    "object_xyz_kind and": lambda s: rewrite(s / "object_xyz_kind.npy", filled(1)),
    "object_xyz_kind and object_points do not": lambda s: rewrite(s / "object_points.npy", emptied),
    "object_rgb_kind and": lambda s: rewrite(s / "object_rgb_kind.npy", filled(9)),
    "pose_cell points outside": lambda s: rewrite(s / "pose_cell.npy", filled(7)),
    "cell_scene points outside": lambda s: rewrite(s / "cell_scene.npy", filled(-1)),
    "hint_object points outside": lambda s: rewrite(s / "hint_object.npy", filled(10**6)),
    "hint_direction points outside": lambda s: rewrite(s / "hint_direction.npy", filled(5)),
}


@pytest.mark.parametrize("message", DAMAGE)
def test_a_damaged_store_is_refused(message: str, data: Path, tmp_path: Path) -> None:
    store = tmp_path / "store"
    convert(data, store)
    DAMAGE[message](store)
    if message.startswith("object_id"):
        message = r"object_id\.npy: no column of numbers"
    with pytest.raises(DataError, match=message) as error:
        open_store(store)
    assert str(store) in str(error.value)


def test_verify_finds_a_changed_byte(data: Path, tmp_path: Path) -> None:
    store = tmp_path / "store"
    convert(data, store)
    verify_store(store)
    for path in sorted(store.glob("*.npy")):
        whole = path.read_bytes()
        if len(whole) > 128:  # more than a header
            path.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))
            with pytest.raises(DataError, match=path.name.split(".")[0].split("_")[0]):
                verify_store(store)
            path.write_bytes(whole)
    verify_store(store)


@pytest.mark.skipif(not MINI.is_dir(), reason="../shared/data/k360-mini is not on this machine")
def test_the_sample_comes_back_to_the_last_bit(tmp_path: Path) -> None:
    for part in ("cells", "poses"):
        (tmp_path / part).mkdir()
    for source in MINI.glob("cells/*.pkl.xz"):
        (tmp_path / "cells" / source.stem).write_bytes(lzma.decompress(source.read_bytes()))
    for source in MINI.glob("poses/*.pkl"):
        (tmp_path / "poses" / source.name).write_bytes(source.read_bytes())
    convert(tmp_path, tmp_path / "store")
    begin = time.perf_counter()
    store = open_store(tmp_path / "store")
    assert time.perf_counter() - begin < 1
    for scene in ("0003", "0010"):
        stored = load_scene(tmp_path, scene)
        cells, poses = published(store.split(scene))
        assert_same(cells, stored.cells)
        assert_same(poses, stored.poses)
    assert not len(store.columns["xyz_f8"])  # the compact form holds for all of it
    assert store.poses.text(0).startswith("The pose is north of a gray building. The pose is east of a gray-green")
