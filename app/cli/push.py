"""The command that sends an index elsewhere. Heavy imports are inside it, so that --help is quick."""
# ruff: noqa: PLC0415

from typing import Annotated

import typer

from app.cli.options import INDEX_DIR, IndexDir


def push(
    url: Annotated[str, typer.Argument(help="where to, as fsspec knows it: s3://bucket/town, file:///shared/town")],
    index_dir: IndexDir = INDEX_DIR,
) -> None:
    """Send the versions that an index's aliases name to where `serve --index URL` fetches them."""
    from app.cli.progress import stage_bars
    from index.remote.place import Place
    from index.remote.push import push as push_index

    place = Place(url)
    with stage_bars() as show:
        there = push_index(index_dir, place, show)
    named = ", ".join(f"{alias} ({version})" for alias, version in sorted(there.aliases.items()))
    typer.echo(f"{place.url} has {named}; serve it with: hereabouts serve --index {place.url}")
