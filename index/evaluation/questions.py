"""Evaluation of follow-up questions with simulated people, who say little and answer from the map."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np

from index.answering.localizer import Localizer
from index.answering.query import Query
from index.evaluation.report import Table
from index.evaluation.simulated_person import MapTruth, SimulatedPerson
from models.citymap.queries import Queries
from models.citymap.templates import render_hint
from models.citymap.types import Progress
from models.errors import DataError
from models.sources.source import Source

MAX_QUESTIONS: Final = 3
HINTS_PER_TEXT: Final = 2
WITHIN_M: Final = 10.0


@dataclass(slots=True)
class Dialogue:
    """The answers to one text after each question; the last answer counts if no question follows."""

    error_m: list[float] = field(default_factory=list)  # infinite in another scene and without estimate
    probability: list[float] = field(default_factory=list)  # of the best cell
    is_ok: list[bool] = field(default_factory=list)
    kinds: list[str] = field(default_factory=list)


def hold_dialogue(localizer: Localizer, text: str, person: SimulatedPerson, scene: str) -> Dialogue:
    """Localize a text and answer up to MAX_QUESTIONS questions."""
    query, dialogue = Query(text), Dialogue()
    scenes = dict(zip(localizer.gallery.cells.ids, localizer.gallery.cells.scenes, strict=True))
    while True:
        [answer] = localizer.localize([query])
        error = float(np.hypot(*(answer.estimate.position - person.position_m))) if answer.estimate else np.inf
        is_there = bool(answer.candidates) and scenes[answer.candidates[0].cell_id] == scene
        dialogue.error_m.append(error if is_there else np.inf)
        dialogue.probability.append(answer.estimate.probability if answer.estimate else 0.0)
        dialogue.is_ok.append(answer.status == "ok")
        if answer.question is None or len(query.replies) == MAX_QUESTIONS:
            return dialogue
        dialogue.kinds.append(answer.question.id.split(":")[0])
        query = replace(query, replies=(*query.replies, person.reply(answer.question)))


def vague_texts(queries: Queries, rows: Sequence[int], rng: np.random.Generator, *, is_plain: bool) -> list[str]:
    """Return texts of two hints of some queries, in template words or in plain ones without direction and colour."""
    assert queries.hints is not None
    texts = []
    for row in rows:
        hints = queries.hints[row]
        chosen = [hints[n] for n in rng.permutation(len(hints))[:HINTS_PER_TEXT]]
        if is_plain:
            texts.append(f"There is a {chosen[0].label} near me, and a {chosen[-1].label}.")
        else:
            texts.append(" ".join(render_hint(hint) for hint in chosen))
    return texts


def evaluate_questions(
    localizer: Localizer, source: Source, texts: int, seed: int, progress: Progress, *, is_plain: bool = False
) -> dict[str, Any]:
    """Describe random positions by two hints and answer the questions; DataError if the index has other cells.

    With `is_plain`, hints have classes only, without directions and colours.
    """
    if localizer.gallery.cells.ids != source.data.cells.ids:
        raise DataError("the index has other cells than the data; build the index with the same --split")
    rng, gazetteer = np.random.default_rng(seed), source.gazetteer()
    queries = source.queries(seed)
    rows = rng.permutation(len(queries))[:texts]
    descriptions = vague_texts(queries, rows.tolist(), rng, is_plain=is_plain)
    truth = MapTruth(source.geometry(), source.data.gallery, source.data.palette, gazetteer)
    scenes = {scene: n for n, scene in enumerate(sorted(set(source.data.cells.scenes)))}
    dialogues = []
    for n, (row, text) in enumerate(zip(rows.tolist(), descriptions, strict=True)):
        progress("ask", n, len(rows))
        scene = queries.scenes[row]
        person = SimulatedPerson(truth, scenes[scene], queries.positions_m[row], rng)
        dialogues.append(hold_dialogue(localizer, text, person, scene))
    progress("ask", len(rows), len(rows))
    return {"data": source.data.name, "texts": len(dialogues), "seed": seed, **_summarize(dialogues)}


def _summarize(dialogues: Sequence[Dialogue]) -> dict[str, Any]:
    after = []
    for count in range(MAX_QUESTIONS + 1):
        last = [min(count, len(one.error_m) - 1) for one in dialogues]
        error = np.array([one.error_m[n] for one, n in zip(dialogues, last, strict=True)])
        median = float(np.median(error))
        after.append({
            "questions": count,
            "asked": sum(len(one.kinds) >= count for one in dialogues) if count else 0,
            "within_10_m": float((error <= WITHIN_M).mean()),
            "median_m": median if np.isfinite(median) else None,
            "probability": float(np.mean([one.probability[n] for one, n in zip(dialogues, last, strict=True)])),
            "ok": float(np.mean([one.is_ok[n] for one, n in zip(dialogues, last, strict=True)])),
        })  # fmt: skip
    kinds = [kind for one in dialogues for kind in one.kinds]
    return {"after": after, "kinds": {kind: kinds.count(kind) for kind in sorted(set(kinds))}}


def questions_table(report: dict[str, Any]) -> Table:
    """Return the report as a table."""
    head: tuple[str, ...] = ("questions", "asked", "within 10 m", "median", "probability", "ok")
    rows: list[tuple[str, ...]] = [
        (
            f"{row['questions']}",
            f"{row['asked']}",
            f"{row['within_10_m']:.3f}",
            "-" if row["median_m"] is None else f"{row['median_m']:.0f} m",
            f"{row['probability']:.3f}",
            f"{row['ok']:.3f}",
        )
        for row in report["after"]
    ]
    return head, rows
