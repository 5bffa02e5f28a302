"""Descriptions with known positions, as they are asked; and all that can be said at positions, as it is trained on."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from models.city.cells import CellTable, cut_cubes
from models.city.gallery import Gallery
from models.city.hints import BEST_CELL_REACH_M, HintTable, hint_table
from models.city.points import PointTable
from models.city.store.pose_store import PoseStore
from models.city.types import CityMap, Floats, Hint, Pose
from models.language.hints_text import render_hint

APART_M = 1e6  # between scenes, on an axis of their own


@dataclass(frozen=True, slots=True, eq=False)
class Queries:
    """Q descriptions with known positions.

    Attributes:
        sentences: each description's hint sentences, in the benchmark's wording unless they are someone's own.
        positions_m: [Q, 2] float64 true positions, map frame.
        truth: [Q] row of the best cell, -1 if no centre is within 15 m of the position.
        scenes: scene of each query; what is found in another is wrong wherever it lies.
        strategies: how the hints were chosen, "" if that is not known.
        hints: what the sentences say; None where only text is known.
    """

    sentences: Sequence[tuple[str, ...]]
    positions_m: Floats
    truth: npt.NDArray[np.intp]
    scenes: Sequence[str]
    strategies: Sequence[str]
    hints: Sequence[tuple[Hint, ...]] | None = None

    @classmethod
    def of_poses(cls, poses: Sequence[Pose], cells: CellTable) -> "Queries":
        """Poses of a map."""
        row = {cell_id: n for n, cell_id in enumerate(cells.ids)}
        truth = np.array([row[pose.cell_id] for pose in poses])
        positions_m = np.array([pose.position_m[:2] for pose in poses], dtype=np.float64)
        return cls._of_hints(
            [pose.description.hints for pose in poses], positions_m, truth, cells, [pose.strategy for pose in poses]
        )

    @classmethod
    def of_store(cls, store: PoseStore, cells: CellTable) -> "Queries":
        """The poses of a data set, against its cells."""
        poses = store.poses
        hints = [poses.hints(q) for q in range(len(poses))]
        return cls._of_hints(hints, poses.positions_m[:, :2], poses.cell.astype(np.intp), cells, poses.strategies)

    @classmethod
    def of_text(cls, sentences: Sequence[tuple[str, ...]], positions_m: Floats, cells: CellTable) -> "Queries":
        """Queries of one's own; a description's best cell is the one whose centre is nearest.

        Args:
            sentences: each description's hint sentences.
            positions_m: [Q, 2] where they were said, map frame.
            cells: the gallery.
        """
        distance, nearest = cKDTree(cells.center_m[:, :2]).query(positions_m)
        scenes = [cells.scenes[n] for n in nearest]
        truth = np.where(distance <= BEST_CELL_REACH_M, nearest, -1)
        return cls(sentences, positions_m, truth, scenes, [""] * len(sentences))

    @classmethod
    def _of_hints(
        cls,
        hints: Sequence[tuple[Hint, ...]],
        positions_m: Floats,
        truth: npt.NDArray[np.intp],
        cells: CellTable,
        strategies: Sequence[str],
    ) -> "Queries":
        sentences = [tuple(render_hint(hint) for hint in said) for said in hints]
        return cls(sentences, positions_m, truth, [cells.scenes[n] for n in truth], strategies, hints)

    def __len__(self) -> int:
        return len(self.truth)

    def take(self, rows: npt.NDArray[np.intp]) -> "Queries":
        """Some of them."""
        return Queries(
            sentences=[self.sentences[q] for q in rows],
            positions_m=self.positions_m[rows],
            truth=self.truth[rows],
            scenes=[self.scenes[q] for q in rows],
            strategies=[self.strategies[q] for q in rows],
            hints=None if self.hints is None else [self.hints[q] for q in rows],
        )


@dataclass(frozen=True, slots=True, eq=False)
class Statements:
    """Positions, and everything that can be said at each of them.

    Attributes:
        gallery: the cells around them.
        positions_m: [N, 2 or more] positions; those of different scenes are far from each other.
        best: [N] best cell of each position.
        table: what can be said there.
        labels: label of each instance that the table names.
        words: colour words that the table numbers.
        part_number: [R] number of each instance, in rows of the cells' parts; parts of one instance share it.
        said_number: [H] number of the instance that each row of the table means, -1 if unknown.
    """

    gallery: Gallery
    positions_m: Floats
    best: npt.NDArray[np.intp]
    table: HintTable
    labels: Sequence[str]
    words: tuple[str, ...]
    part_number: npt.NDArray[Any]
    said_number: npt.NDArray[Any]

    @classmethod
    def of_map(cls, city_map: CityMap, points: PointTable, gallery: Gallery, positions_m: Floats) -> "Statements":
        """Positions of a map, [N, 3] metres; those further than 15 m from every centre are left out."""
        distance, best = cKDTree(gallery.cells.center_m).query(positions_m)
        near = distance <= BEST_CELL_REACH_M
        positions = positions_m[near]
        table = hint_table(city_map.palette, cut_cubes(points, positions, city_map.rules), positions)
        words, part_number = city_map.palette.words, gallery.cells.parts.instance
        return cls(gallery, positions[:, :2], best[near], table, gallery.labels, words, part_number, table.instance)

    @classmethod
    def of_store(cls, store: PoseStore, gallery: Gallery) -> "Statements":
        """The poses of a data set; what is said there is what their descriptions say."""
        poses, said = store.poses, store.poses.instance
        scene = np.unique(gallery.cells.scenes, return_inverse=True)[1][poses.cell]
        return cls(
            gallery=gallery,
            positions_m=np.column_stack([poses.positions_m[:, :2], scene * APART_M]),
            best=poses.cell.astype(np.intp),
            # in the order in which they were said
            table=HintTable(poses.starts, poses.label, poses.direction, poses.colour, np.arange(float(len(said)))),
            labels=poses.words,
            words=poses.words,
            part_number=store.instance_ids,
            said_number=np.where(said >= 0, store.instance_ids[said], -1),
        )
