"""The command that reproduces the paper's tables. Heavy imports are inside, so that --help is fast."""
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

    from index.evaluation.reproduction.plan import PlannedRun
    from models.training.experiments import TrainingRun, TrainingScale

SYNTHETIC_SCALES = ("demo", "full")  # scales of `models.sources.synthetic.towns.write_towns`
TOWN_SEED = 0
PARTS = ("retriever", "fine", "points")  # tables of a --config


def reproduce(
    out: Annotated[Path, typer.Option(help="directory for runs and report; finished runs in it are reused")],
    data: Annotated[str, typer.Option(help="demo or full (synthetic towns), or a directory of KITTI360Pose")] = "demo",
    seeds: Annotated[
        str, typer.Option(help="seeds of the trainings, such as 0 or 0,1,2; figure 4 uses the first")
    ] = "0",
    tables: Annotated[
        str | None,
        typer.Option(
            help="tables: 1, 2, 3, 4, 4a, 4b, graph, attention, code, inputs; or ret, loss, head, noise20, noise40, "
            "which are long and not in the default"
        ),
    ] = None,
    steps: Annotated[int | None, typer.Option(min=1, help="optimization steps of each training")] = None,
    epochs: Annotated[
        int | None,
        typer.Option(
            min=1, help="epochs of each training; validates after each one and halves the learning rate every five"
        ),
    ] = None,
    config: Annotated[
        Path | None,
        typer.Option(
            help="TOML file with tables retriever, fine and points, each with model and training settings as in --set"
        ),
    ] = None,
    workers: Annotated[
        int | None, typer.Option(min=1, help="concurrent trainings; default: one per GPU or CPU")
    ] = None,
    device: Annotated[str | None, typer.Option(help="auto, cpu or cuda; several GPUs are used in turn")] = None,
    report: Annotated[Path | None, typer.Option(help="directory for the report; default: OUT")] = None,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="list the trainings and estimate their hours")] = False,
) -> None:
    """Reproduce tables 1-4 and figures 3-5 of MNCL: train missing models, measure, and compare with the paper."""
    from app.cli.progress import stage_bars
    from index.evaluation.reproduction.plan import plan_runs
    from index.evaluation.reproduction.report import write_reproduction
    from index.evaluation.reproduction.reproduce import choose_experiments, figure_3_path, scale_in_epochs
    from index.evaluation.reproduction.reproduce import reproduce as run
    from models.training.experiments import POINTS, SCALES, TrainingRun, required_runs

    if steps and epochs:
        raise DataError("--steps and --epochs both set the length of training; give one of them")
    numbers, experiments = _parse_seeds(seeds), choose_experiments(tables)
    scale = _override(SCALES["demo" if data == "demo" else "full"], config, steps, device)
    max_workers = _check_runs(scale, (*required_runs(experiments), TrainingRun(POINTS)), config)
    if dry_run:
        store = _existing_store(data, out)
        if epochs and store is None:
            raise DataError(
                "--epochs counts in batches of the data, which are not ready yet; use --steps with --dry-run"
            )
        scale = scale_in_epochs(scale, store, epochs) if epochs and store else scale
        _show_plan(plan_runs(store, out, scale, numbers, experiments), workers or max_workers)
        return
    with stage_bars() as show:
        store = _store(_towns(data, out, show) if data in SYNTHETIC_SCALES else Path(data), out, show)
        scale = scale_in_epochs(scale, store, epochs) if epochs else scale
        results = run(store, out, scale, numbers, workers or max_workers, show, experiments)
    name = f"the {data} towns" if data in SYNTHETIC_SCALES else Path(data).resolve().name
    directory = report or out
    write_reproduction(directory, results, name, figure_3_path(store, out, scale, numbers[0], experiments))
    typer.echo(f"the report is {directory / 'report.md'}")


def _override(scale: "TrainingScale", config: Path | None, steps: int | None, device: str | None) -> "TrainingScale":
    from_file = _read_config(config) if config else {}
    length = (f"training.steps={steps}", f"training.validate_every={max(1, steps // 20)}") if steps else ()
    device_setting = (f"training.device={device}",) if device else ()
    parts = {
        part: (*getattr(scale, part), *from_file.get(part, ()), *(() if part == "points" else length), *device_setting)
        for part in PARTS
    }
    return replace(scale, **parts)


def _check_runs(scale: "TrainingScale", runs: "Sequence[TrainingRun]", config: Path | None) -> int:
    """Check that all runs can be trained; return how many can be trained at once."""
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


def _read_config(config: Path) -> dict[str, tuple[str, ...]]:
    try:
        tables: dict[str, Any] = tomllib.loads(config.read_text())
    except (OSError, ValueError) as error:
        raise DataError(
            f"--config {config} cannot be read ({error}); it must be a TOML file as in docs/use.md"
        ) from error
    if unknown := [part for part in tables if part not in PARTS]:
        raise DataError(f"--config {config}: unknown table '{unknown[0]}'; the tables are {', '.join(PARTS)}")
    for part, of_part in tables.items():
        if not isinstance(of_part, dict) or not all(isinstance(fields, dict) for fields in of_part.values()):
            raise DataError(f"--config {config}: settings belong in {part}.model or {part}.training")
        if "inputs" in of_part.get("model", {}):
            raise DataError(
                f"--config {config}: the tables compare inputs, so they cannot be set; choose a table with --tables"
            )
    return {
        part: tuple(
            f"{table}.{name}={','.join(map(str, value)) if isinstance(value, list) else value}"
            for table, fields in of_part.items()
            for name, value in fields.items()
        )
        for part, of_part in tables.items()
    }


def _parse_seeds(text: str) -> list[int]:
    try:
        return sorted({int(part) for part in text.split(",")})
    except ValueError:
        raise DataError(f"--seeds {text}: not whole numbers; write them as 0 or 0,1,2") from None


def _show_plan(runs: "Sequence[PlannedRun]", workers: int) -> None:
    width = max(len(run.name) for run in runs)
    for run in runs:
        typer.echo(
            f"{run.name:<{width}}  seed {run.seed}  {run.steps:>6} steps  {'done' if run.is_done else 'missing'}"
        )
    missing = [run.hours for run in runs if not run.is_done]
    typer.echo(
        f"{len(runs)} trainings, {len(missing)} missing: about {sum(missing):.1f} hours of one core in all, shared by "
        f"{workers} workers. Estimate: steps x batch size / descriptions per second as measured on a CPU with MiniLM "
        "and a width of 128 (models/reports/demo), without making data, validating and measuring."
    )


def _prepared(scale: str, out: Path) -> Path:
    return out / "data" / scale / "prepared"


def _towns(scale: str, out: Path, show: Callable[[str, int, int], None]) -> Path:
    from models.sources.kitti360.job import prepare_data
    from models.sources.synthetic.towns import write_towns

    prepared = _prepared(scale, out)
    raw = prepared.with_name("raw")
    if not raw.is_dir():
        write_towns(raw, scale, TOWN_SEED, lambda done, total: show("towns", done, total))
    prepare_data(raw, prepared, None, seed=TOWN_SEED, progress=show)
    return prepared


def _store(data: Path, out: Path, show: Callable[[str, int, int], None]) -> Path:
    """Convert data to a store, which opens quickly; return OpenStreetMap files and stores unchanged."""
    from models.sources.store.files import convert

    store = _store_path(data, out)
    if store != data and not store.is_dir():
        convert(data, store, None, lambda done, total: show("MB of points", done >> 20, total >> 20))
    return store


def _store_path(data: Path, out: Path) -> Path:
    from index.build.manifest import fingerprint
    from models.sources.store.layout import MANIFEST

    if not data.is_dir() or (data / MANIFEST).is_file():
        return data
    return out / "data" / f"store-{fingerprint(data)[:12]}"


def _existing_store(data: str, out: Path) -> Path | None:
    """Return the store of data, as `_store`; None if it is not made yet."""
    if data in SYNTHETIC_SCALES and not (_prepared(data, out) / "cells").is_dir():
        return None
    path = _prepared(data, out) if data in SYNTHETIC_SCALES else Path(data)
    if not path.exists():
        raise DataError(f"--data {data}: no such file or directory; give demo, full or a path")
    store = _store_path(path, out)
    return store if store.exists() else None
