"""Robustness: short, wrong, misspelt or free descriptions, and outdated maps."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from index.answering.posterior_localizer import PosteriorLocalizer
from index.answering.ranking import Ranker
from index.answering.result import CellLocalizer
from index.answering.vector_localizer import VectorLocalizer, raw_sentences
from index.evaluation.evaluation import predict
from index.evaluation.localizers import posterior_of_map, vectors_of_map
from index.evaluation.report import Table
from index.evaluation.scoring import score
from index.evaluation.trials import CANDIDATE_TRIALS, Trial, all_trials
from models.citymap.cells import CellTable, PartTable
from models.citymap.gallery import Gallery, MapData
from models.citymap.hints import direction_index
from models.citymap.point_sample import FIXED_SAMPLING, PointSampling, Sampler
from models.citymap.points import Ints, ranges
from models.citymap.queries import Queries
from models.citymap.types import DIRECTIONS, Direction, Floats, Hint, Progress
from models.errors import DataError
from models.posterior.neighbours.map_objects import MapObjects
from models.posterior.neighbours.neighbour_index import NeighbourIndex

MAX_QUERIES = 300
SEED = 0
CANDIDATE_COUNTS = (10, 20, 50, 100, 200, 500)  # sizes of the candidate set
SOURCES = ("vector index, raw text", "vector index, read and rendered", "inverted list", "both, so many of each")


def robustness(
    data: MapData, queries: Queries, vectors: VectorLocalizer, posterior: PosteriorLocalizer, progress: Progress
) -> dict[str, Any]:
    """Evaluate retriever and posterior under every trial with the same queries, and the candidates' recall.

    At most MAX_QUERIES queries are used; DataError if they have no hints.
    """
    if queries.hints is None:
        raise DataError("robustness needs the hints behind the texts; give a data set or a map with --data")
    sampled = sample_queries(queries)
    rows, candidates = [], {}
    trials = all_trials(data)
    for n, trial in enumerate(trials):
        progress("trials", n, len(trials))
        rng = np.random.default_rng(SEED)
        facts = (
            sampled.hints
            if trial.hints is None
            else nearest_hints(data, sampled.positions_m, sampled.truth, posterior.surroundings, trial.hints)
        )
        assert facts is not None
        described = replace(sampled, sentences=[trial.say(hints, rng) for hints in facts], hints=None)
        if trial.name in CANDIDATE_TRIALS:
            candidates[trial.name] = candidate_recall(described, posterior)
        damage = _damage_map(data, trial, np.random.default_rng(SEED))
        localizers = _damaged_localizers(damage, vectors, posterior) if damage else (vectors, posterior)
        trial_data = damage.data if damage else data
        retriever_scores, posterior_scores = (_evaluate(trial_data, described, each) for each in localizers)
        rows.append({"name": trial.name, "retriever": retriever_scores, "posterior": posterior_scores})
    progress("trials", len(trials), len(trials))
    return {"trials": rows, "candidates": candidates}


def _evaluate(data: MapData, queries: Queries, localizer: CellLocalizer) -> dict[str, Any]:
    report = score(predict(data, queries, localizer, lambda *_: None))
    return {key: report[key] for key in ("retrieval", "localization", "coverage", "calibration")}


def robustness_tables(results: dict[str, Any]) -> list[Table]:
    """Return the tables of trials and of candidates."""
    return [
        _trials_table(results["trials"]),
        *(candidate_table(rows, text) for text, rows in results["candidates"].items()),
    ]


def _trials_table(rows: Sequence[dict[str, Any]]) -> Table:
    recall_head = ("retriever R@1", "posterior R@1", "retriever k=1: 5/10/15 m", "posterior k=1: 5/10/15 m")
    head = ("", *recall_head, "its 90 % radius holds", "ECE")
    table_rows = []
    for row in rows:
        both = row["retriever"], row["posterior"]
        recalls = [f"{scores['retrieval']['1']:.3f}" for scores in both]
        within = ["/".join(f"{v:.3f}" for v in scores["localization"]["1"].values()) for scores in both]
        coverage = f"{row['posterior']['coverage']['p90']['true']:.3f}"
        error = f"{row['posterior']['calibration']['expected_calibration_error']:.3f}"
        table_rows.append((row["name"], *recalls, *within, coverage, error))
    return head, table_rows


def candidate_recall(queries: Queries, posterior: PosteriorLocalizer) -> list[dict[str, Any]]:
    """Return for each of SOURCES the share of queries whose best cell is among the first N candidates."""
    deepest = min(CANDIDATE_COUNTS[-1], len(posterior.gallery.cells))
    rank_of_truth = np.full((len(SOURCES), len(queries)), CANDIDATE_COUNTS[-1])
    retriever = posterior.ranker.retriever
    descriptions = ["\n".join(sentences) for sentences in queries.sentences]
    rendered = posterior.sentences(descriptions)
    for q, (raw, sentences) in enumerate(zip(raw_sentences(descriptions), rendered, strict=True)):
        texts = retriever.encode_texts([raw, sentences or raw])
        hints = posterior.chunk_reader.parse(descriptions[q : q + 1])[0]
        by_list = posterior.nodes.cell_scores(posterior.binding.bind(hints)) if hints else np.zeros(deepest)
        orders = [*posterior.ranker.search(texts, deepest)[1], np.argsort(-by_list, kind="stable")[:deepest]]
        for n, order in enumerate(orders):
            position = np.flatnonzero(order == queries.truth[q])
            rank_of_truth[n, q] = position[0] if len(position) else CANDIDATE_COUNTS[-1]
        rank_of_truth[-1, q] = rank_of_truth[1:-1, q].min()
    shares = [{str(size): float((row < size).mean()) for size in CANDIDATE_COUNTS} for row in rank_of_truth]
    return [{"source": name, "recall": share} for name, share in zip(SOURCES, shares, strict=True)]


def candidate_table(rows: Sequence[dict[str, Any]], text: str) -> Table:
    """Return the table of candidate recall for one kind of text."""
    head = (f"{text}: best cell among the first", *(f"{size}" for size in CANDIDATE_COUNTS))
    return head, [(row["source"], *(f"{row['recall'][str(size)]:.3f}" for size in CANDIDATE_COUNTS)) for row in rows]


def sample_queries(queries: Queries) -> Queries:
    """Return at most MAX_QUERIES of the queries, drawn at random."""
    rows = np.random.default_rng(SEED).permutation(len(queries))[:MAX_QUERIES]
    rows.sort()
    return queries.take(rows)


def nearest_hints(
    data: MapData, positions_m: Floats, rows: Ints, around: NeighbourIndex, count: int
) -> list[tuple[Hint, ...]]:
    """Return at most `count` hints about the objects nearest to positions [Q, 2] in cells [Q]; none for cell -1."""
    hints: list[tuple[Hint, ...]] = []
    for position, cell in zip(positions_m, rows.tolist(), strict=True):
        nodes = np.arange(around.cell_starts[cell], around.cell_starts[cell + 1]) if cell >= 0 else np.empty(0, int)
        if not len(nodes):
            hints.append(())
            continue
        nodes_m = around.positions_m(nodes)
        nearest = np.hypot(*(nodes_m - position).T).argmin()
        neighbours = around.around(nodes[[nearest]])
        offset = position - (nodes_m[nearest] - neighbours.offset_m)
        nearest = np.argsort(np.hypot(*offset.T), kind="stable")[:count]
        hints.append(tuple(_hint(data, around.objects, int(neighbours.part[k]), offset[k]) for k in nearest))
    return hints


def _hint(data: MapData, things: MapObjects, part: int, offset_m: Floats) -> Hint:
    gallery = data.gallery
    instance, rgb = things.instance[part], things.rgb[part]
    direction: Direction = DIRECTIONS[int(direction_index(offset_m))]
    return Hint(direction, gallery.labels[instance], data.palette.word(rgb))


@dataclass(frozen=True, slots=True, eq=False)
class DamagedMap:
    """An outdated map."""

    data: MapData
    is_remaining: npt.NDArray[np.bool_]  # [R] which of the original parts remain


def _damage_map(data: MapData, trial: Trial, rng: np.random.Generator) -> DamagedMap | None:
    """Return the map with instances removed or relabelled; None if it stays as it is."""
    if not trial.dropped and not trial.relabelled:
        return None
    gallery, parts = data.gallery, data.gallery.cells.parts
    # In a data set each part is an instance; its source names the whole object.
    keys = [f"{scene} {source}" for scene, source in zip(_instance_scenes(gallery), gallery.sources, strict=True)]
    number = np.unique(np.array(keys), return_inverse=True)[1]
    hit = rng.random(number.max() + 1) < max(trial.dropped, trial.relabelled)
    if trial.relabelled:
        labels = np.array(gallery.labels)
        names = np.unique(labels)
        changed = np.where(hit[number], names[rng.integers(len(names), size=len(hit))][number], labels)
        relabelled = replace(gallery, labels=tuple(changed.tolist()))
        return DamagedMap(replace(data, gallery=relabelled), np.ones(len(parts.instance), np.bool_))
    is_remaining = ~hit[number][parts.instance]
    is_remaining[parts.starts[:-1]] = True  # a cell keeps at least one part
    count = np.concatenate([[0], np.cumsum(is_remaining)])
    columns = {f.name: getattr(parts, f.name)[is_remaining] for f in fields(parts) if f.name != "starts"}
    cells = replace(
        gallery.cells,
        content=PartTable(starts=count[parts.starts], **columns),
        sample=_remaining_sampler(gallery.cells, is_remaining),
    )
    return DamagedMap(replace(data, gallery=replace(gallery, cells=cells)), is_remaining)


def _remaining_sampler(table: CellTable, is_remaining: npt.NDArray[np.bool_]) -> Sampler | None:
    sample, starts = table.sample, table.parts.starts
    if sample is None:
        return None

    def sample_remaining(cells: Ints, sampling: PointSampling = FIXED_SAMPLING) -> Floats:
        return sample(cells, sampling)[is_remaining[ranges(starts[cells], starts[cells + 1])]]

    return sample_remaining


def _instance_scenes(gallery: Gallery) -> list[str]:
    scenes = np.full(len(gallery.labels), "", dtype=object)
    scenes[gallery.cells.parts.instance] = np.array(gallery.cells.scenes, dtype=object)[gallery.cells.parts.cube]
    return scenes.tolist()


def _count_remaining_parts(objects: MapObjects, parts: PartTable, is_remaining: npt.NDArray[np.bool_]) -> Ints:
    """Return the number [P] of kept parts of each object; 0 for an instance that lost most parts."""
    if objects.are_parts:
        return is_remaining.astype(np.int32)
    remaining = np.bincount(parts.instance[is_remaining], minlength=len(objects.instance))
    return np.where(2 * remaining > objects.parts, remaining, 0).astype(np.int32)


def _damaged_localizers(
    damage: DamagedMap, vectors: VectorLocalizer, posterior: PosteriorLocalizer
) -> tuple[VectorLocalizer, PosteriorLocalizer]:
    data, ranker = damage.data, vectors.ranker
    around = posterior.surroundings
    parts = _count_remaining_parts(around.objects, posterior.gallery.cells.parts, damage.is_remaining)
    surroundings = around.take(np.arange(len(data.cells)), parts)
    encoded = Ranker.from_cells(ranker.retriever, data.cells, data.gallery.labels, ranker.depth)
    return vectors_of_map(data, encoded), posterior_of_map(posterior.weights, data, encoded, surroundings)
