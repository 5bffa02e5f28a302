"""An index of a map that a city's own data has joined."""

import pytest

from index.answering.localizer import Localizer
from index.answering.query import Query
from index.build.artifact import open_version
from index.build.build import IndexJob
from index.build.shard import Shard
from models.errors import DataError
from models.sources.extras.layer import ExtraLayer

ROBOTS = "name,lat,lon\nRobo,60.000853,25.001702\nAlf,60.000269,25.000538\nFar,10,10\n"


@pytest.fixture
def layer(tmp_path):
    path = tmp_path / "robots.csv"
    path.write_text(ROBOTS)
    return ExtraLayer.read(path, "parcel robot")


@pytest.mark.slow
def test_an_answer_shows_the_source_of_an_object(osm_file, weights_dir, layer, tmp_path) -> None:
    job = IndexJob(osm_file, tmp_path / "index", weights_dir, keep_current=True, extras=(layer,))
    built = job.build()
    summary = open_version(built)[1].summary
    assert summary.extras == {"robots.csv as parcel robot": 2}
    assert summary.dropped == {"outside the map, in robots.csv": 1}
    localizer = Localizer.open(tmp_path / "index", weights_dir)
    [near, named] = localizer.localize([Query("A parcel robot is north of me."), Query("I am at Robo.")])
    assert {one.source_id for one in near.evidence} <= {"robots.csv/2", "robots.csv/3"}
    assert near.evidence[0].explained > 0.9
    assert [one.source_id for one in named.evidence] == ["robots.csv/2"]
    assert job.build() == built, "nothing has changed"
    without = IndexJob(osm_file, tmp_path / "index", weights_dir, keep_current=True)
    assert without.build() != built, "the data belongs to the map"


@pytest.mark.slow
def test_shards_have_the_data_too(osm_file, weights_dir, layer, tmp_path) -> None:
    whole, shared = (IndexJob(osm_file, tmp_path / name, weights_dir, extras=(layer,)) for name in ("whole", "shared"))
    for shard in Shard.all(2):
        shared.make_shard(shard)
    manifests = [open_version(directory)[1] for directory in (whole.build(), shared.merge(2))]
    assert manifests[0].files == manifests[1].files
    assert manifests[0].summary == manifests[1].summary


def test_only_a_map_can_be_joined(streets, weights_dir, layer, tmp_path) -> None:
    with pytest.raises(DataError, match="--extra needs an OpenStreetMap file"):
        IndexJob(streets, tmp_path / "index", weights_dir, extras=(layer,)).build()
    assert not (tmp_path / "index").exists()
