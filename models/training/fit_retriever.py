"""Training of a retriever on maps and data sets."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from models.language.text_encoder import TextEncoder, load_text_encoder
from models.paper.checkpoint import save_retriever
from models.paper.levels import Levels
from models.paper.retriever import Retriever, RetrieverConfig
from models.training.engine.devices import on_device
from models.training.engine.loop import History, Progress, pick_device, run_training
from models.training.fit_points import prepare_point_encoder
from models.training.retrieval_data import Batch
from models.training.settings import TrainingConfig, settings_record
from models.training.training_data import TrainingData
from models.training.validation import Validation, calibrate, mean_recall


class RetrievalTask:
    """The training task of a retriever; a source is drawn per step, in proportion to its number of positions.

    `cluster` descriptions of a batch lie near each other, as hard negatives.
    """

    criterion = "recall@5"

    def __init__(self, model: Retriever, sources: Sequence[TrainingData], batch_size: int, cluster: int) -> None:
        self.model: Retriever = model
        self.sources, self.batch_size, self.cluster = sources, batch_size, cluster
        sizes = np.array([len(source.training) for source in sources])
        self._probability = sizes / sizes.sum()

    @cached_property
    def validations(self) -> list[Validation]:
        """One validation for each source."""
        return [Validation(source.gallery, source.queries, self.model) for source in self.sources]

    def batch(self, rng: np.random.Generator) -> tuple[int, Batch]:
        """Draw a source, and examples of it."""
        drawn = int(rng.choice(len(self.sources), p=self._probability)) if len(self.sources) > 1 else 0
        training = self.sources[drawn].training
        return drawn, training.batch(training.draw(self.batch_size, self.cluster, rng), rng)

    def loss(self, batch: tuple[int, Batch]) -> Tensor:
        """Return the loss over all pairs of the batch, in float32 whatever precision the encoders use."""
        device = next(self.model.parameters()).device
        training, examples = self.sources[batch[0]].training, batch[1]
        training.to(device)
        mask = examples.hint_mask.to(device)
        hints = training.vocabulary.features(self.model.embed_hints, examples.sentences.to(device), mask)
        text = self.model.embed_texts(hints, mask)
        cells = self.model.embed_cells(self.model.encode_points(examples.cells.to(device)), training.label_embeddings)
        # Half precision is too coarse for logits at a temperature of 0.05.
        with torch.autocast(device.type, enabled=False):
            return self.model.loss(_in_float32(text), _in_float32(cells), examples.same_cell.to(device))

    def validate(self) -> dict[str, float]:
        """Return recall@1, 3 and 5, the mean over the sources, and figures of the loss since the last validation."""
        recalls = [validation.recall(self.model) for validation in self.validations]
        return {f"recall@{k}": recall for k, recall in mean_recall(recalls).items()} | self.model.pop_loss_figures()


def _in_float32(levels: Levels) -> Levels:
    instance, relation = (x if x is None else x.float() for x in (levels.instance, levels.relation))
    return replace(levels, global_vectors=levels.global_vectors.float(), instance=instance, relation=relation)


def train_retriever(
    load: Callable[[TextEncoder, np.random.Generator], Sequence[TrainingData]],
    out: Path,
    method: type[Retriever],
    model: RetrieverConfig,
    config: TrainingConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
) -> dict[int, float]:
    """Train a retriever, calibrate the weights with the best validation, and save them.

    `load` loads the training data, `out` gets model.safetensors and config.json. Other arguments as `run_training`.
    Returns the retrieval recall@k on the validation queries, the mean over the sources.

    Raises:
        TrainingError: see `run_training`.
    """
    rng = np.random.default_rng(config.seed)
    torch.manual_seed(config.seed)
    encoder = load_text_encoder(model.text_encoder)
    with on_device(pick_device(config.device), encoder):
        sources = load(encoder, rng)
        retriever = method(encoder, model)
        task = RetrievalTask(retriever, sources, config.batch_size, config.cluster)
        points = prepare_point_encoder(retriever, sources, config, run_dir and run_dir / "points", resume, progress)
        record = settings_record(method.method, model, config) | {"sources": [source.facts for source in sources]}
        record |= {"point_encoder": points}
        history = run_training(task, config, run_dir, resume, progress, rng, record)
        return _finish(task, out, config, history, rng, points)


def _finish(
    task: RetrievalTask,
    out: Path,
    config: TrainingConfig,
    history: History,
    rng: np.random.Generator,
    points: dict[str, float],
) -> dict[int, float]:
    """Calibrate, measure and save the model; return the recall for `train_retriever`."""
    retriever, validations = task.model, task.validations
    retriever.config = retriever.config.model_copy(update=calibrate(retriever, validations, rng))
    recalls = [validation.recall(retriever) for validation in validations]
    facts = [_facts(*part) for part in zip(task.sources, validations, recalls, strict=True)]
    training = {"config": config.model_dump(mode="json"), "sources": facts, **history.facts, "point_encoder": points}
    save_retriever(retriever.cpu(), out, training)
    return mean_recall(recalls)


def _facts(source: TrainingData, validation: Validation, recall: dict[int, float]) -> dict[str, Any]:
    size = {"cells": len(validation.features), "queries": len(validation.truth)}
    return source.facts | {"positions": len(source.training), "validation": size | {"retrieval": recall}}
