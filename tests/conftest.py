"""A tiny seeded city in the real file format, an untrained model, an index of it, and a client."""

import os

os.environ.setdefault("HF_HUB_OFFLINE", "1")
os.environ["OMP_NUM_THREADS"] = (
    "1"  # before torch: the tests' models are small, and the other CPUs have tests of their own
)

import shutil
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
import torch
from filelock import FileLock

from index.answering.localizer import Localizer
from index.answering.query import Query
from index.build.build import IndexJob
from models.checkpoint import round_weights
from models.citymap.cells import CellTable
from models.citymap.gallery import MapData
from models.citymap.geometry.solids import sample_solid
from models.citymap.map_geometry import MapGeometry, build_geometry, cut_cells
from models.citymap.points import PointTable
from models.citymap.queries import Queries
from models.citymap.types import CityMap
from models.language.text_encoder import TextEncoder, load_text_encoder
from models.paper.checkpoint import save_retriever
from models.paper.mncl import Mncl, MnclConfig
from models.sources.kitti360.job import prepare_data
from models.sources.osm.extent import read_extent
from models.sources.osm.feature_strips import FeatureInstances, FeatureStrips
from models.sources.osm.map import load_osm, read_features
from models.sources.source import MapSource
from tests.milvus_server import SKIPPED, MilvusServer
from tests.models.sources.raw_scenes import TEST_STREET, TRAIN_STREETS, VAL_STREET, write_towns

MadeOnce = Callable[[str, Callable[[Path], object]], Path]
SIZE_M = 300
LAT, LON = 60.0, 25.0
LAT_M, LON_M = 1 / 111_412.0, 1 / 55_800.0  # degrees a metre, near enough at 60 degrees


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put the tests that share a server first, next to each other, so that one worker of a run starts it for all.

    Files with slow tests are next, so that no worker is left alone with them in the end.
    """
    slow = {item.path for item in items if item.get_closest_marker("slow")}

    def rank(item: pytest.Item) -> tuple[str, bool]:
        server = item.get_closest_marker("server")
        return server.args[0] if server else "~", item.path not in slow

    items.sort(key=rank)


@pytest.fixture(scope="session", autouse=True)
def _own_cache(tmp_path_factory):
    """Cache features of sentences and points here, not in the home directory, for all processes of a run."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HEREABOUTS_CACHE_DIR", str(_of_the_run(tmp_path_factory) / "cache"))
        yield


def _of_the_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A directory that all processes of a run share."""
    root = tmp_path_factory.getbasetemp()
    return root.parent if "PYTEST_XDIST_WORKER" in os.environ else root


def tiny_osm(seed: int = 0, depth_m: int | None = None) -> str:
    """A made-up town of 300 x 300 m as OSM XML: streets every 60 m, a house a block, things along the streets."""
    rng, depth_m = np.random.default_rng(seed), depth_m or SIZE_M
    nodes: list[str] = []
    ways: list[str] = []

    def node(x: float, y: float, **tags: str) -> int:
        body = "".join(f'<tag k="{k.replace("__", ":")}" v="{v}"/>' for k, v in tags.items())
        number = len(nodes) + 1
        nodes.append(
            f'<node id="{number}" version="1" lat="{LAT + y * LAT_M:.7f}" lon="{LON + x * LON_M:.7f}">{body}</node>'
        )
        return number

    def way(refs: list[int], **tags: str) -> None:
        body = "".join(f'<nd ref="{r}"/>' for r in refs)
        body += "".join(f'<tag k="{k.replace("__", ":")}" v="{v}"/>' for k, v in tags.items())
        ways.append(f'<way id="{len(ways) + 1}" version="1">{body}</way>')

    for i, offset_m in enumerate(range(0, SIZE_M + 1, 60)):
        if offset_m <= depth_m:
            for half in (0, SIZE_M / 2):  # each street in two ways that touch
                way(
                    [node(half, offset_m), node(half + SIZE_M / 2, offset_m)],
                    highway="residential",
                    name=f"East Street {i}",
                    surface="asphalt",
                )
        way([node(offset_m, 0), node(offset_m, depth_m)], highway="footway", name=f"North Path {i}")
    for x in range(0, SIZE_M, 60):
        for y in range(0, depth_m, 60):
            colour = ["red", "#ffffff", "brown", ""][rng.integers(4)]
            corners = [node(x + 20 + dx, y + 20 + dy) for dx, dy in ((0, 0), (18, 0), (18, 18), (0, 18))]
            tags = {"building": "yes", "building__levels": "3"} | ({"building__colour": colour} if colour else {})
            way([*corners, corners[0]], **tags)
    kinds = [
        {"highway": "street_lamp"},
        {"natural": "tree"},
        {"amenity": "bench", "colour": "green"},
        {"barrier": "bollard"},
        {"amenity": "waste_basket"},
        {"amenity": "post_box", "colour": "yellow"},
    ]
    for _ in range(500 * depth_m // SIZE_M):
        node(*rng.uniform(0, (SIZE_M, depth_m)), **kinds[rng.integers(len(kinds))])
    return "<?xml version='1.0' encoding='UTF-8'?><osm version='0.6'>" + "".join(nodes + ways) + "</osm>"


@pytest.fixture(scope="session")
def made_once(tmp_path_factory: pytest.TempPathFactory) -> MadeOnce:
    """(name, make) -> a directory that `make` has filled, once for all processes of a run; nobody writes to it."""
    root = _of_the_run(tmp_path_factory)

    def made(name: str, make: Callable[[Path], object]) -> Path:
        path = root / "made-once" / name
        path.parent.mkdir(exist_ok=True)
        with FileLock(f"{path}.lock"):
            if not path.exists():
                half = path.with_name(f"{name}.half")
                shutil.rmtree(half, ignore_errors=True)
                half.mkdir()
                make(half)
                half.rename(path)
        return path

    return made


@pytest.fixture(scope="session")
def osm_file(made_once: MadeOnce) -> Path:
    return made_once("map", lambda out: (out / "tinytown.osm").write_text(tiny_osm())) / "tinytown.osm"


@pytest.fixture(scope="session")
def strip_file(made_once: MadeOnce) -> Path:
    """A town with all splits and as little else as can be, for what is trained and measured often."""
    return made_once("strip", lambda out: (out / "strip.osm").write_text(tiny_osm(depth_m=80))) / "strip.osm"


@pytest.fixture(scope="session")
def city(osm_file: Path) -> CityMap:
    return load_osm(osm_file)


@pytest.fixture(scope="session")
def scan(osm_file: Path, city: CityMap) -> CityMap:
    """The same town as points."""
    xyz: dict[str | None, list[Any]] = {}
    with TemporaryDirectory() as directory:
        strips = FeatureStrips(Path(directory), read_features(osm_file, read_extent(osm_file)))
        joined = FeatureInstances.join(strips)
        placed = {each.number: each.feature for number in strips.numbers for each in strips.read(number)}
    for number in np.argsort(joined.rank):
        if joined.feature_instance[number] >= 0:
            first = placed[joined.first[joined.feature_instance[number]]]
            solid = placed[number].solid(0, placed[number].base_m, placed[number].height_m)
            xyz.setdefault(first.source_id, []).append(sample_solid(solid))
    instances = tuple(
        replace(one, points_m=np.concatenate(xyz[one.source_id]).astype(np.float32)) for one in city.instances
    )
    return replace(city, instances=instances, pieces=None)


@pytest.fixture(scope="session")
def points(scan: CityMap) -> PointTable:
    return PointTable.from_map(scan, scan.rules.eps_m)


@pytest.fixture(scope="session")
def geometry(city: CityMap) -> MapGeometry:
    return build_geometry(city)


@pytest.fixture(scope="session")
def cells(city: CityMap, geometry: MapGeometry) -> CellTable:
    return cut_cells(city, geometry)


@pytest.fixture(scope="session")
def source(osm_file: Path, city: CityMap, geometry: MapGeometry, cells: CellTable) -> MapSource:
    """As `open_source` gives it."""
    return MapSource(osm_file, city, geometry, cells)


@pytest.fixture(scope="session")
def regions(osm_file: Path, city: CityMap, geometry: MapGeometry, cells: CellTable) -> list[MapSource]:
    """The west to train on, and the strip beside it to choose by."""
    return [MapSource(osm_file, city, geometry, cells, split) for split in ("train", "val")]


@pytest.fixture(scope="session")
def data_and_queries(source: MapSource) -> tuple[MapData, Queries]:
    """The town, and what it is asked."""
    return source.data, source.queries()


@pytest.fixture(scope="session")
def text_encoder() -> TextEncoder:
    return load_text_encoder()


@pytest.fixture(scope="session")
def model(text_encoder: TextEncoder) -> Mncl:
    """Untrained: its answers mean nothing, its shapes and its determinism do."""
    torch.manual_seed(0)
    made = Mncl(text_encoder, MnclConfig(width=32, levels=("global",)))
    round_weights(made)  # as every process will read it
    return made


@pytest.fixture(scope="session")
def mncl(text_encoder: TextEncoder) -> Mncl:
    """Untrained, with all three levels."""
    torch.manual_seed(0)
    return Mncl(text_encoder, MnclConfig(width=32)).eval()


@pytest.fixture(scope="session")
def weights_dir(model: Mncl, made_once: MadeOnce) -> Path:
    return made_once("weights", lambda out: save_retriever(model, out, {}))


@pytest.fixture(scope="session")
def index_dir(osm_file: Path, weights_dir: Path, made_once: MadeOnce) -> Path:
    return made_once("index", lambda out: IndexJob(osm_file, out, weights_dir).build())


@pytest.fixture(scope="session")
def localizer(index_dir: Path, weights_dir: Path) -> Localizer:
    return Localizer.open(index_dir, weights_dir)


@pytest.fixture(scope="session", autouse=True)
def _compiled_once(request: pytest.FixtureRequest, _own_cache: None) -> None:
    """Compile what answers before a parallel run begins, or each of its processes would, for 35 seconds of CPU."""
    texts = ("A tree is north of me.", "I am on East Street 2 at North Path 3, and a building is on my right.")
    if "PYTEST_XDIST_WORKER" in os.environ:
        made_once, localizer = (request.getfixturevalue(name) for name in ("made_once", "localizer"))
        made_once("compiled", lambda _: localizer.localize([Query(text) for text in texts]))


@pytest.fixture(scope="session")
def raw_root(made_once: MadeOnce) -> Path:
    """Raw KITTI-360: a street of the test split and one of the validation split."""
    return made_once("raw", lambda out: write_towns(out, TEST_STREET, VAL_STREET))


@pytest.fixture(scope="session")
def streets(made_once: MadeOnce) -> Path:
    """A prepared data set: two streets to train on, which lie over each other, and one to choose by."""

    def make(out: Path) -> None:
        write_towns(out / "raw", *TRAIN_STREETS, VAL_STREET)
        prepare_data(out / "raw", out / "prepared")

    return made_once("streets", make) / "prepared"


@pytest.fixture(scope="session")
def milvus_server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[MilvusServer]:
    """A real Milvus."""
    if SKIPPED:
        pytest.skip(SKIPPED)
    server = MilvusServer(tmp_path_factory.mktemp("milvus"))
    try:
        with FileLock(_of_the_run(tmp_path_factory) / "milvus.lock"):  # or two would find the same ports free
            server.start()
        yield server
    finally:
        server.kill()
