"""Validation of a retriever, and calibration of its scores to probabilities."""

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
    """Validation queries of a gallery; a frozen point encoder must not change."""

    def __init__(self, gallery: Gallery, queries: Queries, retriever: Retriever) -> None:
        self.features = CellFeatures.from_cells(gallery.cells, np.array(gallery.labels))
        if retriever.config.points_frozen:
            self.features = retriever.with_point_features(self.features)
        self.descriptions, self.truth = queries.sentences, queries.truth

    def scores(self, retriever: Retriever) -> npt.NDArray[np.float32]:
        """Return the scores [Q, N] of all cells."""
        return retriever.combine(self.encode(retriever).level_scores(self.descriptions))

    def encode(self, retriever: Retriever) -> "EncodedGallery":
        """Return the vectors of the gallery."""
        return EncodedGallery(retriever, retriever.validation_features(self.features))

    def recall(self, retriever: Retriever) -> dict[int, float]:
        """Return the retrieval recall@k."""
        ranked = np.argsort(-self.scores(retriever), axis=1, kind="stable")[:, : max(RETRIEVAL_KS)]
        return retrieval_recall(ranked, self.truth)


class EncodedGallery:
    """The vectors of a gallery at all levels of a retriever."""

    def __init__(self, retriever: Retriever, features: CellFeatures) -> None:
        self.retriever = retriever
        self.vectors, self.table = encode_gallery(retriever, features)

    def level_scores(self, descriptions: Sequence[Sequence[str]]) -> dict[Level, npt.NDArray[np.float32]]:
        """Return the similarities [Q, N] of descriptions with all cells, by level."""
        texts = self.retriever.encode_texts_padded(descriptions)
        scores = np.concatenate([text.global_vectors.numpy() for text in texts]) @ self.vectors.T
        others = self.table.scores(texts, np.arange(len(self.vectors)), self.retriever.matching)
        return {**others, "global": scores}


def mean_recall(recalls: Sequence[dict[int, float]]) -> dict[int, float]:
    """Return the mean over sources, for each k."""
    return {k: float(np.mean([recall[k] for recall in recalls])) for k in RETRIEVAL_KS}


CALIBRATION_QUERIES_PER_SOURCE = 500
ScoredQueries = tuple[int, npt.NDArray[np.floating[Any]], npt.NDArray[np.intp]]


def calibrate(retriever: Retriever, validations: Sequence[Validation], rng: np.random.Generator) -> dict[str, Any]:
    """Fit the configuration fields that turn the scores of a retriever into probabilities.

    The validation queries are used with all hints, and with fewer hints drawn at random. The fields are "temperature",
    "temperature_decay" and, for more than one level, "level_weights", "global_temperature", "global_temperature_decay".
    """
    scored = [part for validation in validations for part in _score_queries(retriever, validation, rng)]
    weights, temperature, decay = fit_weights(scored)
    fields: dict[str, Any] = {"temperature": temperature, "temperature_decay": decay}
    if len(weights) == 1:
        return fields
    _, temperature, decay = fit_weights([(count, scores[:1], truth) for count, scores, truth in scored])
    return fields | {"level_weights": weights, "global_temperature": temperature, "global_temperature_decay": decay}


def fit_weights(scored: Sequence[ScoredQueries]) -> tuple[tuple[float, ...], float, float]:
    """Return (weights of the levels, temperature, decay) with the maximum likelihood of the true cells.

    The probability of a cell is the softmax over the gallery of (sum over levels of w * similarity) / T, with
    T = temperature * number of hints ** -decay; the weight of the first level is 1.

    Args:
        scored: for each number of hints, similarities [L, Q, N] of queries with that many, and their true cells [Q].
    """
    levels = len(scored[0][1])

    def loss(parameters: npt.NDArray[np.float64]) -> float:
        weights, total = np.exp([0.0, *parameters[2:]]), 0.0
        for count, scores, truth in scored:
            temperature = np.exp(parameters[0]) * count ** -parameters[1]
            logits = np.tensordot(weights.astype(scores.dtype), scores, axes=1) / temperature
            total += float((logsumexp(logits, axis=1) - logits[np.arange(len(truth)), truth]).mean())
        return total

    optimum = minimize(loss, x0=[np.log(0.2), 1.0, *[0.0] * (levels - 1)], method="Nelder-Mead").x
    weights = tuple(float(weight) for weight in np.exp([0.0, *optimum[2:]]))
    return weights, float(np.exp(optimum[0])), float(optimum[1])


def _score_queries(retriever: Retriever, validation: Validation, rng: np.random.Generator) -> list[ScoredQueries]:
    gallery = validation.encode(retriever)
    max_hints = min(len(hints) for hints in validation.descriptions)
    rows = np.arange(0, len(validation.truth), max(1, len(validation.truth) // CALIBRATION_QUERIES_PER_SOURCE))
    scored: list[ScoredQueries] = []
    for count in range(1, max_hints + 1):
        texts = [rng.permutation(list(validation.descriptions[int(row)]))[:count].tolist() for row in rows]
        by_level = gallery.level_scores(texts)
        scored.append((count, np.stack([by_level[level] for level in retriever.levels]), validation.truth[rows]))
    return scored
