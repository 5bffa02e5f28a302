"""From a posterior over nodes to an answer: cells in order, positions, how far the truth may be, evidence."""

import numpy as np
import numpy.typing as npt

from models.citymap.cells import CellTable
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats
from models.compiled import compiled
from models.posterior.area_filter import Inside
from models.posterior.distribution import Located, heaviest
from models.posterior.likelihood import Reading
from models.posterior.neighbours.nodes import SPACING_M
from models.posterior.places.field import PlaceEvidence
from models.posterior.posterior import CANDIDATES, Field, HintPosterior, LogPrior
from models.posterior.questions import Answered

HIT_M = 6.5  # positions are chosen to have most of the mass this near, softly
PLACE_HIT_M = 10.0  # the same where places are named: what is far away leaves a wider peak
BEHIND = 9.0  # cells this far behind on the coarser grid (nats) are not looked at more closely
MEAN_M = 5.0  # and are then the mean of the mass this near
SOFTENED = 0.86  # mass to this power: what a text gets slightly wrong moves a position less
HEAVY = 256  # nodes that the mass within reach is added up from: the likeliest
TIMES = 2  # as coarse is the grid that cells are looked at on first
FAR = 20.0  # this far behind by the inverted list (nats) on one twice as coarse, unless places are named
_SHARE = 16  # of the scores one is looked at first
_TAIL = 30  # candidates at the end, from which the mass of the cells behind them is guessed


def locate(
    posterior: HintPosterior,
    reading: Reading | None,
    log_prior: LogPrior | None = None,
    inside: Inside | None = None,
    candidates: int = CANDIDATES,
    further: Ints | None = None,
    told: PlaceEvidence | None = None,
    answered: Answered | None = None,
) -> Located | None:
    """Find where a description was said.

    Args:
        posterior: of the gallery.
        reading: hints about what is near, at least one; None for none.
        log_prior: log-density of positions [M, 2], any constant.
        inside: where alone it can be; None for everywhere.
        candidates: cells to look at, the best by the inverted list.
        further: [A] rows of further cells to look at, found in another way.
        told: the places that were named, if any.
        answered: what answers to questions tell, if any.

    Returns:
        None if nothing is inside.
    """
    scores = _cell_scores(posterior, reading, log_prior, inside)
    if told is not None:
        scores = scores + told.cells
    if answered is not None:
        scores = scores + answered.cells
    listed = best_rows(scores, min(candidates, len(scores)))
    if not len(listed):
        return None
    chosen = listed
    if further is not None:
        chosen = np.concatenate([listed, np.setdiff1d(further[scores[further] > -np.inf], listed)])
    score = scores[chosen]
    others = scores
    others[chosen] = -np.inf  # which leaves what is not looked at
    far = score < score[0] - FAR if told is None else np.zeros(len(chosen), np.bool_)
    field = _field(posterior, reading, chosen, np.where(far, 2 * TIMES, TIMES), log_prior, inside, told, answered)
    mass = _mass(field)
    rest = -np.inf
    if (highest := others.max()) > -np.inf:
        tail = slice(max(0, len(listed) - _TAIL), len(listed))
        gap = np.median(mass[tail] - score[tail])
        behind = np.subtract(others, highest, out=others)
        rest = float(gap + highest + np.log(np.exp(behind, out=behind).sum()))
    total = np.logaddexp(np.logaddexp.reduce(mass), rest)
    order = np.lexsort((chosen, -mass))
    weight = np.exp(field.log_p - total)
    nodes_m = posterior.surroundings.positions_m(field.nodes)
    return Located(
        rows=chosen[order],
        score=mass[order],
        probability=np.exp(mass[order] - total),
        other=float(np.exp(rest - total)),
        positions=_positions(field, nodes_m, weight, order, posterior.cells, HIT_M if told is None else PLACE_HIT_M),
        points_m=nodes_m,
        points=field.nodes,
        weight=weight,
        spacing_m=SPACING_M,
        extent_m=posterior.extent_m,
    )


def best_rows(scores: Floats, count: int) -> Ints:
    """The rows of the highest scores, at most so many, highest first, of equal ones the first; none that is -inf."""
    some = scores[::_SHARE]
    some = some[some > -np.inf]  # many that are equal take partition a hundred times as long
    # So many of some scores are at least this high, and so many of all.
    floor = np.partition(some, -count)[-count] if len(some) > count else np.finfo(scores.dtype).min
    rows = np.flatnonzero(scores >= floor)
    high = scores[rows]
    least = np.partition(high, -count)[-count] if len(high) > count else -np.inf
    above = np.flatnonzero(high > least)
    chosen = rows[np.concatenate([above, np.flatnonzero(high == least)[: count - len(above)]])]
    found: Ints = chosen[np.lexsort((chosen, -scores[chosen]))]
    return found


def _field(
    posterior: HintPosterior,
    reading: Reading | None,
    chosen: Ints,
    times: Ints,
    log_prior: LogPrior | None,
    inside: Inside | None,
    told: PlaceEvidence | None,
    answered: Answered | None,
) -> Field:
    """The posterior over the nodes of some cells [K]; of those that are far behind on a coarser grid, that will do.

    The grid is so many times [K] as coarse. All nodes are looked at where some are likelier beforehand and no place is
    named.
    """
    if log_prior is not None and told is None:
        return posterior.field(reading, chosen, log_prior, inside, told, answered)
    rough = posterior.field(reading, chosen, log_prior, inside, told, answered, times)
    mass = _mass(rough)
    near = np.flatnonzero((mass > mass.max() - BEHIND) | (mass == -np.inf))
    fine = posterior.field(reading, chosen[near], log_prior, inside, told, answered, times[near], between=True)
    stands_for = _counts(posterior, chosen, inside) / np.maximum(1, np.bincount(rough.cell, minlength=len(chosen)))
    stands_for[near] = 1.0
    cell = np.concatenate([near[fine.cell], rough.cell])
    log_p = np.concatenate([fine.log_p, rough.log_p + np.log(stands_for)[rough.cell]])
    order = np.argsort(cell, kind="stable")
    return Field(chosen, np.concatenate([fine.nodes, rough.nodes])[order], cell[order], log_p[order])


def _counts(posterior: HintPosterior, chosen: Ints, inside: Inside | None) -> Ints:
    """[K] how many nodes of each of some cells are inside."""
    starts = posterior.surroundings.cell_starts
    count = starts[chosen + 1] - starts[chosen]
    if inside is None:
        return count
    held = inside.holds(posterior.surroundings.positions_m(ranges(starts[chosen], starts[chosen + 1])))
    return np.bincount(np.repeat(np.arange(len(chosen)), count), held, len(chosen)).astype(np.int64)


def _mass(field: Field) -> Floats:
    """[K] log of the mass of each cell of a field, -inf of those without nodes."""
    mass = np.full(len(field.cells), -np.inf)
    if len(field.cell):
        first = np.flatnonzero(np.diff(field.cell, prepend=-1))
        highest = np.maximum.reduceat(field.log_p, first).clip(min=-1e300)  # a prior may be 0
        above = np.exp(field.log_p - np.repeat(highest, np.diff(np.append(first, len(field.cell)))))
        with np.errstate(divide="ignore"):
            mass[field.cell[first]] = highest + np.log(np.add.reduceat(above, first))
    return mass


def _cell_scores(
    posterior: HintPosterior, reading: Reading | None, log_prior: LogPrior | None, inside: Inside | None
) -> Floats:
    """[N] about the log mass of each cell, up to one constant; -inf where no node is, or none that is inside."""
    scores: Floats = np.zeros(len(posterior.surroundings.cell_starts) - 1)
    if reading is not None:
        scores = posterior.cell_scores(reading, None if inside is None else _span(inside.cells))
        scores *= float(posterior.likelihood.temper.detach().exp())
    if log_prior is not None:
        scores = scores + log_prior(posterior.cells.center_m[:, :2])
    scores[posterior.without_nodes if inside is None else ~inside.cells] = -np.inf
    return scores


def _span(cells: npt.NDArray[np.bool_]) -> range:
    """From the first of some cells [N] to the last, which in a city are few of all where a small box has them."""
    rows = np.flatnonzero(cells)
    return range(int(rows[0]), int(rows[-1]) + 1) if len(rows) else range(0)


def _positions(field: Field, nodes_m: Floats, weight: Floats, order: Ints, cells: CellTable, reach_m: float) -> Floats:
    """[K, 2] for each cell, in the given order, the place with most mass within reach.

    Of the first cell anywhere in its cube, which the cells beside it share; of the others in the part that each owns,
    so that they differ.
    """
    best = heaviest(field.cell, weight)
    heavy = np.argpartition(-weight, min(HEAVY, len(weight)) - 1)[:HEAVY]
    centers = np.union1d(heavy, best)
    near_m, share = nodes_m[centers], np.maximum(weight[centers] / max(weight[centers].max(), 1e-300), 1e-30)
    share **= SOFTENED
    near_mass = _mass_near(near_m, share, reach_m)
    owner = field.cell[centers]
    chosen = np.zeros(len(field.cells), np.int64)
    ascending = np.lexsort((near_mass, owner))
    chosen[owner[ascending]] = ascending  # the last of a cell, that with most mass, stays
    apart = np.abs(nodes_m[centers] - cells.center_m[field.cells[order[0]], :2]).max(axis=1)
    chosen[order[0]] = np.where(apart <= cells.size_m / 2, near_mass, -1.0).argmax()
    found: Floats = _mean_near(near_m, share, chosen[order], MEAN_M)
    return found


@compiled
def _mass_near(points_m: Floats, mass: Floats, reach_m: float) -> Floats:
    """[A] mass within reach of each of some points [A, 2], softly."""
    found = mass.copy()
    for a in range(len(mass)):
        for b in range(a):
            falls = _falls(points_m, a, b, reach_m)
            found[a] += falls * mass[b]
            found[b] += falls * mass[a]
    return found


@compiled
def _mean_near(points_m: Floats, mass: Floats, chosen: Ints, reach_m: float) -> Floats:
    """[K, 2] mean of the mass within reach of some chosen ones of points [A, 2]."""
    found = np.zeros((len(chosen), 2))
    for k in range(len(chosen)):
        total, east, north = 0.0, 0.0, 0.0
        for b in range(len(mass)):
            here = mass[b] * _falls(points_m, chosen[k], b, reach_m)
            total, east, north = total + here, east + here * points_m[b, 0], north + here * points_m[b, 1]
        found[k, 0], found[k, 1] = east / total, north / total
    return found


@compiled
def _falls(points_m: Floats, a: int, b: int, reach_m: float) -> float:
    """About 1 up to a distance of two points and 0 beyond."""
    x, y = (points_m[a, 0] - points_m[b, 0]) / reach_m, (points_m[a, 1] - points_m[b, 1]) / reach_m
    square = x * x + y * y
    falls: float = np.exp(-square * square * square) if square < 4.0 else 0.0
    return falls
