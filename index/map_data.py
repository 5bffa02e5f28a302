"""Any map that can be read, as the index and the evaluation take it: a gallery, and queries with known answers."""

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from index.gallery import Gallery
from models.city.cells import CellTable, cut_cells
from models.city.colours import KITTI360_PALETTE, Palette
from models.city.frame import Frame
from models.city.hints import BEST_CELL_REACH_M, describe_poses, sample_positions
from models.city.kitti360pose.files import list_scenes, select_scenes
from models.city.osm.map import load_osm
from models.city.points import PointTable
from models.city.regions import SPLITS, split_regions
from models.city.store.files import MANIFEST, load_data
from models.city.store.pose_store import PoseStore
from models.city.types import CityMap, CutRules, Floats, Hint
from models.errors import DataError, MapError
from models.files import sha256
from models.language.hints_text import render_hint
from models.posterior.surroundings import Bodies, Surroundings

POSE_SPACING_M = 10.0
POSE_SEED = 1  # evaluation draws nothing: the positions are the same at every run
Progress = Callable[[str, int, int], None]  # stage, done, to do (0 if that is not known)


def _no_surroundings(progress: Progress) -> Surroundings:
    raise DataError("this gallery has no surroundings; ask without the posterior")


@dataclass(frozen=True, slots=True, eq=False)
class MapData:
    """A map, some of its scenes, or a region of it.

    Attributes:
        name: of the map.
        split: what was taken of it; "all" for everything, "index" for what an index holds.
        gallery: its cells and what is in them.
        palette: its colour words.
        frame: what its metres mean on Earth.
        grid_m: distance between neighbouring cells.
        attribution: what the data's licence asks to show.
        around: makes or reads its surroundings, which only the hint posterior needs.
    """

    name: str
    split: str
    gallery: Gallery
    palette: Palette
    frame: Frame = field(default_factory=Frame)
    grid_m: float = 10.0
    attribution: str = ""
    around: "Callable[[Progress], Surroundings]" = field(default=_no_surroundings, repr=False)

    @property
    def cells(self) -> CellTable:
        """The cells."""
        return self.gallery.cells


@dataclass(frozen=True, slots=True, eq=False)
class Queries:
    """Q descriptions with known positions.

    Attributes:
        sentences: each description's hint sentences.
        positions_m: [Q, 2] true positions, map frame.
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


def fingerprint(data: Path, split: str | None = None) -> str:
    """sha256 of what a map is read from.

    Raises:
        DataError: there is nothing to read.
    """
    if data.is_file():
        files = [data]
    elif (data / MANIFEST).is_file():
        files = [data / MANIFEST]  # has the sums of all others
    else:
        files = [data / "cells" / f"{s}.pkl" for s in select_scenes(list_scenes(data), split, data / "cells")]
    parts = [f"{split}", *(f"{path.name} {sha256(path)}" for path in files)]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def load_map(data: Path, split: str | None = None, progress: Progress | None = None) -> MapData:
    """A map to index.

    Args:
        data: .osm.pbf or .osm; or a directory in KITTI360Pose's published layout; or a converted store.
        split: of an OpenStreetMap file: train, val or test (its west, middle or east); of the others a standard
            split or a comma list of scenes; None for everything.
        progress: called as the work goes on.

    Raises:
        MapError, DataError: it cannot be read, or there is no such split.
    """
    if data.is_dir():
        return _of_store(load_data(data, split), data, split)
    city_map, points, cells = _cut(data, progress)
    return _of_city(city_map, points, _region(cells, city_map, split)[0], split)


def load_queries(data: Path, split: str | None = None, progress: Progress | None = None) -> tuple[MapData, Queries]:
    """A map and queries about it: the poses of a data set, or described positions of an OpenStreetMap file.

    Args:
        data: as `load_map`.
        split: as `load_map`.
        progress: called as the work goes on.

    Raises:
        MapError, DataError: as `load_map`; or there is nothing to ask.
    """
    if data.is_dir():
        store = load_data(data, split)
        queries = _of_poses(store)
        return _of_store(store, data, split), queries
    city_map, points, cells = _cut(data, progress)
    cells, locations = _region(cells, city_map, split)
    positions = sample_positions(locations, POSE_SPACING_M, np.random.default_rng(POSE_SEED))
    if progress:
        progress("describe positions", 0, 0)
    poses = describe_poses(city_map, points, cells, positions) if len(cells) and len(positions) else []
    if not poses:
        raise MapError(f"{data}: no position in split '{split}' can be described; take a larger map or another split")
    row = {cell_id: n for n, cell_id in enumerate(cells.ids)}
    hints = [pose.description.hints for pose in poses]
    queries = Queries(
        sentences=[tuple(render_hint(hint) for hint in said) for said in hints],
        positions_m=np.array([pose.position_m[:2] for pose in poses], dtype=np.float64),
        truth=np.array([row[pose.cell_id] for pose in poses]),
        scenes=[city_map.name] * len(poses),
        strategies=[pose.strategy for pose in poses],
        hints=hints,
    )
    return _of_city(city_map, points, cells, split), queries


def ask(cells: CellTable, sentences: Sequence[tuple[str, ...]], positions_m: Floats) -> Queries:
    """Queries of one's own about a gallery; a description's best cell is the one whose centre is nearest.

    Args:
        cells: the gallery.
        sentences: each description's hint sentences.
        positions_m: [Q, 2] where they were said, map frame.
    """
    distance, nearest = cKDTree(cells.center_m[:, :2]).query(positions_m)
    scenes = [cells.scenes[n] for n in nearest]
    truth = np.where(distance <= BEST_CELL_REACH_M, nearest, -1)
    return Queries(sentences, positions_m, truth, scenes, [""] * len(sentences))


def _cut(data: Path, progress: Progress | None) -> tuple[CityMap, PointTable, CellTable]:
    report = progress or (lambda stage, done, total: None)
    report("read map", 0, 0)
    city_map = load_osm(data)
    report("index points", 0, 0)
    points = PointTable.of(city_map, city_map.rules.eps_m)
    cells = cut_cells(city_map, points, lambda done, total: report("cut cells", done, total))
    return city_map, points, cells


def _region(cells: CellTable, city_map: CityMap, split: str | None) -> tuple[CellTable, Floats]:
    """The cells and the locations of a split."""
    if split is None:
        return cells, city_map.locations_m
    for name, region in split_regions(cells).items():
        if name == split:
            return region.cells(cells), region.locations(city_map.locations_m)
    raise MapError(f"'{split}' is no split of a map; choose one of {', '.join(SPLITS)}, or none for the whole map")


def _of_city(city_map: CityMap, points: PointTable, cells: CellTable, split: str | None) -> MapData:
    def around(progress: Progress) -> Surroundings:
        bodies = Bodies.of_map(city_map, points, cells)
        return Surroundings.of(
            bodies, cells, city_map.rules.thing_share, lambda done, total: progress("measure surroundings", done, total)
        )

    return MapData(
        name=city_map.name,
        split=split or "all",
        gallery=Gallery.of(city_map, cells),
        palette=city_map.palette,
        frame=city_map.frame,
        grid_m=city_map.rules.grid_m,
        attribution=city_map.attribution,
        around=around,
    )


def _of_store(store: PoseStore, data: Path, split: str | None) -> MapData:
    cells = store.cell_table()
    names = tuple(str(number) for number in store.instance_ids)
    gallery = Gallery(cells, store.labels, (None,) * len(names), names)

    def around(progress: Progress) -> Surroundings:
        share = CutRules().thing_share
        return Surroundings.of(
            Bodies.of_store(store, cells),
            cells,
            share,
            lambda done, total: progress("measure surroundings", done, total),
        )

    name, grid_m = data.resolve().name, _grid_of(cells)
    return MapData(name, split or "all", gallery, KITTI360_PALETTE, grid_m=grid_m, around=around)


def _grid_of(cells: CellTable) -> float:
    """Metres between neighbouring centres in the plane, the commonest; the size of a cell if there is one alone."""
    if len(cells) < 2:
        return cells.size_m
    scene = np.unique(cells.scenes, return_inverse=True)[1][:, None] * 1e7  # scenes may lie over each other
    distance: npt.NDArray[Any] = cKDTree(np.hstack([cells.center_m[:, :2], scene])).query(
        np.hstack([cells.center_m[:, :2], scene]), k=2
    )[0][:, 1]
    return float(min(np.median(distance), cells.size_m))


def _of_poses(store: PoseStore) -> Queries:
    poses = store.poses
    if not len(poses):
        raise DataError(f"{store.source}: no poses in these scenes; name others with --split")
    scenes = store.cell_table().scenes
    hints = [poses.hints(q) for q in range(len(poses))]
    return Queries(
        sentences=[tuple(render_hint(hint) for hint in said) for said in hints],
        positions_m=poses.positions_m[:, :2],
        truth=poses.cell.astype(np.intp),
        scenes=[scenes[c] for c in poses.cell],
        strategies=poses.strategies,
        hints=hints,
    )
