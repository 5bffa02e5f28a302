"""Commands that measure. Heavy imports are inside the commands, so that --help is quick."""
# ruff: noqa: PLC0415

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.table import Table

import models
from app.cli.options import DATA_HELP, INDEX_DIR, IndexDir, Seed, Split
from index.answering.query import Refine
from models.errors import DataError
from models.sources.place_texts import SUFFIXES as TOLD_SUFFIXES

if TYPE_CHECKING:
    from app.settings import Settings
    from index.evaluation.report import Table as Rows

SHIPPED_MAP = Path(models.__file__).parent / "maps" / "helsinki.osm.pbf"


def evaluate(
    data: Annotated[
        Path | None,
        typer.Option(
            help=f"{DATA_HELP}; or, asked of --index, a .json file with the queries of a POST /evaluate, "
            "or texts about places as .jsonl: "
            "text, goal [lat, lon] and perhaps start [lat, lon]"
        ),
    ] = None,
    split: Split = None,
    index_dir: IndexDir = INDEX_DIR,
    report: Annotated[Path | None, typer.Option(help="directory for predictions, report.json, tables, plots")] = None,
    grow: Annotated[str | None, typer.Option(help="radii in metres of a growing gallery: 200,300,400,500")] = None,
    refine: Annotated[
        Refine | None, typer.Option(help="how positions are found; posterior, or what a .json says, if left out")
    ] = None,
    hard: Annotated[
        bool, typer.Option("--robustness", help="fewer, wrong and misspelt hints, free wording, an outdated map")
    ] = False,
    rescore: Annotated[Path | None, typer.Option(help="score the predictions of this report's directory again")] = None,
) -> None:
    """Recall on queries with known positions, beside chance, an oracle and exact matching of the hints."""
    from app.cli.progress import stage_bars
    from app.jobs.order import WEIGHTS_DIRS, Evaluation, read_evaluation
    from app.settings import load_settings
    from index.evaluation.evaluation import rescore as run_again

    if (data is None) == (rescore is None):
        raise DataError("name either --data, what to ask about, or --rescore, the directory of an earlier report")
    if data is None or rescore is not None:
        _print_report(run_again(Path(str(rescore))))
        return
    radii = _radii(grow)
    settings = load_settings(index_dir=index_dir)
    if data.name.endswith(TOLD_SUFFIXES):
        _evaluate_told(data, settings, report)
        return
    if data.suffix == ".json":
        asked = read_evaluation(data, settings, split, radii)
    else:
        weights = {name: getattr(settings, name) for name in WEIGHTS_DIRS}
        asked = Evaluation(**weights, data=data, split=split, grow_m=radii, refine="posterior")
    if refine:
        asked = asked.model_copy(update={"refine": refine})
    with stage_bars() as show:
        found = asked.run_robustness(report, show) if hard else asked.run(report, show)
    if hard:
        _print_robustness(found)
    else:
        _print_report(found)


def _evaluate_told(data: Path, settings: "Settings", report: Path | None) -> None:
    """Evaluate an index on texts about places."""
    from app.cli.progress import stage_bars
    from index.answering.localizer import Localizer
    from index.evaluation.place_texts import evaluate_texts, text_tables
    from models.sources.place_texts import load_place_texts

    texts = load_place_texts(data)
    weights = settings.weights_dir, settings.fine_weights_dir, settings.posterior_weights_dir
    with stage_bars() as show:
        found = evaluate_texts(Localizer.open(settings.index_dir, *weights), texts, report, show)
    _print_tables(Console(width=150), *text_tables(found))


def _print_robustness(found: dict[str, Any]) -> None:
    from index.evaluation.robustness import robustness_tables

    console = Console(width=140)
    console.print(f"{found['data']}, {found['split']}: {found['queries']} queries, {found['cells']} cells")
    _print_tables(console, *robustness_tables(found))


def _print_tables(console: Console, *tables: "Rows") -> None:
    for head, rows in tables:
        table = Table(*head)
        for row in rows:
            table.add_row(*row)
        console.print(table)


def _radii(grow: str | None) -> list[float]:
    try:
        return [float(radius) for radius in grow.split(",")] if grow else []
    except ValueError:
        raise DataError(f"--grow {grow}: no list of metres; give it as 200,300,400,500") from None


def _print_report(report: dict[str, Any]) -> None:
    from index.evaluation.report import group_table, growth_table, main_table

    console = Console(width=120)
    console.print(f"{report['data']}, {report['split']}: {report['queries']} queries, {report['cells']} cells")
    tables = [main_table(report)]
    tables += [group_table(name, report[key]) for name, key in (("scene", "by_scene"), ("strategy", "by_strategy"))]
    if "growth" in report:
        tables.append(growth_table(report["growth"]))
    _print_tables(console, *((head, rows) for head, rows in tables if len(rows) > 1))
    low, high = report["intervals"]["retrieval"]["5"]
    line = f"R@5 95 % interval {low:.3f}-{high:.3f}; calibration error of the probability: "
    line += f"{report['calibration']['expected_calibration_error']:.3f}"
    if "ambiguity" in report:
        fits = report["ambiguity"]["median_cells_that_fit_as_well"]
        line += f"; cells that fit a description as well as the true one (median): {fits:.0f}"
    console.print(line)


def questions(
    data: Annotated[Path, typer.Option(help=f"what tells the truth, which the index is of: {DATA_HELP}")],
    split: Split = None,
    index_dir: IndexDir = INDEX_DIR,
    texts: Annotated[int, typer.Option(min=1, help="how many")] = 300,
    seed: Seed = 0,
    plain: Annotated[bool, typer.Option("--plain", help="hints name classes alone, without winds and colours")] = False,
) -> None:
    """How far the service's questions help made-up people who say two hints, and answer, sometimes wrongly."""
    from app.cli.progress import stage_bars
    from app.settings import load_settings
    from index.answering.localizer import Localizer
    from index.evaluation.questions import evaluate_questions, questions_table
    from models.sources.source import open_source

    settings = load_settings(index_dir=index_dir)
    weights = settings.weights_dir, settings.fine_weights_dir, settings.posterior_weights_dir
    localizer = Localizer.open(settings.index_dir, *weights)
    with stage_bars() as show:
        source = open_source(data, split, show)
        found = evaluate_questions(localizer, source, texts, seed, show, is_plain=plain)
    console = Console(width=120)
    console.print(f"{found['data']}: {found['texts']} texts, seed {seed}")
    _print_tables(console, questions_table(found))
    console.print("asked: " + ", ".join(f"{count} {kind}" for kind, count in found["kinds"].items()))


def descriptions(
    index_dir: IndexDir = INDEX_DIR,
    positions: Annotated[int, typer.Option(min=1, help="how many, each in another cell")] = 200,
    seed: Seed = 0,
) -> None:
    """How well random positions of the map are found again by what POST /describe says of them."""
    from app.cli.progress import stage_bars
    from app.settings import load_settings
    from index.answering.localizer import Localizer
    from index.evaluation.descriptions import descriptions_table, evaluate_descriptions

    settings = load_settings(index_dir=index_dir)
    weights = settings.weights_dir, settings.fine_weights_dir, settings.posterior_weights_dir
    localizer = Localizer.open(settings.index_dir, *weights)
    with stage_bars() as show:
        found = evaluate_descriptions(localizer, positions, seed, show)
    console = Console(width=120)
    console.print(f"{found['data']}: {found['positions']} positions, seed {seed}")
    _print_tables(console, descriptions_table(found))


def benchmark(
    map_path: Annotated[
        Path | None, typer.Option("--map", help="map to index; with --cells the shipped one if it is left out")
    ] = None,
    index_dir: IndexDir = INDEX_DIR,
    cells: Annotated[
        str | None,
        typer.Option(
            help="sizes of a city made of copies of the map, about so many cells each: 1e4,1e5,1e6; --index is not used"
        ),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="with --cells, directory for benchmark.json and plots")] = None,
) -> None:
    """Seconds, memory and latency on this machine, of an index or, with --cells, as a city grows."""
    if cells is None:
        if map_path is None:
            raise typer.BadParameter("missing; only with --cells it may be left out", param_hint="'--map'")
        if out is not None:
            raise DataError("--out is for the figures of --cells; give that too, or leave --out out")
        from app.benchmark.service import run_benchmark

        found = run_benchmark(map_path, index_dir)
    else:
        from app.benchmark.growth import parse_sizes, run_growth

        found = run_growth(map_path or SHIPPED_MAP, parse_sizes(cells), out)
    if out is None:
        json.dump(found, sys.stdout, indent=2)
        sys.stdout.write("\n")
    else:
        typer.echo(f"figures and plots are in {out}")
    if "failed" in found:
        raise DataError(f"{found['failed']['cells']} cells were not measured: {found['failed']['why']}")
