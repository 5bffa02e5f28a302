from pathlib import Path

import numpy as np
import pytest

import models
from index.answering.localizer import Localizer
from index.build.artifact import open_version
from index.build.build import IndexJob
from models.sources.osm.extract import Region

SHIPPED_PATH = Path(models.__file__).parent / "maps" / "helsinki.osm.pbf"


@pytest.mark.slow
def test_an_index_of_a_part_of_a_file_knows_that_part_alone(weights_dir, tmp_path) -> None:
    region = Region.parse("24.9440,60.1690,24.9480,60.1710", SHIPPED_PATH)
    built = IndexJob(SHIPPED_PATH, tmp_path, weights_dir, keep_current=True, within=region).build()
    localizer = Localizer.open(tmp_path, weights_dir)
    assert open_version(tmp_path)[1].map_name == "helsinki"
    centers_m = localizer.gallery.cells.center_m
    lat, lon = localizer.frame.to_wgs84(centers_m)
    assert 100 < len(lat) < 2000
    west, south, east, north = region.shape.bounds
    inside = (lon >= west) & (lon <= east) & (lat >= south) & (lat <= north)
    assert np.mean(inside) > 0.8, "cells reach 15 m over the border"
    again = IndexJob(SHIPPED_PATH, tmp_path, weights_dir, keep_current=True, within=region).build()
    assert again == built
    other = Region.parse("24.9440,60.1690,24.9480,60.1712", SHIPPED_PATH)
    assert IndexJob(SHIPPED_PATH, tmp_path, weights_dir, keep_current=True, within=other).build() != built
