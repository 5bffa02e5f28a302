"""An index, opened: from descriptions to answers, and what is in its cells."""

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
from index.answering.posterior_localizer import PosteriorLocalizer
from index.answering.query import Query, Refine
from index.answering.ranking import Ranker
from index.answering.result import CellLocalizer, to_answer
from index.answering.vector_localizer import VectorLocalizer, raw_sentences
from index.build.artifact import find_version, open_version
from index.build.manifest import ADVICE, Manifest, check_model
from index.stores.faiss_store import FaissStore
from index.stores.opening import open_store
from models.citymap.cells import PartTable
from models.citymap.colours import PALETTES
from models.citymap.frame import Frame
from models.citymap.gallery import Gallery, MapData
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
from models.paper.level_table import STARTS_FILE
from models.paper.retriever import Retriever
from models.posterior.model import PosteriorModel, load_posterior
from models.posterior.neighbours.neighbour_index import NeighbourIndex, load_neighbour_index
from models.posterior.neighbours.piece_index import PieceNeighbourIndex
from models.posterior.places.landmarks import Landmarks
from models.posterior.statements import Statements


class Localizer:
    """Answers queries about one map. `localize` is not thread-safe: one thread owns it. The rest only reads.

    What only some queries need (posterior, fine stage, levels) is read when the first of them comes.

    Args:
        directory: a version of an index, checked.
        manifest: what it says of itself.
        retriever: the model that made its vectors.
        load_refiner: reads the fine stage of a method.
        load_model: reads the hint posterior.
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
        self.gallery = Gallery.load(directory, self._cut)
        store = open_store(directory, manifest, self.gallery.cells.center_m)
        self.ranker = Ranker.load(retriever.global_only(), directory, store)
        self.frame, self.palette = Frame(**manifest.frame.model_dump()), PALETTES[manifest.palette]
        said = {"dim": manifest.dim, "cells": manifest.cells, "instances": manifest.instances}
        held = {
            "dim": self.ranker.store.dim,
            "cells": len(self.ranker.store),
            "instances": len(self.gallery.labels),
        }
        if said != held or len(self.gallery.cells) != manifest.cells:
            raise IndexBroken(f"{directory}: the manifest says {said}, its files hold {held}; {ADVICE}")
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
        """Open an index directory (what its alias "default" names) or one version of it.

        Args:
            index_dir: as it says.
            weights_dir: the retriever's; None for those that ship with the package.
            fine_weights_dir: the same of a fine stage, see `load_refiner`; read when the first query asks for it.
            posterior_weights_dir: the same of the hint posterior.
            with_sums: read all files first and compare their sums; the service does so later, beside queries.

        Raises:
            IndexBroken: the index is missing, incomplete or changed.
            IndexMismatch: another model built it.
            WeightsError: the model cannot be loaded.
            StoreUnavailable: its vectors are in Milvus, and nothing says where that is.
        """
        directory, manifest = (open_version if with_sums else find_version)(index_dir)
        retriever = load_retriever(weights_dir)
        check_model(manifest, retriever.fingerprint)
        load_fine = partial(load_refiner, directory=fine_weights_dir)
        return cls(directory, manifest, retriever, load_fine, partial(load_posterior, posterior_weights_dir))

    @property
    def facts(self) -> IndexFacts:
        """What the index says of itself."""
        said = self.manifest
        return IndexFacts(
            version=said.version,
            created=said.created,
            map_name=said.map_name,
            attribution=said.attribution,
            model=ModelName(self.retriever.name, said.model_fingerprint),
            num_cells=said.cells,
            num_instances=said.instances,
            dim=said.dim,
            scenery_parts=sum(is_scenery(name) for name in said.files),
        )

    def localize(self, queries: Sequence[Query]) -> list[Answer]:
        """Answer queries, in order; those of one kind go through their model together.

        Raises:
            WeightsError: a query asks for a model that cannot be loaded.
            IndexBroken: what it needs of the index cannot be read.
            StoreUnavailable: the index's vectors are in Milvus, which does not answer.
        """
        answers: dict[int, Answer] = {}
        for refine in {query.refine for query in queries}:
            localizer = self.of(refine)
            rows = [n for n, query in enumerate(queries) if query.refine == refine]
            found = localizer.find([queries[n] for n in rows])
            for n, finding in zip(rows, found, strict=True):
                answers[n] = to_answer(queries[n], finding, localizer, self.gallery.cells, self.frame)
        return [answers[n] for n in range(len(queries))]

    def warm(self) -> None:
        """Read what usual queries need, so that the first does not wait and workers that are forked share it.

        A vector stands in for the store: what connects to a server must not do so before the fork.
        """
        store, self.ranker.store = self.ranker.store, FaissStore.of(np.zeros((1, self.manifest.dim), np.float32))
        try:
            words = self._gazetteer.objects
            streets = np.flatnonzero(words.is_street & words.has_name)
            street = words[int(streets[0])].names[0] if len(streets) else "Main Street"
            self.localize([Query("I am north of a building."), Query(f"I am on {street}, near a pharmacy.")])
        finally:
            self.ranker.store = store
        load_text_encoder().quantize_now()

    def of(self, refine: Refine) -> CellLocalizer:
        """What answers queries of one kind."""
        return self.posterior if refine == "posterior" else self.by_vectors(refine)

    def by_vectors(self, refine: Refine) -> VectorLocalizer:
        """Vector search, with the fine stage if it is asked for."""
        if refine == "none" or refine == "posterior":  # noqa: PLR1714, which mypy does not see through
            return self._vectors
        if refine not in self._refined:
            given = self._vectors.ranker, self.gallery, self.frame, self.manifest.grid_m
            self._refined[refine] = VectorLocalizer(*given, self._load_refiner(refine), self.sentences)
        return self._refined[refine]

    @cached_property
    def posterior(self) -> PosteriorLocalizer:
        """The hint posterior on this gallery."""
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

    def _cut(self, cells: Ints) -> PartTable:
        """The parts of some cells, of a map of pieces."""
        surroundings = self._surroundings
        assert isinstance(surroundings, PieceNeighbourIndex)
        return surroundings.cut(self.gallery.cells.center_m[cells])

    # The next three are read by `describe` too, on any thread: what two threads read at once is the same.
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
        """Vector search on this gallery, by all levels that the index has."""
        has_levels = STARTS_FILE in self.manifest.files
        ranker = Ranker.load(self.retriever, self._directory, self.ranker.store) if has_levels else self.ranker
        return VectorLocalizer(ranker, self.gallery, self.frame, self.manifest.grid_m, sentences=self.sentences)

    def sentences(self, descriptions: Sequence[str]) -> list[tuple[str, ...]]:
        """Descriptions as the retriever knows them.

        Template hints about this map stay as they are; of other descriptions, what was read of them is put in template
        hints; of what cannot be read, the sentences.
        """
        raw = raw_sentences(descriptions)
        free = [n for n, sentences in enumerate(raw) if not self._known_hints.issuperset(sentences)]
        read = dict(zip(free, self.posterior.sentences([descriptions[n] for n in free]), strict=True))
        return [read.get(n) or sentences for n, sentences in enumerate(raw)]

    def map_data(self) -> MapData:
        """The map of the index, as the evaluation takes it."""
        return MapData(
            name=self.manifest.map_name,
            split="index",
            gallery=self.gallery,
            palette=self.palette,
            frame=self.frame,
            grid_m=self.manifest.grid_m,
            attribution=self.manifest.attribution,
        )

    def scenery(self, number: int) -> SceneryPart | None:
        """A part of what the map looks like; None if there is no such part."""
        name = file_name(number)
        record = self.manifest.files.get(name)
        return SceneryPart(self._directory / name, record.sha256) if record else None

    def describe(self, position_m: tuple[float, float]) -> Described | None:
        """What the map says at a position (x, y), metres, map frame; None off the map, and where nothing is near."""
        return self._describer.describe(np.array(position_m, dtype=np.float64))

    def close(self) -> None:
        """Let go of it; what it holds goes with its process."""

    def cells(self, first: int, count: int) -> list[CellSummary]:
        """Cells of the map in their order, from row `first` (0 is the first), at most `count`."""
        rows = range(first, min(first + count, len(self.gallery.cells.ids)))
        count_of = np.diff(self.gallery.cells.take(np.array(rows, np.int64)).parts.starts).tolist()
        return [CellSummary(**self._place(row), instances=n) for row, n in zip(rows, count_of, strict=True)]

    def cell(self, cell_id: str) -> CellDetail | None:
        """A cell and what is in it; None if there is no such cell."""
        gallery = self.gallery
        try:
            row = gallery.cells.ids.index(cell_id)
        except ValueError:
            return None
        parts = gallery.cells.take(np.array([row])).parts
        return CellDetail(
            **self._place(row),
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

    def _place(self, row: int) -> dict[str, Any]:
        """Where a cell is, as answers say it."""
        cells, half_m = self.gallery.cells, self.gallery.cells.size_m / 2
        x, y = (float(v) for v in cells.center_m[row, :2])
        return {
            "cell_id": cells.ids[row],
            "scene": cells.scenes[row],
            "center": _triple(cells.center_m[row]),
            "bbox": (x - half_m, y - half_m, x + half_m, y + half_m),
            "wgs84": LatLon.of(cells.center_m[row], self.frame),
        }


def _triple(values: Floats) -> tuple[float, float, float]:
    return round(float(values[0]), 3), round(float(values[1]), 3), round(float(values[2]), 3)
