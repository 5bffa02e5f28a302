"""The likelihood of mentions on a map (docs/method.md, M27): approximate at cells, exact at positions."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from math import degrees, log, pi, radians
from typing import Final

import numpy as np
import numpy.typing as npt
import torch
from cachetools import LRUCache, cachedmethod
from torch import Tensor

from models.citymap.gazetteer.closest_points import ClosestPoints, PointGroups, find_closest_points, select_objects
from models.citymap.gazetteer.distance_raster import DistanceRaster, GroupDistances
from models.citymap.gazetteer.gazetteer import WALKED_KIND, Gazetteer
from models.citymap.gazetteer.walkways import Walkways
from models.citymap.points import Ints, bounding_corners
from models.citymap.types import Floats
from models.language.mentions.cues import Cue
from models.language.mentions.mentions import Mention
from models.posterior.places.explanations import UNEXPLAINED, MentionExplanation, PlacedMentions
from models.posterior.places.kernels import FLOOR_NAMES, HEADINGS, PlaceKernels, floor_name, kernel_of

# Search radii for objects, in scales of a kernel; smaller for mentions with many objects, which bounds the time.
REACH_SCALES, REACH_SCALES_OF_MANY, MANY_OBJECTS = 5.0, 2.5, 60
REACH_MARGIN_M, MAX_REACH_M = 20.0, 250.0
STATED_REACH_FACTOR, MAX_STATED_REACH_M = 2.5, 600.0  # the same for stated distances
GRID_ERROR_M: Final = 5.0  # by which a distance on the grid may be too long
MIN_KERNEL_MEAN: Final = 1e-6
MIN_KERNEL_MAX: Final = 0.02  # a mention that fits nowhere better is not near the map
DENIED_SHARE: Final = 0.9  # by which a place is less likely at what a text says is not there
CODE_FLOOR: Final = 0.01  # probability that coordinates or another code are no evidence: they are seldom chance
CACHED_MENTIONS: Final = 32  # those of one text
HEADINGS_RAD: Final = np.arange(HEADINGS) * (2 * pi / HEADINGS)
TIERS: Final = (1.0, 0.7, 0.4, 0.2)  # weights on the grid are rounded to these


@dataclass(frozen=True, slots=True, eq=False)
class CoarseDistances:
    """Distances of n cells from the objects of a mention in T tiers, to the precision of the grid."""

    weights: tuple[float, ...]  # of each tier
    metres: Tensor  # [T, n]


class PlaceEvidence:
    """The evidence of a text's mentions: approximate at every cell, exact at any position."""

    def __init__(self, field: "PlaceField", placed: PlacedMentions, cell_log_p: Floats) -> None:
        self._field, self.placed, self.cell_log_p = field, placed, cell_log_p  # the last [N], of the cells

    @torch.inference_mode()
    def log_p(self, points_m: Floats, group: Ints) -> Floats:
        """Return log p(T | x) [M] of positions [M, 2]; `group` as `PlaceField.log_p`."""
        if not len(points_m):
            return np.zeros(0)
        return self._field.log_p(self.placed, points_m, group).double().numpy()


class PlaceField:
    """The likelihood of mentions on one map, whose cells have centres [N, 2] with a spacing."""

    def __init__(self, kernels: PlaceKernels, gazetteer: Gazetteer, centers_m: Floats, spacing_m: float) -> None:
        self.kernels, self.gazetteer, self._centers_m = kernels, gazetteer, centers_m
        self._outlines: LRUCache[Mention, tuple[Floats, Ints, npt.NDArray[np.bool_]]] = LRUCache(CACHED_MENTIONS)
        has_walkways = WALKED_KIND in gazetteer.by_kind
        self._walkways = Walkways(gazetteer, *bounding_corners(centers_m)) if has_walkways else None
        self.raster = DistanceRaster(gazetteer, centers_m, spacing_m)

    @torch.inference_mode()
    def evidence(
        self,
        mentions: Sequence[Mention],
        listener_m: Floats | None = None,
        listener_wind: float | None = None,
        *,
        is_meeting: bool = False,
    ) -> PlaceEvidence:
        """Return the evidence of the mentions of a text; the other arguments as in `PlacedMentions`."""
        near, means, total = [], [], np.zeros(self.raster.shape, np.float32)
        denied = tuple(mention for mention in mentions if mention.is_denied and len(mention.objects))
        for mention in mentions:
            if mention.is_denied or (not len(mention.objects) and not len(mention.lines_m)):
                continue
            weights, distances = self._tier_distances(mention)
            grids = (torch.from_numpy(steps_m) for steps_m in (self.raster.steps_m, self.raster.block_steps_m))
            fits = [self._by_tier(mention, _coarse(weights, steps_m.expand(len(weights), -1))) for steps_m in grids]
            mean, highest = self.raster.mean_and_max(distances, fits[0].numpy(), fits[1].numpy())
            if highest < MIN_KERNEL_MAX:
                continue
            near.append(mention)
            means.append(torch.tensor(mean).clamp(min=MIN_KERNEL_MEAN))
            log_ratios = [self.log_evidence(mention, fit, means[-1]).numpy() for fit in fits]
            self.raster.add_best(total, distances, log_ratios[0], log_ratios[1])
        kernel_means = torch.stack(means) if means else torch.zeros(0)
        placed = PlacedMentions(tuple(near), kernel_means, denied, listener_m, listener_wind, is_meeting)
        cell_log_p = torch.from_numpy(total.ravel()[self.raster.cell_pixel])
        cell_log_p = self.kernels.temper.exp() * cell_log_p + self.from_listener(placed, self._centers_m)
        return PlaceEvidence(self, placed, cell_log_p.double().numpy())

    def log_p(self, placed: PlacedMentions, points_m: Floats, group: Ints) -> Tensor:
        """Return log p(T | x) [M] of positions [M, 2], up to a constant; `group` [M], ascending, is one per area."""
        by_heading = self.by_heading(placed, points_m, group)
        total = by_heading.logsumexp(dim=1) - log(HEADINGS)
        standing = self.kernels.standing(self.walkway_distance_m(placed, points_m))
        return self.kernels.temper.exp() * total + self.from_listener(placed, points_m) + standing

    def walkway_distance_m(self, placed: PlacedMentions, points_m: Floats) -> Tensor:
        """Return the distance [M] of positions [M, 2] to a walkway; 0 for meeting points and without walkways."""
        if self._walkways is None or placed.is_meeting:
            return torch.zeros(len(points_m))
        return torch.from_numpy(self._walkways.distances_m(points_m))

    def by_heading(self, placed: PlacedMentions, points_m: Floats, group: Ints) -> Tensor:
        """Return log p(T | x, heading) [M, HEADINGS]."""
        total = torch.zeros(len(points_m), HEADINGS)
        if placed.mentions or placed.denied:
            around = PointGroups.from_groups(points_m, group)
            for mention in placed.denied:
                near = self.fits(mention, self.closest_points(mention, around), len(points_m)).amax(dim=1, keepdim=True)
                total = total + torch.log1p(-DENIED_SHARE * near.clamp(max=1.0))
            for mention, mean in zip(placed.mentions, placed.kernel_means, strict=True):
                fits = self.fits(mention, self.closest_points(mention, around), len(points_m))
                total = total + self.log_evidence(mention, fits, mean)
        return total

    @torch.inference_mode()
    def explain(self, placed: PlacedMentions, points_m: Floats) -> list[list[MentionExplanation]]:
        """Explain each mention at positions [M, 2], in the best heading at each; M lists."""
        count = len(points_m)
        around = PointGroups.from_groups(points_m, np.arange(count))
        closest = [self.closest_points(mention, around) for mention in placed.mentions]
        fits = [self._object_fits(*pair) for pair in zip(placed.mentions, closest, strict=True)]
        total = torch.zeros(count, HEADINGS)
        for mention, near, fit, mean in zip(placed.mentions, closest, fits, placed.kernel_means, strict=True):
            total = total + self.log_evidence(mention, _best_fits(fit, near, count), mean)
        headings = total.argmax(dim=1).tolist()
        return [
            [
                self._explanation(mention, near, fit, float(mean), point, heading)
                for mention, near, fit, mean in zip(placed.mentions, closest, fits, placed.kernel_means, strict=True)
            ]
            for point, heading in enumerate(headings)
        ]

    def _explanation(
        self, mention: Mention, closest: ClosestPoints, fits: Tensor, mean: float, point: int, heading: int
    ) -> MentionExplanation:
        rows = np.flatnonzero(closest.point == point)
        if not len(rows):
            return UNEXPLAINED
        at_heading = fits[torch.from_numpy(rows), heading if fits.shape[1] > 1 else 0]
        best, floor = int(at_heading.argmax()), float(self._floor(mention))
        ratio = (1 - floor) * float(at_heading[best]) / mean
        row, heading_deg = int(rows[best]), degrees(HEADINGS_RAD[heading])
        probability = ratio / (ratio + floor)
        return MentionExplanation(probability, int(closest.target[row]), closest.offset_m[row], heading_deg)

    def closest_points(self, mention: Mention, around: PointGroups) -> ClosestPoints:
        """Return the closest points of a mention's candidates to grouped positions."""
        return find_closest_points(around, *self._outline(mention), self._reach_m(mention))

    @cachedmethod(lambda field: field._outlines)
    def _outline(self, mention: Mention) -> tuple[Floats, Ints, npt.NDArray[np.bool_]]:
        """Return the segments, starts and `is_area` of the objects and lines of a mention."""
        segments, starts, is_area = select_objects(self.gazetteer, mention.objects)
        lines = len(mention.lines_m)
        if lines:
            segments = np.concatenate([segments, mention.lines_m])
            starts = np.concatenate([starts, starts[-1] + 1 + np.arange(lines)])
            is_area = np.concatenate([is_area, np.zeros(lines, np.bool_)])
        return segments.astype(np.float64), starts, is_area

    def _reach_m(self, mention: Mention) -> float:
        """Return the search radius for candidates; it is smaller for mentions with many."""
        if mention.cue.distance_m is not None:
            return min(STATED_REACH_FACTOR * mention.cue.distance_m + REACH_MARGIN_M, MAX_STATED_REACH_M)
        scale = float(self.kernels.scale[kernel_of(mention, mention.cue.angle)].detach().exp())
        scales = REACH_SCALES_OF_MANY if len(mention.objects) > MANY_OBJECTS else REACH_SCALES
        return min(scales * scale + REACH_MARGIN_M, MAX_REACH_M)

    def coarse_distances(self, mention: Mention, cells: Ints) -> CoarseDistances:
        """Return the distances of cells from the candidates of a mention."""
        weights, distances = self._tier_distances(mention)
        return _coarse(weights, torch.from_numpy(self.raster.distances_m(distances, cells)))

    def _tier_distances(self, mention: Mention) -> tuple[tuple[float, ...], GroupDistances]:
        """Return the weights of the tiers of a mention's candidates, and the distances of cells from each tier."""
        tier = np.searchsorted(-np.array(TIERS[1:]), -mention.weights[: len(mention.objects)], side="left")
        tiers = np.unique(tier).tolist()
        groups = [mention.objects[tier == number] for number in tiers]
        weights = tuple(TIERS[number] for number in tiers)
        if not len(mention.lines_m):
            return weights, self.raster.distances_to(groups)
        return (1.0, *weights), self.raster.distances_to(groups, mention.lines_m)

    def coarse_kernel(self, mention: Mention, distances: CoarseDistances) -> Tensor:
        """Return the kernel [n] at cells, without directions."""
        return self._by_tier(mention, distances).amax(dim=0)

    def _by_tier(self, mention: Mention, distances: CoarseDistances) -> Tensor:
        """Return the kernel [T, n] of each tier."""
        return torch.tensor(distances.weights)[:, None] * self._kernel(mention, distances.metres)

    def coarse_kernel_mean(self, mention: Mention, distances: CoarseDistances) -> Tensor:
        """Return the mean of the kernel over cells."""
        return self.coarse_kernel(mention, distances).mean().clamp(min=MIN_KERNEL_MEAN)

    def fits(self, mention: Mention, closest: ClosestPoints, points: int) -> Tensor:
        """Return the kernel [M, 1] or [M, HEADINGS] of the likeliest object at M positions; differentiable."""
        return _best_fits(self._object_fits(mention, closest), closest, points)

    def _object_fits(self, mention: Mention, closest: ClosestPoints) -> Tensor:
        """Return the kernel [P, 1] or [P, HEADINGS] of each closest point, summed over the cue's possible angles."""
        kernels, cue = self.kernels, mention.cue
        metres, direction = _polar(closest.offset_m)
        weight = torch.from_numpy(mention.weights[closest.target]).float()
        if mention.side is not None:  # seen from its north side, a street lies in the south
            weight = weight * kernels.on_side(-metres * (direction @ _unit_vectors(radians(mention.side))))
        if cue.wind is not None:
            cosine = direction @ _unit_vectors(radians(cue.wind))
            return (weight * self._kernel(mention, metres) * kernels.toward(kernels.wind, cosine, metres))[:, None]
        first, density, terms = 0.0, torch.zeros(0), list[Tensor]()
        for angle, p in cue.angles or ((cue.angle, 1.0),):
            fits = (p * weight * self._distance_kernel(kernel_of(mention, angle), cue, metres))[:, None]
            if angle is None:
                terms.append(fits)
                continue
            if not len(density):
                first, cosines = angle, direction @ _unit_vectors(radians(angle) + HEADINGS_RAD)
                density = kernels.toward(kernels.ego, cosines, metres[:, None])
            # An object on the right of a speaker who looks north is ahead of one who looks east.
            steps = round((angle - first) * HEADINGS / 360.0)
            terms.append(fits * (density.roll(-steps, 1) if steps else density))
        return reduce(torch.add, terms)

    def _kernel(self, mention: Mention, metres: Tensor) -> Tensor:
        return self._distance_kernel(kernel_of(mention, mention.cue.angle), mention.cue, metres)

    def _distance_kernel(self, kernel: int, cue: Cue, metres: Tensor) -> Tensor:
        """Return the kernel of a stated distance, or that of a type of TYPES."""
        if cue.distance_m is not None:
            return self.kernels.stated_distance(metres, cue.distance_m, is_loose=cue.is_loose)
        return self.kernels.near(kernel, metres)

    def log_evidence(self, mention: Mention, fits: Tensor, mean: Tensor) -> Tensor:
        """Return the log ratio of a mention's likelihood to its mean over the map."""
        floor = self._floor(mention)
        return torch.log(floor + (1 - floor) * fits / mean)

    def _floor(self, mention: Mention) -> Tensor:
        """Return the probability that a mention is no evidence."""
        if mention.form == "point":
            return torch.tensor(CODE_FLOOR)
        return 1 - (1 - self.kernels.floor[FLOOR_NAMES.index(floor_name(mention))].sigmoid()) * mention.trust

    def from_listener(self, placed: PlacedMentions, points_m: Floats) -> Tensor:
        """Return the log density [M] of positions [M, 2] in the stated direction from the listener."""
        if placed.listener_m is None or placed.listener_wind is None:
            return torch.zeros(len(points_m))
        metres, direction = _polar(points_m - placed.listener_m)
        cosine = direction @ _unit_vectors(radians(placed.listener_wind))
        return self.kernels.toward(self.kernels.listener, cosine, metres).log()


def _best_fits(fits: Tensor, closest: ClosestPoints, points: int) -> Tensor:
    """Return the highest of the kernels [P, H] of closest points at each of M positions, [M, H]; 0 without any."""
    index = torch.from_numpy(closest.point)[:, None].expand_as(fits)
    return torch.zeros(points, fits.shape[1]).scatter_reduce(0, index, fits, "amax")


def _polar(offset_m: Floats) -> tuple[Tensor, Tensor]:
    """Return the lengths [P] and directions [P, 2] of offsets [P, 2]; an offset of length 0 has no direction."""
    offset = torch.from_numpy(offset_m).float()
    metres = torch.linalg.vector_norm(offset, dim=1)
    return metres, offset / metres.clamp(min=1e-9)[:, None]


def _unit_vectors(bearing: float | Floats) -> Tensor:
    """Return east and north [2, ...] of bearings, radians clockwise from north."""
    return torch.from_numpy(np.stack([np.sin(bearing), np.cos(bearing)])).float()


def _coarse(weights: tuple[float, ...], metres: Tensor) -> CoarseDistances:
    return CoarseDistances(weights, (metres - GRID_ERROR_M).clamp(0.0, 1e6).float())
