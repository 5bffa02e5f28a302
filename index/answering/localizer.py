"""An open index: it answers queries and lists its cells."""

from collections.abc import Callable, Sequence
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np

from index.answering.answers import (
    Answer,
    CellDetail,
    CellInstance,
    CellSummary,
    Described,
    IndexFacts,
    LatLon,
    ModelName,
)
from index.answering.describing import Describer
from index.answering.hint_features import load_hint_features
from index.answering.meanings import Meanings
from index.answering.place_text import closest_points_from
from index.answering.posterior_localizer import PosteriorLocalizer
from index.answering.query import Query, Refine
from index.answering.ranking import Ranker
from index.answering.result import pair, to_answer
from index.answering.vector_localizer import VectorLocalizer, raw_sentences
from index.build.artifact import find_version, open_version
from index.build.manifest import ADVICE, Manifest, check_model
from index.stores.faiss_store import FaissStore
from index.stores.opening import open_store
from models.citymap.cells import PartTable
from models.citymap.colours import PALETTES
from models.citymap.frame import Frame
from models.citymap.gallery import Gallery
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.points import Ints
from models.citymap.scenery.files import SceneryPart, file_name, is_scenery
from models.citymap.types import Floats
from models.errors import IndexBroken
from models.language.mentions.name_table import NameTable
from models.language.text_encoder import load_text_encoder
from models.paper.checkpoint import load_retriever
from models.paper.fine.checkpoint import load_refiner
from models.paper.fine.fine_model import FineMethod, FineModel
from models.paper.level_table import FILE as LEVELS_FILE
from models.paper.retriever import Retriever
from models.posterior.model import PosteriorModel, load_posterior
from models.posterior.neighbours.neighbour_index import NeighbourIndex, load_neighbour_index
from models.posterior.neighbours.piece_index import PieceNeighbourIndex
from models.posterior.places.landmarks import Landmarks
from models.posterior.statements import Statements


class Localizer:
    """Answers queries about one map. Only one thread may call `localize`; all else only reads.

    The posterior, the fine stage and the levels are loaded by the first query that needs them.
    """

    def __init__(
        self,
        directory: Path,
        manifest: Manifest,
        retriever: Retriever,
        load_refiner: Callable[[FineMethod], FineModel] = load_refiner,
        load_model: Callable[[], PosteriorModel] = load_posterior,
    ) -> None:
        self.manifest, self.retriever = manifest, retriever
        self._directory, self._load_refiner, self._load_model = directory, load_refiner, load_model
        self._refined: dict[str, VectorLocalizer] = {}
        self.gallery = Gallery.load(directory, self._cut_parts)
        store = open_store(directory, manifest, self.gallery.cells.center_m)
        self.ranker = Ranker.load(retriever.global_only(), directory, store)
        self.frame, self.palette = Frame(**manifest.frame.model_dump()), PALETTES[manifest.palette]
        expected = {"dim": manifest.dim, "cells": manifest.cells, "instances": manifest.instances}
        actual = {"dim": self.ranker.store.dim, "cells": len(self.ranker.store), "instances": len(self.gallery.labels)}
        if expected != actual or len(self.gallery.cells) != manifest.cells:
            raise IndexBroken(f"{directory}: the manifest says {expected}, the files contain {actual}; {ADVICE}")
        self._known_hints = load_hint_features(directory, retriever)

    @classmethod
    def open(
        cls,
        index_dir: Path,
        weights_dir: Path | None = None,
        fine_weights_dir: Path | None = None,
        posterior_weights_dir: Path | None = None,
        with_sums: bool = True,
    ) -> "Localizer":
        """Open an index directory (the version of its alias "default") or one of its versions.

        None stands for the weights in the package. With `with_sums` the sums of all files are checked first; the
        service does so in the background. Raise IndexBroken, IndexMismatch if another model built it, WeightsError, or
        StoreUnavailable.
        """
        directory, manifest = (open_version if with_sums else find_version)(index_dir)
        retriever = load_retriever(weights_dir)
        check_model(manifest, retriever.fingerprint)
        load_fine = partial(load_refiner, directory=fine_weights_dir)
        return cls(directory, manifest, retriever, load_fine, partial(load_posterior, posterior_weights_dir))

    @property
    def facts(self) -> IndexFacts:
        """Return facts about the index."""
        manifest, cells = self.manifest, self.gallery.cells
        centers_m, half_m = cells.center_m[:, :2].astype(np.float64), cells.size_m / 2
        return IndexFacts(
            version=manifest.version,
            created=manifest.created,
            map_name=manifest.map_name,
            attribution=manifest.attribution,
            model=ModelName(self.retriever.name, manifest.model_fingerprint),
            num_cells=manifest.cells,
            num_instances=manifest.instances,
            dim=manifest.dim,
            scenery_parts=sum(is_scenery(name) for name in manifest.files),
            box_m=(*(centers_m.min(axis=0) - half_m).tolist(), *(centers_m.max(axis=0) + half_m).tolist()),
            summary=manifest.summary,
        )

    def localize(self, queries: Sequence[Query]) -> list[Answer]:
        """Answer queries, in order; queries with the same `refine` form a batch."""
        answers: dict[int, Answer] = {}
        for refine in {query.refine for query in queries}:
            localizer = self.posterior if refine == "posterior" else self.vector_localizer(refine)
            rows = [n for n, query in enumerate(queries) if query.refine == refine]
            results = localizer.find([queries[n] for n in rows])
            for n, result in zip(rows, results, strict=True):
                answers[n] = to_answer(queries[n], result, localizer, self.gallery.cells, self.frame)
        return [answers[n] for n in range(len(queries))]

    def warm(self) -> None:
        """Load the data of usual queries, so that the first is fast and forked workers share the memory.

        A single vector replaces the store meanwhile, because a store must not connect to a server before the fork.
        """
        store = self.ranker.store
        self.ranker.store = FaissStore.from_vectors(np.zeros((1, self.manifest.dim), np.float32))
        try:
            words = self._gazetteer.objects
            streets = np.flatnonzero(words.is_street & words.has_name)
            street = words[int(streets[0])].names[0] if len(streets) else "Main Street"
            self.localize([Query("I am north of a building."), Query(f"I am on {street}, near a pharmacy.")])
        finally:
            self.ranker.store = store
        load_text_encoder()(["a"])  # quantize all layers before workers are forked

    def vector_localizer(self, refine: Refine) -> VectorLocalizer:
        """Return vector search, with the fine stage that `refine` names."""
        if refine == "none" or refine == "posterior":  # noqa: PLR1714, which mypy does not see through
            return self._vectors
        if refine not in self._refined:
            common = self._vectors.ranker, self.gallery, self.frame, self.manifest.grid_m
            self._refined[refine] = VectorLocalizer(*common, self._load_refiner(refine), self.sentences)
        return self._refined[refine]

    @cached_property
    def posterior(self) -> PosteriorLocalizer:
        """Load the hint posterior for this gallery."""
        model = self._load_model()
        meanings = Meanings.load(self._directory, load_text_encoder().embed)
        return PosteriorLocalizer(
            model,
            self.gallery,
            self.palette,
            self.frame,
            self._surroundings,
            self.ranker,
            self._gazetteer,
            self.manifest.grid_m,
            meanings,
            Statements.load(self._directory, model.fingerprint),
            NameTable.load(self._directory),
            Landmarks.load(self._directory),
        )

    def _cut_parts(self, cells: Ints) -> PartTable:
        surroundings = self._surroundings
        assert isinstance(surroundings, PieceNeighbourIndex)
        return surroundings.cut(self.gallery.cells.center_m[cells])

    # `describe` also loads the next three, on any thread; if two threads load one at once, the results are equal.
    @cached_property
    def _surroundings(self) -> NeighbourIndex:
        return load_neighbour_index(self._directory, self.gallery.cells)

    @cached_property
    def _gazetteer(self) -> Gazetteer:
        return Gazetteer.load(self._directory)

    @cached_property
    def _describer(self) -> Describer:
        return Describer(self.gallery, self.palette, self.frame, self._surroundings, self._gazetteer)

    @cached_property
    def _vectors(self) -> VectorLocalizer:
        has_levels = LEVELS_FILE in self.manifest.files
        ranker = Ranker.load(self.retriever, self._directory, self.ranker.store) if has_levels else self.ranker
        return VectorLocalizer(ranker, self.gallery, self.frame, self.manifest.grid_m, sentences=self.sentences)

    def sentences(self, descriptions: Sequence[str]) -> list[tuple[str, ...]]:
        """Split descriptions into sentences for the retriever.

        Template hints about this map stay as they are. Other descriptions are parsed and rendered as template hints, or
        stay as they are if no hint is found.
        """
        raw = raw_sentences(descriptions)
        free = [n for n, sentences in enumerate(raw) if not self._known_hints.issuperset(sentences)]
        read = dict(zip(free, self.posterior.sentences([descriptions[n] for n in free]), strict=True))
        return [read.get(n) or sentences for n, sentences in enumerate(raw)]

    def scenery(self, number: int) -> SceneryPart | None:
        """Return a file of the drawing of the map; None if there is no such file."""
        name = file_name(number)
        record = self.manifest.files.get(name)
        return SceneryPart(self._directory / name, record.sha256) if record else None

    def describe(self, position_m: tuple[float, float], language: str | None = None) -> Described | None:
        """Describe a position (x, y), metres, map frame; None off the map, and where nothing is near.

        `place` is in the given language, everything else in English.
        """
        return self._describer.describe(np.array(position_m, dtype=np.float64), language)

    def position_of(self, source_id: str) -> tuple[float, float] | None:
        """Return the point of an object that is closest to its middle; None if no such object can be named."""
        gazetteer = self._gazetteer
        row = gazetteer.objects.find_source(source_id)
        if row is None:
            return None
        middle = gazetteer.middles_m[row]
        way = closest_points_from(gazetteer, np.array([row]), middle, float(gazetteer.reach_m[row]) + 1.0)
        return pair(middle + way.offset_m[0])

    def close(self) -> None:
        """Do nothing; the memory is freed with the process."""

    def cells(self, first: int, count: int) -> list[CellSummary]:
        """Return at most `count` cells from row `first`, counted from 0."""
        rows = range(first, min(first + count, len(self.gallery.cells.ids)))
        counts = np.diff(self.gallery.cells.take(np.array(rows, np.int64)).parts.starts).tolist()
        return [CellSummary(**self._cell_fields(row), instances=n) for row, n in zip(rows, counts, strict=True)]

    def cell(self, cell_id: str) -> CellDetail | None:
        """Return a cell with its instances; None if there is no such cell."""
        gallery = self.gallery
        try:
            row = gallery.cells.ids.index(cell_id)
        except ValueError:
            return None
        parts = gallery.cells.take(np.array([row])).parts
        return CellDetail(
            **self._cell_fields(row),
            instances=tuple(
                CellInstance(
                    label=gallery.labels[parts.instance[r]],
                    name=gallery.names[parts.instance[r]],
                    source_id=gallery.sources[parts.instance[r]],
                    colour=self.palette.word(parts.rgb[r]),
                    points=int(parts.count[r]),
                    center=_triple((parts.low_m[r] + parts.high_m[r]) / 2),
                    size=_triple(parts.high_m[r] - parts.low_m[r]),
                    closest=_triple(parts.closest_m[r]),
                )
                for r in range(len(parts.instance))
            ),
        )

    def _cell_fields(self, row: int) -> dict[str, Any]:
        cells, half_m = self.gallery.cells, self.gallery.cells.size_m / 2
        x, y = (float(v) for v in cells.center_m[row, :2])
        return {
            "cell_id": cells.ids[row],
            "scene": cells.scenes[row],
            "center": _triple(cells.center_m[row]),
            "bbox": (x - half_m, y - half_m, x + half_m, y + half_m),
            "wgs84": LatLon.from_position(cells.center_m[row], self.frame),
        }


def _triple(values: Floats) -> tuple[float, float, float]:
    return round(float(values[0]), 3), round(float(values[1]), 3), round(float(values[2]), 3)
