"""RET's parts against their equations written as loops."""

import math

import pytest
import torch

from models.paper.levels import Levels
from models.paper.relation_attention import NUM_HEADS, InstanceRelation
from models.paper.ret import HintRelation, RelationLayer, Ret, RetConfig
from models.paper.text2pos import pairwise_ranking_loss

WIDTH = 8
SIZES = [5, 2]
MASK = torch.arange(5) < torch.tensor(SIZES)[:, None]


def test_relation_enhanced_attention_against_a_loop() -> None:
    torch.manual_seed(0)
    layer = RelationLayer(WIDTH, dropout=0.0)
    x, relation = torch.randn(2, 5, WIDTH), torch.randn(2, 5, WIDTH)
    part = WIDTH // NUM_HEADS
    with torch.no_grad():
        attended = layer.attend(x, relation, MASK)
        for b, size in enumerate(SIZES):
            query, key, value = layer.project(x[b]).split(WIDTH, dim=-1)
            value = value + relation[b]
            for i in range(size):
                heads = []
                for h in range(NUM_HEADS):
                    own = slice(h * part, (h + 1) * part)
                    logits = [(query[i, own] @ key[j, own]).item() / math.sqrt(part) for j in range(size)]
                    total = sum(math.exp(v) for v in logits)
                    heads.append(sum(math.exp(v) / total * value[j, own] for j, v in enumerate(logits)))
                assert torch.allclose(attended[b, i], layer.merge(torch.cat(heads)), atol=1e-5)


def test_a_layer_is_attention_and_feed_forward_with_residuals() -> None:
    torch.manual_seed(1)
    layer = RelationLayer(WIDTH, dropout=0.0)
    x, relation = torch.randn(2, 5, WIDTH), torch.randn(2, 5, WIDTH)
    with torch.no_grad():
        attended = layer.attention_norm(x + layer.attend(x, relation, MASK))
        expected = layer.feed_forward_norm(attended + layer.feed_forward(attended))
        assert torch.allclose(layer(x, relation, MASK), expected, atol=1e-6)


def test_relations_against_loops() -> None:
    torch.manual_seed(2)
    centers, hints = torch.randn(2, 5, 3), torch.randn(2, 5, WIDTH)
    of_instances, of_hints = InstanceRelation(WIDTH), HintRelation(WIDTH)
    weight = torch.cat([of_hints.of_first.weight, of_hints.of_second.weight], dim=1)
    with torch.no_grad():
        instance, hint = of_instances(centers, MASK), of_hints(hints, MASK)
        for b, size in enumerate(SIZES):
            for i in range(size):
                differences = [of_instances.linear(centers[b, i] - centers[b, j]) for j in range(size)]
                assert torch.allclose(instance[b, i], torch.stack(differences).amax(dim=0), atol=1e-5)
                pairs = [weight @ torch.cat([hints[b, i], hints[b, j]]) for j in range(size)]
                expected = torch.stack(pairs).amax(dim=0) + of_hints.of_first.bias
                assert torch.allclose(hint[b, i], expected, atol=1e-5)


def test_relations_of_instances_stay_when_the_cell_moves() -> None:
    relation, centers = InstanceRelation(WIDTH), torch.randn(2, 5, 3)
    assert torch.allclose(relation(centers, MASK), relation(centers + 0.7, MASK), atol=1e-5)


def test_loss_is_the_ranking_loss_of_the_global_level(text_encoder) -> None:
    model = Ret(text_encoder, RetConfig(width=WIDTH))
    unit = torch.nn.functional.normalize
    text, cells = unit(torch.randn(4, WIDTH), dim=-1), unit(torch.randn(4, WIDTH), dim=-1)
    mask, same = torch.ones(4, 1, dtype=torch.bool), torch.eye(4, dtype=torch.bool)
    expected = pairwise_ranking_loss(text @ cells.T, same, 0.35)
    assert model.loss(Levels(text, mask), Levels(cells, mask), same).item() == pytest.approx(expected.item())
