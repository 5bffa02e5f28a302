"""The preparation job, interrupted at any point: nothing half is seen, and the next run does what is left."""

import subprocess
import sys
from pathlib import Path

import pytest

from models.errors import DataError
from models.sources.kitti360 import job as kitti360_job
from models.sources.kitti360.job import prepare_data
from models.sources.store.files import load_data
from tests.models.sources.conftest import LONG, QUICK, VAL, contents, forbid


def stop(*args: object):
    raise KeyboardInterrupt


@pytest.mark.parametrize(
    "position", ["load_raw_scene", "prepare_scene", "save_scene", "save_direction", "replace_file"]
)
def test_an_interrupted_scene_leaves_nothing(position: str, raw_root: Path, tmp_path: Path, monkeypatch) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(kitti360_job, position, stop)
        with pytest.raises(KeyboardInterrupt):
            prepare_data(raw_root, tmp_path, "0003", QUICK)
    assert not list(tmp_path.iterdir())


def test_a_full_disk_leaves_nothing(raw_root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*args: object):
        raise OSError(28, "No space left on device", "some.pkl")

    monkeypatch.setattr(kitti360_job, "save_scene", full)
    with pytest.raises(DataError, match=rf"scene '{LONG}' cannot be prepared: .*No space left on device: 'some\.pkl'"):
        prepare_data(raw_root, tmp_path / "out", None, QUICK)
    assert not list((tmp_path / "out").iterdir())


@pytest.mark.parametrize("moves", range(4))
def test_a_scene_killed_while_it_is_put_in_place(
    moves: int, raw_root: Path, prepared: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No state in between shows cells beside another preparation's poses; the next run only carries on."""
    prepare_data(raw_root, tmp_path, "0010", QUICK, seed=5)
    (tmp_path / f"poses/{VAL}.pkl").unlink()  # so that it is made again, over files of another seed
    record = tmp_path / f"prepared/{VAL}.json"
    record.write_text(record.read_text().replace('"seed": 5', '"seed": 0'))
    rename, left = Path.replace, [2 + 1 + 1 + moves]  # before: cells, poses, direction and record in `.preparing`

    def limited(self: Path, target: Path) -> Path:
        left[0] -= 1
        if left[0] < 0:
            raise KeyboardInterrupt
        return rename(self, target)

    with monkeypatch.context() as patch:
        patch.setattr(Path, "replace", limited)
        with pytest.raises(KeyboardInterrupt):
            prepare_data(raw_root, tmp_path, "0010", QUICK)
    if (tmp_path / f"cells/{VAL}.pkl").exists():
        load_data(tmp_path, "0010")
        assert contents(tmp_path / "poses") == contents(prepared / "poses", VAL)
    assert (tmp_path / f".placing-{VAL}").is_dir()
    with monkeypatch.context() as patch:
        forbid(patch)
        prepare_data(raw_root, tmp_path, "0010", QUICK)
    assert contents(tmp_path) == contents(prepared, VAL)


def test_what_a_killed_run_left_is_removed(raw_root: Path, prepared: Path, tmp_path: Path) -> None:
    left = tmp_path / f".preparing-{LONG}/cells"
    left.mkdir(parents=True)
    (left / f".{LONG}.pkl.123").write_bytes(b"half a pickle")
    (tmp_path / f".{LONG}.lock").touch()
    prepare_data(raw_root, tmp_path, "0003", QUICK)
    assert contents(tmp_path) == contents(prepared, LONG)


def test_two_runs_do_not_make_one_scene(raw_root: Path, prepared: Path, tmp_path: Path) -> None:
    code = "import sys; from pathlib import Path; from models.sources.kitti360.job import prepare_data\n"
    code += "prepare_data(Path(sys.argv[1]), Path(sys.argv[2]), '0003')"
    command = [sys.executable, "-c", code, str(raw_root), str(tmp_path)]
    others = []

    def meanwhile(*_: object):
        if not others:
            root = Path(__file__).parents[4]
            others.append(subprocess.run(command, cwd=root, capture_output=True, text=True, check=False))

    assert prepare_data(raw_root, tmp_path, "0003", QUICK, progress=meanwhile) == (LONG,)
    assert f"{tmp_path}: scene '{LONG}' is being prepared by another run; wait for it" in others[0].stderr
    assert contents(tmp_path) == contents(prepared, LONG)
