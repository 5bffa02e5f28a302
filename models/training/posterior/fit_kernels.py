"""Fit the place kernels to texts about real places (docs/method.md, fitting)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import log

import numpy as np
import torch
from torch import Tensor

from models.citymap.frame import Frame
from models.citymap.gazetteer.closest_points import ClosestPoints, PointGroups
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.kinds.vocabulary import load_vocabulary
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.errors import TrainingError
from models.language.languages.english import English
from models.language.mentions.cue_reader import CueReader
from models.language.mentions.lookup import Lookup
from models.language.mentions.reader import find_mentions, is_meeting, listener_wind, mark_goal
from models.language.text_encoder import TextEncoder
from models.posterior.places.explanations import PlacedMentions
from models.posterior.places.field import CoarseDistances, PlaceField
from models.posterior.places.kernels import HEADINGS, PlaceKernels
from models.sources.place_texts import START_SIGMA_M, PlaceText

# A text is compared with the best-scoring cells, the cells near the truth and random cells.
HARD_CELLS, TRUE_CELL_RADIUS_M, RANDOM_CELLS = 250, 25.0, 60
NODE_SPACING_M = 3.0
BLUR_M = 4.0  # width of the normal distribution around the true position
MAX_LOSS_NATS = 9.0  # caps the gradient of texts that cannot be explained
TEXTS_PER_BATCH = 48
STEPS = 100
LEARNING_RATE = 0.06
PULL_WEIGHT = 0.005  # of the squared distance from the initial weights, in the loss
TEMPER_SCALES = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5)  # candidate factors of `temper`
SAMPLED_CELLS = 4000  # for the mean of a kernel over the map


@dataclass(frozen=True, slots=True, eq=False)
class MapTexts:
    """A map and the texts about it."""

    gazetteer: Gazetteer
    frame: Frame
    centers_m: Floats  # [N, 2] of the cells
    grid_m: float  # their spacing
    texts: Sequence[PlaceText]  # with goals on the map


@dataclass(frozen=True, slots=True, eq=False)
class KernelExample:
    """A text with everything that does not depend on the weights: nodes of some cells, and the true position."""

    field: PlaceField
    placed: PlacedMentions
    points_m: Floats
    closest: Sequence[ClosestPoints]
    distances: Sequence[CoarseDistances]
    log_prior: Tensor
    walkway_distance_m: Tensor
    blur: Tensor
    goal_m: Floats
    cell: Ints
    centers_m: Floats


def fit_kernels(
    kernels: PlaceKernels,
    examples: Sequence[KernelExample],
    steps: int,
    rng: np.random.Generator,
    progress: Callable[[int, int, float], None] | None = None,
) -> float:
    """Fit the kernels of examples in place by Adam, by the posterior density at the true positions.

    `progress` is called with (steps done, steps, recent loss). Returns the mean loss of the last steps, nats.

    Raises:
        TrainingError: there are no examples.
    """
    if not examples:
        raise TrainingError("no text names anything of its map; are they about these maps?")
    start = [p.detach().clone() for p in kernels.parameters()]
    optimizer = torch.optim.Adam(kernels.parameters(), LEARNING_RATE)
    losses: list[float] = []
    for step in range(steps):
        for group in optimizer.param_groups:
            group["lr"] = LEARNING_RATE * (1 - 0.9 * step / steps)
        optimizer.zero_grad()
        for n in rng.permutation(len(examples))[:TEXTS_PER_BATCH]:
            loss = _loss(examples[n])
            (loss / TEXTS_PER_BATCH).backward()
            losses.append(loss.item())
        pull = sum(((p - q) ** 2).sum() for p, q in zip(kernels.parameters(), start, strict=True))
        (PULL_WEIGHT * torch.as_tensor(pull)).backward()
        optimizer.step()
        if progress:
            progress(step + 1, steps, float(np.mean(losses[-5 * TEXTS_PER_BATCH :])))
    return float(np.mean(losses[-10 * TEXTS_PER_BATCH :]))


def read_examples(
    kernels: PlaceKernels,
    texts: MapTexts,
    encoder: TextEncoder,
    cues_for: Callable[[str], CueReader],
    rng: np.random.Generator,
) -> list[KernelExample]:
    """Read the texts about a map; texts without a mention of the map are left out.

    The encoder tells which words are common, `cues_for` returns the cue reader for a text, `rng` draws cells.
    """
    field = PlaceField(kernels, texts.gazetteer, texts.centers_m, texts.grid_m)
    lookup = Lookup(texts.gazetteer, load_vocabulary(), encoder.is_everyday)
    sample = rng.choice(len(texts.centers_m), min(SAMPLED_CELLS, len(texts.centers_m)), replace=False)
    examples = (_example(field, lookup, cues_for(text.text), texts, text, sample, rng) for text in texts.texts)
    return [example for example in examples if example is not None]


def _example(
    field: PlaceField,
    lookup: Lookup,
    cues: CueReader,
    texts: MapTexts,
    text: PlaceText,
    sample: Ints,
    rng: np.random.Generator,
) -> KernelExample | None:
    if text.goal is None:
        return None
    mentions = find_mentions(text.text, lookup, English(cues))
    listener_m = None if text.start is None else texts.frame.from_wgs84(*text.start)
    meets = listener_m is not None or is_meeting(text.text)
    if meets:
        mentions = mark_goal(mentions)
    wind = None if listener_m is None else listener_wind(text.text)
    evidence = field.evidence(mentions, listener_m, wind, is_meeting=meets)
    if not evidence.placed.mentions:
        return None
    goal, centers = texts.frame.from_wgs84(*text.goal), texts.centers_m
    scores = evidence.cell_log_p + _log_prior(centers, listener_m)
    near = np.flatnonzero(np.hypot(*(centers - goal).T) < TRUE_CELL_RADIUS_M)
    cells = np.unique(np.concatenate([np.argsort(-scores)[:HARD_CELLS], near, rng.choice(len(centers), RANDOM_CELLS)]))
    points, group = _nodes(centers[cells], texts.grid_m)
    around = PointGroups.from_groups(points, group)
    squared_m2 = ((points - goal) ** 2).sum(axis=1)
    return KernelExample(
        field=field,
        placed=evidence.placed,
        points_m=points,
        closest=[field.closest_points(mention, around) for mention in evidence.placed.mentions],
        distances=[field.coarse_distances(mention, sample) for mention in evidence.placed.mentions],
        log_prior=torch.from_numpy(_log_prior(points, listener_m)).float(),
        walkway_distance_m=field.walkway_distance_m(evidence.placed, points),
        blur=torch.from_numpy(-squared_m2 / (2 * BLUR_M**2)).float(),
        goal_m=goal,
        cell=group,
        centers_m=centers[cells],
    )


def _loss(example: KernelExample) -> Tensor:
    """Return -log of the posterior density at the truth over the nodes, softly capped at MAX_LOSS_NATS."""
    log_p = _log_p(example)
    gain = (log_p + example.blur).logsumexp(0) - log_p.logsumexp(0)
    return -torch.logaddexp(gain, torch.tensor(-MAX_LOSS_NATS))


def _log_p(example: KernelExample) -> Tensor:
    """Return the unnormalised log posterior [M] of the nodes."""
    field, total = example.field, torch.zeros(len(example.points_m), HEADINGS)
    for mention, closest, distances in zip(example.placed.mentions, example.closest, example.distances, strict=True):
        fits = field.fits(mention, closest, len(example.points_m))
        total = total + field.log_evidence(mention, fits, field.coarse_kernel_mean(mention, distances))
    log_p = field.kernels.temper.exp() * (total.logsumexp(dim=1) - log(HEADINGS))
    log_p = log_p + field.kernels.standing(example.walkway_distance_m)
    return log_p + field.from_listener(example.placed, example.points_m) + example.log_prior


def calibrate_kernels(
    kernels: PlaceKernels, examples: Sequence[KernelExample], steps: int, rng: np.random.Generator
) -> float:
    """Calibrate probabilities by two-fold cross-fitting; the kernels are unchanged afterwards.

    Returns:
        The factor of `temper` that makes the probability of the best cell match its hit rate.
    """
    start = {name: value.clone() for name, value in kernels.state_dict().items()}
    half = rng.permutation(len(examples)) % 2
    outcomes = np.zeros((len(TEMPER_SCALES), len(examples), 2))
    for side in (0, 1):
        kernels.load_state_dict(start)
        fit_kernels(kernels, [example for n, example in enumerate(examples) if half[n] != side], steps, rng)
        fitted = kernels.temper.detach().clone()
        for k, scale in enumerate(TEMPER_SCALES):
            with torch.no_grad():
                kernels.temper.copy_(fitted + log(scale))
                for n, example in enumerate(examples):
                    if half[n] == side:
                        outcomes[k, n] = _outcome(example)
    kernels.load_state_dict(start)
    return TEMPER_SCALES[int(np.argmin(np.abs(outcomes[:, :, 0].mean(axis=1) - outcomes[:, :, 1].mean(axis=1))))]


def _outcome(example: KernelExample) -> tuple[float, float]:
    """Return the probability of the best cell, and whether it is the true one."""
    weight = _log_p(example).softmax(0).double().numpy()
    mass = np.bincount(example.cell, weight, len(example.centers_m))
    best = int(mass.argmax())
    return float(mass[best]), float(best == int(np.hypot(*(example.centers_m - example.goal_m).T).argmin()))


def _log_prior(points_m: Floats, listener_m: Floats | None) -> Floats:
    if listener_m is None:
        return np.zeros(len(points_m))
    return -((points_m - listener_m) ** 2).sum(axis=1) / (2 * START_SIGMA_M**2)


def _nodes(centers_m: Floats, grid_m: float) -> tuple[Floats, Ints]:
    """Return the nodes of some cells, and the index of each node's cell."""
    steps = np.arange(-grid_m / 2 + NODE_SPACING_M / 2, grid_m / 2, NODE_SPACING_M)
    offsets = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    points = (centers_m[:, None] + offsets[None]).reshape(-1, 2)
    return points, np.repeat(np.arange(len(centers_m)), len(offsets))
