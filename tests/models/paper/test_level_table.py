import numpy as np
import pytest
import torch

from models.errors import IndexBroken
from models.paper.instance_encoder import CellFeatures
from models.paper.level_table import FILE, LevelTable, encode_gallery
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


def test_codes_are_rounded_shares_of_the_principal_directions(table) -> None:
    small = table.take(np.arange(40))
    bases = small.fit_bases()
    codes = small.compact(bases).vectors
    for level, vectors in small.vectors.items():
        values, directions = np.linalg.eigh(np.cov(vectors.T, bias=True) + np.outer(*[vectors.mean(axis=0)] * 2))
        assert (np.diff(values) >= 0).all()
        for column in range(3):  # the first directions are far apart
            direction = directions[:, -1 - column]
            shares = np.array([vector @ direction for vector in vectors])
            expected = np.rint(shares / np.abs(shares).max() * 127)
            sign = np.sign(direction @ bases[level][:, column])
            assert np.abs(codes[level][:, column] - sign * expected).max() <= 1
        assert np.abs(codes[level]).max() <= 127


def test_a_compact_table_scores_as_the_exact_one_within_its_error(model, table, texts, tmp_path) -> None:
    compact = table.compact(table.fit_bases())
    compact.save(tmp_path)
    again, rows = LevelTable.load(tmp_path, model.levels), np.arange(9)
    exact = table.scores(texts, rows)
    for level, scores in again.scores(texts, rows).items():
        assert scores == pytest.approx(exact[level], abs=0.02)
        assert np.array_equal(scores, compact.scores(texts, rows)[level])
        basis = again.bases[level]
        for t, text in enumerate(texts):
            hints = text.vectors(level)[0].numpy()
            for n in rows:
                instances = [basis @ code for code in again.vectors[level][again.starts[n] : again.starts[n + 1]]]
                best = [max(hint @ instance for instance in instances) for hint in hints]
                assert scores[t, n] == pytest.approx(np.mean(best), abs=1e-5)
    assert again.bytes_per_cell == pytest.approx(2 * 32 * len(table.vectors["instance"]) / (len(table.starts) - 1))
    size = (tmp_path / FILE).stat().st_size - sum(basis.nbytes for basis in again.bases.values())
    assert again.bytes_per_cell * (len(table.starts) - 1) == pytest.approx(size, abs=8 * len(table.starts) + 1000)


def test_tables_of_other_bases_are_joined_in_those_of_the_first(table, texts) -> None:
    first, second = table.take(np.arange(30)), table.take(np.arange(30, 60))
    compact = first.compact(first.fit_bases()), second.compact(second.fit_bases())
    joined, rows = LevelTable.concatenate(compact), np.arange(60)
    assert joined.bases is compact[0].bases
    exact = table.scores(texts, rows)
    for level, scores in joined.scores(texts, rows).items():
        assert scores == pytest.approx(exact[level], abs=0.05)


def test_missing_or_mixed_levels_are_refused(model, table, tmp_path) -> None:
    with pytest.raises(IndexBroken, match="cannot be read"):
        LevelTable.load(tmp_path, model.levels)
    compact = table.compact(table.fit_bases())
    codes = compact.vectors
    for broken in ({**codes, "relation": codes["relation"][:-1]}, {**codes, "relation": codes["relation"][:, 1:]}):
        LevelTable(compact.starts, broken, compact.bases).save(tmp_path)
        with pytest.raises(IndexBroken, match=r"levels.safetensors cannot be read; rebuild"):
            LevelTable.load(tmp_path, model.levels)
    (tmp_path / FILE).write_bytes(b"no tensors")
    with pytest.raises(IndexBroken, match="cannot be read"):
        LevelTable.load(tmp_path, model.levels)
