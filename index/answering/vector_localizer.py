"""Vector search in one gallery, with or without a fine stage."""

import time
from collections.abc import Callable, Sequence

import numpy as np
from scipy.special import logsumexp

from index.answering.answers import Method, ModelName
from index.answering.filters import is_inside, log_prior
from index.answering.partial_transport import TransportReranker
from index.answering.query import Query
from index.answering.ranking import Ranker
from index.answering.result import LocalizerResult, elapsed_ms
from models.citymap.cells import PartTable
from models.citymap.frame import Frame
from models.citymap.gallery import Gallery
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.sentences import split_hints
from models.paper.fine.fine_model import FineModel
from models.paper.instance_encoder import CellFeatures, UncutCells
from models.paper.levels import Levels
from models.posterior.distribution import PositionDistribution

RANKED_CELLS = 2000  # cells in the softmax; `_probability` bounds the rest
NO_CELL_WITHIN = "'within' contains no cell centre; widen it, move it onto the map or leave it out"
SplitTexts = Callable[[Sequence[str]], Sequence[tuple[str, ...]]]


def raw_sentences(descriptions: Sequence[str]) -> list[tuple[str, ...]]:
    """Split each description into sentences, as the paper's retrievers encode them."""
    return [split_hints(description) for description in descriptions]


class VectorLocalizer:
    """Localizes descriptions by the vectors of the cells."""

    def __init__(
        self,
        ranker: Ranker,
        gallery: Gallery,
        frame: Frame,
        grid_m: float,
        refiner: FineModel | None = None,  # finds positions inside the listed cells; None keeps the centres
        sentences: SplitTexts = raw_sentences,  # turns descriptions into the sentences that the models encode
        depth: int = RANKED_CELLS,  # number of cells in the softmax
        reranker: TransportReranker | None = None,  # changes the order of the first cells; None keeps the ranker's
    ) -> None:
        self.ranker, self.gallery, self.frame, self.refiner = ranker, gallery, frame, refiner
        self.grid_m, self.sentences, self.depth, self.reranker = grid_m, sentences, depth, reranker
        model = refiner or ranker.retriever
        name = f"{model.name}, re-ranked by partial transport" if reranker else model.name
        self.model = ModelName(name, model.fingerprint)  # computed once, because it reads all weights
        self._centers, self._extent_m = gallery.cells.center_m[:, :2].astype(np.float64), gallery.cells.extent_m
        self._features: CellFeatures | UncutCells | None = None
        if refiner:
            labels = np.array(gallery.labels)
            if isinstance(gallery.cells.content, PartTable):
                self._features = refiner.with_point_features(CellFeatures.from_cells(gallery.cells, labels))
            else:
                self._features = refiner.with_point_features(UncutCells.from_cells(gallery.cells, labels))

    @property
    def method(self) -> Method:
        """Implement CellLocalizer."""
        return self.refiner.method if self.refiner else "cell_center"

    def find(self, queries: Sequence[Query]) -> list[LocalizerResult]:
        """Implement CellLocalizer."""
        start = time.perf_counter()
        sentences = self.sentences([query.description for query in queries])
        texts = self.ranker.retriever.encode_texts(sentences)
        encode_ms = elapsed_ms(start)
        start = time.perf_counter()
        ranked = self._rank(queries, texts)
        search_ms = elapsed_ms(start)
        start = time.perf_counter()
        ordered = [self._order(*each) for each in zip(queries, texts, ranked, strict=True)]
        if reranker := self.reranker:
            ordered = [reranker.rerank(*each) for each in zip(sentences, ordered, strict=True)]
        positions = self._positions(queries, sentences, [rows for rows, *_ in ordered])
        distributions = [self._distribution(*each) for each in zip(ordered, positions, strict=True)]
        timings = {"encode": encode_ms, "search": search_ms, "estimate": elapsed_ms(start)}
        return [
            LocalizerResult(located, None if located else NO_CELL_WITHIN, timings_ms=timings)
            for located in distributions
        ]

    def _rank(self, queries: Sequence[Query], texts: Sequence[Levels]) -> list[tuple[Ints, Floats]]:
        plain = [n for n, query in enumerate(queries) if query.within is None and query.prior is None]
        ranked: dict[int, tuple[Ints, Floats]] = {}
        if plain:
            scores, rows = self.ranker.rank([texts[n] for n in plain], self.depth)
            ranked = {n: (rows[k], scores[k]) for k, n in enumerate(plain)}
        for n, (query, text) in enumerate(zip(queries, texts, strict=True)):
            if n not in ranked:
                # A filter or a prior changes the order of the cells, so score all cells inside.
                cell_rows = np.flatnonzero(is_inside(query, self._centers, self.frame))
                ranked[n] = cell_rows, self.ranker.score(text, cell_rows)
        return [ranked[n] for n in range(len(queries))]

    def _order(self, query: Query, text: Levels, ranked: tuple[Ints, Floats]) -> tuple[Ints, Floats, Floats]:
        rows, scores = ranked
        probability = self._probability(query, int(text.mask.sum()), rows, scores)
        order = np.lexsort((rows, -probability))
        return rows[order], scores[order], probability[order]

    def _probability(self, query: Query, hints: int, rows: Ints, scores: Floats) -> Floats:
        """Return the probability [R] that each cell is the right one.

        softmax(score / T) over the gallery, with T fitted on validation queries (`Retriever.temperature`). Cells beyond
        the depth count as if they scored like the last one, so the uncertainty is never understated.
        """
        if not len(rows):
            return np.zeros(0)
        logits = scores.astype(np.float64) / self.ranker.temperature(hints)
        logits = logits + log_prior(query, self._centers[rows], self.frame)
        is_complete = query.within is not None or query.prior is not None
        unseen = 0 if is_complete else len(self._centers) - len(rows)
        rest = np.log(unseen) + logits.min() if unseen else -np.inf
        return np.exp(logits - np.logaddexp(logsumexp(logits), rest))

    def _positions(
        self, queries: Sequence[Query], sentences: Sequence[tuple[str, ...]], rows: Sequence[Ints]
    ) -> list[Floats]:
        """Return the position [C, 2] in each cell, for each query; only listed cells are refined."""
        positions: list[Floats] = [self._centers[cell_rows] for cell_rows in rows]
        if self.refiner is not None and self._features is not None:
            listed = np.full((len(queries), max(query.top_k for query in queries)), -1)
            for n, (query, cell_rows) in enumerate(zip(queries, rows, strict=True)):
                listed[n, : len(cell_rows[: query.top_k])] = cell_rows[: query.top_k]
            offset = self.refiner.predict(sentences, self._features, listed)
            cells = self.gallery.cells
            for n, cell_rows in enumerate(rows):
                count = int((listed[n] >= 0).sum())
                positions[n][:count] = cells.center_m[cell_rows[:count], :2] + (offset[n, :count] - 0.5) * cells.size_m
        return positions

    def _distribution(self, ordered: tuple[Ints, Floats, Floats], positions: Floats) -> PositionDistribution | None:
        rows, scores, probability = ordered
        if not len(rows):
            return None
        # The position lies in the grid square around the centre, or in one as wide as the error of the fine stage.
        error_m = self.refiner.error_m if self.refiner else None
        return PositionDistribution(
            rows=rows,
            score=scores,
            probability=probability,
            other=max(0.0, 1.0 - float(probability.sum())),
            positions=positions,
            points_m=positions,
            points=rows,
            weight=probability,
            spacing_m=self.grid_m if error_m is None else error_m * 12**0.5,
            extent_m=self._extent_m,
        )
