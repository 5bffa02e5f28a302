"""The command line. Heavy imports are inside the commands, so that --help is fast."""
# ruff: noqa: PLC0415

import json
import signal
import sys
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text
from typer.core import TyperGroup

from app.cli import data as cli_data
from app.cli import maps as cli_maps
from app.cli import measure as cli_measure
from app.cli import records as cli_records
from app.cli import reproduce as cli_reproduce
from app.cli import train as cli_train
from app.cli.aliases import aliases
from app.cli.batch import batch
from app.cli.options import (
    DATA_HELP,
    EXTRA_FORMATS,
    FIELDS_HELP,
    INDEX_DIR,
    WITHIN_HELP,
    IndexDir,
    Split,
    check_shard_options,
    parse_fields,
    parse_shard,
    read_extras,
    run_index_job,
)
from index.answering.query import DEFAULT_REFINE, DEFAULT_TOP_K, Refine
from index.build.shard import MAX_SHARDS, Shard
from models.errors import HereaboutsError

if TYPE_CHECKING:
    from collections.abc import Callable

    from index.answering.answers import Answer
    from index.answering.localizer import Localizer
    from index.answering.query import Query

STDIN = "-"  # as the text of `localize`


class _Commands(TyperGroup):
    """A group of commands that show user errors as one line instead of a traceback."""

    def invoke(self, ctx: Any) -> Any:  # typer does not export the types of the base class
        try:
            return super().invoke(ctx)
        except HereaboutsError as error:
            Console(stderr=True).print(Text(str(error), style="red"), soft_wrap=True)
            raise typer.Exit(1) from None


app = typer.Typer(
    cls=_Commands,
    help="Describe in plain words what you see around you, and Hereabouts tells you where in the city you are.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_show_locals=False,
)


@app.callback()
def set_threads(context: typer.Context) -> None:
    """Set the number of threads before any command imports torch, which reads it once."""
    from app.threads import set_thread_env, usable_cpus

    set_thread_env(usable_cpus() if context.invoked_subcommand == "train" else 1)


@app.command()
def index(
    map_path: Annotated[Path, typer.Option("--map", help=DATA_HELP)],
    out: Annotated[Path, typer.Option(envvar="HEREABOUTS_INDEX_DIR", help="index directory")] = INDEX_DIR,
    split: Split = None,
    keep_current: Annotated[
        bool, typer.Option("--keep-current", help="do nothing if the index was built from this map and model")
    ] = False,
    levels: Annotated[
        bool,
        typer.Option(
            help="store all levels of the retriever, for other values of refine than posterior: 0.7 kB per cell",
        ),
    ] = True,
    store: Annotated[
        Literal["faiss", "milvus"],
        typer.Option(help="store of the vectors: a file, or the Milvus server of HEREABOUTS_MILVUS_URI"),
    ] = "faiss",
    within: Annotated[str | None, typer.Option(help=WITHIN_HELP)] = None,
    extra: Annotated[
        list[Path] | None,
        typer.Option(help=f"a city's own data, to join the map: {EXTRA_FORMATS}; may be repeated, each with a --kind"),
    ] = None,
    kind: Annotated[
        list[str] | None,
        typer.Option(
            help="kind of the objects of an --extra: waste_basket, amenity=waste_basket, or a word of your own"
        ),
    ] = None,
    list_places: Annotated[
        bool, typer.Option("--list-places", help="list the places of the file that --within accepts, and do nothing")
    ] = False,
    shard: Annotated[
        Shard | None,
        typer.Option(parser=parse_shard, metavar="I/N", help="build only shard I of N, for --merge"),
    ] = None,
    merge: Annotated[
        int | None, typer.Option(min=1, max=MAX_SHARDS, metavar="N", help="merge N shards into the index")
    ] = None,
    engine: Annotated[
        Literal["ray"] | None,
        typer.Option(help="build and merge the shards on a Ray cluster: --merge of them, or one per CPU"),
    ] = None,
    address: Annotated[str | None, typer.Option(help="address of the Ray cluster; default: a local one")] = None,
) -> None:
    """Build an index of a map."""
    if list_places:
        cli_maps.print_places(map_path)
        return
    check_shard_options(shard, merge, engine, address, keep_current)

    from app.cli.progress import stage_bars
    from app.settings import load_settings
    from index.build.build import IndexJob
    from models.sources.osm.extract import Region

    # leave the blocks that remove temporary files, as an interrupt from the keyboard does
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    extras = read_extras(extra or [], kind or [])
    region = None if within is None else Region.parse(within, map_path)
    arguments = map_path, out, load_settings().weights_dir, split, keep_current, levels
    with stage_bars() as show:
        path = run_index_job(IndexJob(*arguments, store, region, extras), shard, merge, engine, address, show)
    if shard:
        next_step = f"once all {shard.count} are built, run this with --merge {shard.count} instead of --shard {shard}"
        typer.echo(f"shard {shard} is in {path}; {next_step}")
    else:
        cli_maps.print_index_summary(path)
        typer.echo(f"index {path.name} is in {path}; serve it with: hereabouts serve --index {out}")


@app.command()
def serve(
    index_dir: IndexDir = INDEX_DIR,
    host: Annotated[str, typer.Option(envvar="HEREABOUTS_HOST", help="address to listen on")] = "127.0.0.1",
    port: Annotated[int, typer.Option(envvar="HEREABOUTS_PORT", help="port to listen on; 0: any free port")] = 8000,
    jobs: Annotated[
        Path, typer.Option(envvar="HEREABOUTS_JOBS_DIR", help="directory that keeps evaluations over restarts")
    ] = Path("data/jobs"),
) -> None:
    """Serve an index over HTTP. Other settings are HEREABOUTS_ environment variables."""
    from app.workers.launch import prelaunched

    with prelaunched():
        from app.logs import configure_logging
        from app.main import create_app
        from app.server import serve as serve_app
        from app.settings import load_settings

        settings = load_settings(index_dir=index_dir, host=host, port=port, jobs_dir=jobs)
        configure_logging(settings.log_level, settings.log_descriptions)
        serve_app(create_app(settings), settings)


@app.command()
def verify(index_dir: IndexDir = INDEX_DIR) -> None:
    """Verify the checksums of all registered versions of an index directory, or of one version."""
    from index.build.artifact import open_version, read_aliases
    from index.build.artifact import verify as verify_version

    registered = sorted(read_aliases(index_dir).versions)
    for directory in [index_dir / version for version in registered] or [open_version(index_dir)[0]]:
        manifest = verify_version(directory)
        typer.echo(f"index {manifest.version} of {manifest.map_name} is intact: {manifest.cells} cells")


@app.command()
def mcp(
    url: Annotated[str, typer.Option(help="address of the running service")] = "http://127.0.0.1:8000",
    key: Annotated[
        str | None, typer.Option(envvar="HEREABOUTS_READ_KEY", help="read key of the service, if needed")
    ] = None,
    http_port: Annotated[
        int | None, typer.Option(help="serve streamable HTTP at http://127.0.0.1:PORT/mcp; default: stdin and stdout")
    ] = None,
    allowed_host: Annotated[
        list[str] | None,
        typer.Option(help="host name by which a proxy reaches --http-port; may be repeated. Others get 421"),
    ] = None,
) -> None:
    """Offer the running service as tools for agents (Model Context Protocol)."""
    from app.client import AsyncClient
    from app.mcp import allow_hosts, build_server

    server = build_server(AsyncClient(url, key))
    if http_port is None:
        server.run()
    else:
        server.run("streamable-http", port=http_port, transport_security=allow_hosts(allowed_host or []))


@app.command()
def localize(
    text: Annotated[
        str,
        typer.Argument(
            help="a description, for example 'I am north of a gray building.'; -: read one description per line from "
            "standard input and print one JSON answer per line"
        ),
    ],
    index_dir: IndexDir = INDEX_DIR,
    top_k: Annotated[int, typer.Option(min=1, max=40, help="number of candidates")] = DEFAULT_TOP_K,
    refine: Annotated[Refine, typer.Option(help="how the position is found")] = DEFAULT_REFINE,
    fields: Annotated[str, typer.Option(help=FIELDS_HELP)] = "{}",
    as_json: Annotated[bool, typer.Option("--json", help="print JSON")] = False,
    picture: Annotated[Path | None, typer.Option(help="PNG file to draw the answer to")] = None,
    record: Annotated[
        Path | None, typer.Option(help="JSON file to write the request and the answer to, for 'hereabouts replay'")
    ] = None,
) -> None:
    """Find the position of the speaker of a description."""
    from app.http.errors import Problem
    from app.http.routes.localize import check_positions
    from app.settings import open_index
    from models.language.sentences import split_hints

    request = parse_fields(fields, top_k, refine)
    if text != STDIN:
        split_hints(text)  # raises DescriptionError before anything is loaded
    if record:
        from app.records import check_request, write_answer

        if text == STDIN:
            raise typer.BadParameter("--record keeps one answer: give one description with it")
        request = check_request(text, top_k=top_k, refine=refine)
    localizer = open_index(index_dir)
    try:
        check_positions(request, localizer)
    except Problem as problem:
        raise typer.BadParameter(f"--fields: {problem.detail}") from None
    query = request.to_query()

    def make_query(description: str) -> "Query":
        return replace(query, description=description)

    if text == STDIN:
        raise typer.Exit(_answer_lines(localizer, make_query))
    [answer] = localizer.localize([make_query(text)])
    if picture and answer.estimate:
        from index.answering.picture import draw_answer

        draw_answer(localizer, text, answer, picture)
    if record:
        write_answer(record, request, answer, localizer)
    if as_json:
        _print_json(answer)
    else:
        _print_table(answer)


def _answer_lines(localizer: "Localizer", make_query: "Callable[[str], Query]") -> int:
    """Answer each line of standard input with one line of JSON; return 1 if any line failed, each alone."""
    from models.language.sentences import split_hints

    failed = 0
    for line in filter(str.strip, sys.stdin):
        try:
            split_hints(line)
            [answer] = localizer.localize([make_query(line.strip())])
            _print_json(answer, indent=None)
        except HereaboutsError as error:
            failed = 1
            print(json.dumps({"error": str(error)}, ensure_ascii=False), flush=True)
    return failed


def _print_json(answer: "Answer", indent: int | None = 2) -> None:
    print(json.dumps(asdict(answer), allow_nan=False, indent=indent, ensure_ascii=False), flush=True)


def _print_table(answer: "Answer") -> None:
    console = Console()
    table = Table("rank", "cell", "probability", "position (m)", "lat, lon")
    for candidate in answer.candidates:
        place = candidate.wgs84
        table.add_row(
            str(candidate.rank),
            Text(candidate.cell_id),
            f"{candidate.probability:.3f}",
            f"{candidate.position[0]:.1f}, {candidate.position[1]:.1f}",
            f"{place.lat:.6f}, {place.lon:.6f}" if place else "-",
        )
    console.print(table)
    if answer.estimate is None:
        console.print(f"{answer.status}: no position")
    else:
        x, y = answer.estimate.position
        radius = answer.estimate.radius_m
        console.print(
            f"{answer.status}: at {x:.1f}, {y:.1f} m, within {radius.p50:.0f} m (p50) or {radius.p90:.0f} m (p90), "
            f"probability {answer.estimate.probability:.2f}"
        )
    if answer.question:
        choices = " / ".join(choice.text for choice in answer.question.choices)
        another = " / another name" if answer.question.is_open else ""
        console.print(Text(f"question: {answer.question.text} {choices}{another}"))
    for warning in answer.warnings:
        console.print(Text(f"warning: {warning}", style="yellow"))


for command in (
    batch,
    cli_maps.check,
    cli_data.prepare,
    cli_data.convert,
    cli_data.synth,
    cli_train.train,
    cli_records.replay,
    cli_measure.evaluate,
    cli_measure.questions,
    cli_measure.descriptions,
    cli_measure.benchmark,
    cli_reproduce.reproduce,
):
    app.command()(command)
app.add_typer(aliases, name="alias")


if __name__ == "__main__":
    app()
