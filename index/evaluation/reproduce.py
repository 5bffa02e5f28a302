"""The paper's tables and figures on a data set: what is missing is trained and measured, what is done is kept."""

import hashlib
import json
import multiprocessing
import resource
import shutil
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import torch

from index.artifact import fingerprint
from index.evaluation.ambiguity import ambiguity
from index.evaluation.evaluation import evaluate
from index.ranking import RERANKED, Ranker
from index.vector_localizer import VectorLocalizer
from models.city.gallery import MapData
from models.city.queries import Queries
from models.city.source import open_source
from models.city.types import Progress
from models.files import replace_file
from models.localization.checkpoint import FINE_METHODS, load_fine
from models.localization.fine_model import FineModel
from models.retrieval.checkpoint import METHODS, load_retriever
from models.retrieval.retriever import Retriever
from models.training.engine.run_dir import METRICS_FILE
from models.training.experiments import FINE, GROWTH, MNCL, Run, Scale, runs_of
from models.training.fit_fine import train_fine
from models.training.fit_retriever import train_retriever
from models.training.settings import load_settings
from models.training.training_data import load_training

RESULT_FILE, LOCALIZATION_FILE, WEIGHTS_DIR, RUN_DIR = "result.json", "localization.json", "weights", "run"
RANKINGS = {"global level alone": 0, f"global, then all levels on {RERANKED}": RERANKED, "all levels on all cells": -1}
TEST, CHOSEN_BY = "test", "val"


@dataclass(frozen=True, slots=True)
class Job:
    """One training with its measurements, in a directory of its own.

    Attributes:
        run: what is trained.
        seed: of all that is drawn.
        data: a data set.
        directory: where it goes.
        scale: how much is trained.
        key: of everything that the result depends on.
    """

    run: Run
    seed: int
    data: Path
    directory: Path
    scale: Scale
    key: str

    @classmethod
    def of(cls, run: Run, seed: int, data: Path, out: Path, scale: Scale) -> "Job":
        """A job in `out`."""
        model, training = load_settings(run.method, [*_changes(run, scale), f"training.seed={seed}"])
        facts = [run.method, model.model_dump(mode="json"), training.model_dump(mode="json"), fingerprint(data)]
        key = hashlib.sha256(json.dumps([*facts, scale.growth_radii_m]).encode()).hexdigest()
        return cls(run, seed, data, out / "runs" / run.name / f"seed-{seed}", scale, key)

    def result(self) -> dict[str, Any] | None:
        """What was measured; None if that is still to do."""
        path = self.directory / RESULT_FILE
        found: dict[str, Any] = json.loads(path.read_text()) if path.is_file() else {}
        return found if found.get("key") == self.key else None


def reproduce(
    data: Path, out: Path, scale: Scale, seeds: Sequence[int], workers: int, progress: Progress
) -> dict[str, Any]:
    """Train what is missing, measure it, and gather the figures.

    Args:
        data: a directory in KITTI360Pose's layout or a converted store, with train, val and test scenes.
        out: where runs go, one directory each; those of an earlier call that fit are kept.
        scale: how much is trained.
        seeds: of the trainings; the figures' are done with the first alone, the tables' with each.
        workers: trainings at once.
        progress: called as the work goes on.

    Returns:
        "seeds", and "runs": for each run's name its results, one a seed.

    Raises:
        DataError: the data cannot be read.
    """
    jobs = [Job.of(run, seed, data, out, scale) for seed in seeds for run in runs_of(every_seed=seed != seeds[0])]
    missing = [(job,) for job in jobs if job.result() is None]
    for done in _all_done(_do, missing, workers):
        progress("train and measure", len(jobs) - len(missing) + done, len(jobs))
    found: dict[str, list[dict[str, Any]]] = {}
    for job in jobs:
        result = job.result()
        assert result is not None
        found.setdefault(job.run.name, []).append(result)
    pairs = [
        (Job.of(Run(method), seed, data, out, scale), Job.of(fine, seed, data, out, scale))
        for method, fine in FINE.items()
        for seed in seeds
    ]
    for done in _all_done(_localize, pairs, workers):
        progress("localize", done, len(pairs))
    for job, fine_job in pairs:
        found[job.run.name][list(seeds).index(job.seed)]["localization"] = _localized(job, fine_job)
    return {"seeds": list(seeds), "data": _facts(data), "runs": found}


def _changes(run: Run, scale: Scale) -> tuple[str, ...]:
    return (*(scale.fine if run.method in FINE_METHODS else scale.retriever), *run.settings)


def _all_done(work: Callable[..., None], tasks: Sequence[tuple[Job, ...]], workers: int) -> Iterator[int]:
    """How many are done; each is done in a process of its own, so that its memory is its own."""
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=spawn, max_tasks_per_child=1) as pool:
        for done, future in enumerate(as_completed([pool.submit(work, *task) for task in tasks]), start=1):
            future.result()
            yield done


def _do(job: Job) -> None:
    """Train and measure; what an earlier call with other settings left is removed."""
    torch.set_num_threads(1)  # so that a run's weights do not depend on the machine's number of processors
    if job.directory.is_dir() and not _goes_on(job):
        shutil.rmtree(job.directory)
    job.directory.mkdir(parents=True, exist_ok=True)
    (job.directory / "key").write_text(job.key)
    weights = job.directory / WEIGHTS_DIR
    model, config = load_settings(job.run.method, [*_changes(job.run, job.scale), f"training.seed={job.seed}"])
    given: Any = model, config, job.directory / RUN_DIR, True

    def load(encoder: Any, rng: np.random.Generator) -> list[Any]:
        return [load_training(job.data, ("train", CHOSEN_BY), encoder, config, rng)]

    is_fine = job.run.method in FINE_METHODS
    if is_fine:
        train_fine(load, weights, job.run.method, *given)
    else:
        train_retriever(load, weights, METHODS[job.run.method], *given)
    result = {"key": job.key, "seed": job.seed, "training": _training_facts(job)}
    result |= _of_fine(weights) if is_fine else _of_retriever(job, weights)
    replace_file(job.directory / RESULT_FILE, (json.dumps(result, indent=2) + "\n").encode())


def _goes_on(job: Job) -> bool:
    path = job.directory / "key"
    return path.is_file() and path.read_text() == job.key


def _training_facts(job: Job) -> dict[str, float]:
    """Throughput, time to the best epoch, memory."""
    rows = np.genfromtxt(job.directory / RUN_DIR / METRICS_FILE, delimiter=",", names=True, ndmin=1)
    best_step = json.loads((job.directory / WEIGHTS_DIR / "config.json").read_text())["training"]["best_step"]
    return {
        "descriptions_per_second": float(np.median(rows["descriptions_per_second"])),
        "seconds_to_best": float(rows["seconds"][rows["step"] == best_step][0]),
        "peak_memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
    }


def _of_fine(weights: Path) -> dict[str, Any]:
    """Validation figures of a fine stage, given the true cell."""
    training = json.loads((weights / "config.json").read_text())["training"]
    return {"validation": training["sources"][0]["validation"]}


def _of_retriever(job: Job, weights: Path) -> dict[str, Any]:
    """Retrieval on the test scenes; of MNCL each ranking on the validation scenes; growth where the paper has it."""
    retriever = load_retriever(weights)
    data, queries = _queries(job.data, TEST)
    localizer = _localizer(data, retriever)
    grown = any(job.run == run for run, _ in GROWTH.values())
    report = evaluate(data, queries, localizer, grow_m=job.scale.growth_radii_m if grown else ())
    found = {
        "retrieval": report["retrieval"],
        "calibration_error": report["calibration"]["expected_calibration_error"],
        "bytes_a_cell": 4 * retriever.config.width + localizer.ranker.table.bytes_a_cell,
        "parameters": sum(p.numel() for p in retriever.parameters()),
    }
    if grown:
        found["growth"] = [
            {
                "radius_m": row["radius_m"],
                "cells": row["cells"],
                "queries": row["queries"],
                "R@1": row["retrieval"]["1"],
            }
            for row in report["growth"]
        ]
    if job.run == MNCL:
        found["rankings"] = _rankings(retriever, job.data)
    return found


def _rankings(retriever: Retriever, data: Path) -> dict[str, dict[str, float]]:
    """Retrieval recall on the validation scenes, by how cells are ranked."""
    asked, queries = _queries(data, CHOSEN_BY)
    recalls: dict[str, dict[str, float]] = {}
    for name, depth in RANKINGS.items():
        depth_here = len(asked.cells) if depth < 0 else depth
        recalls[name] = evaluate(asked, queries, _localizer(asked, retriever, depth_here))["retrieval"]
    return recalls


def _localize(job: Job, fine_job: Job) -> None:
    """Localization recall on the test scenes, kept beside the retriever's result."""
    if _localized(job, fine_job) is not None:
        return
    torch.set_num_threads(1)
    data, queries = _queries(job.data, TEST)
    refiner = load_fine(fine_job.directory / WEIGHTS_DIR)
    localizer = _localizer(data, load_retriever(job.directory / WEIGHTS_DIR), refiner=refiner)
    localization: dict[str, Any] = evaluate(data, queries, localizer)["localization"]
    record = {"key": job.key + fine_job.key, "localization": localization}
    replace_file(job.directory / LOCALIZATION_FILE, json.dumps(record).encode())


def _localizer(
    data: MapData, retriever: Retriever, depth: int = RERANKED, refiner: FineModel | None = None
) -> VectorLocalizer:
    ranker = Ranker.of(retriever, data.cells, data.gallery.labels, depth)
    return VectorLocalizer.of_map(data, ranker, refiner)


def _localized(job: Job, fine_job: Job) -> dict[str, Any] | None:
    """What `_localize` kept; None if that is still to do."""
    path = job.directory / LOCALIZATION_FILE
    found: dict[str, Any] = json.loads(path.read_text()) if path.is_file() else {}
    return found["localization"] if found.get("key") == job.key + fine_job.key else None


def _queries(data: Path, split: str) -> tuple[MapData, Queries]:
    """A split without the hints behind its sentences: exact matching is measured once, in `_facts`."""
    source = open_source(data, split)
    return source.data, replace(source.queries(), hints=None)


def _facts(data: Path) -> dict[str, Any]:
    """What the test scenes are, and what can be had there at all."""
    source = open_source(data, TEST)
    queries = source.queries()
    assert queries.hints is not None
    exact = ambiguity(source.data, queries, queries.hints)
    return {"cells": len(source.data.cells), "queries": len(queries), "exact_matching": exact["exact_matching"]}
