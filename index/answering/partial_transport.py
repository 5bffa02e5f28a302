"""PARC-Loc's re-ranking (2026): partial optimal transport between the hints of a text and the parts of a cell.

A transport plan gives each hint to parts of the cell, or leaves it unmatched. It costs something if labels or colours
differ, and if two parts do not lie relative to each other as the directions of their hints say: seen from the person,
a thing that the person is north of lies south of one that the person is south of.

PARC-Loc publishes `DEPTH` and the costs of labels, colours and layout. The other constants, and that parts without a
hint cost nothing, were chosen on validation scenes of synthetic towns.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.optimize import linear_sum_assignment

from models.citymap.cells import PartTable
from models.citymap.colours import Palette
from models.citymap.gallery import Gallery
from models.citymap.points import Ints
from models.citymap.templates import parse_hint
from models.citymap.types import DIRECTIONS, Floats, Hint

DEPTH: Final = 20  # first cells that are ranked again
LABEL_COST, COLOUR_COST, LAYOUT_COST = 1.0, 0.5, 0.8
UNMATCHED_COST: Final = 0.6  # of a hint; less than another label, which is therefore never matched
# The retriever's log-probability less this times the cost orders the cells; the cost alone is worse, and ties often.
NATS_PER_COST: Final = 48.0
TEMPERATURE: Final = 2.5  # that divides the result, so that probabilities are calibrated; it changes no order
MAX_ITERATIONS: Final = 12  # of Frank and Wolfe's algorithm; most plans are final after three
MIN_DECREASE: Final = 1e-9  # of a cost, to go on
# Unit vectors [5, 2] from the person to the thing, for a hint with each of DIRECTIONS.
TOWARDS_THING: Final = np.array([[0.0, -1.0], [0.0, 1.0], [-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]])


@dataclass(frozen=True, slots=True)
class TransportReranker:
    """Ranks the first cells of a description again."""

    gallery: Gallery
    palette: Palette

    def rerank(self, sentences: Sequence[str], ranked: tuple[Ints, Floats, Floats]) -> tuple[Ints, Floats, Floats]:
        """Return ranked cells [R], their scores and their probabilities with the first `DEPTH` in their new order.

        These cells share the probability that they had together. Sentences that no template writes are left out;
        without any other the order stays.
        """
        rows, scores, probability = ranked
        parsed = [parse_hint(sentence, self.palette.words) for sentence in sentences]
        hints = [hint for hint in parsed if hint is not None]
        first, mass = rows[:DEPTH], float(probability[:DEPTH].sum())
        if not hints or not mass:
            return ranked
        with np.errstate(divide="ignore"):
            logits = (np.log(probability[:DEPTH]) - NATS_PER_COST * self.costs(hints, first)) / TEMPERATURE
        weight = np.exp(logits - logits.max())
        order = np.argsort(-logits, kind="stable")
        everything = np.append(order, np.arange(len(order), len(rows)))
        probability = np.append(mass * weight / weight.sum(), probability[DEPTH:])
        return rows[everything], scores[everything], probability[everything]

    def costs(self, hints: Sequence[Hint], rows: Ints) -> Floats:
        """Return the cost [C] of the transport between hints and the parts of each cell, 0 to `UNMATCHED_COST`."""
        parts = self.gallery.cells.take(rows).parts
        sizes = np.diff(parts.starts)
        is_part = np.arange(sizes.max()) < sizes[:, None]
        pair_costs = np.zeros((*is_part.shape, len(hints)))
        pair_costs[is_part] = self._pair_costs(hints, parts).T
        positions_m = np.zeros((*is_part.shape, 2))
        positions_m[is_part] = parts.closest_m[:, :2]
        towards = TOWARDS_THING[[DIRECTIONS.index(hint.direction) for hint in hints]]
        return transport_costs(pair_costs.swapaxes(1, 2), towards, positions_m, sizes)

    def _pair_costs(self, hints: Sequence[Hint], parts: PartTable) -> Floats:
        """Return the costs [H, R] of labels and colours; an unknown colour goes with any."""
        words = np.array([*self.palette.words, ""])  # the last, for colour -1
        label, colour = (
            np.array([self.gallery.labels[n] for n in parts.instance]),
            words[self.palette.word_index(parts.rgb)],
        )
        hint_label, hint_colour = (
            np.array(column)[:, None] for column in ([h.label for h in hints], [h.colour or "" for h in hints])
        )
        is_other_colour = (hint_colour != colour) & (hint_colour != "") & (colour != "")
        return LABEL_COST * (hint_label != label) + COLOUR_COST * is_other_colour


def transport_costs(pair_costs: Floats, towards: Floats, positions_m: Floats, sizes: Ints) -> Floats:
    """Return the least cost [C] of a plan for each cell that Frank and Wolfe's algorithm finds.

    A plan [H, I] has a mass of at most 1 / H for each hint and each part. Its cost is the sum of

    - pair_costs [C, H, I] times the masses,
    - `UNMATCHED_COST` times the rest of the hints' mass,
    - `LAYOUT_COST` times (1 - cosine) / 2 of the angle between the offsets of two hints (`towards` [H, 2]) and of two
      parts (`positions_m` [C, I, 2]), times both masses, over all pairs; an offset of zero length costs nothing.

    Cells have the first `sizes` [C] of the I parts.
    """
    hints = pair_costs.shape[1]
    between = _directions(towards), _directions(positions_m)
    is_part = np.arange(pair_costs.shape[2]) < sizes[:, None, None]
    linear = pair_costs - UNMATCHED_COST
    plan = is_part / (hints * np.maximum(hints, sizes)[:, None, None]) * np.ones((hints, 1))  # prefers no part
    layout = LAYOUT_COST * _mismatch(plan, *between)
    for _ in range(MAX_ITERATIONS):
        gradient = linear + 2 * layout
        step = np.stack([_best_vertex(table, size) for table, size in zip(gradient, sizes, strict=True)]) - plan
        step_layout = LAYOUT_COST * _mismatch(step, *between)
        slope, curvature = (gradient * step).sum(axis=(1, 2)), (step_layout * step).sum(axis=(1, 2))
        # The least slope * length + curvature * length**2.
        convex = np.clip(-slope / np.maximum(2 * curvature, 1e-300), 0, 1)
        length = np.where(curvature > 0, convex, slope + curvature < 0)
        plan, layout = plan + length[:, None, None] * step, layout + length[:, None, None] * step_layout
        if (length * (slope + length * curvature) > -MIN_DECREASE).all():
            break
    return UNMATCHED_COST + ((linear + layout) * plan).sum(axis=(1, 2))


def _best_vertex(gradient: Floats, size: int) -> Floats:
    """Return the plan [H, I] of the least linear cost: hints and parts one to one, or hints without a part."""
    hints = len(gradient)
    hint, part = linear_sum_assignment(np.hstack([gradient[:, :size], np.zeros((hints, hints))]))
    plan = np.zeros_like(gradient)
    plan[hint[part < size], part[part < size]] = 1 / hints
    return plan


def _directions(points: Floats) -> Floats:
    """Return the unit vectors [..., N, N, 2] from the second to the first of two points [..., N, 2]; 0 if equal."""
    offset = points[..., :, None, :] - points[..., None, :, :]
    length = np.linalg.norm(offset, axis=-1, keepdims=True)
    return np.divide(offset, length, out=np.zeros_like(offset), where=length > 0)


def _mismatch(plan: Floats, hints: Floats, parts: Floats) -> Floats:
    """Return the layout cost [C, H, I] of each pair with all pairs of a plan, from directions [H, H, 2], [C, I, I, 2].

    The sum over h', i' of plan (1 - cosine) / 2 is a sum of products of matrices, because a cosine is one of products.
    """
    defined = [directions.any(axis=-1).astype(float) for directions in (hints, parts)]
    total = defined[0] @ plan @ defined[1]
    for axis in range(2):
        total -= hints[..., axis] @ plan @ parts[..., axis].swapaxes(-1, -2)
    return total / 2
