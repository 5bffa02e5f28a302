"""Commands that make data sets. Heavy imports are inside the commands, so that --help is quick."""
# ruff: noqa: PLC0415

from pathlib import Path
from typing import Annotated

import typer

from app.cli.options import Seed, Split


def prepare(
    raw: Annotated[Path, typer.Option(help="raw KITTI-360: data_3d_semantics/ and data_poses/")],
    out: Annotated[Path, typer.Option(help="where cells/, poses/ and direction/ go")],
    scene: Annotated[str | None, typer.Option(help="one scene, as its folder or its digits; all if left out")] = None,
    seed: Seed = 0,
) -> None:
    """Make KITTI360Pose's cells and poses from raw KITTI-360; scenes that are done are kept."""
    from app.cli.progress import stage_bars
    from models.sources.kitti360.job import prepare_data

    with stage_bars() as show:
        scenes = prepare_data(raw, out, scene, seed=seed, progress=show)
    typer.echo(f"{len(scenes)} scenes are in {out}; next: hereabouts convert --data {out} --out DIR")


def convert(
    data: Annotated[Path, typer.Option(help="a directory in KITTI360Pose's layout")],
    out: Annotated[Path, typer.Option(help="the store, a new directory")],
    split: Split = None,
) -> None:
    """Write KITTI360Pose's pickles as a store that opens at once."""
    from app.cli.progress import stage_bars
    from models.sources.store.files import convert as run

    with stage_bars() as show:
        store = run(data, out, split, lambda done, total: show("MB of points", done >> 20, total >> 20))
    typer.echo(f"{len(store.cell_ids)} cells of {len(store.scenes)} scenes are in {out}")


def synth(
    out: Annotated[Path, typer.Option(help="a new directory, for raw KITTI-360 files")],
    scale: Annotated[str, typer.Option(help="demo (trains in minutes) or full (as large as KITTI360Pose)")] = "demo",
    seed: Seed = 0,
    pieces: Annotated[
        str, typer.Option(help="numbers of ground: official (all road of a town is one instance) or own (each piece)")
    ] = "official",
) -> None:
    """Make up towns, as raw KITTI-360 files: nine scenes under KITTI-360's names, so that the standard splits work."""
    from app.cli.progress import stage_bars
    from models.sources.synthetic.towns import write_towns

    with stage_bars() as show:
        scenes = write_towns(out, scale, seed, lambda done, total: show("towns", done, total), pieces)
    typer.echo(f"{len(scenes)} towns are in {out}; next: hereabouts prepare --raw {out} --out DIR")
