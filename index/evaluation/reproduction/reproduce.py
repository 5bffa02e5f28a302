"""Reproduction of the paper's tables and figures: train and measure what is missing, keep what is done."""

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import replace
from pathlib import Path
from typing import Any

import torch

from index.evaluation.ambiguity import ambiguity
from index.evaluation.reproduction.jobs import (
    FIGURE_3,
    TEST,
    ReproductionJob,
    draw_figure_3_of,
    localization_file,
    localize,
    measure_reranked,
    read_localization,
    read_reranked,
    train_and_measure,
)
from models.citymap.types import Progress
from models.errors import DataError
from models.sources.source import open_source
from models.training.experiments import Experiment, TrainingScale, fine_pairs, required_runs, reranked_pairs
from models.training.paper_tables import EXPERIMENTS, HEAD, MNCL, TEXT2LOC
from models.training.settings import load_settings

EPOCHS_PER_HALVING = 5  # after which the papers halve the learning rate
FIGURE_3_RUNS = {"Text2Loc": TEXT2LOC, "MNCL": MNCL}  # retrievers, which share HEAD


def scale_in_epochs(scale: TrainingScale, data: Path, epochs: int) -> TrainingScale:
    """Return a scale of some epochs that validates after each and halves its rate as the papers do."""
    positions = len(open_source(data, "train").queries())
    parts = {}
    for part, method in (("retriever", "mncl"), ("fine", "regressor")):
        settings = getattr(scale, part)
        _, training = load_settings(method, settings)
        an_epoch = max(1, positions // training.batch_size)
        lasts = {"schedule": "step", "halve_every": EPOCHS_PER_HALVING * an_epoch}
        lasts |= {"steps": epochs * an_epoch, "validate_every": an_epoch}
        parts[part] = (*settings, *(f"training.{name}={value}" for name, value in lasts.items()))
    return replace(scale, **parts)


def choose_experiments(keys: str | None) -> tuple[Experiment, ...]:
    """Return experiments by their keys, such as "1,2,4a", or all but the long ones; DataError if a key is unknown."""
    short = [key for key, experiment in EXPERIMENTS.items() if not experiment.long]
    wanted = short if keys is None else [key.strip() for key in keys.split(",")]
    if unknown := [key for key in wanted if key not in EXPERIMENTS]:
        raise DataError(f"--tables {unknown[0]}: unknown; choose from {', '.join(EXPERIMENTS)}")
    return tuple(EXPERIMENTS[key] for key in dict.fromkeys(wanted))


def reproduce(
    data: Path,
    out: Path,
    scale: TrainingScale,
    seeds: Sequence[int],
    workers: int,
    progress: Progress,
    experiments: tuple[Experiment, ...],
) -> dict[str, Any]:
    """Train and measure what is missing, and collect the results.

    Runs of an earlier call that match are kept. Figures use the first seed only, tables use all. Parallel trainings use
    the GPUs in turn. "runs" has the results of each run's name, one per seed.
    """
    jobs = [
        ReproductionJob.build(run, seed, data, out, scale)
        for n, seed in enumerate(seeds)
        for run in required_runs(experiments, n)
    ]
    backbones = list(dict.fromkeys(job.points for job in jobs if job.points))
    _train("train and measure", [*backbones, *(job for job in jobs if not job.points)], workers, progress)
    _train("with points", [job for job in jobs if job.points], workers, progress)
    results_by_run: dict[str, list[dict[str, Any]]] = {}
    for job in [*jobs, *backbones]:
        result = job.result()
        assert result is not None
        results_by_run.setdefault(job.run.name, []).append(result)
    pairs = [
        (ReproductionJob.build(run, seed, data, out, scale), ReproductionJob.build(fine, seed, data, out, scale))
        for n, seed in enumerate(seeds)
        for run, fine in fine_pairs(experiments, n)
    ]
    _localize(pairs, workers, progress)
    _draw_figure_3([pair for pair in pairs if pair[0].seed == seeds[0] and pair[1].run == HEAD])
    for job, fine_job in pairs:
        by_fine = results_by_run[job.run.name][list(seeds).index(job.seed)].setdefault("localization", {})
        by_fine[fine_job.run.name] = read_localization(job, fine_job)
    reranked = [
        (
            ReproductionJob.build(run, seed, data, out, scale),
            ReproductionJob.build(fine, seed, data, out, scale) if fine else None,
        )
        for n, seed in enumerate(seeds)
        for run, fine in reranked_pairs(experiments, n)
    ]
    _measure_reranked(reranked, workers, progress)
    for job, stage in reranked:
        by_stage = results_by_run[job.run.name][list(seeds).index(job.seed)].setdefault("reranked", {})
        by_stage[stage.run.name if stage else ""] = read_reranked(job, stage)
    keys = [experiment.key for experiment in experiments]
    return {"seeds": list(seeds), "data": _test_scene_facts(data), "experiments": keys, "runs": results_by_run}


def _train(stage: str, jobs: Sequence[ReproductionJob], workers: int, progress: Progress) -> None:
    missing = [job for job in jobs if job.result() is None]
    for done in _run_in_processes(train_and_measure, _on_gpus([(job,) for job in missing]), workers):
        progress(stage, len(jobs) - len(missing) + done, len(jobs))


def _localize(pairs: Sequence[tuple[ReproductionJob, ReproductionJob]], workers: int, progress: Progress) -> None:
    missing = [pair for pair in pairs if read_localization(*pair) is None]
    for done in _run_in_processes(localize, _on_gpus(missing), workers):
        progress("localize", done, len(missing))


def _measure_reranked(
    pairs: Sequence[tuple[ReproductionJob, ReproductionJob | None]], workers: int, progress: Progress
) -> None:
    missing = [pair for pair in pairs if read_reranked(*pair) is None]
    for done in _run_in_processes(measure_reranked, _on_gpus(missing), workers):
        progress("re-rank", done, len(missing))


def _draw_figure_3(pairs: Sequence[tuple[ReproductionJob, ReproductionJob]]) -> None:
    """Draw figure 3 if its retrievers are among the pairs with HEAD, and one was measured since it was drawn."""
    pair_by_run = {job.run: (job, fine_job) for job, fine_job in pairs}
    if not pair_by_run.keys() >= set(FIGURE_3_RUNS.values()):
        return
    drawn = {name: pair_by_run[run] for name, run in FIGURE_3_RUNS.items()}
    mncl_job, head_job = pair_by_run[MNCL]
    path, measured = mncl_job.directory / FIGURE_3, [localization_file(*pair) for pair in drawn.values()]
    if not path.is_file() or path.stat().st_mtime < max(file.stat().st_mtime for file in measured):
        jobs = {name: job for name, (job, _) in drawn.items()}
        list(_run_in_processes(draw_figure_3_of, [(jobs, head_job, path)], 1))


def figure_3_path(
    data: Path, out: Path, scale: TrainingScale, seed: int, experiments: tuple[Experiment, ...]
) -> Path | None:
    """Return the picture that `reproduce` drew of retrieved cells; None if these experiments have none."""
    path = ReproductionJob.build(MNCL, seed, data, out, scale).directory / FIGURE_3
    return path if {(run, HEAD) for run in FIGURE_3_RUNS.values()} <= set(fine_pairs(experiments)) else None


def _on_gpus(tasks: Sequence[tuple[Any, ...]]) -> list[tuple[Any, ...]]:
    """Return the tasks with the number of a GPU each, in turn; None without one."""
    gpus = torch.cuda.device_count() if torch.cuda.is_available() else 0
    return [(*task, n % gpus if gpus else None) for n, task in enumerate(tasks)]


def _run_in_processes(work: Callable[..., None], tasks: Sequence[tuple[Any, ...]], workers: int) -> Iterator[int]:
    """Run tasks in one process each, which frees its memory, and yield the number done."""
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=spawn, max_tasks_per_child=1) as pool:
        futures = [pool.submit(work, *task) for task in tasks]
        try:
            for done, future in enumerate(as_completed(futures), start=1):
                future.result()
                yield done
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)  # report a failure without waiting for the others
            raise


def _test_scene_facts(data: Path) -> dict[str, Any]:
    source = open_source(data, TEST)
    queries = source.queries()
    assert queries.hints is not None
    exact = ambiguity(source.data, queries, queries.hints)
    return {"cells": len(source.data.cells), "queries": len(queries), "exact_matching": exact["exact_matching"]}
