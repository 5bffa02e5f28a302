"""What a model is trained on and chosen by: maps and data sets, each with training and validation parts kept apart."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from models.city.cells import CellTable, cut_cells
from models.city.hints import describe_poses, sample_positions
from models.city.osm.map import load_osm
from models.city.points import PointTable
from models.city.regions import split_regions
from models.city.store.files import load_data
from models.city.store.pose_store import PoseStore
from models.city.types import CityMap, Floats, Pose
from models.language.hints_text import render_hint
from models.language.text_encoder import TextEncoder
from models.training.retrieval_data import TrainingPlace, TrainingSet
from models.training.settings import TrainingConfig

VALIDATION_SPACING_M = 10.0


@dataclass(frozen=True, slots=True, eq=False)
class ValidationQueries:
    """Queries with known answers, in the benchmark's wording.

    Attributes:
        cells: the gallery.
        labels: [I] label of each instance that the cells' parts name.
        descriptions: Q lists of sentences.
        positions_m: [Q, 2 or 3] where they were said.
        truth: [Q] the best cell of each.
    """

    cells: CellTable
    labels: npt.NDArray[np.str_]
    descriptions: Sequence[Sequence[str]]
    positions_m: Floats
    truth: npt.NDArray[np.intp]

    @classmethod
    def of_map(cls, city_map: CityMap, cells: CellTable, poses: Sequence[Pose]) -> "ValidationQueries":
        """Poses of a map as queries against some of its cells."""
        row = {cell_id: n for n, cell_id in enumerate(cells.ids)}
        return cls(
            cells,
            np.array([i.label for i in city_map.instances]),
            [[render_hint(hint) for hint in pose.description.hints] for pose in poses],
            np.array([pose.position_m for pose in poses]),
            np.array([row[pose.cell_id] for pose in poses]),
        )

    @classmethod
    def of_store(cls, store: PoseStore) -> "ValidationQueries":
        """The poses of a data set as queries against its cells."""
        poses = store.poses
        said = [[render_hint(hint) for hint in poses.hints(q)] for q in range(len(poses))]
        return cls(store.cell_table(), np.array(store.labels), said, poses.positions_m, poses.cell.astype(np.intp))


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """One map or data set to train on.

    Attributes:
        training, queries: parts of it that share no cell; the second is for choosing.
        facts: what it is, for the record beside the weights.
    """

    training: TrainingSet
    queries: ValidationQueries
    facts: dict[str, Any]


def load_source(
    data: Path, encoder: TextEncoder, config: TrainingConfig, rng: np.random.Generator, splits: tuple[str, str]
) -> Source:
    """Read a map or a data set.

    Args:
        data: an OpenStreetMap file, of which the west is trained on and the strip beside it chosen by; or a directory
            in KITTI360Pose's layout or a converted store.
        encoder: the frozen text encoder.
        config: says how densely a map is described, and in which words.
        rng: draws positions in a map.
        splits: of a data set: what is trained on and what is chosen by, each a standard split or a comma list of
            scenes.

    Raises:
        MapError, DataError: it cannot be read, or has no such splits.
    """
    if not data.is_dir():
        return source_of_map(load_osm(data), encoder, config, rng)
    training, asked = (load_data(data, split) for split in splits)
    facts = {
        "data": data.resolve().name,
        "scenes": {s: [n.name for n in p.scenes] for s, p in zip(splits, (training, asked), strict=True)},
    }
    return Source(
        TrainingSet(TrainingPlace.of_store(training), encoder, config.wording), ValidationQueries.of_store(asked), facts
    )


def source_of_map(city_map: CityMap, encoder: TextEncoder, config: TrainingConfig, rng: np.random.Generator) -> Source:
    """The west of a map to train on, the strip beside it to choose by; arguments as `load_source`."""
    points = PointTable.of(city_map, city_map.rules.eps_m)
    cells = cut_cells(city_map, points)
    regions = split_regions(cells)
    west, strip = regions["train"], regions["val"]
    positions = sample_positions(west.locations(city_map.locations_m), config.spacing_m, rng)
    asked = sample_positions(strip.locations(city_map.locations_m), VALIDATION_SPACING_M, np.random.default_rng(0))
    gallery = strip.cells(cells)
    facts = {
        "data": city_map.name,
        "attribution": city_map.attribution,
        "regions": {name: [region.west_m, region.east_m] for name, region in regions.items()},
    }
    return Source(
        TrainingSet(TrainingPlace.of_map(city_map, points, west.cells(cells), positions), encoder, config.wording),
        ValidationQueries.of_map(city_map, gallery, describe_poses(city_map, points, gallery, asked)),
        facts,
    )
