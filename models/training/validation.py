"""Validation of a retriever: its scores for queries with known answers, and what makes probabilities of them."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize
from scipy.special import logsumexp

from models.citymap.gallery import Gallery
from models.citymap.queries import Queries
from models.paper.instance_encoder import CellFeatures
from models.paper.level_table import encode_gallery
from models.paper.levels import Level
from models.paper.retriever import Retriever
from models.training.metrics import RETRIEVAL_KS, retrieval_recall


class Validation:
    """Queries with known answers against a gallery.

    Args:
        gallery: the cells.
        asked: the queries.
        retriever: that will be asked, with a point encoder that does not change.
    """

    def __init__(self, gallery: Gallery, asked: Queries, retriever: Retriever) -> None:
        self.features = retriever.with_point_features(CellFeatures.from_cells(gallery.cells, np.array(gallery.labels)))
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
        texts = self.retriever.encode_texts_padded(descriptions)
        whole = np.concatenate([text.global_vectors.numpy() for text in texts]) @ self.vectors.T
        return {**self.table.scores(texts, np.arange(len(self.vectors))), "global": whole}


def mean_recall(recalls: Sequence[dict[int, float]]) -> dict[int, float]:
    """The mean over sources, for each k."""
    return {k: float(np.mean([recall[k] for recall in recalls])) for k in RETRIEVAL_KS}


QUERIES = 500  # of each source
ScoredQueries = tuple[int, npt.NDArray[np.floating[Any]], npt.NDArray[np.intp]]


def calibrate(retriever: Retriever, validations: Sequence[Validation], rng: np.random.Generator) -> dict[str, Any]:
    """The fields of a retriever's configuration that make probabilities of its scores.

    Args:
        retriever: trained.
        validations: their queries are asked whole, and cut down to fewer hints drawn at random.
        rng: draws them.

    Returns:
        "temperature", "temperature_decay", and, if there is more than one level, "level_weights" and
        "global_temperature", "global_temperature_decay".
    """
    asked = [part for validation in validations for part in _ask(retriever, validation, rng)]
    weights, temperature, decay = most_likely(asked)
    found: dict[str, Any] = {"temperature": temperature, "temperature_decay": decay}
    if len(weights) == 1:
        return found
    _, temperature, decay = most_likely([(count, scores[:1], truth) for count, scores, truth in asked])
    return found | {"level_weights": weights, "global_temperature": temperature, "global_temperature_decay": decay}


def most_likely(asked: Sequence[ScoredQueries]) -> tuple[tuple[float, ...], float, float]:
    """(weights of the levels, temperature, decay) that give the true cells most likelihood.

    The probability of a cell is the softmax over the gallery of (sum over levels of w * similarity) / T, with
    T = temperature * number of hints ** -decay; the first level's weight is 1.

    Args:
        asked: a number of hints, similarities [L, Q, N] of queries with that many, and their true cells [Q].
    """
    levels = len(asked[0][1])

    def loss(parameters: npt.NDArray[np.float64]) -> float:
        weights, total = np.exp([0.0, *parameters[2:]]), 0.0
        for count, scores, truth in asked:
            temperature = np.exp(parameters[0]) * count ** -parameters[1]
            logits = np.tensordot(weights.astype(scores.dtype), scores, axes=1) / temperature
            total += float((logsumexp(logits, axis=1) - logits[np.arange(len(truth)), truth]).mean())
        return total

    found = minimize(loss, x0=[np.log(0.2), 1.0, *[0.0] * (levels - 1)], method="Nelder-Mead").x
    weights = tuple(float(weight) for weight in np.exp([0.0, *found[2:]]))
    return weights, float(np.exp(found[0])), float(found[1])


def _ask(retriever: Retriever, validation: Validation, rng: np.random.Generator) -> list[ScoredQueries]:
    gallery = Encoded(retriever, validation.features)
    longest = min(len(hints) for hints in validation.descriptions)
    rows = np.arange(0, len(validation.truth), max(1, len(validation.truth) // QUERIES))
    asked: list[ScoredQueries] = []
    for count in range(1, longest + 1):
        texts = [rng.permutation(list(validation.descriptions[int(row)]))[:count].tolist() for row in rows]
        by_level = gallery.level_scores(texts)
        asked.append((count, np.stack([by_level[level] for level in retriever.levels]), validation.truth[rows]))
    return asked
