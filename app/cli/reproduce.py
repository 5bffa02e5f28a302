"""The command that makes the paper's tables again. Heavy imports are inside, so that --help is quick."""
# ruff: noqa: PLC0415

import tomllib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from models.errors import DataError, TrainingError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from models.training.experiments import TrainingRun, TrainingScale

MADE_UP = ("demo", "full")  # scales of `models.sources.synthetic.towns.write_towns`
TOWN_SEED = 0
PARTS = ("retriever", "fine", "points")  # tables of a --config


def reproduce(
    out: Annotated[Path, typer.Option(help="directory for runs and report; what is done there is kept")],
    data: Annotated[str, typer.Option(help="demo or full (made-up towns), or a directory of KITTI360Pose")] = "demo",
    seeds: Annotated[str, typer.Option(help="of the trainings: 0 or 0,1,2; figure 4 is made with the first")] = "0",
    tables: Annotated[
        str | None, typer.Option(help="1, 2, 3, 4, 4a, 4b, graph, attention, code, inputs; else all")
    ] = None,
    steps: Annotated[int | None, typer.Option(min=1, help="of each training")] = None,
    epochs: Annotated[
        int | None, typer.Option(min=1, help="of each training; validates after each, halves the rate every five")
    ] = None,
    config: Annotated[
        Path | None,
        typer.Option(help="TOML: tables retriever, fine, points, in each model and training, as --set of train"),
    ] = None,
    workers: Annotated[int | None, typer.Option(min=1, help="trainings at once; else one a GPU or processor")] = None,
    device: Annotated[str | None, typer.Option(help="auto, cpu or cuda; of several GPUs each takes its turn")] = None,
    report: Annotated[Path | None, typer.Option(help="directory for the report; OUT if left out")] = None,
) -> None:
    """Make the tables 1-4 and figures 3-5 of MNCL: train what is missing, measure, print beside what is published."""
    from app.cli.progress import stage_bars
    from index.evaluation.reproduction.report import write_reproduction
    from index.evaluation.reproduction.reproduce import choose_experiments, figure_3_path, scale_in_epochs
    from index.evaluation.reproduction.reproduce import reproduce as run
    from models.training.experiments import POINTS, SCALES, TrainingRun, required_runs

    if steps and epochs:
        raise DataError("--steps and --epochs both say how long to train; give one of them")
    numbers, experiments = _numbers(seeds), choose_experiments(tables)
    scale = _changed(SCALES["demo" if data == "demo" else "full"], config, steps, device)
    at_once = _checked(scale, (*required_runs(experiments, every_seed=False), TrainingRun(POINTS)), config)
    with stage_bars() as show:
        store = _store(_towns(data, out, show) if data in MADE_UP else Path(data), out, show)
        scale = scale_in_epochs(scale, store, epochs) if epochs else scale
        found = run(store, out, scale, numbers, workers or at_once, show, experiments)
    name = f"the {data} towns" if data in MADE_UP else Path(data).resolve().name
    directory = report or out
    write_reproduction(directory, found, name, figure_3_path(store, out, scale, numbers[0], experiments))
    typer.echo(f"the report is {directory / 'report.md'}")


def _changed(scale: "TrainingScale", config: Path | None, steps: int | None, device: str | None) -> "TrainingScale":
    """A scale with what a configuration file and the options say, the latter last."""
    told = _read(config) if config else {}
    lasts = (f"training.steps={steps}", f"training.validate_every={max(1, steps // 20)}") if steps else ()
    on = (f"training.device={device}",) if device else ()
    parts = {
        part: (*getattr(scale, part), *told.get(part, ()), *(() if part == "points" else lasts), *on) for part in PARTS
    }
    return replace(scale, **parts)


def _checked(scale: "TrainingScale", runs: "Sequence[TrainingRun]", config: Path | None) -> int:
    """How many can be trained at once; what cannot be trained with is said before any work."""
    import torch

    from app.threads import usable_cpus
    from index.evaluation.reproduction.jobs import run_settings
    from models.training.engine.loop import pick_device

    kinds = set()
    for run in runs:
        try:
            kinds.add(pick_device(run_settings(run, 0, scale)[1].device).type)
        except TrainingError as error:
            raise TrainingError(f"{f'--config {config}, ' if config else ''}{run.method}: {error}") from error
    return torch.cuda.device_count() if "cuda" in kinds else usable_cpus()


def _read(config: Path) -> dict[str, tuple[str, ...]]:
    """The settings of each part of a configuration file, as `load_settings` takes them."""
    try:
        tables: dict[str, Any] = tomllib.loads(config.read_text())
    except (OSError, ValueError) as error:
        raise DataError(f"--config {config} cannot be read ({error}); it is a TOML file, see docs/use.md") from error
    if unknown := [part for part in tables if part not in PARTS]:
        raise DataError(f"--config {config}: there is no table '{unknown[0]}'; it has {', '.join(PARTS)}")
    for part, of_part in tables.items():
        if not isinstance(of_part, dict) or not all(isinstance(fields, dict) for fields in of_part.values()):
            raise DataError(f"--config {config}: settings stand in {part}.model or {part}.training")
        if "inputs" in of_part.get("model", {}):
            raise DataError(f"--config {config}: inputs are what the tables compare; choose a table with --tables")
    return {
        part: tuple(
            f"{table}.{name}={','.join(map(str, value)) if isinstance(value, list) else value}"
            for table, fields in of_part.items()
            for name, value in fields.items()
        )
        for part, of_part in tables.items()
    }


def _numbers(text: str) -> list[int]:
    try:
        return sorted({int(part) for part in text.split(",")})
    except ValueError:
        raise DataError(f"--seeds {text}: no whole numbers; give them as 0 or 0,1,2") from None


def _towns(scale: str, out: Path, show: Callable[[str, int, int], None]) -> Path:
    """Made-up towns in the published layout, made if they are not there yet."""
    from models.sources.kitti360.job import prepare_data
    from models.sources.synthetic.towns import write_towns

    raw, prepared = (out / "data" / scale / name for name in ("raw", "prepared"))
    if not raw.is_dir():
        write_towns(raw, scale, TOWN_SEED, lambda done, total: show("towns", done, total))
    prepare_data(raw, prepared, None, seed=TOWN_SEED, progress=show)
    return prepared


def _store(data: Path, out: Path, show: Callable[[str, int, int], None]) -> Path:
    """Data as a store, which each training opens in no time; an OpenStreetMap file and a store stay what they are."""
    from index.build.manifest import fingerprint
    from models.sources.store.files import convert
    from models.sources.store.layout import MANIFEST

    if not data.is_dir() or (data / MANIFEST).is_file():
        return data
    store = out / "data" / f"store-{fingerprint(data)[:12]}"
    if not store.is_dir():
        convert(data, store, None, lambda done, total: show("MB of points", done >> 20, total >> 20))
    return store
