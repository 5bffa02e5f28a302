import math

import numpy as np
import pytest
import torch

from models.citymap.colours import KITTI360_PALETTE
from models.posterior.likelihood import Likelihood, Reading
from models.posterior.neighbours.neighbours import Neighbours
from models.posterior.node_batch import NodeBatch, colour_words, usual_statements
from models.posterior.node_likelihood import NodeLikelihood

LABELS, THINGS, NODES = 4, 30, 40
IS_VAGUE = np.arange(THINGS) % 3 == 0
WORDS = len(colour_words(KITTI360_PALETTE))


@pytest.fixture
def model():
    torch.manual_seed(0)
    fitted = Likelihood()
    with torch.no_grad():
        for weight in fitted.parameters():
            weight.add_(torch.randn_like(weight) * 0.3)
    return fitted


def surroundings(rng, most=12) -> Neighbours:
    """What lies around some nodes; around the third there is nothing."""
    node = np.repeat(np.arange(NODES), [0 if n == 2 else int(rng.integers(1, most)) for n in range(NODES)])
    way = rng.integers(-127, 128, (len(node), 2)).astype(np.int8)
    return Neighbours(node, rng.integers(0, THINGS, len(node)), way, rng.random(len(node)) < 0.8)


def batch_of(around, label, rgb) -> NodeBatch:
    return NodeBatch.of(around, NODES, label, rgb, torch.from_numpy(IS_VAGUE))


def reading(rng, hints, absent, metres) -> Reading:
    relation, label, colour = (
        torch.from_numpy(rng.dirichlet(np.full(width, 0.2), hints)).float() for width in (10, LABELS + 1, WORDS + 1)
    )
    return Reading(relation, label[:, :-1], colour, torch.full((hints,), metres), torch.full((hints,), absent))


@pytest.mark.parametrize(
    ("hints", "absent", "metres"), [(1, 0.0, math.nan), (6, 0.0, math.nan), (6, 0.0, 8.0), (4, 0.9, math.nan)]
)
def test_it_is_what_torch_makes_of_it(model, hints, absent, metres) -> None:
    rng = np.random.default_rng(hints)
    label, rgb = torch.from_numpy(rng.integers(0, LABELS, THINGS)), torch.from_numpy(rng.random((THINGS, 3))).float()
    rgb[::5] = math.nan
    label[:LABELS] = torch.arange(LABELS)
    usual = usual_statements(label, rgb, torch.ones(THINGS), KITTI360_PALETTE)
    with torch.no_grad():
        compiled = NodeLikelihood(model, label, rgb, IS_VAGUE, KITTI360_PALETTE, usual)
        for _ in range(3):
            around, said = surroundings(rng), reading(rng, hints, absent, metres)
            expected = model(said, batch_of(around, label, rgb), KITTI360_PALETTE, usual)
            assert np.allclose(compiled.log_p(said, around, NODES), expected.numpy(), rtol=1e-4, atol=1e-4)


def test_a_long_text_does_not_vanish(model) -> None:
    """A product of so many chances is less than any number."""
    rng, label, rgb = np.random.default_rng(0), torch.arange(THINGS) % LABELS, torch.rand(THINGS, 3)
    usual = usual_statements(label, rgb, torch.ones(THINGS), KITTI360_PALETTE)
    with torch.no_grad():
        compiled = NodeLikelihood(model, label, rgb, IS_VAGUE, KITTI360_PALETTE, usual)
        around, said = surroundings(rng), reading(rng, 200, 0.0, math.nan)
        expected = model(said, batch_of(around, label, rgb), KITTI360_PALETTE, usual)
        assert np.allclose(compiled.log_p(said, around, NODES), expected.numpy(), rtol=1e-4)


def test_what_explains_a_hint_is_seen_as_roughly_as_it_is_told_of(model) -> None:
    """Of two things alike, one to the north and one nearly so, the vague one may be the northern too."""
    label, rgb = torch.zeros(2, dtype=torch.long), torch.full((2, 3), 0.4)
    usual = usual_statements(label, rgb, torch.ones(2), KITTI360_PALETTE)
    way = np.array([[40, 39], [-40, 39]], dtype=np.int8)
    around = Neighbours(np.zeros(2, np.int64), np.arange(2), way, np.ones(2, np.bool_))
    relation, colour = torch.eye(10)[:1], torch.eye(WORDS + 1)[-1:]
    said = Reading(relation, torch.ones(1, 1), colour, torch.tensor([math.nan]), torch.zeros(1))
    with torch.no_grad():
        model.border_m.copy_(torch.tensor([-3.0, 0.0]))
        for vague in (0, 1):
            compiled = NodeLikelihood(model, label, rgb, np.arange(2) == vague, KITTI360_PALETTE, usual)
            assert compiled.explain(said, around)[0].tolist() == [vague]
