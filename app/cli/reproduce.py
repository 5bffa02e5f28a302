"""The command that makes the paper's tables again. Heavy imports are inside, so that --help is quick."""
# ruff: noqa: PLC0415

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from models.errors import DataError

MADE_UP = ("demo", "full")  # scales of `models.city.synthetic.towns.write_towns`
TOWN_SEED = 0


def reproduce(
    out: Annotated[Path, typer.Option(help="directory for runs and report; what is done there is kept")],
    data: Annotated[str, typer.Option(help="demo or full (made-up towns), or a directory of KITTI360Pose")] = "demo",
    seeds: Annotated[str, typer.Option(help="of the trainings: 0 or 0,1,2; figure 4 is made with the first")] = "0",
    report: Annotated[Path | None, typer.Option(help="directory for the report; OUT if left out")] = None,
) -> None:
    """Make the tables 1-4 and figures 4-5 of MNCL: train what is missing, measure, print beside what is published."""
    from app.cli.progress import stage_bars
    from app.threads import usable_cpus
    from index.evaluation.reproduce import reproduce as run
    from index.evaluation.reproduce_report import write_reproduction
    from models.training.experiments import SCALES

    numbers = _numbers(seeds)
    with stage_bars() as show:
        store = _towns(data, out, show) if data in MADE_UP else Path(data)
        found = run(store, out, SCALES["demo" if data == "demo" else "full"], numbers, usable_cpus(), show)
    name = f"the {data} towns" if data in MADE_UP else Path(data).resolve().name
    directory = report or out
    write_reproduction(directory, found, name)
    typer.echo(f"the report is {directory / 'report.md'}")


def _numbers(text: str) -> list[int]:
    try:
        return sorted({int(part) for part in text.split(",")})
    except ValueError:
        raise DataError(f"--seeds {text}: no whole numbers; give them as 0 or 0,1,2") from None


def _towns(scale: str, out: Path, show: Callable[[str, int, int], None]) -> Path:
    """Made-up towns as a store, made if they are not there yet."""
    from models.city.kitti360.job import prepare_data
    from models.city.store.files import MANIFEST, convert
    from models.city.synthetic.towns import write_towns

    raw, prepared, store = (out / "data" / name for name in ("raw", "prepared", "store"))
    if not (store / MANIFEST).is_file():
        if not raw.is_dir():
            write_towns(raw, scale, TOWN_SEED, lambda done, total: show("towns", done, total))
        prepare_data(raw, prepared, None, seed=TOWN_SEED, progress=show)
        convert(prepared, store, None, lambda done, total: show("MB of points", done >> 20, total >> 20))
    return store
