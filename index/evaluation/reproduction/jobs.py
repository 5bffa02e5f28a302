"""One training of `reproduce` with its measurements, in a directory of its own."""

import hashlib
import json
import resource
import shutil
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import torch

from index.answering.ranking import RERANKED, Ranker
from index.answering.vector_localizer import VectorLocalizer
from index.build.manifest import fingerprint
from index.evaluation.evaluation import evaluate
from index.evaluation.localizers import vectors_of_map
from index.evaluation.reproduction.figure_3 import draw_figure_3
from models.citymap.gallery import MapData
from models.citymap.queries import Queries
from models.files import replace_file, sha256
from models.language.text_encoder import DEFAULT_TEXT_ENCODER
from models.paper.checkpoint import METHODS, load_retriever
from models.paper.fine.checkpoint import FINE_METHODS, load_fine
from models.paper.fine.fine_model import FineModel
from models.paper.retriever import Retriever
from models.sources.source import VALIDATION_SEED, open_sources
from models.training.engine.loop import pick_device
from models.training.engine.run_dir import METRICS_FILE
from models.training.experiments import POINTS, VARIANTS, TrainingRun, TrainingScale, apply_variant
from models.training.fit_fine import train_fine
from models.training.fit_points import train_points
from models.training.fit_retriever import train_retriever
from models.training.paper_tables import GROWTH, MNCL
from models.training.settings import load_settings
from models.training.training_data import load_training_cells, load_training_data

_FORMAT = 1  # of results; counted up when what a training or a measurement does changes
RESULT_FILE, WEIGHTS_DIR, RUN_DIR, FIGURE_3 = "result.json", "weights", "run", "figure3.png"
POINTS_SEED = 0
MEASURED = TEST, VALIDATION = "test", "val"
_TAUGHT = "train", VALIDATION
ALONE, LISTED, ALL = "global level alone", f"global, then all levels on {RERANKED}", "all levels on all cells"
Z_SCORES = "all levels on all cells, by z-scores (the code)"
GROWN = [apply_variant(run, variant) for run, _ in GROWTH.values() for variant in VARIANTS]
RANKED = [apply_variant(MNCL, variant) for variant in VARIANTS]


@dataclass(frozen=True, slots=True)
class Job:
    """What is trained on what, and where it goes.

    Attributes:
        run: what is trained.
        seed: of all that is drawn.
        data: a data set.
        out: where all jobs go.
        scale: how much is trained.
        key: of everything that the result depends on.
    """

    run: TrainingRun
    seed: int
    data: Path
    out: Path
    scale: TrainingScale
    key: str

    @classmethod
    def of(cls, run: TrainingRun, seed: int, data: Path, out: Path, scale: TrainingScale) -> "Job":
        """A job in `out`."""
        model, training = settings_of(run, seed, scale)
        settings = [model.model_dump(mode="json"), training.model_dump(mode="json", exclude={"device"})]
        facts = [_FORMAT, run.method, *settings, pick_device(training.device).type]
        facts += _files_of(getattr(model, "text_encoder", DEFAULT_TEXT_ENCODER))
        if run.needs_points:
            facts.append(Job.of(TrainingRun(POINTS), POINTS_SEED, data, out, scale).key)
        key = hashlib.sha256(json.dumps([*facts, fingerprint(data), scale.growth_radii_m]).encode()).hexdigest()
        return cls(run, seed, data, out, scale, key)

    @property
    def directory(self) -> Path:
        """Its own."""
        return self.out / "runs" / self.run.name / f"seed-{self.seed}"

    @property
    def points(self) -> "Job | None":
        """The training of its point encoder, if it takes one: one for all seeds, as the papers have one backbone."""
        return (
            Job.of(TrainingRun(POINTS), POINTS_SEED, self.data, self.out, self.scale) if self.run.needs_points else None
        )

    def settings(self) -> tuple[Any, Any]:
        """As `settings_of`, with where its point encoder is."""
        points = (f"training.points={self.points.directory / WEIGHTS_DIR}",) if self.points else ()
        return settings_of(self.run, self.seed, self.scale, points)

    def result(self) -> dict[str, Any] | None:
        """What was measured; None if that is still to do."""
        return _kept(self.directory / RESULT_FILE, self.key)


def settings_of(run: TrainingRun, seed: int, scale: TrainingScale, also: tuple[str, ...] = ()) -> tuple[Any, Any]:
    """The settings of a run, as `load_settings`.

    Raises:
        TrainingError: it cannot be trained with them.
    """
    of_method = scale.points if run.method == POINTS else scale.fine if run.method in FINE_METHODS else scale.retriever
    return load_settings(run.method, [*of_method, *run.settings, f"training.seed={seed}", *also])


def _files_of(text_encoder: str) -> list[str]:
    """Names and sums of the files of a text encoder that a directory holds; others are known by their names."""
    directory = Path(text_encoder)
    if text_encoder == DEFAULT_TEXT_ENCODER or not directory.is_dir():
        return []
    files = {path.relative_to(directory).as_posix(): path for path in directory.rglob("*") if path.is_file()}
    known = {name: (path.stat().st_size, path.stat().st_mtime_ns) for name, path in files.items()}
    return [f"{name} {_sum(path, *known[name])}" for name, path in sorted(files.items())]


@lru_cache
def _sum(path: Path, size: int, mtime_ns: int) -> str:
    """sha256 of a file, read once while it stays as it was: every key of a job asks for it."""
    return sha256(path)


def _kept(path: Path, key: str) -> dict[str, Any] | None:
    found: dict[str, Any] = json.loads(path.read_text()) if path.is_file() else {}
    return found if found.get("key") == key else None


def train_and_measure(job: Job, gpu: int | None) -> None:
    """Do a job; what an earlier call with other settings left is removed.

    Args:
        job: which.
        gpu: number of the one to train on, if "auto" or "cuda" is asked for; None if there is none.
    """
    torch.set_num_threads(1)  # so that a run's weights do not depend on the machine's number of processors
    if gpu is not None:
        torch.cuda.set_device(gpu)
    key = job.directory / "key"
    if job.directory.is_dir() and not (key.is_file() and key.read_text() == job.key):
        shutil.rmtree(job.directory)
    job.directory.mkdir(parents=True, exist_ok=True)
    key.write_text(job.key)
    weights = job.directory / WEIGHTS_DIR
    model, config = job.settings()
    where: Any = job.directory / RUN_DIR, True

    def load(encoder: Any, rng: np.random.Generator) -> list[Any]:
        return [load_training_data(job.data, _TAUGHT, encoder, config, rng)]

    found: dict[str, Any]
    if job.run.method == POINTS:
        found = {"validation": train_points([load_training_cells(job.data, _TAUGHT)], weights, config, *where)}
    elif job.run.method in FINE_METHODS:
        train_fine(load, weights, job.run.method, model, config, *where)
        found = {"validation": _record(weights)["sources"][0]["validation"]}
    else:
        train_retriever(load, weights, METHODS[job.run.method], model, config, *where)
        found = _of_retriever(job, weights)
    result = {"key": job.key, "seed": job.seed, "settings": _settings(model, config), "training": _costs(job), **found}
    replace_file(job.directory / RESULT_FILE, (json.dumps(result, indent=2) + "\n").encode())


def _settings(model: Any, config: Any) -> dict[str, Any]:
    """What the head of the report repeats."""
    told = {name: getattr(model, name) for name in ("text_encoder", "width") if hasattr(model, name)}
    names = ("steps", "batch_size", "learning_rate", "schedule", "cluster", "wording", "patience")
    return told | {name: getattr(config, name) for name in names}


def _record(weights: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((weights / "config.json").read_text())["training"]
    return found


def _costs(job: Job) -> dict[str, float]:
    """Throughput, time to the best epoch and in all, steps done, memory."""
    rows = np.genfromtxt(job.directory / RUN_DIR / METRICS_FILE, delimiter=",", names=True, ndmin=1)
    best = rows[rows[_criterion(job.run)].argmax()]
    return {
        "descriptions_per_second": float(np.median(rows["descriptions_per_second"])),
        "seconds_to_best": float(best["seconds"]),
        "seconds": float(rows["seconds"][-1]),
        "best_step": int(best["step"]),
        "steps": int(rows["step"][-1]),
        "peak_memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
    }


def _criterion(run: TrainingRun) -> str:
    """The column of metrics.csv that the best weights have most of, as NumPy names it."""
    return "label" if run.method == POINTS else "within_5m" if run.method in FINE_METHODS else "recall5"


def _of_retriever(job: Job, weights: Path) -> dict[str, Any]:
    """Retrieval on test scenes and on those it was chosen by; of MNCL each ranking; growth where the paper has it."""
    retriever = load_retriever(weights)
    [(data, queries)] = asked(job.data, TEST)
    localizer = _localizer(data, retriever)
    grown = job.run in GROWN
    report = evaluate(data, queries, localizer, grow_m=job.scale.growth_radii_m if grown else ())
    found = {
        "retrieval": report["retrieval"],
        "validation_retrieval": _record(weights)["sources"][0]["validation"]["retrieval"],
        "calibration_error": report["calibration"]["expected_calibration_error"],
        "bytes_a_cell": 4 * retriever.config.width + localizer.ranker.table.bytes_per_cell,
        "parameters": sum(p.numel() for p in retriever.parameters()),
    }
    if grown:
        found["growth"] = [
            {name: row[name] for name in ("radius_m", "cells", "queries")} | {"R@1": row["retrieval"]["1"]}
            for row in report["growth"]
        ]
    if job.run in RANKED:
        found["rankings"] = _rankings(retriever, job.data)
    return found


def _rankings(retriever: Retriever, data: Path) -> dict[str, dict[str, float]]:
    """Retrieval recall on the validation scenes, by how cells are ranked by one and the same trained model."""
    [(given, queries)] = asked(data, VALIDATION)
    fitted = retriever.config
    found = {}
    for name, depth in ((ALONE, 0), (LISTED, RERANKED), (ALL, len(given.cells)), (Z_SCORES, len(given.cells))):
        retriever.config = fitted.model_copy(update={"level_weights": ()}) if name == Z_SCORES else fitted
        found[name] = evaluate(given, queries, _localizer(given, retriever, depth))["retrieval"]
    return found


def localize(job: Job, fine_job: Job, draw: bool) -> None:
    """Measure localization with a fine stage on the test and validation scenes, kept beside the retriever's result.

    Args:
        job: of the retriever, done.
        fine_job: of the fine stage, done.
        draw: whether to make figure 3 of it.
    """
    torch.set_num_threads(1)
    retriever, refiner = load_retriever(job.directory / WEIGHTS_DIR), load_fine(fine_job.directory / WEIGHTS_DIR)
    found = {}
    for split, (data, queries) in zip(MEASURED, asked(job.data, *MEASURED), strict=True):
        localizer = _localizer(data, retriever, refiner=refiner)
        found[split] = evaluate(data, queries, localizer)["localization"]
        if draw and split == TEST:
            draw_figure_3(data, queries, localizer, job.directory / FIGURE_3)
    record = {"key": job.key + fine_job.key, "localization": found}
    replace_file(_localization_file(job, fine_job), json.dumps(record).encode())


def localized(job: Job, fine_job: Job) -> dict[str, Any] | None:
    """What `localize` kept, by split; None if that is still to do."""
    found = _kept(_localization_file(job, fine_job), job.key + fine_job.key)
    return found and found["localization"]


def _localization_file(job: Job, fine_job: Job) -> Path:
    return job.directory / f"localization-{fine_job.run.name}.json"


def _localizer(
    data: MapData, retriever: Retriever, depth: int = RERANKED, refiner: FineModel | None = None
) -> VectorLocalizer:
    ranker = Ranker.of(retriever, data.cells, data.gallery.labels, depth)
    return vectors_of_map(data, ranker, refiner)


def asked(data: Path, *splits: str) -> Iterator[tuple[MapData, Queries]]:
    """Splits without the hints behind their sentences: exact matching is measured once, in `reproduce`."""
    for split, source in zip(splits, open_sources(data, splits), strict=True):
        queries = source.queries(VALIDATION_SEED) if split == VALIDATION else source.queries()
        yield source.data, replace(queries, hints=None)
