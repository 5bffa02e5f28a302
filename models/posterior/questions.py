"""Which question narrows a posterior most, and what answers make of it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from models.city.points import Ints
from models.city.types import Floats

WRONG: Final = 0.1  # of people's answers, those that are not what the map has


@dataclass(frozen=True, slots=True, eq=False)
class Answered:
    """What answers tell of positions, for `locate`.

    Attributes:
        cells: [N] about log p(answers | cell).
        at: [M] log p(answers | x) of rows [M] of the surroundings' nodes.
    """

    cells: Floats
    at: Callable[[Ints], Floats]


def with_errors(true: Floats) -> Floats:
    """[..., K] chance of each answer, of which some are wrong.

    Args:
        true: [..., K] chance that each is the right one; they add up to 1.
    """
    others = max(1, true.shape[-1] - 1)
    chance: Floats = (1 - WRONG) * true + WRONG * (1 - true) / others
    return chance


def entropy(mass: Floats) -> float:
    """Bits of a distribution [C]."""
    some = mass[mass > 0]
    return float(-(some * np.log2(some)).sum())


def expected_entropy(mass: Floats, chance: Floats) -> Floats:
    """[Q] bits that are left when each question is answered: H(X | A) = sum_a p(a) H(X | a).

    "I don't know" is as likely anywhere, so it is no answer here.

    Args:
        mass: [C] probability of each place, adding up to 1.
        chance: [Q, C, K] p(a | x) of each question's answers; zeros where a question has fewer than K.
    """
    joint = mass[None, :, None] * chance
    answer = joint.sum(axis=1, keepdims=True)  # p(a)
    # p(a) H(X | a) = - sum_x p(x, a) log p(x | a)
    share = joint / np.maximum(answer, 1e-300)
    left: Floats = -(joint * np.log2(np.maximum(share, 1e-300))).sum(axis=(1, 2))
    return left
