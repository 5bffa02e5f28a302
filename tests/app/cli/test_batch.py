"""The command `batch`."""

import csv
import io
import os
import random
import subprocess
import sys
import threading
import time
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest
from fake_localizer import FakeLocalizer
from typer.testing import CliRunner

from app.cli import table_rows
from app.cli.main import app
from app.cli.table_rows import write_rows
from app.http.formats.csv_table import CsvTable
from app.threads import THREAD_VARIABLES
from app.workers.messages import WorkerFault
from models.errors import StoreUnavailable

FAKE = Path(__file__).parent / "batch_fake.py"
TABLE = '\ufeff"id";text\r\n1;"a\r\n""green""\r\ntree"\r\n2;=å\r\n3;\r\n4;nowhere\r\n5;"a;b"\r\n'


class Uneven(FakeLocalizer):
    """Takes longer for certain texts, fails for others, and counts the queries."""

    count = 0

    def localize(self, queries):
        Uneven.count += 1
        text = queries[0].description
        if text.startswith("late"):
            time.sleep(random.random() / 100)
        if text == "fault":
            raise WorkerFault("a bug")
        if text == "gone":
            raise StoreUnavailable("Milvus does not answer; start it")
        return super().localize(queries)


@pytest.fixture
def version(monkeypatch):
    """The index version that the command opens; its `localizers` answer."""
    for name in THREAD_VARIABLES:
        monkeypatch.setenv(name, "1")
    manifest = SimpleNamespace(version="v1", frame=SimpleNamespace(origin_lat=60.17), localizers=[Uneven(), Uneven()])

    @contextmanager
    def nothing():
        yield

    monkeypatch.setattr("app.workers.launch.prelaunched", nothing)
    monkeypatch.setattr("index.build.artifact.open_version", lambda index_dir: (index_dir, manifest))
    monkeypatch.setattr("app.workers.remote.open_workers", lambda _spec, _count: manifest.localizers)
    return manifest


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "calls.csv"
    path.write_bytes(TABLE.encode())
    return path


def run(table, out, *options):
    return CliRunner().invoke(app, ["batch", str(table), "--text", "text", "-o", str(out), *options])


def partial_of(out):
    [path] = out.parent.glob(f"{out.name}.*.partial")
    return path


def test_the_table_is_written_and_counted(version, table):
    out = table.parent / "new" / "out.csv"
    result = run(table, out)
    assert result.exit_code == 1, "a text is empty"
    assert result.stdout == f"3 ok, 1 error, 1 no_match: {out}\n"
    assert [path.name for path in out.parent.iterdir()] == ["out.csv"]
    content = out.read_bytes().decode()
    assert content.startswith("\ufeffid;text;decimalLatitude;")
    rows = list(csv.reader(io.StringIO(content, newline=""), delimiter=";"))
    assert [row[:2] for row in rows[1:]] == [
        ["1", 'a\r\n"green"\r\ntree'],
        ["2", "'=å"],
        ["3", ""],
        ["4", "nowhere"],
        ["5", "a;b"],
    ]
    assert all(localizer.is_closed for localizer in version.localizers)


def test_a_run_continues_from_any_byte(version, table):
    out = table.with_name("out.csv")
    run(table, out)
    content = out.read_bytes()
    checked = CsvTable.check(lambda: table.open("rb"), "text")
    starts = {0, len(content), *(content.index(b"\r\n" + start) + 2 for start in (b"1;", b"2;", b"3;", b"4;", b"5;"))}
    assert len(starts) == 7
    for length in range(len(content) + 1):
        with io.BytesIO(content[:length]) as file:
            table_rows._resume(file, checked)
            last_start = max(start for start in starts if start <= length)
            assert file.getvalue() == content[:last_start]
            if length - last_start in {0, 1}:
                statuses = write_rows(checked, version.localizers, file, lambda _done: None)
                assert file.getvalue() == content
                assert statuses == {"ok": 3, "error": 1, "no_match": 1}


def test_a_killed_run_continues(tmp_path):
    table, out, whole = (tmp_path / name for name in ("calls.csv", "out.csv", "whole.csv"))
    table.write_text("text\n" + "".join(f'"a tree,\n{n}"\n' for n in range(200)))
    command = [sys.executable, FAKE, "batch", table, "--text", "text", "-o"]
    environment = {**os.environ, "PYTHONPATH": str(FAKE.parents[3])}
    process = subprocess.Popen([*command, out], env=environment, stderr=subprocess.DEVNULL)
    while not any(path.stat().st_size > 20_000 for path in tmp_path.glob("*.partial")):
        assert process.poll() is None
        time.sleep(0.005)
    process.kill()
    process.wait()
    assert not out.exists()
    rows_before = partial_of(out).read_bytes().count(b"\r\n") - 1
    assert 0 < rows_before < 190
    for path in (out, whole):
        subprocess.run([*command, path], env=environment, check=True, capture_output=True)
    assert out.read_bytes() == whole.read_bytes()
    assert whole.read_bytes().count(b"\r\n") == 201


def test_only_the_missing_rows_are_computed(version, table):
    out = table.with_name("out.csv")
    table.write_text("text\n" + "a tree\n" * 50 + "gone\n")
    result = run(table, out)
    assert result.exit_code == 1
    assert "Milvus does not answer" in result.stderr
    assert not out.exists()
    assert partial_of(out).read_bytes().count(b"\r\n") == 51
    Uneven.count = 0
    run(table, out)
    assert Uneven.count == 1


def test_the_unfinished_output_of_other_work_is_refused(version, table):
    out = table.with_name("out.csv")
    table.write_text("text,lang\na tree,sv\ngone,sv\n")
    run(table, out)
    before = partial_of(out).read_bytes()
    refused = [run(table, out, "--lang-column", "lang")]
    version.version = "v2"
    refused.append(run(table, out))
    version.version = "v1"
    table.write_text("text,lang\na tree,sv\na bank,sv\n")
    refused.append(run(table, out))
    for result in refused:
        assert "delete it to start again" in result.stderr.replace("\n", " ")
    assert partial_of(out).read_bytes() == before
    partial_of(out).unlink()
    assert run(table, out).exit_code == 0


def test_a_second_run_does_not_write_to_the_same_file(version, table):
    out = table.with_name("out.csv")
    with table_rows.unfinished(out, table, (version.version, None, None, None, "text", None)):
        assert "another process" in run(table, out).stderr
    assert out.exists()


def test_a_full_disk_leaves_what_can_be_continued(version, table, monkeypatch):
    def full(_path, _target):
        raise OSError(28, "No space left on device")

    out = table.with_name("out.csv")
    with monkeypatch.context() as patch:
        patch.setattr(Path, "replace", full)
        result = run(table, out)
    assert "run this again to continue" in result.stderr
    assert partial_of(out).exists()
    table.with_name("out.csv.1.csv.0123456789ab.partial").touch()  # of another output
    assert "3 ok" in run(table, out).stdout


@pytest.mark.parametrize("num_localizers", [1, 3])
def test_rows_stay_in_order_and_a_fault_fails_alone(version, table, num_localizers):
    table.write_text("text\n" + "".join(f"late {n}\n" for n in range(150)) + "fault\nnan\nlate 150\n")
    version.localizers = [Uneven() for _ in range(num_localizers)]
    out = table.with_name("out.csv")
    assert run(table, out).exit_code == 1
    rows = list(csv.DictReader(io.StringIO(out.read_text(), newline="")))
    assert [row["text"] for row in rows] == [*(f"late {n}" for n in range(150)), "fault", "nan", "late 150"]
    assert [row["text"] for row in rows if row["localizationStatus"] == "error"] == ["fault", "nan"]


def test_a_bounded_number_of_rows_is_read_ahead(table):
    class Endless(CsvTable):
        __slots__ = ()

        def rows(self):
            nonlocal num_read
            while True:
                num_read += 1
                yield ["1", "a tree"]

    num_read = 0
    fake = FakeLocalizer()
    fake.gate.clear()
    checked = Endless(lambda: table.open("rb"), ";", False, ["id", "text"], 1, None, 1)
    threading.Timer(0.2, fake.gate.set).start()

    def stop(_done):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_rows(checked, [fake], io.BytesIO(), stop)
    assert num_read <= table_rows.ROWS_AHEAD


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"id,text\n1,a tree\n2\n", "calls.csv: row 3: has 1 cells"),
        (b"id,words\n", "calls.csv: row 1: no column has the name given for the text; the columns are id, words"),
        (None, "calls.csv: No such file"),
    ],
)
def test_a_bad_table_is_refused_before_the_index_is_opened(version, table, content, words):
    table.unlink() if content is None else table.write_bytes(content)
    version.localizers = None
    result = run(table, table.with_name("out.csv"))
    assert result.exit_code == 1
    assert words in result.stderr
    assert not table.with_name("out.csv").exists()


def test_the_input_is_not_overwritten(version, table):
    for out in (table.parent / ".." / table.parent.name / "calls.csv", table.parent):
        assert "neither the table nor a directory" in run(table, out).stderr
    assert table.read_bytes() == TABLE.encode()


def test_a_map_without_georeference_is_refused(version, table):
    version.frame.origin_lat = None
    result = run(table, table.with_name("out.csv"))
    assert "has no latitude and longitude" in result.stderr
    assert not list(table.parent.glob("out.csv*"))


def test_the_command_imports_no_torch():
    code = "import sys, app.cli.batch, app.cli.table_rows; sys.exit('torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], cwd=FAKE.parents[3], check=False).returncode == 0
