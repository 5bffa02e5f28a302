"""Training the point encoder to tell what an instance is and which colour it has; it is frozen after that.

Two heads, one for the label and one for the colour, their cross-entropies added (Text2Pos and after it all, MNCL too).
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
from models.errors import TrainingError, WeightsError
from models.files import replace_file
from models.paper.fine.fine_model import FineModel
from models.paper.instance_encoder import GEOMETRY_WIDTHS, CellFeatures
from models.paper.point_encoder import POINT_WIDTH, PointEncoder
from models.paper.retriever import Retriever
from models.training.engine.loop import LoopConfig, Progress, pick_device, run_training
from models.training.settings import TrainingConfig, load_settings
from models.training.training_data import TrainingCells, TrainingData

CELLS_A_SOURCE, CHOSEN_BY_CELLS = 800, 100  # whose instances it is trained on, and chosen by


@dataclass(frozen=True, slots=True, eq=False)
class PointExamples:
    """R instances.

    Attributes:
        points: [R, 256, 6].
        label, colour: [R] int64, -100 where unknown.
    """

    points: Tensor
    label: Tensor
    colour: Tensor

    @classmethod
    def of(cls, parts: Sequence[CellFeatures], labels: Sequence[str], size: int, seed: int) -> "PointExamples":
        """Instances of `size` cells of each gallery; a class that is not among `labels` is unknown."""
        rng, number = np.random.default_rng(seed), {label: n for n, label in enumerate(labels)}
        points, label, rgb = [], [], []
        for part in parts:
            cells = rng.choice(len(part), min(size, len(part)), replace=False)
            batch = part.batch(cells)
            own = np.array([number.get(name, -100) for name in part.labels])
            points.append(part.points(cells))
            label.append(own[batch.label[batch.mask]])
            columns = batch.geometry[batch.mask][:, -GEOMETRY_WIDTHS["colour"] :].numpy()
            rgb.append(np.where(columns[:, 3:] > 0, columns[:, :3], np.nan))
        colour = KITTI360_PALETTE.word_index(np.concatenate(rgb))
        found = np.concatenate(label), np.where(colour < 0, -100, colour)
        return cls(torch.cat(points), *(torch.from_numpy(column.astype(np.int64)) for column in found))

    def __len__(self) -> int:
        return len(self.label)

    def take(self, rows: npt.NDArray[np.intp]) -> "PointExamples":
        """Some of them."""
        return PointExamples(self.points[rows], self.label[rows], self.colour[rows])


class _Classifier(nn.Module):
    """A point encoder with a head for the label and one for the colour."""

    def __init__(self, encoder: PointEncoder, labels: int) -> None:
        super().__init__()
        self.encoder = encoder
        self.label = nn.Linear(POINT_WIDTH, labels)
        self.colour = nn.Linear(POINT_WIDTH, len(KITTI360_PALETTE.words))

    def forward(self, points: Tensor) -> tuple[Tensor, Tensor]:
        seen = self.encoder(points)
        return self.label(seen), self.colour(seen)


class _PointTask:
    """What `run_training` makes of it (models.training.engine.loop.Task)."""

    criterion = "label"

    def __init__(self, model: _Classifier, training: PointExamples, validation: PointExamples, batch_size: int) -> None:
        self.model, self.training, self.validation = model, training, validation
        self.batch_size = batch_size

    def batch(self, rng: np.random.Generator) -> PointExamples:
        return self.training.take(rng.choice(len(self.training), self.batch_size))

    def loss(self, batch: PointExamples) -> Tensor:
        device = next(self.model.parameters()).device
        logits = self.model(batch.points.to(device))
        wanted = batch.label.to(device), batch.colour.to(device)
        return torch.stack([_cross_entropy(*pair) for pair in zip(logits, wanted, strict=True)]).sum()

    @torch.inference_mode()
    def validate(self) -> dict[str, float]:
        device = next(self.model.parameters()).device
        logits = [self.model(part.to(device)) for part in self.validation.points.split(256)]
        label, colour = (torch.cat(part).argmax(dim=-1).cpu() for part in zip(*logits, strict=True))
        wanted = {"label": (label, self.validation.label), "colour": (colour, self.validation.colour)}
        return {
            name: float((found == truth)[truth >= 0].float().mean().nan_to_num())
            for name, (found, truth) in wanted.items()
        }


def _cross_entropy(logits: Tensor, wanted: Tensor) -> Tensor:
    """0 where nothing is known."""
    return nn.functional.cross_entropy(logits, wanted, reduction="sum") / max(1, int((wanted >= 0).sum()))


def train_points(
    sources: Sequence[TrainingCells],
    out: Path,
    config: TrainingConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
) -> dict[str, float]:
    """Train a point encoder alone and save it, for `TrainingConfig.points` of what is trained after it.

    Args:
        sources: what to train on.
        out: directory for model.safetensors and config.json.
        config: how to optimise.
        run_dir: see `run_training`.
        resume: see `run_training`.
        progress: see `run_training`.

    Returns:
        As `fit_points`.

    Raises:
        WeightsError, TrainingError: see `fit_points`.
    """
    torch.manual_seed(config.seed)
    encoder = PointEncoder()
    figures = fit_points(encoder, sources, config, run_dir, resume, progress)
    out.mkdir(parents=True, exist_ok=True)
    replace_file(out / WEIGHTS_FILE, save(encoder.cpu().state_dict()))
    facts = {"config": config.model_dump(mode="json"), "validation": figures, "sources": [s.facts for s in sources]}
    replace_file(out / CONFIG_FILE, (json.dumps({"method": "points", **facts}, indent=2) + "\n").encode())
    return figures


def look_at_points(
    model: Retriever | FineModel,
    sources: Sequence[TrainingData],
    config: TrainingConfig,
    run_dir: Path | None,
    resume: bool,
    progress: Callable[[Progress], None] | None,
) -> dict[str, float]:
    """Give a model its point encoder, if it takes points, and look once at all that it is trained on.

    The point encoder is read from `config.points`, or trained here on their cells; the other arguments, return and
    errors as `fit_points`.
    """
    if model.points is None:
        if config.points:
            raise TrainingError("training.points is for models that take points; have points among model.inputs")
        return {}
    if config.points is None:
        _, loop = load_settings("points", [f"training.seed={config.seed}", f"training.device={config.device}"])
        cells = [source.cells for source in sources]
        figures = fit_points(model.points, cells, loop, run_dir, resume, progress)
    else:
        figures = _read_points(model.points, config.points)
        model.points.to(pick_device(config.device))
    for source in sources:
        source.training.features = model.with_point_features(source.training.features)
    return figures


def _read_points(encoder: PointEncoder, directory: Path) -> dict[str, float]:
    """Load what `train_points` saved; its figures."""
    try:
        encoder.load_state_dict(load_file(directory / WEIGHTS_FILE))
        figures: dict[str, float] = json.loads((directory / CONFIG_FILE).read_text())["validation"]
    except (OSError, SafetensorError, RuntimeError, ValueError, KeyError) as error:
        raise WeightsError(
            f"training.points={directory}: no point encoder there ({type(error).__name__}); make one with "
            f"'hereabouts train --method points --out {directory}', or leave training.points out"
        ) from error
    encoder.requires_grad_(False).eval()
    return figures


def fit_points(
    encoder: PointEncoder,
    sources: Sequence[TrainingCells],
    config: LoopConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
) -> dict[str, float]:
    """Train a point encoder on what a model is trained on, in place, and freeze it.

    Args:
        encoder: of a retriever or a fine stage.
        sources: their training cells to learn from, their validation cells to choose by.
        config: how to optimise.
        run_dir: see `run_training`.
        resume: see `run_training`.
        progress: see `run_training`.

    Returns:
        Shares of the validation instances whose "label" and "colour" it tells.

    Raises:
        WeightsError: the cells come without points.
        TrainingError: see `run_training`.
    """
    labels = sorted({label for source in sources for label in source.training.labels})
    training = PointExamples.of([source.training for source in sources], labels, CELLS_A_SOURCE, config.seed)
    validation = PointExamples.of([source.validation for source in sources], labels, CHOSEN_BY_CELLS, config.seed)
    model = _Classifier(encoder.requires_grad_(True), len(labels))
    task = _PointTask(model, training, validation, config.batch_size)
    history = run_training(task, config, run_dir, resume, progress)
    encoder.requires_grad_(False).eval()
    return next(row.figures for row in history.rows if row.step == history.best_step)
