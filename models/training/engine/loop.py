"""The training loop for any model: optimiser, schedule, mixed precision, validation, early stopping, resuming."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, Protocol

import numpy as np
import torch
from pydantic import BaseModel, ConfigDict, Field
from torch import Tensor, nn

from models.errors import TrainingError
from models.training.engine.run_dir import RunDir, RunState, ValidationRow

_AMP = {"bfloat16": torch.bfloat16, "float16": torch.float16}
_Schedule = torch.optim.lr_scheduler.OneCycleLR | torch.optim.lr_scheduler.StepLR


class LoopConfig(BaseModel):
    """Settings of the optimisation."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    seed: int = 0
    steps: int = Field(default=1500, ge=1)
    batch_size: int = Field(default=128, ge=2)
    learning_rate: float = Field(default=1e-3, gt=0)  # peak of "one-cycle", initial value of "step"
    # "one-cycle" rises for a tenth of the steps and then falls to almost 0; "step" halves the rate every `halve_every`
    # steps (the paper: every 5 epochs).
    schedule: Literal["one-cycle", "step"] = "one-cycle"
    halve_every: int = Field(default=500, ge=1)
    weight_decay: float = Field(default=0.01, ge=0)
    clip_norm: float = Field(default=1.0, gt=0)
    # In steps; the weights with the best criterion are kept.
    validate_every: int = Field(default=250, ge=1)
    # Validations without a better criterion before an early stop.
    patience: int | None = Field(default=None, ge=1)
    # Precision of the forward pass on a GPU; a CPU always uses float32.
    amp: Literal["none", "bfloat16", "float16"] = "bfloat16"
    device: Literal["auto", "cpu", "cuda"] = "auto"


class Task(Protocol):
    """A model with its training and validation data."""

    @property
    def model(self) -> nn.Module:
        """The model to train in place; the loop moves it to the device."""

    @property
    def criterion(self) -> str:
        """The key of `validate()` that selects the best weights, such as "recall@5"; larger is better."""

    def batch(self, rng: np.random.Generator) -> Any:
        """Draw `LoopConfig.batch_size` examples, on the CPU."""

    def loss(self, batch: Any) -> Tensor:
        """Return the loss, a scalar on the device of the model."""

    def validate(self) -> dict[str, float]:
        """Return validation metrics; the model is in evaluation mode."""


@dataclass(frozen=True, slots=True)
class Progress:
    """The state of a training, for a progress bar."""

    step: int
    steps: int
    loss: float
    figures: dict[str, float] | None  # metrics of the validation after this step, if there was one
    descriptions_per_second: float  # examples trained on since the last validation


@dataclass(slots=True)
class History:
    """The result of a training."""

    rows: list[ValidationRow] = field(default_factory=list)  # one per validation
    best_step: int = 0  # step with the best criterion, whose weights are kept
    best: float = -math.inf
    stopped_early: bool = False  # whether `patience` ended the training

    @property
    def facts(self) -> dict[str, Any]:
        """The history for the config.json of the weights."""
        rows = [{"step": row.step, "loss": row.loss} | row.figures for row in self.rows]
        return {"history": rows, "best_step": self.best_step}


def run_training(
    task: Task,
    config: LoopConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
    rng: np.random.Generator | None = None,
    record: dict[str, Any] | None = None,
) -> History:
    """Train a model; it stays on its device, in evaluation mode, with the weights of the best validation.

    Seed torch before building the model; the loop continues with the state of torch's generator.

    Args:
        task: the model and its data.
        config: settings of the optimisation.
        run_dir: directory for the files of `RunDir`; None writes nothing.
        resume: continue the run in `run_dir` if there is one; the result equals that of an uninterrupted run.
        progress: called at every step.
        rng: draws the batches; None for one seeded by `config.seed`.
        record: content of config.json; None for `config`.

    Raises:
        TrainingError: the loss is not finite, the device does not exist, or the run directory has another run.
    """
    files = RunDir.open(run_dir, resume, record or config.model_dump(mode="json")) if run_dir else None
    run = _Run(task, config, rng or np.random.default_rng(config.seed))
    state = files.load_state() if files and resume else None
    if state:
        run.restore(state)
    while not run.finished:
        loss = run.advance()
        figures = run.validate() if run.validation_due else None
        if files and figures is not None:
            files.write(run.history.rows, task.criterion, run.best_weights, run.state())
        if progress:
            progress(Progress(run.step, config.steps, loss, figures, run.descriptions_per_second))
    task.model.load_state_dict(run.best_weights)
    task.model.eval()
    return run.history


def pick_device(device: Literal["auto", "cpu", "cuda"]) -> torch.device:
    """Return the device to train on.

    Raises:
        TrainingError: `device` is "cuda" and there is no GPU.
    """
    if device == "cuda" and not torch.cuda.is_available():
        raise TrainingError("torch finds no GPU; use device 'auto' or 'cpu'")
    if device == "cpu" or not torch.cuda.is_available():
        return torch.device("cpu")
    return torch.device("cuda", torch.cuda.current_device())


class _Run:
    """A run in progress, which `state` stores and `restore` continues."""

    def __init__(self, task: Task, config: LoopConfig, rng: np.random.Generator) -> None:
        self.task, self.config, self.rng = task, config, rng
        self.device = pick_device(config.device)
        task.model.to(self.device)
        self.optimizer = torch.optim.AdamW(
            task.model.parameters(), config.learning_rate, weight_decay=config.weight_decay
        )
        self.schedule = _schedule(self.optimizer, config)
        self.amp = _AMP.get(config.amp) if self.device.type == "cuda" else None
        self.scaler = torch.amp.GradScaler(self.device.type, enabled=self.amp is torch.float16)
        self.step, self.stale, self.losses = 0, 0, list[float]()
        self.history, self.best_weights = History(), _copy(task.model)
        self.seconds, self._training_seconds, self._clock = 0.0, 0.0, time.perf_counter()
        self.descriptions_per_second = 0.0
        self.last_learning_rate = config.learning_rate
        task.model.train()

    @property
    def finished(self) -> bool:
        return self.step >= self.config.steps or self.history.stopped_early

    @property
    def validation_due(self) -> bool:
        return self.step % self.config.validate_every == 0 or self.step == self.config.steps

    def advance(self) -> float:
        """Do one step, and return its loss."""
        model = self.task.model
        batch = self.task.batch(self.rng)
        with torch.autocast(self.device.type, dtype=self.amp, enabled=self.amp is not None):
            loss = self.task.loss(batch)
        self.optimizer.zero_grad()
        self.scaler.scale(loss).backward()
        self.scaler.unscale_(self.optimizer)
        nn.utils.clip_grad_norm_(model.parameters(), self.config.clip_norm)
        scale = self.scaler.get_scale()
        self.scaler.step(self.optimizer)
        self.scaler.update()
        self.last_learning_rate = float(self.schedule.get_last_lr()[0])
        if self.scaler.get_scale() >= scale:  # otherwise float16 overflowed and the scaler skipped the step
            self.schedule.step()
        self.step += 1
        value = loss.item()
        if not math.isfinite(value):
            raise TrainingError(f"the loss of step {self.step} is {value}; lower training.learning_rate")
        self.losses.append(value)
        self._training_seconds += self._lap()
        self.descriptions_per_second = len(self.losses) * self.config.batch_size / self._training_seconds
        return value

    def validate(self) -> dict[str, float]:
        """Validate, keep the weights if they are the best so far, and add a row to the history."""
        model, history = self.task.model, self.history
        model.eval()
        figures = self.task.validate()
        model.train()
        if figures[self.task.criterion] > history.best:
            history.best, history.best_step, self.stale = figures[self.task.criterion], self.step, 0
            self.best_weights = _copy(model)
        else:
            self.stale += 1
        history.stopped_early = self.stale == self.config.patience and self.step < self.config.steps
        self._lap()
        loss = float(np.mean(self.losses))
        rate, speed = self.last_learning_rate, self.descriptions_per_second
        history.rows.append(ValidationRow(self.step, self.seconds, loss, rate, speed, figures))
        self.losses, self._training_seconds = [], 0.0
        return figures

    def state(self) -> RunState:
        """Return everything that `restore` needs."""
        return RunState.capture(
            self.task.model,
            self.best_weights,
            self.optimizer,
            [self.schedule, self.scaler],
            self.rng.bit_generator.state,
            _torch_generators(self.device),
            self.history.rows,
            {"step": self.step, "stale": self.stale, "seconds": self.seconds}
            | {name: getattr(self.history, name) for name in ("best_step", "best", "stopped_early")},
        )

    def restore(self, state: RunState) -> None:
        """Continue from a state."""
        state.load_into(self.task.model, self.optimizer, [self.schedule, self.scaler])
        self.best_weights = state.best_weights(self.device)
        self.rng.bit_generator.state, generators = state.generators()
        torch.set_rng_state(generators[0])
        if self.device.type == "cuda":
            torch.cuda.set_rng_state(generators[-1], self.device)
        facts = state.counters
        self.step, self.stale, self.seconds = facts["step"], facts["stale"], facts["seconds"]
        self.history = History(state.rows, facts["best_step"], facts["best"], facts["stopped_early"])

    def _lap(self) -> float:
        now = time.perf_counter()
        lap, self._clock = now - self._clock, now
        self.seconds += lap
        return lap


def _schedule(optimizer: torch.optim.Optimizer, config: LoopConfig) -> _Schedule:
    if config.schedule == "step":
        return torch.optim.lr_scheduler.StepLR(optimizer, config.halve_every, gamma=0.5)
    rise = 0.11 if config.steps == 10 else 0.1  # torch divides by rise * steps - 1
    return torch.optim.lr_scheduler.OneCycleLR(
        optimizer, config.learning_rate, total_steps=config.steps, pct_start=rise
    )


def _copy(model: nn.Module) -> dict[str, Tensor]:
    return {name: tensor.detach().clone() for name, tensor in model.state_dict().items()}


def _torch_generators(device: torch.device) -> list[Tensor]:
    """Return the states [n] uint8 of torch's generators: the CPU's, and the GPU's if one is used."""
    gpu = [torch.cuda.get_rng_state(device)] if device.type == "cuda" else []
    return [torch.get_rng_state(), *gpu]
