"""The options of `hereabouts index` that share the work out."""

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from index.build.shard import Shard

if TYPE_CHECKING:
    from index.build.build import IndexJob
    from models.citymap.types import Progress


def parse_shard(text: str | Shard) -> Shard:
    """A shard as it was typed.

    Raises:
        BadParameter: it is none.
    """
    try:
        return Shard.parse(str(text))
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None


def check_shares(
    shard: Shard | None, merge: int | None, engine: str | None, address: str | None, keep_current: bool
) -> None:
    """Refuse what does not go together.

    Raises:
        BadParameter: it does not.
    """
    if shard and (merge or engine):
        raise typer.BadParameter("--shard does one share, --merge and --engine ask for an index: give one of them")
    if shard and keep_current:
        raise typer.BadParameter("--keep-current is about an index, not a share: leave it out with --shard")
    if address is not None and not engine:
        raise typer.BadParameter("--address is of a Ray cluster: give --engine ray with it, or leave it out")


def share_out(
    job: "IndexJob", shard: Shard | None, merge: int | None, engine: str | None, address: str | None, show: "Progress"
) -> Path:
    """Make an index, at once or of its parts, or one part of it; arguments as they were checked.

    Returns:
        The directory of what was made.
    """
    if shard:
        return job.make_shard(shard, show)
    if engine:
        from index.build.ray_shards import build_on_ray  # noqa: PLC0415  # heavy, as all commands are

        return build_on_ray(job, merge, address, show)
    return job.merge(merge, show) if merge else job.build(show)
