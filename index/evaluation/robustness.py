"""How answers hold when descriptions are short, wrong, misspelt or worded freely, and when the map is out of date."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from index.answering.posterior_localizer import PosteriorLocalizer
from index.answering.ranking import Ranker
from index.answering.result import CellLocalizer
from index.answering.vector_localizer import VectorLocalizer
from index.evaluation.candidates import candidate_recall, candidate_table
from index.evaluation.evaluation import predict
from index.evaluation.localizers import posterior_of_map, vectors_of_map
from index.evaluation.report import Table
from index.evaluation.scoring import score
from index.evaluation.trials import CANDIDATES_OF, Trial, all_trials
from models.citymap.cells import CellTable, PartTable
from models.citymap.gallery import Gallery, MapData
from models.citymap.hints import direction_index
from models.citymap.point_sample import Sampler
from models.citymap.points import Ints, ranges
from models.citymap.queries import Queries
from models.citymap.types import DIRECTIONS, Direction, Floats, Hint, Progress
from models.errors import DataError
from models.posterior.neighbours.map_objects import MapObjects
from models.posterior.neighbours.neighbour_index import NeighbourIndex

MOST_QUERIES = 300
SEED = 0


def robustness(
    data: MapData, queries: Queries, vectors: VectorLocalizer, posterior: PosteriorLocalizer, progress: Progress
) -> dict[str, Any]:
    """Recall of retriever and posterior under every trial, the same queries in all, and where candidates come from.

    Args:
        data: the gallery.
        queries: with their hints; of many, some are taken.
        vectors: the retriever alone.
        posterior: of the same gallery.
        progress: called as the work goes on.

    Returns:
        "trials": of each "name" and, for "retriever" and "posterior", "retrieval" {k: recall}, "localization",
        "coverage" of the radii and "calibration";
        "candidates" {text: `candidate_recall`} for some of them.

    Raises:
        DataError: the queries are text alone.
    """
    if queries.hints is None:
        raise DataError("robustness needs to know what the hints mean; give a data set or a map with --data")
    some = some_of(queries)
    rows, candidates = [], {}
    trials = all_trials(data)
    for n, trial in enumerate(trials):
        progress("trials", n, len(trials))
        rng = np.random.default_rng(SEED)
        facts = (
            some.hints
            if trial.hints is None
            else nearest_hints(data, some.positions_m, some.truth, posterior.surroundings, trial.hints)
        )
        assert facts is not None
        said = replace(some, sentences=[trial.say(hints, rng) for hints in facts], hints=None)
        if trial.name in CANDIDATES_OF:
            candidates[trial.name] = candidate_recall(said, posterior)
        damage = _damage(data, trial, np.random.default_rng(SEED))
        both = _localizers(damage, vectors, posterior) if damage else (vectors, posterior)
        here = damage.data if damage else data
        rows.append(
            {"name": trial.name, "retriever": _ask(here, said, both[0]), "posterior": _ask(here, said, both[1])}
        )
    progress("trials", len(trials), len(trials))
    return {"trials": rows, "candidates": candidates}


def _ask(data: MapData, queries: Queries, localizer: CellLocalizer) -> dict[str, Any]:
    report = score(predict(data, queries, localizer, lambda *_: None))
    return {key: report[key] for key in ("retrieval", "localization", "coverage", "calibration")}


def robustness_tables(found: dict[str, Any]) -> list[Table]:
    """The trials, and the candidates of each kind of text, as `robustness` gives them."""
    return [_trials(found["trials"]), *(candidate_table(rows, text) for text, rows in found["candidates"].items())]


def _trials(rows: Sequence[dict[str, Any]]) -> Table:
    """Recall@1, and recall within 5, 10 and 15 m at k = 1, of both; how honest the posterior is."""
    recall_head = ("retriever R@1", "posterior R@1", "retriever k=1: 5/10/15 m", "posterior k=1: 5/10/15 m")
    head = ("", *recall_head, "its 90 % radius holds", "ECE")
    found = []
    for row in rows:
        recalls = [f"{row[name]['retrieval']['1']:.3f}" for name in ("retriever", "posterior")]
        within = [
            "/".join(f"{v:.3f}" for v in row[name]["localization"]["1"].values()) for name in ("retriever", "posterior")
        ]
        asked = row["posterior"]
        honest = asked["coverage"]["p90"]["true"], asked["calibration"]["expected_calibration_error"]
        found.append((row["name"], *recalls, *within, *(f"{value:.3f}" for value in honest)))
    return head, found


def some_of(queries: Queries) -> Queries:
    """Not more than MOST_QUERIES of them, drawn."""
    rows = np.random.default_rng(SEED).permutation(len(queries))[:MOST_QUERIES]
    rows.sort()
    return queries.take(rows)


def nearest_hints(
    data: MapData, positions_m: Floats, rows: Ints, around: NeighbourIndex, count: int
) -> list[tuple[Hint, ...]]:
    """Hints about the nearest things round some positions.

    Args:
        data: the map.
        positions_m: [Q, 2] map frame.
        rows: [Q] cell of each; of -1 nothing is said.
        around: surroundings of the map's cells.
        count: hints each; fewer where there are fewer things.
    """
    found: list[tuple[Hint, ...]] = []
    for position, cell in zip(positions_m, rows.tolist(), strict=True):
        nodes = np.arange(around.cell_starts[cell], around.cell_starts[cell + 1]) if cell >= 0 else np.empty(0, int)
        if not len(nodes):
            found.append(())
            continue
        nodes_m = around.positions_m(nodes)
        nearest = np.hypot(*(nodes_m - position).T).argmin()
        here = around.around(nodes[[nearest]])
        offset = position - (nodes_m[nearest] - here.way_m)
        nearest = np.argsort(np.hypot(*offset.T), kind="stable")[:count]
        found.append(tuple(_hint(data, around.things, int(here.part[k]), offset[k]) for k in nearest))
    return found


def _hint(data: MapData, things: MapObjects, part: int, offset_m: Floats) -> Hint:
    gallery = data.gallery
    instance, rgb = things.instance[part], things.rgb[part]
    direction: Direction = DIRECTIONS[int(direction_index(offset_m))]
    return Hint(direction, gallery.labels[instance], data.palette.word(rgb))


@dataclass(frozen=True, slots=True, eq=False)
class Damage:
    """A map that is out of date.

    Attributes:
        data: the map.
        kept: [R] which parts of the map as it was are still there.
    """

    data: MapData
    kept: npt.NDArray[np.bool_]


def _damage(data: MapData, trial: Trial, rng: np.random.Generator) -> Damage | None:
    """The map with some instances gone, or with others' labels; None if it stays as it is."""
    if not trial.dropped and not trial.relabelled:
        return None
    gallery, parts = data.gallery, data.gallery.cells.parts
    # In a data set each part is an instance; its source names what it is a part of.
    keys = [f"{scene} {source}" for scene, source in zip(_scene_of(gallery), gallery.sources, strict=True)]
    number = np.unique(np.array(keys), return_inverse=True)[1]
    hit = rng.random(number.max() + 1) < max(trial.dropped, trial.relabelled)
    if trial.relabelled:
        labels = np.array(gallery.labels)
        names = np.unique(labels)
        changed = np.where(hit[number], names[rng.integers(len(names), size=len(hit))][number], labels)
        relabelled = replace(gallery, labels=tuple(changed.tolist()))
        return Damage(replace(data, gallery=relabelled), np.ones(len(parts.instance), np.bool_))
    kept = ~hit[number][parts.instance]
    kept[parts.starts[:-1]] = True  # a cell keeps one part at least
    count = np.concatenate([[0], np.cumsum(kept)])
    columns = {f.name: getattr(parts, f.name)[kept] for f in fields(parts) if f.name != "starts"}
    cells = replace(
        gallery.cells, content=PartTable(starts=count[parts.starts], **columns), sample=_sampler_of(gallery.cells, kept)
    )
    return Damage(replace(data, gallery=replace(gallery, cells=cells)), kept)


def _sampler_of(cells: CellTable, kept: npt.NDArray[np.bool_]) -> Sampler | None:
    """Points of the parts that are left."""
    sample, starts = cells.sample, cells.parts.starts
    return sample and (lambda chosen: sample(chosen)[kept[ranges(starts[chosen], starts[chosen + 1])]])


def _scene_of(gallery: Gallery) -> list[str]:
    """Scene of each instance."""
    scenes = np.full(len(gallery.labels), "", dtype=object)
    scenes[gallery.cells.parts.instance] = np.array(gallery.cells.scenes, dtype=object)[gallery.cells.parts.cube]
    found: list[str] = scenes.tolist()
    return found


def _localizers(
    damage: Damage, vectors: VectorLocalizer, posterior: PosteriorLocalizer
) -> tuple[VectorLocalizer, PosteriorLocalizer]:
    """Retriever and posterior of a map that differs from theirs."""
    data, ranker = damage.data, vectors.ranker
    around = posterior.surroundings
    parts = around.things.parts_among(posterior.gallery.cells.parts, damage.kept)
    surroundings = around.take(np.arange(len(data.cells)), parts)
    encoded = Ranker.of(ranker.retriever, data.cells, data.gallery.labels, ranker.depth)
    return vectors_of_map(data, encoded), posterior_of_map(posterior.weights, data, encoded, surroundings)
