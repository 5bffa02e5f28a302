"""Small maps, each with a difficulty that users of OpenStreetMap's tools report."""

from pathlib import Path

import pytest

from index.answering.localizer import Localizer
from index.answering.query import Query
from index.build.build import IndexJob
from models.errors import MapError

MAPS = Path(__file__).parents[4] / "shared/data/maps-hard"
TEXT = "I'm on Mill Street, the Blue Door cafe on my left"
WITH_CAFE = ["neg", "unsorted", "stray", "anti", "josmdel", "history"]
ALL_FACTS_AT_THE_CAFE = {"Mill Street", "cafe"}


def answer(name: str, out: Path, weights_dir: Path):
    if not MAPS.is_dir():
        pytest.skip(f"{MAPS} is not there")
    IndexJob(MAPS / f"{name}.osm", out, weights_dir).build()
    assert [path.name for path in out.iterdir() if path.name.startswith(".building")] == [], "nothing temporary stays"
    (result,) = Localizer.open(out, weights_dir).localize([Query(TEXT)])
    return result


@pytest.mark.slow
@pytest.mark.parametrize("name", WITH_CAFE)
def test_the_cafe_is_beside_the_speaker(name, weights_dir, tmp_path) -> None:
    result = answer(name, tmp_path, weights_dir)
    assert result.estimate.place.endswith("m south of Blue Door")
    assert result.estimate.place.startswith("on Mill Street")
    assert {each.text for each in result.evidence} == ALL_FACTS_AT_THE_CAFE


@pytest.mark.slow
@pytest.mark.parametrize("name", ["addr", "names"])
def test_a_map_without_the_cafe_knows_the_street(name, weights_dir, tmp_path) -> None:
    assert answer(name, tmp_path, weights_dir).estimate.place.startswith("on Mill Street")


@pytest.mark.slow
def test_a_map_whose_streets_have_no_names_claims_none(weights_dir, tmp_path) -> None:
    result = answer("noname", tmp_path, weights_dir)
    assert result.status == "ambiguous"
    assert result.estimate.place is None


def test_a_map_of_two_objects_is_refused(weights_dir, tmp_path) -> None:
    with pytest.raises(MapError, match="too few to tell places apart; take a larger or richer map"):
        answer("sparse", tmp_path / "out", weights_dir)
    assert not (tmp_path / "out").exists()
