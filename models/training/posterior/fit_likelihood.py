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
from models.posterior.likelihood import BoundHints, Likelihood
from models.posterior.node_batch import NodeBatch
from models.posterior.posterior import HintPosterior
from models.training.posterior.training_sites import TrainingSite

# A text is compared with the cells near the truth, the best-scoring cells and random cells.
TRUE_CELL_RADIUS_M = 25.0
HARD_CELLS, RANDOM_CELLS = 40, 40
BLUR_M = 1.5  # width of the normal distribution around the true position, about the spacing of the nodes
TEXTS_PER_BATCH = 16
LEARNING_RATE = 0.05


@dataclass(frozen=True, slots=True, eq=False)
class SiteTexts:
    """Read texts about positions of a training site."""

    site: TrainingSite
    rows: Ints  # [Q] positions of the site
    bound_hints: Sequence[BoundHints]  # Q


def fit_likelihood(
    likelihood: Likelihood,
    texts: Sequence[SiteTexts],
    steps: int,
    rng: np.random.Generator,
    progress: Callable[[int, int, float], None] | None = None,
) -> None:
    """Fit a likelihood in place by Adam, by the posterior density at the true positions.

    Sites are drawn in proportion to their number of texts; `progress` is called with (steps done, steps, recent loss).
    """
    sizes = np.array([len(part.bound_hints) for part in texts], dtype=np.float64)
    start = [part.site.posterior(likelihood) for part in texts]  # selects cells; has the means over the map
    trees = [_tree(part.site.cells) for part in texts]
    optimizer = torch.optim.Adam(likelihood.parameters(), LEARNING_RATE)
    losses: list[float] = []
    for step in range(steps):
        for group in optimizer.param_groups:
            group["lr"] = LEARNING_RATE * (1 - 0.9 * step / steps)
        optimizer.zero_grad()
        for _ in range(TEXTS_PER_BATCH):
            n = int(rng.choice(len(texts), p=sizes / sizes.sum()))
            query = int(rng.integers(len(texts[n].bound_hints)))
            cells = _cells(texts[n], start[n], trees[n], query, rng)
            loss = negative_log_density(likelihood, texts[n], query, cells, start[n].mean_statements)
            (loss / TEXTS_PER_BATCH).backward()
            losses.append(loss.item())
        torch.nn.utils.clip_grad_norm_(likelihood.parameters(), 5.0)
        optimizer.step()
        if progress:
            progress(step + 1, steps, float(np.mean(losses[-20 * TEXTS_PER_BATCH :])))


def negative_log_density(
    likelihood: Likelihood, texts: SiteTexts, query: int, cells: Ints, mean_statements: Tensor
) -> Tensor:
    """Return -log of the posterior density at the truth over the nodes of some cells."""
    site, row = texts.site, int(texts.rows[query])
    nodes, batch = nodes_of_cells(site, cells)
    log_p = likelihood(texts.bound_hints[query], batch, site.palette, mean_statements)
    scene = np.unique(site.cells.scenes, return_inverse=True)[1]
    owner = np.repeat(cells, np.diff(site.surroundings.cell_starts)[cells])
    squared_m2 = ((site.surroundings.positions_m(nodes) - site.positions_m[row]) ** 2).sum(axis=1)
    squared_m2 = np.where(scene[owner] == scene[site.truth[row]], squared_m2, np.inf)
    blur = torch.from_numpy(-squared_m2 / (2 * BLUR_M**2)).float()
    return log_p.logsumexp(0) - (log_p + blur).logsumexp(0)


def nodes_of_cells(site: TrainingSite, cells: Ints) -> tuple[Ints, NodeBatch]:
    """Return the nodes of some cells with their neighbours."""
    s = site.surroundings
    nodes = ranges(s.cell_starts[cells], s.cell_starts[cells + 1])
    label, rgb = torch.from_numpy(site.label), torch.from_numpy(s.objects.rgb.astype(np.float32))
    is_vague = torch.from_numpy(s.objects.is_vague)
    return nodes, NodeBatch.from_neighbours(s.around(nodes), len(nodes), label, rgb, is_vague)


def _tree(cells: CellTable) -> cKDTree:
    scene = np.unique(cells.scenes, return_inverse=True)[1]
    return cKDTree(np.column_stack([cells.center_m[:, :2], scene * 1e6]))


def _cells(
    texts: SiteTexts, start: HintPosterior, tree: cKDTree, query: int, rng: np.random.Generator
) -> npt.NDArray[np.int64]:
    """Select the cells near the truth, the best-scoring cells, and random cells."""
    scores = start.cell_scores(texts.bound_hints[query])
    hard = np.argpartition(-scores, min(HARD_CELLS, len(scores) - 1))[:HARD_CELLS]
    near = tree.query_ball_point(tree.data[texts.site.truth[texts.rows[query]]], TRUE_CELL_RADIUS_M)
    random = rng.choice(len(scores), min(RANDOM_CELLS, len(scores)), replace=False)
    return np.unique(np.concatenate([near, hard, random]))
