import numpy as np
import pytest
import torch

from models.errors import IndexBroken
from models.paper.instance_encoder import CellFeatures
from models.paper.level_table import LevelTable, encode_gallery
from models.paper.levels import level_scores

TEXTS = [
    ["I am north of a red building.", "A bench is west of me.", "There is a tree to my east."],
    ["I stand on a road."],
]


@pytest.fixture(scope="module")
def model(mncl):
    return mncl


@pytest.fixture(scope="module")
def features(city, cells):
    return CellFeatures.from_cells(cells, np.array([i.label for i in city.instances]))


@pytest.fixture(scope="module")
def table(model, features):
    return encode_gallery(model, features)[1]


@pytest.fixture(scope="module")
def texts(model):
    return [model.encode_description(text) for text in TEXTS]


@pytest.mark.parametrize("matching", ["hints", "both"])
def test_scores_are_those_of_the_padded_form(model, features, table, texts, matching) -> None:
    rows = np.array([5, 0, 17, len(features) - 1])
    by_level = table.scores(texts, rows, matching)
    assert set(by_level) == {"instance", "relation"}
    with torch.inference_mode():
        cells = model.embed_cells(features.batch(rows), model.text_encoder.embed(features.labels))
        for n, text in enumerate(texts):
            expected = level_scores(text, cells, ("global", "instance", "relation"), matching)
            for level, scores in by_level.items():
                assert scores[n] == pytest.approx(expected[level][0].numpy(), abs=1e-5)


def test_saved_and_mapped_is_the_same_in_half_precision(model, table, texts, tmp_path) -> None:
    table.save(tmp_path)
    again, rows = LevelTable.load(tmp_path, model.levels), np.arange(9)
    expected = table.scores(texts, rows)
    for level, scores in again.scores(texts, rows).items():
        assert scores == pytest.approx(expected[level], abs=2e-3)
    size = sum((tmp_path / f"levels.{level}.npy").stat().st_size for level in expected)
    assert table.bytes_per_cell * (len(table.starts) - 1) == pytest.approx(size, abs=300), "but for the headers"


def test_missing_or_mixed_levels_are_refused(model, table, tmp_path) -> None:
    with pytest.raises(IndexBroken, match="cannot be read"):
        LevelTable.load(tmp_path, model.levels)
    table.save(tmp_path)
    np.save(tmp_path / "levels.relation.npy", table.vectors["relation"][:-1])
    with pytest.raises(IndexBroken, match="different sizes"):
        LevelTable.load(tmp_path, model.levels)
