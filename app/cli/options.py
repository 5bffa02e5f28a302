"""Options that several commands share."""

from pathlib import Path
from typing import Annotated

import typer

INDEX_DIR = Path("data/index")
DATA_HELP = (
    "an OpenStreetMap file (.osm.pbf, .osm), a directory in KITTI360Pose's layout (cells/*.pkl, poses/*.pkl), "
    "or a store written by 'convert'"
)
SPLIT_HELP = (
    "train, val or test; for KITTI360Pose's layout also scenes separated by commas, such as 0003,0005; "
    "default: everything"
)


IndexDir = Annotated[Path, typer.Option("--index", envvar="HEREABOUTS_INDEX_DIR", help="index directory")]
Split = Annotated[str | None, typer.Option(help=SPLIT_HELP)]
Seed = Annotated[int, typer.Option(min=0, help="random seed")]
