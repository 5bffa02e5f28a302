"""The paper's tables and figures on a data set: what is missing is trained and measured, what is done is kept."""

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import replace
from pathlib import Path
from typing import Any

import torch

from index.evaluation.ambiguity import ambiguity
from index.evaluation.reproduction.jobs import FIGURE_3, TEST, Job, localize, localized, train_and_measure
from models.citymap.types import Progress
from models.errors import DataError
from models.sources.source import open_source
from models.training.experiments import Experiment, TrainingScale, fine_pairs, required_runs
from models.training.paper_tables import EXPERIMENTS, HEAD, MNCL
from models.training.settings import load_settings

EPOCHS_A_HALVING = 5  # of the papers' learning rate


def in_epochs(scale: TrainingScale, data: Path, epochs: int) -> TrainingScale:
    """A scale that lasts for some epochs of a data set, validates after each, and halves its rate as the papers do.

    Raises:
        DataError: the data cannot be read.
    """
    positions = len(open_source(data, "train").queries())
    parts = {}
    for part, method in (("retriever", "mncl"), ("fine", "regressor")):
        given = getattr(scale, part)
        _, training = load_settings(method, given)
        an_epoch = max(1, positions // training.batch_size)
        lasts = {"schedule": "step", "halve_every": EPOCHS_A_HALVING * an_epoch}
        lasts |= {"steps": epochs * an_epoch, "validate_every": an_epoch}
        parts[part] = (*given, *(f"training.{name}={value}" for name, value in lasts.items()))
    return replace(scale, **parts)


def chosen(keys: str | None) -> tuple[Experiment, ...]:
    """Experiments by their keys, as "1,2,4a"; all of them if None.

    Raises:
        DataError: there is no such table or figure.
    """
    wanted = list(EXPERIMENTS) if keys is None else [key.strip() for key in keys.split(",")]
    if unknown := [key for key in wanted if key not in EXPERIMENTS]:
        raise DataError(f"--tables {unknown[0]}: there is none; name some of {', '.join(EXPERIMENTS)}")
    return tuple(EXPERIMENTS[key] for key in dict.fromkeys(wanted))


def reproduce(
    data: Path,
    out: Path,
    scale: TrainingScale,
    seeds: Sequence[int],
    workers: int,
    progress: Progress,
    experiments: tuple[Experiment, ...] = tuple(EXPERIMENTS.values()),
) -> dict[str, Any]:
    """Train what is missing, measure it, and gather the figures.

    Args:
        data: a directory in KITTI360Pose's layout or a converted store, with train, val and test scenes.
        out: where runs go, one directory each; those of an earlier call that fit are kept.
        scale: how much is trained.
        seeds: of the trainings; the figures' are done with the first alone, the tables' with each.
        workers: trainings at once; of several GPUs each takes its turn.
        progress: called as the work goes on.
        experiments: which tables and figures.

    Returns:
        "seeds", "data", "experiments", and "runs": for each run's name its results, one a seed.

    Raises:
        DataError: the data cannot be read.
    """
    jobs = [
        Job.of(run, seed, data, out, scale)
        for seed in seeds
        for run in required_runs(experiments, every_seed=seed != seeds[0])
    ]
    backbones = list(dict.fromkeys(job.points for job in jobs if job.points))
    _train("train and measure", [*backbones, *(job for job in jobs if not job.points)], workers, progress)
    _train("with points", [job for job in jobs if job.points], workers, progress)
    found: dict[str, list[dict[str, Any]]] = {}
    for job in [*jobs, *backbones]:
        result = job.result()
        assert result is not None
        found.setdefault(job.run.name, []).append(result)
    pairs = [
        (Job.of(run, seed, data, out, scale), Job.of(fine, seed, data, out, scale))
        for run, fine in fine_pairs(experiments)
        for seed in seeds
    ]
    _localize(pairs, seeds[0], workers, progress)
    for job, fine_job in pairs:
        by_fine = found[job.run.name][list(seeds).index(job.seed)].setdefault("localization", {})
        by_fine[fine_job.run.name] = localized(job, fine_job)
    keys = [experiment.key for experiment in experiments]
    return {"seeds": list(seeds), "data": _facts(data), "experiments": keys, "runs": found}


def _train(stage: str, jobs: Sequence[Job], workers: int, progress: Progress) -> None:
    """Do the jobs that are not done."""
    missing = [job for job in jobs if job.result() is None]
    for done in _all_done(train_and_measure, [(job, _gpu(n)) for n, job in enumerate(missing)], workers):
        progress(stage, len(jobs) - len(missing) + done, len(jobs))


def _localize(pairs: Sequence[tuple[Job, Job]], first_seed: int, workers: int, progress: Progress) -> None:
    """Measure localization where it is not measured; figure 3 is of the first seed."""
    drawn = (first_seed, MNCL, HEAD)
    missing = [(*pair, (pair[0].seed, pair[0].run, pair[1].run) == drawn) for pair in pairs if localized(*pair) is None]
    for done in _all_done(localize, missing, workers):
        progress("localize", done, len(missing))


def figure_3_of(
    data: Path,
    out: Path,
    scale: TrainingScale,
    seed: int,
    experiments: tuple[Experiment, ...] = tuple(EXPERIMENTS.values()),
) -> Path | None:
    """The picture of MNCL's retrieved cells; None if it is not of these experiments, or not made with this scale."""
    job, fine_job = (Job.of(run, seed, data, out, scale) for run in (MNCL, HEAD))
    made = (MNCL, HEAD) in fine_pairs(experiments) and localized(job, fine_job) is not None
    return job.directory / FIGURE_3 if made else None


def _gpu(n: int) -> int | None:
    """The GPU of the n-th job; None without any."""
    return n % torch.cuda.device_count() if torch.cuda.is_available() else None


def _all_done(work: Callable[..., None], tasks: Sequence[tuple[Any, ...]], workers: int) -> Iterator[int]:
    """How many are done; each is done in a process of its own, so that its memory is its own."""
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=spawn, max_tasks_per_child=1) as pool:
        futures = [pool.submit(work, *task) for task in tasks]
        try:
            for done, future in enumerate(as_completed(futures), start=1):
                future.result()
                yield done
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)  # one that failed is told of before the others are done
            raise


def _facts(data: Path) -> dict[str, Any]:
    """What the test scenes are, and what can be had there at all."""
    source = open_source(data, TEST)
    queries = source.queries()
    assert queries.hints is not None
    exact = ambiguity(source.data, queries, queries.hints)
    return {"cells": len(source.data.cells), "queries": len(queries), "exact_matching": exact["exact_matching"]}
