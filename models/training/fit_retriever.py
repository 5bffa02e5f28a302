"""Training a retriever on parts of maps and data sets, chosen on others."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch

from models.language.text_encoder import TextEncoder, load_text_encoder
from models.retrieval.checkpoint import save_retriever
from models.retrieval.retriever import Retriever, RetrieverConfig
from models.training.calibration import calibrate
from models.training.engine import distributed
from models.training.engine.loop import History, Progress, run_training
from models.training.fit_points import train_points
from models.training.retrieval_task import RetrievalTask
from models.training.settings import TrainingConfig, settings_record
from models.training.training_data import TrainingData
from models.training.validation import Validation, mean_recall


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
    """Train, keep what is best on validation queries, calibrate on them, save.

    Of several processes (`distributed.process_group`), all call this with the same arguments, and the first saves.

    Args:
        load: reads what to train on; drawn from in turn, by their numbers of positions.
        out: directory for model.safetensors and config.json.
        method: which retriever.
        model: shape and loss of it, of its `config_type`.
        config: how to train.
        run_dir: directory for metrics, curves and what a killed run goes on from; None keeps none.
        resume: go on from `run_dir`, if a run stands there.
        progress: called at every step, in the first process.

    Returns:
        Retrieval recall@k on the validation queries, the mean over the sources.

    Raises:
        TrainingError: see `run_training`.
    """
    rng = np.random.default_rng(config.seed)
    torch.manual_seed(config.seed)
    encoder = load_text_encoder(model.text_encoder)
    sources = load(encoder, rng)
    retriever = method(encoder, model)
    task = RetrievalTask(retriever, sources, config.batch_size, config.cluster)
    points = _look_at_points(retriever, sources, config, run_dir and run_dir / "points", resume, progress)
    record = settings_record(method.method, model, config) | {"sources": [source.facts for source in sources]}
    try:
        history = run_training(task, config, run_dir, resume, progress, rng, record)
        return distributed.from_first(lambda: _finish(task, out, config, history, rng, points))
    finally:
        encoder.to("cpu")  # it is shared with whatever this process does next


def _look_at_points(
    retriever: Retriever,
    sources: Sequence[TrainingData],
    config: TrainingConfig,
    run_dir: Path | None,
    resume: bool,
    progress: Callable[[Progress], None] | None,
) -> dict[str, float]:
    """Train the point encoder, if there is one, and look once at all that the retriever is trained on; its figures."""
    if retriever.points is None:
        return {}
    figures = train_points(retriever.points, sources, config, run_dir, resume, progress)
    for source in sources:
        source.training.features = retriever.seen(source.training.features)
    return figures


def _finish(
    task: RetrievalTask,
    out: Path,
    config: TrainingConfig,
    history: History,
    rng: np.random.Generator,
    points: dict[str, float],
) -> dict[int, float]:
    """Calibrate, measure, save; the recall that `train_retriever` returns."""
    retriever, validations = task.model, task.validations
    retriever.config = retriever.config.model_copy(update=calibrate(retriever, validations, rng))
    recalls = [validation.recall(retriever) for validation in validations]
    facts = [_facts(*part) for part in zip(task.sources, validations, recalls, strict=True)]
    training = {
        "config": config.model_dump(mode="json"),
        "sources": facts,
        **history.facts,
        "point_encoder": points,
    }
    retriever.cpu().text_encoder.cpu()
    save_retriever(retriever, out, training)
    return mean_recall(recalls)


def _facts(source: TrainingData, validation: Validation, recall: dict[int, float]) -> dict[str, Any]:
    size = {"cells": len(validation.features), "queries": len(validation.truth)}
    return source.facts | {"positions": len(source.training), "validation": size | {"retrieval": recall}}
