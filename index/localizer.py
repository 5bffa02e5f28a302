"""From a description to candidates and a position, with what is not known stated."""

import time
from collections.abc import Callable, Sequence
from functools import cached_property, partial
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
    Method,
    Query,
    Wgs84,
)
from index.artifact import Manifest, check_model, open_version
from index.gallery import Gallery
from index.map_data import MapData
from index.map_posterior import MapPosterior
from index.posterior_answers import PosteriorAnswers
from index.ranking import Ranker
from index.refinement import Refinement, Refiner
from index.uncertainty import covariance_of, radius_of
from models.city.colours import PALETTES
from models.city.frame import Frame
from models.city.surroundings import Surroundings
from models.errors import WeightsError
from models.localization.checkpoint import load_fine
from models.posterior.model import load_posterior
from models.retrieval.checkpoint import load_retriever
from models.retrieval.levels import Levels

Floats = npt.NDArray[np.floating[Any]]
DEPTH = 2000  # cells that a posterior looks at; what is beyond is bounded, see `_posterior`


class Localizer:
    """Answers queries about one map, with one model. Not thread-safe: one thread owns it.

    Args:
        ranker: the model, with its vectors of the gallery.
        gallery: the cells.
        manifest: what the index says of itself.
        load_refiner: reads a model of the fine stage; called when the first query asks for one.
        load_map_posterior: the same of the hint posterior; None if there is none.
    """

    def __init__(
        self,
        ranker: Ranker,
        gallery: Gallery,
        manifest: Manifest,
        load_refiner: Callable[[], Refiner] = load_fine,
        load_map_posterior: Callable[[], MapPosterior] | None = None,
    ) -> None:
        self.ranker, self.gallery, self.manifest, self._load_refiner = ranker, gallery, manifest, load_refiner
        self._load_map_posterior = load_map_posterior
        self.retriever, self.store = ranker.retriever, ranker.store
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
    def open(
        cls,
        index_dir: Path,
        weights_dir: Path | None = None,
        fine_weights_dir: Path | None = None,
        posterior_weights_dir: Path | None = None,
    ) -> "Localizer":
        """Open an index directory (what its alias "default" names) or one version of it.

        Args:
            index_dir: as it says.
            weights_dir: the retriever's; None for those that ship with the package.
            fine_weights_dir: the same of the fine stage; read when the first query asks for it.
            posterior_weights_dir: the same of the hint posterior.

        Raises:
            IndexBroken: the index is missing, incomplete or changed.
            IndexMismatch: another model built it.
            WeightsError: the model cannot be loaded.
        """
        directory, manifest = open_version(index_dir)
        retriever = load_retriever(weights_dir)
        check_model(manifest, retriever.fingerprint)
        gallery = Gallery.load(directory)

        def load_map_posterior() -> MapPosterior:
            palette = PALETTES[manifest.palette]
            return MapPosterior(load_posterior(posterior_weights_dir), gallery, palette, Surroundings.load(directory))

        load_refiner = partial(load_fine, fine_weights_dir)
        return cls(Ranker.load(retriever, directory), gallery, manifest, load_refiner, load_map_posterior)

    def map_data(self) -> MapData:
        """The map of the index, as the evaluation takes it."""
        return MapData(
            name=self.map_name,
            split="index",
            gallery=self.gallery,
            palette=PALETTES[self.manifest.palette],
            frame=self.frame,
            grid_m=self.manifest.grid_m,
            attribution=self.attribution,
        )

    @cached_property
    def refinement(self) -> Refinement:
        """The fine stage on this gallery.

        Raises:
            WeightsError: its model cannot be loaded.
        """
        return Refinement(self._load_refiner(), self.gallery)

    @cached_property
    def map_posterior(self) -> MapPosterior:
        """The hint posterior on this gallery.

        Raises:
            WeightsError: its model cannot be loaded.
            IndexBroken: nor can the surroundings.
        """
        if self._load_map_posterior is None:
            raise WeightsError("this localizer has no posterior; ask with refine none")
        return self._load_map_posterior()

    def localize(self, queries: Sequence[Query]) -> list[Answer]:
        """Answer queries, in order; the text encoder runs once for all that is new to it.

        Raises:
            WeightsError: a query asks for a model that cannot be loaded.
        """
        by_vectors = [query for query in queries if query.refine != "posterior"]
        start = time.perf_counter()
        texts = iter(self.retriever.encode_texts([query.hints for query in by_vectors]) if by_vectors else ())
        encode_ms = (time.perf_counter() - start) * 1000
        return [
            self._posterior_answers.answer(query)
            if query.refine == "posterior"
            else self._answer(query, next(texts), encode_ms)
            for query in queries
        ]

    @cached_property
    def _posterior_answers(self) -> PosteriorAnswers:
        return PosteriorAnswers(self.map_posterior, self.frame, self.manifest.cell_size_m)

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

    def _answer(self, query: Query, text: Levels, encode_ms: float) -> Answer:
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
        is_clear = estimate.radius_m.p50 <= self.manifest.cell_size_m
        timings = {"encode": encode_ms, "search": search_ms, "estimate": (time.perf_counter() - start) * 1000}
        return Answer("ok" if is_clear else "ambiguous", estimate, candidates, other, (), timings)

    def _candidates(self, query: Query, text: Levels) -> tuple[npt.NDArray[np.int64], Floats, int]:
        """Rows and scores of the cells to consider, and how many cells scored less and were left out."""
        if query.within is None and query.prior is None:
            scores, rows = self.ranker.rank([text], DEPTH)
            return rows[0], scores[0], len(self.store) - len(rows[0])
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
        logits = scores.astype(np.float64) / self.retriever.temperature(len(query.hints))
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
            positions[: query.top_k] = self.refinement.positions_m([query.hints], rows[None, : query.top_k])[0]
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
        edge_m = self.manifest.grid_m
        if query.refine != "none":
            model = self.refinement.model
            method, edge_m = model.method, edge_m if model.error_m is None else model.error_m * 12**0.5
        covariance = covariance_of(positions, probability, edge_m, self._extent_m)
        return Estimate(
            position=_pair(positions[0]),
            method=method,
            covariance=(_pair(covariance[0]), _pair(covariance[1])),
            radius_m=radius_of(positions, probability, edge_m, self._extent_m),
            probability=float(probability[0]),
            wgs84=self._wgs84(positions[0]),
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
            wgs84=self._wgs84(position),
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
