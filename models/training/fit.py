"""Training the retriever on one region of a map, chosen on another."""

import copy
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from pydantic import BaseModel, ConfigDict, Field
from scipy.optimize import minimize
from scipy.special import logsumexp
from torch import Tensor

from models.city.cells import CellTable, cut_cells
from models.city.hints import describe_poses, sample_positions
from models.city.points import PointTable
from models.city.regions import Region, split_regions
from models.city.types import CityMap, Pose
from models.language.hints_text import render_hint
from models.language.text_encoder import TextEncoder, load_text_encoder
from models.retrieval.checkpoint import save_retriever
from models.retrieval.instance_encoder import CellFeatures
from models.retrieval.losses import contrastive_loss
from models.retrieval.retriever import Retriever, RetrieverConfig
from models.training.data import Batch, HintVocabulary, TrainingRegion
from models.training.metrics import retrieval_recall

CALIBRATION_QUERIES = 500


class TrainingConfig(BaseModel):
    """How to train.

    Attributes:
        seed: of weights, positions, hints and order.
        steps: optimisation steps.
        batch_size: descriptions a step.
        cluster: of these, how many lie near each other (hard negatives).
        learning_rate: peak of the one-cycle schedule.
        temperature: tau of the contrastive loss.
        spacing_m: one training position a square of this size.
        validate_every: steps between validations; the best by recall@5 is kept.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    seed: int = 0
    steps: int = Field(default=1500, ge=1)
    batch_size: int = Field(default=128, ge=2)
    cluster: int = Field(default=4, ge=1)
    learning_rate: float = 1e-3
    temperature: float = 0.05
    spacing_m: float = 4.0
    validate_every: int = 250


@dataclass(frozen=True, slots=True)
class Progress:
    """Where training stands, for a progress bar."""

    step: int
    steps: int
    loss: float
    recall: dict[int, float] | None


@dataclass(frozen=True, slots=True, eq=False)
class Validation:
    """Queries with known answers, in the benchmark's wording.

    Attributes:
        features: the gallery.
        descriptions: Q lists of sentences.
        truth: [Q] the best cell of each.
    """

    features: CellFeatures
    descriptions: Sequence[Sequence[str]]
    truth: npt.NDArray[np.intp]

    @classmethod
    def of(cls, city_map: CityMap, cells: CellTable, poses: Sequence[Pose]) -> "Validation":
        """Poses of a map as queries against some of its cells."""
        row = {cell_id: n for n, cell_id in enumerate(cells.ids)}
        return cls(
            CellFeatures.of(cells, np.array([i.label for i in city_map.instances])),
            [[render_hint(hint) for hint in pose.description.hints] for pose in poses],
            np.array([row[pose.cell_id] for pose in poses]),
        )

    def scores(self, retriever: Retriever) -> npt.NDArray[np.float32]:
        """[Q, N] similarities."""
        return retriever.encode_descriptions(self.descriptions) @ retriever.encode_cells(self.features).T


def train_retriever(
    city_map: CityMap,
    out: Path,
    model: RetrieverConfig,
    config: TrainingConfig,
    progress: Callable[[Progress], None] | None = None,
) -> dict[int, float]:
    """Train on the west of a map, keep what is best on the strip beside it, fit the temperature there, save.

    Args:
        city_map: the map.
        out: directory for model.safetensors and config.json.
        model: shape of the model.
        config: how to train.
        progress: called at every step.

    Returns:
        Retrieval recall@k on the validation strip.
    """
    rng = np.random.default_rng(config.seed)
    torch.manual_seed(config.seed)
    encoder = load_text_encoder(model.text_encoder)
    points = PointTable.of(city_map, city_map.rules.eps_m)
    cells = cut_cells(city_map, points)
    regions = split_regions(cells)
    region = _training_region(city_map, points, cells, regions["train"], config, rng, encoder)
    validation = _validation(city_map, points, cells, regions["val"])
    retriever = Retriever(encoder, model)
    history = _optimise(retriever, region, validation, config, rng, progress)
    temperature, decay = fit_temperature(retriever, validation, rng)
    retriever.config = model.model_copy(update={"temperature": temperature, "temperature_decay": decay})
    recall = retrieval_recall(_rank(validation.scores(retriever)), validation.truth)
    training = {
        "map": city_map.name,
        "attribution": city_map.attribution,
        "regions": {name: [strip.west_m, strip.east_m] for name, strip in regions.items()},
        "config": config.model_dump(),
        "positions": len(region),
        "validation": {"cells": len(validation.features), "queries": len(validation.truth), "retrieval": recall},
        "history": history,
    }
    save_retriever(retriever, out, json.loads(json.dumps(training)))
    return recall


def fit_temperature(retriever: Retriever, validation: Validation, rng: np.random.Generator) -> tuple[float, float]:
    """What `Retriever.temperature` needs, by maximum likelihood of the true cells of validation queries.

    Args:
        retriever: trained.
        validation: its queries are asked whole, and cut down to fewer hints drawn at random.
        rng: draws them.

    Returns:
        (temperature, temperature_decay).
    """
    cells = retriever.encode_cells(validation.features)
    longest = min(len(hints) for hints in validation.descriptions)
    rows = np.arange(0, len(validation.truth), max(1, len(validation.truth) // CALIBRATION_QUERIES))
    asked = []
    for count in range(1, longest + 1):
        texts = [rng.permutation(list(validation.descriptions[int(row)]))[:count].tolist() for row in rows]
        asked.append((count, (retriever.encode_descriptions(texts) @ cells.T).astype(np.float64)))
    return most_likely_temperature(asked, validation.truth[rows])


def most_likely_temperature(
    asked: Sequence[tuple[int, npt.NDArray[np.float64]]], truth: npt.NDArray[np.intp]
) -> tuple[float, float]:
    """(temperature, decay) that give the true cells most likelihood.

    Args:
        asked: pairs of a number of hints and similarities [Q, N] of the queries with that many.
        truth: [Q] the true cell of each query.
    """

    def negative_log_likelihood(parameters: npt.NDArray[np.float64]) -> float:
        total = 0.0
        for count, scores in asked:
            logits = scores / (np.exp(parameters[0]) * count ** -parameters[1])
            total += float((logsumexp(logits, axis=1) - logits[np.arange(len(truth)), truth]).mean())
        return total

    found = minimize(negative_log_likelihood, x0=[np.log(0.2), 1.0], method="Nelder-Mead")
    return float(np.exp(found.x[0])), float(found.x[1])


def _training_region(
    city_map: CityMap,
    points: PointTable,
    cells: CellTable,
    region: Region,
    config: TrainingConfig,
    rng: np.random.Generator,
    encoder: TextEncoder,
) -> TrainingRegion:
    positions = sample_positions(region.locations(city_map.locations_m), config.spacing_m, rng)
    return TrainingRegion(city_map, points, region.cells(cells), positions, encoder)


def _validation(city_map: CityMap, points: PointTable, cells: CellTable, region: Region) -> Validation:
    positions = sample_positions(region.locations(city_map.locations_m), 10.0, np.random.default_rng(0))
    gallery = region.cells(cells)
    return Validation.of(city_map, gallery, describe_poses(city_map, points, gallery, positions))


def _optimise(
    retriever: Retriever,
    region: TrainingRegion,
    validation: Validation,
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
    retriever.train()
    for step in range(1, config.steps + 1):
        batch = region.batch(region.draw(config.batch_size, config.cluster, rng), rng)
        loss = _loss(retriever, region, batch, config.temperature)
        optimizer.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(retriever.parameters(), 1.0)
        optimizer.step()
        schedule.step()
        losses.append(loss.item())
        recall = None
        if step % config.validate_every == 0 or step == config.steps:
            recall = retrieval_recall(_rank(validation.scores(retriever.eval())), validation.truth)
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


def _loss(retriever: Retriever, region: TrainingRegion, batch: Batch, temperature: float) -> Tensor:
    hints = _hint_features(retriever, region.vocabulary, batch)
    return contrastive_loss(
        retriever.pool_hints(hints, batch.hint_mask),
        retriever.pool_instances(batch.cells, region.label_embeddings),
        batch.same_cell,
        temperature,
    )


def _hint_features(retriever: Retriever, vocabulary: HintVocabulary, batch: Batch) -> Tensor:
    """[B, H, D]; each different sentence of the batch is encoded once."""
    sentences, inverse = torch.unique(batch.sentences[batch.hint_mask], return_inverse=True)
    mask = vocabulary.mask[sentences]
    longest = int(mask.sum(dim=1).max())
    features: Tensor = retriever.hints(vocabulary.tokens[sentences, :longest].float(), mask[:, :longest])
    hints = features.new_zeros(*batch.sentences.shape, features.shape[-1])
    hints[batch.hint_mask] = features[inverse]
    return hints


def _rank(scores: npt.NDArray[np.floating[Any]]) -> npt.NDArray[np.intp]:
    return np.argsort(-scores, axis=1, kind="stable")[:, :10]
