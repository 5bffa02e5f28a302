"""What turns similarities into probabilities, fitted to validation queries by maximum likelihood."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize
from scipy.special import logsumexp

from models.retrieval.retriever import Retriever
from models.training.validation import Encoded, Validation

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
