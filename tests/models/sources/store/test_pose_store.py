"""The converted store: what was published to the last bit, opened without reading it, refused when it is not whole."""

from pathlib import Path

import numpy as np
import pytest

from models.citymap.point_sample import sample_points
from models.errors import DataError
from models.sources.kitti360pose.files import save_scene
from models.sources.kitti360pose.records import PublishedCell, PublishedObject
from models.sources.store.files import convert, load_data
from models.sources.store.pose_store import PoseStore
from tests.models.sources.conftest import assert_kept, assert_same
from tests.models.sources.published import Scene


@pytest.fixture(params=["converted", "published"])
def store(request: pytest.FixtureRequest, data: Path, tmp_path: Path) -> PoseStore:
    """The same data either way."""
    if request.param == "published":
        return load_data(data)
    convert(data, tmp_path / "store")
    return load_data(tmp_path / "store")


def test_every_value_is_as_published(store: PoseStore, scenes: list[Scene]) -> None:
    assert_kept(
        store, [cell for scene in scenes for cell in scene.cells], [pose for scene in scenes for pose in scene.poses]
    )


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
    assert [scene.scene_name for scene in view.scenes] == names
    for same in (view, view.split(None)):
        assert_kept(same, [c for scene in chosen for c in scene.cells], [p for scene in chosen for p in scene.poses])


def test_a_split_without_scenes_is_refused(store: PoseStore) -> None:
    for split in ("train", "0005"):
        with pytest.raises(DataError, match="2013_05_28_drive_0003_sync"):
            store.split(split)
    with pytest.raises(DataError, match="2013_05_28_drive_0010_sync"):
        store.split("val").split("0003")


def test_samples_are_the_points_of_the_instances(store: PoseStore) -> None:
    view = store.split("0003")
    table = view.cell_table()
    assert table.sample is not None
    chosen = np.array([len(table) - 1, 0])
    rows = [row for n in chosen for row in range(table.parts.starts[n], table.parts.starts[n + 1])]
    expected = np.stack([sample_points(*view.instance_points(row)) for row in rows])
    assert np.array_equal(table.sample(chosen), expected)


def test_the_cell_table_is_what_a_slow_reading_gives(store: PoseStore, scenes: list[Scene]) -> None:
    table, row = store.cell_table(), 0
    for n, cell in enumerate(cell for scene in scenes for cell in scene.cells):
        center = (cell.bbox_w[:3] + cell.bbox_w[3:]) / 2
        assert (table.ids[n], table.scenes[n]) == (cell.id, cell.scene_name)
        assert np.array_equal(table.center_m[n], center)
        assert table.parts.starts[n] == row
        for item in cell.objects:
            world = np.array(
                [[low + 30 * float(x) for low, x in zip(cell.bbox_w[:3], p, strict=True)] for p in item.xyz]
            )
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
    assert_same(store.instance_points(0), (xyz, rgb))
    assert sum(path.stat().st_size for path in (tmp_path / "store").iterdir()) < 15 * 5000 + 20_000
