"""Commands that train and measure. Heavy imports are inside the commands, so that --help is quick."""
# ruff: noqa: PLC0415

import json
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.table import Table

from app.options import DATA_HELP, INDEX_DIR, IndexDir, Seed, Split
from models.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from models.training.fit import Progress


def train(
    out: Annotated[Path, typer.Option(help="directory for the weights")],
    data: Annotated[list[Path], typer.Option(help=DATA_HELP + "; may be given several times")],
    split: Annotated[str, typer.Option(help="of a data set: what to train on")] = "train",
    val_split: Annotated[str, typer.Option(help="of a data set: what to choose by")] = "val",
    steps: Annotated[int | None, typer.Option(min=1, help="optimisation steps")] = None,
    seed: Seed = 0,
    text_encoder: Annotated[str, typer.Option(help="minilm, or the directory or hub id of a T5")] = "minilm",
) -> None:
    """Train a retriever: on the train scenes of a data set, or the west of an OpenStreetMap file."""
    from models.retrieval.retriever import RetrieverConfig
    from models.training.fit import TrainingConfig, train_retriever
    from models.training.sources import load_source

    config = TrainingConfig(seed=seed) if steps is None else TrainingConfig(seed=seed, steps=steps)
    model = RetrieverConfig(text_encoder=text_encoder)
    with _training_bar() as show:
        recall = train_retriever(
            lambda encoder, rng: [
                load_source(path, encoder, config.spacing_m, rng, (split, val_split)) for path in data
            ],
            out,
            model,
            config,
            show,
        )
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


def evaluate(
    data: Annotated[
        Path | None,
        typer.Option(help=f"{DATA_HELP}; or a .json file with the queries of a POST /evaluate, asked of --index"),
    ] = None,
    split: Split = None,
    index_dir: IndexDir = INDEX_DIR,
    report: Annotated[Path | None, typer.Option(help="directory for predictions, report.json, tables, plots")] = None,
    grow: Annotated[str | None, typer.Option(help="radii in metres of a growing gallery: 200,300,400,500")] = None,
    rescore: Annotated[Path | None, typer.Option(help="score the predictions of this report's directory again")] = None,
) -> None:
    """Recall on queries with known positions, beside chance, an oracle and exact matching of the hints."""
    from app.evaluation import Evaluation, read_evaluation
    from app.progress import stage_bars
    from app.settings import load_settings
    from index.evaluation import rescore as run_again

    if (data is None) == (rescore is None):
        raise DataError("name either --data, what to ask about, or --rescore, the directory of an earlier report")
    if data is None or rescore is not None:
        _print_report(run_again(Path(str(rescore))))
        return
    radii = _radii(grow)
    settings = load_settings(index_dir=index_dir)
    if data.suffix == ".json":
        asked = read_evaluation(data, settings, split, radii)
    else:
        asked = Evaluation(weights_dir=settings.weights_dir, data=data, split=split, grow_m=radii)
    with stage_bars() as show:
        found = asked.run(report, show)
    _print_report(found)


def _radii(grow: str | None) -> list[float]:
    try:
        return [float(radius) for radius in grow.split(",")] if grow else []
    except ValueError:
        raise DataError(f"--grow {grow}: no list of metres; give it as 200,300,400,500") from None


def _print_report(report: dict[str, Any]) -> None:
    from index.report import group_table, growth_table, main_table

    console = Console(width=120)
    console.print(f"{report['data']}, {report['split']}: {report['queries']} queries, {report['cells']} cells")
    tables = [main_table(report)]
    tables += [group_table(name, report[key]) for name, key in (("scene", "by_scene"), ("strategy", "by_strategy"))]
    if "growth" in report:
        tables.append(growth_table(report["growth"]))
    for head, rows in tables:
        if len(rows) > 1:
            table = Table(*head)
            for row in rows:
                table.add_row(*row)
            console.print(table)
    low, high = report["intervals"]["retrieval"]["5"]
    line = f"R@5 95 % interval {low:.3f}-{high:.3f}; calibration error of the probability: "
    line += f"{report['calibration']['expected_calibration_error']:.3f}"
    if "ambiguity" in report:
        fits = report["ambiguity"]["median_cells_that_fit_as_well"]
        line += f"; cells that fit a description as well as the true one (median): {fits:.0f}"
    console.print(line)


def benchmark(
    map_path: Annotated[Path, typer.Option("--map", help="map to index")],
    index_dir: IndexDir = INDEX_DIR,
) -> None:
    """Seconds, memory and latency on this machine."""
    from app.benchmark import run_benchmark

    json.dump(run_benchmark(map_path, index_dir), sys.stdout, indent=2)
    sys.stdout.write("\n")
