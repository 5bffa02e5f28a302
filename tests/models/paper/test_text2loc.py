"""The residual hierarchy over hints, the attention within cells and the loss of Text2Loc."""

import math
from dataclasses import replace

import numpy as np
import pytest
import torch

from models.paper.instance_encoder import CellFeatures
from models.paper.layers import CauchyLayer, CauchyTransformer, masked_max
from models.paper.levels import Levels
from models.paper.text2loc import Text2Loc, Text2LocConfig

WIDTH = 16


@pytest.fixture
def model(text_encoder):
    torch.manual_seed(0)
    return Text2Loc(text_encoder, Text2LocConfig(width=WIDTH, hint_layers=2)).eval()


def test_every_layer_over_hints_has_a_residual(model) -> None:
    hints, mask = torch.randn(2, 4, WIDTH), torch.arange(4) < torch.tensor([[4], [2]])
    with torch.no_grad():
        first = hints + model.description[0](hints, mask)
        second = first + model.description[1](first, mask)
        expected = torch.nn.functional.normalize(masked_max(second, mask), dim=-1)
        assert torch.allclose(model.embed_texts(hints, mask).global_vectors, expected, atol=1e-6)


def test_loss_against_a_loop(model) -> None:
    unit = torch.nn.functional.normalize
    text, cells = unit(torch.randn(5, WIDTH), dim=-1), unit(torch.randn(5, WIDTH), dim=-1)
    same = torch.eye(5, dtype=torch.bool)
    same[0, 3] = same[3, 0] = True  # two descriptions of one cell
    scores, total = (text @ cells.T / 0.1).tolist(), 0.0
    for i in range(5):
        columns = [j for j in range(5) if j == i or not same[i, j]]
        total -= math.log(math.exp(scores[i][i]) / sum(math.exp(scores[i][j]) for j in columns))
        total -= math.log(math.exp(scores[i][i]) / sum(math.exp(scores[j][i]) for j in columns))
    mask = torch.ones(5, 1, dtype=torch.bool)
    loss = model.loss(Levels(text, mask), Levels(cells, mask), same)
    assert loss.item() == pytest.approx(total / 10, rel=1e-4)


def norm_layer(x, weight, bias):
    return (x - x.mean()) / math.sqrt(x.var() + 1e-5) * weight + bias


def cauchy_layer_by_loops(weights, features, positions, num_heads):
    """A layer on one unpadded set; attention is softmax, then kernels, then division by the sum."""
    queries, keys, values = (
        features @ w.T + b
        for w, b in zip(
            np.split(weights["attention.in_proj_weight"], 3),
            np.split(weights["attention.in_proj_bias"], 3),
            strict=True,
        )
    )
    scales, shares = np.exp(weights["log_scales"]), np.exp(weights["share_logits"])
    shares, size, rows = shares / shares.sum(), features.shape[1] // num_heads, []
    for i in range(len(features)):
        attended = []
        for head in range(num_heads):
            columns = slice(head * size, (head + 1) * size)
            softmax = np.exp([queries[i, columns] @ key[columns] / math.sqrt(size) for key in keys])
            softmax /= softmax.sum()
            for j in range(len(features)):
                distance = math.dist(positions[i], positions[j])
                softmax[j] *= sum(w / (1 + (distance / gamma) ** 2) for w, gamma in zip(shares, scales, strict=True))
            attended.append(sum(w * value[columns] for w, value in zip(softmax / softmax.sum(), values, strict=True)))
        x = weights["attention.out_proj.weight"] @ np.concatenate(attended) + weights["attention.out_proj.bias"]
        x = norm_layer(features[i] + x, weights["norms.0.weight"], weights["norms.0.bias"])
        hidden = np.maximum(0, weights["feed_forward.0.weight"] @ x + weights["feed_forward.0.bias"])
        x = x + weights["feed_forward.3.weight"] @ hidden + weights["feed_forward.3.bias"]
        rows.append(norm_layer(x, weights["norms.1.weight"], weights["norms.1.bias"]))
    return np.stack(rows)


def test_cauchy_attention_against_loops() -> None:
    torch.manual_seed(0)
    transformer = CauchyTransformer(WIDTH, num_layers=2, num_heads=4, dropout=0.1).eval()
    for parameter in transformer.parameters():
        torch.nn.init.normal_(parameter, std=0.5)
    features, positions = torch.randn(2, 6, WIDTH), 2 * torch.rand(2, 6, 3) - 1
    mask = torch.arange(6) < torch.tensor([[6], [4]])
    positions[1, 4:] = 1e3
    outputs = transformer(features, mask, positions).detach()
    with torch.inference_mode():
        assert torch.allclose(transformer(features, mask, positions), outputs, atol=1e-5)
    assert (outputs[1, 4:] == 0).all()
    layers = [{name: p.detach().double().numpy() for name, p in x.named_parameters()} for x in transformer.layers]
    for b, count in enumerate((6, 4)):
        expected = features[b, :count].double().numpy()
        for weights in layers:
            expected = cauchy_layer_by_loops(weights, expected, positions[b, :count].double().numpy(), 4)
        assert np.allclose(outputs[b, :count].numpy(), expected, atol=1e-4)


def test_cauchy_attention_is_plain_where_all_are_at_one_position() -> None:
    torch.manual_seed(0)
    layer, plain = (
        CauchyLayer(WIDTH, 4, 0.0),
        torch.nn.TransformerEncoderLayer(WIDTH, 4, 2 * WIDTH, 0.0, batch_first=True),
    )
    plain.self_attn.load_state_dict(layer.attention.state_dict())
    for name, part in (("linear1", layer.feed_forward[0]), ("linear2", layer.feed_forward[3])):
        getattr(plain, name).load_state_dict(part.state_dict())
    features, mask = torch.randn(2, 5, WIDTH), torch.ones(2, 5, dtype=torch.bool)
    assert torch.allclose(layer(features, mask, torch.zeros(2, 5, 5)), plain(features), atol=1e-5)
    assert not torch.allclose(layer(features, mask, 9 * (1 - torch.eye(5)).expand(2, 5, 5)), plain(features), atol=1e-2)


def test_cells_attend_by_the_centres_of_their_instances(text_encoder, cells, city) -> None:
    features = CellFeatures.from_cells(cells, np.array([i.label for i in city.instances]))
    labels, batch = text_encoder.embed(features.labels), features.batch(np.arange(6))
    torch.manual_seed(0)
    model = Text2Loc(text_encoder, Text2LocConfig(width=WIDTH, cell_attention="cauchy", inputs=("label",))).eval()
    plain = Text2Loc(text_encoder, Text2LocConfig(width=WIDTH, inputs=("label",))).eval()
    apart = replace(batch, geometry=batch.geometry.clone())
    apart.geometry[..., :3] *= 3
    with torch.no_grad():
        unit = torch.nn.functional.normalize(model.instances.encode_padded(batch, labels), dim=-1)
        expected = masked_max(model.cell(unit, batch.mask, batch.geometry[..., :3]), batch.mask)
        vectors = model.embed_cells(batch, labels).global_vectors
        assert torch.equal(vectors, torch.nn.functional.normalize(expected, dim=-1))
        assert not torch.allclose(model.embed_cells(apart, labels).global_vectors, vectors, atol=1e-4)
        unmoved = plain.embed_cells(batch, labels).global_vectors
        assert torch.equal(plain.embed_cells(apart, labels).global_vectors, unmoved)


def test_scales_and_shares_of_the_kernels_are_learned() -> None:
    torch.manual_seed(0)
    layer = CauchyLayer(WIDTH, 4, 0.0)
    layer(torch.randn(1, 5, WIDTH), torch.ones(1, 5, dtype=torch.bool), torch.rand(1, 5, 5)).square()[
        ..., 0
    ].sum().backward()
    for parameter in (layer.log_scales, layer.share_logits):
        assert (parameter.grad != 0).all()
