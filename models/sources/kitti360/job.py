"""The preparation job: raw KITTI-360 to the published layout, scene by scene; finished scenes are kept.

<out>/cells/<scene>.pkl, poses/<scene>.pkl, direction/<scene>.json   the published layout
<out>/prepared/<scene>.json   what a complete scene was made from (models.sources.kitti360.record)
<out>/.preparing-<scene>      a scene in progress; removed on failure, or by the next run after a kill
<out>/.placing-<scene>        a complete scene while its files are moved into place; the next run resumes
"""

import fcntl
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from models.citymap.types import Progress
from models.errors import DataError
from models.files import replace_file, sync
from models.sources.kitti360.prepare import prepare_scene
from models.sources.kitti360.raw import POSES, TILES, list_raw_scenes, load_raw_scene
from models.sources.kitti360.record import PreparationRecord, Recipe, build_recipe, describe_differences, read_record
from models.sources.kitti360.rules import PrepareConfig
from models.sources.kitti360pose.direction import find_neighbours, save_direction
from models.sources.kitti360pose.files import save_scene, select_scenes, short_name

RELEASED_CONFIG = PrepareConfig()
# In the order of moving into place: readers list scenes by their cells, and the record means that all is there.
SCENE_FILES = {"poses": ".pkl", "direction": ".json", "cells": ".pkl", "prepared": ".json"}
READING_SHARE, CUTTING_SHARE = 0.1, 0.8  # shares of a scene's work; the rest is writing


def prepare_data(
    raw: Path,
    out: Path,
    scene: str | None = None,
    config: PrepareConfig = RELEASED_CONFIG,
    seed: int = 0,
    progress: Progress | None = None,
) -> tuple[str, ...]:
    """Prepare scenes one after the other; return the file names of all chosen scenes, which are complete then.

    A complete scene in `out` that was made from the same raw files (by name, size and time) with the same settings is
    kept. A scene made otherwise is never replaced, but refused before any work begins. If a scene cannot be prepared,
    the others still are. Runs that prepare different scenes may share `out`.

    Args:
        raw: folder with data_3d_semantics and data_poses.
        out: root of the published layout.
        scene: name of a folder, or the drive's digits ("0003"), or as `select_scenes`; None for all.
        config: every option.
        seed: draws, with the scene's name, its positions, whatever scenes are prepared with it.
        progress: called with (scene, work done, total work), in bytes of all chosen scenes' raw files.

    Raises:
        DataError: a scene is unknown, was made otherwise, or cannot be prepared or written.
    """
    recipes = {folder: build_recipe(raw, folder, config, seed) for folder in _choose_folders(raw, scene)}
    _check_output(raw, out)
    pending = [folder for folder, recipe in recipes.items() if not _is_finished(out, recipe)]
    bar = _ProgressBar(recipes, progress)
    problems = []
    for folder, recipe in recipes.items():
        try:
            if folder in pending:
                with _locked(out, recipe.scene):
                    _complete_scene(raw, folder, out, recipe, config, bar)
        except DataError as error:
            problems.append(str(error))
        except OSError as error:  # it would fail for the next scene, too
            raise DataError(f"{out}: scene '{recipe.scene}' cannot be prepared: {error}") from error
        bar.finish(recipe)
    if problems and len(recipes) > 1:
        count = f"{len(problems)} of {len(recipes)} scenes could not be prepared"
        problems.insert(0, f"{out}: {count}; the others are complete")
    if problems:
        raise DataError("\n".join(problems))
    return tuple(recipe.scene for recipe in recipes.values())


def _choose_folders(raw: Path, scene: str | None) -> tuple[str, ...]:
    try:
        available = list_raw_scenes(raw)
    except DataError as error:
        if any((raw / "cells").glob("*.pkl")):
            raise DataError(
                f"{raw}: is not raw KITTI-360 ({TILES}/<scene>/static/*.ply) but the published layout "
                "(cells/<scene>.pkl), which is prepared already: use it as the data"
            ) from error
        raise
    chosen = select_scenes(available, scene, raw / TILES)
    for n, folder in enumerate(chosen):
        same = [earlier for earlier in chosen[:n] if short_name(earlier) == short_name(folder)]
        if same:
            raise DataError(
                f"{raw / TILES}: folders '{same[0]}' and '{folder}' are one scene; name or keep one of them"
            )
    return chosen


def _check_output(raw: Path, out: Path) -> None:
    place, root = out.resolve(), raw.resolve()
    if place == root or any(place.is_relative_to(root / part) for part in (TILES, POSES)):
        raise DataError(f"{out}: contains the raw data; name another directory to prepare into")
    if out.exists() and not out.is_dir():
        raise DataError(f"{out}: is not a directory; name another one to prepare into")


def _file_paths(root: Path, scene: str) -> dict[str, Path]:
    """Return the files of a scene by kind, in the order of SCENE_FILES."""
    return {part: root / part / f"{scene}{ending}" for part, ending in SCENE_FILES.items()}


def _is_finished(out: Path, recipe: Recipe) -> bool:
    """Whether a scene is complete; raise DataError if it was made otherwise than the recipe says."""
    places = _file_paths(out, recipe.scene)
    if (out / f".placing-{recipe.scene}").is_dir():
        return False
    if not places["prepared"].exists():
        existing = [path for path in places.values() if path.exists()]
        if existing:
            raise DataError(
                f"{existing[-1]}: exists, but there is no {places['prepared']} to show that it was prepared here; it "
                "is not overwritten: move it away, or name another directory to prepare into"
            )
        return False
    if not places["cells"].exists():
        return False
    advice = f"it is not overwritten: delete {places['cells']} to make the scene again, or name another directory"
    record = read_record(places["prepared"], advice)
    changed = describe_differences(record, recipe)
    if changed:
        raise DataError(f"{places['prepared']}: the scene was prepared otherwise: {changed}; {advice}")
    files = {out / name: size for name, size in record.files.items()}
    return all(path.is_file() and path.stat().st_size == size for path, size in files.items())


@contextmanager
def _locked(out: Path, scene: str) -> Iterator[None]:
    """Keep other runs from preparing the same scene into the same directory."""
    out.mkdir(parents=True, exist_ok=True)
    path = out / f".{scene}.lock"
    with path.open("w") as file:
        try:
            # Not filelock: its locks are inherited by forked workers, which may outlive a run that is killed.
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            is_ours = os.path.samestat(os.fstat(file.fileno()), path.stat())
        except (BlockingIOError, PermissionError, FileNotFoundError):
            is_ours = False
        if not is_ours:
            raise DataError(f"{out}: scene '{scene}' is being prepared by another run; wait for it")
        try:
            yield
        finally:
            path.unlink(missing_ok=True)


def _complete_scene(
    raw: Path, folder: str, out: Path, recipe: Recipe, config: PrepareConfig, bar: "_ProgressBar"
) -> None:
    """Prepare a scene, or finish an interrupted preparation."""
    making, placing = (out / f".{state}-{recipe.scene}" for state in ("preparing", "placing"))
    if placing.is_dir():
        _move_into_place(placing, out, recipe.scene)
    if _is_finished(out, recipe):
        return
    shutil.rmtree(making, ignore_errors=True)
    try:
        _write_scene(raw, folder, making, recipe, config, bar)
        making.rename(placing)
        sync(out)
    finally:
        shutil.rmtree(making, ignore_errors=True)
    _move_into_place(placing, out, recipe.scene)


def _write_scene(
    raw: Path, folder: str, making: Path, recipe: Recipe, config: PrepareConfig, bar: "_ProgressBar"
) -> None:
    raw_scene = load_raw_scene(raw, folder, config.classes, lambda size: bar.read(recipe, size))
    rng = np.random.default_rng([recipe.seed, *raw_scene.name.encode()])
    try:
        cells, poses = prepare_scene(raw_scene, config, rng, lambda done, total: bar.cut(recipe, done / total))
    except DataError as error:
        raise DataError(f"{raw / TILES / folder}: {error}") from error
    places = _file_paths(making, recipe.scene)
    save_scene(making, recipe.scene, cells, poses)
    save_direction(places["direction"], find_neighbours(cells, config.cut.grid_m))
    files = {
        path.relative_to(making).as_posix(): path.stat().st_size for part, path in places.items() if part != "prepared"
    }
    record = PreparationRecord(**recipe.model_dump(), cells=len(cells), poses=len(poses), files=files)
    replace_file(places["prepared"], record.model_dump_json(indent=2).encode() + b"\n")


def _move_into_place(placing: Path, out: Path, scene: str) -> None:
    """Move a scene's files into place; called again, it resumes."""
    made, places = _file_paths(placing, scene), _file_paths(out, scene)
    if made["cells"].exists():
        places["cells"].unlink(missing_ok=True)  # so that no reader finds parts of two preparations
    for part, path in made.items():
        if path.exists():
            places[part].parent.mkdir(exist_ok=True)
            path.replace(places[part])
            sync(places[part].parent)
    sync(out)
    shutil.rmtree(placing)


class _ProgressBar:
    """Counts work over all scenes, in bytes of raw files."""

    def __init__(self, recipes: Mapping[str, Recipe], progress: Progress | None) -> None:
        self._progress = progress
        self._sizes = {r.scene: max(sum(file.bytes for file in r.raw.values()), 1) for r in recipes.values()}
        self._total = sum(self._sizes.values())
        self._before = self._read = 0  # bytes of earlier scenes, and those read of this one

    def read(self, recipe: Recipe, size: int) -> None:
        """Count a file of `size` bytes as read."""
        self._read += size
        self._show(recipe, READING_SHARE * self._read / self._sizes[recipe.scene])

    def cut(self, recipe: Recipe, share: float) -> None:
        """Count a share of the cells and poses as made."""
        self._show(recipe, READING_SHARE + CUTTING_SHARE * share)

    def finish(self, recipe: Recipe) -> None:
        """Count a scene as complete, or failed."""
        self._show(recipe, 1.0)
        self._before += self._sizes[recipe.scene]
        self._read = 0

    def _show(self, recipe: Recipe, share: float) -> None:
        if self._progress:
            self._progress(recipe.scene, self._before + int(share * self._sizes[recipe.scene]), self._total)
