"""Training a model of the fine stage on parts of maps and data sets, chosen on others."""

from collections.abc import Callable, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from models.language.text_encoder import TextEncoder, load_text_encoder
from models.paper.fine.checkpoint import FINE_METHODS, save_fine
from models.paper.fine.fine_model import FineConfig, FineModel, FineTargets
from models.training.engine.devices import on_device
from models.training.engine.loop import History, Progress, pick_device, run_training
from models.training.fine_data import CloningMode, FineBatch, FineSet, FineValidation
from models.training.fit_points import prepare_point_encoder
from models.training.settings import TrainingConfig, settings_record
from models.training.training_data import TrainingData


class FineTask:
    """The training task of a fine stage; a source is drawn per step, in proportion to its number of positions."""

    criterion = "within_5m"

    def __init__(
        self, model: FineModel, sources: Sequence[TrainingData], batch_size: int, pmc: CloningMode = "containing"
    ) -> None:
        self.model, self.sources, self.batch_size = model, sources, batch_size
        self.sets = [FineSet(source.training, pmc) for source in sources]
        sizes = np.array([len(source.training) for source in sources])
        self._probability = sizes / sizes.sum()

    @cached_property
    def validations(self) -> list[FineValidation]:
        """One validation for each source."""
        return [FineValidation.from_queries(source.gallery, source.queries, self.model) for source in self.sources]

    def batch(self, rng: np.random.Generator) -> tuple[int, FineBatch]:
        """Draw a source, and examples of it."""
        drawn = int(rng.choice(len(self.sources), p=self._probability)) if len(self.sources) > 1 else 0
        return drawn, self.sets[drawn].batch(self.batch_size, rng, self.model.needs_matches)

    def loss(self, batch: tuple[int, FineBatch]) -> Tensor:
        """Return the loss of a batch."""
        training, examples, device = self.sources[batch[0]].training, batch[1], self.model.device
        training.to(device)
        mask = examples.hint_mask.to(device)
        hints = training.vocabulary.features(self.model.embed_hints, examples.sentences.to(device), mask)
        instances = self.model.embed_instances(
            self.model.encode_points(examples.cells.to(device)), training.label_embeddings
        )
        targets = FineTargets(examples.targets.offset.to(device), examples.targets.match.to(device))
        return self.model.loss(hints, mask, instances, targets)

    def validate(self) -> dict[str, float]:
        """Return the mean of `FineValidation.metrics` over the sources."""
        return _mean([validation.metrics(self.model) for validation in self.validations])


def train_fine(
    load: Callable[[TextEncoder, np.random.Generator], Sequence[TrainingData]],
    out: Path,
    method: str,
    model: FineConfig,
    config: TrainingConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
) -> dict[str, float]:
    """Train a fine stage, and save the weights with the best validation.

    `load` loads the training data, `out` gets model.safetensors and config.json. Other arguments as `run_training`; the
    paper trains 32 to 35 epochs with a learning rate of 3e-4, halved every few epochs. Returns the validation metrics,
    the mean over the sources.

    Raises:
        TrainingError: see `run_training`.
    """
    rng = np.random.default_rng(config.seed)
    torch.manual_seed(config.seed)
    encoder = load_text_encoder(model.text_encoder)
    with on_device(pick_device(config.device), encoder):
        sources = load(encoder, rng)
        fine = FINE_METHODS[method](encoder, model)
        task = FineTask(fine, sources, config.batch_size, config.pmc)
        points = prepare_point_encoder(fine, sources, config, run_dir and run_dir / "points", resume, progress)
        record = settings_record(method, model, config) | {"sources": [source.facts for source in sources]}
        record |= {"point_encoder": points}
        history = run_training(task, config, run_dir, resume, progress, rng, record)
        return _finish(task, out, config, history, points)


def _finish(
    task: FineTask, out: Path, config: TrainingConfig, history: History, points: dict[str, float]
) -> dict[str, float]:
    """Measure and save the model; return the metrics for `train_fine`."""
    fine, validations = task.model, task.validations
    metrics = [validation.metrics(fine) for validation in validations]
    residuals = np.concatenate([validation.residuals_m(fine)[:, 0].ravel() for validation in validations])
    fine.config = fine.config.model_copy(update={"error_m": float(np.sqrt(np.mean(residuals**2)))})
    training = {
        "config": config.model_dump(mode="json"),
        "sources": [_facts(*part) for part in zip(task.sources, validations, metrics, strict=True)],
        **history.facts,
        "point_encoder": points,
    }
    save_fine(fine.cpu(), out, training)
    return _mean(metrics)


def _facts(source: TrainingData, validation: FineValidation, metrics: dict[str, float]) -> dict[str, Any]:
    measured = {"queries": len(validation.rows), "cell_center": validation.center_metrics()} | metrics
    return source.facts | {"positions": len(source.training), "validation": measured}


def _mean(metrics: Sequence[dict[str, float]]) -> dict[str, float]:
    return {name: float(np.mean([each[name] for each in metrics])) for name in metrics[0]}
