"""The command that trains. Heavy imports are inside, so that --help is quick."""
# ruff: noqa: PLC0415

from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console

from app.cli.options import DATA_HELP

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from models.training.engine.loop import Progress


def train(
    out: Annotated[Path, typer.Option(help="directory for the weights")],
    data: Annotated[list[Path], typer.Option(help=DATA_HELP + "; may be given several times")],
    method: Annotated[
        str,
        typer.Option(
            help="a retriever (mncl, text2loc, ret, text2pos), a fine stage (regressor, matching), points: the point "
            "encoder that either may take, posterior, or places: its reader of cues and kernels of places"
        ),
    ] = "mncl",
    change: Annotated[
        list[str] | None,
        typer.Option("--set", help="a setting: model.levels=global,instance or training.batch_size=64; repeatable"),
    ] = None,
    split: Annotated[str, typer.Option(help="what to train on")] = "train",
    val_split: Annotated[str, typer.Option(help="what to choose by")] = "val",
    steps: Annotated[int | None, typer.Option(min=1, help="optimisation steps")] = None,
    seed: Annotated[int | None, typer.Option(min=0, help="of everything that is drawn")] = None,
    text_encoder: Annotated[str | None, typer.Option(help="minilm, or the directory or hub id of a T5")] = None,
    run_dir: Annotated[
        Path | None, typer.Option(help="directory for metrics, curves, best weights and what --resume goes on from")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="go on with the run in --run-dir, if there is one")] = False,
    reader: Annotated[
        Path | None,
        typer.Option(help="weights that are kept but for the likelihood (posterior), or for cues and kernels (places)"),
    ] = None,
    texts: Annotated[
        list[str] | None,
        typer.Option(help="of places: .jsonl files about each --data, joined by commas; as many as there are --data"),
    ] = None,
) -> None:
    """Train a model: on the train scenes of a data set, or the west of an OpenStreetMap file."""
    from models.errors import TrainingError
    from models.paper.fine.checkpoint import FINE_METHODS
    from models.training.settings import load_settings

    if resume and run_dir is None:
        raise TrainingError("--resume goes on with the run in --run-dir; name that directory")
    if reader is not None and method not in ("posterior", "places"):
        raise TrainingError("--reader is for --method posterior and places")
    if method == "places" or texts:
        _train_places(method, data, texts or [], reader, out, steps, seed)
        return
    options = {"training.seed": seed, "training.steps": steps, "model.text_encoder": text_encoder}
    named = [f"{name}={value}" for name, value in options.items() if value is not None]
    model, config = load_settings(method, [*(change or []), *named])
    given = data, (split, val_split), method, model, config, out, run_dir, resume

    with _training_bar() as show:
        train_it: Callable[..., str] = _train_fine if method in FINE_METHODS else _train_retriever
        if method == "posterior":
            train_it = partial(_train_posterior, reader)
        elif method == "points":
            train_it = _train_points
        found = train_it(*given, show)
        typer.echo(f"weights are in {out}; validation {found}")


def _train_places(
    method: str, data: list[Path], texts: list[str], reader: Path | None, out: Path, steps: int | None, seed: int | None
) -> None:
    """Train the reader of cues and fit the kernels of places."""
    from app.cli.progress import stage_bars
    from models.errors import TrainingError
    from models.training.posterior.fit_kernels import STEPS
    from models.training.posterior.train_places import train_places

    if method != "places" or len(texts) != len(data):
        raise TrainingError("--texts is for --method places: name the texts of each --data, in the same order")
    maps = [(path, [Path(name) for name in files.split(",")]) for path, files in zip(data, texts, strict=True)]
    with stage_bars() as show:
        found = train_places(
            maps,
            reader,
            out,
            steps or STEPS,
            seed or 0,
            lambda stage, done, total, loss: show(f"{stage}, {loss:.2f}", done, total),
        )
    typer.echo(f"weights are in {out}; {', '.join(f'{name} {value:.3f}' for name, value in found.items())}")


def _loader(data: list[Path], splits: tuple[str, str], config: Any) -> "Callable[..., Any]":
    """Reads what to train on, given a text encoder and a generator."""
    from models.training.training_data import load_training_data

    return lambda encoder, rng: [load_training_data(path, splits, encoder, config, rng) for path in data]


def _train_retriever(
    data: list[Path], splits: tuple[str, str], method: str, model: Any, config: Any, *where: Any
) -> str:
    """Train a retriever; its figures in words."""
    from models.paper.checkpoint import METHODS
    from models.training.fit_retriever import train_retriever

    out, *rest = where
    recall = train_retriever(
        _loader(data, splits, config),
        out, METHODS[method], model, config, *rest,
    )  # fmt: skip
    return f"recall@1/3/5: {recall[1]:.3f} {recall[3]:.3f} {recall[5]:.3f}"


def _train_fine(data: list[Path], splits: tuple[str, str], method: str, model: Any, config: Any, *where: Any) -> str:
    """Train a model of the fine stage; its figures in words."""
    from models.training.fit_fine import train_fine

    out, *rest = where
    figures = train_fine(
        _loader(data, splits, config),
        out, method, model, config, *rest,
    )  # fmt: skip
    return ", ".join(f"{name} {value:.3f}" for name, value in figures.items())


def _train_points(data: list[Path], splits: tuple[str, str], method: str, model: Any, config: Any, *where: Any) -> str:
    """Train the point encoder; its figures in words."""
    from models.training.fit_points import train_points
    from models.training.training_data import load_training_cells

    figures = train_points([load_training_cells(path, splits) for path in data], where[0], config, *where[1:])
    return ", ".join(f"{name} {value:.3f}" for name, value in figures.items())


def _train_posterior(
    reader: Path | None,
    data: list[Path],
    splits: tuple[str, str],
    method: str,
    model: Any,
    config: Any,
    out: Path,
    *rest: Any,
) -> str:
    """Train the hint posterior, or fit its likelihood alone; its figures in words."""
    from models.training.posterior.fit_posterior import refit_posterior, train_posterior

    if reader is None:
        figures = train_posterior(data, splits, out, model, config, *rest)
    else:
        figures = refit_posterior(reader, data, splits, out, config)
    return ", ".join(f"{name} {value:.3f}" for name, value in figures.items())


@contextmanager
def _training_bar() -> "Iterator[Callable[[Progress], None]]":
    """A progress bar with the loss, the last validation and the speed."""
    from rich import progress as bars

    columns = (
        bars.TextColumn("{task.description}"),
        bars.BarColumn(),
        bars.MofNCompleteColumn(),
        bars.TimeRemainingColumn(),
    )
    with bars.Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task("preparing", total=None)
        measured = ""

        def show(at: "Progress") -> None:
            nonlocal measured
            measured = "  ".join(f"{name} {value:.3f}" for name, value in (at.figures or {}).items()) or measured
            text = f"loss {at.loss:.3f}  {measured}  {at.descriptions_per_second:.0f} descriptions/s"
            bar.update(task, total=at.steps, completed=at.step, description=text)

        yield show
