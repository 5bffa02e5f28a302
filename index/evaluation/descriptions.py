"""Measuring descriptions: whether a position is found again by what the map says there."""

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
AT_ONCE: Final = 50  # descriptions that are localized together; no more answers are held
NOTHING_SAID: Final = (0, np.inf, False, False)


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """What was found at P positions.

    Attributes:
        words: [P] of the description; 0 where there is nothing to say.
        error_m: [P] from the position to the estimate; inf in another scene, and without one.
        is_ok: [P] whether the answer's status is "ok".
        is_held: [P] whether the circle that is to hold .9 of such positions holds this one.
    """

    words: npt.NDArray[np.int64]
    error_m: Floats
    is_ok: npt.NDArray[np.bool_]
    is_held: npt.NDArray[np.bool_]


def draw_positions(localizer: Localizer, count: int, rng: np.random.Generator) -> Floats:
    """[P, 2] a position in each of so many cells, or in all if there are fewer, anywhere in the square that it owns.

    Centres lie on a grid over where one can walk (docs/formats.md, rule 4), and its squares fill the map up to some
    metres beside that, walls and all: where the page's map can be clicked with sense.
    """
    centers_m, half_m = localizer.gallery.cells.center_m[:, :2], localizer.manifest.grid_m / 2
    drawn = rng.permutation(centers_m)[:count]
    return drawn + rng.uniform(-half_m, half_m, drawn.shape)


def evaluate_descriptions(localizer: Localizer, positions: int, seed: int, progress: Progress) -> dict[str, Any]:
    """Describe random positions of an index, and localize what was said.

    Args:
        localizer: of the index.
        positions: how many; see `draw_positions`.
        seed: of them.
        progress: called as the work goes on.

    Returns:
        "data", "positions", "seed"; shares of all positions, of which nothing is found where nothing can be said:
        "described", "within" {metres: share}, "ok", "held" (by the 90 % radius); "median_m", None if that is in
        another scene or nowhere; and "words", the median of a description, None without any.
    """
    drawn = draw_positions(localizer, positions, np.random.default_rng(seed))
    found = find_again(localizer, drawn, progress)
    said, median_m = found.words[found.words > 0], float(np.median(found.error_m))
    return {
        "data": localizer.manifest.map_name,
        "positions": len(drawn),
        "seed": seed,
        "described": len(said) / len(drawn),
        "within": {str(metres): float((found.error_m <= metres).mean()) for metres in WITHIN_M},
        "median_m": median_m if np.isfinite(median_m) else None,
        "ok": float(found.is_ok.mean()),
        "held": float(found.is_held.mean()),
        "words": float(np.median(said)) if len(said) else None,
    }


def find_again(localizer: Localizer, positions_m: Floats, progress: Progress) -> Found:
    """Describe positions [P, 2], metres, map frame, and localize the descriptions."""
    scenes = dict(zip(localizer.gallery.cells.ids, localizer.gallery.cells.scenes, strict=True))
    rows: list[tuple[int, float, bool, bool]] = []
    for start in range(0, len(positions_m), AT_ONCE):
        progress("ask", start, len(positions_m))
        some_m = positions_m[start : start + AT_ONCE]
        said = [localizer.describe((x, y)) for x, y in some_m.tolist()]
        answers = iter(localizer.localize([Query(one.description) for one in said if one is not None]))
        rows += [
            NOTHING_SAID if one is None else _row(one, next(answers), position, scenes)
            for one, position in zip(said, some_m, strict=True)
        ]
    progress("ask", len(positions_m), len(positions_m))
    words, error_m, is_ok, is_held = (np.array(column) for column in zip(*rows, strict=True))
    return Found(words, error_m, is_ok, is_held)


def _row(said: Described, answer: Answer, position: Floats, scenes: Mapping[str, str]) -> tuple[int, float, bool, bool]:
    words, estimate, is_ok = len(said.description.split()), answer.estimate, answer.status == "ok"
    if estimate is None:
        return words, np.inf, is_ok, False
    metres = float(np.hypot(*(estimate.position - position)))
    # as in other reports: errors are by scene, a circle holds what is in it
    is_there = scenes[answer.candidates[0].cell_id] == scenes[said.cell_id]
    return words, metres if is_there else np.inf, is_ok, metres <= estimate.radius_m.p90


def descriptions_table(report: dict[str, Any]) -> Table:
    """The report as a table."""
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
