"""Options that several commands share, and those of `index` that split the work into shards."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from pydantic import ValidationError

from index.answering.query import Refine
from index.build.shard import Shard

if TYPE_CHECKING:
    from app.http.schemas.requests import LocalizeRequest
    from index.build.build import IndexJob
    from models.citymap.types import Progress
    from models.sources.extras.layer import ExtraLayer

INDEX_DIR = Path("data/index")
DATA_HELP = (
    "an OpenStreetMap file (.osm.pbf, .osm), a directory in KITTI360Pose's layout (cells/*.pkl, poses/*.pkl), "
    "or a store written by 'convert'"
)
SPLIT_HELP = (
    "train, val or test; for KITTI360Pose's layout also scenes separated by commas, such as 0003,0005; "
    "default: everything"
)
WITHIN_HELP = (
    "region of an OpenStreetMap file: west,south,east,north in degrees, a GeoJSON file, or a place in the file, "
    'such as place:"Andorra la Vella"'
)
FIELDS_HELP = (
    "JSON with within, prior, listener, crs or answers as in POST /localize, for example "
    '\'{"prior": {"position": [24.94, 60.17], "radius_m": 80}, "crs": "wgs84"}\''
)
LOCAL_FIELDS = frozenset({"within", "prior", "listener", "crs", "answers"})
EXTRA_FORMATS = "a .csv file with columns lat and lon, GeoJSON, or Overpass JSON"


IndexDir = Annotated[Path, typer.Option("--index", envvar="HEREABOUTS_INDEX_DIR", help="index directory")]
Split = Annotated[str | None, typer.Option(help=SPLIT_HELP)]
Seed = Annotated[int, typer.Option(min=0, help="random seed")]


def parse_shard(text: str | Shard) -> Shard:
    """Parse "I/N"."""
    try:
        return Shard.parse(str(text))
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None


def check_shard_options(
    shard: Shard | None, merge: int | None, engine: str | None, address: str | None, keep_current: bool
) -> None:
    """Refuse options that exclude each other."""
    if shard and (merge or engine):
        raise typer.BadParameter("--shard builds one shard, --merge and --engine build an index: give one of them")
    if shard and keep_current:
        raise typer.BadParameter("--keep-current applies to an index, not to a shard: leave it out with --shard")
    if address is not None and not engine:
        raise typer.BadParameter(
            "--address is the address of a Ray cluster: give --engine ray with it, or leave it out"
        )


def parse_fields(text: str, top_k: int, refine: Refine) -> "LocalizeRequest":
    """Return a request with these options and fields in JSON."""
    from app.http.errors import Problem  # noqa: PLC0415  # heavy
    from app.http.schemas.requests import LocalizeRequest  # noqa: PLC0415  # heavy

    try:
        fields = json.loads(text)
    except ValueError as error:
        raise typer.BadParameter(f"--fields: is not JSON: {error}") from None
    if not isinstance(fields, dict) or not fields.keys() <= LOCAL_FIELDS:
        raise typer.BadParameter(f"--fields: must be a JSON object with any of {', '.join(sorted(LOCAL_FIELDS))}")
    try:
        return LocalizeRequest.model_validate({"description": "any", "top_k": top_k, "refine": refine, **fields})
    except ValidationError as error:
        raise typer.BadParameter(f"--fields: {Problem.for_body(error).detail}") from None


def read_extras(files: Sequence[Path], kinds: Sequence[str]) -> tuple["ExtraLayer", ...]:
    """Read a city's own data: the n-th file has objects of the n-th kind."""
    from models.sources.extras.layer import ExtraLayer  # noqa: PLC0415  # heavy

    if len(files) != len(kinds):
        raise typer.BadParameter(
            f"each --extra needs a --kind after it, such as --extra bins.geojson --kind waste_basket: "
            f"there are {len(files)} and {len(kinds)}"
        )
    return tuple(ExtraLayer.read(path, kind) for path, kind in zip(files, kinds, strict=True))


def run_index_job(
    job: "IndexJob", shard: Shard | None, merge: int | None, engine: str | None, address: str | None, show: "Progress"
) -> Path:
    """Build an index, merge its shards, or build one shard; return the directory of the result."""
    if shard:
        return job.make_shard(shard, show)
    if engine:
        from index.build.ray_shards import build_on_ray  # noqa: PLC0415  # heavy

        return build_on_ray(job, merge, address, show)
    return job.merge(merge, show) if merge else job.build(show)
