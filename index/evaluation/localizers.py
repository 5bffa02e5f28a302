"""The localizers that are measured: of a map that is no index, and of some of the cells of a gallery."""

import numpy as np

from index.answering.localizer import Localizer
from index.answering.partial_transport import TransportReranker
from index.answering.posterior_localizer import PosteriorLocalizer
from index.answering.query import Rerank
from index.answering.ranking import Ranker
from index.answering.result import CellLocalizer
from index.answering.vector_localizer import VectorLocalizer
from index.stores.faiss_store import FaissStore
from models.citymap.cells import CellTable
from models.citymap.gallery import MapData
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, Gazetteer
from models.citymap.points import Ints, ranges
from models.paper.fine.fine_model import FineModel
from models.posterior.model import PosteriorModel
from models.posterior.neighbours.map_objects import MapObjects
from models.posterior.neighbours.neighbour_index import NeighbourIndex


def map_of_index(localizer: Localizer) -> MapData:
    """Return the map of an index."""
    manifest = localizer.manifest
    return MapData(
        name=manifest.map_name,
        split="index",
        gallery=localizer.gallery,
        palette=localizer.palette,
        frame=localizer.frame,
        grid_m=manifest.grid_m,
        attribution=manifest.attribution,
    )


def vectors_of_map(
    data: MapData, ranker: Ranker, refiner: FineModel | None = None, rerank: Rerank | None = None
) -> VectorLocalizer:
    """Return the vector search of a map, which encodes texts as they are and gives every cell a probability."""
    arguments = ranker, data.gallery, data.frame, data.grid_m, refiner
    return VectorLocalizer(*arguments, depth=len(data.cells), reranker=_reranker(data, rerank))


def with_raw_texts(served: VectorLocalizer, data: MapData, rerank: Rerank | None = None) -> VectorLocalizer:
    """Return the vector search of an index with the map `data`, which encodes texts as they are, as the paper does."""
    arguments = served.ranker, served.gallery, served.frame, served.grid_m, served.refiner
    return VectorLocalizer(*arguments, depth=served.depth, reranker=_reranker(data, rerank))


def _reranker(data: MapData, rerank: Rerank | None) -> TransportReranker | None:
    return TransportReranker(data.gallery, data.palette) if rerank == "parc" else None


def posterior_of_map(
    model: PosteriorModel,
    data: MapData,
    ranker: Ranker,
    surroundings: NeighbourIndex,
    gazetteer: Gazetteer = EMPTY_GAZETTEER,
) -> PosteriorLocalizer:
    """Return the hint posterior of a map."""
    arguments = model, data.gallery, data.palette, data.frame, surroundings, ranker
    return PosteriorLocalizer(*arguments, gazetteer, data.grid_m)


def restrict_localizer(localizer: CellLocalizer, data: MapData, rows: Ints) -> CellLocalizer:
    """Return a localizer that knows only the cells `rows` of its gallery; `data` has these cells alone."""
    assert isinstance(localizer, VectorLocalizer | PosteriorLocalizer)
    ranker = restrict_ranker(localizer.ranker, rows)
    if isinstance(localizer, VectorLocalizer):
        reranker = localizer.reranker and TransportReranker(data.gallery, data.palette)
        how = localizer.refiner, localizer.sentences, localizer.depth, reranker
        return VectorLocalizer(ranker, data.gallery, data.frame, data.grid_m, *how)
    around, places = localizer.surroundings, localizer.places
    around = around.take(rows, count_parts(around.objects, localizer.gallery.cells, rows))
    arguments = localizer.weights, data.gallery, data.palette, data.frame, around, ranker
    if places is None:
        return PosteriorLocalizer(*arguments, grid_m=data.grid_m)
    return PosteriorLocalizer(*arguments, places.gazetteer, data.grid_m, places.meanings)


def count_parts(objects: MapObjects, cells: CellTable, rows: Ints) -> Ints:
    """Return the number [P] of parts of each object in some of the cells of a map."""
    if objects.are_parts:
        number = ranges(cells.parts.starts[rows], cells.parts.starts[rows + 1])
    else:
        number = cells.take(rows).parts.instance
    return np.bincount(number, minlength=len(objects.instance)).astype(np.int32)


def restrict_ranker(ranker: Ranker, rows: Ints) -> Ranker:
    """Return a ranker of some of the cells of a gallery."""
    vectors = FaissStore.from_vectors(ranker.store.vectors(rows))
    return Ranker(ranker.retriever, vectors, ranker.table.take(rows), ranker.depth)
