"""The files of a version, read again beside the service, in processes as the service starts them."""

import asyncio
import os
import shutil
import signal
import sys

import pytest
from fake_localizer import FakeLocalizer
from fastapi.testclient import TestClient

from app import main
from app.http import indexes
from app.main import create_app
from app.settings import Settings
from app.workers import checksums as sums
from app.workers.messages import LocalizerSpec
from index.build.artifact import read_aliases, set_alias
from models.errors import HereaboutsError, IndexBroken


@pytest.fixture
def root(index_dir, tmp_path):
    shutil.copytree(index_dir, tmp_path / "index")
    return tmp_path / "index"


def version_of(root):
    return read_aliases(root).aliases["default"]


def flip(path):
    """Another bit in the last byte, which is data."""
    whole = path.read_bytes()
    path.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))


def test_what_is_whole_passes_and_a_flipped_bit_is_named_without_its_place(root):
    version = version_of(root)
    asyncio.run(sums.check_version(root, version))
    asyncio.run(sums.check_version(root / version, version))
    flip(root / version / "vectors.faiss")
    with pytest.raises(IndexBroken, match=rf"^{version}/vectors.faiss was changed .* build it") as broken:
        asyncio.run(sums.check_version(root, version))
    assert str(root) not in str(broken.value)


@pytest.mark.parametrize(
    ("code", "message"), [("import os; os.kill(os.getpid(), 9)", "status -9"), ("1 / 0", "ZeroDivisionError")]
)
def test_a_process_that_does_not_end_well_does_not_make_an_index_broken(root, monkeypatch, code, message):
    monkeypatch.setattr(sums, "PROCESS", (sys.executable, "-c", code))
    with pytest.raises(HereaboutsError, match=f"(?s){message}") as failed:
        asyncio.run(sums.check_version(root, version_of(root)))
    assert not isinstance(failed.value, IndexBroken)
    assert "hereabouts verify" in str(failed.value)


def test_it_gives_way_and_ends_with_who_waits_for_it(root, monkeypatch, tmp_path):
    note = tmp_path / "said"
    code = (
        "import os, sys, time, pathlib; from app.workers import checksums as sums\n"
        f"sums.open_version = lambda path: (pathlib.Path({str(note)!r}).write_text(f'{{os.getpid()}} {{os.nice(0)}}'),"
        " time.sleep(60))\n"
        "sums.main(pathlib.Path(sys.argv[1]))"
    )
    monkeypatch.setattr(sums, "PROCESS", (sys.executable, "-c", code))

    async def run():
        task = asyncio.create_task(sums.check_version(root, version_of(root)))
        async with asyncio.timeout(60):
            while not (note.exists() and note.read_text()):
                await asyncio.sleep(0.01)
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)

    asyncio.run(run())
    pid, niceness = map(int, note.read_text().split())
    assert niceness == sums.NICENESS
    with pytest.raises(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)


@pytest.mark.parametrize("name", ["cells.json", "cells.safetensors", "statements.safetensors"])
def test_what_cannot_be_opened_as_it_was_changed_is_named(root, weights_dir, name):
    path = root / version_of(root) / name
    path.write_bytes(b"\xff" * 16 + path.read_bytes()[16:])  # no JSON, no header
    with pytest.raises(IndexBroken, match=f"{name} was changed"):
        LocalizerSpec(root, weights_dir).open()


def test_a_flipped_bit_ends_readiness_by_name_until_the_alias_moves_to_what_is_whole(
    root, monkeypatch, until, problem, logged, text
):
    broken, body = version_of(root), {"description": text}
    sound = "sound"
    shutil.copytree(root / broken, root / sound)
    manifest = root / sound / "manifest.json"
    manifest.write_text(manifest.read_text().replace(broken, sound))
    flip(root / broken / "statements.safetensors")
    monkeypatch.setattr(main, "open_workers", lambda _order, _count: [FakeLocalizer()])
    monkeypatch.setattr(main, "check_version", lambda where, _: sums.check_version(where, version_of(where)))
    monkeypatch.setattr(indexes, "ALIAS_POLL_S", 0.05)
    note = logged("info")
    with TestClient(create_app(Settings(index_dir=root))) as api:
        until(lambda: api.get("/readyz").json().get("code") == "load_failed")
        for response in (api.get("/readyz"), api.post("/localize", json=body), api.get("/cells/x")):
            detail = problem(response, 503, "load_failed")["detail"]
            assert detail.startswith(f"{broken}/statements.safetensors was changed")
            assert "build it with 'hereabouts index" in detail
            assert str(root) not in response.text
        assert api.get("/healthz").status_code == 200
        assert 'hereabouts_workers{index="default"} 0.0' in api.get("/metrics").text
        set_alias(root, "default", sound)
        until(lambda: api.get("/readyz").status_code == 200)
        assert api.post("/localize", json=body).status_code == 200
        until(api.app.state.indexes._served["default"].checking.done)
        assert api.get("/readyz").status_code == 200
    lines = note().splitlines()
    assert len([line for line in lines if "index broken" in line and "statements.safetensors" in line]) == 1
    assert len([line for line in lines if "index verified" in line]) == 1
