"""Training a model of the fine stage on parts of maps and data sets, chosen on others."""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from models.city.cells import cut_cells
from models.city.hints import describe_poses, sample_positions
from models.city.osm import load_osm
from models.city.points import PointTable
from models.city.pose_files import load_data
from models.city.pose_store import PoseStore
from models.city.regions import split_regions
from models.city.types import CityMap
from models.language.hints_text import render_hint
from models.language.text_encoder import TextEncoder, load_text_encoder
from models.localization.checkpoint import FINE_METHODS, save_fine
from models.localization.fine_model import FineConfig, FineModel, Truth
from models.training import distributed
from models.training.data import HintVocabulary, TrainingSet
from models.training.fine_data import FineBatch, FineSet, FineValidation
from models.training.loop import History, LoopConfig, Progress, run_training
from models.training.sources import VALIDATION_SPACING_M


@dataclass(frozen=True, slots=True, eq=False)
class FineSource:
    """One map or data set to train the fine stage on.

    Attributes:
        training, validation: parts of it that share no cell.
        facts: what it is, for the record beside the weights.
    """

    training: FineSet
    validation: FineValidation
    facts: dict[str, Any]


class FineTask:
    """What `run_training` makes of the fine stage (models.training.loop.Task).

    Args:
        model: trained in place.
        sources: drawn from in turn, by their numbers of positions.
        batch_size: examples a step, of all processes together.

    Raises:
        TrainingError: the batch cannot be split over the processes.
    """

    criterion = "within_5m"

    def __init__(self, model: FineModel, sources: Sequence[FineSource], batch_size: int) -> None:
        self.model, self.sources, self.share = model, sources, distributed.share_of(batch_size)
        sizes = np.array([len(source.training) for source in sources])
        self._probability = sizes / sizes.sum()

    def batch(self, rng: np.random.Generator) -> tuple[int, FineBatch]:
        """Which source, and examples of it."""
        drawn = int(rng.choice(len(self.sources), p=self._probability)) if len(self.sources) > 1 else 0
        return drawn, self.sources[drawn].training.batch(self.share, rng, self.model.needs_matches)

    def loss(self, batch: tuple[int, FineBatch]) -> Tensor:
        """Scalar to make small."""
        training, examples, device = self.sources[batch[0]].training.training, batch[1], self.model.device
        training.to(device)
        hints = hint_features(self.model, training.vocabulary, examples)
        instances = self.model.look(examples.cells.to(device), training.label_embeddings)
        truth = Truth(examples.truth.offset.to(device), examples.truth.match.to(device))
        return self.model.loss(hints, examples.hint_mask.to(device), instances, truth)

    def validate(self) -> dict[str, float]:
        """`FineValidation.figures`, the mean over the sources."""
        self.model.text_encoder.to(self.model.device)
        return _mean([source.validation.figures(self.model) for source in self.sources])


def hint_features(model: FineModel, vocabulary: HintVocabulary, batch: FineBatch) -> Tensor:
    """[B, H, D] on the model's device; each different sentence of the batch is read once."""
    device = model.device
    mask = batch.hint_mask.to(device)
    sentences, inverse = torch.unique(batch.sentences.to(device)[mask], return_inverse=True)
    features = model.read(vocabulary.tokens(sentences))
    hints = features.new_zeros(*mask.shape, features.shape[-1])
    hints[mask] = features[inverse]
    return hints


def train_fine(
    load: Callable[[TextEncoder, np.random.Generator], Sequence[FineSource]],
    out: Path,
    method: str,
    model: FineConfig,
    config: LoopConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
) -> dict[str, float]:
    """Train a model of the fine stage, keep what is best on validation queries, save.

    Of several processes (`distributed.process_group`), all call this with the same arguments, and the first saves.

    Args:
        load: reads what to train on.
        out: directory for model.safetensors and config.json.
        method: key of `FINE_METHODS`.
        model: its shape, of the method's `config_type`.
        config: how to optimise (the paper: 32 to 35 epochs, learning rate 3e-4, halved every few).
        run_dir: as `run_training`.
        resume: as `run_training`.
        progress: as `run_training`.

    Returns:
        Figures on the validation queries, the mean over the sources.

    Raises:
        TrainingError: see `run_training`.
    """
    rng = np.random.default_rng(config.seed)
    torch.manual_seed(config.seed)
    encoder = load_text_encoder(model.text_encoder)
    sources = load(encoder, rng)
    fine = FINE_METHODS[method](encoder, model)
    task = FineTask(fine, sources, config.batch_size)
    record = {
        "method": method,
        "model": model.model_dump(mode="json"),
        "training": config.model_dump(mode="json"),
        "sources": [source.facts | {"pmc": source.training.pmc} for source in sources],
    }
    record = json.loads(json.dumps(record))
    try:
        history = run_training(task, config, run_dir, resume, progress, rng, record)
        return distributed.from_first(lambda: _finish(task, out, config, history))
    finally:
        encoder.to("cpu")  # it is shared with whatever this process does next


def _finish(task: FineTask, out: Path, config: LoopConfig, history: History) -> dict[str, float]:
    """Measure, save; the figures that `train_fine` returns."""
    fine, sources = task.model, task.sources
    figures = [source.validation.figures(fine) for source in sources]
    residuals = np.concatenate([source.validation.residuals_m(fine)[:, 0].ravel() for source in sources])
    fine.config = fine.config.model_copy(update={"error_m": float(np.sqrt(np.mean(residuals**2)))})
    training = {
        "config": config.model_dump(mode="json"),
        "sources": [_facts(source, found) for source, found in zip(sources, figures, strict=True)],
        "history": [{"step": row.step, "loss": row.loss} | row.figures for row in history.rows],
        "best_step": history.best_step,
    }
    save_fine(fine.cpu(), out, json.loads(json.dumps(training)))
    return _mean(figures)


def _facts(source: FineSource, figures: dict[str, float]) -> dict[str, Any]:
    size = {"positions": len(source.training), "pmc": source.training.pmc}
    asked = source.validation
    measured = {"queries": len(asked.rows), "cell_center": asked.center_figures()} | figures
    return source.facts | size | {"validation": measured}


def load_fine_source(
    data: Path,
    encoder: TextEncoder,
    spacing_m: float,
    rng: np.random.Generator,
    splits: tuple[str, str],
    pmc: bool = True,
) -> FineSource:
    """Read a map or a data set; arguments and errors as `models.training.sources.load_source`, pmc as `FineSet`."""
    if not data.is_dir():
        return fine_source_of_map(load_osm(data), encoder, spacing_m, rng, pmc)
    training, validation = (load_data(data, split) for split in splits)
    facts = {
        "data": data.resolve().name,
        "scenes": {s: [n.name for n in p.scenes] for s, p in zip(splits, (training, validation), strict=True)},
    }
    return fine_source_of_stores(training, validation, encoder, facts, pmc)


def fine_source_of_stores(
    training: PoseStore, validation: PoseStore, encoder: TextEncoder, facts: dict[str, Any], pmc: bool = True
) -> FineSource:
    """Some scenes of a data set to train on, others to choose by."""
    poses = validation.poses
    said = [[render_hint(hint) for hint in poses.hints(q)] for q in range(len(poses))]
    asked = FineValidation.of(
        validation.cell_table(), np.array(validation.labels), said, poses.positions_m, poses.cell.astype(np.intp)
    )
    return FineSource(FineSet.of_store(TrainingSet.of_store(training, encoder), training, pmc), asked, facts)


def fine_source_of_map(
    city_map: CityMap, encoder: TextEncoder, spacing_m: float, rng: np.random.Generator, pmc: bool = True
) -> FineSource:
    """The west of a map to train on, the strip beside it to choose by (`models.training.sources.source_of_map`)."""
    points = PointTable.of(city_map, city_map.rules.eps_m)
    cells = cut_cells(city_map, points)
    regions = split_regions(cells)
    west, strip = regions["train"], regions["val"]
    positions = sample_positions(west.locations(city_map.locations_m), spacing_m, rng)
    asked = sample_positions(strip.locations(city_map.locations_m), VALIDATION_SPACING_M, np.random.default_rng(0))
    gallery, taught = strip.cells(cells), west.cells(cells)
    poses = describe_poses(city_map, points, gallery, asked)
    row = {cell_id: n for n, cell_id in enumerate(gallery.ids)}
    validation = FineValidation.of(
        gallery,
        np.array([i.label for i in city_map.instances]),
        [[render_hint(hint) for hint in pose.description.hints] for pose in poses],
        np.array([pose.position_m for pose in poses]),
        np.array([row[pose.cell_id] for pose in poses]),
    )
    facts = {"data": city_map.name, "attribution": city_map.attribution}
    training = TrainingSet.of_map(city_map, points, taught, positions, encoder)
    return FineSource(FineSet.of_map(training, taught, pmc), validation, facts)


def _mean(figures: Sequence[dict[str, float]]) -> dict[str, float]:
    return {name: float(np.mean([f[name] for f in figures])) for name in figures[0]}
