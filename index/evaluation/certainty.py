"""Calibrate the certainty of answers on texts about several cities, and check it on cities that took no part."""

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from index.answering.answers import Evidence
from index.answering.evidence import MIN_EXPLAINED, evidence_facts
from index.answering.localizer import Localizer
from index.evaluation.place_texts import WITHIN_M, query_of
from index.evaluation.report import Table
from index.evaluation.scoring import calibration
from models.checkpoint import CONFIG_FILE, SHIPPED_WEIGHTS_DIR
from models.citymap.types import Floats, Progress
from models.language.measures import compass_name
from models.posterior.certainty import Certainty, TextFacts, probability_within, radius_of
from models.posterior.model import load_posterior, save_posterior
from models.sources.place_texts import PlaceText, load_place_texts
from models.training.posterior.fit_certainty import CityTexts, fit_certainty, labelled_features

RIGHT_M: Final = 60.0  # error of the estimate up to which a corner counts as the right one
FAR_M: Final = 80.0  # farther off, an object does not have the relation that the text states ...
FAR_RELATIONS: Final = frozenset(  # ... except these
    ("far", "block", "wind", "past", "off", *(compass_name(degrees) for degrees in range(0, 360, 45)))
)


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
    """Localize texts, without calibration; those that name no place are left out."""
    error_m, shares, facts = list[float](), list[Floats](), list[TextFacts]()
    evidence, is_right = list[Floats](), list[bool]()
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
        labelled = [(item, meant) for item in result.views[0].evidence if (meant := _meant(item, text)) is not None]
        if labelled:
            rows = evidence_facts([item for item, _ in labelled])
            evidence.append(np.column_stack([np.full(len(rows), len(facts) - 1), rows]))
            is_right += [_is_right(item, meant, error_m[-1]) for item, meant in labelled]
    city, extent_m = localizer.manifest.map_name, localizer.gallery.cells.extent_m
    labels = np.concatenate([np.zeros((0, 4)), *evidence]), np.array(is_right, np.float64)
    return CityTexts(city, np.array(error_m), np.array(shares), facts, extent_m, *labels)


def _meant(item: Evidence, text: PlaceText) -> list[str | None] | None:
    """Return the objects that the writer meant with the words of evidence; None where nothing is calibrated."""
    if item.span is None or item.explained < MIN_EXPLAINED:
        return None
    start, end = item.span
    return [mention.object for mention in text.mentions if mention.start < end and start < mention.end] or None


def _is_right(item: Evidence, meant: Sequence[str | None], error_m: float) -> bool:
    if item.source_id is None:  # a corner, a span, or a house number between two others
        return error_m <= RIGHT_M
    is_near = item.away_m is None or item.away_m <= FAR_M or item.relation in FAR_RELATIONS
    return is_near and any(name is not None and name in (item.source_id, item.name) for name in meant)


def _joined(parts: Sequence[CityTexts]) -> CityTexts:
    starts = np.cumsum([0, *(len(part.facts) for part in parts)])[:-1]
    return replace(
        parts[0],
        error_m=np.concatenate([part.error_m for part in parts]),
        shares=np.concatenate([part.shares for part in parts]),
        facts=[facts for part in parts for facts in part.facts],
        evidence=np.concatenate([np.add(part.evidence, [n, 0, 0, 0]) for n, part in zip(starts, parts, strict=True)]),
        is_right=np.concatenate([part.is_right for part in parts]),
    )


def measure(certainty: Certainty, city: CityTexts) -> dict[str, Any]:
    """Return how often the radii contain the truth, and the Brier scores of the probabilities of being within."""
    curves = [certainty.curve(*each) for each in zip(city.shares, city.facts, strict=True)]
    radii = np.array([[min(radius_of(curve, p), city.extent_m) for p in (0.5, 0.9)] for curve in curves])
    claimed = np.array([[probability_within(curve, metres) for metres in WITHIN_M] for curve in curves])
    explained = certainty.explained(labelled_features(certainty, city))
    hit = city.error_m[:, None] <= np.array(WITHIN_M)
    return {
        "texts": len(city.error_m),
        "within": dict(zip(map(str, WITHIN_M), hit.mean(axis=0).round(4).tolist(), strict=True)),
        "p50_holds": round(float((city.error_m <= radii[:, 0]).mean()), 4),
        "p90_holds": round(float((city.error_m <= radii[:, 1]).mean()), 4),
        "median_p90_m": round(float(np.median(radii[:, 1])), 1),
        "brier": dict(zip(map(str, WITHIN_M), ((claimed - hit) ** 2).mean(axis=0).round(4).tolist(), strict=True)),
        "evidence_error": calibration(explained, city.is_right > 0)["expected_calibration_error"]
        if len(explained)
        else None,
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
