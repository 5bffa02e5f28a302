import gzip
import itertools
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from models.errors import DataError
from models.sources.kitti360.raw import list_raw_scenes, load_raw_scene, read_tile, read_trajectory
from models.sources.kitti360.rules import CLASSES
from tests.models.sources.raw_scenes import FOLDER, VERTEX, write_ply, write_trajectory

POLE, ROAD, CAR, UNLABELLED = (17, 17001), (7, 7001), (26, 26001), (0, 0)


def vertices(seed: int, *clouds: tuple[tuple[int, int], int]) -> np.ndarray:
    """Points at random in a box of 30 x 20 x 2 m: ((semantic, instance), number of points) a cloud."""
    rng = np.random.default_rng(seed)
    vertex = np.zeros(sum(count for _, count in clouds), dtype=VERTEX)
    for axis, size in zip("xyz", (30, 20, 2), strict=True):
        vertex[axis] = rng.uniform(0, size, len(vertex)) + 500
    for channel in ("red", "green", "blue"):
        vertex[channel] = rng.integers(0, 256, len(vertex))
    ids = np.repeat([key for key, _ in clouds], [count for _, count in clouds], axis=0)
    vertex["semantic"], vertex["instance"] = ids.T
    return rng.permutation(vertex)


TILES = (
    vertices(0, (ROAD, 4000), (POLE, 20), (CAR, 300), (UNLABELLED, 50), ((17, 17009), 24)),
    vertices(1, (ROAD, 3000), (POLE, 10), ((11, 11001), 500), ((17, 17000), 40)),
)
TRAJECTORY = np.column_stack([np.linspace(500, 530, 31), np.linspace(500, 520, 31), np.full(31, 1.0)])


@pytest.fixture
def root(tmp_path: Path) -> Path:
    static = tmp_path / "data_3d_semantics" / FOLDER / "static"
    for n, tile in enumerate(TILES):
        write_ply(static / f"{n:010d}_{n + 1:010d}.ply", tile)
    write_trajectory(tmp_path, TRAJECTORY)
    return tmp_path


def tiles_of(root: Path) -> list[Path]:
    return sorted((root / "data_3d_semantics" / FOLDER / "static").iterdir())


def naive_merge(number: int, voxel: float | None) -> tuple[np.ndarray, np.ndarray]:
    """Rule 2 as it reads: after each tile, the first point of each voxel, in the order they came."""
    remaining: list = []
    for tile in TILES:
        remaining += [tuple(v) for v in tile[tile["instance"] == number].tolist()]
        low = [min((v[axis] for v in remaining), default=0) for axis in range(3)]
        first_in_cube: dict = {}
        for v in remaining:
            key = v[:3] if voxel is None else tuple((v[a] - low[a] + voxel / 2) // voxel for a in range(3))
            first_in_cube.setdefault(key, v)
        remaining = list(first_in_cube.values())
    return np.array([v[:3] for v in remaining], dtype=np.float32), np.array([v[3:6] for v in remaining]) / 255


def test_instances_are_merged_over_tiles_and_thinned(root) -> None:
    scene = load_raw_scene(root, "0042")
    assert scene.name == "0042"
    # By tile, then class, then number; 24 points are too few for a pole, cars and unlabelled points are no class.
    assert [(i.id, i.label) for i in scene.instances] == [
        (17001, "pole"), (7001, "road"), (11001, "building"), (17000, "pole")
    ]  # fmt: skip
    for instance, voxel in zip(scene.instances, (None, 0.25, 0.25, None), strict=True):
        xyz, rgb = naive_merge(instance.id, voxel)
        assert np.array_equal(instance.points_m, xyz)
        assert instance.rgb == pytest.approx(rgb, abs=1e-6)
    assert len(scene.instances[1].points_m) < 7000
    assert np.abs(scene.trajectory_m - TRAJECTORY).max() < 1e-6
    assert "road" in scene.stuff
    assert "pole" not in scene.stuff
    assert load_raw_scene(root, FOLDER).name == "0042"


def test_the_classes_are_the_rules_of_kitti360pose() -> None:
    stuff = {"road", "sidewalk", "parking", "wall", "fence", "guard rail", "bridge", "tunnel", "vegetation", "terrain"}
    assert {rule.label for rule in CLASSES if rule.is_stuff} == stuff
    quarter = {"building", "road", "sidewalk", "parking", "bridge", "tunnel", "vegetation", "terrain"}
    assert {rule.label for rule in CLASSES if rule.voxel_m == 0.25} == quarter
    assert {r.label for r in CLASSES if r.voxel_m == 0.125} == {"garage", "wall", "fence", "guard rail"}
    assert {r.label for r in CLASSES if r.min_points == 1000} == {"road", "sidewalk", "parking", "bridge", "tunnel"}
    assert {r.label for r in CLASSES if r.min_points == 25} == {r.label for r in CLASSES if r.voxel_m is None}
    assert sorted(r.semantic for r in CLASSES) == [*range(7, 10), *range(11, 18), *range(19, 23), 34, *range(36, 42)]


def test_gzipped_and_big_endian_tiles_are_the_same(root) -> None:
    expected = load_raw_scene(root, "0042")
    one, two = tiles_of(root)
    one.with_suffix(".ply.gz").write_bytes(gzip.compress(one.read_bytes()))
    one.unlink()
    write_ply(two, TILES[1], byte_order=">")
    two.with_suffix(".ply.gz").write_bytes(b"the plain file counts")
    scene = load_raw_scene(root, "0042")
    for mine, theirs in zip(scene.instances, expected.instances, strict=True):
        assert mine.id == theirs.id
        assert np.array_equal(mine.points_m, theirs.points_m)
        assert np.array_equal(mine.rgb, theirs.rgb)


def test_tiles_may_lie_in_train_and_test_folders(root) -> None:
    before = load_raw_scene(root, "0042")
    folder = root / "data_3d_semantics"
    (folder / "train").mkdir()
    (folder / FOLDER).rename(folder / "train" / FOLDER)
    assert list_raw_scenes(root) == (FOLDER,)
    after = load_raw_scene(root, "0042")
    assert [len(i.points_m) for i in after.instances] == [len(i.points_m) for i in before.instances]


def test_a_missing_scene_or_no_tiles(root) -> None:
    assert list_raw_scenes(root) == (FOLDER,)
    with pytest.raises(DataError, match=r"no scene '0007'; there are: .*0042"):
        load_raw_scene(root, "0007")
    for path in tiles_of(root):
        path.unlink()
    with pytest.raises(DataError, match=r"static: no tiles"):
        load_raw_scene(root, "0042")
    with pytest.raises(DataError, match=r"data_3d_semantics: no scene"):
        list_raw_scenes(root / "nowhere")


def test_a_scene_of_unknown_classes_only(root) -> None:
    for path in tiles_of(root):
        write_ply(path, vertices(0, (CAR, 300)))
    with pytest.raises(DataError, match=r"static: field 'semantic'"):
        load_raw_scene(root, "0042")


def without(name: str) -> np.ndarray:
    return TILES[1][[field for field, _ in VERTEX if field != name]]


@pytest.mark.parametrize("name", ["x", "blue", "semantic", "instance"])
def test_a_missing_property_is_named(tmp_path, name) -> None:
    vertex = np.array(without(name).tolist(), dtype=[(f, t) for f, t in VERTEX if f != name])
    with pytest.raises(DataError, match=rf"one\.ply: field '{name}' is missing"):
        read_tile(write_ply(tmp_path / "one.ply", vertex))


@pytest.mark.parametrize(
    ("name", "kind", "word"), [("red", "f4", "uchar"), ("semantic", "f4", "int"), ("y", "i4", "f")]
)
def test_a_property_of_another_type_is_named(tmp_path, name, kind, word) -> None:
    vertex = TILES[1].astype([(f, kind if f == name else t) for f, t in VERTEX])
    with pytest.raises(DataError, match=rf"one\.ply: field '{name}' is .*expected {word}"):
        read_tile(write_ply(tmp_path / "one.ply", vertex))


@pytest.mark.parametrize("value", [np.nan, -np.inf, 3e30])
def test_a_coordinate_that_is_none_is_named(tmp_path, value) -> None:
    vertex = TILES[1].copy()
    vertex["y"][7] = value
    with pytest.raises(DataError, match=r"one\.ply: field 'y' of vertex 7 is"):
        read_tile(write_ply(tmp_path / "one.ply", vertex))


def test_an_ascii_file_is_refused_with_what_to_do(tmp_path) -> None:
    with pytest.raises(DataError, match=r"one\.ply: field 'format': ascii PLY; write it as binary"):
        read_tile(write_ply(tmp_path / "one.ply", TILES[1], text=True))


@pytest.mark.parametrize("gzipped", [False, True])
def test_a_file_cut_short_is_refused_wherever_it_is_cut(tmp_path, gzipped) -> None:
    whole = write_ply(tmp_path / "one.ply", TILES[1]).read_bytes()
    path = tmp_path / "one.ply"
    if gzipped:
        whole, path = gzip.compress(whole), tmp_path / "one.ply.gz"
    for length in (0, 1, 4, 100, len(whole) // 2, len(whole) - 9):
        path.write_bytes(whole[:length])
        with pytest.raises(DataError, match=r"one\.ply"):
            read_tile(path)


@pytest.mark.parametrize("count", [10**12, 10**30, -3])
@pytest.mark.parametrize("extra", [b"", b"element face 1000000000000\nproperty list uint int corners\n"])
def test_a_header_that_claims_too_much_allocates_nothing(tmp_path, count, extra) -> None:
    path = write_ply(tmp_path / "one.ply", TILES[1])
    data = path.read_bytes().replace(b"vertex %d" % len(TILES[1]), b"vertex %d" % count)
    path.write_bytes(data.replace(b"end_header", extra + b"end_header"))
    tracemalloc.start()
    try:
        with pytest.raises(DataError, match=r"one\.ply"):
            read_tile(path)
        assert tracemalloc.get_traced_memory()[1] < 2_000_000
    finally:
        tracemalloc.stop()


def mutated(data: bytes, header: int, rng: np.random.Generator) -> bytes:
    """A file with bytes changed, cut out, put in or doubled; in the header more often than among the points."""
    out = bytearray(data)
    for _ in range(rng.integers(1, 4)):
        position = int(rng.integers(0, header if rng.random() < 0.7 else len(out) + 1))
        junk = rng.integers(0, 256, rng.integers(1, 6), dtype=np.uint8).tobytes()
        digits = str(rng.integers(0, 10 ** int(rng.integers(1, 18)))).encode()
        end = position + int(rng.integers(1, 40))
        kind = rng.integers(0, 5)
        if kind == 0:
            out[position : position + len(junk)] = junk
        elif kind == 1:
            del out[position:end]
        elif kind == 2:
            out[position:position] = out[position:end]
        elif kind == 3:
            out[position : position + 1] = digits
        else:
            del out[position + len(out) // 2 :]
    return bytes(out)


def test_mutated_files_are_read_or_refused(tmp_path) -> None:
    path = write_ply(tmp_path / "one.ply", TILES[1][:200])
    data = path.read_bytes()
    header = data.index(b"end_header") + 11
    rng = np.random.default_rng(0)
    outcomes = []
    for _ in range(600):
        path.write_bytes(mutated(data, header, rng))
        try:
            tile = read_tile(path)
            shapes = {tile.xyz.shape, tile.rgb.shape, (len(tile.semantic), 3), (len(tile.instance), 3)}
            outcomes.append(len(shapes) == 1 and bool(np.isfinite(tile.xyz).all()))
        except DataError as error:
            outcomes.append("refused" if str(path) in str(error) else "file not named")
    assert set(outcomes) == {True, "refused"}
    assert outcomes.count(True) > 30


GOOD = "0 1 0 0 5.0 0 1 0 6.0 0 0 1 1.0\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "at least two lines, this has 0"),
        (GOOD, "at least two lines, this has 1"),
        (GOOD + "1 2 3\n", "in line 2: 3 numbers"),
        (GOOD + GOOD.replace("5.0", "five"), "in line 2: could not convert"),
        (GOOD + "\n" + GOOD.replace("6.0", "nan"), "in line 3: a value is not finite"),
        (GOOD + GOOD.replace("6.0", "1e99"), "in line 2: a value"),
        (GOOD + "\u00e9", "field 'trajectory'"),
    ],
)
def test_a_trajectory_that_is_none(tmp_path, text, message) -> None:
    path = tmp_path / "poses.txt"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(DataError, match=message) as caught:
        read_trajectory(path)
    assert str(path) in str(caught.value)


def test_a_trajectory_in_order_of_line(tmp_path) -> None:
    path = write_trajectory(tmp_path, TRAJECTORY[:5])
    assert np.abs(read_trajectory(path) - TRAJECTORY[:5]).max() < 1e-6
    with pytest.raises(DataError, match=r"poses2\.txt: field 'trajectory'"):
        read_trajectory(path.with_name("poses2.txt"))


def test_reading_leaves_no_file_open(root) -> None:
    path = tiles_of(root)[0]
    tile = read_tile(path)
    path.write_bytes(b"")  # what was read does not depend on the file any more
    for name, column in itertools.chain(zip("xyz", tile.xyz.T, strict=True), [("semantic", tile.semantic)]):
        assert np.array_equal(column, TILES[0][name])
