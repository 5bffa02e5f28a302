"""The distribution over positions: candidate cells, their nodes, and the best position in each (docs/method.md)."""

from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.cells import CellTable
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats
from models.compiled import compiled
from models.posterior.area_filter import AreaFilter
from models.posterior.distribution import PositionDistribution, heaviest
from models.posterior.modes import likeliest_cell
from models.posterior.neighbours.nodes import SPACING_M
from models.posterior.posterior import CANDIDATE_CELLS, Field, HintPosterior, PositionEvidence

# Positions (M31).
PEAK_RADIUS_M, PLACE_PEAK_RADIUS_M = 6.5, 10.0  # the mass within is maximised; far-away places make wider peaks
MEAN_RADIUS_M: Final = 5.0  # the position is the mean of the mass within
WEIGHT_POWER: Final = 0.86  # flattens weights, so that errors of the text move the position less
HEAVY_NODES: Final = 256  # only the heaviest nodes count, which bounds the time
# Grids of the first evaluation, by how far a cell is behind the best one.
COARSENING: Final = 2
MAX_GAP_NATS: Final = 9.0  # by the coarse grid; cells further behind are not evaluated at all nodes
FAR_GAP_NATS: Final = 20.0  # by the inverted list; cells further behind get a grid twice as coarse, without mentions
_SAMPLE_STRIDE: Final = 16  # the sample of scores that bounds the best ones
LISTED_CELLS: Final = 30  # best cells of the list that join the proposed ones (docs/method.md#candidates)
_TAIL_CELLS: Final = 30  # candidates that score most like the others, from which the mass of these is estimated


def locate(
    posterior: HintPosterior,
    evidence: PositionEvidence,
    candidates: int = CANDIDATE_CELLS,
    proposed: Ints | None = None,
) -> PositionDistribution | None:
    """Return the distribution over positions, whose first cell is the best of the likeliest place.

    None if the area contains no node.

    Args:
        posterior: of the gallery.
        evidence: about the position.
        candidates: number of cells to evaluate if the inverted list proposes them, the best by approximate score.
        proposed: [A] cells to evaluate instead, with a few of the list's, unless its best cell is not among them.
    """
    scores = _cell_scores(posterior, evidence)
    is_retrieved = proposed is not None and len(proposed) > 0 and scores[proposed].max() == scores.max()
    chosen = best_rows(scores, min(candidates, len(scores)))
    if proposed is not None and is_retrieved:
        chosen = _in_order(np.union1d(proposed[scores[proposed] > -np.inf], chosen[:LISTED_CELLS]), scores)
    if not len(chosen):
        return None
    score = scores[chosen]
    others = scores
    others[chosen] = -np.inf
    is_far = score < score[0] - FAR_GAP_NATS if evidence.places is None else np.zeros(len(chosen), np.bool_)
    field = _field(posterior, evidence, chosen, np.where(is_far, 2 * COARSENING, COARSENING))
    mass = _log_mass(field)
    rest = -np.inf
    if (highest := others.max()) > -np.inf:
        alike = np.argsort(np.abs(score - highest)[::-1], kind="stable")[:_TAIL_CELLS]
        gap = np.median((mass - score)[::-1][alike])
        behind = np.subtract(others, highest, out=others)
        rest = float(gap + highest + np.log(np.exp(behind, out=behind).sum()))
    total = np.logaddexp(np.logaddexp.reduce(mass), rest)
    order = np.lexsort((chosen, -mass))
    weight = np.exp(field.log_p - total)
    nodes_m = posterior.surroundings.positions_m(field.nodes)
    radius_m = PEAK_RADIUS_M if evidence.places is None else PLACE_PEAK_RADIUS_M
    positions = _positions(field, nodes_m, weight, order, posterior.cells, radius_m)
    best = 0 if evidence.places is None else likeliest_cell(positions, np.exp(mass[order] - total))
    if best > 0:
        order = np.concatenate([order[[best]], np.delete(order, best)])
        positions = _positions(field, nodes_m, weight, order, posterior.cells, radius_m)
    return PositionDistribution(
        rows=chosen[order],
        score=mass[order],
        probability=np.exp(mass[order] - total),
        other=float(np.exp(rest - total)),
        positions=positions,
        points_m=nodes_m,
        points=field.nodes,
        weight=weight,
        spacing_m=SPACING_M,
        extent_m=posterior.extent_m,
        is_retrieved=is_retrieved,
    )


def best_rows(scores: Floats, count: int) -> Ints:
    """Return the rows of at most `count` highest scores, highest first, then in order of rows; none that is -inf."""
    sample = scores[::_SAMPLE_STRIDE]
    sample = sample[sample > -np.inf]  # many equal values slow `partition` down a hundredfold
    # As many scores of the sample, and so of all, are at least this high.
    floor = np.partition(sample, -count)[-count] if len(sample) > count else np.finfo(scores.dtype).min
    rows = np.flatnonzero(scores >= floor)
    high = scores[rows]
    lowest = np.partition(high, -count)[-count] if len(high) > count else -np.inf
    above = np.flatnonzero(high > lowest)
    chosen = rows[np.concatenate([above, np.flatnonzero(high == lowest)[: count - len(above)]])]
    return _in_order(chosen, scores)


def _in_order(rows: Ints, scores: Floats) -> Ints:
    """Return rows by score, highest first, then in order of rows."""
    return rows[np.lexsort((rows, -scores[rows]))]


def _field(posterior: HintPosterior, evidence: PositionEvidence, chosen: Ints, coarsening: Ints) -> Field:
    """Evaluate cells [K] on coarser grids, and those close to the best on all nodes.

    With a prior and without mentions, all nodes are evaluated at once.
    """
    if evidence.log_prior is not None and evidence.places is None:
        return posterior.field(evidence, chosen)
    coarse = posterior.field(evidence, chosen, coarsening)
    mass = _log_mass(coarse)
    near = np.flatnonzero((mass > mass.max() - MAX_GAP_NATS) | (mass == -np.inf))
    fine = posterior.field(evidence, chosen[near], coarsening[near], is_rest=True)
    count = _count_nodes(posterior, chosen, evidence.area)
    nodes_per_coarse_node = count / np.maximum(1, np.bincount(coarse.cell, minlength=len(chosen)))
    nodes_per_coarse_node[near] = 1.0
    cell = np.concatenate([near[fine.cell], coarse.cell])
    log_p = np.concatenate([fine.log_p, coarse.log_p + np.log(nodes_per_coarse_node)[coarse.cell]])
    order = np.argsort(cell, kind="stable")
    return Field(chosen, np.concatenate([fine.nodes, coarse.nodes])[order], cell[order], log_p[order])


def _count_nodes(posterior: HintPosterior, chosen: Ints, area: AreaFilter | None) -> Ints:
    """Return the number [K] of nodes of each cell inside the area."""
    starts = posterior.surroundings.cell_starts
    count = starts[chosen + 1] - starts[chosen]
    if area is None:
        return count
    is_inside = area.contains(posterior.surroundings.positions_m(ranges(starts[chosen], starts[chosen + 1])))
    return np.bincount(np.repeat(np.arange(len(chosen)), count), is_inside, len(chosen)).astype(np.int64)


def _log_mass(field: Field) -> Floats:
    """Return the log mass [K] of each cell; -inf without nodes."""
    mass = np.full(len(field.cells), -np.inf)
    if len(field.cell):
        first = np.flatnonzero(np.diff(field.cell, prepend=-1))
        highest = np.maximum.reduceat(field.log_p, first).clip(min=-1e300)  # a prior may be 0
        above = np.exp(field.log_p - np.repeat(highest, np.diff(np.append(first, len(field.cell)))))
        with np.errstate(divide="ignore"):
            mass[field.cell[first]] = highest + np.log(np.add.reduceat(above, first))
    return mass


def _cell_scores(posterior: HintPosterior, evidence: PositionEvidence) -> Floats:
    """Return the approximate log mass [N] of each cell, up to a constant; -inf without a node inside the area."""
    area, hints = evidence.area, evidence.hints
    scores: Floats = np.zeros(len(posterior.surroundings.cell_starts) - 1)
    if hints is not None:
        scores = posterior.cell_scores(hints, None if area is None else _span(area.has_node))
        scores *= float(posterior.likelihood.temper.detach().exp())
    if evidence.log_prior is not None:
        scores = scores + evidence.log_prior(posterior.cells.center_m[:, :2])
    scores[posterior.cells_without_nodes if area is None else ~area.has_node] = -np.inf
    for part in (evidence.places, evidence.replies):
        if part is not None:
            scores = scores + part.cell_log_p
    return scores


def _span(cells: npt.NDArray[np.bool_]) -> range:
    """Return the range from the first to the last of the selected cells [N]; short for a small area."""
    rows = np.flatnonzero(cells)
    return range(int(rows[0]), int(rows[-1]) + 1) if len(rows) else range(0)


def _positions(field: Field, nodes_m: Floats, weight: Floats, order: Ints, cells: CellTable, radius_m: float) -> Floats:
    """Return the position [K, 2] with the most mass within a radius in each cell, in the given order.

    The position of the first cell may lie anywhere in its cube; those of the others lie in the part that each owns, so
    that they differ.
    """
    best = heaviest(field.cell, weight)
    heavy = np.argpartition(-weight, min(HEAVY_NODES, len(weight)) - 1)[:HEAVY_NODES]
    centers = np.union1d(heavy, best)
    near_m, share = nodes_m[centers], np.maximum(weight[centers] / max(weight[centers].max(), 1e-300), 1e-30)
    share **= WEIGHT_POWER
    near_mass = _mass_near(near_m, share, radius_m)
    owner = field.cell[centers]
    chosen = np.zeros(len(field.cells), np.int64)
    ascending = np.lexsort((near_mass, owner))
    chosen[owner[ascending]] = ascending  # of each cell, the last one stays: that with the most mass
    distance = np.abs(nodes_m[centers] - cells.center_m[field.cells[order[0]], :2]).max(axis=1)
    chosen[order[0]] = np.where(distance <= cells.size_m / 2, near_mass, -1.0).argmax()
    return _mean_near(near_m, share, chosen[order], MEAN_RADIUS_M)


@compiled
def _mass_near(points_m: Floats, mass: Floats, radius_m: float) -> Floats:
    """Return the mass [A] softly within a radius of each point [A, 2]."""
    total = mass.copy()
    for a in range(len(mass)):
        for b in range(a):
            factor = _is_near(points_m, a, b, radius_m)
            total[a] += factor * mass[b]
            total[b] += factor * mass[a]
    return total


@compiled
def _mean_near(points_m: Floats, mass: Floats, chosen: Ints, radius_m: float) -> Floats:
    """Return the mean [K, 2] of the mass softly within a radius of chosen points."""
    means = np.zeros((len(chosen), 2))
    for k in range(len(chosen)):
        total, east, north = 0.0, 0.0, 0.0
        for b in range(len(mass)):
            weight = mass[b] * _is_near(points_m, chosen[k], b, radius_m)
            total, east, north = total + weight, east + weight * points_m[b, 0], north + weight * points_m[b, 1]
        means[k, 0], means[k, 1] = east / total, north / total
    return means


@compiled
def _is_near(points_m: Floats, a: int, b: int, radius_m: float) -> float:
    """Return about 1 for two points within a radius, and 0 beyond."""
    x, y = (points_m[a, 0] - points_m[b, 0]) / radius_m, (points_m[a, 1] - points_m[b, 1]) / radius_m
    square = x * x + y * y
    return np.exp(-square * square * square) if square < 4.0 else 0.0
