"""prepared/<scene>.json: the raw files and settings of a prepared scene, and the sizes of its files."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError

from models.errors import DataError
from models.sources.kitti360.raw import POSES, scene_folder, tile_paths
from models.sources.kitti360.rules import PrepareConfig
from models.sources.kitti360pose.files import file_name

MAX_SHOWN_DIFFERENCES = 3  # differences that a message names
MAX_SHOWN_CHARACTERS = 60  # characters of a value that a message shows


class RawFile(BaseModel):
    """A file of the raw data, as it was when a scene was made from it."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    bytes: int
    modified_ns: int


class Recipe(BaseModel):
    """Everything that determines the result of a preparation."""

    model_config = ConfigDict(frozen=True, extra="forbid", ser_json_inf_nan="constants")

    kind: Literal["hereabouts prepared scene"] = "hereabouts prepared scene"
    format: Literal[1] = 1  # changes when the same raw files would give other cells or poses
    scene: str
    seed: int  # of the positions
    config: dict[str, Any]  # every option
    raw: dict[str, RawFile]  # the files, by path below the raw data's root


class PreparationRecord(Recipe):
    """A complete scene."""

    cells: int
    poses: int
    files: dict[str, int]  # bytes by path below the root


def build_recipe(raw: Path, folder: str, config: PrepareConfig, seed: int) -> Recipe:
    """Return the recipe for preparing a scene now; missing files are reported later, when the scene is read."""
    try:
        files = tile_paths(scene_folder(raw, folder))
    except DataError:
        files = []
    files.append(raw / POSES / folder / "poses.txt")
    stats = {path.relative_to(raw).as_posix(): path.stat() for path in files if path.is_file()}
    return Recipe(
        scene=file_name(folder),
        seed=seed,
        config=TypeAdapter(PrepareConfig).dump_python(config, mode="json"),
        raw={name: RawFile(bytes=stat.st_size, modified_ns=stat.st_mtime_ns) for name, stat in stats.items()},
    )


def read_record(path: Path, advice: str) -> PreparationRecord:
    """Read prepared/<scene>.json; raise DataError, with the advice, if it is not usable or of another version."""
    try:
        return PreparationRecord.model_validate_json(path.read_bytes())
    except OSError as error:
        raise DataError(f"{path}: cannot be read: {error.strerror}; {advice}") from error
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"])
        raise DataError(f"{path}: field '{field}': {first['msg']}; {advice}") from error


def describe_differences(record: PreparationRecord, recipe: Recipe) -> str:
    """Describe how a scene's record differs from a recipe; empty if it does not."""
    changes = list(_find_changes(record.model_dump(include=set(Recipe.model_fields)), recipe.model_dump()))
    more = f" and {len(changes) - MAX_SHOWN_DIFFERENCES} more" if len(changes) > MAX_SHOWN_DIFFERENCES else ""
    return ", ".join(changes[:MAX_SHOWN_DIFFERENCES]) + more


def _find_changes(before: Mapping[str, Any], now: Mapping[str, Any], within: str = "") -> Iterator[str]:
    for name in dict.fromkeys([*before, *now]):
        old, new = before.get(name), now.get(name)
        if name not in before or name not in now:
            yield f"{within}{name} is {'new' if name in now else 'gone'}"
        elif isinstance(old, dict) and isinstance(new, dict):
            yield from _find_changes(old, new, f"{within}{name}.")
        elif old != new:
            yield f"{within}{name} was {_shorten(old)}, is {_shorten(new)}"


def _shorten(value: Any) -> str:
    return str(value) if len(str(value)) < MAX_SHOWN_CHARACTERS else "another"
