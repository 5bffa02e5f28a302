"""Training of the point encoder as a classifier of label and colour, before a model has it, frozen or not.

The loss is the sum of the cross-entropies of the two heads, as in Text2Pos and its successors up to MNCL.
"""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
import torch
from safetensors import SafetensorError
from safetensors.torch import load_file, save
from torch import Tensor, nn

from models.checkpoint import CONFIG_FILE, WEIGHTS_FILE
from models.citymap.colours import KITTI360_PALETTE
from models.citymap.point_sample import PointFrame, PointSampling
from models.errors import TrainingError, WeightsError
from models.files import replace_file
from models.paper.fine.fine_model import FineModel
from models.paper.instance_encoder import GEOMETRY_WIDTHS, CellFeatures
from models.paper.point_encoder import POINT_WIDTH, PointArchitecture, PointEncoder
from models.paper.retriever import Retriever
from models.training.engine.loop import LoopConfig, Progress, pick_device, run_training
from models.training.settings import TrainingConfig, load_settings
from models.training.training_data import TrainingCells, TrainingData

TRAINING_CELLS_PER_SOURCE, VALIDATION_CELLS_PER_SOURCE = 800, 100
_ARCHITECTURE = "point_encoder"  # key of config.json; "small" if it is missing


@dataclass(frozen=True, slots=True, eq=False)
class PointExamples:
    """R instances with their labels and colours."""

    points: Tensor  # [R, 256, 6]
    label: Tensor  # [R] int64, -100 where unknown
    colour: Tensor

    @classmethod
    def sample(
        cls, parts: Sequence[CellFeatures], labels: Sequence[str], size: int, seed: int, frame: PointFrame = "part"
    ) -> "PointExamples":
        """Draw the instances of `size` cells of each gallery; a class that is not in `labels` is unknown."""
        rng, number = np.random.default_rng(seed), {label: n for n, label in enumerate(labels)}
        points, label, rgb = [], [], []
        for part in parts:
            cells = rng.choice(len(part), min(size, len(part)), replace=False)
            batch = part.batch(cells)
            codes = np.array([number.get(name, -100) for name in part.labels])
            points.append(part.points(cells, PointSampling(frame)))
            label.append(codes[batch.label[batch.mask]])
            columns = batch.geometry[batch.mask][:, -GEOMETRY_WIDTHS["colour"] :].numpy()
            rgb.append(np.where(columns[:, 3:] > 0, columns[:, :3], np.nan))
        colour = KITTI360_PALETTE.word_index(np.concatenate(rgb))
        targets = np.concatenate(label), np.where(colour < 0, -100, colour)
        return cls(torch.cat(points), *(torch.from_numpy(column.astype(np.int64)) for column in targets))

    def __len__(self) -> int:
        return len(self.label)

    def take(self, rows: npt.NDArray[np.intp]) -> "PointExamples":
        """Return some of the instances."""
        return PointExamples(self.points[rows], self.label[rows], self.colour[rows])


class _Classifier(nn.Module):
    """A point encoder with a head for the label and one for the colour."""

    def __init__(self, encoder: PointEncoder, labels: int) -> None:
        super().__init__()
        self.encoder = encoder
        self.label = nn.Linear(POINT_WIDTH, labels)
        self.colour = nn.Linear(POINT_WIDTH, len(KITTI360_PALETTE.words))

    def forward(self, points: Tensor) -> tuple[Tensor, Tensor]:
        features = self.encoder(points)
        return self.label(features), self.colour(features)


class _PointTask:
    """The training task of the point encoder (models.training.engine.loop.Task)."""

    criterion = "label"

    def __init__(self, model: _Classifier, training: PointExamples, validation: PointExamples, batch_size: int) -> None:
        self.model, self.training, self.validation = model, training, validation
        self.batch_size = batch_size

    def batch(self, rng: np.random.Generator) -> PointExamples:
        return self.training.take(rng.choice(len(self.training), self.batch_size))

    def loss(self, batch: PointExamples) -> Tensor:
        device = next(self.model.parameters()).device
        logits = self.model(batch.points.to(device))
        targets = batch.label.to(device), batch.colour.to(device)
        return torch.stack([_cross_entropy(*pair) for pair in zip(logits, targets, strict=True)]).sum()

    @torch.inference_mode()
    def validate(self) -> dict[str, float]:
        device = next(self.model.parameters()).device
        logits = [self.model(part.to(device)) for part in self.validation.points.split(256)]
        label, colour = (torch.cat(part).argmax(dim=-1).cpu() for part in zip(*logits, strict=True))
        outcomes = {"label": (label, self.validation.label), "colour": (colour, self.validation.colour)}
        return {
            name: float((predicted == truth)[truth >= 0].float().mean().nan_to_num())
            for name, (predicted, truth) in outcomes.items()
        }


def _cross_entropy(logits: Tensor, targets: Tensor) -> Tensor:
    """Return the mean cross-entropy of the known targets; 0 if there are none."""
    return nn.functional.cross_entropy(logits, targets, reduction="sum") / max(1, int((targets >= 0).sum()))


def train_points(
    sources: Sequence[TrainingCells],
    out: Path,
    config: TrainingConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
    *,
    architecture: PointArchitecture = "small",
) -> dict[str, float]:
    """Train a point encoder, save it to `out` for `TrainingConfig.points`, and return its metrics; see `fit_points`."""
    torch.manual_seed(config.seed)
    encoder = PointEncoder(architecture)
    metrics = fit_points(encoder, sources, config, run_dir, resume, progress)
    out.mkdir(parents=True, exist_ok=True)
    replace_file(out / WEIGHTS_FILE, save(encoder.cpu().state_dict()))
    record = {
        "method": "points",
        _ARCHITECTURE: architecture,
        "config": config.model_dump(mode="json"),
        "validation": metrics,
        "sources": [source.facts for source in sources],
    }
    replace_file(out / CONFIG_FILE, (json.dumps(record, indent=2) + "\n").encode())
    return metrics


def prepare_point_encoder(
    model: Retriever | FineModel,
    sources: Sequence[TrainingData],
    config: TrainingConfig,
    run_dir: Path | None,
    resume: bool,
    progress: Callable[[Progress], None] | None,
) -> dict[str, float]:
    """Load or train the point encoder of a model that has one, and prepare the sources for it.

    The point encoder is loaded from `config.points`, or trained on the cells of the sources. The sources get their
    point features, or draw points for each step if the model needs it. Other arguments, result and errors as
    `fit_points`.
    """
    if model.points is None:
        if config.points:
            raise TrainingError("training.points is for models with point inputs; add points to model.inputs")
        return {}
    if config.points is None:
        _, loop = load_settings("points", [f"training.seed={config.seed}", f"training.device={config.device}"])
        cells = [source.cells for source in sources]
        metrics = fit_points(model.points, cells, loop, run_dir, resume, progress)
    else:
        metrics = _read_points(model.points, config.points)
        model.points.to(pick_device(config.device))
    model.points.requires_grad_(not model.config.points_frozen)
    for source in sources:
        if model.draws_points:
            source.training.point_frame = model.points.frame
        else:
            source.training.features = model.with_point_features(source.training.features)
    return metrics


def _read_points(encoder: PointEncoder, directory: Path) -> dict[str, float]:
    """Load a point encoder of `train_points` in place, and return its metrics."""
    wanted, command = encoder.architecture, f"hereabouts train --method points --out {directory}"
    if wanted != "small":
        command += f" --set model.point_encoder={wanted}"
    try:
        record = json.loads((directory / CONFIG_FILE).read_text())
        metrics: dict[str, float] = record["validation"]
        stored = record.get(_ARCHITECTURE, "small")
        if stored != wanted:
            raise WeightsError(
                f"training.points={directory} has a point encoder of the kind '{stored}', but model.point_encoder is "
                f"'{wanted}'; set model.point_encoder={stored}, or train another one with '{command}'"
            )
        encoder.load_state_dict(load_file(directory / WEIGHTS_FILE))
    except (OSError, SafetensorError, RuntimeError, ValueError, KeyError) as error:
        raise WeightsError(
            f"training.points={directory} has no point encoder ({type(error).__name__}); train one with '{command}', "
            "or leave training.points out"
        ) from error
    encoder.requires_grad_(False).eval()
    return metrics


def fit_points(
    encoder: PointEncoder,
    sources: Sequence[TrainingCells],
    config: LoopConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
) -> dict[str, float]:
    """Train a point encoder in place, and freeze it.

    Other arguments as `run_training`. Returns the shares of the validation instances with correct "label" and "colour".

    Raises:
        WeightsError: the points of the cells are not available.
        TrainingError: see `run_training`.
    """
    labels = sorted({label for source in sources for label in source.training.labels})
    training = PointExamples.sample(
        [source.training for source in sources], labels, TRAINING_CELLS_PER_SOURCE, config.seed, encoder.frame
    )
    validation = PointExamples.sample(
        [source.validation for source in sources], labels, VALIDATION_CELLS_PER_SOURCE, config.seed, encoder.frame
    )
    model = _Classifier(encoder.requires_grad_(True), len(labels))
    task = _PointTask(model, training, validation, config.batch_size)
    record = config.model_dump(mode="json")
    if encoder.architecture != "small":
        record |= {_ARCHITECTURE: encoder.architecture}
    history = run_training(task, config, run_dir, resume, progress, record=record)
    encoder.requires_grad_(False).eval()
    return next(row.figures for row in history.rows if row.step == history.best_step)
