"""Evaluation of descriptions: whether a described position is found again."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from index.answering.answers import Answer, Described
from index.answering.localizer import Localizer
from index.answering.query import Query
from index.evaluation.report import Table
from models.citymap.types import Floats, Progress

WITHIN_M: Final = (5, 10, 15, 30)
DESCRIPTIONS_PER_BATCH: Final = 50  # bounds the answers in memory
NO_DESCRIPTION: Final = (0, np.inf, False, False)


@dataclass(frozen=True, slots=True, eq=False)
class RoundTrips:
    """The results at P described positions."""

    words: npt.NDArray[np.int64]  # [P]; 0 without description
    error_m: Floats  # [P]; inf in another scene and without estimate
    is_ok: npt.NDArray[np.bool_]  # [P] whether the status is "ok"
    is_in_radius: npt.NDArray[np.bool_]  # [P] whether the 90 % radius contains the position


def draw_positions(localizer: Localizer, count: int, rng: np.random.Generator) -> Floats:
    """Return random positions [P, 2], each in another cell's grid square.

    Centres form a grid over the walkable area (docs/formats.md, rule 4). The squares also cover some metres around it.
    """
    centers_m, half_m = localizer.gallery.cells.center_m[:, :2], localizer.manifest.grid_m / 2
    drawn = rng.permutation(centers_m)[:count]
    return drawn + rng.uniform(-half_m, half_m, drawn.shape)


def evaluate_descriptions(localizer: Localizer, positions: int, seed: int, progress: Progress) -> dict[str, Any]:
    """Describe random positions of an index and localize the descriptions.

    The report has shares of all positions: "described", "within" {metres: share}, "ok" and "held" (by the 90 % radius);
    the median error, None if it is in another scene; and the median number of "words".
    """
    drawn = draw_positions(localizer, positions, np.random.default_rng(seed))
    round_trips = localize_descriptions(localizer, drawn, progress)
    word_counts, median_m = round_trips.words[round_trips.words > 0], float(np.median(round_trips.error_m))
    return {
        "data": localizer.manifest.map_name,
        "positions": len(drawn),
        "seed": seed,
        "described": len(word_counts) / len(drawn),
        "within": {str(metres): float((round_trips.error_m <= metres).mean()) for metres in WITHIN_M},
        "median_m": median_m if np.isfinite(median_m) else None,
        "ok": float(round_trips.is_ok.mean()),
        "held": float(round_trips.is_in_radius.mean()),
        "words": float(np.median(word_counts)) if len(word_counts) else None,
    }


def localize_descriptions(localizer: Localizer, positions_m: Floats, progress: Progress) -> RoundTrips:
    """Describe positions [P, 2], metres, map frame, and localize the descriptions."""
    scenes = dict(zip(localizer.gallery.cells.ids, localizer.gallery.cells.scenes, strict=True))
    rows: list[tuple[int, float, bool, bool]] = []
    for start in range(0, len(positions_m), DESCRIPTIONS_PER_BATCH):
        progress("ask", start, len(positions_m))
        batch_m = positions_m[start : start + DESCRIPTIONS_PER_BATCH]
        descriptions = [localizer.describe((x, y)) for x, y in batch_m.tolist()]
        answers = iter(localizer.localize([Query(one.description) for one in descriptions if one is not None]))
        rows += [
            NO_DESCRIPTION if one is None else _row(one, next(answers), position, scenes)
            for one, position in zip(descriptions, batch_m, strict=True)
        ]
    progress("ask", len(positions_m), len(positions_m))
    words, error_m, is_ok, is_in_radius = (np.array(column) for column in zip(*rows, strict=True))
    return RoundTrips(words, error_m, is_ok, is_in_radius)


def _row(
    described: Described, answer: Answer, position: Floats, scenes: Mapping[str, str]
) -> tuple[int, float, bool, bool]:
    words, estimate, is_ok = len(described.description.split()), answer.estimate, answer.status == "ok"
    if estimate is None:
        return words, np.inf, is_ok, False
    metres = float(np.hypot(*(estimate.position - position)))
    # as in other reports, errors are per scene and circles are not
    is_there = scenes[answer.candidates[0].cell_id] == scenes[described.cell_id]
    return words, metres if is_there else np.inf, is_ok, metres <= estimate.radius_m.p90


def descriptions_table(report: dict[str, Any]) -> Table:
    """Return the report as a table."""
    metres = "/".join(report["within"])
    head = ("described", f"within {metres} m", "median error", "ok", "90 % radius holds", "median words")
    row = (
        f"{report['described']:.3f}",
        "/".join(f"{share:.3f}" for share in report["within"].values()),
        "-" if report["median_m"] is None else f"{report['median_m']:.1f} m",
        f"{report['ok']:.3f}",
        f"{report['held']:.3f}",
        "-" if report["words"] is None else f"{report['words']:.0f}",
    )
    return head, [row]
