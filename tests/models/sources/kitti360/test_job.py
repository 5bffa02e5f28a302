"""The preparation job: complete scenes only, made once, the same whatever else is prepared."""

import gzip
import json
import os
from pathlib import Path

import numpy as np
import pytest

from models.citymap.types import CutRules
from models.errors import DataError
from models.sources.kitti360.job import prepare_data
from models.sources.kitti360.prepare import prepare_scene
from models.sources.kitti360.raw import load_raw_scene
from models.sources.kitti360.rules import PrepareConfig
from models.sources.store.files import load_data
from tests.models.sources.conftest import LONG, MINI, QUICK, VAL, assert_same, contents, forbid, needs_mini
from tests.models.sources.published import load_cells, load_scene
from tests.models.sources.raw_scenes import write_town


@pytest.fixture
def own(raw_root: Path, tmp_path: Path) -> Path:
    """The raw data to change."""
    for path in raw_root.rglob("*.*"):
        if path.is_file():
            copy = tmp_path / "raw" / path.relative_to(raw_root)
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(path.read_bytes())
    return tmp_path / "raw"


def files_of(scene: str) -> list[str]:
    parts = {"cells": "pkl", "direction": "json", "poses": "pkl", "prepared": "json"}
    return [f"{part}/{scene}.{ending}" for part, ending in parts.items()]


def test_what_comes_out_is_the_published_layout(raw_root: Path, prepared: Path) -> None:
    assert sorted(contents(prepared)) == sorted(files_of(LONG) + files_of(VAL))
    for name, digits in ((LONG, "0003"), (VAL, "0010")):
        scene = load_scene(prepared, digits)
        rng = np.random.default_rng([0, *digits.encode()])
        assert_same([*scene[1:]], [*prepare_scene(load_raw_scene(raw_root, digits), QUICK, rng)])
        direction = json.loads((prepared / f"direction/{name}.json").read_text())
        assert list(direction) == [cell.id for cell in scene.cells]
    store = load_data(prepared)
    assert [scene.name for scene in store.split("test").scenes] == [LONG]
    assert [scene.name for scene in store.split("val").scenes] == [VAL]
    assert len(store.poses) == len(store.split("0003").poses) + len(store.split("0010").poses) > 10


def test_one_scene_is_the_same_to_the_byte_as_among_all(raw_root: Path, prepared: Path, tmp_path: Path) -> None:
    assert prepare_data(raw_root, tmp_path, "0010", QUICK) == (VAL,)
    assert contents(tmp_path) == contents(prepared, VAL)
    assert prepare_data(raw_root, tmp_path, LONG, QUICK) == (LONG,)
    assert contents(tmp_path) == contents(prepared)


def test_another_seed_gives_other_positions(raw_root: Path, prepared: Path, tmp_path: Path) -> None:
    prepare_data(raw_root, tmp_path, "0003", QUICK, seed=1)
    mine, theirs = contents(tmp_path), contents(prepared, LONG)
    assert {name for name in theirs if mine[name] != theirs[name]} == {f"poses/{LONG}.pkl", f"prepared/{LONG}.json"}


def test_a_finished_scene_is_skipped(raw_root: Path, prepared: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = {path: path.stat().st_mtime_ns for path in prepared.rglob("*")}
    steps: list[tuple[str, int, int]] = []
    forbid(monkeypatch)
    assert prepare_data(raw_root, prepared, None, QUICK, progress=lambda *step: steps.append(step)) == (LONG, VAL)
    assert {path: path.stat().st_mtime_ns for path in prepared.rglob("*")} == before
    assert [name for name, _, _ in steps] == [LONG, VAL]
    assert steps[-1][1] == steps[-1][2]


@pytest.mark.parametrize(
    ("config", "seed", "message"),
    [
        (QUICK, 1, "seed was 0, is 1; "),
        (PrepareConfig(copies=2, cut=CutRules(reach_m=np.inf)), 0, "config.cut.reach_m was 30.0, is inf"),
        (PrepareConfig(copies=2), 0, "config.copies was 1, is 2; "),
    ],
)
def test_a_scene_made_by_other_settings_is_refused(
    config: PrepareConfig, seed: int, message: str, raw_root: Path, prepared: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    forbid(monkeypatch)
    before = contents(prepared)
    with pytest.raises(DataError) as error:
        prepare_data(raw_root, prepared, None, config, seed)
    assert f"{prepared}/prepared/{LONG}.json: the scene was prepared otherwise" in str(error.value)
    assert message in str(error.value)
    assert f"delete {prepared}/cells/{LONG}.pkl to make the scene again" in str(error.value)
    assert contents(prepared) == before


def test_changed_raw_files_are_refused_and_deleted_cells_made_again(own: Path, tmp_path: Path) -> None:
    out, tile = tmp_path / "out", own / f"data_3d_semantics/{LONG}/static/0000000001.ply"
    prepare_data(own, out, "0003", QUICK)
    before = contents(out)
    os.utime(tile, (1, 1))
    with pytest.raises(DataError, match=r"raw\.data_3d_semantics/.*/0000000001\.ply\.modified_ns was \d+, is 10"):
        prepare_data(own, out, "0003", QUICK)
    tile.with_suffix(".ply.gz").write_bytes(gzip.compress(tile.read_bytes()))
    tile.unlink()
    with pytest.raises(DataError, match=r"0000000001\.ply is gone, .*\.ply\.gz is new; it is not overwritten"):
        prepare_data(own, out, "0003", QUICK)
    assert contents(out) == before
    (out / f"cells/{LONG}.pkl").unlink()
    prepare_data(own, out, "0003", QUICK)
    after = contents(out)
    assert [name for name in before if after[name] != before[name]] == [f"prepared/{LONG}.json"]


@pytest.mark.parametrize("part", ["cells", "poses", "direction"])
def test_a_scene_that_lost_a_file_is_made_again(part: str, raw_root: Path, tmp_path: Path) -> None:
    prepare_data(raw_root, tmp_path, "0003", QUICK)
    before = contents(tmp_path)
    next((tmp_path / part).iterdir()).unlink()
    prepare_data(raw_root, tmp_path, "0003", QUICK)
    assert contents(tmp_path) == before


@pytest.mark.parametrize("name", [f"cells/{LONG}.pkl", f"poses/{LONG}.pkl", f"direction/{LONG}.json"])
def test_files_of_others_are_not_overwritten(name: str, raw_root: Path, tmp_path: Path) -> None:
    (tmp_path / name).parent.mkdir()
    (tmp_path / name).write_bytes(b"downloaded")
    with pytest.raises(DataError, match=rf"{name}: exists.*not overwritten"):
        prepare_data(raw_root, tmp_path, None, QUICK)
    assert contents(tmp_path) == {name: b"downloaded"}
    assert prepare_data(raw_root, tmp_path, "0010", QUICK) == (VAL,)


@pytest.mark.parametrize(
    ("text", "message"),
    [("{", "field ''"), ('{"format": 2}', "field 'format'"), ('{"seed": "one"}', "field 's"), ("[" * 9000, "field ''")],
)
def test_a_record_that_is_none(text: str, message: str, raw_root: Path, tmp_path: Path) -> None:
    prepare_data(raw_root, tmp_path, "0003", QUICK)
    record = tmp_path / f"prepared/{LONG}.json"
    record.write_text(text)
    with pytest.raises(DataError, match=rf"{LONG}\.json: {message}.*delete .*{LONG}\.pkl"):
        prepare_data(raw_root, tmp_path, "0003", QUICK)


def test_a_bad_scene_does_not_lose_the_others(own: Path, prepared: Path, tmp_path: Path) -> None:
    out, bad = tmp_path / "out", "2013_05_28_drive_0007_sync"
    write_town(own, bad, 2)
    tile = own / f"data_3d_semantics/{bad}/static/0000000001.ply"
    tile.write_bytes(tile.read_bytes()[:-9])
    (own / f"data_poses/{VAL}/poses.txt").unlink()
    steps: list[tuple[str, int, int]] = []
    with pytest.raises(DataError) as error:
        prepare_data(own, out, None, QUICK, progress=lambda *step: steps.append(step))
    first, *problems = str(error.value).splitlines()
    assert "2 of 3 scenes could not be prepared; the others are complete" in first
    assert str(tile) in problems[0]
    assert f"{own}/data_poses/{VAL}/poses.txt: field 'trajectory'" in problems[1]
    assert steps[-1][1] == steps[-1][2]
    assert sorted(contents(out)) == sorted(files_of(LONG))
    assert contents(out)[f"cells/{LONG}.pkl"] == contents(prepared)[f"cells/{LONG}.pkl"]
    with pytest.raises(DataError, match=rf"^{tile}"):
        prepare_data(own, out, "0007", QUICK)


def test_a_scene_that_gives_no_cells_names_its_folder(raw_root: Path, tmp_path: Path) -> None:
    with pytest.raises(DataError, match=rf"{raw_root}/data_3d_semantics/{LONG}: .*field 'cells'"):
        prepare_data(raw_root, tmp_path, "0003", PrepareConfig(cut=CutRules(min_instances=99)))


def test_progress_covers_all_scenes_and_never_goes_back(raw_root: Path, tmp_path: Path) -> None:
    steps: list[tuple[str, int, int]] = []
    prepare_data(raw_root, tmp_path, None, QUICK, progress=lambda *step: steps.append(step))
    names, done, totals = zip(*steps, strict=True)
    assert list(dict.fromkeys(names)) == [LONG, VAL]
    assert list(done) == sorted(done)
    assert set(totals) == {sum(path.stat().st_size for path in raw_root.rglob("*.*") if path.is_file())}
    assert done[-1] == totals[0]
    assert 0 < done[0] < done[1] < totals[0] / 10, "both tiles count"


def test_places_that_cannot_be(raw_root: Path, prepared: Path, tmp_path: Path) -> None:
    for out in (raw_root, raw_root / "data_poses", raw_root / "data_3d_semantics/new"):
        with pytest.raises(DataError, match="contains the raw data"):
            prepare_data(raw_root, out)
    (tmp_path / "file").touch()
    with pytest.raises(DataError, match="is not a directory"):
        prepare_data(raw_root, tmp_path / "file")
    with pytest.raises(DataError, match=rf"{prepared}: is not raw KITTI-360 .* but the published layout"):
        prepare_data(prepared, tmp_path / "out")
    with pytest.raises(DataError, match=r"nowhere/data_3d_semantics: no scene; the raw layout is"):
        prepare_data(raw_root / "nowhere", tmp_path / "out")
    with pytest.raises(DataError, match=r"no scene '0042'; there are .*0003"):
        prepare_data(raw_root, tmp_path / "out", "0042")
    assert not (tmp_path / "out").exists()


def test_two_folders_of_one_scene_are_not_guessed_between(own: Path, tmp_path: Path) -> None:
    write_town(own, "0003", 3)
    with pytest.raises(DataError, match=rf"folders '0003' and '{LONG}' are one scene"):
        prepare_data(own, tmp_path / "out", None, QUICK)


def test_a_folder_of_digits_only(tmp_path: Path) -> None:
    write_town(tmp_path / "raw", "0042", 0)
    assert prepare_data(tmp_path / "raw", tmp_path, None, QUICK) == ("2013_05_28_drive_0042_sync",)
    assert prepare_data(tmp_path / "raw", tmp_path, "0042", QUICK) == ("2013_05_28_drive_0042_sync",)
    assert load_cells(tmp_path / "cells/2013_05_28_drive_0042_sync.pkl")[0].scene_name == "0042"


@pytest.mark.slow
@needs_mini
def test_the_sample_is_prepared(tmp_path: Path) -> None:
    prepare_data(MINI / "raw", tmp_path, "0003")
    scene = load_scene(tmp_path, "0003")
    assert len(scene.cells) == 52
    direction = json.loads((tmp_path / f"direction/{LONG}.json").read_text())
    assert list(direction) == [cell.id for cell in scene.cells]
