"""Answers of the hint posterior, in the form that every localizer answers in."""

import time

import numpy as np
import numpy.typing as npt

from index.answers import (
    Answer,
    Box,
    Candidate,
    Circle,
    Estimate,
    Evidence,
    HeatMap,
    Query,
    Radius,
    Status,
    Wgs84,
)
from index.map_posterior import EXPLAINED, MapPosterior
from models.city.frame import Frame
from models.city.types import Floats
from models.posterior.locate import Located
from models.posterior.posterior import LogPrior
from models.posterior.surroundings import SPACING_M

HEAT_POINTS = 500
NOTHING_SAID = (
    "nothing in the description says what is around the speaker; name things and directions, for example "
    "'I am north of a gray building.'"
)
NOWHERE = "no position of the map lies inside 'within'; move it onto the map or leave it out"
NOTHING_FITS = "nothing that is said was found on the map; is it the right map?"


class PosteriorAnswers:
    """Answers queries about one map by the hint posterior.

    Args:
        posterior: of the map.
        frame: of the map.
        cell_size_m: an answer is clear if it is surer than this.
    """

    def __init__(self, posterior: MapPosterior, frame: Frame, cell_size_m: float) -> None:
        self.posterior, self.frame, self.cell_size_m = posterior, frame, cell_size_m
        self._cells = posterior.gallery.cells

    def answer(self, query: Query) -> Answer:
        """Answer one query."""
        start = time.perf_counter()
        noticed = self.posterior.notice(query.hints)
        if not noticed:
            return _no_match(NOTHING_SAID, {"encode": _since(start)})
        reading = self.posterior.reading(noticed)
        timings = {"encode": _since(start)}
        start = time.perf_counter()
        inside = None if query.within is None else self._inside(query)
        located = self.posterior.locate(reading, self._log_prior(query), inside)
        timings["search"] = _since(start)
        if located is None:
            return _no_match(NOWHERE, timings)
        start = time.perf_counter()
        evidence = self.posterior.evidence(noticed, reading, located)
        if not any(hint.explained >= EXPLAINED for hint in evidence):
            return _no_match(NOTHING_FITS, timings, evidence)
        estimate = self._estimate(located)
        candidates = tuple(self._candidate(located, n) for n in range(min(query.top_k, len(located.rows))))
        is_clear = estimate.radius_m.p50 <= self.cell_size_m
        heat_map = _heat_map(located) if query.heat_map else None
        timings["estimate"] = _since(start)
        other = max(0.0, 1.0 - sum(candidate.probability for candidate in candidates))
        status: Status = "ok" if is_clear else "ambiguous"
        return Answer(status, estimate, candidates, other, (), timings, evidence, heat_map)

    def _inside(self, query: Query) -> npt.NDArray[np.bool_]:
        """[M] True where a node is inside `within`."""
        nodes_m, within = self.posterior.posterior.nodes_m, query.within
        if isinstance(within, Circle):
            offset = nodes_m - self._to_map(within.center, query.crs)
            return np.asarray(np.hypot(offset[:, 0], offset[:, 1]) <= within.radius_m)
        assert isinstance(within, Box)
        x, y = nodes_m.T
        if query.crs == "wgs84":
            y, x = self.frame.to_wgs84(nodes_m)
        return np.asarray((x >= within.west) & (x <= within.east) & (y >= within.south) & (y <= within.north))

    def _log_prior(self, query: Query) -> LogPrior | None:
        if query.prior is None:
            return None
        center, sigma_m = self._to_map(query.prior.position, query.crs), query.prior.sigma_m

        def log_prior(positions_m: Floats) -> Floats:
            density: Floats = -((positions_m - center) ** 2).sum(axis=1) / (2 * sigma_m**2)
            return density

        return log_prior

    def _to_map(self, position: tuple[float, float], crs: str) -> Floats:
        return np.asarray(position) if crs == "map" else self.frame.from_wgs84(position[1], position[0])

    def _estimate(self, located: Located) -> Estimate:
        covariance = located.covariance(self.posterior.extent_m, SPACING_M)
        p50, p90 = self.posterior.radii_m(located)
        x, y = located.positions[0].tolist()
        return Estimate(
            position=(x, y),
            method="posterior",
            covariance=(
                (float(covariance[0, 0]), float(covariance[0, 1])),
                (float(covariance[1, 0]), float(covariance[1, 1])),
            ),
            radius_m=Radius(p50, p90),
            probability=float(located.probability[0]),
            wgs84=Wgs84.of(located.positions[0], self.frame),
        )

    def _candidate(self, located: Located, n: int) -> Candidate:
        row = int(located.rows[n])
        x, y = self._cells.center_m[row, :2].tolist()
        half = self._cells.size_m / 2
        position = located.positions[n]
        return Candidate(
            rank=n + 1,
            cell_id=self._cells.ids[row],
            score=float(located.log_mass[n]),
            probability=float(located.probability[n]),
            center=(x, y),
            bbox=(x - half, y - half, x + half, y + half),
            position=(float(position[0]), float(position[1])),
            wgs84=Wgs84.of(position, self.frame),
        )


def _no_match(warning: str, timings_ms: dict[str, float], evidence: tuple[Evidence, ...] = ()) -> Answer:
    return Answer("no_match", None, (), 1.0, (warning,), timings_ms, evidence)


def _heat_map(located: Located) -> HeatMap:
    order = np.argsort(-located.weight, kind="stable")[:HEAT_POINTS]
    rows = np.column_stack([located.nodes_m[order], located.weight[order]])
    return HeatMap(SPACING_M, tuple((round(x, 2), round(y, 2), p) for x, y, p in rows.tolist()))


def _since(start: float) -> float:
    return (time.perf_counter() - start) * 1000
