"""`PlaceKernels` at ways to what may be meant, compiled: way by way, without arrays of every heading of every way."""

from math import factorial, nan, radians
from typing import Final

import numpy as np
import torch

from models.citymap.gazetteer.closest_points import ClosestPoints
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled
from models.language.mentions.mentions import Mention
from models.posterior.places.kernels import HEADINGS, TYPES, PlaceKernels, kernel_of, with_angle

ACROSS: Final = TYPES.index("across")
NO_ANGLE: Final = -1
_2, _3, _4, _5, _6, _7 = (1 / factorial(n) for n in range(2, 8))
SMALL: Final = 0.25  # an exponent of whose exponential eight terms are enough
# Of I0, by powers of (x / 3.75)^2 below 3.75 and of 3.75 / x above (Abramowitz and Stegun 9.8.1 and 9.8.2).
_LOW: Final = (1.0, 3.5156229, 3.0899424, 1.2067492, 0.2659732, 0.0360768, 0.0045813)
_HIGH: Final = (
    0.39894228, 0.01328592, 0.00225319, -0.00157565, 0.00916281, -0.02057706, 0.02635537, -0.01647633, 0.00392377,
)  # fmt: skip


class WayKernels:
    """As the kernels but for the last bits, where nothing is learnt; weights that change later make no difference."""

    @torch.inference_mode()
    def __init__(self, kernels: PlaceKernels) -> None:
        self._scale, self._tail = kernels.scale.exp().double().numpy(), kernels.tail.sigmoid().double().numpy()
        self._across_m, self._side_m = float(kernels.across_m.exp()), float(kernels.side_m.exp())
        self._widths, self._slip = kernels.measured.exp().tolist(), float(kernels.slip.sigmoid())
        self._wind, self._ego = float(kernels.wind.exp()), float(kernels.ego.exp())

    def fits(self, mention: Mention, ways: ClosestPoints, point: Ints, points: int) -> Floats:
        """[M, 1] or [M, HEADINGS] float32 the best of the ways to one mention from each of M points.

        Args:
            mention: what is meant.
            ways: P to what it may mean.
            point: [P] from which point each is.
            points: M.
        """
        cue = mention.cue
        said = (nan, 1.0) if cue.distance_m is None else (cue.distance_m, self._widths[int(cue.is_loose)])
        angles = ((cue.angle, 1.0),) if cue.wind is not None else cue.angles or ((cue.angle, 1.0),)
        told = [angle for angle, _ in angles if angle is not None and cue.wind is None]
        first = cue.wind if cue.wind is not None else told[0] if told else None
        steps = [0 if cue.wind is not None else NO_ANGLE if a is None else _step(a, told[0]) for a, _ in angles]
        kinds = [kernel_of(with_angle(mention, angle)) for angle, _ in angles]
        chances = np.array([p for _, p in angles])
        shape = np.stack([chances, self._scale[kinds], self._tail[kinds], np.equal(kinds, ACROSS)], axis=1)
        found: Floats = _best(
            point, ways.target, ways.offset_m, mention.weights.astype(np.float64), points, HEADINGS if told else 1,
            shape, np.array(steps), nan if first is None else radians(first), self._ego if told else self._wind,
            self._slip, said, self._across_m, nan if mention.side is None else radians(mention.side), self._side_m,
        )  # fmt: skip
        return found


def _step(angle: float, first: float) -> int:
    """By how many headings: what is on the right of who looks north is ahead of who looks east."""
    return round((angle - first) * HEADINGS / 360.0) % HEADINGS


@compiled
def _best(
    point: Ints, item: Ints, way_m: Floats, weights: Floats, points: int, headings: int, shape: Floats, steps: Ints,
    toward: float, concentration: float, slip: float, said: tuple[float, float], across_m: float, side: float,
    side_m: float,
) -> Floats:  # fmt: skip
    """[M, headings] float32; shape [A, 4] of each angle its chance, scale, tail, and whether it is a ring."""
    best, turn = np.zeros((points, headings)), 2 * np.pi / HEADINGS
    cosine, sine = np.cos(toward + np.arange(headings) * turn), np.sin(toward + np.arange(headings) * turn)
    halvings = _halvings(concentration)
    density, fits = np.ones(2 * headings), np.empty(headings)
    for n in range(len(point)):
        east, north = way_m[n, 0], way_m[n, 1]
        metres = np.sqrt(east * east + north * north)
        x, y = (east / metres, north / metres) if metres > 0.0 else (0.0, 1.0)
        if not np.isnan(toward):
            kappa = concentration * metres / (metres + 4.0)
            _directions(kappa, x, y, cosine, sine, halvings, slip, density)
        weight = weights[item[n]]
        if not np.isnan(side):  # the street lies on the other side of who is on its north side
            over = metres * (y * np.cos(side) + x * np.sin(side)) / side_m
            weight *= 1.9 / (1.0 + np.exp(min(over, 700.0))) + 0.05
        fits[:] = 0.0
        for a in range(len(shape)):
            near, step = weight * shape[a, 0] * _near(metres, shape[a], said, across_m), steps[a]
            if step == NO_ANGLE:
                fits += near
                continue
            for h in range(headings):
                fits[h] += near * density[h + step]
        p = point[n]
        for h in range(headings):
            so_far = best[p, h]
            best[p, h] = fits[h] if fits[h] > so_far else so_far
    return best.astype(np.float32)


@compiled
def _near(metres: float, shape: Floats, said: tuple[float, float], across_m: float) -> float:
    """The kernel of a distance that was said, or the one of a type; see `PlaceKernels.said` and `near`."""
    if not np.isnan(said[0]):
        ratio = np.log((metres + 4.0) / (said[0] + 4.0)) / said[1]
        near: float = np.exp(-0.5 * ratio * ratio)
        return near
    scale, tail = shape[1], shape[2]
    off, share = (metres - across_m) / scale, max(metres / scale, 1e-4)
    ring = np.exp(-0.5 * off * off) if shape[3] else np.exp(-share * np.sqrt(share))
    near = (1 - tail) * ring + tail * np.exp(-metres / (4 * scale))
    return near


@compiled
def _halvings(concentration: float) -> int:
    """How often an exponent of `_directions` is halved until it is small."""
    count, most = 0, 2 * concentration
    while most > SMALL:
        most /= 2
        count += 1
    return count


@compiled
def _directions(
    kappa: float, x: float, y: float, cosine: Floats, sine: Floats, halvings: int, slip: float, density: Floats
) -> None:
    """Fill in `PlaceKernels.toward` of a direction (x, y) in each heading, twice over.

    The exponential of a small number is a polynomial's, and of a large one its powers: so the processor takes several
    headings at once.
    """
    count, small = len(cosine), kappa * 0.5**halvings
    most = (1 - slip) / _scaled_bessel(kappa)
    for h in range(count):
        e = small * (y * cosine[h] + x * sine[h] - 1.0)
        density[h] = 1 + e * (1 + e * (_2 + e * (_3 + e * (_4 + e * (_5 + e * (_6 + e * _7))))))
    for _ in range(halvings):
        for h in range(count):
            density[h] *= density[h]
    for h in range(count):
        density[h] = density[h + count] = most * density[h] + slip


@compiled
def _scaled_bessel(x: float) -> float:
    """I0(x) exp(-x) of x >= 0."""
    found = 0.0
    if x < 3.75:
        share = (x / 3.75) ** 2
        for n in range(len(_LOW)):
            found = found * share + _LOW[len(_LOW) - 1 - n]
    else:
        for n in range(len(_HIGH)):
            found = found * (3.75 / x) + _HIGH[len(_HIGH) - 1 - n]
    scaled: float = found * np.exp(-x) if x < 3.75 else found / np.sqrt(x)
    return scaled
