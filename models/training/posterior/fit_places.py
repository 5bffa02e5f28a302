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
from models.language.mentions.cue_reader import CueReader
from models.language.mentions.lookup import Lookup
from models.language.mentions.reader import find_mentions, is_meeting, listener_wind, with_goal
from models.language.text_encoder import TextEncoder
from models.posterior.locate import PLACE_HIT_M
from models.posterior.places.explanations import Places
from models.posterior.places.field import PlaceField, Rough
from models.posterior.places.kernels import HEADINGS, PlaceKernels
from models.sources.place_texts import START_SIGMA_M, PlaceText

HARD, NEAR_M, RANDOM = 250, 25.0, 60  # cells that fit the text best, around the truth, and any
NODE_M = 3.0  # spacing of the nodes in a cell
BLUR_M = 4.0  # the truth is a normal distribution of this width
MOST = 9.0  # nats: a text that cannot be explained pulls no harder
BATCH = 48
STEPS = 100
LEARNING_RATE = 0.06
PULL = 0.005  # towards where the weights began
TEMPERS = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5)  # what `temper` is scaled with
HELD = 0.9
HEAVY = 256  # nodes that the best place is looked for among
SAMPLED = 4000  # cells that the mean of a kernel over the map is taken from


@dataclass(frozen=True, slots=True, eq=False)
class ToldPlace:
    """A map with texts about it.

    Attributes:
        gazetteer: of the map.
        frame: of the map.
        centers_m: [N, 2] of its cells.
        grid_m: their spacing.
        texts: with goals on the map.
    """

    gazetteer: Gazetteer
    frame: Frame
    centers_m: Floats
    grid_m: float
    texts: Sequence[PlaceText]


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """A text with everything that does not depend on the weights: nodes in some cells, and where the truth is."""

    field: PlaceField
    places: Places
    points_m: Floats
    ways: Sequence[ClosestPoints]
    rough: Sequence[Rough]
    log_prior: Tensor
    walked: Tensor
    blur: Tensor
    goal_m: Floats
    cell: Ints
    centers_m: Floats
    is_meeting: bool


def fit_places(
    kernels: PlaceKernels,
    cases: Sequence[Case],
    steps: int,
    rng: np.random.Generator,
    progress: Callable[[int, int, float], None] | None = None,
) -> float:
    """Make texts likely where they were said, in place.

    Args:
        kernels: those of the cases, from where to start.
        cases: what to fit to.
        steps: of Adam, `BATCH` texts each.
        rng: draws texts.
        progress: called with (steps done, steps, mean surprise).

    Returns:
        The mean surprise of the last steps, nats.

    Raises:
        TrainingError: there is nothing to fit to.
    """
    if not cases:
        raise TrainingError("no text names anything of its map; are they about these maps?")
    start = [p.detach().clone() for p in kernels.parameters()]
    optimizer = torch.optim.Adam(kernels.parameters(), LEARNING_RATE)
    losses: list[float] = []
    for step in range(steps):
        for group in optimizer.param_groups:
            group["lr"] = LEARNING_RATE * (1 - 0.9 * step / steps)
        optimizer.zero_grad()
        for n in rng.permutation(len(cases))[:BATCH]:
            loss = _surprise(cases[n])
            (loss / BATCH).backward()
            losses.append(loss.item())
        pull = sum(((p - q) ** 2).sum() for p, q in zip(kernels.parameters(), start, strict=True))
        (PULL * torch.as_tensor(pull)).backward()
        optimizer.step()
        if progress:
            progress(step + 1, steps, float(np.mean(losses[-5 * BATCH :])))
    return float(np.mean(losses[-10 * BATCH :]))


def read_cases(
    kernels: PlaceKernels,
    place: ToldPlace,
    encoder: TextEncoder,
    cues_for: Callable[[str], CueReader],
    rng: np.random.Generator,
) -> list[Case]:
    """A place's texts, read; those that name nothing of the map are left out.

    Args:
        kernels: what is to be fitted.
        place: a map with texts.
        encoder: says which words are everyday ones.
        cues_for: the reader of cues for a text.
        rng: draws cells.
    """
    field = PlaceField(kernels, place.gazetteer, place.centers_m, place.grid_m)
    lookup = Lookup(place.gazetteer, load_vocabulary(), encoder.is_everyday)
    sample = rng.choice(len(place.centers_m), min(SAMPLED, len(place.centers_m)), replace=False)
    found = (_case(field, lookup, cues_for(told.text), place, told, sample, rng) for told in place.texts)
    return [case for case in found if case is not None]


def _case(
    field: PlaceField,
    lookup: Lookup,
    cues: CueReader,
    place: ToldPlace,
    told: PlaceText,
    sample: Ints,
    rng: np.random.Generator,
) -> Case | None:
    mentions = find_mentions(told.text, lookup, cues)
    listener_m = None if told.start is None else place.frame.from_wgs84(*told.start)
    meets = listener_m is not None or is_meeting(told.text)
    if meets:
        mentions = with_goal(mentions)
    wind = None if listener_m is None else listener_wind(told.text)
    found = field.told(mentions, listener_m, wind, is_meeting=meets)
    if not found.places.mentions:
        return None
    goal, centers = place.frame.from_wgs84(*told.goal), place.centers_m
    scores = found.cells + _log_prior(centers, listener_m)
    near = np.flatnonzero(np.hypot(*(centers - goal).T) < NEAR_M)
    cells = np.unique(np.concatenate([np.argsort(-scores)[:HARD], near, rng.choice(len(centers), RANDOM)]))
    points, group = _nodes(centers[cells], place.grid_m)
    around = PointGroups.from_groups(points, group)
    away = ((points - goal) ** 2).sum(axis=1)
    return Case(
        field=field,
        places=found.places,
        points_m=points,
        ways=[field.ways_from(mention, around) for mention in found.places.mentions],
        rough=[field.rough(mention, sample) for mention in found.places.mentions],
        log_prior=torch.from_numpy(_log_prior(points, listener_m)).float(),
        walked=field.walked(found.places, points),
        blur=torch.from_numpy(-away / (2 * BLUR_M**2)).float(),
        goal_m=goal,
        cell=group,
        centers_m=centers[cells],
        is_meeting=meets,
    )


def _surprise(case: Case) -> Tensor:
    """-log of the posterior density at the truth, among the nodes of some cells; at most about MOST."""
    log_p = _log_p(case)
    gain = (log_p + case.blur).logsumexp(0) - log_p.logsumexp(0)
    return -torch.logaddexp(gain, torch.tensor(-MOST))


def _log_p(case: Case) -> Tensor:
    """[M] log posterior of the nodes, not normalised."""
    field, total = case.field, torch.zeros(len(case.points_m), HEADINGS)
    for mention, ways, rough in zip(case.places.mentions, case.ways, case.rough, strict=True):
        total = total + field.worth(mention, field.fits(mention, ways, len(case.points_m)), field.usual(mention, rough))
    log_p = field.kernels.temper.exp() * (total.logsumexp(dim=1) - log(HEADINGS))
    log_p = log_p + field.kernels.standing(case.walked)
    return log_p + field.from_listener(case.places, case.points_m) + case.log_prior


def calibrate_places(
    kernels: PlaceKernels, cases: Sequence[Case], steps: int, rng: np.random.Generator
) -> tuple[float, float, float]:
    """What makes probabilities and radii honest, from texts that the kernels were not fitted to: two halves in turn.

    Args:
        kernels: those of the cases; as they were given afterwards.
        cases: to fit to and to calibrate on.
        steps: of each fit.
        rng: draws the halves.

    Returns:
        What `temper` must be scaled with so that the best cell's probability is honest; the .9 quantile of error / 90 %
        radius then, of texts "where I am", and of those of where to meet (1 without any).
    """
    start = {name: value.clone() for name, value in kernels.state_dict().items()}
    half = rng.permutation(len(cases)) % 2
    answers = np.zeros((len(TEMPERS), len(cases), 3))
    for side in (0, 1):
        kernels.load_state_dict(start)
        fit_places(kernels, [case for n, case in enumerate(cases) if half[n] != side], steps, rng)
        fitted = kernels.temper.detach().clone()
        for k, scale in enumerate(TEMPERS):
            with torch.no_grad():
                kernels.temper.copy_(fitted + log(scale))
                for n, case in enumerate(cases):
                    if half[n] == side:
                        answers[k, n] = _answer(case)
    kernels.load_state_dict(start)
    best = int(np.argmin(np.abs(answers[:, :, 0].mean(axis=1) - answers[:, :, 1].mean(axis=1))))
    meets = np.array([case.is_meeting for case in cases])
    ratio = answers[best, :, 2]
    own, meeting = (float(np.quantile(ratio[some], HELD)) if some.any() else 1.0 for some in (~meets, meets))
    return TEMPERS[best], own, meeting


def _answer(case: Case) -> tuple[float, float, float]:
    """Probability of the best cell, whether it is the true one, and error / 90 % radius of the best place."""
    weight = _log_p(case).softmax(0).double().numpy()
    mass = np.bincount(case.cell, weight, len(case.centers_m))
    best = int(mass.argmax())
    hit = best == int(np.hypot(*(case.centers_m - case.goal_m).T).argmin())
    heavy = np.argsort(-weight)[:HEAVY]
    away = ((case.points_m[heavy][:, None] - case.points_m[heavy][None]) ** 2).sum(axis=2)
    at = case.points_m[heavy[(np.exp(-((away / PLACE_HIT_M**2) ** 3)) @ weight[heavy]).argmax()]]
    radius = np.hypot(*(case.points_m - at).T)
    order = np.argsort(radius)
    p90 = radius[order][np.searchsorted(np.cumsum(weight[order]), HELD)]
    return float(mass[best]), float(hit), float(np.hypot(*(at - case.goal_m)) / max(p90, NODE_M))


def _log_prior(points_m: Floats, listener_m: Floats | None) -> Floats:
    if listener_m is None:
        return np.zeros(len(points_m))
    density: Floats = -((points_m - listener_m) ** 2).sum(axis=1) / (2 * START_SIGMA_M**2)
    return density


def _nodes(centers_m: Floats, grid_m: float) -> tuple[Floats, Ints]:
    """Nodes of some cells, and the number of each one's cell."""
    steps = np.arange(-grid_m / 2 + NODE_M / 2, grid_m / 2, NODE_M)
    offsets = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    points = (centers_m[:, None] + offsets[None]).reshape(-1, 2)
    return points, np.repeat(np.arange(len(centers_m)), len(offsets))
