from typing import get_args

import numpy as np
import pytest
import torch

from index.answering.ranking import Ranker
from index.evaluation.localizers import restrict_ranker
from models.errors import IndexBroken
from models.paper.levels import Level, level_scores
from models.paper.mncl import Mncl, MnclConfig

TEXTS = [["I am north of a red building.", "A bench is west of me."], ["There is a tree to my east."]]
WEIGHTS = (1.0, 0.7, 0.4)


@pytest.fixture(scope="module")
def weighted(text_encoder):
    torch.manual_seed(0)
    return Mncl(text_encoder, MnclConfig(width=32, level_weights=WEIGHTS)).eval()


@pytest.fixture(scope="module")
def labels(city):
    return [instance.label for instance in city.instances]


@pytest.fixture(scope="module")
def expected(weighted, cells, labels):
    """[Q, N] what the weighted sum over the levels is, padded and all at once."""
    ranker = Ranker.from_cells(weighted, cells, labels)
    texts = weighted.encode_texts(TEXTS)
    table = ranker.table.scores(texts, np.arange(len(cells)))
    whole = (
        np.concatenate([text.global_vectors.numpy() for text in texts]) @ ranker.store.vectors(np.arange(len(cells))).T
    )
    return WEIGHTS[0] * whole + WEIGHTS[1] * table["instance"] + WEIGHTS[2] * table["relation"]


def test_all_levels_on_the_whole_gallery(weighted, cells, labels, expected) -> None:
    ranker = Ranker.from_cells(weighted, cells, labels, depth=len(cells))
    scores, rows = ranker.rank(weighted.encode_texts(TEXTS), len(cells))
    for q in range(len(TEXTS)):
        assert sorted(rows[q]) == list(range(len(cells)))
        assert scores[q] == pytest.approx(np.sort(expected[q])[::-1], abs=1e-5)
        assert expected[q][rows[q]] == pytest.approx(scores[q], abs=1e-5)


def test_the_matching_of_the_retriever_ranks(text_encoder, cells, labels) -> None:
    torch.manual_seed(0)
    both = Mncl(text_encoder, MnclConfig(width=32, level_weights=WEIGHTS, matching="both")).eval()
    ranker, rows = Ranker.from_cells(both, cells, labels), np.arange(9)
    [text] = both.encode_texts(TEXTS[:1])
    expected = WEIGHTS[0] * ranker.store.score(text.global_vectors[0].numpy(), rows)
    by_level = ranker.table.scores([text], rows, "both")
    expected = expected + WEIGHTS[1] * by_level["instance"][0] + WEIGHTS[2] * by_level["relation"][0]
    assert ranker.score(text, rows) == pytest.approx(expected, abs=1e-5)


def test_the_best_of_vector_search_are_reordered_and_stay_first(weighted, cells, labels, expected) -> None:
    plain, deep = (Ranker.from_cells(weighted, cells, labels, depth=depth) for depth in (0, 20))
    texts = weighted.encode_texts(TEXTS)
    (whole, by_whole), (scores, rows) = plain.rank(texts, 50), deep.rank(texts, 50)
    assert np.array_equal(
        by_whole, plain.store.search(np.concatenate([t.global_vectors.numpy() for t in texts]), 50)[1]
    )
    for q in range(len(TEXTS)):
        first = by_whole[q, :20]
        assert list(rows[q, :20]) == list(first[np.argsort(-expected[q][first], kind="stable")])
        assert set(rows[q, 20:]) == set(by_whole[q, 20:])
    assert (np.diff(scores, axis=1) <= 0).all()
    assert (np.diff(whole, axis=1) <= 0).all()


def test_some_cells_score_as_in_the_whole(weighted, cells, labels, expected) -> None:
    ranker, rows = Ranker.from_cells(weighted, cells, labels), np.array([7, 3, 100])
    [text] = weighted.encode_texts(TEXTS[:1])
    assert ranker.score(text, rows) == pytest.approx(expected[0][rows], abs=1e-5)
    scores, order = restrict_ranker(ranker, rows).rank([text], 3)
    assert sorted(scores[0]) == pytest.approx(sorted(expected[0][rows]), abs=1e-5)
    assert sorted(order[0]) == [0, 1, 2]


def test_without_weights_z_scores_are_added(mncl, cells, labels) -> None:
    ranker = Ranker.from_cells(mncl, cells, labels, depth=len(cells))
    texts = mncl.encode_texts(TEXTS)
    scores, _ = ranker.rank(texts, len(cells))
    assert scores.mean(axis=1) == pytest.approx(0, abs=1e-4), "each level is centred on the gallery"
    assert set(level_scores(texts[0], texts[0], get_args(Level))) == set(get_args(Level))


def test_saved_and_loaded_ranks_the_same(weighted, cells, labels, tmp_path) -> None:
    ranker = Ranker.from_cells(weighted, cells, labels)
    ranker.table.compact(ranker.table.fit_bases()).save(tmp_path)
    again, texts = Ranker.load(weighted, tmp_path, ranker.store), weighted.encode_texts(TEXTS)
    assert again.rank(texts, 10)[0] == pytest.approx(ranker.rank(texts, 10)[0], abs=0.02)
    lean = Ranker.load(weighted.global_only(), tmp_path, ranker.store)
    assert lean.table.is_empty
    assert np.array_equal(lean.rank(texts, 10)[1], ranker.search(texts, 10)[1]), "the global level alone"
    (tmp_path / "levels.safetensors").unlink()
    with pytest.raises(IndexBroken, match="levels"):
        Ranker.load(weighted, tmp_path, ranker.store)


def test_cells_are_looked_at_once(weighted, cells, labels, monkeypatch) -> None:
    sizes, embed_cells = [], weighted.embed_cells
    monkeypatch.setattr(
        weighted, "embed_cells", lambda batch, labels: sizes.append(len(batch.mask)) or embed_cells(batch, labels)
    )
    rich = Ranker.from_cells(weighted, cells, labels)
    assert sum(sizes) == len(cells)
    lean = Ranker.from_cells(weighted.global_only(), cells, labels)
    assert lean.table.is_empty
    everything = np.arange(len(cells))
    assert np.array_equal(lean.store.vectors(everything), rich.store.vectors(everything))
