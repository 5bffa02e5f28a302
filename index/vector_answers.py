"""Answers of vector search, with or without a fine stage, in the form that every localizer answers in."""

import time
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.special import logsumexp

from index.answers import Answer, Box, Candidate, Circle, Estimate, Method, Query, Wgs84
from index.ranking import Ranker
from index.refinement import Refinement
from index.uncertainty import covariance_of, radius_of
from models.city.frame import Frame
from models.city.gallery import Gallery
from models.retrieval.levels import Levels

Floats = npt.NDArray[np.floating[Any]]
DEPTH = 2000  # cells that a probability looks at; what is beyond is bounded, see `_posterior`


class VectorAnswers:
    """Answers queries about one map by the cells' vectors.

    Args:
        ranker: the model, with its vectors of the gallery.
        gallery: the cells.
        frame: of the map.
        cell_size_m: of a cell's side; an answer is clear if it is surer than this.
        grid_m: spacing of the cells.
        refinement: gives the fine stage; called when a query asks for it.
    """

    def __init__(
        self,
        ranker: Ranker,
        gallery: Gallery,
        frame: Frame,
        cell_size_m: float,
        grid_m: float,
        refinement: Callable[[], Refinement],
    ) -> None:
        self.ranker, self.gallery, self.frame, self.refinement = ranker, gallery, frame, refinement
        self.cell_size_m, self.grid_m = cell_size_m, grid_m
        self._centers = gallery.cells.center_m[:, :2]
        self._extent_m = float(np.linalg.norm(np.ptp(self._centers, axis=0)) + cell_size_m)

    def answer(self, query: Query, text: Levels, encode_ms: float) -> Answer:
        """Answer one query.

        Args:
            query: what was asked.
            text: its hints, encoded.
            encode_ms: how long that took.
        """
        start = time.perf_counter()
        rows, scores, unseen = self._candidates(query, text)
        search_ms = (time.perf_counter() - start) * 1000
        if not len(rows):
            warning = "no cell of the map lies inside 'within'; move it onto the map or leave it out"
            return Answer("no_match", None, (), 1.0, (warning,), {"encode": encode_ms, "search": search_ms})
        start = time.perf_counter()
        probability = self._posterior(query, rows, scores, unseen)
        order = np.lexsort((rows, -probability))
        rows, scores, probability = rows[order], scores[order], probability[order]
        positions = self._positions(query, rows)
        estimate = self._estimate(query, positions, probability)
        listed = range(min(query.top_k, len(rows)))
        candidates = tuple(self._candidate(i + 1, rows[i], scores[i], probability[i], positions[i]) for i in listed)
        other = max(0.0, 1.0 - sum(candidate.probability for candidate in candidates))
        is_clear = estimate.radius_m.p50 <= self.cell_size_m
        timings = {"encode": encode_ms, "search": search_ms, "estimate": (time.perf_counter() - start) * 1000}
        return Answer("ok" if is_clear else "ambiguous", estimate, candidates, other, (), timings)

    def _candidates(self, query: Query, text: Levels) -> tuple[npt.NDArray[np.int64], Floats, int]:
        """Rows and scores of the cells to consider, and how many cells scored less and were left out."""
        if query.within is None and query.prior is None:
            scores, rows = self.ranker.rank([text], DEPTH)
            return rows[0], scores[0], len(self.ranker.store) - len(rows[0])
        # A filter or a prior: the vectors' order is not the answer's, so score all that may be in it.
        rows = np.flatnonzero(self._inside(query))
        return rows, self.ranker.score(text, rows), 0

    def _inside(self, query: Query) -> npt.NDArray[np.bool_]:
        """[N] True where a cell's centre is inside `within`."""
        within = query.within
        if isinstance(within, Box):
            x, y = self._coordinates(query.crs)
            return (x >= within.west) & (x <= within.east) & (y >= within.south) & (y <= within.north)
        if isinstance(within, Circle):
            offset = self._centers - self._to_map(within.center, query.crs)
            return np.asarray(np.hypot(offset[:, 0], offset[:, 1]) <= within.radius_m)
        return np.ones(len(self._centers), dtype=bool)

    def _coordinates(self, crs: str) -> tuple[Floats, Floats]:
        """The cells' centres as (x, y) or (lon, lat)."""
        if crs == "map":
            return self._centers[:, 0], self._centers[:, 1]
        lat, lon = self.frame.to_wgs84(self._centers)
        return lon, lat

    def _to_map(self, position: tuple[float, float], crs: str) -> Floats:
        return np.asarray(position) if crs == "map" else self.frame.from_wgs84(position[1], position[0])

    def _posterior(self, query: Query, rows: npt.NDArray[np.int64], scores: Floats, unseen: int) -> Floats:
        """[len(rows)] probability that each cell is the right one.

        softmax(score / T) over the gallery, with T fitted on validation queries (`Retriever.temperature`). Cells
        that were left out count as if each scored like the last one seen, so doubt is never understated.
        """
        logits = scores.astype(np.float64) / self.ranker.retriever.temperature(len(query.hints))
        if query.prior is not None:
            offset = self._centers[rows] - self._to_map(query.prior.position, query.crs)
            logits = logits - (offset**2).sum(axis=1) / (2 * query.prior.sigma_m**2)
        rest = np.log(unseen) + logits.min() if unseen else -np.inf
        probability: Floats = np.exp(logits - np.logaddexp(logsumexp(logits), rest))
        return probability

    def _positions(self, query: Query, rows: npt.NDArray[np.int64]) -> Floats:
        """[len(rows), 2] the best position in each cell: what will be listed may be refined, the rest are centres."""
        positions: Floats = self._centers[rows].astype(np.float64)
        if query.refine != "none":
            positions[: query.top_k] = self.refinement().positions_m([query.hints], rows[None, : query.top_k])[0]
        return positions

    def _estimate(self, query: Query, positions: Floats, probability: Floats) -> Estimate:
        """The position in the best cell, and how far the true one may be from it.

        Args:
            query: what was asked.
            positions: [C, 2] in each cell, the best cell first.
            probability: [C] of the cells.
        """
        # In its cell the position is in the square nearest to the centre, or in one as wide as the fine stage errs.
        method: Method = "cell_center"
        edge_m = self.grid_m
        if query.refine != "none":
            model = self.refinement().model
            method, edge_m = model.method, edge_m if model.error_m is None else model.error_m * 12**0.5
        covariance = covariance_of(positions, probability, edge_m, self._extent_m)
        return Estimate(
            position=_pair(positions[0]),
            method=method,
            covariance=(_pair(covariance[0]), _pair(covariance[1])),
            radius_m=radius_of(positions, probability, edge_m, self._extent_m),
            probability=float(probability[0]),
            wgs84=Wgs84.of(positions[0], self.frame),
        )

    def _candidate(self, rank: int, row: int, score: float, probability: float, position: Floats) -> Candidate:
        center = self._centers[row]
        return Candidate(
            rank=rank,
            cell_id=self.gallery.cells.ids[row],
            score=float(score),
            probability=float(probability),
            center=_pair(center),
            bbox=self._bbox(row),
            position=_pair(position),
            wgs84=Wgs84.of(position, self.frame),
        )

    def _bbox(self, row: int) -> tuple[float, float, float, float]:
        half = self.cell_size_m / 2
        x, y = (float(v) for v in self._centers[row])
        return (x - half, y - half, x + half, y + half)


def _pair(values: Floats) -> tuple[float, float]:
    return float(values[0]), float(values[1])
