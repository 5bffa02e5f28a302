"""Commands that prepare data sets. Heavy imports are inside the commands, so that --help is fast."""
# ruff: noqa: PLC0415

from pathlib import Path
from typing import Annotated

import typer

from app.cli.options import Seed, Split


def prepare(
    raw: Annotated[Path, typer.Option(help="raw KITTI-360: data_3d_semantics/ and data_poses/")],
    out: Annotated[Path, typer.Option(help="directory for cells/, poses/ and direction/")],
    scene: Annotated[str | None, typer.Option(help="one scene, by folder name or digits; default: all")] = None,
    seed: Seed = 0,
) -> None:
    """Prepare KITTI360Pose's cells and poses from raw KITTI-360. Finished scenes are skipped."""
    from app.cli.progress import stage_bars
    from models.sources.kitti360.job import prepare_data

    with stage_bars() as show:
        scenes = prepare_data(raw, out, scene, seed=seed, progress=show)
    typer.echo(f"{len(scenes)} scenes are in {out}; next: hereabouts convert --data {out} --out DIR")


def convert(
    data: Annotated[Path, typer.Option(help="a directory in KITTI360Pose's layout")],
    out: Annotated[Path, typer.Option(help="new directory for the store")],
    split: Split = None,
) -> None:
    """Convert KITTI360Pose's pickles to a store that opens immediately."""
    from app.cli.progress import stage_bars
    from models.sources.store.files import convert as run

    with stage_bars() as show:
        store = run(data, out, split, lambda done, total: show("MB of points", done >> 20, total >> 20))
    typer.echo(f"{len(store.cell_ids)} cells of {len(store.scenes)} scenes are in {out}")


def synth(
    out: Annotated[Path, typer.Option(help="new directory for raw KITTI-360 files")],
    scale: Annotated[
        str, typer.Option(help="demo (training takes minutes) or full (as large as KITTI360Pose)")
    ] = "demo",
    seed: Seed = 0,
    pieces: Annotated[
        str,
        typer.Option(help="instances of ground: official (all road of a town is one instance) or own (one per piece)"),
    ] = "official",
) -> None:
    """Generate synthetic towns as raw KITTI-360 files: nine scenes with KITTI-360's names, so that its splits apply."""
    from app.cli.progress import stage_bars
    from models.sources.synthetic.towns import write_towns

    with stage_bars() as show:
        scenes = write_towns(out, scale, seed, lambda done, total: show("towns", done, total), pieces)
    typer.echo(f"{len(scenes)} towns are in {out}; next: hereabouts prepare --raw {out} --out DIR")
