"""What one node makes of a text, compiled: parts of `models.posterior.node_likelihood`, whose arguments they take."""

from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled
from models.posterior.likelihood import HABITS, SPOKEN

TINY: Final = 1e-200  # a product of chances goes into the sum of their logarithms before it is smaller
LEAST_MASS: Final = 1e-3


@compiled
def place_of(ways: Floats, way: int, told: Floats, side: int, hint: int, slip: float) -> float:
    """p(direction) p(distance) of a way for a hint, as `Likelihood.places`."""
    place, relations = slip, ways.shape[1] - 1
    for n in range(relations):
        place += ways[way, n] * told[side, hint, n]
    said_m, spread = told[side, hint, relations], told[side, hint, relations + 1]
    if not np.isnan(said_m):
        off = (ways[way, relations] - said_m) / spread
        place *= np.exp(-0.5 * off * off)
    return place


@compiled
def longest(node: Ints) -> int:
    """How many rows the node with most of them has."""
    most, begin = 0, 0
    for r in range(1, len(node) + 1):
        if r == len(node) or node[r] != node[begin]:
            most, begin = max(most, r - begin), r
    return most


@compiled
def powers_of(among: Floats, most: int) -> Floats:
    """[2, most + 1, 3] what a habit makes of so many that it tells one of."""
    powers = np.ones((len(among), most + 1, HABITS))
    for n in range(len(among)):
        for many in range(2, most + 1):
            for h in range(HABITS):
                powers[n, many, h] = float(many) ** -among[n, h]
    return powers


@compiled
def share_out(
    begin: int, rows: int, number: Ints, whole: npt.NDArray[np.bool_], rank: Ints, by_way: Floats, ranks: Floats,
    powers: Floats, numbers: Floats, share: Floats,
) -> None:  # fmt: skip
    """Fill in pi [rows, 3] of what is around one node, shared among it; `whole` of all, of it from `begin` on."""
    mass = (LEAST_MASS, LEAST_MASS, LEAST_MASS)
    for r in range(rows):
        part = 1.0 if whole[begin + r] else numbers[0]
        for h in range(HABITS):
            nearer = ranks[0, rank[r, 0], h] * ranks[1, rank[r, 1], h] * ranks[2, rank[r, 2], h]
            many = powers[0, rank[r, 3], h] * powers[1, rank[r, 4], h]
            share[r, h] = by_way[number[r], h] * part * nearer * many
        mass = (mass[0] + share[r, 0], mass[1] + share[r, 1], mass[2] + share[r, 2])
    first, second, third = mass[0] ** -numbers[1], mass[1] ** -numbers[1], mass[2] ** -numbers[1]
    for r in range(rows):
        share[r, 0] *= first
        share[r, 1] *= second
        share[r, 2] *= third


@compiled
def log_p_of(
    pairs: int, row: Ints, hint: Ints, fit: Floats, share: Floats, said: Floats, numbers: Floats, habit: Floats,
    sums: Floats, load: Floats,
) -> float:  # fmt: skip
    """Log p(T | x) of pairs of what is around a node and what a hint may mean; in the room of `sums` and `load`."""
    _add_up(pairs, row, hint, fit, share, said, numbers, sums, load)
    highest, mass = -np.inf, 0.0
    for k in range(HABITS):
        mixed = habit[k] + _of_hints(sums, said, k)
        if mixed > highest:
            mass, highest = mass * np.exp(highest - mixed) + 1.0, mixed
        else:
            mass += np.exp(mixed - highest)
    log_p: float = numbers[3] * (highest + np.log(mass))
    return log_p


@compiled
def _add_up(
    pairs: int,
    row: Ints,
    hint: Ints,
    fit: Floats,
    share: Floats,
    said: Floats,
    numbers: Floats,
    sums: Floats,
    load: Floats,
) -> None:
    """Fill in by habit what explains each hint, and then with what is meant twice less; `row` in its order."""
    last = -1
    for h in range(said.shape[1]):
        for k in range(HABITS):
            sums[0, h, k], sums[1, h, k] = 0.0, 0.0
    for n in range(pairs):
        for k in range(HABITS):
            sums[0, hint[n], k] += fit[n] * share[row[n], k]
            load[row[n], k] = 0.0
    for h in range(said.shape[1]):
        for k in range(HABITS):
            sums[2, h, k] = 1.0 / (sums[0, h, k] + said[1, h])
    for n in range(pairs):
        for k in range(HABITS):
            load[row[n], k] += fit[n] * share[row[n], k] * sums[2, hint[n], k]
    for n in range(pairs):
        r = row[n]
        if r != last:
            last = r
            for k in range(HABITS):
                load[r, k] = share[r, k] * (load[r, k] ** -numbers[2] if load[r, k] > 1.0 else 1.0)
        for k in range(HABITS):
            sums[1, hint[n], k] += fit[n] * load[r, k]


@compiled
def _of_hints(sums: Floats, said: Floats, k: int) -> float:
    """Sum of the hints' logarithms by a habit; sums [2 or more, H, 3] of what explains each, then of it meant once."""
    product, found, is_absent = 1.0, 0.0, False
    for h in range(said.shape[1]):
        is_absent |= said[0, h] > SPOKEN
    for h in range(said.shape[1]):
        chance = sums[1, h, k] + said[1, h]
        if is_absent:  # the less there is of it, the likelier
            none = max(np.exp(-3 * sums[0, h, k] / max(said[1, h], 1e-2)), 1e-2)
            found += np.log(chance) * (1 - said[0, h]) + np.log(none) * said[0, h]
        else:
            product *= chance
        if product < TINY:
            found, product = found + np.log(product), 1.0
    log_p: float = found + np.log(product)
    return log_p
