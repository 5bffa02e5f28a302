"""`Likelihood` at the nodes of a map, compiled: node by node, without arrays of all that is around them.

A description in template sentences takes 9.5 ms of CPU less by it, of 54. Training needs the form that torch can
differentiate; `tests/models/posterior/test_node_likelihood.py` compares the two.
"""

from functools import lru_cache
from typing import Final

import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor

from models.citymap.colours import Palette
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled
from models.posterior.likelihood import FAINT, HABITS, Likelihood, Reading
from models.posterior.neighbours.neighbours import Neighbours
from models.posterior.node_batch import OFFSET, RANKS, SECTOR_OF_WAY, WAYS, colour_words, count_ranks, no_counts
from models.posterior.node_sums import log_p_of, longest, place_of, powers_of, share_out

_EAST_WEST: Final = np.array([0, 7, 6, 5, 4, 3, 2, 1, 8, 9, 10, 11])  # of RELATIONS and two more, which side is which
_NORTH_SOUTH: Final = np.array([4, 3, 2, 1, 0, 7, 6, 5, 8, 9, 10, 11])
MIRRORED: Final = np.arange(12), _NORTH_SOUTH, _EAST_WEST, _EAST_WEST[_NORTH_SOUTH]


class NodeLikelihood:
    """As `Likelihood` but for the last bits, where nothing is learnt; weights that change later make no difference.

    Args:
        likelihood: fitted.
        label: [P] label of each of a map's things.
        rgb: [P, 3] colour of each, 0..1, NaN where unknown.
        is_vague: [P] see `MapObjects`.
        palette: the map's colour words.
        usual: as `usual_statements`.
    """

    @torch.inference_mode()
    def __init__(
        self,
        likelihood: Likelihood,
        label: Tensor,
        rgb: Tensor,
        is_vague: npt.NDArray[np.bool_],
        palette: Palette,
        usual: Tensor,
    ) -> None:
        self._model, self._usual = likelihood, usual
        names, centers = colour_words(palette), np.array(palette.centers, np.float64) / 255
        column = np.array([names.index(word) for word in palette.words])
        logs = likelihood.colour_spread, likelihood.colour_slip, likelihood.unknown_colour
        chances = np.array([float(x.exp()) for x in logs])
        self._things = label.numpy(), rgb.numpy(), is_vague, centers, column, chances
        self._ways = np.concatenate([_quarter(table.numpy()) for table in likelihood.ways().split(WAYS)])
        by_way = _quarter(likelihood.log_pi().exp().double().numpy())
        sector = SECTOR_OF_WAY.numpy().astype(np.int8)
        ranks = np.ones((len(RANKS), max(RANKS), HABITS))
        for n, weights in enumerate(likelihood.ranks):
            ranks[n, : len(weights)] = weights.exp().numpy()
        told = likelihood.partly.exp(), likelihood.crowding, likelihood.twice.exp(), likelihood.temper.exp()
        numbers = np.array([float(number) for number in told])
        habit = likelihood.habit.log_softmax(0).double().numpy()
        self._weights = sector, by_way, ranks, likelihood.among.double().numpy(), numbers, habit
        self._slip, self._measured = (float(x.exp()) for x in (likelihood.relation_slip, likelihood.measured))
        self._least = FAINT / (1.0 + self._slip)  # what fits less does so in no direction
        self._place = np.full(len(label), -1, np.int32)  # see `_distinct`
        self._said = lru_cache(maxsize=1)(self._said_by)

    @torch.inference_mode()
    def _said_by(self, reading: Reading) -> tuple[Floats, Floats, tuple[Floats, Floats]]:
        """(said, told) as `_log_p` takes them, and labels [H, L] and colours [H, W + 1]."""
        said = torch.stack([reading.absent, self._model.chance(reading, self._usual)]).double().numpy()
        said_m = reading.distance_m.double().numpy()
        told = np.column_stack([reading.relation.double().numpy(), said_m, self._measured * said_m + 1.0])
        told = np.stack([told[:, order] for order in MIRRORED])
        return said, told, (reading.label.double().numpy(), reading.colour.double().numpy())

    def log_p(self, reading: Reading, around: Neighbours, nodes: int) -> Floats:
        """Return log p(T | x) of nodes [M], from what is around them."""
        said, told, read = self._said(reading)
        parts, part = _distinct(around.part, self._place)
        label, table, fits = _fits(parts, *self._things, *read)
        found: Floats = _log_p(
            nodes, around.node, part, around.way, around.whole, label, table, fits, self._ways, told, self._slip,
            self._least, said, *self._weights,
        )  # fmt: skip
        return found

    def explain(self, reading: Reading, around: Neighbours) -> tuple[Ints, Floats]:
        """[H] the row of what is around one node that explains each hint best, and the chance that something does."""
        said, told, read = self._said(reading)
        label, table, fits = _fits(around.part, *self._things, *read)
        found: tuple[Ints, Floats] = _explained(
            around.way, around.whole, label, table, fits, self._ways, told, self._slip, said, read[0],
            *self._weights[:-1],
        )  # fmt: skip
        return found


def _quarter(table: Floats) -> Floats:
    """[16384, K] of a table [65536, K] of all ways those to the north-east: the others' are alike, but mirrored."""
    square = table.reshape(2 * OFFSET, 2 * OFFSET, -1)[OFFSET:, OFFSET:]
    return np.ascontiguousarray(square).reshape(OFFSET * OFFSET, -1)


@compiled
def _fits(
    parts: Ints, label_of: Ints, rgb_of: Floats, vague_of: npt.NDArray[np.bool_], centers: Floats, column: Ints,
    chances: Floats, label_read: Floats, colour_read: Floats,
) -> tuple[Ints, Ints, Floats]:  # fmt: skip
    """Labels and where the ways from them begin [P], and p(class) p(colour) [P, H] of some things.

    As `Likelihood.parts` and `Likelihood.words`.
    """
    words, (spread, slip, unknown) = colour_read.shape[1] - 1, chances
    label, table = np.empty(len(parts), np.int64), np.empty(len(parts), np.int64)
    fits = np.empty((len(parts), len(label_read)))
    square, chance = np.empty(len(centers)), np.empty(words)
    for n in range(len(parts)):
        label[n], table[n] = label_of[parts[n]], OFFSET * OFFSET * vague_of[parts[n]]
        rgb = rgb_of[parts[n]]
        chance[:] = slip
        for c in range(len(centers)):
            square[c] = (rgb[0] - centers[c, 0]) ** 2 + (rgb[1] - centers[c, 1]) ** 2 + (rgb[2] - centers[c, 2]) ** 2
        if np.isnan(square[0]):
            chance[:] = unknown
        else:
            square[:] = np.exp((square.min() - square) / (2 * spread * spread))
            total = square.sum()
            for c in range(len(centers)):
                chance[column[c]] += square[c] / total
        for h in range(len(label_read)):
            colour = colour_read[h, words]
            for w in range(words):
                colour += chance[w] * colour_read[h, w]
            fits[n, h] = label_read[h, label[n]] * colour
    return label, table, fits


@compiled
def _distinct(part: Ints, place: Ints) -> tuple[Ints, Ints]:
    """The things [P] that rows [R] are of, as they come, and which of these each row is of; `place` is as before."""
    parts, found, count = np.empty(len(part), np.int64), np.empty(len(part), np.int64), 0
    for r in range(len(part)):
        if place[part[r]] < 0:
            place[part[r]], parts[count] = count, part[r]
            count += 1
        found[r] = place[part[r]]
    for n in range(count):
        place[parts[n]] = -1
    return parts[:count].copy(), found


@compiled
def _log_p(
    nodes: int, node: Ints, part: Ints, way: Ints, whole: npt.NDArray[np.bool_], label: Ints, table: Ints, fits: Floats,
    ways: Floats, told: Floats, slip: float, least: float, said: Floats, sector_of: Ints, by_way: Floats, ranks: Floats,
    among: Floats, numbers: Floats, habit: Floats,
) -> Floats:  # fmt: skip
    """[M] log p(T | x).

    Args:
        nodes: M.
        node: [R] of each thing around them, ascending.
        part: [R] which of the next.
        way: [R, 2] see `Neighbours`.
        whole: [R] likewise.
        label: [P] of each part.
        table: [P] row of `ways` at which those from it begin.
        fits: [P, H] p(class) p(colour).
        ways: [2 * 16384, 11] p(relation) of each way to the north-east from what is exact, then from what is vague;
            last, its metres.
        told: [4, H, 12] p(relation) of each hint, the metres that it says, NaN for none, and their spread; as it is,
            and as it is of ways to the south-east, the north-west and the south-west if these are mirrored.
        slip: chance of a wrong direction.
        least: what fits a hint less than this is left to chance in any direction.
        said: [2, H] chance that the text says there is none of it, and of what nothing explains.
        sector_of: [65536] of each way.
        by_way: [16384, 3] pi of each way to the north-east by habit.
        ranks: [3, most, 3] by which a habit heeds those that come behind so many.
        among: [2, 3] powers of how many there are.
        numbers: factor of what is not whole, powers of crowding, of what is meant twice, and of the whole.
        habit: [3] log weights.
    """
    most, begin, hints = longest(node), 0, fits.shape[1]
    powers, share, number = powers_of(among, most), np.empty((most, 3)), np.empty(most, np.int64)
    here, sector, rank = np.empty(most, np.int64), np.empty(most, np.int64), np.empty((most, 5), np.int64)
    room = most * hints + 1
    row, hint, fit = np.empty(room, np.int64), np.empty(room, np.int64), np.empty(room)
    sums, load = np.empty((3, hints, HABITS)), np.empty((most, HABITS))
    may, many = _may_mean(fits, least)
    counts = no_counts(label)
    log_p = np.full(nodes, log_p_of(0, row, hint, fit, share, said, numbers, habit, sums, load))
    while begin < len(node):
        end, pairs = begin, 0
        while end < len(node) and node[end] == node[begin]:
            r = end - begin
            x, y = max(int(way[end, 0]), 1 - OFFSET), max(int(way[end, 1]), 1 - OFFSET)
            number[r], side = abs(x) * OFFSET + abs(y), 2 * (x < 0) + (y < 0)
            seen = number[r] + table[part[end]]
            here[r], sector[r] = label[part[end]], sector_of[(x + OFFSET) * 256 + y + OFFSET]
            for m in range(many[part[end]]):
                h = may[part[end], m]
                chance = fits[part[end], h] * place_of(ways, seen, told, side, h, slip)
                row[pairs], hint[pairs], fit[pairs] = r, h, chance
                pairs += chance > FAINT  # no branch, which a processor would guess wrong half of the time
            end += 1
        if pairs:
            rows = end - begin
            count_ranks(0, rows, here, sector, counts, rank)
            share_out(begin, rows, number, whole, rank, by_way, ranks, powers, numbers, share)
            log_p[node[begin]] = log_p_of(pairs, row, hint, fit, share, said, numbers, habit, sums, load)
        begin = end
    return log_p


@compiled
def _may_mean(fits: Floats, least: float) -> tuple[Ints, Ints]:
    """[P, H] the hints that each part may be meant by, first of all, and [P] how many they are."""
    may, many = np.zeros(fits.shape, np.int64), np.zeros(len(fits), np.int64)
    for p in range(len(fits)):
        for h in range(fits.shape[1]):
            if fits[p, h] > least:
                may[p, many[p]] = h
                many[p] += 1
    return may, many


@compiled
def _explained(
    way: Ints, whole: npt.NDArray[np.bool_], label: Ints, table: Ints, fits: Floats, ways: Floats, told: Floats,
    slip: float, said: Floats, label_read: Floats, sector_of: Ints, by_way: Floats, ranks: Floats, among: Floats,
    numbers: Floats,
) -> tuple[Ints, Floats]:  # fmt: skip
    """See `NodeLikelihood.explain`; what fits only because a label may be wrong does not explain."""
    (rows, hints), best = fits.shape, np.zeros(fits.shape[1], np.int64)
    most, total, chance = np.zeros(hints), np.zeros(hints), np.empty(hints)
    number, side, sector = np.empty(rows, np.int64), np.empty(rows, np.int64), np.empty(rows, np.int64)
    for r in range(rows):
        x, y = max(int(way[r, 0]), 1 - OFFSET), max(int(way[r, 1]), 1 - OFFSET)
        number[r], side[r] = abs(x) * OFFSET + abs(y), 2 * (x < 0) + (y < 0)
        sector[r] = sector_of[(x + OFFSET) * 256 + y + OFFSET]
    rank, share = np.empty((rows, 5), np.int64), np.empty((rows, 3))
    count_ranks(0, rows, label, sector, no_counts(label), rank)
    share_out(0, rows, number, whole, rank, by_way, ranks, powers_of(among, rows), numbers, share)
    for h in range(hints):
        for r in range(rows):
            term = fits[r, h] * place_of(ways, number[r] + table[r], told, side[r], h, slip) * share[r].mean()
            total[h] += term
            if term > most[h]:
                best[h], most[h] = r, term
        chance[h] = total[h] / (total[h] + said[1, h]) * min(1.0, 2 * label_read[h, label[best[h]]])
    return best, chance
