"""Fit the weights of the near factor by maximum likelihood (docs/method.md, fitting)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import torch
from scipy.spatial import cKDTree
from torch import Tensor

from models.citymap.cells import CellTable
from models.citymap.points import Ints, ranges
from models.posterior.likelihood import Likelihood, Reading
from models.posterior.node_batch import NodeBatch
from models.posterior.posterior import HintPosterior
from models.training.posterior.training_sites import Place

NEAR_M = 25.0  # cells this near to the truth are always looked at
HARD, RANDOM = 40, 40  # and so many that fit the text, and others
BLUR_M = 1.5  # the truth is a normal distribution of this width, so that no node is right alone
BATCH = 16
LEARNING_RATE = 0.05


@dataclass(frozen=True, slots=True, eq=False)
class Texts:
    """Texts about a place, as they were read.

    Attributes:
        place: where.
        rows: [Q] their positions among the place's.
        readings: Q of them.
    """

    place: Place
    rows: Ints
    readings: Sequence[Reading]


def fit_likelihood(
    likelihood: Likelihood,
    texts: Sequence[Texts],
    steps: int,
    rng: np.random.Generator,
    progress: Callable[[int, int, float], None] | None = None,
) -> None:
    """Make what was said likely where it was said, in place.

    Args:
        likelihood: from where to start.
        texts: what to fit to, drawn from in turn, by their numbers.
        steps: of Adam, `BATCH` texts each.
        rng: draws texts and cells.
        progress: called with (steps done, steps, mean loss of the last ones).
    """
    sizes = np.array([len(part.readings) for part in texts], dtype=np.float64)
    start = [part.place.posterior(likelihood) for part in texts]  # for choosing cells, and what is usual there
    trees = [_tree(part.place.cells) for part in texts]
    optimizer = torch.optim.Adam(likelihood.parameters(), LEARNING_RATE)
    losses: list[float] = []
    for step in range(steps):
        for group in optimizer.param_groups:
            group["lr"] = LEARNING_RATE * (1 - 0.9 * step / steps)
        optimizer.zero_grad()
        for _ in range(BATCH):
            n = int(rng.choice(len(texts), p=sizes / sizes.sum()))
            query = int(rng.integers(len(texts[n].readings)))
            cells = _cells(texts[n], start[n], trees[n], query, rng)
            loss = surprise(likelihood, texts[n], query, cells, start[n].usual)
            (loss / BATCH).backward()
            losses.append(loss.item())
        torch.nn.utils.clip_grad_norm_(likelihood.parameters(), 5.0)
        optimizer.step()
        if progress:
            progress(step + 1, steps, float(np.mean(losses[-20 * BATCH :])))


def surprise(likelihood: Likelihood, texts: Texts, query: int, cells: Ints, usual: Tensor) -> Tensor:
    """-log of the posterior density at the truth, among the nodes of some cells; `usual` of the place."""
    place, row = texts.place, int(texts.rows[query])
    nodes, around = around_cells(place, cells)
    log_p = likelihood(texts.readings[query], around, place.palette, usual)
    scene = np.unique(place.cells.scenes, return_inverse=True)[1]
    owner = np.repeat(cells, np.diff(place.surroundings.cell_starts)[cells])
    away = ((place.surroundings.positions_m(nodes) - place.positions_m[row]) ** 2).sum(axis=1)
    away = np.where(scene[owner] == scene[place.truth[row]], away, np.inf)
    blur = torch.from_numpy(-away / (2 * BLUR_M**2)).float()
    loss: Tensor = log_p.logsumexp(0) - (log_p + blur).logsumexp(0)
    return loss


def around_cells(place: Place, cells: Ints) -> tuple[Ints, NodeBatch]:
    """The nodes of some cells, and their surroundings."""
    s = place.surroundings
    nodes = ranges(s.cell_starts[cells], s.cell_starts[cells + 1])
    label, rgb = torch.from_numpy(place.label), torch.from_numpy(s.things.rgb.astype(np.float32))
    is_vague = torch.from_numpy(s.things.is_vague)
    return nodes, NodeBatch.of(s.around(nodes), len(nodes), label, rgb, is_vague)


def _tree(cells: CellTable) -> cKDTree:
    scene = np.unique(cells.scenes, return_inverse=True)[1]
    return cKDTree(np.column_stack([cells.center_m[:, :2], scene * 1e6]))


def _cells(
    texts: Texts, start: HintPosterior, tree: cKDTree, query: int, rng: np.random.Generator
) -> npt.NDArray[np.int64]:
    """Cells to tell the truth from: those around it, those that fit, and any."""
    scores = start.cell_scores(texts.readings[query])
    hard = np.argpartition(-scores, min(HARD, len(scores) - 1))[:HARD]
    near = tree.query_ball_point(tree.data[texts.place.truth[texts.rows[query]]], NEAR_M)
    return np.unique(np.concatenate([near, hard, rng.choice(len(scores), min(RANDOM, len(scores)), replace=False)]))
