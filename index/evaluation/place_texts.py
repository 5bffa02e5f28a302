"""Evaluation on texts about real places: errors and radii, of all texts and of those with each construction."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from pyproj import Geod
from scipy.stats import binomtest

from index.answering.answers import Answer
from index.answering.localizer import Localizer
from index.answering.place_reader import PlaceReader
from index.answering.query import Prior, Query
from index.evaluation.report import Table, as_markdown
from index.evaluation.scoring import calibration
from models.citymap.types import Floats, Progress
from models.errors import DataError
from models.language.languages.detect import detect_languages
from models.language.mentions.mentions import Mention
from models.language.mentions.reader import listener_wind
from models.sources.place_texts import START_SIGMA_M, PlaceText

WITHIN_M: Final = (10, 30, 100, 250)
CONSTRUCTIONS: Final = (
    "street", "corner", "address", "name", "kind", "left, right, ahead, behind", "across", "wind", "side", "block",
    "distance", "listener",
)  # fmt: skip
_EARTH = Geod(ellps="WGS84")


@dataclass(frozen=True, slots=True, eq=False)
class TextEvaluation:
    """The answers to Q texts."""

    error_m: Floats  # [Q] great-circle distance to the goal; inf without an estimate
    radius_m: Floats  # [Q, 2] p50 and p90
    probability: Floats  # [Q] of the best cell
    hit: npt.NDArray[np.bool_]  # [Q] whether the best cell is the right one


def evaluate_texts(
    localizer: Localizer, texts: Sequence[PlaceText], report_dir: Path | None, progress: Progress
) -> dict[str, Any]:
    """Localize texts with known positions; texts with a start get a prior of 800 m around it.

    The report is also written as told.json and told.md. DataError if the map has no georeference.
    """
    if not localizer.frame.is_georeferenced:
        raise DataError(
            "the index has no georeference, so positions in degrees are not on it; index an OpenStreetMap file"
        )
    report: dict[str, Any] = {"data": localizer.manifest.map_name, "texts": len(texts)}
    evaluation = ask(localizer, texts, progress)
    report |= _summarize(evaluation, np.ones(len(texts), np.bool_))
    places = localizer.posterior.places
    report["by_construction"] = {}
    if places is not None:
        constructions = [_constructions(places, text) for text in texts]
        for name in CONSTRUCTIONS:
            rows = np.array([name in names for names in constructions])
            if rows.any():
                report["by_construction"][name] = _summarize(evaluation, rows)
    if report_dir:
        report_dir.mkdir(parents=True, exist_ok=True)
        (report_dir / "told.json").write_text(json.dumps(report, indent=1) + "\n")
        (report_dir / "told.md").write_text("\n\n".join(as_markdown(table) for table in text_tables(report)) + "\n")
    return report


def ask(localizer: Localizer, texts: Sequence[PlaceText], progress: Progress) -> TextEvaluation:
    """Localize texts."""
    rows = []
    for n, text in enumerate(texts):
        progress("ask", n, len(texts))
        [answer] = localizer.localize([query_of(text)])
        rows.append(_row(localizer, text, answer))
    progress("ask", len(texts), len(texts))
    error, p50, p90, probability, hit = np.array(rows, dtype=np.float64).T
    return TextEvaluation(error, np.stack([p50, p90], axis=1), probability, hit > 0)


def query_of(text: PlaceText) -> Query:
    """Return the query of a text; one with a start has a listener there, and a prior around it."""
    if text.start is None:
        return Query(text.text)
    start = text.start[1], text.start[0]
    return Query(text.text, prior=Prior(start, START_SIGMA_M), listener=start, crs="wgs84")


def _row(localizer: Localizer, text: PlaceText, answer: Answer) -> tuple[float, float, float, float, bool]:
    estimate = answer.estimate
    if estimate is None or estimate.wgs84 is None:
        extent_m = localizer.gallery.cells.extent_m
        return np.inf, extent_m, extent_m, 0.0, False
    if text.goal is None:
        return np.inf, estimate.radius_m.p50, estimate.radius_m.p90, estimate.probability, False
    lat, lon = text.goal
    error = _EARTH.inv(estimate.wgs84.lon, estimate.wgs84.lat, lon, lat)[2]
    goal_m = localizer.frame.from_wgs84(lat, lon)
    nearest = int(np.hypot(*(localizer.gallery.cells.center_m[:, :2] - goal_m).T).argmin())
    hit = answer.candidates[0].cell_id == localizer.gallery.cells.ids[nearest]
    return error, estimate.radius_m.p50, estimate.radius_m.p90, estimate.probability, hit


def _constructions(places: PlaceReader, text: PlaceText) -> set[str]:
    mentions = places.read(text.text, detect_languages(text.text), to_listener=text.start is not None)
    names = {name for mention in mentions for name in constructions_of(mention)}
    return names | ({"listener"} if text.start is not None and listener_wind(text.text) is not None else set())


def constructions_of(mention: Mention) -> set[str]:
    """Return which of `CONSTRUCTIONS` a mention has."""
    cue, names = mention.cue, set[str]()
    if mention.form in ("corner", "span"):
        names.add("corner")
    elif mention.form == "thing":
        names.add("kind" if mention.kinds and not mention.is_exact and mention.trust == 1.0 else "name")
    elif mention.form in ("street", "address"):
        names.add(mention.form)
    if cue.relation in ("across", "block"):
        names.add(cue.relation)
    optional = {
        "left, right, ahead, behind": cue.angle,
        "wind": cue.wind,
        "distance": cue.distance_m,
        "side": mention.side,
    }
    return names | {name for name, value in optional.items() if value is not None}


def _summarize(evaluation: TextEvaluation, rows: npt.NDArray[np.bool_]) -> dict[str, Any]:
    error, radius, count = evaluation.error_m[rows], evaluation.radius_m[rows], int(rows.sum())
    inside_count = {name: int((error <= radius[:, n]).sum()) for n, name in enumerate(("p50", "p90"))}
    median = float(np.median(error))
    return {
        "texts": count,
        "within": {str(m): round(float((error <= m).mean()), 4) for m in WITHIN_M},
        "median_m": round(median, 2) if np.isfinite(median) else None,
        "coverage": {
            name: {
                "true": round(inside / count, 4),
                "interval": [round(v, 4) for v in binomtest(inside, count).proportion_ci(0.95, "wilson")],
                "median_m": round(float(np.median(radius[:, n])), 2),
            }
            for n, (name, inside) in enumerate(inside_count.items())
        },
        "calibration": calibration(evaluation.probability[rows], evaluation.hit[rows]),
    }


def text_tables(report: dict[str, Any]) -> list[Table]:
    """Return the report as tables: all texts, then the texts with each construction."""
    head = ("", "texts", "within 10/30/100/250 m", "median", "90 % radius holds", "its median", "ECE")
    rows = [("all", *_row_cells(report))]
    rows += [(name, *_row_cells(figures)) for name, figures in report["by_construction"].items()]
    return [(head, rows)]


def _row_cells(figures: dict[str, Any]) -> tuple[str, ...]:
    p90 = figures["coverage"]["p90"]
    low, high = p90["interval"]
    median = figures["median_m"]
    return (
        f"{figures['texts']}",
        "/".join(f"{share:.3f}" for share in figures["within"].values()),
        "-" if median is None else f"{median:.1f} m",
        f"{p90['true']:.3f} ({low:.2f}-{high:.2f})",
        f"{p90['median_m']:.0f} m",
        f"{figures['calibration']['expected_calibration_error']:.3f}",
    )
