"""The command that answers a record again."""
# ruff: noqa: PLC0415

from pathlib import Path
from typing import Annotated

import typer

from app.cli.options import INDEX_DIR, IndexDir

MAX_LINES = 20  # differences to print


def replay(
    path: Annotated[Path, typer.Argument(metavar="RECORD", help="a file that 'localize --record' wrote")],
    index_dir: IndexDir = INDEX_DIR,
    html: Annotated[Path | None, typer.Option(help="page to write about the record, one sheet of A4")] = None,
) -> None:
    """Localize the description of a record again; the exit status is 1 if the answer differs."""
    from app.records import Record, record_page, write_text
    from app.records import replay as replay_record
    from app.settings import open_index
    from index.build.artifact import DEFAULT_ALIAS, find_version

    record = Record.read(path)
    alias = record.request.index
    localizer = open_index(index_dir if alias == DEFAULT_ALIAS else find_version(index_dir, alias)[0])
    response = replay_record(record, localizer)
    differences = record.differences(response)
    if html:
        write_text(html, record_page(path, record, differences, localizer))
    old, new = record.answer.provenance, response.provenance
    if old.index_version != new.index_version:
        typer.echo(f"another index: {new.index_version}, the record is of {old.index_version}")
        if (index_dir / old.index_version).is_dir():
            typer.echo(f"to replay it with its own: --index {index_dir / old.index_version}")
    if old.model_sha256 != new.model_sha256:
        typer.echo(f"another model: {new.model} {new.model_sha256}, the record is of {old.model} {old.model_sha256}")
    if not differences:
        typer.echo("the answer is the same, to the digit")
        return
    typer.echo("the answer differs in")
    for difference in differences[:MAX_LINES]:
        typer.echo(f"  {difference}")
    if len(differences) > MAX_LINES:
        typer.echo(f"  and {len(differences) - MAX_LINES} more")
    raise typer.Exit(1)
