"""Which question narrows a posterior most, and what answers make of it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.sparse import csr_array, find

from models.citymap.points import Ints
from models.citymap.types import Floats

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


def said_with_errors(true: Floats, names: int, said: int = 1) -> Floats:
    """[...] chance that a name is said of which any other of a map may be said in error.

    Args:
        true: [...] chance that it is the right one.
        names: K of the map.
        said: how many of these it may mean, where a part of a name is said.
    """
    wrong = WRONG / max(1, names - 1)
    chance: Floats = (1 - WRONG - wrong) * true + said * wrong
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


def expected_entropy_of_names(mass: Floats, true: csr_array, names: int) -> float:
    """Bits that are left when a name is asked for; who has none to say says "I don't know", which leaves all.

    Args:
        mass: [C] probability of each place, adding up to 1.
        true: [C, K] chance that each name is the right one; rows may add up to less than 1.
        names: K of the map; columns of `true` may be fewer, the others are said in error alone.
    """
    place, name, chance = find(true)
    wrong, before = float(said_with_errors(np.zeros(1), names)[0]), entropy(mass)
    # A name that is right nowhere leaves all; only what the others leave needs to be added up. Of each, places where it
    # is wrong have the joint probability m w, of which all logarithms together are known.
    column = np.unique(name, return_inverse=True)[1]
    right = mass[place] * said_with_errors(chance, names)
    in_error = mass[place] * wrong
    count = int(column.max(initial=-1)) + 1
    answer = wrong + np.bincount(column, right - in_error, count)  # p(a)
    some = _log(right) * right - _log(in_error) * in_error
    log_joint = wrong * (np.log2(wrong) - before) + np.bincount(column, some, count)
    nothing = 1 - answer.sum() - (names - count) * wrong
    return float((answer * _log(answer) - log_joint).sum() + before * ((names - count) * wrong + nothing))


def _log(values: Floats) -> Floats:
    logs: Floats = np.log2(np.maximum(values, 1e-300))
    return logs
