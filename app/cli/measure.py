"""Commands that measure. Heavy imports are inside the commands, so that --help is fast."""
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
from index.answering.query import Refine, Rerank
from models.errors import DataError
from models.sources.place_texts import SUFFIXES as PLACE_TEXT_SUFFIXES

if TYPE_CHECKING:
    from index.evaluation.report import Table as Rows

SHIPPED_MAP = Path(models.__file__).parent / "maps" / "helsinki.osm.pbf"


def evaluate(
    data: Annotated[
        Path | None,
        typer.Option(
            help=f"{DATA_HELP}; or queries for --index: a .json file with the body of POST /evaluate, "
            "or a .jsonl file of texts with text, goal [lat, lon] and, optionally, start [lat, lon]"
        ),
    ] = None,
    split: Split = None,
    index_dir: IndexDir = INDEX_DIR,
    report: Annotated[
        Path | None, typer.Option(help="directory for predictions, report.json, tables and plots")
    ] = None,
    grow: Annotated[
        str | None, typer.Option(help="radii in metres of a growing gallery, such as 200,300,400,500")
    ] = None,
    refine: Annotated[
        Refine | None, typer.Option(help="how positions are found; default: posterior, or the value in a .json file")
    ] = None,
    rerank: Annotated[
        Rerank | None,
        typer.Option(
            help="rank the first 20 cells again by matching hints with their objects; with --refine none, regressor "
            "or matching"
        ),
    ] = None,
    hard: Annotated[
        bool,
        typer.Option("--robustness", help="test fewer, wrong and misspelt hints, free wording and an outdated map"),
    ] = False,
    rescore: Annotated[
        Path | None, typer.Option(help="recompute the scores of the predictions in this report directory")
    ] = None,
) -> None:
    """Measure recall on queries with known positions, compared with chance, an oracle and exact matching of hints."""
    from app.cli.progress import stage_bars
    from app.jobs.evaluation import WEIGHTS_DIRS, Evaluation, read_evaluation
    from app.settings import load_settings
    from index.evaluation.evaluation import rescore as rescore_report

    if (data is None) == (rescore is None):
        raise DataError("give either --data, the queries, or --rescore, the directory of an earlier report")
    if data is None or rescore is not None:
        _check_rerank(rerank, "--rescore")
        _print_report(rescore_report(Path(str(rescore))))
        return
    radii = _radii(grow)
    if data.name.endswith(PLACE_TEXT_SUFFIXES):
        _check_rerank(rerank, "a file of texts")
        _evaluate_place_texts(data, index_dir, report)
        return
    settings = load_settings(index_dir=index_dir)
    if data.suffix == ".json":
        evaluation = read_evaluation(data, settings, split, radii)
    else:
        weights = {name: getattr(settings, name) for name in WEIGHTS_DIRS}
        evaluation = Evaluation(**weights, data=data, split=split, grow_m=radii, refine="posterior")
    if refine:
        evaluation = evaluation.model_copy(update={"refine": refine})
    if hard or evaluation.refine == "posterior":
        _check_rerank(rerank, "--robustness" if hard else "--refine posterior, the default")
    evaluation = evaluation.model_copy(update={"rerank": rerank})
    with stage_bars() as show:
        results = evaluation.run_robustness(report, show) if hard else evaluation.run(report, show)
    if hard:
        _print_robustness(results)
    else:
        _print_report(results)


def _check_rerank(rerank: Rerank | None, other: str) -> None:
    """Raise DataError if there is `rerank` beside something that it does not work with."""
    if rerank is not None:
        raise DataError(
            f"--rerank {rerank} changes the order of vector search and does not work with {other}; "
            "use it with --refine none, regressor or matching"
        )


def _evaluate_place_texts(data: Path, index_dir: Path, report: Path | None) -> None:
    from app.cli.progress import stage_bars
    from app.settings import open_index
    from index.evaluation.place_texts import evaluate_texts, text_tables
    from models.sources.place_texts import load_place_texts

    texts = load_place_texts(data)
    with stage_bars() as show:
        results = evaluate_texts(open_index(index_dir), texts, report, show)
    _print_tables(Console(width=150), *text_tables(results))


def _print_robustness(results: dict[str, Any]) -> None:
    from index.evaluation.robustness import robustness_tables

    console = Console(width=140)
    console.print(f"{results['data']}, {results['split']}: {results['queries']} queries, {results['cells']} cells")
    _print_tables(console, *robustness_tables(results))


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
        raise DataError(f"--grow {grow}: not a list of metres; write it as 200,300,400,500") from None


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
        line += f"; cells that fit a description as well as the true cell (median): {fits:.0f}"
    console.print(line)


def questions(
    data: Annotated[Path, typer.Option(help=f"the data set that the index was built from: {DATA_HELP}")],
    split: Split = None,
    index_dir: IndexDir = INDEX_DIR,
    texts: Annotated[int, typer.Option(min=1, help="number of texts")] = 300,
    seed: Seed = 0,
    plain: Annotated[
        bool, typer.Option("--plain", help="hints with classes only, without directions and colours")
    ] = False,
) -> None:
    """Measure how much the follow-up questions help simulated users with two hints, who sometimes answer wrongly."""
    from app.cli.progress import stage_bars
    from app.settings import open_index
    from index.evaluation.questions import evaluate_questions, questions_table
    from models.sources.source import open_source

    localizer = open_index(index_dir)
    with stage_bars() as show:
        source = open_source(data, split, show)
        results = evaluate_questions(localizer, source, texts, seed, show, is_plain=plain)
    console = Console(width=120)
    console.print(f"{results['data']}: {results['texts']} texts, seed {seed}")
    _print_tables(console, questions_table(results))
    console.print("asked: " + ", ".join(f"{count} {kind}" for kind, count in results["kinds"].items()))


def descriptions(
    index_dir: IndexDir = INDEX_DIR,
    positions: Annotated[int, typer.Option(min=1, help="number of positions, each in another cell")] = 200,
    seed: Seed = 0,
) -> None:
    """Measure how well random positions are found again from the text that POST /describe gives for them."""
    from app.cli.progress import stage_bars
    from app.settings import open_index
    from index.evaluation.descriptions import descriptions_table, evaluate_descriptions

    localizer = open_index(index_dir)
    with stage_bars() as show:
        results = evaluate_descriptions(localizer, positions, seed, show)
    console = Console(width=120)
    console.print(f"{results['data']}: {results['positions']} positions, seed {seed}")
    _print_tables(console, descriptions_table(results))


def benchmark(
    map_path: Annotated[
        Path | None, typer.Option("--map", help="map to index; with --cells, the default is the shipped map")
    ] = None,
    index_dir: IndexDir = INDEX_DIR,
    cells: Annotated[
        str | None,
        typer.Option(
            help="approximate numbers of cells of cities made of copies of the map: 1e4,1e5,1e6; --index is ignored"
        ),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="with --cells: directory for benchmark.json and plots")] = None,
) -> None:
    """Measure time, memory and latency on this machine, for one index or, with --cells, for growing cities."""
    if cells is None:
        if map_path is None:
            raise typer.BadParameter("missing; it is optional only with --cells", param_hint="'--map'")
        if out is not None:
            raise DataError("--out works only with --cells; give --cells too, or leave out --out")
        from app.benchmark.service import run_benchmark

        results = run_benchmark(map_path, index_dir)
    else:
        from app.benchmark.growth import parse_sizes, run_growth

        results = run_growth(map_path or SHIPPED_MAP, parse_sizes(cells), out)
    if out is None:
        json.dump(results, sys.stdout, indent=2)
        sys.stdout.write("\n")
    else:
        typer.echo(f"figures and plots are in {out}")
    if "failed" in results:
        raise DataError(f"{results['failed']['cells']} cells were not measured: {results['failed']['why']}")
