import hashlib
from collections import Counter

import numpy as np
import pytest
from scipy.spatial import cKDTree

from models.citymap.colours import KITTI360_PALETTE
from models.errors import DataError
from models.sources.kitti360.prepare import grid_centers, prepare_scene, spaced_rows
from models.sources.kitti360.raw import list_raw_scenes, load_raw_scene
from models.sources.kitti360.rules import CLASSES, GROUND, PrepareConfig
from models.sources.kitti360pose.files import STANDARD_SPLITS, short_name
from models.sources.synthetic import towns as synthetic
from models.sources.synthetic.drive import draw_drive
from models.sources.synthetic.layout import draw_land, draw_plan
from models.sources.synthetic.objects import FURNITURE
from models.sources.synthetic.shapes import LocalFrame, box, patch
from models.sources.synthetic.styles import COLOUR_WEIGHTS, STYLES
from models.sources.synthetic.towns import SCALES, SIZES, TOWN_STYLES, build_town, write_town, write_towns

LABELS = {rule.label for rule in CLASSES}
TINY = {"train": (12, 20), "val": (15,), "test": ()}
FEW = {"train": ("0000", "0002"), "val": ("0010",), "test": ()}


def digests(root):
    return {
        str(p.relative_to(root)): hashlib.sha256(p.read_bytes()).hexdigest() for p in root.rglob("*") if p.is_file()
    }


@pytest.fixture(scope="module")
def prepared(tmp_path_factory):
    """A town of about a hundred cells, written, read back and prepared."""
    root = tmp_path_factory.mktemp("towns")
    scene = "2013_05_28_drive_0010_sync"
    town = build_town(np.random.default_rng(5), STYLES["mixed"], 100)
    write_town(root, scene, town)
    raw = load_raw_scene(root, scene)
    return (
        root / synthetic.TILES / scene / "static",
        town,
        raw,
        *prepare_scene(raw, PrepareConfig(), np.random.default_rng(0)),
    )


@pytest.fixture
def tiny_scale(monkeypatch):
    monkeypatch.setitem(SIZES, "demo", TINY)
    monkeypatch.setattr(synthetic, "STANDARD_SPLITS", FEW)
    monkeypatch.setattr(synthetic, "TOWN_STYLES", {"train": ("suburb", "grid"), "val": ("works",), "test": ()})


def test_a_town_passes_the_preparation_with_about_as_many_cells_and_instances_as_asked(prepared):
    _, _, raw, cells, poses = prepared
    assert abs(len(cells) - 100) <= 10
    counts = np.array([len(cell.objects) for cell in cells])
    assert counts.min() >= 6
    assert 10 < counts.mean() < 18
    assert counts.max() <= 40
    assert 0.5 < len({tuple(pose.pose_w) for pose in poses}) / len(cells) < 1.3
    assert sum(len(i.points_m) for i in raw.instances) < 4000 * len(cells)


def test_every_class_stands_in_a_town_that_is_not_tiny(prepared):
    _, town, _, _, _ = prepared
    assert {rule.semantic for rule in CLASSES} == set(np.unique(town.scan.semantic).tolist())


def test_classes_and_colours_vary(prepared):
    _, _, raw, cells, _ = prepared
    labels = Counter(item.label for cell in cells for item in cell.objects)
    assert labels.keys() <= LABELS
    assert all(labels[label] > len(cells) / 2 for label in ("building", "vegetation", "road", "sidewalk", "terrain"))
    words = Counter(KITTI360_PALETTE.word(i.rgb.mean(axis=0)) for i in raw.instances)
    assert words.keys() == set(KITTI360_PALETTE.words)
    assert words.most_common(1)[0][1] < 0.6 * words.total()
    chroma = max(float(np.ptp(i.rgb.mean(axis=0))) for i in raw.instances)
    assert chroma < 0.12  # near-grey


def test_paved_streets_have_no_holes_where_the_drive_goes(prepared):
    _, town, _, _, _ = prepared
    road = cKDTree(town.scan.xyz[town.scan.semantic == 7, :2])
    assert (road.query(town.drive_m[:, :2])[0] < 1).mean() > 0.97


def test_numbers_say_class_and_instance_and_tiles_share_instances(prepared):
    tiles, town, _, _, _ = prepared
    assert (town.scan.instance // 1000 == town.scan.semantic).all()
    of_ground = np.isin(town.scan.semantic, [rule.semantic for rule in CLASSES if rule.label in GROUND])
    assert ((town.scan.instance % 1000 == 0) == of_ground).all(), "all road is one instance, as in KITTI-360"
    parts = [set(np.unique(synthetic.plyfile.PlyData.read(path)["vertex"]["instance"])) for path in tiles.iterdir()]
    assert len(parts) > 1
    assert set.union(*parts) == set(np.unique(town.scan.instance))
    assert sum(map(len, parts)) > len(set.union(*parts))


def test_pieces_of_ground_have_numbers_of_their_own_where_that_is_asked():
    official, own = (build_town(np.random.default_rng(5), STYLES["mixed"], 20, way).scan for way in (False, True))
    assert (official.xyz == own.xyz).all()
    assert (official.rgb == own.rgb).all()
    assert (official.semantic == own.semantic).all()
    assert (own.instance % 1000 > 0).all()
    numbers = {rule.label: [np.unique(scan.instance[scan.semantic == rule.semantic]) for scan in (official, own)]
               for rule in CLASSES}  # fmt: skip
    for label, (merged, apart) in numbers.items():
        if label in GROUND and len(apart):
            assert len(merged) == 1
        elif label not in GROUND:
            assert (merged == apart).all()
    assert len(numbers["sidewalk"][1]) > 1


def test_tiles_have_the_properties_of_kitti360(prepared):
    vertex = synthetic.plyfile.PlyData.read(next(prepared[0].iterdir()))["vertex"]
    assert [(p.name, p.val_dtype) for p in vertex.properties] == [
        *((axis, "f4") for axis in "xyz"),
        *((channel, "u1") for channel in ("red", "green", "blue")),
        *(("semantic", "i4"), ("instance", "i4"), ("visible", "u1"), ("confidence", "f4")),
    ]


def test_poses_are_rotations_that_look_ahead(prepared):
    _, town, raw, _, _ = prepared
    np.testing.assert_allclose(raw.trajectory_m, town.drive_m, atol=1e-6)
    [poses] = prepared[0].parents[2].rglob("poses.txt")
    matrices = np.loadtxt(poses)[:, 1:].reshape(-1, 3, 4)
    turned = matrices[:, :, :3] @ matrices[:, :, :3].swapaxes(1, 2)
    np.testing.assert_allclose(turned, np.broadcast_to(np.eye(3), turned.shape), atol=3e-6)  # six decimals
    steps = np.diff(town.drive_m[:, :2], axis=0)
    assert np.linalg.norm(steps, axis=1).max() < 1.5
    ahead = (matrices[:-1, :2, 0] * steps).sum(axis=1)
    assert (ahead > 0).mean() > 0.95


@pytest.mark.parametrize("style", STYLES)
def test_a_drive_bends_and_ends_when_it_has_passed_enough_cells(style):
    rng = np.random.default_rng(3)
    plan, land = draw_plan(rng, STYLES[style], 400), draw_land(rng, STYLES[style])
    drive = land.to_world(draw_drive(rng, plan, land, 400))
    config = PrepareConfig()
    assert abs(len(grid_centers(drive[spaced_rows(drive, config.spacing_m)], config)) - 400) <= 12
    heading = np.arctan2(*np.gradient(drive[:, :2], axis=0).T)
    assert len(np.unique(np.round(heading / (np.pi / 8)) % 16)) >= 8
    assert np.ptp(drive[:, 2]) > 0.5


@pytest.mark.slow
def test_one_seed_makes_one_set_of_files_and_another_seed_another(tmp_path, tiny_scale):
    calls = []
    names = write_towns(tmp_path / "a", "demo", 1, lambda done, total: calls.append((done, total)))
    assert calls == [(1, 3), (2, 3), (3, 3)]
    assert [short_name(name) for name in names] == ["0000", "0002", "0010"]
    assert list_raw_scenes(tmp_path / "a") == tuple(sorted(names))
    write_towns(tmp_path / "b", "demo", 1)
    assert digests(tmp_path / "a") == digests(tmp_path / "b")
    write_towns(tmp_path / "c", "demo", 2)
    tiles = {name: digest for name, digest in digests(tmp_path / "c").items() if name.endswith("ply")}
    assert not set(tiles.values()) & set(digests(tmp_path / "a").values())
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b", "c"]


def test_what_cannot_be_made_is_refused_and_leaves_nothing(tmp_path):
    with pytest.raises(DataError, match="'huge' is unknown; choose from: demo, full"):
        write_towns(tmp_path / "out", "huge", 0)
    with pytest.raises(DataError, match="'some' are unknown; choose from: official, own"):
        write_towns(tmp_path / "out", "demo", 0, pieces="some")
    with pytest.raises(DataError, match="negative"):
        write_towns(tmp_path / "out", "demo", -1)
    assert not list(tmp_path.iterdir())
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "mine").write_text("kept")
    with pytest.raises(DataError, match="not an empty folder"):
        write_towns(tmp_path / "out", "demo", 0)
    with pytest.raises(DataError, match="not an empty folder"):
        write_towns(tmp_path / "out" / "mine", "demo", 0)
    with pytest.raises(DataError, match="deeper: cannot be written"):
        write_towns(tmp_path / "out" / "mine" / "deeper", "demo", 0)
    assert [path.name for path in tmp_path.rglob("*")] == ["out", "mine"]


def test_a_failure_on_the_way_leaves_nothing(tmp_path, tiny_scale):
    def stop(done, total):
        if done == 2:
            raise KeyboardInterrupt

    (tmp_path / "out").mkdir()
    with pytest.raises(KeyboardInterrupt):
        write_towns(tmp_path / "out", "demo", 0, stop)
    assert [path.name for path in tmp_path.rglob("*")] == ["out"]


def test_scales_cover_the_standard_split_at_the_published_size():
    assert SCALES == ("demo", "full")
    assert {split: sum(sizes) for split, sizes in SIZES["full"].items()} == {"train": 11259, "val": 1434, "test": 4308}
    assert sum(SIZES["demo"]["train"]) == 2000
    for sizes in (*SIZES.values(), TOWN_STYLES):
        assert {split: len(owner) for split, owner in sizes.items()} == {
            s: len(owner) for s, owner in STANDARD_SPLITS.items()
        }
    assert COLOUR_WEIGHTS.keys() == LABELS


def test_bodies_lie_where_they_should():
    rng = np.random.default_rng(0)
    sheet = patch(rng, (1, 2, 3), (4, 0, 0), (0, 0, 2), 0.2)
    assert len(sheet) == 20 * 10
    np.testing.assert_allclose(sheet.min(axis=0), (1, 2, 3), atol=0.2)
    np.testing.assert_allclose(sheet.max(axis=0), (5, 2, 5), atol=0.2)
    body = box(rng, (2.0, 1.0, 3.0), 0.1)
    np.testing.assert_allclose(np.abs(body[:, 0]).max(), 1, atol=0.1)
    np.testing.assert_allclose(body[:, 1:].max(axis=0), (1, 3), atol=0.1)


@pytest.mark.parametrize("flip", [1.0, -1.0])
def test_spots_nest(flip):
    spot = LocalFrame(3, 4, np.cos(0.7), np.sin(0.7), flip)
    nested = spot.offset(2, 1, np.pi / 2)
    inner = np.array([[1.0, 0.0, 0.0]])  # a metre along the turned x axis is a metre along the outer y axis
    np.testing.assert_allclose(nested.to_plan(inner), spot.to_plan(np.array([[2.0, 2.0, 0.0]])), atol=1e-12)


@pytest.mark.parametrize("label", FURNITURE)
def test_furniture_has_enough_points_to_count(label):
    least = next(rule.min_points for rule in CLASSES if rule.label == label)
    rng = np.random.default_rng(0)
    clouds = [FURNITURE[label](rng) for _ in range(200)]
    assert np.mean([len(cloud) >= least for cloud in clouds]) > 0.95
    assert all(np.abs(cloud[:, :2]).max() < 6 and cloud[:, 2].min() > -0.2 for cloud in clouds)
