import csv
import json
import math

import numpy as np
import pytest
import torch
from torch import nn

from models.errors import TrainingError
from models.training.engine.loop import LoopConfig, pick_device, run_training
from models.training.engine.run_dir import RunDir

SMALL = LoopConfig(steps=12, batch_size=8, validate_every=4, learning_rate=1e-2)


class Line:
    """Learns y = 2 x; draws from NumPy for its batches and from torch for its dropout."""

    criterion = "recall@5"

    def __init__(self, figures=None) -> None:
        torch.manual_seed(3)
        self.model = nn.Sequential(nn.Linear(1, 16), nn.Dropout(0.3), nn.BatchNorm1d(16), nn.Linear(16, 1))
        self.figures, self.weights, self.stop_at = figures, [], None

    def batch(self, rng):
        x = rng.normal(size=(8, 1)).astype(np.float32)
        return torch.from_numpy(x)

    def loss(self, batch):
        assert self.model.training
        return ((self.model(batch) - 2 * batch) ** 2).mean()

    def validate(self):
        assert not self.model.training
        self.weights.append({name: tensor.clone() for name, tensor in self.model.state_dict().items()})
        x = torch.linspace(-1, 1, 9)[:, None]
        with torch.no_grad():
            fit = -float(((self.model(x) - 2 * x) ** 2).mean())
        return {"recall@5": self.figures[len(self.weights) - 1] if self.figures else fit, "other": 1.0}


def weights(task):
    return {name: tensor.tolist() for name, tensor in task.model.state_dict().items()}


def test_the_best_weights_are_kept_and_the_model_is_left_evaluating() -> None:
    task = Line(figures=[0.1, 0.7, 0.3])
    history = run_training(task, SMALL)
    assert (history.best, history.best_step, history.stopped_early) == (0.7, 8, False)
    assert all(torch.equal(task.weights[1][name], tensor) for name, tensor in task.model.state_dict().items())
    assert not task.model.training


def test_a_naive_loop_ends_with_the_same_weights() -> None:
    task, rng = Line(), np.random.default_rng(SMALL.seed)
    optimizer = torch.optim.AdamW(task.model.parameters(), 1e-2)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, 1e-2, total_steps=12, pct_start=0.1)
    task.model.train()
    for _ in range(12):
        optimizer.zero_grad()
        task.loss(task.batch(rng)).backward()
        nn.utils.clip_grad_norm_(task.model.parameters(), 1.0)
        optimizer.step()
        schedule.step()
    looped = Line(figures=[0.1, 0.2, 0.3])
    run_training(looped, SMALL)
    assert weights(looped) == weights(task)


@pytest.mark.parametrize("schedule", ["one-cycle", "step"])
def test_a_killed_run_resumed_ends_where_an_unbroken_one_ends(tmp_path, schedule) -> None:
    config = SMALL.model_copy(update={"schedule": schedule, "halve_every": 5})
    whole = Line()
    unbroken = run_training(whole, config, tmp_path / "whole")

    def kill(report) -> None:
        if report.step == 7:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_training(Line(), config, tmp_path / "killed", progress=kill)
    torch.manual_seed(99)  # a new process has another generator
    again, steps = Line(), []
    history = run_training(
        again, config, tmp_path / "killed", resume=True, progress=lambda report: steps.append(report.step)
    )
    assert steps == list(range(5, 13)), "it goes on from the validation at step 4"
    assert weights(again) == weights(whole)
    assert [(r.step, r.loss, r.figures) for r in history.rows] == [(r.step, r.loss, r.figures) for r in unbroken.rows]
    assert (history.best, history.best_step) == (unbroken.best, unbroken.best_step)

    done = Line()
    assert run_training(done, config, tmp_path / "killed", resume=True).best == unbroken.best
    assert weights(done) == weights(whole), "a finished run has nothing left to do"


def test_patience_ends_training() -> None:
    history = run_training(Line(figures=[0.5, 0.4, 0.3, 0.9]), SMALL.model_copy(update={"steps": 16, "patience": 2}))
    assert history.stopped_early
    assert [row.step for row in history.rows] == [4, 8, 12]
    assert history.best_step == 4


def test_the_step_schedule_halves() -> None:
    config = LoopConfig(steps=7, batch_size=8, schedule="step", halve_every=3, learning_rate=0.08, validate_every=1)
    rates = [row.learning_rate for row in run_training(Line(), config).rows]
    assert rates == pytest.approx([0.08] * 3 + [0.04] * 3 + [0.02])


@pytest.mark.parametrize("steps", [1, 2, 9, 10, 11, 20])
def test_any_number_of_steps(steps) -> None:
    assert run_training(Line(), LoopConfig(steps=steps, batch_size=8)).rows[-1].step == steps


def test_the_run_directory_tells_the_run(tmp_path) -> None:
    task = Line(figures=[0.1, 0.7, 0.3])
    history = run_training(task, SMALL, tmp_path, record={"what": "line"})
    assert json.loads((tmp_path / "config.json").read_text()) == {"what": "line"}
    rows = list(csv.DictReader((tmp_path / "metrics.csv").read_text().splitlines()))
    assert [float(row["recall@5"]) for row in rows] == [0.1, 0.7, 0.3]
    assert list(rows[0])[:5] == ["step", "seconds", "loss", "learning_rate", "descriptions_per_second"]
    assert float(rows[1]["loss"]) == history.rows[1].loss
    assert all(float(row["descriptions_per_second"]) > 0 for row in rows)
    assert (tmp_path / "curves.png").read_bytes().startswith(b"\x89PNG")
    from safetensors.torch import load_file

    best = load_file(tmp_path / "best.safetensors")
    assert all(torch.equal(best[name], tensor) for name, tensor in task.model.state_dict().items())
    expected = {"config.json", "metrics.csv", "curves.png", "best.safetensors", "state.safetensors"}
    assert {path.name for path in tmp_path.iterdir()} == expected


def test_a_run_directory_of_another_run_is_refused(tmp_path) -> None:
    run_training(Line(), SMALL, tmp_path)
    with pytest.raises(TrainingError, match="--resume"):
        run_training(Line(), SMALL, tmp_path)
    with pytest.raises(TrainingError, match=r"\(steps\)"):
        run_training(Line(), SMALL.model_copy(update={"steps": 20}), tmp_path, resume=True)
    (tmp_path / "state.safetensors").write_bytes(b"cut short")
    with pytest.raises(TrainingError, match="cannot be read"):
        run_training(Line(), SMALL, tmp_path, resume=True)


def test_a_file_that_cannot_be_written_leaves_the_old_one(tmp_path, monkeypatch) -> None:
    run_training(Line(), SMALL, tmp_path)
    before = (tmp_path / "config.json").read_bytes()

    def full_disk(*_):
        raise OSError("no space left")

    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(OSError, match="no space"):
        RunDir.open(tmp_path, True, SMALL.model_dump(mode="json"))
    assert (tmp_path / "config.json").read_bytes() == before
    assert not list(tmp_path.glob(".*"))


def test_a_loss_that_is_no_number_is_an_error() -> None:
    class Broken(Line):
        def loss(self, batch):
            return super().loss(batch) * math.nan

    task = Broken()
    with pytest.raises(TrainingError, match="learning_rate"):
        run_training(task, SMALL)


@pytest.mark.skipif(torch.cuda.is_available(), reason="there is a GPU here")
def test_without_a_gpu() -> None:
    assert pick_device("auto").type == "cpu"
    with pytest.raises(TrainingError, match="no GPU"):
        pick_device("cuda")


@pytest.mark.skipif(not torch.cuda.is_available(), reason="there is no GPU here")
@pytest.mark.parametrize("amp", ["none", "bfloat16", "float16"])
def test_on_a_gpu_training_learns_and_resumes(tmp_path, amp) -> None:
    config = LoopConfig(steps=200, batch_size=8, validate_every=50, learning_rate=1e-2, amp=amp)
    task = Line()
    history = run_training(task, config, tmp_path)
    assert next(task.model.parameters()).is_cuda
    assert history.best > -0.5
    assert run_training(Line(), config, tmp_path, resume=True).best == history.best
