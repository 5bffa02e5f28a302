"""The command that trains models. Heavy imports are inside, so that --help is fast."""
# ruff: noqa: PLC0415

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console

from app.cli.options import DATA_HELP

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from models.training.engine.loop import Progress

ON_TEXTS = ("places", "certainty")  # methods that are fitted to texts about real places


def train(
    out: Annotated[Path, typer.Option(help="directory for the weights")],
    data: Annotated[list[Path], typer.Option(help=DATA_HELP + "; repeatable")],
    method: Annotated[
        str,
        typer.Option(
            help="a retriever (mncl, text2loc, ret, text2pos), a fine stage (regressor, matching), points (a point "
            "encoder for either), posterior, places (the posterior's cue readers and place kernels), or certainty (how "
            "sure the answers are; each --data is then an index)"
        ),
    ] = "mncl",
    change: Annotated[
        list[str] | None,
        typer.Option(
            "--set", help="a setting, such as model.levels=global,instance or training.batch_size=64; repeatable"
        ),
    ] = None,
    split: Annotated[str, typer.Option(help="split to train on")] = "train",
    val_split: Annotated[str, typer.Option(help="split for model selection")] = "val",
    steps: Annotated[int | None, typer.Option(min=1, help="optimization steps")] = None,
    seed: Annotated[int | None, typer.Option(min=0, help="random seed")] = None,
    text_encoder: Annotated[str | None, typer.Option(help="minilm, or a directory or hub id of a T5")] = None,
    run_dir: Annotated[
        Path | None, typer.Option(help="directory for metrics, curves, the best weights and the state for --resume")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="continue the run in --run-dir, if there is one")] = False,
    reader: Annotated[
        Path | None,
        typer.Option(
            help="weights to start from: only the likelihood (posterior) or the cues and kernels (places) are fitted"
        ),
    ] = None,
    texts: Annotated[
        list[str] | None,
        typer.Option(
            help="for places and certainty: .jsonl files for a --data, separated by commas; one --texts per --data"
        ),
    ] = None,
) -> None:
    """Train a model on the train split of a data set; for an OpenStreetMap file this is its west."""
    from models.errors import TrainingError
    from models.training.settings import load_settings

    if resume and run_dir is None:
        raise TrainingError("--resume continues the run in --run-dir; give that directory")
    if reader is not None and method not in ("posterior", *ON_TEXTS):
        raise TrainingError("--reader is for --method posterior, places and certainty")
    if method in ON_TEXTS or texts:
        _train_places(method, data, texts or [], reader, out, steps, seed)
        return
    options = {"training.seed": seed, "training.steps": steps, "model.text_encoder": text_encoder}
    overrides = [f"{name}={value}" for name, value in options.items() if value is not None]
    model, config = load_settings(method, [*(change or []), *overrides])
    with _training_bar() as show:
        figures = _train_model(reader, data, (split, val_split), method, model, config, out, run_dir, resume, show)
        typer.echo(f"weights are in {out}; validation {figures}")


def _train_places(
    method: str, data: list[Path], texts: list[str], reader: Path | None, out: Path, steps: int | None, seed: int | None
) -> None:
    from app.cli.progress import stage_bars
    from models.errors import TrainingError
    from models.training.posterior.fit_kernels import STEPS
    from models.training.posterior.train_places import train_places

    if method not in ON_TEXTS or len(texts) != len(data):
        raise TrainingError(
            "--texts is for --method places and certainty: give the texts of each --data, in the same order"
        )
    maps = [(path, [Path(name) for name in files.split(",")]) for path, files in zip(data, texts, strict=True)]
    if method == "certainty":
        from index.evaluation.certainty import calibrate_certainty, certainty_table
        from index.evaluation.report import as_markdown

        with stage_bars() as show:
            figures = calibrate_certainty(maps, reader, out, show)
        typer.echo(f"{as_markdown(certainty_table(figures))}\n\nweights are in {out}")
        return
    with stage_bars() as show:
        figures = train_places(
            maps,
            reader,
            out,
            steps or STEPS,
            seed or 0,
            lambda stage, done, total, loss: show(f"{stage}, {loss:.2f}", done, total),
        )
    typer.echo(f"weights are in {out}; {', '.join(f'{name} {value:.3f}' for name, value in figures.items())}")


def _loader(data: list[Path], splits: tuple[str, str], config: Any) -> "Callable[..., Any]":
    from models.training.training_data import load_training_data

    return lambda encoder, rng: [load_training_data(path, splits, encoder, config, rng) for path in data]


def _train_model(
    reader: Path | None, data: list[Path], splits: tuple[str, str], method: str, model: Any, config: Any, *run: Any
) -> str:
    """Train any other model and format its validation figures; `run` is the tail of each trainer's arguments."""
    from models.paper.checkpoint import METHODS
    from models.paper.fine.checkpoint import FINE_METHODS

    figures: dict[str, float]
    if method == "posterior":
        from models.training.posterior.fit_posterior import refit_posterior, train_posterior

        if reader is None:
            figures = train_posterior(data, splits, run[0], model, config, *run[1:])
        else:
            figures = refit_posterior(reader, data, splits, run[0], config)
    elif method == "points":
        from models.training.fit_points import train_points
        from models.training.training_data import load_training_cells

        cells = [load_training_cells(path, splits) for path in data]
        figures = train_points(cells, run[0], config, *run[1:], architecture=model.point_encoder)
    elif method in FINE_METHODS:
        from models.training.fit_fine import train_fine

        figures = train_fine(_loader(data, splits, config), run[0], method, model, config, *run[1:])
    else:
        from models.training.fit_retriever import train_retriever

        recall = train_retriever(_loader(data, splits, config), run[0], METHODS[method], model, config, *run[1:])
        return f"recall@1/3/5: {recall[1]:.3f} {recall[3]:.3f} {recall[5]:.3f}"
    return ", ".join(f"{name} {value:.3f}" for name, value in figures.items())


@contextmanager
def _training_bar() -> "Iterator[Callable[[Progress], None]]":
    from rich import progress as rich

    columns = rich.TextColumn("{task.description}"), rich.BarColumn(), rich.MofNCompleteColumn()
    with rich.Progress(*columns, rich.TimeRemainingColumn(), console=Console(stderr=True)) as bar:
        task = bar.add_task("preparing", total=None)
        validation = ""

        def show(progress: "Progress") -> None:
            nonlocal validation
            validation = (
                "  ".join(f"{name} {value:.3f}" for name, value in (progress.figures or {}).items()) or validation
            )
            text = f"loss {progress.loss:.3f}  {validation}  {progress.descriptions_per_second:.0f} descriptions/s"
            bar.update(task, total=progress.steps, completed=progress.step, description=text)

        yield show
