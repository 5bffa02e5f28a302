"""Training the point encoder to tell what an instance is and which colour it has; it is frozen after that."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor, nn

from models.city.colours import KITTI360_PALETTE
from models.retrieval.instance_encoder import GEOMETRY, CellFeatures
from models.retrieval.point_encoder import POINT_WIDTH, PointEncoder
from models.training.engine import distributed
from models.training.engine.loop import LoopConfig, Progress, run_training
from models.training.training_data import TrainingData

CELLS_A_SOURCE, CHOSEN_BY_CELLS = 800, 100  # whose instances it is trained on, and chosen by
STEPS, VALIDATE_EVERY, BATCH, LEARNING_RATE = 600, 100, 64, 2e-3


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
            columns = batch.geometry[batch.mask][:, -GEOMETRY["colour"] :].numpy()
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

    def __init__(self, model: _Classifier, training: PointExamples, validation: PointExamples) -> None:
        self.model, self.training, self.validation = model, training, validation

    def batch(self, rng: np.random.Generator) -> PointExamples:
        return self.training.take(rng.choice(len(self.training), distributed.share_of(BATCH)))

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
    encoder: PointEncoder,
    sources: Sequence[TrainingData],
    config: LoopConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
) -> dict[str, float]:
    """Train a point encoder on what a retriever is trained on, in place, and freeze it.

    Args:
        encoder: of the retriever.
        sources: their training cells to learn from, their validation cells to choose by.
        config: seed and device.
        run_dir: see `run_training`.
        resume: see `run_training`.
        progress: see `run_training`.

    Returns:
        Shares of the validation instances whose "label" and "colour" it tells.

    Raises:
        WeightsError: the cells come without points.
        TrainingError: see `run_training`.
    """
    galleries = [source.training.features for source in sources]
    labels = sorted({label for gallery in galleries for label in gallery.labels})
    training = PointExamples.of(galleries, labels, CELLS_A_SOURCE, config.seed)
    asked = [CellFeatures.of(source.gallery.cells, np.array(source.gallery.labels)) for source in sources]
    validation = PointExamples.of(asked, labels, CHOSEN_BY_CELLS, config.seed)
    model = _Classifier(encoder.requires_grad_(True), len(labels))
    loop = LoopConfig(
        seed=config.seed,
        steps=STEPS,
        batch_size=BATCH,
        learning_rate=LEARNING_RATE,
        validate_every=VALIDATE_EVERY,
        amp="none",
        device=config.device,
    )
    history = run_training(_PointTask(model, training, validation), loop, run_dir, resume, progress)
    encoder.requires_grad_(False).eval()
    return next(row.figures for row in history.rows if row.step == history.best_step)
