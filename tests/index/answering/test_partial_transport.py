import dataclasses
from itertools import permutations

import numpy as np
import pytest
from scipy.optimize import linprog

from index.answering import partial_transport as module
from index.answering.partial_transport import DEPTH, UNMATCHED_COST, TransportReranker, transport_costs
from index.answering.query import Query
from index.answering.ranking import Ranker
from index.evaluation.evaluation import evaluate
from index.evaluation.localizers import restrict_localizer, vectors_of_map
from models.citymap.cells import CellTable, PartTable
from models.citymap.colours import KITTI360_PALETTE
from models.citymap.gallery import Gallery
from models.citymap.types import Hint

GRAY, BLACK, UNKNOWN = (130, 130, 120), (27, 28, 25), (np.nan,) * 3  # 0..255
TOWARDS = {"north": (0, -1), "south": (0, 1), "east": (-1, 0), "west": (1, 0), "on-top": (0, 0)}


def gallery_of(*cells):
    """Cells of parts (label, colour, east, north)."""
    parts = [part for cell in cells for part in cell]
    at_m = np.array([[east, north, 0.0] for *_, east, north in parts], np.float32).reshape(-1, 3)
    table = PartTable(
        starts=np.cumsum([0, *map(len, cells)]),
        instance=np.arange(len(parts), dtype=np.int32),
        count=np.ones(len(parts), np.int32),
        low_m=at_m,
        high_m=at_m,
        closest_m=at_m,
        rgb=np.array([colour for _, colour, *_ in parts], np.float32).reshape(-1, 3) / 255,
    )
    names = [f"c_{n}" for n in range(len(cells))]
    rows = CellTable(names, ("c",) * len(cells), np.zeros((len(cells), 3)), 30.0, table)
    return Gallery(rows, [label for label, *_ in parts], [None] * len(parts), [None] * len(parts))


def costs(gallery, *hints):
    return TransportReranker(gallery, KITTI360_PALETTE).costs(hints, np.arange(len(gallery.cells)))


def cost_of(plan, pair_costs, towards, at_m):
    """The definition, pair by pair, for a plan [H, I]."""
    hints, parts = plan.shape
    total = UNMATCHED_COST * (1 - plan.sum())
    for h in range(hints):
        for i in range(parts):
            total += plan[h, i] * pair_costs[h, i]
            for k in range(hints):
                for j in range(parts):
                    stated, true = towards[h] - towards[k], at_m[i] - at_m[j]
                    lengths = np.hypot(*stated) * np.hypot(*true)
                    if lengths > 0:
                        total += 0.8 * plan[h, i] * plan[k, j] * (1 - stated @ true / lengths) / 2
    return total


def one_to_one(hints, parts):
    """Every plan of whole hints: each hint has a part of its own, or none."""
    for chosen in set(permutations([*range(parts), *[-1] * hints], hints)):
        plan = np.zeros((hints, parts))
        for h, part in enumerate(chosen):
            if part >= 0:
                plan[h, part] = 1 / hints
        yield plan


def drawn(seed, hints=3, parts=4):
    rng = np.random.default_rng(seed)
    towards = np.array(list(TOWARDS.values()))[rng.integers(5, size=hints)].astype(float)
    pair_costs = rng.choice([0, 0, 0.5, 1, 1.5], size=(hints, parts))
    return pair_costs, towards, rng.uniform(-15, 15, (parts, 2))


def least(pair_costs, towards, at_m):
    return transport_costs(pair_costs[None], towards, at_m[None], np.array([len(at_m)]))[0]


def test_without_layout_the_plan_is_that_of_a_linear_program(monkeypatch) -> None:
    monkeypatch.setattr(module, "LAYOUT_COST", 0.0)
    for seed in range(20):
        hints, parts = 2 + seed % 5, 1 + seed % 6
        pair_costs, towards, at_m = drawn(seed, hints, parts)
        bounds = [np.kron(np.eye(hints), np.ones(parts)), np.kron(np.ones(hints), np.eye(parts))]
        program = linprog((pair_costs - UNMATCHED_COST).ravel(), np.vstack(bounds), np.full(hints + parts, 1 / hints))
        assert least(pair_costs, towards, at_m) == pytest.approx(UNMATCHED_COST + program.fun)


def test_the_plan_with_layout_is_nearly_the_best_of_all() -> None:
    """A quadratic program has several minima; Frank and Wolfe's algorithm ends in one of them."""
    above = []
    for seed in range(60):
        pair_costs, towards, at_m = drawn(seed)
        best = min(cost_of(plan, pair_costs, towards, at_m) for plan in one_to_one(3, 4))
        above.append(least(pair_costs, towards, at_m) - best)
    assert min(above) > -0.05, "a divided hint gains little"
    assert np.mean(np.array(above) < 0.02) > 0.95


def test_the_layout_tells_mirrored_cells_apart() -> None:
    """North of the building and south of the pole: the building lies south of the pole."""
    gallery = gallery_of(
        [("building", GRAY, 0, 9), ("pole", BLACK, 0, -9)], [("building", GRAY, 0, -9), ("pole", BLACK, 0, 9)]
    )
    hints = Hint("north", "building", "gray"), Hint("south", "pole", "black")
    # With mass x of each hint the mirrored cell costs .6 (1 - 2 x) + .8 * 2 x**2, least for x = .375; an angle of 180
    # degrees costs 1 and each pair counts in both orders.
    assert costs(gallery, *hints) == pytest.approx([0.375, 0.0])
    turned = Hint("east", "building", "gray"), Hint("east", "pole", "black")
    assert costs(gallery, *turned) == pytest.approx([0, 0]), "the same direction says nothing about the layout"
    aside = Hint("east", "building"), Hint("on-top", "pole")
    # The angle is 90 degrees: .8 * 2 x**2 / 2 exceeds .6 * 2 x nowhere up to x = 1 / 2, where it is .2.
    assert costs(gallery, *aside) == pytest.approx([0.2, 0.2])


def test_labels_and_colours_cost_what_is_published() -> None:
    gallery = gallery_of(
        [("pole", GRAY, 0, 0)], [("pole", BLACK, 0, 0)], [("pole", UNKNOWN, 0, 0)], [("wall", GRAY, 0, 0)], []
    )
    assert costs(gallery, Hint("west", "pole", "gray")) == pytest.approx([0, 0.5, 0, UNMATCHED_COST, UNMATCHED_COST])
    assert costs(gallery, Hint("west", "pole")) == pytest.approx([0, 0, 0, UNMATCHED_COST, UNMATCHED_COST])


def test_leftover_hints_cost_their_share_and_leftover_parts_nothing() -> None:
    pole = ("pole", GRAY, 3, 3)
    gallery = gallery_of([pole], [pole, pole], [pole, pole, ("wall", GRAY, 1, 1), ("bench", BLACK, 0, 2)])
    two = Hint("north", "pole", "gray"), Hint("north", "pole", "gray")
    assert costs(gallery, *two) == pytest.approx([UNMATCHED_COST / 2, 0, 0]), "a part serves one hint"
    assert costs(gallery, *two, Hint("north", "tree"))[2] == pytest.approx(UNMATCHED_COST / 3)


def test_neither_the_order_of_hints_nor_that_of_parts_matters() -> None:
    for seed in range(20):
        pair_costs, towards, at_m = drawn(seed, 5, 7)
        hints, parts = np.random.default_rng(seed).permutation(5), np.random.default_rng(seed).permutation(7)
        turned = least(pair_costs[hints][:, parts], towards[hints], at_m[parts])
        assert turned == pytest.approx(least(pair_costs, towards, at_m), abs=1e-6)


def test_cells_do_not_affect_each_other() -> None:
    problems = [drawn(seed, 3, parts) for seed, parts in enumerate((2, 6, 4))]
    pair_costs, at_m = np.full((3, 3, 6), 9.0), np.zeros((3, 6, 2))
    for n, (table, _, positions) in enumerate(problems):
        pair_costs[n, :, : table.shape[1]], at_m[n, : len(positions)] = table, positions
    towards = problems[0][1]
    together = transport_costs(pair_costs, towards, at_m, np.array([2, 6, 4]))
    assert together == pytest.approx([least(table, towards, positions) for table, _, positions in problems])


def test_the_right_cell_comes_first_and_the_mass_stays() -> None:
    wrong, right = [("tree", GRAY, 0, 9), ("pole", BLACK, 0, 9)], [("building", GRAY, 0, -9), ("pole", BLACK, 0, 9)]
    gallery = gallery_of(*[wrong] * (DEPTH - 1), right, right)
    ranked = np.arange(DEPTH + 1), -np.arange(DEPTH + 1.0), np.full(DEPTH + 1, 0.04)
    texts = "The pose is north of a gray building.", "The pose is south of a black pole.", "Nice weather."
    rows, scores, probability = TransportReranker(gallery, KITTI360_PALETTE).rerank(texts, ranked)
    assert list(rows) == [DEPTH - 1, *range(DEPTH - 1), DEPTH], "only the first cells move, equal ones keep their order"
    assert list(scores) == [-row for row in rows]
    # The wrong cells leave the building unmatched, .3 more; 48 / 2.5 nats a unit of cost.
    assert probability[1] / probability[0] == pytest.approx(np.exp(-48 * 0.3 / 2.5))
    assert probability[:DEPTH].sum() == pytest.approx(0.04 * DEPTH)
    assert probability[-1] == 0.04


def test_a_text_without_templates_keeps_its_order() -> None:
    reranker = TransportReranker(gallery_of([("pole", GRAY, 0, 0)]), KITTI360_PALETTE)
    ranked = np.arange(1), np.ones(1), np.ones(1)
    assert reranker.rerank(["A pole, and north of it me."], ranked) is ranked
    nothing = np.zeros(0, np.int64), np.zeros(0), np.zeros(0)
    assert reranker.rerank(["The pose is north of a pole."], nothing) is nothing


def test_vector_search_answers_with_the_cells_in_their_new_order(data_and_queries, model) -> None:
    data, queries = data_and_queries
    queries = dataclasses.replace(queries.take(np.arange(40)), hints=None)
    ranker = Ranker.from_cells(model, data.cells, data.gallery.labels)
    plain, again = vectors_of_map(data, ranker), vectors_of_map(data, ranker, rerank="parc")
    changed = 0
    for n in range(10):
        query = Query(" ".join(queries.sentences[n]))
        before, after = (localizer.find([query])[0].located for localizer in (plain, again))
        cost = again.reranker.costs(data_and_queries[1].hints[n], before.rows[:DEPTH])
        order = np.argsort(48 * cost - np.log(before.probability[:DEPTH]), kind="stable")
        assert list(after.rows[:DEPTH]) == list(before.rows[order])
        assert list(after.rows[DEPTH:]) == list(before.rows[DEPTH:])
        assert after.positions[0] == pytest.approx(data.cells.center_m[after.rows[0], :2])
        changed += after.rows[0] != before.rows[0]
    assert changed
    reports = [evaluate(data, queries, localizer) for localizer in (plain, again)]
    assert reports[1]["retrieval"]["5"] > reports[0]["retrieval"]["5"], "an untrained model leaves much to gain"
    assert "re-ranked" in reports[1]["model"]
    near = restrict_localizer(again, data, np.arange(len(data.cells)))
    assert near.find([query])[0].located.rows[0] == after.rows[0]
