"""Validation of a retriever: its scores of a gallery for queries with known answers."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from models.city.gallery import Gallery
from models.city.queries import Queries
from models.retrieval.instance_encoder import CellFeatures
from models.retrieval.level_table import encode_gallery
from models.retrieval.levels import Level
from models.retrieval.retriever import Retriever
from models.training.metrics import RETRIEVAL_KS, retrieval_recall


class Validation:
    """Queries with known answers against a gallery.

    Args:
        gallery: the cells.
        asked: the queries.
        retriever: that will be asked, with a point encoder that does not change.
    """

    def __init__(self, gallery: Gallery, asked: Queries, retriever: Retriever) -> None:
        self.features = retriever.seen(CellFeatures.of(gallery.cells, np.array(gallery.labels)))
        self.descriptions, self.truth = asked.sentences, asked.truth

    def scores(self, retriever: Retriever) -> npt.NDArray[np.float32]:
        """[Q, N] scores by which cells are ranked."""
        return retriever.combine(Encoded(retriever, self.features).level_scores(self.descriptions))

    def recall(self, retriever: Retriever) -> dict[int, float]:
        """Retrieval recall@k."""
        ranked = np.argsort(-self.scores(retriever), axis=1, kind="stable")[:, : max(RETRIEVAL_KS)]
        return retrieval_recall(ranked, self.truth)


class Encoded:
    """A gallery at all levels of a retriever.

    Args:
        retriever: the model.
        features: the cells.
    """

    def __init__(self, retriever: Retriever, features: CellFeatures) -> None:
        self.retriever = retriever
        self.vectors, self.table = encode_gallery(retriever, features)

    def level_scores(self, descriptions: Sequence[Sequence[str]]) -> dict[Level, npt.NDArray[np.float32]]:
        """[Q, N] similarities of descriptions with all cells, by level."""
        texts = self.retriever.encode_texts(descriptions)
        whole = np.concatenate([text.whole.cpu().numpy() for text in texts]) @ self.vectors.T
        return {**self.table.scores(texts, np.arange(len(self.vectors))), "global": whole}


def mean_recall(recalls: Sequence[dict[int, float]]) -> dict[int, float]:
    """The mean over sources, for each k."""
    return {k: float(np.mean([recall[k] for recall in recalls])) for k in RETRIEVAL_KS}
