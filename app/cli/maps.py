"""Commands that show what is in a map. Heavy imports are inside the commands, so that --help is fast."""
# ruff: noqa: PLC0415

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

from app.cli.options import WITHIN_HELP

if TYPE_CHECKING:
    from models.citymap.summary import MapSummary

WIDTH = 120  # characters of a line


def check(
    map_path: Annotated[Path, typer.Argument(metavar="MAP", help="an OpenStreetMap file (.osm.pbf, .osm)")],
    within: Annotated[str | None, typer.Option(help=WITHIN_HELP)] = None,
) -> None:
    """Show what a map is good for, and what indexing it will take, without indexing it."""
    from index.build.estimate import estimate_cost
    from models.sources.osm.extract import Region, extracted_file
    from models.sources.osm.summary import load_gazetteer_and_summary

    with extracted_file(map_path, Region.parse(within, map_path) if within else None) as path:
        summary = load_gazetteer_and_summary(path)[1]
    cost = estimate_cost(summary)
    print_summary(
        map_path.name,
        summary,
        f"about {cost.cpu_s:,.0f} s of one processor and {cost.bytes / 1e6:,.0f} MB (estimated from other cities)",
    )


def print_summary(name: str, summary: "MapSummary", cost: str) -> None:
    """Print the summary of a map, with what indexing it takes in words."""
    table = Table(box=None, show_header=False, pad_edge=False)
    for title, text in (*_rows(name, summary), ("index", cost), *_advice(summary)):
        table.add_row(title, Text(text))
    Console(width=WIDTH).print(table)


def print_index_summary(directory: Path) -> None:
    """Print the summary of a new index version; a data set has none."""
    from index.build.manifest import read_manifest

    manifest = read_manifest(directory)
    if manifest.summary is not None:
        size = sum(file.bytes for file in manifest.files.values())
        print_summary(manifest.map_name, manifest.summary, f"{manifest.cells:,} cells, {size / 1e6:,.1f} MB")


def _rows(name: str, summary: "MapSummary") -> Iterator[tuple[str, str]]:
    size = f"{summary.width_km:,.2f} x {summary.height_km:,.2f} km"
    yield "map", f"{name}: {size}, box {','.join(f'{degrees:.5f}' for degrees in summary.bbox)}"
    yield "walkable", f"{summary.walkable_km:,.{0 if summary.walkable_km >= 10 else 1}f} km of streets and paths"
    yield "streets", f"{summary.streets:,} with a name"
    yield "objects", f"{summary.objects:,}, of which {summary.named_objects:,} have a name"
    yield "kinds", _counts(summary.kinds)
    yield "house numbers", f"{summary.house_numbers:,}"
    yield "scripts", _counts(summary.scripts)
    yield "languages", _counts(summary.languages)
    for layer, count in summary.extras.items():
        yield "extra", f"{count:,} objects of {layer}"
    for title in ("cut", "dropped", "repaired"):
        for reason, count in getattr(summary, title).items():
            yield title, f"{count:,}: {reason}"


def _counts(counts: Mapping[str, int]) -> str:
    return ", ".join(f"{name} {count:,}" for name, count in counts.items()) or "none"


def _advice(summary: "MapSummary") -> Iterator[tuple[str, str]]:
    """Yield what descriptions cannot use on a map."""
    if not summary.walkable_km:
        yield "note", "nobody can stand anywhere: the map has no street, path or square; take a larger extract"
    if not summary.streets:
        yield "note", "no street has a name, so descriptions need other names or objects"
    if not summary.house_numbers:
        yield "note", "there are no house numbers, so addresses cannot be located"


def print_places(map_path: Path) -> None:
    """Print the named areas of a map's file."""
    from models.sources.osm.places import list_places

    areas = list_places(map_path)
    table = Table("name", "admin_level", "place", "km2", "id", box=None, pad_edge=False)
    for area in areas:
        table.add_row(Text(area.names[0]), area.admin_level, area.place, area.size, area.source_id)
    Console(width=WIDTH).print(table)
    if not areas:
        typer.echo("no administrative boundary or settlement has a name; give --within a box or a GeoJSON file")
    elif any(area.shape is None for area in areas):
        typer.echo("incomplete: the file lacks a part of the boundary, so --within refuses the place")
