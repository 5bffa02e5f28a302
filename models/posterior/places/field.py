"""Likelihood of mentions on a map: log p(T | x), approximate at cells, exact at nodes, summed over headings."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from math import log, pi, radians
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
from models.posterior.places.explanations import UNEXPLAINED, MentionExplanation, Places
from models.posterior.places.kernels import HEADINGS, SURE, PlaceKernels, kernel_of, sure_of

FEW_REACH, MANY_REACH = 5.0, 2.5  # scales of a kernel, as far as which objects are looked at
MANY: Final = 60  # objects
SLACK_M: Final = 20.0
MOST_REACH_M: Final = 250.0
SAID_REACH, FARTHEST_M = 2.5, 600.0  # the same of distances that were said
ROUGH_M: Final = 5.0  # what a distance on the grid may be too long by
LEAST: Final = 1e-6  # of a kernel's mean
FAINT: Final = 0.02  # what fits nowhere better than this is not near the map
KEPT: Final = 32  # mentions: those of one text
HEADINGS_RAD: Final = np.arange(HEADINGS) * (2 * pi / HEADINGS)
TIERS: Final = (1.0, 0.7, 0.4, 0.2)  # weights on the grid are rounded to these


@dataclass(frozen=True, slots=True, eq=False)
class Rough:
    """Distances of cells from the candidates of a mention, to the precision of the grid.

    Attributes:
        weights: of each of T tiers of objects.
        metres: [T, n] of so many cells.
    """

    weights: tuple[float, ...]
    metres: Tensor


class PlaceEvidence:
    """The evidence of a text's mentions: approximate at every cell, exact at any position.

    Attributes:
        places: the text's mentions on the map.
        cells: [N] about log p(T | cell).
    """

    def __init__(self, field: "PlaceField", places: Places, cells: Floats) -> None:
        self._field, self.places, self.cells = field, places, cells

    @torch.inference_mode()
    def at(self, points_m: Floats, group: Ints) -> Floats:
        """[M] log p(T | x) of positions [M, 2]; `group` as `PlaceField.log_p`."""
        if not len(points_m):
            return np.zeros(0)
        log_p: Floats = self._field.log_p(self.places, points_m, group).double().numpy()
        return log_p


class PlaceField:
    """The gazetteer of one gallery.

    Args:
        kernels: fitted.
        gazetteer: of the map.
        centers_m: [N, 2] of the cells.
        spacing_m: of their grid.
    """

    def __init__(self, kernels: PlaceKernels, gazetteer: Gazetteer, centers_m: Floats, spacing_m: float) -> None:
        self.kernels, self.gazetteer, self._centers_m = kernels, gazetteer, centers_m
        self._lately: LRUCache[Mention, tuple[Floats, Ints, npt.NDArray[np.bool_]]] = LRUCache(KEPT)
        has_walkways = WALKED_KIND in gazetteer.by_kind
        self._walkways = Walkways(gazetteer, *bounding_corners(centers_m)) if has_walkways else None
        self.raster = DistanceRaster(gazetteer, centers_m, spacing_m)

    @torch.inference_mode()
    def told(
        self,
        mentions: Sequence[Mention],
        listener_m: Floats | None = None,
        listener_wind: float | None = None,
        *,
        is_meeting: bool = False,
    ) -> PlaceEvidence:
        """A text on this map.

        Args:
            mentions: what it names.
            listener_m: [2] where the listener is, if that is known.
            listener_wind: degrees from the listener to the speaker, if that is said.
            is_meeting: whether the place told of is not where the speaker stands.
        """
        kept, common, total = [], [], np.zeros(self.raster.shape, np.float32)
        for mention in mentions:
            if not len(mention.objects) and not len(mention.lines_m):
                continue
            weights, away = self._away(mention)
            both = (torch.from_numpy(steps_m) for steps_m in (self.raster.steps_m, self.raster.block_steps_m))
            fits = [self._by_tier(mention, _rough(weights, steps_m.expand(len(weights), -1))) for steps_m in both]
            mean, most = self.raster.mean_and_max(away, fits[0].numpy(), fits[1].numpy())
            if most < FAINT:
                continue  # none of it is near the map
            kept.append(mention)
            common.append(torch.tensor(mean).clamp(min=LEAST))
            worth = [self.worth(mention, each, common[-1]).numpy() for each in fits]
            self.raster.add_best(total, away, worth[0], worth[1])
        places = Places(
            tuple(kept), torch.stack(common) if common else torch.zeros(0), listener_m, listener_wind, is_meeting
        )
        at_cells = torch.from_numpy(total.ravel()[self.raster.cell_pixel])
        at_cells = self.kernels.temper.exp() * at_cells + self.from_listener(places, self._centers_m)
        return PlaceEvidence(self, places, at_cells.double().numpy())

    def log_p(self, places: Places, points_m: Floats, group: Ints) -> Tensor:
        """[M] log p(T | x) of positions [M, 2], up to a constant; `group` ascending, of those that lie together."""
        by_heading = self.by_heading(places, points_m, group)
        total = by_heading.logsumexp(dim=1) - log(HEADINGS)
        standing = self.kernels.standing(self.walked(places, points_m))
        return self.kernels.temper.exp() * total + self.from_listener(places, points_m) + standing

    def walked(self, places: Places, points_m: Floats) -> Tensor:
        """[M] metres from positions [M, 2] to where people walk; 0 where that is not known or does not matter."""
        if self._walkways is None or places.is_meeting:
            return torch.zeros(len(points_m))
        return torch.from_numpy(self._walkways.distances_m(points_m))

    def by_heading(self, places: Places, points_m: Floats, group: Ints) -> Tensor:
        """[M, HEADINGS] log p(T | x, heading)."""
        total = torch.zeros(len(points_m), HEADINGS)
        if places.mentions:
            around = PointGroups.from_groups(points_m, group)
            for mention, mean in zip(places.mentions, places.common, strict=True):
                fits = self.fits(mention, self.ways_from(mention, around), len(points_m))
                total = total + self.worth(mention, fits, mean)
        return total

    @torch.inference_mode()
    def explain(self, places: Places, point_m: Floats) -> list[MentionExplanation]:
        """Explain each mention at a position [1, 2], in the best heading there."""
        around, found = PointGroups.from_groups(point_m, np.zeros(1, np.int64)), []
        ways = [self.ways_from(mention, around) for mention in places.mentions]
        fits = [self._fits_of_ways(mention, each) for mention, each in zip(places.mentions, ways, strict=True)]
        total = torch.zeros(HEADINGS)
        for mention, fit, mean in zip(places.mentions, fits, places.common, strict=True):
            total = total + self.worth(mention, fit.amax(dim=0) if len(fit) else torch.zeros(1), mean)
        heading = int(total.argmax())
        for mention, each, fit, mean in zip(places.mentions, ways, fits, places.common, strict=True):
            if not len(fit):
                found.append(UNEXPLAINED)
                continue
            here = fit[:, heading if fit.shape[1] > 1 else 0]
            best, floor = int(here.argmax()), self._floor(mention)
            told = (1 - floor) * here[best] / mean
            found.append(MentionExplanation(float(told / (told + floor)), int(each.target[best]), each.offset_m[best]))
        return found

    def ways_from(self, mention: Mention, around: PointGroups) -> ClosestPoints:
        """Return the closest points of a mention's candidates to grouped positions."""
        return find_closest_points(around, *self._outline(mention), self._reach_m(mention))

    @cachedmethod(lambda field: field._lately)
    def _outline(self, mention: Mention) -> tuple[Floats, Ints, npt.NDArray[np.bool_]]:
        """Segments, starts and `is_area` of what a mention may mean; a text asks for them again and again."""
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
            return min(SAID_REACH * mention.cue.distance_m + SLACK_M, FARTHEST_M)
        scale = float(self.kernels.scale[kernel_of(mention, mention.cue.angle)].detach().exp())
        reach = MANY_REACH if len(mention.objects) > MANY else FEW_REACH
        return min(reach * scale + SLACK_M, MOST_REACH_M)

    def rough(self, mention: Mention, cells: Ints) -> Rough:
        """Return the distances of cells from the candidates of a mention."""
        weights, away = self._away(mention)
        return _rough(weights, torch.from_numpy(self.raster.distances_m(away, cells)))

    def _away(self, mention: Mention) -> tuple[tuple[float, ...], GroupDistances]:
        """The weights of tiers of what a mention may mean, and how far cells are from each."""
        tier = np.searchsorted(-np.array(TIERS[1:]), -mention.weights[: len(mention.objects)], side="left")
        tiers = np.unique(tier).tolist()
        groups = [mention.objects[tier == number] for number in tiers]
        weights = tuple(TIERS[number] for number in tiers)
        if not len(mention.lines_m):
            return weights, self.raster.distances_to(groups)
        return (1.0, *weights), self.raster.distances_to(groups, mention.lines_m)

    def roughly(self, mention: Mention, rough: Rough) -> Tensor:
        """[n] the kernel at cells, without directions."""
        return self._by_tier(mention, rough).amax(dim=0)

    def _by_tier(self, mention: Mention, rough: Rough) -> Tensor:
        """[T, n] the kernel of each tier."""
        return torch.tensor(rough.weights)[:, None] * self._kernel(mention, rough.metres)

    def usual(self, mention: Mention, rough: Rough) -> Tensor:
        """Return the mean of the kernel over cells."""
        return self.roughly(mention, rough).mean().clamp(min=LEAST)

    def fits(self, mention: Mention, ways: ClosestPoints, points: int) -> Tensor:
        """[M, 1] or [M, HEADINGS] the kernel of the likeliest object, at each of M positions; differentiable."""
        fits = self._fits_of_ways(mention, ways)
        index = torch.from_numpy(ways.point)[:, None].expand_as(fits)
        return torch.zeros(points, fits.shape[1]).scatter_reduce(0, index, fits, "amax")

    def _fits_of_ways(self, mention: Mention, ways: ClosestPoints) -> Tensor:
        """[P, 1] or [P, HEADINGS] the kernel of each way, summed over the angles that the cue may mean."""
        kernels, cue = self.kernels, mention.cue
        metres, direction = _polar(ways.offset_m)
        weight = torch.from_numpy(mention.weights[ways.target]).float()
        if mention.side is not None:  # the street lies on the other side of a speaker on its north side
            weight = weight * kernels.on_side(-metres * (direction @ _unit_vectors(radians(mention.side))))
        if cue.wind is not None:
            cosine = direction @ _unit_vectors(radians(cue.wind))
            return (weight * self._kernel(mention, metres) * kernels.toward(kernels.wind, cosine, metres))[:, None]
        first, density, terms = 0.0, torch.zeros(0), list[Tensor]()
        for angle, p in cue.angles or ((cue.angle, 1.0),):
            fits = (p * weight * self._near(kernel_of(mention, angle), cue, metres))[:, None]
            if angle is None:
                terms.append(fits)
                continue
            if not len(density):
                first, cosines = angle, direction @ _unit_vectors(radians(angle) + HEADINGS_RAD)
                density = kernels.toward(kernels.ego, cosines, metres[:, None])
            # What is on the right of a speaker who looks north is ahead of one who looks east.
            steps = round((angle - first) * HEADINGS / 360.0)
            terms.append(fits * (density.roll(-steps, 1) if steps else density))
        return reduce(torch.add, terms)

    def _kernel(self, mention: Mention, metres: Tensor) -> Tensor:
        return self._near(kernel_of(mention, mention.cue.angle), mention.cue, metres)

    def _near(self, kernel: int, cue: Cue, metres: Tensor) -> Tensor:
        """The kernel of a distance that was said, or the one of TYPES."""
        if cue.distance_m is not None:
            return self.kernels.said(metres, cue.distance_m, is_loose=cue.is_loose)
        return self.kernels.near(kernel, metres)

    def worth(self, mention: Mention, fits: Tensor, mean: Tensor) -> Tensor:
        """Return the log ratio of a mention's likelihood here to its mean over the map."""
        floor = self._floor(mention)
        return torch.log(floor + (1 - floor) * fits / mean)

    def _floor(self, mention: Mention) -> Tensor:
        """Return the probability that a mention is no evidence."""
        return 1 - (1 - self.kernels.floor[SURE.index(sure_of(mention))].sigmoid()) * mention.trust

    def from_listener(self, places: Places, points_m: Floats) -> Tensor:
        """Return the log density [M] of positions [M, 2] in the stated direction from the listener."""
        if places.listener_m is None or places.listener_wind is None:
            return torch.zeros(len(points_m))
        metres, direction = _polar(points_m - places.listener_m)
        cosine = direction @ _unit_vectors(radians(places.listener_wind))
        return self.kernels.toward(self.kernels.listener, cosine, metres).log()


def _polar(way_m: Floats) -> tuple[Tensor, Tensor]:
    """[P] lengths and [P, 2] directions of ways [P, 2]; a way without length has none."""
    way = torch.from_numpy(way_m).float()
    metres = torch.linalg.vector_norm(way, dim=1)
    return metres, way / metres.clamp(min=1e-9)[:, None]


def _unit_vectors(bearing: float | Floats) -> Tensor:
    """[2, ...] east and north of directions, radians clockwise from north."""
    return torch.from_numpy(np.stack([np.sin(bearing), np.cos(bearing)])).float()


def _rough(weights: tuple[float, ...], metres: Tensor) -> Rough:
    return Rough(weights, (metres - ROUGH_M).clamp(0.0, 1e6).float())
