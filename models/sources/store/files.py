"""A pose store on disk: written once from the published pickles, mapped into memory when opened.

<store>/<column>.npy    models.sources.store.layout
<store>/strings.json    ids of cells, and the words that columns number
<store>/manifest.json   written last: scenes, format, and size and sha256 of every other file
"""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from models.errors import DataError
from models.files import FileRecord, file_records, new_directory
from models.sources.kitti360pose.files import (
    CellKey,
    build_cell_key,
    check_poses,
    iter_cells,
    list_scenes,
    load_poses,
    select_scenes,
)
from models.sources.store.columns import ColumnWriter, DiskSink, MemorySink
from models.sources.store.layout import COLUMNS, MANIFEST, STRINGS, Column, find_problem
from models.sources.store.pose_store import PoseStore, StoredScene

FORMAT = 2  # version of the store's layout
ADVICE = "convert the published files again with 'hereabouts convert --data DIR --out DIR'"
Progress = Callable[[int, int], None]
Step = Callable[[int], None]


class StoreManifest(BaseModel):
    """The content of a store's manifest.json."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    kind: Literal["hereabouts pose store"] = "hereabouts pose store"
    format: int = FORMAT
    scenes: tuple[StoredScene, ...]
    files: dict[str, FileRecord]


class StoreStrings(BaseModel):
    """The content of strings.json."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    cell_ids: tuple[str, ...]
    words: tuple[str, ...]


def load_data(data: Path, split: str | None = None) -> PoseStore:
    """Load the cells and poses of a split (see `select_scenes`), from a store or from the published layout.

    The published layout is converted in memory, every time: convert large ones once. Raise DataError, with file and
    field, if the data are neither, or not usable.
    """
    if (data / MANIFEST).is_file():
        return open_store(data).split(split)
    if not (data / "cells").is_dir():
        raise DataError(f"{data}: neither a converted store ({MANIFEST}) nor the published layout (cells/<scene>.pkl)")
    sink = MemorySink()
    writer = ColumnWriter(sink)
    names = select_scenes(list_scenes(data), split, data / "cells")
    scenes = tuple(_add_scene(writer, data, name, n, None) for n, name in enumerate(names))
    return PoseStore.whole(data, scenes, sink.columns(), tuple(writer.words), tuple(writer.cell_ids))


def convert(data: Path, out: Path, split: str | None = None, progress: Progress | None = None) -> PoseStore:
    """Write a store from a split (see `select_scenes`) of the published layout, with one cell's points in memory.

    `out`, a new or empty directory, appears when all is written; `progress` gets (bytes of points done, approximate
    total). Raise DataError, and leave nothing behind, if `out` has files in it, or `data` is not usable.
    """
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise DataError(f"{out}: exists and is not empty; name a new directory")
    names = select_scenes(list_scenes(data), split, data / "cells")
    step = _byte_counter(data, names, progress) if progress else None
    with new_directory(out) as directory:
        with DiskSink(directory) as sink:
            writer = ColumnWriter(sink)
            scenes = tuple(_add_scene(writer, data, name, n, step) for n, name in enumerate(names))
        strings = {"cell_ids": writer.cell_ids, "words": list(writer.words)}
        (directory / STRINGS).write_text(json.dumps(strings) + "\n")
        manifest = StoreManifest(scenes=scenes, files=file_records(directory))
        (directory / MANIFEST).write_text(manifest.model_dump_json(indent=2) + "\n")
    return open_store(out)


def open_store(path: Path) -> PoseStore:
    """Open a store with its columns mapped into memory; raise DataError if it is not one, or inconsistent.

    Sizes and structure are checked, checksums are not.
    """
    manifest = _read_manifest(path)
    for name, record in manifest.files.items():
        file = path / name
        if not file.is_file() or file.stat().st_size != record.bytes:
            raise DataError(f"{file}: missing or cut short; {ADVICE}")
    try:
        strings = StoreStrings.model_validate_json((path / STRINGS).read_bytes())
    except ValidationError as error:
        raise DataError(f"{path / STRINGS}: {error.errors()[0]['msg']}; {ADVICE}") from error
    columns = {name: _map_column(path / f"{name}.npy") for name in COLUMNS}
    problem = find_problem(columns, len(strings.words), len(manifest.scenes))
    if not problem and len(strings.cell_ids) != len(columns["cell_scene"]):
        problem = f"{STRINGS} has {len(strings.cell_ids)} cell ids, not {len(columns['cell_scene'])}"
    if problem:
        raise DataError(f"{path}: {problem}; {ADVICE}")
    return PoseStore.whole(path, manifest.scenes, columns, strings.words, strings.cell_ids)


def _add_scene(writer: ColumnWriter, data: Path, name: str, number: int, step: Step | None) -> StoredScene:
    path = data / "cells" / f"{name}.pkl"
    taken = set(writer.cell_ids)
    keys: dict[str, CellKey] = {}
    for cell in iter_cells(path):
        if cell.id in taken:
            raise DataError(
                f"{path}: cells[{len(keys)}].id '{cell.id}' is taken by another scene; leave one of them out"
            )
        keys[cell.id] = build_cell_key(cell)
        writer.add_cell(cell, number)
        if step:
            step(sum(item.xyz.nbytes + item.rgb.nbytes for item in cell.objects))
    scene_name = next(iter(keys.values())).scene_name
    poses_path = data / "poses" / f"{name}.pkl"
    if not poses_path.exists():
        return StoredScene(name=name, scene_name=scene_name, cells=len(keys), poses=None)
    poses = load_poses(poses_path)
    check_poses(poses_path, poses, keys)
    writer.add_poses(poses)
    return StoredScene(name=name, scene_name=scene_name, cells=len(keys), poses=len(poses))


def _byte_counter(data: Path, names: tuple[str, ...], progress: Progress) -> Step:
    total = sum((data / "cells" / f"{name}.pkl").stat().st_size for name in names)
    done = 0

    def step(more: int) -> None:
        nonlocal done
        done += more
        progress(done, total)

    return step


def _read_manifest(path: Path) -> StoreManifest:
    try:
        manifest = StoreManifest.model_validate_json((path / MANIFEST).read_bytes())
    except OSError as error:
        raise DataError(f"{path / MANIFEST}: cannot be read, so this is not a store; {ADVICE}") from error
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"])
        raise DataError(f"{path / MANIFEST}: {field}: {first['msg']}; {ADVICE}") from error
    if manifest.format != FORMAT:
        raise DataError(f"{path}: has format {manifest.format}, this hereabouts reads {FORMAT}; {ADVICE}")
    expected = {STRINGS, *(f"{name}.npy" for name in COLUMNS)}
    if set(manifest.files) != expected:
        odd = sorted(expected ^ set(manifest.files))
        raise DataError(f"{path / MANIFEST}: files: unexpected or missing {', '.join(odd)[:200]}; {ADVICE}")
    return manifest


def _map_column(file: Path) -> Column:
    try:
        column: Column = np.load(file, mmap_mode="r", allow_pickle=False).view(np.ndarray)
    except (ValueError, OSError, EOFError) as error:
        raise DataError(f"{file}: not a column of numbers; {ADVICE}") from error
    return column
