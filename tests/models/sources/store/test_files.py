"""A store on disk: written once, mapped when opened, refused when it is not whole."""

import json
import lzma
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from models.citymap.templates import render_hint
from models.errors import DataError
from models.sources.kitti360pose.files import save_scene
from models.sources.store.files import convert, load_data, open_store
from models.sources.store.layout import COLUMNS
from tests.models.sources.conftest import MINI, assert_kept, needs_mini
from tests.models.sources.published import Scene, load_scene


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
    open_store(out)


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
    "has format 1, this hereabouts reads 2; convert .* again": lambda s: rewrite(
        s / "manifest.json", lambda m: m | {"format": 1}
    ),
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
    "pose_strategy has dtype .* shape": lambda s: rewrite(s / "pose_strategy.npy", lambda c: c[1:]),
    r"object_label\.npy: not a column of numbers": lambda s: rewrite(
        s / "object_label.npy", lambda c: c.astype(object)
    ),
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
    with pytest.raises(DataError, match=message) as error:
        open_store(store)
    assert str(store) in str(error.value)


@pytest.mark.slow
@needs_mini
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
        assert_kept(store.split(scene), stored.cells, stored.poses)
    assert not len(store.columns["xyz_f8"])  # the compact form holds for all of it
    text = " ".join(map(render_hint, store.poses.hints(0)))
    assert text.startswith("The pose is north of a gray building. The pose is east of a gray-green")
