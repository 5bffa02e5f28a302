import math

import numpy as np
import pytest
import torch

from models.citymap.colours import BASIC_PALETTE, KITTI360_PALETTE
from models.language.parsed_hint import RELATIONS
from models.posterior.likelihood import HABITS, MIN_FIT, BoundHints, Likelihood
from models.posterior.neighbours.neighbours import STEP_M
from models.posterior.node_batch import OFFSET_CODES, NodeBatch, colour_words, mean_statements, offset_codes, ranks_of

WORDS = len(colour_words(KITTI360_PALETTE))


def random_hints(rng, hints, labels, absent=0.0, distance=math.nan):
    def shares(size):
        return torch.from_numpy(rng.dirichlet(np.full(size, 0.3), hints).astype(np.float32))

    return BoundHints(
        shares(len(RELATIONS)),
        shares(labels),
        shares(WORDS + 1),
        torch.full((hints,), distance),
        torch.full((hints,), absent),
    )


def around(rng, nodes=5, labels=4, parts=9):
    """Return random neighbours and their offsets; some parts may have none."""
    sizes = rng.integers(0, 5, nodes)
    node = np.repeat(np.arange(nodes), sizes)
    offset = torch.from_numpy(rng.integers(-120, 121, (len(node), 2)).astype(np.int8))
    part = torch.from_numpy(rng.integers(0, parts, len(node)))
    label = torch.from_numpy(rng.integers(0, labels, parts))
    rgb = torch.from_numpy(rng.random((parts, 3)).astype(np.float32))
    rgb[0] = math.nan
    whole = torch.from_numpy(rng.random(len(node)) < 0.8)
    rank = ranks_of(torch.from_numpy(node), offset_codes(offset), label[part])
    looks = label, rgb, torch.arange(parts) % 2 == 0
    return NodeBatch(torch.from_numpy(node), offset_codes(offset), whole, rank, part, *looks, nodes), offset


def relation_fit(model, relation, east, north, is_vague):
    radius = math.hypot(east, north)
    e = {name: float(p.exp()) for name, p in model.named_parameters() if p.ndim == 0}
    top, soft = (float(x) for x in model.on_top_m.exp())
    border_m = float(model.border_m[int(is_vague)].exp())
    on_top = 1 / (1 + math.exp(-(top - radius) / soft))
    total = 0.0
    for n, name in enumerate(RELATIONS):
        if name == "on-top":
            fits = on_top
        elif name == "near":
            fits = (on_top + math.exp(-e["near"] * radius)) / 2
        else:
            angle = math.radians(45 * n)
            along = east * math.sin(angle) + north * math.cos(angle)
            across = abs(east * math.cos(angle) - north * math.sin(angle))
            fits = (1 - on_top) / (1 + math.exp(-(along - across) / border_m))
        total += float(relation[n]) * fits
    return total


def means_of(batch):
    return mean_statements(batch.label, batch.rgb, torch.ones(len(batch.label)), KITTI360_PALETTE)


@torch.no_grad()
def naive(model, bound_hints, batch, offset, palette):
    """Return log p(T | x) of each node by loops."""
    means = means_of(batch)
    eps = []
    for h in range(len(bound_hints.label)):
        share = sum(
            float(bound_hints.label[h, n])
            * sum(float(means[n, w]) * float(bound_hints.colour[h, w]) for w in range(WORDS + 1))
            for n in range(len(means))
        )
        eps.append(math.exp(float(model.background)) + math.exp(float(model.common)) * share)
    words = model.colour_word_p(batch.rgb, palette)
    log_p_of_nodes = []
    for m in range(batch.nodes):
        rows = [r for r in range(len(batch.node)) if int(batch.node[r]) == m]
        mixed = []
        for k in range(HABITS):
            pi = []
            for r in rows:
                radius = float((offset[r].double() * STEP_M).norm())
                log_pi = (float(model.distance[0, k]) * radius + float(model.distance[1, k]) * radius**2 / 10) / 10
                log_pi -= sum(math.log(int(batch.rank[r, 3 + n])) * float(model.among[n, k]) for n in range(2))
                log_pi += sum(float(w[int(batch.rank[r, n]), k]) for n, w in enumerate(model.ranks))
                pi.append(math.exp(log_pi + (0.0 if batch.whole[r] else float(model.partly))))
            mass = sum(pi) + 1e-3
            terms = []
            for r, weight in zip(rows, pi, strict=True):
                east, north = (offset[r].double() * STEP_M).tolist()
                part = int(batch.part[r])
                row = []
                for h in range(len(bound_hints.label)):
                    label = float(bound_hints.label[h, batch.label[part]])
                    colour = float(words[part] @ bound_hints.colour[h, :-1]) + float(bound_hints.colour[h, -1])
                    place = relation_fit(model, bound_hints.relation[h], east, north, batch.is_vague[part])
                    place += math.exp(model.relation_slip)
                    fits = label * colour * place
                    row.append((fits if fits > MIN_FIT else 0.0) * weight / mass ** float(model.crowding))
                terms.append(row)
            first = [sum(t[h] for t in terms) for h in range(len(bound_hints.label))]
            power = math.exp(float(model.twice))
            singles = []
            for t in terms:
                load = sum(t[h] / (first[h] + eps[h]) for h in range(len(t)))
                singles.append((1 + max(0.0, load - 1)) ** -power)
            total = [sum(t[h] * s for t, s in zip(terms, singles, strict=True)) for h in range(len(bound_hints.label))]
            habit = float(model.habit.log_softmax(0)[k])
            mixed.append(habit + sum(math.log(x + e) for x, e in zip(total, eps, strict=True)))
        log_p_of_nodes.append(
            math.exp(float(model.temper)) * float(torch.tensor(mixed, dtype=torch.float64).logsumexp(0))
        )
    return log_p_of_nodes


@pytest.fixture
def model():
    torch.manual_seed(0)
    model = Likelihood()
    with torch.no_grad():
        for p in model.parameters():
            p.add_(0.1 * torch.randn_like(p))
    return model


def test_the_likelihood_is_that_of_a_naive_loop(model):
    for seed in range(4):
        rng = np.random.default_rng(seed)
        batch, offset = around(rng)
        bound_hints = random_hints(rng, 3, 4)
        assert model(bound_hints, batch, KITTI360_PALETTE, means_of(batch)).tolist() == pytest.approx(
            naive(model, bound_hints, batch, offset, KITTI360_PALETTE), abs=2e-3
        )


def test_its_gradients_are_those_of_finite_differences(model):
    rng = np.random.default_rng(1)
    batch, _ = around(rng)
    bound_hints = random_hints(rng, 3, 4, distance=6.0)
    bound_hints.distance_m[1] = math.nan
    loss = model(bound_hints, batch, KITTI360_PALETTE, means_of(batch)).sum()
    loss.backward()
    for name in ("background", "common", "crowding", "colour_spread", "twice", "measured", "near"):
        parameter = dict(model.named_parameters())[name]
        with torch.no_grad():
            values = []
            for step in (1e-2, -1e-2):
                parameter.add_(step)
                values.append(float(model(bound_hints, batch, KITTI360_PALETTE, means_of(batch)).sum()))
                parameter.sub_(step)
        assert float(parameter.grad) == pytest.approx((values[0] - values[1]) / 2e-2, rel=0.05, abs=0.02), name


def test_the_order_of_hints_does_not_matter(model):
    rng = np.random.default_rng(2)
    batch, _ = around(rng)
    bound_hints = random_hints(rng, 5, 4)
    ranked = BoundHints(
        *(
            column.flip(0)
            for column in (
                bound_hints.relation,
                bound_hints.label,
                bound_hints.colour,
                bound_hints.distance_m,
                bound_hints.absent,
            )
        )
    )
    assert torch.allclose(
        model(bound_hints, batch, KITTI360_PALETTE, means_of(batch)),
        model(ranked, batch, KITTI360_PALETTE, means_of(batch)),
        atol=1e-4,
    )


def test_the_winds_share_the_compass(model):
    one = torch.eye(len(RELATIONS))
    bound_hints = BoundHints(
        one, torch.ones(10, 1), torch.ones(10, WORDS + 1), torch.full((10,), math.nan), torch.zeros(10)
    )
    place = model.position_fit(bound_hints, model.relation_table())
    number = {
        name: int(offset_codes(torch.tensor([offset], dtype=torch.int8)))
        for name, offset in {
            "north": (0, 80),
            "northeast": (57, 57),
            "south": (0, -80),
            "west": (-80, 0),
            "here": (1, 2),
        }.items()
    }
    for name in ("north", "northeast", "south", "west"):
        assert RELATIONS[int(place[number[name], :9].argmax())] == name
        assert place[number[name], RELATIONS.index(name)] > 0.9
    assert RELATIONS[int(place[number["here"], :9].argmax())] == "on-top"
    four = place[:, [0, 2, 4, 6, 8]].sum(dim=1)
    assert (four - 1).abs().max() < 0.3, "north, east, south, west and on-top are all there is"


@torch.no_grad()
def test_the_winds_from_what_is_vague_are_softer(model):
    model.border_m.copy_(torch.tensor([-3.0, 0.0]))
    north = torch.eye(len(RELATIONS))[:1]
    bound_hints = BoundHints(
        north, torch.ones(1, 1), torch.ones(1, WORDS + 1), torch.tensor([math.nan]), torch.zeros(1)
    )
    just_east, slip = offset_codes(torch.tensor([[42, 40]], dtype=torch.int8)), float(model.relation_slip.exp())
    exact, vague = (
        float(model.position_fit(bound_hints, table)[just_east]) - slip
        for table in model.relation_table().split(OFFSET_CODES)
    )
    assert exact < 0.05
    assert 0.3 < vague < 0.5


def test_what_is_absent_is_not_near(model):
    offset = torch.tensor([[0, 40]], dtype=torch.int8)
    node = torch.zeros(1, dtype=torch.long)
    label = torch.zeros(1, dtype=torch.long)
    batch = NodeBatch(
        node, offset_codes(offset), torch.ones(1, dtype=torch.bool), ranks_of(node, offset_codes(offset), label),
        torch.zeros(1, dtype=torch.long), label, torch.full((1, 3), 0.4),
        torch.zeros(1, dtype=torch.bool), 2,
    )  # fmt: skip
    relation = torch.zeros(1, len(RELATIONS))
    relation[0, -1] = 1.0
    colour = torch.zeros(1, WORDS + 1)
    colour[0, -1] = 1.0
    for absent, better in ((0.0, 0), (1.0, 1)):
        bound_hints = BoundHints(relation, torch.ones(1, 1), colour, torch.tensor([math.nan]), torch.tensor([absent]))
        log_p = model(bound_hints, batch, KITTI360_PALETTE, means_of(batch))
        assert int(log_p.argmax()) == better, "node 0 has the thing, node 1 has nothing"


@torch.no_grad()
def test_a_text_of_200_hints_has_a_finite_likelihood(model):
    rng = np.random.default_rng(3)
    batch, offset = around(rng)
    bound_hints = random_hints(rng, 200, 4)
    expected = naive(model, bound_hints, batch, offset, KITTI360_PALETTE)
    assert model(bound_hints, batch, KITTI360_PALETTE, means_of(batch)).tolist() == pytest.approx(expected, rel=1e-4)


@torch.no_grad()
def test_a_hint_is_explained_by_the_object_in_its_direction(model):
    """One of two like objects is in the north and one nearly so; the vague one may be the northern one, too."""
    model.border_m.copy_(torch.tensor([-3.0, 0.0]))
    node, label = torch.zeros(2, dtype=torch.long), torch.zeros(2, dtype=torch.long)
    offset = offset_codes(torch.tensor([[40, 39], [-40, 39]], dtype=torch.int8))
    relation, colour = torch.eye(len(RELATIONS))[:1], torch.eye(WORDS + 1)[-1:]
    bound_hints = BoundHints(relation, torch.ones(1, 1), colour, torch.tensor([math.nan]), torch.zeros(1))
    for vague in (0, 1):
        batch = NodeBatch(
            node, offset, torch.ones(2, dtype=torch.bool), ranks_of(node, offset, label),
            torch.arange(2), label, torch.full((2, 3), 0.4), torch.arange(2) == vague, 1,
        )  # fmt: skip
        best, probability = model.explain(bound_hints, batch, KITTI360_PALETTE, means_of(batch), model.tables())
        assert best.tolist() == [vague]
        assert 0 < float(probability) < 1
        doubtful = BoundHints(relation, torch.full((1, 1), 0.1), colour, bound_hints.distance_m, bound_hints.absent)
        _, less = model.explain(doubtful, batch, KITTI360_PALETTE, means_of(batch), model.tables())
        assert float(less) < 0.2, "at most twice the probability of the label"


def test_ranks_count_what_is_nearer():
    node = torch.tensor([0, 0, 0, 0, 1])
    offset = torch.tensor([[0, 2], [0, 20], [0, 40], [50, 0], [0, 30]], dtype=torch.int8)
    label = torch.tensor([1, 0, 1, 0, 0])
    assert ranks_of(node, offset_codes(offset), label).tolist() == [
        [0, 0, 0, 2, 1],  # on top
        [1, 0, 0, 2, 2],
        [2, 1, 1, 2, 2],
        [3, 1, 0, 2, 1],
        [0, 0, 0, 1, 1],
    ]


def test_what_is_usual_in_a_map():
    label = torch.tensor([0, 0, 1, 0])
    rgb = torch.tensor(KITTI360_PALETTE.centers, dtype=torch.float32)[[0, 0, 2, 2]] / 255
    rgb[2] = math.nan
    means = mean_statements(label, rgb, torch.ones(len(label)), KITTI360_PALETTE)
    words = colour_words(KITTI360_PALETTE)
    assert means[0, words.index("dark-green")] == 0.5
    assert means[0, words.index("gray-green")] == 0.25
    assert means[:, -1].tolist() == [0.75, 0.25]
    assert means[1, :-1].sum() == 0


def test_a_hint_that_nothing_explains_costs_less_where_it_is_usual(model):
    means = torch.tensor([[0.3] * WORDS + [0.9], [0.0] * WORDS + [0.1]])
    bound_hints = BoundHints(
        torch.eye(len(RELATIONS))[:2],
        torch.eye(2),
        torch.eye(WORDS + 1)[[0, 0]],
        torch.full((2,), math.nan),
        torch.zeros(2),
    )
    often, seldom = model.background_p(bound_hints, means)
    assert often > seldom


def test_colours_are_named_by_their_nearest_word(model):
    centers = torch.tensor(BASIC_PALETTE.centers, dtype=torch.float32) / 255
    names = colour_words(BASIC_PALETTE)
    word = model.colour_word_p(centers, BASIC_PALETTE).argmax(dim=1)
    assert [names[i] for i in word] == list(BASIC_PALETTE.words)
    unknown = model.colour_word_p(torch.full((1, 3), math.nan), BASIC_PALETTE)
    assert len(set(unknown[0].tolist())) == 1
