"""Evaluation: predictions of a model for queries with known positions, saved, then scored and drawn."""

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree
from scipy.special import logsumexp

from index.evaluation.ambiguity import ambiguity
from index.evaluation.predictions import FILE, Predictions
from index.evaluation.report import write_report
from index.evaluation.scoring import score
from index.map_posterior import MapPosterior
from index.ranking import Ranker
from index.refinement import Refinement, Refiner
from models.city.gallery import MapData
from models.city.queries import Queries
from models.city.types import Floats, Progress
from models.errors import DataError
from models.training.metrics import LOCALIZATION_KS, RETRIEVAL_KS

LISTED = 25  # cells kept of each ranking; recall curves end here
PREDICTED = max(*RETRIEVAL_KS, *LOCALIZATION_KS)
CHUNK = 64  # queries ranked at once


def evaluate(
    data: MapData,
    queries: Queries,
    ranker: Ranker | MapPosterior,
    report_dir: Path | None = None,
    grow_m: Sequence[float] = (),
    progress: Progress | None = None,
    refiner: Refiner | None = None,
) -> dict[str, Any]:
    """Ask a model, save what it says, score it.

    Args:
        data: the gallery.
        queries: what is asked.
        ranker: the model, with its vectors of the gallery (`Ranker.of`, or an index's); or the hint posterior of it.
        report_dir: where predictions.npz, report.json, report.md and the plots go; None to write nothing.
        grow_m: radii of a growing gallery (`grow`); predictions for each are saved beside the others.
        progress: called as the work goes on.
        refiner: gives the positions inside the retrieved cells; None for the cells' centres, or the posterior's own.

    Returns:
        The report (`index.evaluation.scoring.score`).
    """
    report = progress or (lambda stage, done, total: None)
    predictions = predict(data, queries, ranker, report, refiner)
    if queries.hints is not None:
        report("match hints", 0, 0)
        predictions.facts["ambiguity"] = ambiguity(data, queries, queries.hints)
    grown = [
        (radius, predict(*part, ranker.take(rows), report, refiner))
        for radius, part, rows in grow(data, queries, grow_m)
    ]
    if report_dir:
        save_run(report_dir, predictions, grown)
        return rescore(report_dir)
    return _report(predictions, grown)


def predict(
    data: MapData,
    queries: Queries,
    ranker: Ranker | MapPosterior,
    progress: Progress,
    refiner: Refiner | None = None,
) -> Predictions:
    """Rank the gallery for each query.

    Args:
        data: the gallery.
        queries: what is asked.
        ranker: the model, with its vectors of the gallery in the same rows.
        progress: called as the work goes on.
        refiner: as `evaluate`.
    """
    if isinstance(ranker, MapPosterior):
        return _predict_by_posterior(data, queries, ranker, progress)
    retriever = ranker.retriever
    total, cells = len(queries), len(data.cells)
    listed = min(LISTED, cells)
    ranked, scores = np.empty((total, listed), np.int32), np.empty((total, listed), np.float32)
    probability = np.empty(total)
    for start in range(0, total, CHUNK):
        progress("ask", start, total)
        rows = slice(start, start + CHUNK)
        said = queries.sentences[rows]
        similarity, order = ranker.rank(retriever.encode_texts(said), cells)
        ranked[rows], scores[rows] = order[:, :listed], similarity[:, :listed]
        probability[rows] = _first_probability(similarity, np.array([retriever.temperature(len(s)) for s in said]))
    progress("ask", total, total)
    centers = data.cells.center_m[:, :2].astype(np.float64)
    predicted: Floats = centers[ranked[:, :PREDICTED]]
    if refiner:
        progress("refine positions", 0, 0)
        predicted = Refinement(refiner, data.gallery).positions_m(queries.sentences, ranked[:, :PREDICTED])
    return Predictions(
        facts={
            "data": data.name,
            "split": data.split,
            "attribution": data.attribution,
            "model": retriever.name,
            "model_fingerprint": retriever.fingerprint,
            "method": refiner.method if refiner else "cell_center",
        }
        | ({"refiner_fingerprint": refiner.fingerprint} if refiner else {}),
        cell_ids=np.array(data.cells.ids),
        cell_scenes=np.array(data.cells.scenes),
        cell_centers_m=centers,
        queried_cells=queries.truth,
        positions_m=queries.positions_m,
        scenes=np.array(queries.scenes),
        strategies=np.array(queries.strategies),
        ranked=ranked,
        scores=scores,
        predicted_m=predicted,
        probability=probability,
        radius_m=np.full((total, 2), np.nan),
    )


def _predict_by_posterior(data: MapData, queries: Queries, posterior: MapPosterior, progress: Progress) -> Predictions:
    total, listed = len(queries), min(LISTED, len(data.cells))
    ranked, scores = np.full((total, listed), -1, np.int32), np.full((total, listed), -np.inf, np.float32)
    positions, radius_m = np.zeros((total, min(PREDICTED, listed), 2)), np.full((total, 2), posterior.extent_m)
    probability = np.zeros(total)
    for q, sentences in enumerate(queries.sentences):
        if q % CHUNK == 0:
            progress("ask", q, total)
            posterior.read_ahead(queries.sentences[q : q + CHUNK])
        located = posterior.locate(posterior.reading(posterior.notice(sentences)))
        if located is None:
            continue
        count = min(listed, len(located.rows))
        ranked[q, :count], scores[q, :count] = located.rows[:count], located.log_mass[:count]
        near = located.positions[: positions.shape[1]]
        positions[q, : len(near)] = near
        probability[q], radius_m[q] = located.probability[0], posterior.radii_m(located)
    progress("ask", total, total)
    model = {"model": posterior.model.method, "model_fingerprint": posterior.model.fingerprint}
    return Predictions(
        facts={"data": data.name, "split": data.split, "attribution": data.attribution}
        | model
        | {"method": posterior.model.method},
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


def grow(
    data: MapData, queries: Queries, radii_m: Sequence[float]
) -> list[tuple[float, tuple[MapData, Queries], npt.NDArray[np.intp]]]:
    """The scalability protocol (MNCL, figure 5): the same queries, a gallery that grows around them.

    The queries are those within the least radius of one centre (the query's position with most others around it, in
    its scene); the gallery is every cell within each radius of it.

    Returns:
        For each radius, in ascending order: the radius, gallery and queries, and the gallery's rows in `data`.

    Raises:
        DataError: a radius is not positive, or holds nothing to ask about.
    """
    if not radii_m:
        return []
    radii = sorted(set(radii_m))
    if radii[0] <= 0:
        raise DataError(f"grow: {radii[0]:g} m is no radius; give metres above 0, such as 200,300,400,500")
    asked, center, scene = _densest(queries, radii[0])
    cells = data.cells
    distance = np.hypot(*(cells.center_m[:, :2] - center).T)
    distance[np.array(cells.scenes) != scene] = np.inf
    asked = asked[distance[queries.truth[asked]] <= radii[0]]  # whose best cell is in the least gallery
    if not len(asked):
        raise DataError(f"grow: no query has its cell within {radii[0]:g} m; begin with a larger radius")
    steps = []
    for radius in radii:
        rows = np.flatnonzero(distance <= radius)
        position = np.full(len(cells), -1)
        position[rows] = np.arange(len(rows))
        gallery = replace(data.gallery, cells=cells.take(rows))
        asked_here = queries.take(asked)
        part = replace(asked_here, truth=position[asked_here.truth], hints=None)
        steps.append((radius, (replace(data, gallery=gallery), part), rows))
    return steps


def _densest(queries: Queries, radius_m: float) -> tuple[npt.NDArray[np.intp], Floats, str]:
    """Rows of the queries around the position that has most of them in reach, that position, and its scene."""
    scenes = np.array(queries.scenes)
    best: npt.NDArray[np.intp] = np.empty(0, np.intp)
    center, scene = np.zeros(2), ""
    for name in np.unique(scenes).tolist():
        rows = np.flatnonzero((scenes == name) & (queries.truth >= 0))
        if len(rows):
            tree = cKDTree(queries.positions_m[rows])
            at = int(tree.query_ball_point(queries.positions_m[rows], radius_m, return_length=True).argmax())
            near = rows[tree.query_ball_point(queries.positions_m[rows[at]], radius_m)]
            if len(near) > len(best):
                best, center, scene = np.sort(near), queries.positions_m[rows[at]], name
    return best, center, scene


def save_run(report_dir: Path, predictions: Predictions, grown: Sequence[tuple[float, Predictions]] = ()) -> None:
    """Save predictions into a report's directory, in place of an older run's."""
    report_dir.mkdir(parents=True, exist_ok=True)
    for old in report_dir.glob("grow-*.npz"):
        old.unlink()
    predictions.save(report_dir / FILE)
    for radius, part in grown:
        part.save(report_dir / f"grow-{radius:g}.npz")


def rescore(report_dir: Path) -> dict[str, Any]:
    """Score a saved run again; writes its report.json, report.md and plots.

    Raises:
        DataError: there are no predictions.
    """
    predictions = Predictions.load(report_dir / FILE)
    radii = sorted(float(path.stem.removeprefix("grow-")) for path in report_dir.glob("grow-*.npz"))
    grown = [(radius, Predictions.load(report_dir / f"grow-{radius:g}.npz")) for radius in radii]
    report = _report(predictions, grown)
    write_report(report_dir, predictions, report)
    return report


def _report(predictions: Predictions, grown: Sequence[tuple[float, Predictions]]) -> dict[str, Any]:
    report = score(predictions)
    if grown:
        names = ("cells", "queries", "retrieval", "localization", "intervals")
        parts = [(radius, score(part)) for radius, part in grown]
        report["growth"] = [{"radius_m": radius} | {name: part[name] for name in names} for radius, part in parts]
    # As it will be read: a report that was written and one that was returned are the same.
    return dict(json.loads(json.dumps(report)))


def _first_probability(similarity: Floats, temperature: Floats) -> Floats:
    """[Q] probability of the first cell: softmax of similarities [Q, N], best first, over temperatures [Q]."""
    logits = similarity.astype(np.float64) / temperature[:, None]
    probability: Floats = np.exp(logits[:, 0] - logsumexp(logits, axis=1))
    return probability
