"""The offline job: map -> cells -> vectors -> an index version on disk."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

from index.artifact import (
    FrameRecord,
    Manifest,
    file_records,
    file_sha256,
    new_version,
    set_alias,
    write_manifest,
    write_version,
)
from index.gallery import Gallery
from index.store import FaissStore
from models.city.cells import cut_cells
from models.city.osm import load_osm
from models.city.points import PointTable
from models.retrieval.checkpoint import load_retriever
from models.retrieval.instance_encoder import CellFeatures

VECTORS_FILE = "vectors.faiss"


@dataclass
class StageBar:
    """A progress bar a stage, and the seconds that each took."""

    progress: Progress
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str) -> Iterator[TaskID]:
        """Show and time a stage."""
        task = self.progress.add_task(name, total=None)
        start = time.perf_counter()
        yield task
        self.seconds[name] = round(time.perf_counter() - start, 2)
        total = self.progress.tasks[task].total or 1
        self.progress.update(task, total=total, completed=total)


def build_index(map_path: Path, out_dir: Path, weights_dir: Path | None = None) -> Path:
    """Build an index version of a map and let the alias "default" name it.

    Args:
        map_path: .osm.pbf or .osm.
        out_dir: index directory; older versions in it are kept.
        weights_dir: the retriever's weights; None for those that ship with the package.

    Returns:
        The version's directory.

    Raises:
        MapError: the map cannot be read or cut.
        WeightsError: the model cannot be loaded.
    """
    columns = (
        TextColumn("{task.description:<14}"),
        BarColumn(),
        TextColumn("{task.completed:.0f}"),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=Console(stderr=True)) as progress:
        bar = StageBar(progress)
        with bar.stage("read map"):
            city_map = load_osm(map_path)
        with bar.stage("index points"):
            points = PointTable.of(city_map, city_map.rules.eps_m)
        with bar.stage("cut cells") as task:
            cells = cut_cells(city_map, points, lambda done, total: progress.update(task, completed=done, total=total))
        with bar.stage("load model"):
            retriever = load_retriever(weights_dir)
        with bar.stage("encode cells"):
            features = CellFeatures.of(cells, np.array([i.label for i in city_map.instances]))
            store = FaissStore.of(retriever.encode_cells(features))
        with bar.stage("write index"):
            origin = new_version(file_sha256(map_path), retriever.fingerprint)
            with write_version(out_dir, origin["version"]) as directory:
                store.save(directory / VECTORS_FILE)
                Gallery.of(city_map, cells).save(directory)
                manifest = Manifest(
                    **origin,
                    map_name=city_map.name,
                    attribution=city_map.attribution,
                    frame=FrameRecord(
                        frame_id=city_map.frame.frame_id,
                        origin_lat=city_map.frame.origin_lat,
                        origin_lon=city_map.frame.origin_lon,
                        epsg=city_map.frame.epsg,
                    ),
                    palette=city_map.palette.name,
                    cell_size_m=cells.size_m,
                    grid_m=city_map.rules.grid_m,
                    model=retriever.name,
                    dim=store.dim,
                    cells=len(cells),
                    instances=len(city_map.instances),
                    files=file_records(directory),
                )
                write_manifest(directory, manifest)
            set_alias(out_dir, "default", manifest.version)
    return out_dir / manifest.version
