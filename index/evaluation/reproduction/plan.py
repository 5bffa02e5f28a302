"""The plan of `reproduce`: which trainings are done, and about how long the others take."""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from index.evaluation.reproduction.jobs import POINTS_SEED, ReproductionJob, run_settings
from models.training.experiments import POINTS, Experiment, TrainingRun, TrainingScale, required_runs

# Where the speeds were measured: one core for each training, MiniLM and a width of 128.
MEASURED = Path(__file__).parents[3] / "models" / "reports" / "demo" / "results.json"


@dataclass(frozen=True, slots=True)
class PlannedRun:
    """A training of `reproduce`."""

    name: str
    seed: int
    steps: int
    is_done: bool
    hours: float  # of one core for the whole training, estimated


def plan_runs(
    data: Path | None, out: Path, scale: TrainingScale, seeds: Sequence[int], experiments: tuple[Experiment, ...]
) -> list[PlannedRun]:
    """Return the trainings that `reproduce` needs, done or not; `data` is None if it does not exist yet."""
    runs = [(run, seed) for n, seed in enumerate(seeds) for run in required_runs(experiments, n)]
    backbones = [(TrainingRun(POINTS), POINTS_SEED)] if any(run.needs_points for run, _ in runs) else []
    speed = measured_speeds(json.loads(MEASURED.read_text())["runs"])
    return [_plan(run, seed, data, out, scale, speed(run)) for run, seed in [*backbones, *runs]]


def _plan(run: TrainingRun, seed: int, data: Path | None, out: Path, scale: TrainingScale, speed: float) -> PlannedRun:
    training = run_settings(run, seed, scale)[1]
    is_done = data is not None and ReproductionJob.build(run, seed, data, out, scale).result() is not None
    return PlannedRun(run.name, seed, training.steps, is_done, training.steps * training.batch_size / speed / 3600)


def measured_speeds(results_by_run: dict[str, list[dict[str, Any]]]) -> Callable[[TrainingRun], float]:
    """Return a function from a run to its descriptions per second, the median over its seeds.

    Settings of the training do not count. A model that was not measured has the median of its method, and a method that
    was not measured that of all runs.
    """
    speeds = {
        name: float(np.median([result["training"]["descriptions_per_second"] for result in by_seed]))
        for name, by_seed in results_by_run.items()
    }

    def speed(run: TrainingRun) -> float:
        model = TrainingRun(
            run.method, tuple(change for change in run.changes if not change[0].startswith("training."))
        )
        if model.name in speeds:
            return speeds[model.name]
        of_method = [value for name, value in speeds.items() if name.split("-")[0] == run.method]
        return float(np.median(of_method or list(speeds.values())))

    return speed
