from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
import torch

from models.posterior.locate import best_rows, locate
from models.posterior.posterior import Field, PositionEvidence
from models.posterior.questions import ReplyEvidence

NOTHING = PositionEvidence()
SOMETHING = PositionEvidence(hints=cast(Any, object()))


def posterior_of(nodes_m: np.ndarray, log_p: np.ndarray, starts: list[int], coarse: list[int] | None = None) -> Any:
    """A posterior that is given: [M] log p at nodes [M, 2], of which cell n owns starts[n] to starts[n + 1]."""
    owner = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    grids: list[dict[int, int]] = []  # coarsening of each cell, call by call
    is_coarse = np.isin(np.arange(len(log_p)), np.arange(len(log_p)) if coarse is None else coarse)

    def field(evidence, cells, coarsening=None, *, is_rest=False):
        chosen = np.ones(len(log_p), np.bool_)
        if coarsening is not None:
            grids.append(dict(zip(cells.tolist(), coarsening.tolist(), strict=True)))
            chosen = is_coarse != is_rest
        nodes = np.concatenate([np.flatnonzero((owner == c) & chosen) for c in cells])
        prior = 0.0 if evidence.log_prior is None else evidence.log_prior(nodes_m[nodes])
        prior = prior if evidence.replies is None else prior + evidence.replies.log_p(nodes)
        order = np.argsort(cells)
        number = order[np.searchsorted(cells, owner[nodes], sorter=order)]
        return Field(cells, nodes, number, log_p[nodes] + prior)

    center = [nodes_m[owner == c].mean(axis=0) if (owner == c).any() else (0, 0) for c in range(len(starts) - 1)]
    return SimpleNamespace(
        likelihood=SimpleNamespace(temper=torch.zeros(())), field=field, grids=grids,
        cells=SimpleNamespace(center_m=np.column_stack([center, np.zeros(len(center))]), size_m=30.0), extent_m=1e4,
        surroundings=SimpleNamespace(cell_starts=np.array(starts), positions_m=lambda nodes: nodes_m[nodes]),
        # As they stand, so that cells are looked at in this order.
        cell_scores=lambda _reading, _cells=None: -np.arange(len(starts) - 1.0),
        cells_without_nodes=np.flatnonzero(np.diff(starts) == 0),
    )  # fmt: skip


def test_near_distances_are_right_on_a_map_of_many_kilometres() -> None:
    rng = np.random.default_rng(0)
    near, far = rng.uniform(0, 8, (40, 2)), np.array([9000.0, 7000.0])
    log_p = rng.normal(size=40)
    alone = locate(posterior_of(near, log_p, [0, 20, 40]), NOTHING)
    twice = posterior_of(np.concatenate([near, far + near]), np.concatenate([log_p, log_p - 1e-3]), [0, 20, 40, 60, 80])
    located = locate(twice, NOTHING)
    assert alone is not None
    assert located is not None
    assert located.rows.tolist() == [n for row in alone.rows for n in (row, row + 2)]
    assert located.positions[0] == pytest.approx(alone.positions[0], abs=0.002)
    assert located.positions[3] - far == pytest.approx(alone.positions[1], abs=0.002)


def test_the_first_cell_belongs_to_the_likeliest_place() -> None:
    nodes_m = np.array([[0.0, 0], [200, 0], [210, 0], [220, 0], [0, 300]])
    evidence = PositionEvidence(places=SimpleNamespace(cell_log_p=np.zeros(5)))
    located = locate(posterior_of(nodes_m, np.log([0.3, 0.2, 0.25, 0.2, 0.05]), [0, 1, 2, 3, 4, 5]), evidence)
    assert located is not None
    assert located.rows.tolist()[:2] == [2, 0], "the likeliest cell stands alone"
    assert [mode.probability for mode in located.modes] == pytest.approx([0.65, 0.3, 0.05])
    assert located.modes[0].position_m == pytest.approx(located.positions[0])


def test_a_cell_that_a_prior_rules_out_has_no_mass_and_spoils_no_other() -> None:
    nodes_m = np.array([[0.0, 0], [1, 0], [30, 0], [31, 0], [60, 0]])
    posterior = posterior_of(nodes_m, np.array([0.0, 0.0, 0.0, 0.0, -1.0]), [0, 2, 4, 4, 5])
    located = locate(
        posterior,
        PositionEvidence(log_prior=lambda points_m: np.where(np.isin(points_m[:, 0], (30, 31)), -np.inf, 0.0)),
    )
    assert located is not None
    mass = dict(zip(located.rows.tolist(), located.score.tolist(), strict=True))
    assert mass == pytest.approx({0: np.log(2), 1: -np.inf, 3: -1.0})


def test_a_cell_without_a_coarse_node_is_looked_at_closely() -> None:
    nodes_m = np.array([[0.0, 0], [1, 0], [30, 0], [31, 0], [60, 0]])
    located = locate(posterior_of(nodes_m, np.zeros(5), [0, 2, 4, 5], coarse=[0, 4]), NOTHING)
    assert located is not None
    assert dict(zip(located.rows.tolist(), located.score.tolist(), strict=True)) == pytest.approx(
        {0: np.log(2), 1: np.log(2), 2: 0.0}
    )


def test_a_cell_that_seemed_far_behind_and_is_not_is_looked_at_closely() -> None:
    nodes_m = np.array([[0.0, 0], [1, 0], [30, 0], [31, 0], [60, 0]])
    posterior = posterior_of(nodes_m, np.array([0.0, 0.0, 0.0, 0.0, -30.0]), [0, 2, 4, 5], coarse=[0, 2, 4])
    posterior.cell_scores = lambda _reading, _cells: np.array([0.0, -30.0, -5.0])
    located = locate(posterior, SOMETHING)
    assert posterior.grids == [{0: 2, 2: 2, 1: 4}, {0: 2, 1: 4}]
    assert located is not None
    assert dict(zip(located.rows.tolist(), located.score.tolist(), strict=True)) == pytest.approx(
        {0: np.log(2), 1: np.log(2), 2: -30.0}
    )


def test_answers_bring_in_cells_that_were_not_listed() -> None:
    nodes_m = np.array([[0.0, 0], [30, 0], [60, 0], [90, 0]])
    posterior = posterior_of(nodes_m, np.zeros(4), [0, 1, 2, 3, 4])
    before = locate(posterior, NOTHING, candidates=2)
    log_p = np.array([-9.0, -9.0, -9.0, 0.0])
    replies = ReplyEvidence(log_p, lambda nodes: log_p[nodes])
    after = locate(posterior, PositionEvidence(replies=replies), candidates=2)
    assert before is not None
    assert after is not None
    assert 3 not in before.rows
    assert after.rows[0] == 3
    assert after.weight[after.points == 3] > 0.9


def test_proposed_cells_replace_the_list_if_its_best_cell_is_among_them(monkeypatch) -> None:
    monkeypatch.setattr("models.posterior.locate.LISTED_CELLS", 2)
    log_p = np.array([0.5, -0.5, 0.1, -2.0, 0.3, -7.0])
    posterior = posterior_of(np.array([[30.0 * n, 0] for n in range(6)]), log_p, list(range(7)))
    good = locate(posterior, SOMETHING, candidates=3, proposed=np.array([3, 4, 0]))
    poor = locate(posterior, SOMETHING, candidates=2, proposed=np.array([3, 4, 1]))
    assert good is not None
    assert poor is not None
    assert (good.is_retrieved, good.rows.tolist()) == (True, [0, 4, 1, 3])
    assert (poor.is_retrieved, poor.rows.tolist()) == (False, [0, 1])
    for located in (good, poor):
        usual = np.median([log_p[row] + row for row in located.rows])  # cell n scores -n
        others = sum(np.exp(usual - row) for row in range(6) if row not in located.rows)
        assert located.other == pytest.approx(others / (others + sum(np.exp(log_p[located.rows]))))


def test_the_mass_of_other_cells_follows_from_those_that_score_like_them() -> None:
    log_p = np.where(np.arange(80) < 40, 0.0, -5.0) - np.arange(80.0)  # as scored, but for the last 40
    posterior = posterior_of(np.array([[30.0 * n, 0] for n in range(80)]), log_p, list(range(81)))
    posterior.cell_scores = lambda _hints, _cells: -np.arange(80.0)
    proposed = np.setdiff1d(np.arange(80), [60])
    located = locate(posterior, SOMETHING, proposed=proposed)
    assert located is not None
    assert located.other == pytest.approx(np.exp(-65.0) / np.exp(log_p).sum(), rel=1e-6)


@pytest.mark.parametrize("possible", [0, 1, 40, 99, 100, 101, 900, 5000])
@pytest.mark.parametrize("differ", [2, 10**6])
def test_the_best_rows_are_those_of_a_sort_whatever_is_ruled_out(possible, differ) -> None:
    rng = np.random.default_rng(possible)
    scores = np.full(5000, -np.inf)
    scores[rng.permutation(5000)[:possible]] = rng.integers(differ, size=possible)
    expected = np.lexsort((np.arange(5000), -scores))[: min(100, possible)]
    assert best_rows(scores, 100).tolist() == expected.tolist()
