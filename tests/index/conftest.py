"""A town of two blocks of cells, as it is shared out."""

import pytest

from index.build.build import IndexJob
from index.build.shard import Shard
from models.paper.checkpoint import save_retriever
from tests.conftest import tiny_osm


@pytest.fixture(scope="session")
def deep_file(made_once):
    return made_once("deep", lambda out: (out / "deep.osm").write_text(tiny_osm(depth_m=600))) / "deep.osm"


@pytest.fixture(scope="session")
def rich_dir(mncl, made_once):
    """Weights with all levels."""
    return made_once("rich", lambda out: save_retriever(mncl, out, {}))


@pytest.fixture(scope="session")
def deep_index(deep_file, rich_dir, made_once):
    """Its index, built at once."""
    return made_once("deep-index", lambda out: IndexJob(deep_file, out, rich_dir, levels=True).build())


@pytest.fixture(scope="session")
def deep_parts(deep_file, rich_dir, made_once):
    """The parts of two shards, which were not merged."""

    def make(out):
        for shard in Shard.all(2):
            IndexJob(deep_file, out, rich_dir, levels=True).make_shard(shard)

    return made_once("deep-parts", make)
