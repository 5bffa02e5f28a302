"""The likelihood of replies, and the expected entropy after a question (docs/method.md, questions)."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.sparse import csr_array, find

from models.citymap.points import Ints
from models.citymap.types import Floats

WRONG_REPLY_SHARE: Final = 0.1  # assumed, not measured


@dataclass(frozen=True, slots=True, eq=False)
class ReplyEvidence:
    """The evidence of replies about positions."""

    cell_log_p: Floats  # [N] approximate log p(replies | cell)
    log_p: Callable[[Ints], Floats]  # log p(replies | node) of nodes [M]


def with_errors(true: Floats) -> Floats:
    """Return the probability [..., K] of each reply from the probability [..., K] that it is true."""
    others = max(1, true.shape[-1] - 1)
    return (1 - WRONG_REPLY_SHARE) * true + WRONG_REPLY_SHARE * (1 - true) / others


def name_with_errors(true: Floats, names: int, matches: int = 1) -> Floats:
    """Return the probability [...] of a replied name; errors may name anything on the map.

    Args:
        true: [...] probability that the name is true.
        names: number of names of the map.
        matches: number of names that the reply may mean.
    """
    wrong = WRONG_REPLY_SHARE / max(1, names - 1)
    return (1 - WRONG_REPLY_SHARE - wrong) * true + matches * wrong


def entropy(mass: Floats) -> float:
    """Return the entropy of a distribution [C], bits."""
    positive = mass[mass > 0]
    return float(-(positive * np.log2(positive)).sum())


def expected_entropy(mass: Floats, reply_p: Floats) -> Floats:
    """Return the expected entropy [Q] after each question, bits: H(X | A) = sum_a p(a) H(X | a).

    "I don't know" is equally likely everywhere, so it does not count.

    Args:
        mass: [C] probability of each position, adding up to 1.
        reply_p: [Q, C, K] p(a | x) of each question's replies; zeros where a question has fewer than K.
    """
    joint = mass[None, :, None] * reply_p
    marginal = joint.sum(axis=1, keepdims=True)  # p(a)
    # p(a) H(X | a) = - sum_x p(x, a) log p(x | a)
    share = joint / np.maximum(marginal, 1e-300)
    return -(joint * np.log2(np.maximum(share, 1e-300))).sum(axis=(1, 2))


def expected_entropy_of_names(mass: Floats, true: csr_array, names: int) -> float:
    """Return the expected entropy after asking for a name, bits; people without one say "I don't know".

    Args:
        mass: [C] probability of each position, adding up to 1.
        true: [C, K] probability that each name is true; rows may add up to less than 1.
        names: number of names of the map; those without a column are replied in error alone.
    """
    position, name, p = find(true)
    wrong, before = float(name_with_errors(np.zeros(1), names)[0]), entropy(mass)
    # A name that is true nowhere changes nothing, so only the others are added up. Where one of these is wrong, the
    # joint probability is mass * wrong, and the sum of all these logarithms is known.
    column = np.unique(name, return_inverse=True)[1]
    right = mass[position] * name_with_errors(p, names)
    in_error = mass[position] * wrong
    count = int(column.max(initial=-1)) + 1
    marginal = wrong + np.bincount(column, right - in_error, count)  # p(a)
    difference = _log(right) * right - _log(in_error) * in_error
    log_joint = wrong * (np.log2(wrong) - before) + np.bincount(column, difference, count)
    no_reply = 1 - marginal.sum() - (names - count) * wrong
    return float((marginal * _log(marginal) - log_joint).sum() + before * ((names - count) * wrong + no_reply))


def _log(values: Floats) -> Floats:
    return np.log2(np.maximum(values, 1e-300))
