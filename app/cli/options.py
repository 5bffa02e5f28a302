"""Options that several commands share."""

import re
from pathlib import Path
from typing import Annotated

import typer

INDEX_DIR = Path("data/index")
DATA_HELP = (
    "an OpenStreetMap file (.osm.pbf, .osm), a directory in KITTI360Pose's layout (cells/*.pkl, poses/*.pkl), "
    "or a store that 'convert' wrote"
)
SPLIT_HELP = (
    "train, val or test; of KITTI360Pose's layout also a comma list of scenes, such as 0003,0005; "
    "everything if it is left out"
)


def is_url(place: str | Path) -> bool:
    """Whether this is a URL, be it that a path was made of it, which has one slash in the place of two."""
    return re.match(r"[A-Za-z][\w+.:-]+:/", str(place)) is not None


def check_local(directory: Path) -> Path:
    """A directory on this machine.

    Raises:
        BadParameter: it is a URL.
    """
    if is_url(directory):
        raise typer.BadParameter("is a URL, which serve and push alone take: give a directory")
    return directory


IndexDir = Annotated[
    Path,
    typer.Option("--index", envvar="HEREABOUTS_INDEX_DIR", callback=check_local, help="directory of the index"),
]
Split = Annotated[str | None, typer.Option(help=SPLIT_HELP)]
Seed = Annotated[int, typer.Option(min=0, help="of everything that is drawn")]
