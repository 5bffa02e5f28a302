"""Options that several commands share."""

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


IndexDir = Annotated[Path, typer.Option("--index", envvar="HEREABOUTS_INDEX_DIR", help="directory of the index")]
Split = Annotated[str | None, typer.Option(help=SPLIT_HELP)]
Seed = Annotated[int, typer.Option(min=0, help="of everything that is drawn")]
