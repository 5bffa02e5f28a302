"""From saved predictions to a report: recall by the protocol of docs/formats.md, intervals and breakdowns."""

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from index.evaluation.predictions import Predictions
from models.citymap.types import Floats
from models.training.metrics import (
    LOCALIZATION_KS,
    LOCALIZATION_RADII_M,
    RETRIEVAL_KS,
    localization_hits,
    localization_recall,
    retrieval_hits,
    retrieval_recall,
)

RESAMPLES = 1000
RESAMPLE_SEED = 0
INTERVAL_PERCENTILES = (2.5, 97.5)  # percentiles of a 95 % interval
CALIBRATION_BINS = 10
DIGITS = 6  # the last bits of a model's output depend on the number of threads


def score(predictions: Predictions) -> dict[str, Any]:
    """Score predictions.

    The report has `Predictions.facts`, "retrieval" {k: recall}, "localization" {k: {metres: recall}}; the same for the
    retrieved cell's centre, the true best cell's centre ("oracle") and "chance"; intervals, breakdowns, error quantiles
    and calibration; and "places" with each query's position ("truth") and "estimate", null in another scene. Keys are
    strings, as in JSON.
    """
    p = predictions
    errors, centers = p.errors_m(), p.center_errors_m(p.ranked[:, : p.predicted_m.shape[1]])
    oracle = np.repeat(p.center_errors_m(p.queried_cells[:, None]), errors.shape[1], axis=1)
    report = {
        **p.facts,
        "cells": len(p.cell_ids),
        "queries": len(p.queried_cells),
        "queries_without_cell": int((p.queried_cells < 0).sum()),
        "retrieval": retrieval_recall(p.ranked, p.queried_cells),
        "localization": localization_recall(errors),
        "intervals": _intervals(p, errors),
        "cell_center": localization_recall(centers),
        "oracle": localization_recall(oracle),
        "chance": _chance(p),
        "error_m": _quantiles(errors[:, 0]),
        "by_scene": _group_recalls(p.scenes, p, errors),
        "by_strategy": _group_recalls(p.strategies, p, errors),
        "calibration": calibration(p.probability, retrieval_hits(p.ranked, p.queried_cells)[1]),
    }
    report["places"] = {
        "truth": p.positions_m[:, :2].round(2).tolist(),
        "estimate": [
            position if np.isfinite(error) else None
            for position, error in zip(p.predicted_m[:, 0].round(2).tolist(), errors[:, 0], strict=True)
        ],
    }
    if not np.isnan(p.radius_m).any():
        report["coverage"] = _coverage(p.radius_m, p.distances_m()[:, 0])
    return dict(json.loads(json.dumps(report)))


def _coverage(radius_m: Floats, error_m: Floats) -> dict[str, Any]:
    return {
        name: {
            "true": float((error_m <= radius_m[:, n]).mean()),
            "median_m": round(float(np.median(radius_m[:, n])), 3),
        }
        for n, name in enumerate(("p50", "p90"))
    }


def calibration(probability: Floats, hit: npt.NDArray[np.bool_]) -> dict[str, Any]:
    """Return the expected calibration error of probabilities [Q], over ten equal bins; `hit` [Q] are the outcomes."""
    bin_of = np.minimum((probability * CALIBRATION_BINS).astype(int), CALIBRATION_BINS - 1)
    bins = [
        {
            "from": b / CALIBRATION_BINS,
            "queries": int((bin_of == b).sum()),
            "claimed": round(float(probability[bin_of == b].mean()), DIGITS),
            "true": float(hit[bin_of == b].mean()),
        }
        for b in range(CALIBRATION_BINS)
        if (bin_of == b).any()
    ]
    error = sum(abs(b["claimed"] - b["true"]) * b["queries"] for b in bins) / len(hit)
    mean = round(float(probability.mean()), DIGITS)
    return {"mean_probability": mean, "expected_calibration_error": round(float(error), DIGITS), "bins": bins}


def _intervals(p: Predictions, errors_m: Floats) -> dict[str, Any]:
    retrieval, localization = retrieval_hits(p.ranked, p.queried_cells), localization_hits(errors_m)
    hits = np.column_stack([*retrieval.values(), *(hit for by in localization.values() for hit in by.values())])
    total = len(hits)
    rng = np.random.default_rng(RESAMPLE_SEED)
    drawn = [rng.multinomial(total, np.full(total, 1 / total)) @ hits for _ in range(RESAMPLES)]
    low, high = np.percentile(np.array(drawn) / total, INTERVAL_PERCENTILES, axis=0).round(6)
    ranges = iter(zip(low.tolist(), high.tolist(), strict=True))
    return {
        "level": 0.95,
        "retrieval": {k: next(ranges) for k in retrieval},
        "localization": {k: {radius: next(ranges) for radius in by} for k, by in localization.items()},
    }


def _group_recalls(groups: npt.NDArray[np.str_], p: Predictions, errors_m: Floats) -> dict[str, Any]:
    """Return the recalls of each group of queries; nothing for a single group without name."""
    names = np.unique(groups).tolist()
    if names == [""]:
        return {}
    recalls = {}
    for name in names:
        rows = groups == name
        recalls[name] = {
            "queries": int(rows.sum()),
            "retrieval": retrieval_recall(p.ranked[rows], p.queried_cells[rows]),
            "localization": localization_recall(errors_m[rows]),
        }
    return recalls


def _quantiles(errors_m: Floats) -> dict[str, float | None]:
    """Return quantiles of the first prediction's error, metres; None where it is in another scene."""
    quantiles = np.quantile(errors_m, [0.25, 0.5, 0.75, 0.9], method="higher")
    return {
        f"p{share}": round(float(q), DIGITS) if np.isfinite(q) else None
        for share, q in zip((25, 50, 75, 90), quantiles, strict=True)
    }


def _chance(p: Predictions) -> dict[str, Any]:
    total = len(p.cell_ids)
    near = np.zeros((len(p.queried_cells), len(LOCALIZATION_RADII_M)))
    for row, position in enumerate(p.positions_m):
        distance = np.hypot(*(p.cell_centers_m - position).T)
        distance[p.cell_scenes != p.scenes[row]] = np.inf
        near[row] = [(distance <= radius).mean() for radius in LOCALIZATION_RADII_M]
    known = float((p.queried_cells >= 0).mean())
    return {
        "retrieval": {k: min(1.0, k / total) * known for k in RETRIEVAL_KS},
        "localization": {
            k: {r: float((1 - (1 - near[:, i]) ** k).mean()) for i, r in enumerate(LOCALIZATION_RADII_M)}
            for k in LOCALIZATION_KS
        },
    }
