"""The command `batch`: georeference a CSV table with all CPUs; it can be stopped and continued."""
# ruff: noqa: PLC0415

from pathlib import Path
from typing import Annotated

import typer

from app.cli.options import INDEX_DIR, IndexDir
from models.errors import DataError


def batch(
    table_path: Annotated[Path, typer.Argument(metavar="TABLE", help="CSV file in UTF-8, with a header")],
    text: Annotated[str, typer.Option(help="column of the descriptions")],
    out: Annotated[Path, typer.Option("--out", "-o", help="CSV file to write")],
    lang_column: Annotated[
        str | None, typer.Option(help="column with the language of the remarks, such as 'sv'; default: the text's")
    ] = None,
    index_dir: IndexDir = INDEX_DIR,
) -> None:
    """Localize the rows of a CSV table and add the georeference terms of Darwin Core; continues a stopped run.

    The exit status is 1 if the text of a row cannot be used.
    """
    from app.workers.launch import prelaunched

    with prelaunched():
        from app.cli.progress import stage_bars
        from app.cli.table_rows import unfinished, write_rows
        from app.http.formats.csv_table import CsvTable
        from app.http.formats.darwin_core import ERROR
        from app.settings import load_settings
        from app.threads import usable_cpus
        from app.workers.messages import LocalizerSpec
        from app.workers.remote import open_workers
        from index.build.artifact import open_version

        try:
            table = CsvTable.check(lambda: table_path.open("rb"), text, lang_column)
            out = out.resolve()  # replace the target of a link, not the link
            if out.is_dir() or (out.exists() and out.samefile(table_path)):
                raise DataError(f"cannot be written to {out}; give a file that is neither the table nor a directory")
        except (DataError, OSError) as error:
            raise DataError(f"{table_path}: {getattr(error, 'strerror', None) or error}") from None
        directory, manifest = open_version(index_dir)
        if manifest.frame.origin_lat is None:
            raise DataError(f"{index_dir}: its map has no latitude and longitude; use 'hereabouts localize -'")
        settings = load_settings()
        work = manifest.version, *settings.weights, text, lang_column
        with unfinished(out, table_path, work) as file:
            localizers = open_workers(LocalizerSpec(directory, *settings.weights), settings.workers or usable_cpus())
            try:
                with stage_bars() as show:
                    statuses = write_rows(table, localizers, file, lambda done: show("rows", done, table.num_rows))
            finally:
                for localizer in localizers:
                    localizer.close()
    typer.echo(", ".join(f"{count} {status}" for status, count in statuses.most_common()) + f": {out}")
    raise typer.Exit(int(ERROR in statuses))
