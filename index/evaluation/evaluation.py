"""Evaluation: predictions for queries with known positions are saved, then scored and drawn."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from index.answering.query import Query
from index.answering.result import CellLocalizer
from index.answering.vector_localizer import VectorLocalizer
from index.evaluation.ambiguity import ambiguity
from index.evaluation.localizers import restrict_localizer
from index.evaluation.predictions import PREDICTIONS_FILE, Predictions
from index.evaluation.report import write_report
from index.evaluation.scoring import score
from models.citymap.gallery import MapData
from models.citymap.queries import Queries
from models.citymap.types import Floats, Progress
from models.errors import DataError
from models.language.text_encoder import DEFAULT_TEXT_ENCODER
from models.training.engine.feature_cache import frozen_features
from models.training.metrics import LOCALIZATION_KS, RETRIEVAL_KS

STORED_CELLS = 25  # per query; the recall curve ends here
STORED_POSITIONS = max(*RETRIEVAL_KS, *LOCALIZATION_KS)
QUERIES_PER_BATCH = 64


def evaluate(
    data: MapData,
    queries: Queries,
    localizer: CellLocalizer,
    report_dir: Path | None = None,
    grow_m: Sequence[float] = (),
    progress: Progress | None = None,
) -> dict[str, Any]:
    """Localize queries, save the predictions and score them; return the report of `index.evaluation.scoring.score`.

    With `grow_m`, the radii of a growing gallery, it has predictions for each (`grow_gallery`).
    """
    report = progress or (lambda stage, done, total: None)
    if isinstance(localizer, VectorLocalizer):
        _read_cached_features(queries, localizer)
    predictions = predict(data, queries, localizer, report)
    if queries.hints is not None:
        report("match hints", 0, 0)
        predictions.facts["ambiguity"] = ambiguity(data, queries, queries.hints)
    grown = _predict_growth(data, queries, localizer, grow_m, None, report)
    if report_dir:
        save_run(report_dir, predictions, grown)
        return rescore(report_dir)
    return _report(predictions, grown)


def _read_cached_features(queries: Queries, localizer: VectorLocalizer) -> None:
    """Give text encoders their features of all queries, from the cache on disk if an earlier evaluation had the same.

    MiniLM is left out: it is fast, and the cache's half precision would change its results.
    """
    models = localizer.ranker.retriever, localizer.refiner
    encoders = {model.text_encoder for model in models if model and model.text_encoder.source != DEFAULT_TEXT_ENCODER}
    if encoders and len(queries):
        sentences = sorted({sentence for text in localizer.sentences(_texts(queries)) for sentence in text})
        for encoder in encoders:
            encoder.remember(sentences, frozen_features(encoder, sentences))


def _texts(queries: Queries) -> list[str]:
    return ["\n".join(sentences) for sentences in queries.sentences]


def predict(data: MapData, queries: Queries, localizer: CellLocalizer, progress: Progress) -> Predictions:
    """Predict cells and positions for each query."""
    texts, total, listed = _texts(queries), len(queries), min(STORED_CELLS, len(data.cells))
    ranked, scores = np.full((total, listed), -1, np.int32), np.full((total, listed), -np.inf, np.float32)
    positions = np.zeros((total, min(STORED_POSITIONS, listed), 2))
    probability, radius_m = np.zeros(total), np.full((total, 2), data.cells.extent_m)
    is_retrieved = np.zeros(total, np.bool_)
    for start in range(0, total, QUERIES_PER_BATCH):
        progress("ask", start, total)
        batch = [Query(text, top_k=STORED_POSITIONS) for text in texts[start : start + QUERIES_PER_BATCH]]
        for q, result in enumerate(localizer.find(batch), start):
            if (located := result.located) is None:
                continue
            count = min(listed, len(located.rows))
            ranked[q, :count], scores[q, :count] = located.rows[:count], located.score[:count]
            near = located.positions[: positions.shape[1]]
            positions[q, : len(near)] = near
            probability[q], radius_m[q] = located.probability[0], located.radii_m(0.5, 0.9)
            is_retrieved[q] = located.is_retrieved
    progress("ask", total, total)
    model = localizer.model
    return Predictions(
        facts={
            "data": data.name,
            "split": data.split,
            "attribution": data.attribution,
            "model": model.name,
            "model_fingerprint": model.sha256,
            "method": localizer.method,
            "retrieved_share": int(is_retrieved.sum()) / max(1, total),  # where vector search proposed the cells
        },
        cell_ids=np.array(data.cells.ids),
        cell_scenes=np.array(data.cells.scenes),
        cell_centers_m=data.cells.center_m[:, :2].astype(np.float64),
        queried_cells=queries.truth,
        positions_m=queries.positions_m,
        scenes=np.array(queries.scenes),
        strategies=np.array(queries.strategies),
        ranked=ranked,
        scores=scores,
        predicted_m=positions,
        probability=probability,
        radius_m=radius_m,
    )


def evaluate_growth(
    data: MapData, queries: Queries, localizer: CellLocalizer, radii_m: Sequence[float], scene: str
) -> list[dict[str, Any]]:
    """Return the reports of a gallery that grows in one scene (`grow_gallery`), as "growth" in that of `evaluate`."""
    return _growth_report(_predict_growth(data, queries, localizer, radii_m, scene, lambda *_: None))


def _predict_growth(
    data: MapData,
    queries: Queries,
    localizer: CellLocalizer,
    radii_m: Sequence[float],
    scene: str | None,
    progress: Progress,
) -> list[tuple[float, Predictions]]:
    return [
        (radius, predict(*part, restrict_localizer(localizer, part[0], rows), progress))
        for radius, part, rows in grow_gallery(data, queries, radii_m, scene)
    ]


def grow_gallery(
    data: MapData, queries: Queries, radii_m: Sequence[float], only_scene: str | None = None
) -> list[tuple[float, tuple[MapData, Queries], npt.NDArray[np.intp]]]:
    """Build galleries that grow around the same queries (the scalability protocol of MNCL, figure 5).

    The gallery has every cell within a radius of the middle of its scene's queries, of all scenes or of one, as in the
    paper. There it is the middle of the trajectory, which data sets do not have. The queries are those whose best cell
    lies within the smallest radius. Return for each radius, ascending: the radius, gallery and queries, and the
    gallery's rows in `data`.
    """
    if not radii_m:
        return []
    radii = sorted(set(radii_m))
    if radii[0] <= 0:
        raise DataError(f"grow: {radii[0]:g} m is not a valid radius; give metres above 0, such as 200,300,400,500")
    cells, known = data.cells, np.flatnonzero(queries.truth >= 0)
    away = np.full(len(cells), np.inf)
    for scene in [only_scene] if only_scene else sorted(set(queries.scenes)):
        scene_queries = known[np.array(queries.scenes)[known] == scene]
        in_scene = np.array(cells.scenes) == scene
        if len(scene_queries):
            away[in_scene] = np.linalg.norm(
                cells.center_m[in_scene, :2] - _central_position(queries.positions_m[scene_queries]), axis=1
            )
    chosen = known[away[queries.truth[known]] <= radii[0]]
    if not len(chosen):
        raise DataError(f"grow: no query has its cell within {radii[0]:g} m; start with a larger radius")
    steps = []
    for radius in radii:
        rows = np.flatnonzero(away <= radius)
        position = np.full(len(cells), -1)
        position[rows] = np.arange(len(rows))
        gallery = replace(data.gallery, cells=cells.take(rows))
        chosen_queries = queries.take(chosen)
        part = replace(chosen_queries, truth=position[chosen_queries.truth], hints=None)
        steps.append((radius, (replace(data, gallery=gallery), part), rows))
    return steps


def _central_position(positions_m: Floats) -> Floats:
    return positions_m[np.linalg.norm(positions_m - positions_m.mean(axis=0), axis=1).argmin()]


def save_run(report_dir: Path, predictions: Predictions, grown: Sequence[tuple[float, Predictions]] = ()) -> None:
    """Save predictions into a report's directory, and remove those of an older run."""
    report_dir.mkdir(parents=True, exist_ok=True)
    for old in report_dir.glob("grow-*.npz"):
        old.unlink()
    predictions.save(report_dir / PREDICTIONS_FILE)
    for radius, part in grown:
        part.save(report_dir / f"grow-{radius:g}.npz")


def rescore(report_dir: Path) -> dict[str, Any]:
    """Score a saved run again and write its report.json, report.md and plots."""
    predictions = Predictions.load(report_dir / PREDICTIONS_FILE)
    radii = sorted(float(path.stem.removeprefix("grow-")) for path in report_dir.glob("grow-*.npz"))
    grown = [(radius, Predictions.load(report_dir / f"grow-{radius:g}.npz")) for radius in radii]
    report = _report(predictions, grown)
    write_report(report_dir, predictions, report)
    return report


def _report(predictions: Predictions, grown: Sequence[tuple[float, Predictions]]) -> dict[str, Any]:
    report = score(predictions)
    if grown:
        report["growth"] = _growth_report(grown)
    return report


def _growth_report(grown: Sequence[tuple[float, Predictions]]) -> list[dict[str, Any]]:
    names = ("cells", "queries", "retrieval", "localization", "intervals")
    parts = [(radius, score(part)) for radius, part in grown]
    return [{"radius_m": radius} | {name: part[name] for name in names} for radius, part in parts]
