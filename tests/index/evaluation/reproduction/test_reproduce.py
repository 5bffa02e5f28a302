import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from index.evaluation.reproduction import reproduce as module
from index.evaluation.reproduction.jobs import run_settings
from index.evaluation.reproduction.report import markdown, order_verdict, write_reproduction
from index.evaluation.reproduction.reproduce import choose_experiments, scale_in_epochs
from models.errors import DataError
from models.paper import point_encoder
from models.sources.source import open_source
from models.training.engine import run_dir
from models.training.experiments import (
    POINTS,
    Experiment,
    TableRow,
    TrainingRun,
    TrainingScale,
    apply_variant,
    fine_pairs,
    required_runs,
    reranked_pairs,
)
from models.training.paper_tables import EXPERIMENTS, GROWTH, HEAD, MNCL, TABLE_1, TABLE_2, TEXT2LOC
from models.training.settings import load_settings

REGRESSOR = TrainingRun("regressor")
ALL = tuple(EXPERIMENTS.values())
_FEW = ("training.steps=2", "training.validate_every=2", "training.batch_size=4", "training.spacing_m=30")
_RETRIEVER = (*_FEW, "training.validate_every=1", "model.width=32")
SCALE = TrainingScale(_RETRIEVER, (*_FEW, "model.width=32"), (60.0, 120.0), _FEW)
NOISES = ["noise20", "noise40"]
ROWS = tuple(TableRow("Text2Loc", TEXT2LOC, fine=fine, rerank=fine != REGRESSOR) for fine in (REGRESSOR, None))
ONE = (Experiment("one", "One method", (*ROWS, replace(ROWS[0], rerank=True))),)


def here(work, tasks, workers):
    """As `_all_done`, in this process."""
    for done, task in enumerate(tasks, start=1):
        work(*task)
        yield done


@pytest.fixture
def small(monkeypatch):
    monkeypatch.setattr(module, "_run_in_processes", here)
    monkeypatch.setattr(run_dir, "_curves", lambda *_: b"")  # test_loop.py has them drawn
    few = replace(point_encoder.ARCHITECTURES["small"], levels=((8, 0.2, 4, (32, 64)), (4, 0.4, 4, (64, 128))))
    monkeypatch.setitem(point_encoder.ARCHITECTURES, "small", few)
    threads = torch.get_num_threads()
    yield
    torch.set_num_threads(threads)


def stamps(out: Path) -> dict[str, int]:
    return {path.parts[-3]: path.stat().st_mtime_ns for path in out.glob("runs/*/*/result.json")}


def changed(before: dict[str, int], now: dict[str, int]) -> set[str]:
    return {name for name, stamp in now.items() if stamp != before[name]}


@pytest.mark.slow
def test_what_is_done_is_kept_and_what_differs_is_made_again(small, strip_file, tmp_path) -> None:
    def made(scale: TrainingScale) -> dict:
        return module.reproduce(strip_file, tmp_path, scale, [0], 1, lambda *_: None, ONE)

    reproduction = made(SCALE)
    points = "inputs=points+colour+position+count"
    names = {"text2loc", "regressor", f"text2loc-{points}", f"regressor-{points}", POINTS}
    assert reproduction["runs"].keys() == names
    result = reproduction["runs"]["text2loc"][0]
    assert 0 <= result["retrieval"]["1"] <= result["retrieval"]["5"] <= 1
    assert result["training"]["seconds"] >= result["training"]["seconds_to_best"] > 0
    assert len(result["growth"]) == 2
    one_scene = [row | {"scene": "strip"} for row in result["growth"]]
    assert result["growth_of_scene"] == one_scene, "a map has one scene"
    assert set(result["localization"]["regressor"]) == {"test", "val", "cell_center"}
    assert set(result["reranked"]) == {"", "regressor"}
    for by_split in result["reranked"].values():
        assert set(by_split) == {"test", "val"}
    reranked, centers = (result["reranked"][stage]["test"] for stage in ("regressor", ""))
    assert reranked["retrieval"] == centers["retrieval"] != result["retrieval"]
    assert reranked["localization"] != centers["localization"]
    first = stamps(tmp_path)
    assert made(SCALE) == reproduction
    assert stamps(tmp_path) == first
    longer = replace(SCALE, retriever=("training.steps=3", *SCALE.retriever[1:]))
    made(longer)
    second = stamps(tmp_path)
    assert changed(first, second) == {"text2loc", f"text2loc-{points}"}
    made(replace(longer, points=("training.steps=1", *_FEW[1:])))
    seeing = {POINTS, f"regressor-{points}", f"text2loc-{points}"}
    assert changed(second, stamps(tmp_path)) == seeing, "what sees points depends on the point encoder"


def test_further_seeds_make_the_tables_alone() -> None:
    every, first = required_runs(ALL, 2), required_runs(ALL)
    assert set(every) < set(first)
    few = [(row, variant) for e in ALL if e.seeds for row, variant in e.row_variants()]
    figures = {apply_variant(run, variant) for row, variant in few for run in (row.run, row.fine) if run}
    assert set(first) - set(every) == figures - set(every)
    assert HEAD in every


def test_variants_differ_in_their_inputs_alone() -> None:
    runs = required_runs((TABLE_2,), 1)
    points = "-inputs=points+colour+position+count"
    assert {run.name for run in runs} == {
        f"{method}{inputs}{text}"
        for method, text in (("mncl", ""), ("ret", ""), ("text2loc", ""), ("text2pos", ""), ("text2pos", "-text=whole"))
        for inputs in ("", points)
    } | {f"text2loc-cell_attention=cauchy{inputs}" for inputs in ("", points)}
    assert sum(run.needs_points for run in runs) == 6
    assert (MNCL, HEAD) in fine_pairs((TABLE_1,))
    assert all(coarse.needs_points == fine.needs_points for coarse, fine in fine_pairs((TABLE_1,)))


def test_every_order_of_the_papers_tables_is_asked() -> None:
    orders = {(e.key, worse.name, better.name) for e in ALL for worse, better in e.published_orders()}
    methods = ("Text2Pos", "RET", "Text2Loc", "MNCL")
    for key in "12":
        assert {o[1:] for o in orders if o[0] == key} == {
            (worse, better) for n, better in enumerate(methods) for worse in methods[:n]
        }
    assert len([o for o in orders if o[0] == "3"]) == 5, "instance and relation alone are equal in the paper"
    assert len([o for o in orders if o[0] == "4"]) == 1
    assert {o[2] for o in orders if o[0] in ("4a", "4b")} == {"3 layers", "a = 2"}


def test_epochs_are_as_many_steps_as_the_data_has_batches(osm_file) -> None:
    batches = len(open_source(osm_file, "train").queries()) // 4
    scale = scale_in_epochs(SCALE, osm_file, 10)
    _, training = load_settings("mncl", scale.retriever)
    assert (training.steps, training.validate_every) == (10 * batches, batches)
    assert (training.schedule, training.halve_every) == ("step", 5 * batches)
    assert scale.fine[-4:] == scale.retriever[-4:]


def test_a_run_may_set_its_own_training() -> None:
    """Changes of a run go before those of the scale."""
    run = TrainingRun("ret").with_changes((("training.steps", 1500), ("dropout", 0.2)))
    assert run.name == "ret-dropout=0.2-training.steps=1500"
    model, training = run_settings(run, 3, SCALE)
    assert (model.dropout, training.steps, training.seed, training.batch_size) == (0.2, 1500, 3, 4)


def test_tables_are_chosen_by_name() -> None:
    assert choose_experiments("2, 4b, 2") == (EXPERIMENTS["2"], EXPERIMENTS["4b"])
    assert choose_experiments(None) == tuple(experiment for experiment in ALL if not experiment.long)
    assert [key for key, experiment in EXPERIMENTS.items() if experiment.long] == ["ret", "loss", "head", *NOISES]
    with pytest.raises(DataError, match=r"--tables 9: .* 4a"):
        choose_experiments("9")


def made_up(run: TrainingRun, seed: int) -> dict[str, object]:
    """Results whose figures can be told apart."""
    at_1 = 0.5 + 0.1 * seed if run == MNCL else 0.2
    recall = {"1": at_1, "3": 0.7, "5": 0.8}
    facts = {
        "descriptions_per_second": 100.0, "seconds_to_best": 60.0, "seconds": 90.0, "best_step": 30, "steps": 40,
        "peak_memory_mb": 900.0,
    }  # fmt: skip
    grown = [
        {"radius_m": r, "cells": 10 * (n + 1), "queries": 5, "R@1": at_1 / (n + 1)} for n, r in enumerate((80, 200))
    ]
    within = {k: {"5": at_1, "10": 0.8, "15": 0.9} for k in ("1", "5", "10")}
    training_settings = {
        "steps": 40, "batch_size": 64, "learning_rate": 1e-3, "schedule": "one-cycle", "patience": None,
        "wording": "published", "cluster": 1, "width": 32, "text_encoder": "minilm",
    }  # fmt: skip
    result = {"training": facts, "settings": training_settings, "seed": seed}
    if run.method in ("matching", "regressor"):
        fine = {f"{who}within_{m}m": 0.5 for who in ("", "neighbour_") for m in (5, 10)}
        return result | {"validation": fine | {"cell_center": fine}}
    if run.method == POINTS:
        return result | {"validation": {"label": 0.8}}
    by_split = {"test": within, "val": within}
    center = {split: {k: {"5": 0.15, "10": 0.25, "15": 0.35} for k in within} for split in by_split}
    stages = {fine.name: by_split | {"cell_center": center} for _, fine in fine_pairs(ALL)}
    again = {
        "retrieval": recall | {"1": 0.61},
        "localization": within | {"1": {"5": 0.71, "10": 0.72, "15": 0.73}},
    }
    reranked = {fine.name if fine else "": {"test": again, "val": again} for _, fine in reranked_pairs(ALL)}
    measured = {"retrieval": recall, "validation_retrieval": recall, "parameters": 10, "bytes_a_cell": 512}
    return (
        result
        | measured
        | {
            "growth": grown,
            "growth_of_scene": [{"scene": "0009"} | row for row in grown],
            "localization": stages,
            "reranked": reranked,
            "rankings": {"global level alone": recall},
        }
    )


def found_of(*seeds: int) -> dict[str, Any]:
    runs = {run.name: [made_up(run, seeds[0])] for run in (*required_runs(ALL), TrainingRun(POINTS))}
    for n, seed in enumerate(seeds[1:], start=1):
        for run in (*required_runs(ALL, n), TrainingRun(POINTS)):
            runs[run.name].append(made_up(run, seed))
    data = {"cells": 100, "queries": 2000, "exact_matching": {"1": 0.4}}
    return {"seeds": list(seeds), "data": data, "experiments": list(EXPERIMENTS), "runs": runs}


def test_the_report_has_every_table_and_says_where_the_orders_hold(tmp_path) -> None:
    (tmp_path / "picture.png").write_bytes(b"\x89PNG of a job")
    write_reproduction(tmp_path, found_of(0, 1), "nowhere", tmp_path / "picture.png")
    text = (tmp_path / "report.md").read_text()
    assert text == markdown(json.loads((tmp_path / "results.json").read_text()), "nowhere")
    for experiment in EXPERIMENTS.values():
        assert f"## {experiment.title}" in text
    assert "| MNCL, our inputs | 0.550 ± 0.071 |" in text
    assert "| MNCL, centre of the retrieved cell, our inputs | 0.150 ± 0.000/0.250" in text
    assert "| MNCL, the paper's inputs, smaller and frozen | 0.200 ± 0.000 |" in text
    assert "| MNCL, re-ranked by PARC-Loc's matching, our inputs | 0.710 ± 0.000/0.720" in text
    assert "| MNCL, re-ranked by PARC-Loc's matching, our inputs | 0.610 ± 0.000 | 0.700" in text
    assert "| 3 layers | 0.500 |" in text, "figure 4 is of the first seed"
    assert "| Table 2 | MNCL above Text2Loc | our inputs | yes | 2 of 2 | 0.350 ± 0.071 |" in text
    assert (
        "| Table 2 | Text2Loc above RET | the paper's inputs, smaller and frozen | undecided | 0 of 2 | 0.000 ± 0.000 |"
        in text
    )
    assert "| Figure 4 | 3 layers above 5 layers | our inputs | yes | 1 of 1 | 0.300 |" in text
    assert "-50.0 %" in text
    assert "| R@1 of scene 0009, 5 queries, within |" in text
    assert "| R@1 of all test scenes, 5 queries, within |" in text
    hours = sum(len(results) for results in found_of(0, 1)["runs"].values()) * 90 / 3600
    assert f"{hours:.1f} hours of training" in text
    assert "| 40, best of validation | 64 | 32 | 0.001, one-cycle | minilm | published |" in text
    for name in ("figure3.png", "figure4.png", "figure5.png"):
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")
        assert f"({name})" in text


@pytest.mark.parametrize(
    ("below", "above", "verdict"),
    [
        ([0.50], [0.54], "yes"),  # the error of one measurement is about sqrt(2 * 0.25 / 2000) = .016
        ([0.50], [0.53], "undecided"),
        ([0.54], [0.50], "no"),
        ([0.50, 0.50, 0.50], [0.53, 0.53, 0.53], "undecided"),  # seeds share the queries
        ([0.50, 0.40, 0.60], [0.60, 0.50, 0.40], "undecided"),
        ([0.50, 0.50, 0.50], [0.56, 0.62, 0.59], "yes"),
        ([0.001], [0.014], "undecided"),  # chance is .01
        ([0.001], [0.03], "yes"),
    ],
)
def test_an_order_within_the_sampling_error_or_at_chance_is_undecided(below, above, verdict) -> None:
    assert order_verdict(np.array(below), np.array(above), {"queries": 2000, "cells": 100}) == verdict


def test_a_report_of_some_tables_has_no_others(tmp_path) -> None:
    reproduction = found_of(0) | {"experiments": ["2"]}
    runs = {apply_variant(row.run, variant).name for row, variant in TABLE_2.row_variants()}
    reproduction["runs"] = {name: results for name, results in reproduction["runs"].items() if name in runs}
    for n in (3, 4):
        (tmp_path / f"figure{n}.png").write_bytes(b"old")
    write_reproduction(tmp_path, reproduction, "nowhere")
    text = (tmp_path / "report.md").read_text()
    assert "Table 2" in text
    assert not any(f"## {title}" in text for title in ("Table 1", "Figure 4", "Figure 3", "Fine stages"))
    assert "Does the order hold?" in text
    assert not list(tmp_path.glob("figure[34].png")), "those of an earlier report"
    assert {name for name in GROWTH if f"| {name}, our inputs | " in text} == set(GROWTH)


def test_results_without_the_growth_of_one_scene_are_shown(tmp_path) -> None:
    """An earlier version made them."""
    older = found_of(0)
    for by_seed in older["runs"].values():
        by_seed[0].pop("growth_of_scene", None)
    write_reproduction(tmp_path, older, "nowhere")
    text = (tmp_path / "report.md").read_text()
    assert "scene 0009" not in text
    assert "| R@1 of all test scenes, 5 queries, within |" in text


def test_costs_are_those_of_a_typical_seed() -> None:
    """A run that was stopped for an hour does not spoil the table."""
    reproduction = found_of(0, 1, 2)
    for result, speed in zip(reproduction["runs"]["ret"], (2, 1, 0.01), strict=True):
        result["training"] |= {"descriptions_per_second": speed, "seconds_to_best": 100.0 / speed}
    assert "| ret | 1 | 30 of 40 | 100 of 90 s | 900 MB |" in markdown(reproduction | {"figure_3": False}, "nowhere")
