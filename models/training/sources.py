"""What a model is trained on and chosen by: maps and data sets, each with training and validation parts kept apart."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from models.city.cells import CellTable, cut_cells
from models.city.hints import describe_poses, sample_positions
from models.city.osm import load_osm
from models.city.points import PointTable
from models.city.pose_files import load_data
from models.city.pose_store import PoseStore
from models.city.regions import split_regions
from models.city.types import CityMap, Pose
from models.language.hints_text import render_hint
from models.language.text_encoder import TextEncoder
from models.retrieval.instance_encoder import CellFeatures
from models.retrieval.level_table import LevelTable
from models.retrieval.levels import Level
from models.retrieval.retriever import Retriever
from models.training.data import TrainingSet

VALIDATION_SPACING_M = 10.0


@dataclass(frozen=True, slots=True, eq=False)
class Validation:
    """Queries with known answers, in the benchmark's wording.

    Attributes:
        features: the gallery.
        descriptions: Q lists of sentences.
        truth: [Q] the best cell of each.
    """

    features: CellFeatures
    descriptions: Sequence[Sequence[str]]
    truth: npt.NDArray[np.intp]

    @classmethod
    def of_map(cls, city_map: CityMap, cells: CellTable, poses: Sequence[Pose]) -> "Validation":
        """Poses of a map as queries against some of its cells."""
        row = {cell_id: n for n, cell_id in enumerate(cells.ids)}
        return cls(
            CellFeatures.of(cells, np.array([i.label for i in city_map.instances])),
            [[render_hint(hint) for hint in pose.description.hints] for pose in poses],
            np.array([row[pose.cell_id] for pose in poses]),
        )

    @classmethod
    def of_store(cls, store: PoseStore) -> "Validation":
        """The poses of a data set as queries against its cells."""
        poses = store.poses
        return cls(
            CellFeatures.of(store.cell_table(), np.array(store.labels)),
            [[render_hint(hint) for hint in poses.hints(q)] for q in range(len(poses))],
            poses.cell.astype(np.intp),
        )

    def scores(self, retriever: Retriever) -> npt.NDArray[np.float32]:
        """[Q, N] scores by which cells are ranked."""
        return retriever.combine(Encoded(retriever, self.features).level_scores(self.descriptions))


class Encoded:
    """A gallery at all levels of a retriever.

    Args:
        retriever: the model.
        features: the cells.
    """

    def __init__(self, retriever: Retriever, features: CellFeatures) -> None:
        self.retriever, self.vectors = retriever, retriever.encode_cells(features)
        self.table = LevelTable.of(retriever, features)

    def level_scores(self, descriptions: Sequence[Sequence[str]]) -> dict[Level, npt.NDArray[np.float32]]:
        """[Q, N] similarities of descriptions with all cells, by level."""
        texts = self.retriever.encode_texts(descriptions)
        whole = np.concatenate([text.whole.cpu().numpy() for text in texts]) @ self.vectors.T
        return {**self.table.scores(texts, np.arange(len(self.vectors))), "global": whole}


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """One map or data set to train on.

    Attributes:
        training, validation: parts of it that share no cell.
        facts: what it is, for the record beside the weights.
    """

    training: TrainingSet
    validation: Validation
    facts: dict[str, Any]


def load_source(
    data: Path, encoder: TextEncoder, spacing_m: float, rng: np.random.Generator, splits: tuple[str, str]
) -> Source:
    """Read a map or a data set.

    Args:
        data: an OpenStreetMap file, of which the west is trained on and the strip beside it chosen by; or a directory
            in KITTI360Pose's layout or a converted store.
        encoder: the frozen text encoder.
        spacing_m: of an OpenStreetMap file: one training position a square of this size.
        rng: draws those.
        splits: of a data set: what is trained on and what is chosen by, each a standard split or a comma list of
            scenes.

    Raises:
        MapError, DataError: it cannot be read, or has no such splits.
    """
    if not data.is_dir():
        return source_of_map(load_osm(data), encoder, spacing_m, rng)
    training, validation = (load_data(data, split) for split in splits)
    facts = {
        "data": data.resolve().name,
        "scenes": {s: [n.name for n in p.scenes] for s, p in zip(splits, (training, validation), strict=True)},
    }
    return Source(TrainingSet.of_store(training, encoder), Validation.of_store(validation), facts)


def source_of_map(city_map: CityMap, encoder: TextEncoder, spacing_m: float, rng: np.random.Generator) -> Source:
    """The west of a map to train on, the strip beside it to choose by; arguments as `load_source`."""
    points = PointTable.of(city_map, city_map.rules.eps_m)
    cells = cut_cells(city_map, points)
    regions = split_regions(cells)
    west = regions["train"]
    positions = sample_positions(west.locations(city_map.locations_m), spacing_m, rng)
    strip = regions["val"]
    asked = sample_positions(strip.locations(city_map.locations_m), VALIDATION_SPACING_M, np.random.default_rng(0))
    gallery = strip.cells(cells)
    poses = describe_poses(city_map, points, gallery, asked)
    facts = {
        "data": city_map.name,
        "attribution": city_map.attribution,
        "regions": {name: [region.west_m, region.east_m] for name, region in regions.items()},
    }
    return Source(
        TrainingSet.of_map(city_map, points, west.cells(cells), positions, encoder),
        Validation.of_map(city_map, gallery, poses),
        facts,
    )
