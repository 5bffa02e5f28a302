"""The single entry point to data: a path and a split give cells, queries and all true hints.

Indexing, training and evaluation use it, so that they see the same cells and the same positions.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from copy import copy
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from models.citymap.cells import CellTable, PartTable
from models.citymap.colours import KITTI360_PALETTE
from models.citymap.gallery import Gallery, MapData, PointClouds
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, Gazetteer
from models.citymap.hints import BEST_CELL_REACH_M, HintTable, build_hint_table, describe_poses, sample_positions
from models.citymap.map_geometry import (
    MapGeometry,
    PieceGeometry,
    ScanGeometry,
    ScannedPieceGeometry,
    build_geometry,
    cut_cells,
)
from models.citymap.points import Ints
from models.citymap.queries import PositionStatements, Queries
from models.citymap.regions import SPLITS, split_regions
from models.citymap.scenery.cloud import encode_cloud
from models.citymap.scenery.files import SceneryBlob
from models.citymap.scenery.shapes import NamedPoint, Outlines
from models.citymap.summary import MapSummary
from models.citymap.types import CityMap, CutRules, Floats, Progress
from models.errors import DataError, MapError
from models.sources.extras.layer import ExtraLayer
from models.sources.kitti360.rules import CLASSES
from models.sources.osm.gazetteer import load_gazetteer
from models.sources.osm.map import load_osm
from models.sources.osm.summary import load_gazetteer_and_summary
from models.sources.store.files import load_data
from models.sources.store.pose_store import PoseStore

QUERY_SPACING_M = 10.0  # between the described positions of a map
# Seeds of a map's positions: a model is chosen at other positions than it is evaluated at.
VALIDATION_SEED, TEST_SEED = 0, 1
SCENE_GAP_M = 1e6  # between scenes, on an extra axis
VOXEL_M = 0.2  # edge of the voxels of scanned scenes
STUFF_LABELS = [rule.label for rule in CLASSES if rule.is_stuff]


class Source(ABC):
    """A map, some of its scenes, or a region of it, with descriptions of its positions."""

    data: MapData
    facts: dict[str, Any]  # a summary for the record next to the weights

    @abstractmethod
    def queries(self, seed: int = TEST_SEED, spacing_m: float = QUERY_SPACING_M) -> Queries:
        """Return descriptions with known positions: the poses of a data set, or drawn positions of a map.

        Raise MapError or DataError if there is nothing to describe.
        """

    def as_scan(self) -> "Source":
        """Return the same source with hints as a scan would give them; a scan returns itself."""
        return self

    @abstractmethod
    def statements(self, spacing_m: float, rng: np.random.Generator) -> PositionStatements:
        """Return all true hints at positions to train on; arguments as `queries`."""

    @abstractmethod
    def geometry(self) -> PointClouds | PieceGeometry:
        """Return the geometry from which neighbours are measured: all of a map, or the cells' points of a data set."""

    @abstractmethod
    def gazetteer(self) -> Gazetteer:
        """Return the named objects; empty if nothing has a name."""

    @abstractmethod
    def scenery(self, gazetteer: Gazetteer) -> Iterator[SceneryBlob]:
        """Yield the parts of the scenery (see `models.citymap.scenery`), with the names of a gazetteer."""


class MapSource(Source):
    """A map that was cut into cells, or a region of it (one of SPLITS)."""

    def __init__(
        self, path: Path, city_map: CityMap, geometry: MapGeometry, cells: CellTable, split: str | None = None
    ) -> None:
        regions = split_regions(cells)
        self._path, self._map, self._geometry, self._locations_m = path, city_map, geometry, city_map.locations_m
        if split is not None:
            cells = regions[split].cells(cells)
            self._locations_m = regions[split].locations(city_map.locations_m)
        self.data = MapData(
            name=city_map.name,
            split=split or "all",
            gallery=Gallery.from_map(city_map, cells),
            palette=city_map.palette,
            frame=city_map.frame,
            grid_m=city_map.rules.grid_m,
            attribution=city_map.attribution,
        )
        self.facts = {
            "data": city_map.name,
            "attribution": city_map.attribution,
            "regions": {name: [region.west_m, region.east_m] for name, region in regions.items()},
        }

    def queries(self, seed: int = TEST_SEED, spacing_m: float = QUERY_SPACING_M) -> Queries:
        """Describe positions of the map."""
        cells = self.data.cells
        positions = sample_positions(self._locations_m, spacing_m, np.random.default_rng(seed))
        poses = describe_poses(self._map, self._geometry, cells, positions) if len(cells) and len(positions) else []
        if not poses:
            raise MapError(
                f"{self._path}: no position in split '{self.data.split}' can be described; "
                "take a larger map or another split"
            )
        row = {cell_id: n for n, cell_id in enumerate(cells.ids)}
        return Queries.from_hints(
            [pose.description.hints for pose in poses],
            np.array([pose.position_m[:2] for pose in poses], dtype=np.float64),
            np.array([row[pose.cell_id] for pose in poses]),
            [pose.strategy for pose in poses],
            cells,
        )

    def statements(self, spacing_m: float, rng: np.random.Generator) -> PositionStatements:
        """Return all true hints at sampled positions."""
        return self.statements_at(sample_positions(self._locations_m, spacing_m, rng))

    def statements_at(self, positions_m: Floats) -> PositionStatements:
        """Return all true hints at positions [N, 3]; those farther than 15 m from every centre are left out."""
        gallery, palette = self.data.gallery, self.data.palette
        distance, best = cKDTree(gallery.cells.center_m).query(positions_m)
        near = distance <= BEST_CELL_REACH_M
        positions = positions_m[near]
        table = build_hint_table(palette, self._geometry.cut(positions), positions)
        part_number = gallery.cells.parts.instance
        return PositionStatements(
            gallery, positions[:, :2], best[near], table, gallery.labels, palette.words, part_number, table.instance
        )

    def geometry(self) -> PointClouds | PieceGeometry:
        """Return the geometry of the whole map."""
        if not isinstance(self._geometry, ScanGeometry):
            assert isinstance(self._geometry, PieceGeometry)
            return self._geometry
        points, rules = self._geometry.points, self._map.rules
        scene, of_part = np.zeros(len(self._map.instances), dtype=np.int64), self.data.cells.parts.instance
        is_thing, least = ~points.is_stuff, rules.min_part_points
        return PointClouds(points.xyz, points.starts, is_thing, scene, of_part, rules.thing_share, least)

    def as_scan(self) -> "MapSource":
        """Return the same source with hints as a scan would give them."""
        if not isinstance(self._geometry, PieceGeometry):
            return self
        scan = copy(self)
        scan._geometry = ScannedPieceGeometry(self._geometry)
        return scan

    def drop_geometry(self) -> None:
        """Drop what only queries need; none can be drawn after that."""
        nowhere = np.zeros((0, 3), np.float32)  # no view of what there was
        self._map, self._locations_m = replace(self._map, instances=(), locations_m=nowhere), nowhere

    def defer_parts(self, cut: Callable[[Floats], PartTable]) -> None:
        """Drop the parts of cells; `cut` makes those of a cell (around centres [N, 3]) on access."""
        self.data = self.data.with_deferred_parts(cut)

    def gazetteer(self) -> Gazetteer:
        """Return the gazetteer of the whole file, whatever the split."""
        return load_gazetteer(self._path, self.data.frame)

    def scenery(self, gazetteer: Gazetteer) -> Iterator[SceneryBlob]:
        """Yield the scenery of the whole file, whatever the split."""
        places = ((gazetteer.middles_m[n].tolist(), gazetteer.objects[n]) for n in gazetteer.named.tolist())
        outlines = self._map.outlines or Outlines.from_shapes(())
        yield outlines.encode(NamedPoint((x, y), w.names[0], w.kinds[0]) for (x, y), w in places)


class StoreSource(Source):
    """Scenes of a data set."""

    def __init__(self, store: PoseStore, split: str | None = None) -> None:
        self._store, cells, name = store, store.cell_table(), store.source.resolve().name
        self._scene = np.unique(cells.scenes, return_inverse=True)[1]
        numbers = tuple(str(number) for number in store.instance_ids)
        gallery = Gallery(cells, store.labels, (None,) * len(numbers), numbers)
        self.data = MapData(name, split or "all", gallery, KITTI360_PALETTE, grid_m=_grid_spacing_m(cells, self._scene))
        self.facts = {"data": name, "scenes": {self.data.split: [scene.name for scene in store.scenes]}}

    def queries(self, seed: int = TEST_SEED, spacing_m: float = QUERY_SPACING_M) -> Queries:
        """Return the poses of the scenes; the arguments have no effect."""
        poses = self._store.poses
        if not len(poses):
            raise DataError(f"{self._store.source}: no poses in these scenes; name others with --split")
        hints = [poses.hints(q) for q in range(len(poses))]
        truth = poses.cell.astype(np.intp)
        return Queries.from_hints(hints, poses.positions_m[:, :2], truth, poses.strategies, self.data.cells)

    def statements(self, spacing_m: float, rng: np.random.Generator) -> PositionStatements:
        """Return the hints of all descriptions; the arguments have no effect."""
        poses, numbers = self._store.poses, self._store.instance_ids
        mentioned, scene = poses.instance, self._scene[poses.cell]
        return PositionStatements(
            gallery=self.data.gallery,
            positions_m=np.column_stack([poses.positions_m[:, :2], scene * SCENE_GAP_M]),
            best=poses.cell.astype(np.intp),
            table=HintTable(poses.starts, poses.label, poses.direction, poses.colour),  # in stated order
            labels=poses.words,
            words=poses.words,
            part_number=numbers,
            mentioned_number=np.where(mentioned >= 0, numbers[mentioned], -1),
        )

    def geometry(self) -> PointClouds:
        """Return the points of the cells, one in each voxel of VOXEL_M."""
        store, cells, cube = self._store, self.data.cells, self.data.cells.parts.cube
        pairs = np.column_stack([self._scene[cube], store.instance_ids])
        known, part_instance = np.unique(pairs, axis=0, return_inverse=True)
        order = np.argsort(part_instance, kind="stable")
        corner = cells.center_m[cube] - cells.size_m / 2
        groups = np.split(order, np.flatnonzero(np.diff(part_instance[order])) + 1)
        xyz = []
        for rows in groups:
            points = np.concatenate([store.instance_points(int(r))[0] * cells.size_m + corner[r] for r in rows])
            xyz.append(_thin_by_voxel(points).astype(np.float32))
        labels = np.array(store.labels)[[rows[0] for rows in groups]]
        starts = np.concatenate([[0], np.cumsum([len(points) for points in xyz])])
        is_thing, rules = ~np.isin(labels, STUFF_LABELS), CutRules()
        return PointClouds(
            np.concatenate(xyz), starts, is_thing, known[:, 0], part_instance, rules.thing_share, rules.min_part_points
        )

    def gazetteer(self) -> Gazetteer:
        """Return an empty gazetteer; scans have no names."""
        return EMPTY_GAZETTEER

    def scenery(self, gazetteer: Gazetteer) -> Iterator[SceneryBlob]:
        """Yield the points of the cells, one in each voxel of VOXEL_M."""
        del gazetteer
        cells, cube = self.data.cells, self.data.cells.parts.cube
        corner = cells.center_m[cube] - cells.size_m / 2
        clouds: list[Floats] = [np.zeros((0, 6))]
        for row in range(len(cube)):
            points, rgb = self._store.instance_points(row)
            clouds.append(_thin_by_voxel(np.concatenate([points * cells.size_m + corner[row], rgb], axis=1)))
        coloured = _thin_by_voxel(np.concatenate(clouds))  # cells overlap
        yield from encode_cloud(coloured[:, :3], np.rint(255 * coloured[:, 3:]).astype(np.uint8))


def _thin_by_voxel(rows: Floats) -> Floats:
    """Return one row [n, ...] for each voxel of VOXEL_M; the first three columns are the position."""
    voxel = np.floor(rows[:, :3] / VOXEL_M).astype(np.int64) & 0x1FFFFF
    key = (voxel[:, 0] << 42) | (voxel[:, 1] << 21) | voxel[:, 2]
    return rows[np.unique(key, return_index=True)[1]]


def open_source(
    path: Path, split: str | None = None, progress: Progress | None = None, extras: Sequence[ExtraLayer] = ()
) -> Source:
    """Open a map or a data set; arguments and errors as `open_sources`."""
    return open_sources(path, [split], progress, extras)[0]


def open_sources(
    path: Path,
    splits: Sequence[str | None],
    progress: Progress | None = None,
    extras: Sequence[ExtraLayer] = (),
) -> list[Source]:
    """Open parts of a map or a data set; a map is read and cut once for all of them.

    A path is an OpenStreetMap file, a directory in KITTI360Pose's published layout, or a converted store. A split of a
    file is train, val or test (its west, middle or east); of the others a standard split or a comma list of scenes;
    None for everything. `extras` join a map. Raise MapError or DataError if the data cannot be read, or have no such
    split.
    """
    if path.is_dir():
        return [StoreSource(load_data(path, split), split) for split in splits]
    for split in splits:
        if split is not None and split not in SPLITS:
            advice = f"choose one of {', '.join(SPLITS)}, or leave it out for the whole map"
            raise MapError(f"'{split}' is not a split of a map; {advice}")
    report = progress or (lambda stage, done, total: None)
    report("read map", 0, 0)
    city_map = load_osm(path, extras=extras)
    geometry = build_geometry(city_map)
    cells = cut_cells(city_map, geometry, lambda done, total: report("cut cells", done, total))
    return [MapSource(path, city_map, geometry, cells, split) for split in splits]


def open_gazetteer(path: Path, extras: Sequence[ExtraLayer] = ()) -> tuple[Gazetteer, MapSummary | None]:
    """Read the gazetteer and the summary of a map without the rest of it; arguments and errors as `open_sources`.

    A data set has no names and no summary.
    """
    return (EMPTY_GAZETTEER, None) if path.is_dir() else load_gazetteer_and_summary(path, extras)


def _grid_spacing_m(cells: CellTable, scene: Ints) -> float:
    """Return the median distance between neighbouring centres in the plane; of a single cell, its size."""
    if len(cells) < 2:
        return cells.size_m
    centers = np.column_stack([cells.center_m[:, :2], scene * SCENE_GAP_M])  # scenes may lie over each other
    return float(min(np.median(cKDTree(centers).query(centers, k=2)[0][:, 1]), cells.size_m))
