from dataclasses import replace

import numpy as np
import pytest
import torch

from index.answering.ranking import Ranker
from index.evaluation.localizers import posterior_of_map, vectors_of_map
from index.evaluation.robustness import (
    CANDIDATE_COUNTS,
    SOURCES,
    _damage_map,
    candidate_recall,
    nearest_hints,
    robustness,
    robustness_tables,
)
from index.evaluation.trials import Trial, all_trials
from models.citymap.types import Hint
from models.errors import DataError
from models.posterior.model import PosteriorConfig, PosteriorModel, load_posterior
from models.posterior.neighbours.neighbour_index import build_neighbour_index

HINTS = tuple(
    Hint(direction, label, colour)
    for direction, label, colour in (
        ("north", "bench", "green"), ("south", "tree", None), ("east", "road", "gray"),
        ("west", "building", "red"), ("on-top", "footpath", "gray"), ("north", "bollard", None),
    )
)  # fmt: skip


def test_trials_say_what_their_name_says(data_and_queries):
    trials = {trial.name: trial for trial in all_trials(data_and_queries[0])}
    plain = trials["template text"].say(HINTS, np.random.default_rng(0))
    assert plain[0] == "The pose is north of a green bench."
    damaged = {name: trial.say(HINTS, np.random.default_rng(1)) for name, trial in trials.items()}
    assert [len(damaged[f"{n} hints"]) for n in range(1, 6)] == [1, 2, 3, 4, 5]
    assert len(set(damaged["one hint of six wrong"]) - set(plain)) == 1
    assert len(set(damaged["two colours of six wrong"]) - set(plain)) == 2
    assert sorted(damaged["hints in another order"]) == sorted(plain)
    assert damaged["inverse phrasing"][0] == "There is a green bench south of me."
    free = " ".join(damaged["free wording, unseen grammar"])
    assert free not in (" ".join(plain), " ".join(damaged["free wording, three typos"]))


def test_hints_about_the_nearest_things_are_true(source, data_and_queries):
    data, queries = data_and_queries
    subset = queries.take(np.arange(0, len(queries), 3))
    around = build_neighbour_index(source.geometry(), data.cells)
    nearest = nearest_hints(data, subset.positions_m, subset.truth, around, 12)
    assert 6 < max(map(len, nearest)) <= 12
    shared = [
        len({(h.label, h.direction) for h in own} & {(h.label, h.direction) for h in hints[:8]}) / len(own)
        for hints, own, strategy in zip(nearest, subset.hints, subset.strategies, strict=True)
        if strategy == "closest"
    ]
    assert shared
    assert np.mean(shared) > 0.8, "the six nearest things are among the eight nearest"


@pytest.mark.slow
def test_retriever_and_posterior_stand_side_by_side(source, data_and_queries, model, text_encoder):
    torch.manual_seed(0)
    data, queries = data_and_queries
    rows = np.arange(0, len(queries), max(1, len(queries) // 2))
    subset = queries.take(rows)
    ranker = Ranker.from_cells(model, data.cells, data.gallery.labels)
    untrained = PosteriorModel(text_encoder, PosteriorConfig(width=32)).eval()
    untrained.matcher = load_posterior().matcher  # knows the names already
    posterior = posterior_of_map(untrained, data, ranker, build_neighbour_index(source.geometry(), data.cells))
    vectors = vectors_of_map(data, ranker)
    figures = robustness(data, subset, vectors, posterior, lambda *_: None)
    (head, table), *of_candidates = robustness_tables(figures)
    assert len(table) == len(all_trials(data))
    assert all(len(row) == len(head) for row in table)
    for row in figures["trials"]:
        assert 0 <= row["posterior"]["retrieval"]["1"] <= 1
    names = [head[0].split(":")[0] for head, _ in of_candidates]
    assert names == list(figures["candidates"]) == ["template text", "free wording, unseen grammar"]
    assert all(len(rows) == len(SOURCES) for _, rows in of_candidates)
    raw, _, by_list, both = (
        [row["recall"][str(n)] for n in CANDIDATE_COUNTS] for row in candidate_recall(subset, posterior)
    )
    assert all(b >= o for b, o in zip(both, by_list, strict=True)), "both hold what one holds"
    first = [ranker.search([ranker.retriever.encode_description(s)], 10)[1][0] for s in subset.sentences]
    assert raw[0] == pytest.approx(np.mean([t in r for t, r in zip(subset.truth, first, strict=True)]))
    with pytest.raises(DataError, match="the hints behind the texts"):
        robustness(data, replace(subset, hints=None), vectors, posterior, lambda *_: None)


def test_points_of_a_damaged_map_are_those_of_the_parts_that_are_left(data_and_queries) -> None:
    data = data_and_queries[0]
    damage = _damage_map(data, Trial("gone", lambda hints, _rng: (), dropped=0.3), np.random.default_rng(0))
    before, after = data.gallery.cells, damage.data.gallery.cells
    chosen = np.array([3, 0])
    rows = np.concatenate([np.arange(before.parts.starts[n], before.parts.starts[n + 1]) for n in chosen])
    left = damage.is_remaining[rows]
    assert 0 < left.sum() < len(left)
    assert np.array_equal(after.sample(chosen), before.sample(chosen)[left])
