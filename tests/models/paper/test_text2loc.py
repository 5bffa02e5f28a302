"""The residual hierarchy over hints and the loss of Text2Loc."""

import math

import pytest
import torch

from models.paper.layers import masked_max
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
