"""Training the retriever on parts of maps and data sets, chosen on others."""

import copy
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
import torch
from pydantic import BaseModel, ConfigDict, Field
from scipy.optimize import minimize
from scipy.special import logsumexp
from torch import Tensor

from models.language.text_encoder import TextEncoder, load_text_encoder
from models.retrieval.checkpoint import save_retriever
from models.retrieval.mncl import Mncl, MnclConfig
from models.retrieval.retriever import Retriever
from models.training.data import Batch, HintVocabulary, TrainingSet
from models.training.metrics import RETRIEVAL_KS, retrieval_recall
from models.training.sources import Source, Validation

CALIBRATION_QUERIES = 500


class TrainingConfig(BaseModel):
    """How to train.

    Attributes:
        seed: of weights, positions, hints and order.
        steps: optimisation steps.
        batch_size: descriptions a step.
        cluster: of these, how many lie near each other (hard negatives).
        learning_rate: peak of the one-cycle schedule.
        spacing_m: one training position a square of this size.
        validate_every: steps between validations; the best by recall@5 is kept.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    seed: int = 0
    steps: int = Field(default=1500, ge=1)
    batch_size: int = Field(default=128, ge=2)
    cluster: int = Field(default=4, ge=1)
    learning_rate: float = 1e-3
    spacing_m: float = 4.0
    validate_every: int = 250


@dataclass(frozen=True, slots=True)
class Progress:
    """Where training stands, for a progress bar."""

    step: int
    steps: int
    loss: float
    recall: dict[int, float] | None


def train_retriever(
    load: Callable[[TextEncoder, np.random.Generator], Sequence[Source]],
    out: Path,
    model: MnclConfig,
    config: TrainingConfig,
    progress: Callable[[Progress], None] | None = None,
) -> dict[int, float]:
    """Train, keep what is best on validation queries, fit the temperature to them, save.

    Args:
        load: reads what to train on; drawn from in turn, by their numbers of positions.
        out: directory for model.safetensors and config.json.
        model: shape of the model.
        config: how to train.
        progress: called at every step.

    Returns:
        Retrieval recall@k on the validation queries, the mean over the sources.
    """
    rng = np.random.default_rng(config.seed)
    torch.manual_seed(config.seed)
    encoder = load_text_encoder(model.text_encoder)
    sources = load(encoder, rng)
    retriever: Retriever = Mncl(encoder, model)
    history = _optimise(retriever, sources, config, rng, progress)
    temperature, decay = fit_temperature(retriever, [source.validation for source in sources], rng)
    retriever.config = model.model_copy(update={"temperature": temperature, "temperature_decay": decay})
    recalls = [_validate(retriever, source.validation) for source in sources]
    training = {
        "config": config.model_dump(),
        "sources": [
            source.facts
            | {"positions": len(source.training)}
            | {"validation": {"cells": len(v.features), "queries": len(v.truth), "retrieval": recall}}
            for source, recall in zip(sources, recalls, strict=True)
            for v in [source.validation]
        ],
        "history": history,
    }
    save_retriever(retriever, out, json.loads(json.dumps(training)))
    return _mean(recalls)


def fit_temperature(
    retriever: Retriever, validations: Sequence[Validation], rng: np.random.Generator
) -> tuple[float, float]:
    """What `Retriever.temperature` needs, by maximum likelihood of the true cells of validation queries.

    Args:
        retriever: trained.
        validations: their queries are asked whole, and cut down to fewer hints drawn at random.
        rng: draws them.

    Returns:
        (temperature, temperature_decay).
    """
    asked = []
    for validation in validations:
        cells = retriever.encode_cells(validation.features)
        longest = min(len(hints) for hints in validation.descriptions)
        rows = np.arange(0, len(validation.truth), max(1, len(validation.truth) // CALIBRATION_QUERIES))
        for count in range(1, longest + 1):
            texts = [rng.permutation(list(validation.descriptions[int(row)]))[:count].tolist() for row in rows]
            scores = (retriever.encode_descriptions(texts) @ cells.T).astype(np.float64)
            asked.append((count, scores, validation.truth[rows]))
    return most_likely_temperature(asked)


def most_likely_temperature(
    asked: Sequence[tuple[int, npt.NDArray[np.float64], npt.NDArray[np.intp]]],
) -> tuple[float, float]:
    """(temperature, decay) that give the true cells most likelihood.

    Args:
        asked: a number of hints, similarities [Q, N] of queries with that many, and their true cells [Q].
    """

    def negative_log_likelihood(parameters: npt.NDArray[np.float64]) -> float:
        total = 0.0
        for count, scores, truth in asked:
            logits = scores / (np.exp(parameters[0]) * count ** -parameters[1])
            total += float((logsumexp(logits, axis=1) - logits[np.arange(len(truth)), truth]).mean())
        return total

    found = minimize(negative_log_likelihood, x0=[np.log(0.2), 1.0], method="Nelder-Mead")
    return float(np.exp(found.x[0])), float(found.x[1])


def _optimise(
    retriever: Retriever,
    sources: Sequence[Source],
    config: TrainingConfig,
    rng: np.random.Generator,
    progress: Callable[[Progress], None] | None,
) -> list[dict[str, float]]:
    """Train, and leave the retriever with the weights that were best on validation recall@5."""
    optimizer = torch.optim.AdamW(retriever.parameters(), config.learning_rate)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimizer, config.learning_rate, total_steps=config.steps, pct_start=0.1
    )
    history: list[dict[str, float]] = []
    best, best_recall = copy.deepcopy(retriever.state_dict()), -1.0
    losses: list[float] = []
    sizes = np.array([len(source.training) for source in sources])
    retriever.train()
    for step in range(1, config.steps + 1):
        turn = rng.choice(len(sources), p=sizes / sizes.sum()) if len(sources) > 1 else 0
        training = sources[turn].training
        batch = training.batch(training.draw(config.batch_size, config.cluster, rng), rng)
        loss = _loss(retriever, training, batch)
        optimizer.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(retriever.parameters(), 1.0)
        optimizer.step()
        schedule.step()
        losses.append(loss.item())
        recall = None
        if step % config.validate_every == 0 or step == config.steps:
            retriever.eval()
            recall = _mean([_validate(retriever, source.validation) for source in sources])
            retriever.train()
            history.append(
                {"step": step, "loss": float(np.mean(losses))} | {f"recall@{k}": v for k, v in recall.items()}
            )
            losses = []
            if recall[5] > best_recall:
                best, best_recall = copy.deepcopy(retriever.state_dict()), recall[5]
        if progress:
            progress(Progress(step, config.steps, loss.item(), recall))
    retriever.load_state_dict(best)
    retriever.eval()
    return history


def _loss(retriever: Retriever, training: TrainingSet, batch: Batch) -> Tensor:
    text = retriever.describe(_hint_features(retriever, training.vocabulary, batch), batch.hint_mask)
    return retriever.loss(text, retriever.look(batch.cells, training.label_embeddings), batch.same_cell)


def _hint_features(retriever: Retriever, vocabulary: HintVocabulary, batch: Batch) -> Tensor:
    """[B, H, D]; each different sentence of the batch is read once."""
    sentences, inverse = torch.unique(batch.sentences[batch.hint_mask], return_inverse=True)
    features = retriever.read(vocabulary.tokens(sentences))
    hints = features.new_zeros(*batch.sentences.shape, features.shape[-1])
    hints[batch.hint_mask] = features[inverse]
    return hints


def _validate(retriever: Retriever, validation: Validation) -> dict[int, float]:
    ranked = np.argsort(-validation.scores(retriever), axis=1, kind="stable")[:, : max(RETRIEVAL_KS)]
    return retrieval_recall(ranked, validation.truth)


def _mean(recalls: Sequence[dict[int, float]]) -> dict[int, float]:
    return {k: float(np.mean([recall[k] for recall in recalls])) for k in RETRIEVAL_KS}
