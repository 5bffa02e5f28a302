import json
from pathlib import Path

import pytest
import torch

from index.evaluation import reproduce as module
from index.evaluation.reproduce_report import markdown, write_reproduction
from models.training.experiments import EXPERIMENTS, FINE, MNCL, Run, Scale, runs_of

TEXT2LOC, REGRESSOR = Run("text2loc"), Run("regressor")
_FEW = ("training.steps=2", "training.validate_every=1", "training.batch_size=4", "training.spacing_m=30")
SCALE = Scale((*_FEW, "model.width=32"), (*_FEW, "model.width=32"), (60.0, 120.0))


def here(work, tasks, workers):
    """As `_all_done`, in this process."""
    for done, task in enumerate(tasks, start=1):
        work(*task)
        yield done


@pytest.fixture
def small(monkeypatch):
    monkeypatch.setattr(module, "_all_done", here)
    monkeypatch.setattr(module, "runs_of", lambda every_seed: (TEXT2LOC,) if every_seed else (TEXT2LOC, REGRESSOR))
    monkeypatch.setattr(module, "FINE", {})
    threads = torch.get_num_threads()
    yield
    torch.set_num_threads(threads)


def stamps(out: Path) -> dict[str, int]:
    return {str(path): path.stat().st_mtime_ns for path in out.glob("runs/*/*/result.json")}


@pytest.mark.slow
def test_what_is_done_is_kept_and_what_differs_is_made_again(small, osm_file, tmp_path) -> None:
    found = module.reproduce(osm_file, tmp_path, SCALE, [0, 1], 1, lambda *_: None)
    assert {name: len(results) for name, results in found["runs"].items()} == {"text2loc": 2, "regressor": 1}
    result = found["runs"]["text2loc"][0]
    assert 0 <= result["retrieval"]["1"] <= result["retrieval"]["5"] <= 1
    assert result["training"]["seconds_to_best"] > 0
    assert len(result["growth"]) == 2
    first = stamps(tmp_path)
    assert module.reproduce(osm_file, tmp_path, SCALE, [0, 1], 1, lambda *_: None) == found
    assert stamps(tmp_path) == first
    longer = Scale(("training.steps=3", *SCALE.retriever[1:]), SCALE.fine, SCALE.growth_radii_m)
    module.reproduce(osm_file, tmp_path, longer, [0], 1, lambda *_: None)
    changed = {path for path, stamp in stamps(tmp_path).items() if stamp != first[path]}
    assert changed == {str(tmp_path / "runs" / "text2loc" / "seed-0" / "result.json")}


def test_further_seeds_make_the_tables_alone() -> None:
    every, first = runs_of(every_seed=True), runs_of(every_seed=False)
    assert set(every) < set(first)
    figures = {row.run for experiment in EXPERIMENTS if not experiment.every_seed for row in experiment.rows}
    assert set(first) - set(every) == figures - set(every)
    assert set(FINE.values()) < set(every)


def made_up(run: Run, seed: int) -> dict[str, object]:
    """Results whose figures can be told apart."""
    at_1 = 0.5 + 0.1 * seed if run == MNCL else 0.2
    recall = {"1": at_1, "3": 0.7, "5": 0.8}
    facts = {"descriptions_per_second": 100.0, "seconds_to_best": 60.0, "peak_memory_mb": 900.0}
    grown = [
        {"radius_m": r, "cells": 10 * (n + 1), "queries": 5, "R@1": at_1 / (n + 1)} for n, r in enumerate((80, 200))
    ]
    within = {"5": at_1, "10": 0.8, "15": 0.9}
    fine = {f"{who}within_{m}m": 0.5 for who in ("", "neighbour_") for m in (5, 10)}
    return {
        "retrieval": recall, "training": facts, "growth": grown, "parameters": 10, "bytes_a_cell": 512,
        "localization": dict.fromkeys(("1", "5", "10"), within), "rankings": {"global level alone": recall},
        "validation": fine | {"cell_center": fine},
    }  # fmt: skip


def test_the_report_has_every_table_and_says_where_the_orders_hold(tmp_path) -> None:
    runs = {run.name: [made_up(run, 0)] for run in runs_of(every_seed=False)}
    for run in runs_of(every_seed=True):
        runs[run.name].append(made_up(run, 1))
    data = {"cells": 10, "queries": 5, "exact_matching": {"1": 0.4}}
    found = {"seeds": [0, 1], "data": data, "runs": runs}
    write_reproduction(tmp_path, found, "nowhere")
    text = (tmp_path / "report.md").read_text()
    assert text == markdown(json.loads((tmp_path / "results.json").read_text()), "nowhere")
    for experiment in EXPERIMENTS:
        assert f"## {experiment.title}" in text
    assert "| MNCL | 0.550 ± 0.071 |" in text
    assert "| 3 layers | 0.500 |" in text, "figure 4 is of the first seed"
    assert "| MNCL above Text2Loc | yes | 2 of 2 | 0.350 ± 0.071 |" in text
    assert "| Text2Loc above Text2Pos | no | 0 of 2 | 0.000 ± 0.000 |" in text
    assert "-50.0 %" in text
    for name in ("figure4.png", "figure5.png"):
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")


def test_costs_are_those_of_a_typical_seed():
    """A run that was stopped for an hour does not spoil the table."""
    costs = [
        {"descriptions_per_second": s, "seconds_to_best": 100.0 / s, "peak_memory_mb": 900.0} for s in (2, 1, 0.01)
    ]
    runs = {run.name: [made_up(run, 0)] for run in runs_of(every_seed=False)}
    runs["ret"] = [made_up(Run("ret"), seed) | {"training": cost} for seed, cost in enumerate(costs)]
    data = {"cells": 10, "queries": 5, "exact_matching": {"1": 0.4}}
    assert "| ret | 1 | 100 s | 900 MB |" in markdown({"seeds": [0, 1, 2], "data": data, "runs": runs}, "nowhere")
