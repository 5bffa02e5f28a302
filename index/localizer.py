"""From a description to candidates and a position, with what is not known stated."""

import time
from collections.abc import Callable, Sequence
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from index.answers import (
    Answer,
    CellDetail,
    CellInstance,
    Query,
    Wgs84,
)
from index.artifact import Manifest, check_model, open_version
from index.map_posterior import MapPosterior
from index.posterior_answers import PosteriorAnswers
from index.ranking import Ranker
from index.refinement import Refinement, Refiner
from index.vector_answers import VectorAnswers
from models.city.colours import PALETTES
from models.city.frame import Frame
from models.city.gallery import Gallery, MapData
from models.errors import WeightsError
from models.localization.checkpoint import load_fine
from models.posterior.model import load_posterior
from models.posterior.surroundings import Surroundings
from models.retrieval.checkpoint import load_retriever

Floats = npt.NDArray[np.floating[Any]]


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
        self._row = {cell_id: row for row, cell_id in enumerate(gallery.cells.ids)}

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
            else self.vector_answers.answer(query, next(texts), encode_ms)
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
        center, half_m = self.gallery.cells.center_m[row], self.manifest.cell_size_m / 2
        x, y = (float(v) for v in center[:2])
        return CellDetail(
            cell_id=cell_id,
            scene=self.gallery.cells.scenes[row],
            center=_triple(center),
            bbox=(x - half_m, y - half_m, x + half_m, y + half_m),
            wgs84=Wgs84.of(center, self.frame),
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

    @cached_property
    def vector_answers(self) -> VectorAnswers:
        """Vector search on this gallery."""
        manifest = self.manifest
        size_m, grid_m = manifest.cell_size_m, manifest.grid_m
        return VectorAnswers(self.ranker, self.gallery, self.frame, size_m, grid_m, lambda: self.refinement)


def _triple(values: Floats) -> tuple[float, float, float]:
    return round(float(values[0]), 3), round(float(values[1]), 3), round(float(values[2]), 3)
