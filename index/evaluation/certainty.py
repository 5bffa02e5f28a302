"""Calibrate the certainty of answers on texts about several cities, and check it on cities that took no part."""

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from index.answering.localizer import Localizer
from index.evaluation.place_texts import WITHIN_M, query_of
from index.evaluation.report import Table
from models.checkpoint import CONFIG_FILE, SHIPPED_WEIGHTS_DIR
from models.citymap.types import Progress
from models.posterior.certainty import Certainty, probability_within, radius_of
from models.posterior.model import load_posterior, save_posterior
from models.sources.place_texts import PlaceText, load_place_texts
from models.training.posterior.fit_certainty import CityTexts, fit_certainty


def calibrate_certainty(
    cities: Sequence[tuple[Path, Sequence[Path]]], weights: Path | None, out: Path, progress: Progress
) -> dict[str, Any]:
    """Fit the certainty to texts about cities, and save the weights with it.

    Args:
        cities: index directories, each with files of texts about it (`load_place_texts`).
        weights: of the posterior; None for the shipped ones. May be the same as `out`.
        out: directory for model.safetensors and config.json.
        progress: called with a stage, texts done, and their number.

    Returns:
        Figures by city, as `measure`, by a certainty that was fitted to the other cities only.

    Raises:
        IndexBroken, IndexMismatch, WeightsError, DataError: an input cannot be read.
    """
    parts = []
    for index_dir, files in cities:
        localizer = Localizer.open(index_dir)
        texts = [text for file in files for text in load_place_texts(file)]
        parts.append(read_city(localizer, texts, progress))
    names = list(dict.fromkeys(part.city for part in parts))
    figures = {
        name: measure(fit_certainty([part for part in parts if part.city != name]), part)
        for name in names
        for part in [_joined([part for part in parts if part.city == name])]
    }
    model = load_posterior(weights)
    record = json.loads(((weights or SHIPPED_WEIGHTS_DIR / "posterior") / CONFIG_FILE).read_text())["training"]
    model.config = model.config.model_copy(update={"certainty": fit_certainty(parts)})
    save_posterior(model, out, record | {"certainty": {"leave_one_out": figures}})
    return figures


def read_city(localizer: Localizer, texts: Sequence[PlaceText], progress: Progress) -> CityTexts:
    """Localize texts without calibration; those that name no place are left out."""
    error_m, shares, facts = [], [], []
    for n, text in enumerate(texts):
        progress(localizer.manifest.map_name, n, len(texts))
        [result] = localizer.posterior.find([query_of(text)])
        located = result.located
        if located is None or located.facts is None:
            continue
        goal_m = None if text.goal is None else localizer.frame.from_wgs84(*text.goal)
        error_m.append(np.inf if goal_m is None else float(np.hypot(*(located.positions[0] - goal_m))))
        shares.append(located.shares)
        facts.append(located.facts)
    city, extent_m = localizer.manifest.map_name, localizer.gallery.cells.extent_m
    return CityTexts(city, np.array(error_m), np.array(shares), facts, extent_m)


def _joined(parts: Sequence[CityTexts]) -> CityTexts:
    return replace(
        parts[0],
        error_m=np.concatenate([part.error_m for part in parts]),
        shares=np.concatenate([part.shares for part in parts]),
        facts=[facts for part in parts for facts in part.facts],
    )


def measure(certainty: Certainty, city: CityTexts) -> dict[str, Any]:
    """Return how often the radii contain the truth, and the Brier scores of the probabilities of being within."""
    curves = [certainty.curve(*each) for each in zip(city.shares, city.facts, strict=True)]
    radii = np.array([[min(radius_of(curve, p), city.extent_m) for p in (0.5, 0.9)] for curve in curves])
    claimed = np.array([[probability_within(curve, metres) for metres in WITHIN_M] for curve in curves])
    hit = city.error_m[:, None] <= np.array(WITHIN_M)
    return {
        "texts": len(city.error_m),
        "within": dict(zip(map(str, WITHIN_M), hit.mean(axis=0).round(4).tolist(), strict=True)),
        "p50_holds": round(float((city.error_m <= radii[:, 0]).mean()), 4),
        "p90_holds": round(float((city.error_m <= radii[:, 1]).mean()), 4),
        "median_p90_m": round(float(np.median(radii[:, 1])), 1),
        "brier": dict(zip(map(str, WITHIN_M), ((claimed - hit) ** 2).mean(axis=0).round(4).tolist(), strict=True)),
    }


def certainty_table(figures: dict[str, Any]) -> Table:
    """Return the figures as a table."""
    head = ("city left out", "texts", "within 10/30/100/250 m", "50 % holds", "90 % holds", "median 90 % radius")
    return head, [
        (
            name,
            f"{row['texts']}",
            "/".join(f"{share:.2f}" for share in row["within"].values()),
            f"{row['p50_holds']:.2f}",
            f"{row['p90_holds']:.2f}",
            f"{row['median_p90_m']:.0f} m",
        )
        for name, row in figures.items()
    ]
