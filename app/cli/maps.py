"""Commands that show what is in a map. Heavy imports are inside the commands, so that --help is fast."""
# ruff: noqa: PLC0415

from pathlib import Path

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text


def print_places(map_path: Path) -> None:
    """Print the named areas of a map's file."""
    from models.sources.osm.places import list_places

    areas = list_places(map_path)
    table = Table("name", "admin_level", "place", "km2", "id", box=None, pad_edge=False)
    for area in areas:
        table.add_row(Text(area.names[0]), area.admin_level, area.place, area.size, area.source_id)
    Console(width=140).print(table)
    if not areas:
        typer.echo("no administrative boundary or settlement has a name; give --within a box or a GeoJSON file")
    elif any(area.shape is None for area in areas):
        typer.echo("incomplete: the file lacks a part of the boundary, so --within refuses the place")
