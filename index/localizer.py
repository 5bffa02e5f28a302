"""From a description to candidates and a position, with what is not known stated."""

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.special import logsumexp

from index.answers import (
    Answer,
    Box,
    Candidate,
    CellDetail,
    CellInstance,
    Circle,
    Estimate,
    Query,
    Radius,
    Wgs84,
)
from index.artifact import Manifest, check_model, open_version
from index.build import VECTORS_FILE
from index.gallery import Gallery
from index.store import FaissStore, VectorStore
from models.city.colours import PALETTES
from models.city.frame import Frame
from models.retrieval.checkpoint import load_retriever
from models.retrieval.retriever import Retriever

Floats = npt.NDArray[np.floating[Any]]
DEPTH = 2000  # cells that a posterior looks at; what is beyond is bounded, see `_posterior`


class Localizer:
    """Answers queries about one map, with one model. Not thread-safe: one thread owns it.

    Args:
        retriever: the model that made the store's vectors.
        store: vectors of the gallery's cells.
        gallery: the cells.
        manifest: what the index says of itself.
    """

    def __init__(self, retriever: Retriever, store: VectorStore, gallery: Gallery, manifest: Manifest) -> None:
        self.retriever, self.store, self.gallery, self.manifest = retriever, store, gallery, manifest
        self.frame = Frame(**manifest.frame.model_dump())
        self._centers = gallery.cells.center_m[:, :2]
        self._row = {cell_id: row for row, cell_id in enumerate(gallery.cells.ids)}
        self._extent_m = float(np.linalg.norm(np.ptp(self._centers, axis=0)) + manifest.cell_size_m)

    @property
    def map_name(self) -> str:
        """The map."""
        return self.manifest.map_name

    @property
    def attribution(self) -> str:
        """What the map data's licence asks to show."""
        return self.manifest.attribution

    @property
    def index_version(self) -> str:
        """The index that is served."""
        return self.manifest.version

    @property
    def created(self) -> str:
        """When the index was built, ISO 8601."""
        return self.manifest.created

    @property
    def model(self) -> str:
        """What kind of model answers."""
        return self.retriever.name

    @property
    def model_sha256(self) -> str:
        """Fingerprint of its weights."""
        return self.manifest.model_fingerprint

    @property
    def num_cells(self) -> int:
        """Cells in the index."""
        return len(self.store)

    @property
    def num_instances(self) -> int:
        """Instances of the map."""
        return self.manifest.instances

    @property
    def dim(self) -> int:
        """Width of the vectors."""
        return self.store.dim

    @classmethod
    def open(cls, index_dir: Path, weights_dir: Path | None = None) -> "Localizer":
        """Open an index directory (what its alias "default" names) or one version of it.

        Raises:
            IndexBroken: the index is missing, incomplete or changed.
            IndexMismatch: another model built it.
            WeightsError: the model cannot be loaded.
        """
        directory, manifest = open_version(index_dir)
        retriever = load_retriever(weights_dir)
        check_model(manifest, retriever.fingerprint)
        return cls(retriever, FaissStore.load(directory / VECTORS_FILE), Gallery.load(directory), manifest)

    def localize(self, queries: Sequence[Query]) -> list[Answer]:
        """Answer queries, in order; the text encoder runs once for all that is new to it."""
        start = time.perf_counter()
        vectors = self.retriever.encode_descriptions([query.hints for query in queries])
        encode_ms = (time.perf_counter() - start) * 1000
        return [self._answer(query, vector, encode_ms) for query, vector in zip(queries, vectors, strict=True)]

    def cell(self, cell_id: str) -> CellDetail | None:
        """A cell and what is in it; None if there is no such cell."""
        row = self._row.get(cell_id)
        if row is None:
            return None
        parts = self.gallery.cells.parts
        rows = np.arange(parts.starts[row], parts.starts[row + 1])
        palette = PALETTES[self.manifest.palette]
        center = self.gallery.cells.center_m[row]
        return CellDetail(
            cell_id=cell_id,
            scene=self.gallery.cells.scenes[row],
            center=_triple(center),
            bbox=self._bbox(row),
            wgs84=self._wgs84(center),
            instances=tuple(
                CellInstance(
                    label=self.gallery.labels[parts.instance[r]],
                    name=self.gallery.names[parts.instance[r]],
                    source_id=self.gallery.sources[parts.instance[r]],
                    colour=palette.word(parts.rgb[r]),
                    points=int(parts.count[r]),
                    center=_triple((parts.low_m[r] + parts.high_m[r]) / 2),
                    size=_triple(parts.high_m[r] - parts.low_m[r]),
                    closest=_triple(parts.closest_m[r]),
                )
                for r in rows
            ),
        )

    def _answer(self, query: Query, vector: npt.NDArray[np.float32], encode_ms: float) -> Answer:
        start = time.perf_counter()
        rows, scores, unseen = self._candidates(query, vector)
        search_ms = (time.perf_counter() - start) * 1000
        if not len(rows):
            warning = "no cell of the map lies inside 'within'; move it onto the map or leave it out"
            return Answer("no_match", None, (), 1.0, (warning,), {"encode": encode_ms, "search": search_ms})
        start = time.perf_counter()
        probability = self._posterior(query, rows, scores, unseen)
        order = np.lexsort((rows, -probability))
        rows, scores, probability = rows[order], scores[order], probability[order]
        estimate = self._estimate(rows, probability)
        listed = range(min(query.top_k, len(rows)))
        candidates = tuple(self._candidate(i + 1, rows[i], scores[i], probability[i]) for i in listed)
        other = max(0.0, 1.0 - sum(candidate.probability for candidate in candidates))
        is_clear = estimate.radius_m.p50 <= self.manifest.cell_size_m
        timings = {"encode": encode_ms, "search": search_ms, "estimate": (time.perf_counter() - start) * 1000}
        return Answer("ok" if is_clear else "ambiguous", estimate, candidates, other, (), timings)

    def _candidates(self, query: Query, vector: npt.NDArray[np.float32]) -> tuple[npt.NDArray[np.int64], Floats, int]:
        """Rows and scores of the cells to consider, and how many cells scored less and were left out."""
        if query.within is None and query.prior is None:
            scores, rows = self.store.search(vector[None], DEPTH)
            return rows[0], scores[0], len(self.store) - len(rows[0])
        # A filter or a prior: the vectors' order is not the answer's, so score all that may be in it.
        rows = np.flatnonzero(self._inside(query))
        return rows, self.store.score(vector, rows), 0

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
        logits = scores.astype(np.float64) / self.retriever.temperature(len(query.hints))
        if query.prior is not None:
            offset = self._centers[rows] - self._to_map(query.prior.position, query.crs)
            logits = logits - (offset**2).sum(axis=1) / (2 * query.prior.sigma_m**2)
        rest = np.log(unseen) + logits.min() if unseen else -np.inf
        probability: Floats = np.exp(logits - np.logaddexp(logsumexp(logits), rest))
        return probability

    def _estimate(self, rows: npt.NDArray[np.int64], probability: Floats) -> Estimate:
        """The best cell's centre, and how far the true position may be from it."""
        position = self._centers[rows[0]]
        offset = self._centers[rows] - position
        unseen = max(0.0, 1.0 - float(probability.sum()))
        # Inside its cell a position is anywhere in the square that is nearest to the centre.
        spread = np.eye(2) * (self.manifest.grid_m**2 / 12 + unseen * self._extent_m**2 / 12)
        covariance = (offset * probability[:, None]).T @ offset + spread
        step = self.manifest.grid_m / 3
        around = np.array([[i, j] for i in (-1, 0, 1) for j in (-1, 0, 1)]) * step
        distance = np.linalg.norm(offset[:, None] + around, axis=2).ravel()
        order = np.argsort(distance)
        mass = np.cumsum(np.repeat(probability / 9, 9)[order])
        p50, p90 = (self._quantile(distance[order], mass, share) for share in (0.5, 0.9))
        return Estimate(
            position=_pair(position),
            method="cell_center",
            covariance=(_pair(covariance[0]), _pair(covariance[1])),
            radius_m=Radius(p50, p90),
            probability=float(probability[0]),
            wgs84=self._wgs84(position),
        )

    def _quantile(self, distance: Floats, mass: Floats, share: float) -> float:
        """The distance that holds a share of the mass; the whole map if what is listed does not."""
        found = int(np.searchsorted(mass, share))
        return float(distance[found]) if found < len(distance) else self._extent_m

    def _candidate(self, rank: int, row: int, score: float, probability: float) -> Candidate:
        center = self._centers[row]
        return Candidate(
            rank=rank,
            cell_id=self.gallery.cells.ids[row],
            score=float(score),
            probability=float(probability),
            center=_pair(center),
            bbox=self._bbox(row),
            position=_pair(center),
            wgs84=self._wgs84(center),
        )

    def _bbox(self, row: int) -> tuple[float, float, float, float]:
        half = self.manifest.cell_size_m / 2
        x, y = (float(v) for v in self._centers[row])
        return (x - half, y - half, x + half, y + half)

    def _wgs84(self, position_m: Floats) -> Wgs84 | None:
        if not self.frame.is_georeferenced:
            return None
        lat, lon = self.frame.to_wgs84(position_m)
        return Wgs84(round(float(lat), 7), round(float(lon), 7))


def _pair(values: Floats) -> tuple[float, float]:
    return float(values[0]), float(values[1])


def _triple(values: Floats) -> tuple[float, float, float]:
    return round(float(values[0]), 3), round(float(values[1]), 3), round(float(values[2]), 3)
