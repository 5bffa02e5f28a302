"""Recall on queries with known answers, by the protocol of kitti360pose.md, beside chance and ambiguity."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_array

from index.store import FaissStore
from models.city.cells import CellTable, cut_cells
from models.city.hints import describe_poses, hint_table, sample_positions
from models.city.osm import load_osm
from models.city.points import PointTable
from models.city.regions import SPLITS, split_regions
from models.city.types import DIRECTIONS, CityMap, Pose
from models.errors import MapError
from models.language.hints_text import render_hint
from models.retrieval.instance_encoder import CellFeatures
from models.retrieval.retriever import Retriever
from models.training.metrics import (
    LOCALIZATION_KS,
    LOCALIZATION_RADII_M,
    RETRIEVAL_KS,
    localization_recall,
    retrieval_recall,
)

POSE_SPACING_M = 10.0
POSE_SEED = 1  # evaluation draws nothing: the positions are the same at every run
TOP = max(*RETRIEVAL_KS, *LOCALIZATION_KS)


@dataclass(frozen=True, slots=True, eq=False)
class QuerySet:
    """A gallery and queries with known answers.

    Attributes:
        city_map: the map.
        cells: the gallery.
        poses: the queries.
        truth: [Q] row of each query's best cell.
    """

    city_map: CityMap
    cells: CellTable
    poses: list[Pose]
    truth: npt.NDArray[np.intp]

    @classmethod
    def of(cls, data: Path, split: str | None) -> "QuerySet":
        """Queries on a map.

        Args:
            data: .osm.pbf or .osm.
            split: "train", "val" or "test" for a region of the map (west, middle, east); None for all of it.

        Raises:
            MapError: the map cannot be read, the split is unknown, or nothing can be asked in it.
        """
        if split is not None and split not in SPLITS:
            raise MapError(
                f"'{split}' is no split of a map; choose one of {', '.join(SPLITS)}, or none for the whole map"
            )
        city_map = load_osm(data)
        points = PointTable.of(city_map, city_map.rules.eps_m)
        cells, locations = cut_cells(city_map, points), city_map.locations_m
        for name, region in split_regions(cells).items():
            if name == split:
                cells, locations = region.cells(cells), region.locations(locations)
        positions = sample_positions(locations, POSE_SPACING_M, np.random.default_rng(POSE_SEED))
        poses = describe_poses(city_map, points, cells, positions) if len(cells) and len(positions) else []
        if not poses:
            raise MapError(
                f"{data}: no position in split '{split}' can be described; take a larger map or another split"
            )
        row = {cell_id: n for n, cell_id in enumerate(cells.ids)}
        return cls(city_map, cells, poses, np.array([row[pose.cell_id] for pose in poses]))


def evaluate(data: Path, split: str | None, report_dir: Path | None, retriever: Retriever) -> dict[str, Any]:
    """Score a retriever on a map.

    Args:
        data: .osm.pbf or .osm.
        split: region of the map, None for all.
        report_dir: where report.json goes; None to write nothing.
        retriever: the model.

    Returns:
        The report: "cells", "queries", "retrieval" {k: recall}, "localization" {k: {metres: recall}} by the
        centre of the retrieved cell, the same of an oracle and of chance, ambiguity, and calibration.
    """
    queries = QuerySet.of(data, split)
    cells, truth = queries.cells, queries.truth
    features = CellFeatures.of(cells, np.array([i.label for i in queries.city_map.instances]))
    store = FaissStore.of(retriever.encode_cells(features))
    descriptions = [[render_hint(hint) for hint in pose.description.hints] for pose in queries.poses]
    scores, ranked = store.search(retriever.encode_descriptions(descriptions), len(cells))
    positions = np.array([pose.position_m for pose in queries.poses])
    temperatures = np.array([retriever.temperature(len(hints)) for hints in descriptions])
    report: dict[str, Any] = {
        "data": data.name,
        "split": split or "all",
        "model": retriever.name,
        "model_fingerprint": retriever.fingerprint,
        "cells": len(cells),
        "queries": len(truth),
        "retrieval": retrieval_recall(ranked[:, :TOP], truth),
        "localization": localization_recall(_errors(cells, ranked[:, :TOP], positions)),
        "oracle": localization_recall(np.repeat(_errors(cells, truth[:, None], positions), TOP, axis=1)),
        "chance": _chance(cells, positions),
        "ambiguity": _ambiguity(queries),
        "calibration": _calibration(scores / temperatures[:, None], ranked[:, 0] == truth),
    }
    report = json.loads(json.dumps(report))  # keys as they will be read: strings
    if report_dir:
        report_dir.mkdir(parents=True, exist_ok=True)
        (report_dir / "report.json").write_text(json.dumps(report, indent=2) + "\n")
    return report


def _errors(cells: CellTable, rows: npt.NDArray[Any], positions_m: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """[Q, K] metres in the plane from the centres of some cells to the true positions."""
    errors: npt.NDArray[Any] = np.linalg.norm(cells.center_m[rows, :2] - positions_m[:, None, :2], axis=2)
    return errors


def _chance(cells: CellTable, positions_m: npt.NDArray[Any]) -> dict[str, Any]:
    """Expected recall of candidates drawn at random without looking at the text."""
    total = len(cells)
    near = np.array(
        [
            [(np.hypot(*(cells.center_m[:, :2] - p[:2]).T) <= radius).mean() for radius in LOCALIZATION_RADII_M]
            for p in positions_m
        ]
    )
    return {
        "retrieval": {k: min(1.0, k / total) for k in RETRIEVAL_KS},
        "localization": {
            k: {r: float((1 - (1 - near[:, i]) ** k).mean()) for i, r in enumerate(LOCALIZATION_RADII_M)}
            for k in LOCALIZATION_KS
        },
    }


def _ambiguity(queries: QuerySet) -> dict[str, Any]:
    """How far the hints themselves tell the cells apart, whatever the model: exact matching of their symbols.

    A cell fits a hint if the same statement (direction, colour, label) is true at its centre. Cells are ranked by
    the number of hints that fit; ties count as drawn at random.
    """
    city_map, cells = queries.city_map, queries.cells
    table = hint_table(city_map, cells.parts, cells.center_m)
    number: dict[tuple[str, str | None, int], int] = {}
    words = (*city_map.palette.words, None)  # the last, for colour -1
    said = [
        number.setdefault((city_map.instances[i].label, words[c], int(d)), len(number))
        for i, c, d in zip(table.instance, table.colour, table.direction, strict=True)
    ]
    holds = csr_array((np.ones(len(said), dtype=np.float32), said, table.starts), shape=(len(cells), len(number)))
    holds.sum_duplicates()
    holds.data[:] = 1
    asked = [
        [number.get((h.label, h.colour, DIRECTIONS.index(h.direction)), -1) for h in pose.description.hints]
        for pose in queries.poses
    ]
    query = np.repeat(np.arange(len(asked)), [len(a) for a in asked])
    symbol = np.concatenate([np.array(a) for a in asked])
    known = symbol >= 0
    wanted = csr_array(
        (np.ones(known.sum(), dtype=np.float32), (query[known], symbol[known])), shape=(len(asked), len(number))
    )
    fits = (wanted @ holds.T).toarray()
    own = fits[np.arange(len(asked)), queries.truth][:, None]
    better, equal = (fits > own).sum(axis=1), (fits == own).sum(axis=1)
    return {
        "median_cells_that_fit_as_well": float(np.median(better + equal)),
        "exact_matching": {k: float(np.clip((k - better) / equal, 0, 1).mean()) for k in RETRIEVAL_KS},
    }


def _calibration(logits: npt.NDArray[Any], hit: npt.NDArray[np.bool_]) -> dict[str, float]:
    """Expected calibration error of the best candidate's probability, over ten equal bins."""
    exponential = np.exp(logits - logits.max(axis=1, keepdims=True))
    probability = exponential[:, 0] / exponential.sum(axis=1)
    bins = np.minimum((probability * 10).astype(int), 9)
    error = sum(
        abs(float(probability[bins == b].mean()) - float(hit[bins == b].mean())) * float((bins == b).mean())
        for b in range(10)
        if (bins == b).any()
    )
    return {"mean_probability": float(probability.mean()), "expected_calibration_error": error}
