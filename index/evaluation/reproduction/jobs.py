"""One training of `reproduce` with its measurements, in its own directory."""

import hashlib
import json
import resource
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import torch

from index.answering.query import Rerank
from index.answering.ranking import RERANKED_CELLS, Ranker
from index.answering.vector_localizer import VectorLocalizer
from index.build.manifest import fingerprint
from index.evaluation.evaluation import evaluate, evaluate_growth
from index.evaluation.localizers import vectors_of_map
from index.evaluation.reproduction.figures import draw_figure_3
from models.citymap.gallery import MapData
from models.citymap.queries import Queries
from models.files import replace_file, sha256
from models.language.text_encoder import DEFAULT_TEXT_ENCODER
from models.paper.checkpoint import METHODS, load_retriever
from models.paper.fine.checkpoint import FINE_METHODS, load_fine
from models.paper.fine.fine_model import FineModel
from models.paper.retriever import Retriever
from models.sources.source import VALIDATION_SEED, open_sources
from models.training.engine.devices import on_device
from models.training.engine.loop import pick_device
from models.training.engine.run_dir import METRICS_FILE
from models.training.experiments import POINTS, VARIANTS, TrainingRun, TrainingScale, apply_variant
from models.training.fit_fine import train_fine
from models.training.fit_points import train_points
from models.training.fit_retriever import train_retriever
from models.training.paper_tables import GROWTH, MNCL
from models.training.settings import load_settings
from models.training.training_data import load_training_cells, load_training_data

_RESULT_FORMAT = 2  # of results; increase it when a training, a measurement or the default of a setting changes
RESULT_FILE, WEIGHTS_DIR, RUN_DIR, FIGURE_3 = "result.json", "weights", "run", "figure3.png"
POINTS_SEED = 0
MEASURED_SPLITS = TEST, VALIDATION = "test", "val"
_RERANK_FORMAT = 1  # of re-ranked results; increase it when the re-ranking changes
AT_CENTER = "cell_center"  # key of the localization at the centres of the cells
_TRAINING_SPLITS = "train", VALIDATION
GLOBAL_ONLY, RERANKED, ALL_LEVELS = (
    "global level alone",
    f"global, then all levels on {RERANKED_CELLS}",
    "all levels on all cells",
)
Z_SCORES = "all levels on all cells, by z-scores (the code)"
FIGURE_5_SCENE = "0009"
GROWTH_RUNS = [apply_variant(run, variant) for run, _ in GROWTH.values() for variant in VARIANTS]
RANKING_RUNS = [apply_variant(MNCL, variant) for variant in VARIANTS]


@dataclass(frozen=True, slots=True)
class ReproductionJob:
    """A training, its data and its directory; `key` is the hash of everything that the result depends on."""

    run: TrainingRun
    seed: int
    data: Path
    out: Path
    scale: TrainingScale
    key: str

    @classmethod
    def build(cls, run: TrainingRun, seed: int, data: Path, out: Path, scale: TrainingScale) -> "ReproductionJob":
        """Build a job in `out`."""
        model, training = run_settings(run, seed, scale)
        settings = [  # not the defaults, so that a further option does not make every run again
            model.model_dump(mode="json", exclude_defaults=True),
            training.model_dump(mode="json", exclude_defaults=True, exclude={"device"}),
        ]
        facts = [_RESULT_FORMAT, run.method, *settings, pick_device(training.device).type]
        facts += _encoder_files(getattr(model, "text_encoder", DEFAULT_TEXT_ENCODER))
        if run.needs_points:
            facts.append(ReproductionJob.build(run.point_run, POINTS_SEED, data, out, scale).key)
        key = hashlib.sha256(json.dumps([*facts, fingerprint(data), scale.growth_radii_m]).encode()).hexdigest()
        return cls(run, seed, data, out, scale, key)

    @property
    def directory(self) -> Path:
        """Return the job's directory."""
        return self.out / "runs" / self.run.name / f"seed-{self.seed}"

    @property
    def points(self) -> "ReproductionJob | None":
        """Return the training of its point encoder, if it needs one; all seeds share it, as in the papers."""
        if not self.run.needs_points:
            return None
        return ReproductionJob.build(self.run.point_run, POINTS_SEED, self.data, self.out, self.scale)

    def settings(self) -> tuple[Any, Any]:
        """Return the settings, with the path of the point encoder."""
        points = (f"training.points={self.points.directory / WEIGHTS_DIR}",) if self.points else ()
        return run_settings(self.run, self.seed, self.scale, points)

    def result(self) -> dict[str, Any] | None:
        """Return the measurements; None if the job is not done."""
        return _read_result(self.directory / RESULT_FILE, self.key)


def run_settings(run: TrainingRun, seed: int, scale: TrainingScale, also: tuple[str, ...] = ()) -> tuple[Any, Any]:
    """Return the settings of a run, as `load_settings`."""
    part = "points" if run.method == POINTS else "fine" if run.method in FINE_METHODS else "retriever"
    return load_settings(run.method, [*getattr(scale, part), *run.settings, f"training.seed={seed}", *also])


def _encoder_files(text_encoder: str) -> list[str]:
    """Return names and sums of the files of a text encoder in a directory; none for encoders known by name."""
    directory = Path(text_encoder)
    if text_encoder == DEFAULT_TEXT_ENCODER or not directory.is_dir():
        return []
    files = {path.relative_to(directory).as_posix(): path for path in directory.rglob("*") if path.is_file()}
    known = {name: (path.stat().st_size, path.stat().st_mtime_ns) for name, path in files.items()}
    return [f"{name} {_file_sha256(path, *known[name])}" for name, path in sorted(files.items())]


@lru_cache
def _file_sha256(path: Path, size: int, mtime_ns: int) -> str:
    """Return the sha256 of a file, cached while size and time stay the same."""
    return sha256(path)


def _read_result(path: Path, key: str) -> dict[str, Any] | None:
    result: dict[str, Any] = json.loads(path.read_text()) if path.is_file() else {}
    return result if result.get("key") == key else None


def train_and_measure(job: ReproductionJob, gpu: int | None) -> None:
    """Train and measure a job; results of other settings are removed. `gpu` serves the devices "auto" and "cuda"."""
    _set_up_process(gpu)
    key = job.directory / "key"
    if job.directory.is_dir() and not (key.is_file() and key.read_text() == job.key):
        shutil.rmtree(job.directory)
    job.directory.mkdir(parents=True, exist_ok=True)
    key.write_text(job.key)
    weights = job.directory / WEIGHTS_DIR
    model, config = job.settings()
    where: Any = job.directory / RUN_DIR, True

    def load(encoder: Any, rng: np.random.Generator) -> list[Any]:
        return [load_training_data(job.data, _TRAINING_SPLITS, encoder, config, rng)]

    measured: dict[str, Any]
    if job.run.method == POINTS:
        cells = [load_training_cells(job.data, _TRAINING_SPLITS)]
        measured = {"validation": train_points(cells, weights, config, *where, architecture=model.point_encoder)}
    elif job.run.method in FINE_METHODS:
        train_fine(load, weights, job.run.method, model, config, *where)
        measured = {"validation": _training_record(weights)["sources"][0]["validation"]}
    else:
        train_retriever(load, weights, METHODS[job.run.method], model, config, *where)
        measured = _measure_retriever(job, weights)
    result = {
        "key": job.key,
        "seed": job.seed,
        "settings": _report_settings(model, config),
        "training": _costs(job),
        **measured,
    }
    replace_file(job.directory / RESULT_FILE, (json.dumps(result, indent=2) + "\n").encode())


def _report_settings(model: Any, config: Any) -> dict[str, Any]:
    settings = {name: getattr(model, name) for name in ("text_encoder", "width") if hasattr(model, name)}
    names = ("steps", "batch_size", "learning_rate", "schedule", "cluster", "wording", "patience")
    return settings | {name: getattr(config, name) for name in names}


def _training_record(weights: Path) -> dict[str, Any]:
    return json.loads((weights / "config.json").read_text())["training"]


def _costs(job: ReproductionJob) -> dict[str, float]:
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
    """Return the column of metrics.csv that selects the best weights."""
    return "label" if run.method == POINTS else "within_5m" if run.method in FINE_METHODS else "recall5"


def _set_up_process(gpu: int | None) -> None:
    torch.set_num_threads(1)  # so that weights do not depend on the number of processors
    if gpu is not None:
        torch.cuda.set_device(gpu)


@contextmanager
def _on_device_of(job: ReproductionJob, *models: Retriever | FineModel | None) -> Iterator[None]:
    """Move models and their text encoders to the device that the job is trained on, and back at the end."""
    modules = [module for model in models if model for module in (model, model.text_encoder)]
    with on_device(pick_device(job.settings()[1].device), *modules):
        yield


def _measure_retriever(job: ReproductionJob, weights: Path) -> dict[str, Any]:
    retriever = load_retriever(weights)
    with _on_device_of(job, retriever):
        return _measure(job, retriever, _training_record(weights)["sources"][0]["validation"]["retrieval"])


def _measure(job: ReproductionJob, retriever: Retriever, validation: dict[str, float]) -> dict[str, Any]:
    [(data, queries)] = open_queries(job.data, TEST)
    localizer = _localizer(data, retriever)
    grown = job.run in GROWTH_RUNS
    report = evaluate(data, queries, localizer, grow_m=job.scale.growth_radii_m if grown else ())
    result = {
        "retrieval": report["retrieval"],
        "validation_retrieval": validation,
        "calibration_error": report["calibration"]["expected_calibration_error"],
        "bytes_a_cell": 4 * retriever.config.width + localizer.ranker.table.bytes_per_cell,
        "parameters": sum(p.numel() for p in retriever.parameters()),
    }
    if grown:
        scene = scene_of_figure_5(queries.scenes)
        rows = evaluate_growth(data, queries, localizer, job.scale.growth_radii_m, scene)
        result["growth"] = _growth_rows(report["growth"])
        result["growth_of_scene"] = [{"scene": scene} | row for row in _growth_rows(rows)]
    if job.run in RANKING_RUNS:
        result["rankings"] = _rankings(retriever, job.data)
    return result


def scene_of_figure_5(scenes: Sequence[str]) -> str:
    """Return the paper's scene if it is among some scenes, else the first of them."""
    ordered = sorted(set(scenes))
    return next((scene for scene in ordered if FIGURE_5_SCENE in scene), ordered[0])


def _growth_rows(report: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    names = "radius_m", "cells", "queries"
    return [{name: row[name] for name in names} | {"R@1": row["retrieval"]["1"]} for row in report]


def _rankings(retriever: Retriever, data: Path) -> dict[str, dict[str, float]]:
    """Measure retrieval recall on the validation scenes for each way to rank with the same model."""
    [(map_data, queries)] = open_queries(data, VALIDATION)
    fitted = retriever.config
    result = {}
    for name, depth in (
        (GLOBAL_ONLY, 0),
        (RERANKED, RERANKED_CELLS),
        (ALL_LEVELS, len(map_data.cells)),
        (Z_SCORES, len(map_data.cells)),
    ):
        retriever.config = fitted.model_copy(update={"level_weights": ()}) if name == Z_SCORES else fitted
        result[name] = evaluate(map_data, queries, _localizer(map_data, retriever, depth))["retrieval"]
    return result


def localize(job: ReproductionJob, fine_job: ReproductionJob, gpu: int | None) -> None:
    """Measure localization with a fine stage and at the centres of the cells, and save it with the retriever's result.

    Both on test and validation scenes; `gpu` as in `train_and_measure`.
    """
    _set_up_process(gpu)
    retriever, refiner = load_retriever(job.directory / WEIGHTS_DIR), load_fine(fine_job.directory / WEIGHTS_DIR)
    result: dict[str, Any] = {AT_CENTER: {}}
    with _on_device_of(job, retriever, refiner):
        for split, (data, queries) in zip(MEASURED_SPLITS, open_queries(job.data, *MEASURED_SPLITS), strict=True):
            report = evaluate(data, queries, _localizer(data, retriever, refiner=refiner))
            result[split], result[AT_CENTER][split] = report["localization"], report[AT_CENTER]
    record = {"key": job.key + fine_job.key, "localization": result}
    replace_file(localization_file(job, fine_job), json.dumps(record).encode())


def read_localization(job: ReproductionJob, fine_job: ReproductionJob) -> dict[str, Any] | None:
    """Return the saved localization by split; None if it is not measured yet."""
    result = _read_result(localization_file(job, fine_job), job.key + fine_job.key)
    return result and result["localization"]


def draw_figure_3_of(jobs: dict[str, ReproductionJob], fine_job: ReproductionJob, path: Path) -> None:
    """Draw figure 3 on the test scenes with the retrievers of `jobs`, by name, and one fine stage."""
    _set_up_process(None)
    refiner = load_fine(fine_job.directory / WEIGHTS_DIR)
    [(data, queries)] = open_queries(fine_job.data, TEST)
    retrievers = {name: load_retriever(job.directory / WEIGHTS_DIR) for name, job in jobs.items()}
    with _on_device_of(fine_job, refiner, *retrievers.values()):
        localizers = {name: _localizer(data, retriever, refiner=refiner) for name, retriever in retrievers.items()}
        draw_figure_3(data, queries, localizers, path)


def localization_file(job: ReproductionJob, fine_job: ReproductionJob) -> Path:
    """Return the file of the localization with a fine stage."""
    return job.directory / f"localization-{fine_job.run.name}.json"


def measure_reranked(job: ReproductionJob, fine_job: ReproductionJob | None, gpu: int | None) -> None:
    """Measure retrieval, and localization with a fine stage or at the centres, of re-ranked cells, and save it.

    Both on test and validation scenes; `gpu` as in `train_and_measure`.
    """
    _set_up_process(gpu)
    retriever = load_retriever(job.directory / WEIGHTS_DIR)
    refiner = load_fine(fine_job.directory / WEIGHTS_DIR) if fine_job else None
    result: dict[str, Any] = {}
    with _on_device_of(job, retriever, refiner):
        for split, (data, queries) in zip(MEASURED_SPLITS, open_queries(job.data, *MEASURED_SPLITS), strict=True):
            report = evaluate(data, queries, _localizer(data, retriever, refiner=refiner, rerank="parc"))
            result[split] = {name: report[name] for name in ("retrieval", "localization", "calibration")}
    record = {"key": _reranked_key(job, fine_job), "reranked": result}
    replace_file(_reranked_file(job, fine_job), json.dumps(record).encode())


def read_reranked(job: ReproductionJob, fine_job: ReproductionJob | None) -> dict[str, Any] | None:
    """Return the saved results of `measure_reranked` by split; None if they are not measured yet."""
    result = _read_result(_reranked_file(job, fine_job), _reranked_key(job, fine_job))
    return result and result["reranked"]


def _reranked_key(job: ReproductionJob, fine_job: ReproductionJob | None) -> str:
    return f"{_RERANK_FORMAT}-{job.key}{fine_job.key if fine_job else ''}"


def _reranked_file(job: ReproductionJob, fine_job: ReproductionJob | None) -> Path:
    return job.directory / f"reranked-{fine_job.run.name if fine_job else 'centers'}.json"


def _localizer(
    data: MapData,
    retriever: Retriever,
    depth: int = RERANKED_CELLS,
    refiner: FineModel | None = None,
    rerank: Rerank | None = None,
) -> VectorLocalizer:
    ranker = Ranker.from_cells(retriever, data.cells, data.gallery.labels, depth)
    return vectors_of_map(data, ranker, refiner, rerank)


def open_queries(data: Path, *splits: str) -> Iterator[tuple[MapData, Queries]]:
    """Yield splits without hints, because exact matching is measured once, in `reproduce`."""
    for split, source in zip(splits, open_sources(data, splits), strict=True):
        queries = source.queries(VALIDATION_SEED) if split == VALIDATION else source.queries()
        yield source.data, replace(queries, hints=None)
