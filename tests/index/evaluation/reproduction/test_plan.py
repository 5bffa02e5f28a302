import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from index.evaluation.reproduction import plan as module
from index.evaluation.reproduction.jobs import RESULT_FILE, ReproductionJob
from index.evaluation.reproduction.plan import MEASURED, measured_speeds, plan_runs
from models.training.experiments import POINTS, TrainingRun, TrainingScale
from models.training.paper_tables import MNCL, TABLE_2

FEW = ("training.steps=30", "training.batch_size=4")
SCALE = TrainingScale(FEW, FEW, (60.0,), ("training.steps=50", "training.batch_size=8"))


def runs_measured(**speeds: list[float]) -> dict:
    return {
        name: [{"training": {"descriptions_per_second": speed}} for speed in by_seed]
        for name, by_seed in speeds.items()
    }


def test_speeds_are_those_of_the_run_else_of_its_method_else_of_all() -> None:
    speed = measured_speeds(runs_measured(**{"mncl": [10, 30, 20], "mncl-width=8": [60], "ret": [5]}))
    assert speed(MNCL) == 20, "the median over seeds"
    assert speed(MNCL.with_changes((("training.steps", 9),))) == 20
    assert speed(MNCL.with_changes((("distance", "unit"),))) == 40
    assert speed(TrainingRun("other")) == 20


def test_a_plan_has_every_training_and_says_which_are_done(osm_file, tmp_path, monkeypatch) -> None:
    measured = tmp_path / "measured.json"
    measured.write_text(json.dumps({"runs": runs_measured(mncl=[10], points=[20])}))
    monkeypatch.setattr(module, "MEASURED", measured)
    planned = plan_runs(None, tmp_path, SCALE, [0, 1], (TABLE_2,))
    names = [(run.name, run.seed) for run in planned]
    assert len(set(names)) == len(names) == 1 + 2 * 2 * len({row.run for row in TABLE_2.rows})
    assert names[0] == (POINTS, 0)
    assert not any(run.is_done for run in planned)
    assert planned[0].steps == 50
    assert planned[0].hours == pytest.approx(50 * 8 / 20 / 3600)
    assert [run.hours for run in planned if run.name == "mncl"] == pytest.approx([30 * 4 / 10 / 3600] * 2)

    job = ReproductionJob.build(MNCL, 1, osm_file, tmp_path, SCALE)
    job.directory.mkdir(parents=True)
    (job.directory / RESULT_FILE).write_text(json.dumps({"key": job.key}))
    planned = plan_runs(osm_file, tmp_path, SCALE, [0, 1], (TABLE_2,))
    assert [(run.name, run.seed) for run in planned if run.is_done] == [("mncl", 1)]
    longer = replace(SCALE, retriever=("training.steps=31", *FEW[1:]))
    assert not any(run.is_done for run in plan_runs(osm_file, tmp_path, longer, [0, 1], (TABLE_2,)))


def test_without_points_no_point_encoder_is_planned() -> None:
    ours = replace(TABLE_2, variants=("our inputs",))
    assert POINTS not in {run.name for run in plan_runs(None, Path("nowhere"), SCALE, [0], (ours,))}


def test_the_committed_speeds_cover_every_method_of_the_tables() -> None:
    speed = measured_speeds(json.loads(MEASURED.read_text())["runs"])
    methods = ("mncl", "text2loc", "ret", "text2pos", "regressor", "matching", POINTS)
    assert all(np.isfinite(speed(TrainingRun(method))) and speed(TrainingRun(method)) > 10 for method in methods)
