"""The command line. Heavy imports are inside the commands, so that --help is quick."""
# ruff: noqa: PLC0415

import json
import sys
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text
from typer.core import TyperGroup

from models.errors import HereaboutsError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from index.answers import Answer
    from models.training.fit import Progress

INDEX_DIR = Path("data/index")
IndexDir = Annotated[Path, typer.Option("--index", envvar="HEREABOUTS_INDEX_DIR", help="directory of the index")]


class _Commands(TyperGroup):
    """Commands whose users see one line, not a traceback, when the input is wrong."""

    def invoke(self, ctx: Any) -> Any:  # typer does not export the types of its base class
        try:
            return super().invoke(ctx)
        except HereaboutsError as error:
            Console(stderr=True).print(Text(str(error), style="red"), soft_wrap=True)
            raise typer.Exit(1) from None


app = typer.Typer(
    cls=_Commands,
    help="Say in plain words what you see around you, and it says where in the city you are.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_show_locals=False,
)


@app.callback()
def prepare() -> None:
    """Before any command, and so before torch is imported, which reads the number of threads once."""
    from app.threads import set_thread_env

    set_thread_env()


@app.command()
def index(
    map_path: Annotated[Path, typer.Option("--map", help="map to index")],
    out: Annotated[Path, typer.Option(envvar="HEREABOUTS_INDEX_DIR", help="directory of the index")] = INDEX_DIR,
) -> None:
    """Build an index of a map."""
    from app.settings import load_settings
    from index.build import build_index

    version_dir = build_index(map_path, out, load_settings().weights_dir)
    typer.echo(f"index {version_dir.name} is in {version_dir}; serve it with: hereabouts serve --index {out}")


@app.command()
def serve(
    index_dir: IndexDir = INDEX_DIR,
    host: Annotated[str, typer.Option(envvar="HEREABOUTS_HOST", help="address to listen on")] = "127.0.0.1",
    port: Annotated[int, typer.Option(envvar="HEREABOUTS_PORT", help="0 takes a free one")] = 8000,
) -> None:
    """Serve an index over HTTP; the other settings are HEREABOUTS_ variables."""
    from app.logs import configure_logging
    from app.main import create_app
    from app.server import serve as serve_app
    from app.settings import load_settings

    settings = load_settings(index_dir=index_dir, host=host, port=port)
    configure_logging(settings.log_level)
    serve_app(create_app(settings), settings)


@app.command()
def localize(
    text: Annotated[str, typer.Argument(help="what is around you, for example 'I am north of a gray building.'")],
    index_dir: IndexDir = INDEX_DIR,
    top_k: Annotated[int, typer.Option(min=1, max=40, help="candidates to list")] = 5,
    as_json: Annotated[bool, typer.Option("--json", help="print JSON")] = False,
    picture: Annotated[Path | None, typer.Option(help="PNG to draw the answer into")] = None,
) -> None:
    """Say where the speaker of a description is."""
    from app.settings import load_settings
    from index.answers import Query
    from index.localizer import Localizer
    from models.language.hints_text import split_hints

    query = Query(hints=split_hints(text), top_k=top_k)
    settings = load_settings(index_dir=index_dir)
    localizer = Localizer.open(settings.index_dir, settings.weights_dir)
    [answer] = localizer.localize([query])
    if picture:
        from index.picture import draw_answer

        draw_answer(localizer, text, answer, picture)
    if as_json:
        _print_json(answer)
    else:
        _print_table(answer)


@app.command()
def train(
    out: Annotated[Path, typer.Option(help="directory for the weights")],
    map_path: Annotated[Path, typer.Option("--map", help="map whose west is trained on")],
    steps: Annotated[int | None, typer.Option(min=1, help="optimisation steps")] = None,
    seed: Annotated[int, typer.Option(help="of everything that is drawn")] = 0,
    text_encoder: Annotated[str, typer.Option(help="minilm, or the directory or hub id of a T5")] = "minilm",
) -> None:
    """Train a retriever on the west of a map, chosen on the strip beside it."""
    from models.city.osm import load_osm
    from models.retrieval.retriever import RetrieverConfig
    from models.training.fit import TrainingConfig, train_retriever

    config = TrainingConfig(seed=seed) if steps is None else TrainingConfig(seed=seed, steps=steps)
    with _training_bar() as show:
        recall = train_retriever(load_osm(map_path), out, RetrieverConfig(text_encoder=text_encoder), config, show)
    typer.echo(f"weights are in {out}; validation recall@1/3/5: {recall[1]:.3f} {recall[3]:.3f} {recall[5]:.3f}")


@contextmanager
def _training_bar() -> "Iterator[Callable[[Progress], None]]":
    """A progress bar with the loss and the last validation's recall@5."""
    from rich import progress as bars

    columns = (
        bars.TextColumn("{task.description}"),
        bars.BarColumn(),
        bars.MofNCompleteColumn(),
        bars.TimeRemainingColumn(),
    )
    with bars.Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task("preparing", total=None)
        recall = "-"

        def show(at: "Progress") -> None:
            nonlocal recall
            recall = f"{at.recall[5]:.3f}" if at.recall else recall
            bar.update(task, total=at.steps, completed=at.step, description=f"loss {at.loss:.3f}  recall@5 {recall}")

        yield show


@app.command()
def evaluate(
    data: Annotated[Path, typer.Option(help="map to ask about")],
    split: Annotated[str | None, typer.Option(help="train, val or test: its west, middle or east; all without")] = None,
    report: Annotated[Path | None, typer.Option(help="directory for report.json")] = None,
) -> None:
    """Recall on a map, beside chance, an oracle and the map's own ambiguity."""
    from app.settings import load_settings
    from index.evaluation import evaluate as run
    from models.retrieval.checkpoint import load_retriever

    _print_report(run(data, split, report, load_retriever(load_settings().weights_dir)))


def _print_report(report: dict[str, Any]) -> None:
    title = f"{report['data']}, {report['split']}: {report['queries']} queries, {report['cells']} cells"
    table = Table("", "R@1", "R@3", "R@5", "k=1: 5/10/15 m", "k=5", "k=10", title=title, title_justify="left")
    rows = {
        "retrieved cell's centre": report,
        "oracle cell's centre": {"localization": report["oracle"]},
        "chance": report["chance"],
        "exact matching of hints": {"retrieval": report["ambiguity"]["exact_matching"]},
    }
    for name, row in rows.items():
        recall = [f"{value:.3f}" for value in row.get("retrieval", {}).values()] or ["-"] * 3
        within = ["/".join(f"{v:.3f}" for v in by.values()) for by in row.get("localization", {}).values()] or ["-"] * 3
        table.add_row(name, *recall, *within)
    console = Console(width=120)
    console.print(table)
    console.print(
        f"median number of cells that fit a description as well as the true one, read exactly: "
        f"{report['ambiguity']['median_cells_that_fit_as_well']:.0f}; "
        f"calibration error of the probability: {report['calibration']['expected_calibration_error']:.3f}"
    )


@app.command()
def benchmark(
    map_path: Annotated[Path, typer.Option("--map", help="map to index")],
    index_dir: IndexDir = INDEX_DIR,
) -> None:
    """Seconds, memory and latency on this machine."""
    from app.benchmark import run_benchmark

    json.dump(run_benchmark(map_path, index_dir), sys.stdout, indent=2)
    sys.stdout.write("\n")


def _print_json(answer: "Answer") -> None:
    json.dump(asdict(answer), sys.stdout, allow_nan=False, indent=2, ensure_ascii=False)
    sys.stdout.write("\n")


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
        console.print(f"{answer.status}: no cell to answer with")
    else:
        x, y = answer.estimate.position
        radius = answer.estimate.radius_m
        console.print(
            f"{answer.status}: at {x:.1f}, {y:.1f} m, within {radius.p50:.0f} m (p50) or {radius.p90:.0f} m (p90), "
            f"probability {answer.estimate.probability:.2f}"
        )
    for warning in answer.warnings:
        console.print(Text(f"warning: {warning}", style="yellow"))


if __name__ == "__main__":
    app()
