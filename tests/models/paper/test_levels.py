"""Similarities and the scene graph against the equations written as loops, and padding that must not leak."""

import numpy as np
import pytest
import torch

from models.paper.levels import Levels, level_scores, set_similarity, sum_of_z_scores
from models.paper.mncl import Mncl, MnclConfig
from models.paper.scene_graph import CellEdges, EdgeTerms, ExternalSpaceAttention, HintEdges, SceneGraph


@pytest.fixture
def sets():
    torch.manual_seed(1)
    unit = torch.nn.functional.normalize
    hints, instances = unit(torch.randn(3, 4, 5), dim=-1), unit(torch.randn(2, 6, 5), dim=-1)
    hint_mask = torch.arange(4) < torch.tensor([[4], [1], [3]])
    instance_mask = torch.arange(6) < torch.tensor([[2], [6]])
    return hints, hint_mask, instances, instance_mask


def test_set_similarity_against_a_loop(sets) -> None:
    hints, hint_mask, instances, instance_mask = sets
    similarity = set_similarity(*sets)
    for q in range(3):
        for n in range(2):
            best = [max(h @ i for i in instances[n, instance_mask[n]]) for h in hints[q, hint_mask[q]]]
            assert similarity[q, n].item() == pytest.approx(sum(best).item() / len(best), abs=1e-6)


def test_similarity_in_both_directions_against_a_loop(sets) -> None:
    hints, hint_mask, instances, instance_mask = (part.numpy() for part in sets)
    similarity = set_similarity(*sets, matching="both")
    for q in range(3):
        for n in range(2):
            h, i = hints[q, hint_mask[q]], instances[n, instance_mask[n]]
            by_hint = [max(float(np.dot(a, b)) for b in i) for a in h]
            by_instance = [max(float(np.dot(a, b)) for a in h) for b in i]
            expected = (sum(by_hint) / len(h) + sum(by_instance) / len(i)) / 2
            assert similarity[q, n].item() == pytest.approx(expected, abs=1e-6)


def test_z_scores_make_levels_comparable() -> None:
    torch.manual_seed(0)
    small, large = torch.rand(3, 50), torch.rand(3, 50) * 100
    total = sum_of_z_scores({"global": small, "instance": large})
    parts = [(s - s.mean(dim=1, keepdim=True)) / s.std(dim=1, keepdim=True, correction=0) for s in (small, large)]
    assert torch.allclose(total, parts[0] + parts[1], atol=1e-4)
    flat = sum_of_z_scores({"global": torch.ones(1, 4)})
    assert torch.isfinite(flat).all()


@pytest.mark.parametrize("aggregate", ["code", "gcn"])
def test_scene_graph_against_a_loop(aggregate) -> None:
    torch.manual_seed(2)
    graph = SceneGraph(4, 2, aggregate, "edges", "edges")
    nodes, ends = torch.randn(1, 3, 4), EdgeTerms(torch.randn(1, 3, 4), torch.randn(1, 3, 4))
    v, e = list(nodes[0]), [[ends.first[0, i] + ends.second[0, j] for j in range(3)] for i in range(3)]
    with torch.no_grad():
        for _ in range(2):
            gathered = [sum(e[i]) / 3 if aggregate == "gcn" else 0 for i in range(3)]
            v = [torch.tanh(graph.node(v[i]) + gathered[i]) for i in range(3)]
            e = [
                [
                    torch.tanh(graph.from_first(v[i]) + graph.from_second(v[j]) + graph.from_edge(e[i][j]))
                    for j in range(3)
                ]
                for i in range(3)
            ]
        relations = []
        for i in range(3):
            weights = torch.stack([graph.attention.key(e[i][j]) for j in range(3)]).softmax(dim=0)
            relations.append(sum(weights[j] * e[i][j] for j in range(3)))
        found_nodes, found_relations = graph(nodes, ends, torch.ones(1, 3, dtype=torch.bool))
    assert torch.allclose(found_nodes[0], torch.stack(v), atol=1e-6)
    assert torch.allclose(found_relations[0], torch.stack(relations), atol=1e-6)


def test_scene_graph_of_the_code_against_a_loop() -> None:
    """A softmax over the first node, times the mapped edge, summed over the second; edges see earlier nodes."""
    torch.manual_seed(2)
    graph = SceneGraph(4, 2, "code", "edges", "code")
    mask = torch.tensor([[True, True, True, False]])
    nodes, ends = torch.randn(1, 4, 4), EdgeTerms(torch.randn(1, 4, 4), torch.randn(1, 4, 4))
    linear = {
        name: (part.weight.detach().numpy(), 0 if part.bias is None else part.bias.detach().numpy())
        for name, part in graph.named_modules()
        if isinstance(part, torch.nn.Linear)
    }

    def apply(name, x):
        weight, bias = linear[name]
        return weight @ x + bias

    v = list(nodes[0, :3].numpy())
    e = {(i, j): (ends.first[0, i] + ends.second[0, j]).numpy() for i in range(3) for j in range(3)}
    for _ in range(2):
        e = {
            (i, j): np.tanh(apply("from_first", v[i]) + apply("from_second", v[j]) + apply("from_edge", e[i, j]))
            for i, j in e
        }
        v = [np.tanh(apply("node", x)) for x in v]
    mapped = {pair: apply("attention.key", x) for pair, x in e.items()}
    with torch.no_grad():
        node_states, relations = graph(nodes, ends, mask)
    for i in range(3):
        assert node_states[0, i].numpy() == pytest.approx(v[i], abs=1e-6)
        expected = np.zeros(4)
        for j in range(3):
            total = sum(np.exp(mapped[first, j]) for first in range(3))
            expected += np.exp(mapped[i, j]) / total * mapped[i, j]
        assert relations[0, i].numpy() == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("query", ["edges", "mixed"])
@pytest.mark.parametrize("axis", ["edges", "channels"])
def test_external_space_attention_against_equation_11(query, axis) -> None:
    """Q = W E, M_E = softmax of Q M, R = sum of M_E * E, for each node over the edges that are real."""
    torch.manual_seed(3)
    attention = ExternalSpaceAttention(4, query, axis)
    if query == "mixed":
        attention.mix.data = torch.tensor([0.7, 1.3])
    edges, real = torch.randn(1, 5, 5, 4), torch.arange(5) < 3
    relations = attention(edges, real[None, None, :, None])
    for i in range(3):
        e = edges[0, i, :3]
        w = 0.7 * torch.eye(3) + 1.3 / 3 * torch.ones(3, 3) if query == "mixed" else torch.eye(3)
        attended = attention.key(w @ e).softmax(dim=0 if axis == "edges" else 1) * e
        assert torch.allclose(relations[0, i], attended.sum(dim=0), atol=1e-6)


def test_edges_are_of_pairs() -> None:
    centers, hints = torch.randn(1, 3, 3), torch.randn(1, 3, 4)
    cell_edges, hint_edges = CellEdges(4), HintEdges(4)
    weight = torch.cat([hint_edges.of_first.weight, hint_edges.of_second.weight], dim=1)
    for i in range(3):
        for j in range(3):
            between = cell_edges.linear(centers[0, i] - centers[0, j])
            assert torch.allclose(cell_edges(centers).edges()[0, i, j], between, atol=1e-6)
            pair = torch.cat([hints[0, i], hints[0, j]])
            expected = torch.nn.functional.linear(pair, weight, hint_edges.of_first.bias)
            assert torch.allclose(hint_edges(hints).edges()[0, i, j], expected, atol=1e-6)


@pytest.mark.parametrize("levels", [("global",), ("global", "instance"), ("global", "relation")])
@pytest.mark.parametrize("loss", ["contrastive", "negative"])
def test_every_row_of_the_ablation_trains(text_encoder, levels, loss) -> None:
    torch.manual_seed(0)
    model = Mncl(text_encoder, MnclConfig(width=16, levels=levels, loss=loss)).train()
    hints, mask = torch.randn(4, 3, 16), torch.ones(4, 3, dtype=torch.bool)
    text = model.embed_texts(hints, mask)
    cells = Levels(
        text.global_vectors.flip(0), mask, *(None if v is None else v.flip(0) for v in (text.instance, text.relation))
    )
    assert list(level_scores(text, cells, model.levels)) == list(levels)
    value = model.loss(text, cells, torch.eye(4, dtype=torch.bool))
    value.backward()
    assert torch.isfinite(value)
    with pytest.raises(ValueError, match="no level"):
        text.vectors("relation" if "instance" in levels or levels == ("global",) else "instance")


def test_the_instance_level_is_of_the_graphs_nodes_or_of_three_linear_layers(text_encoder) -> None:
    torch.manual_seed(0)
    hints, mask, unit = torch.randn(2, 3, 16), torch.ones(2, 3, dtype=torch.bool), torch.nn.functional.normalize
    graph, plain = (
        Mncl(text_encoder, MnclConfig(width=16, levels=("global", "instance", *others))).eval()
        for others in (("relation",), ())
    )
    with torch.no_grad():
        nodes, relations = graph.hint_graph(hints, graph.hint_edges(hints), mask)
        text = graph.embed_texts(hints, mask)
        assert torch.equal(text.vectors("instance"), unit(nodes, dim=-1))
        assert torch.equal(text.vectors("relation"), unit(relations, dim=-1))
        assert torch.equal(plain.embed_texts(hints, mask).vectors("instance"), unit(plain.hint_subspace(hints), dim=-1))
    for subspace in (plain.hint_subspace, plain.cell_subspace):
        assert [type(layer) for layer in subspace[::2]] == [torch.nn.Linear] * 3


def test_the_losses_settings_reach_the_loss(text_encoder) -> None:
    torch.manual_seed(0)
    mask, same = torch.ones(4, 3, dtype=torch.bool), torch.eye(4, dtype=torch.bool)
    unit = torch.nn.functional.normalize
    text, cells = (
        Levels(unit(torch.randn(4, 16), dim=-1), mask, *(unit(torch.randn(4, 3, 16), dim=-1) for _ in range(2)))
        for _ in range(2)
    )

    def loss(**settings):
        return Mncl(text_encoder, MnclConfig(width=16, **settings)).loss(text, cells, same).item()

    assert loss() == loss(least_weight=0.8, exponent=2.0)
    assert len({loss(), loss(least_weight=0.0), loss(least_weight=0.0, exponent=4.0), loss(exponent=0.0)}) == 4
    assert loss(exponent=0.0) == loss(loss="contrastive")
    assert len({loss(), loss(logarithms="one"), loss(matching="both")}) == 3
    assert loss(distance="unit") == loss(distance="unit", least_weight=0.0) != loss(distance="unit", least_weight=0.8)
