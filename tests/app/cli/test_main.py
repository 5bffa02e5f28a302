import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from fake_localizer import FakeLocalizer
from typer.testing import CliRunner

from app import logs, server
from app.cli import maps
from app.cli.main import app
from app.cli.measure import SHIPPED_MAP
from app.threads import THREAD_VARIABLES
from models.citymap.frame import Frame
from models.errors import IndexBroken, MapError
from models.spool import spool_directory, spooling_in

TEXT = "I am north of a gray building. A black pole is to my west."


@pytest.fixture(autouse=True)
def _environment(monkeypatch):
    for name in THREAD_VARIABLES:
        monkeypatch.setenv(name, "1")  # commands set what is not set; this brings it back


@pytest.fixture
def opened(monkeypatch):
    """Puts a fake localizer where the command looks for the real one; the list tells how it was opened."""
    calls = []

    def put(localizer):
        def open_(index_dir, weights_dir, _fine_weights_dir, _posterior_weights_dir):
            calls.append((index_dir, weights_dir))
            if isinstance(localizer, Exception):
                raise localizer
            return localizer

        monkeypatch.setitem(
            sys.modules, "index.answering.localizer", SimpleNamespace(Localizer=SimpleNamespace(open=open_))
        )
        return calls

    return put


def run(*arguments):
    return CliRunner().invoke(app, arguments, env={"COLUMNS": "200"})


def test_table_has_the_candidates_and_the_radius(opened):
    fake = FakeLocalizer()
    calls = opened(fake)
    result = run("localize", TEXT, "--top-k", "1")
    assert result.exit_code == 0
    assert "fakeville_00001" in result.stdout
    assert "fakeville_00002" not in result.stdout
    assert "60.170000, 24.940000" in result.stdout
    assert "12 m (p50)" in result.stdout
    assert fake.batches[0][0].description == TEXT
    assert calls == [(Path("data/index"), None)]


def test_table_without_georeference_and_without_match(opened):
    opened(FakeLocalizer(Frame()))
    assert "24.94" not in run("localize", "a tree").stdout
    result = run("localize", "nowhere")
    assert result.exit_code == 0
    assert "no_match" in result.stdout
    assert "warning: nothing there" in result.stdout


def test_json_is_all_that_is_printed(opened, monkeypatch):
    calls = opened(FakeLocalizer())
    monkeypatch.setenv("HEREABOUTS_WEIGHTS_DIR", "/w")
    body = json.loads(run("localize", TEXT, "--json", "--index", "/i").stdout)
    assert body["estimate"]["radius_m"] == {"p50": 12, "p90": 21}
    assert len(body["candidates"]) == 2
    assert calls == [(Path("/i"), Path("/w"))]


@pytest.mark.parametrize(
    ("error", "text"), [(IndexBroken("no [bold] index; " + "build one " * 50), TEXT), (FakeLocalizer(), " ... ")]
)
def test_wrong_input_is_one_line_on_stderr(opened, error, text):
    opened(error)
    result = run("localize", text)
    assert result.exit_code == 1
    assert result.stdout == ""
    assert len(result.stderr.splitlines()) == 1
    assert ("[bold] index" in result.stderr) == isinstance(error, IndexBroken)


def test_fault_is_not_taken_for_wrong_input(opened):
    opened(ZeroDivisionError())
    assert isinstance(run("localize", TEXT).exception, ZeroDivisionError)


def test_index_builds_and_says_what_next(monkeypatch, tmp_path):
    calls, regions, layers = [], [], []

    def job(map_path, out_dir, weights_dir, *rest):
        calls.append((map_path, out_dir, weights_dir))
        regions.append(rest[-2])
        layers.append(rest[-1])

        def build(_show):
            if map_path.name == "bad":
                raise MapError("bad map")
            return out_dir / "v1"

        return SimpleNamespace(build=build)

    monkeypatch.setitem(sys.modules, "index.build.build", SimpleNamespace(IndexJob=job))
    monkeypatch.setattr(maps, "print_index_summary", lambda _path: None)
    result = run("index", "--map", "a.osm", "--out", "o")
    assert (result.exit_code, calls) == (0, [(Path("a.osm"), Path("o"), None)])
    assert result.stdout == "index v1 is in o/v1; serve it with: hereabouts serve --index o\n"
    assert run("index", "--map", "bad").exit_code == 1
    assert regions == [None, None]
    assert run("index", "--map", "a.osm", "--within", "1,2,3,4").exit_code == 0
    assert regions[-1].shape.bounds == (1, 2, 3, 4)
    for name in ("x.csv", "y.csv"):
        (tmp_path / name).write_text("lat,lon\n1,2\n")
    pairs = "--extra", str(tmp_path / "x.csv"), "--kind", "bench", "--extra", str(tmp_path / "y.csv"), "--kind", "robot"
    assert run("index", "--map", "a.osm", *pairs).exit_code == 0
    assert list(map(str, layers[-1])) == ["x.csv as amenity=bench", "y.csv as robot"]
    result = run("index", "--map", "a.osm", *pairs[:-2])
    assert (result.exit_code, len(calls)) == (2, 4)
    assert "each --extra needs a --kind" in result.stderr
    result = run("index", "--map", "a.osm", "--within", "here")
    assert (result.exit_code, len(calls)) == (1, 4)
    assert "west,south,east,north" in result.stderr


def test_an_index_that_is_terminated_leaves_no_temporary_files(monkeypatch, tmp_path):
    def work(*_):
        with spooling_in(tmp_path), spool_directory() as directory:
            (directory / "half").touch()
            os.kill(os.getpid(), signal.SIGTERM)
            signal.pause()

    monkeypatch.setattr("app.cli.main.run_index_job", work)
    before = signal.getsignal(signal.SIGTERM)
    try:
        assert run("index", "--map", "x.osm.pbf", "--out", str(tmp_path)).exit_code == 128 + signal.SIGTERM
    finally:
        signal.signal(signal.SIGTERM, before)
    assert not list(tmp_path.iterdir())


def test_places_of_a_map_are_listed_without_an_index(tmp_path):
    result = run("index", "--map", str(SHIPPED_MAP), "--out", str(tmp_path / "o"), "--list-places")
    assert result.exit_code == 0
    assert re.search(r"^Kallio +10 +incomplete +relation/184765 *$", result.stdout, re.MULTILINE)
    assert result.stdout.splitlines()[-1].startswith("incomplete: the file lacks a part of the boundary")
    assert not (tmp_path / "o").exists()
    result = run("index", "--map", str(SHIPPED_MAP), "--within", "place:kallio", "--out", str(tmp_path / "o"))
    assert (result.exit_code, (tmp_path / "o").exists()) == (1, False)
    assert "9 of its 10 ways" in result.stderr


def test_serve_takes_options_then_environment(monkeypatch):
    served = []
    monkeypatch.setattr(server, "serve", lambda _app, settings: served.append(settings))
    monkeypatch.setattr(logs, "configure_logging", lambda level, with_messages: None)
    monkeypatch.setenv("HEREABOUTS_HOST", "0.0.0.0")
    monkeypatch.setenv("HEREABOUTS_WORKERS", "7")
    assert run("serve", "--index", "/i", "--port", "9").exit_code == 0
    assert run("serve").exit_code == 0
    first, second = served
    assert (first.index_dir, first.host, first.port, first.workers) == (Path("/i"), "0.0.0.0", 9, 7)
    assert (second.index_dir, second.port) == (Path("data/index"), 8000)
    monkeypatch.setenv("HEREABOUTS_WORKERS", "none")
    result = run("serve")
    assert result.exit_code == 1
    assert "workers" in result.stderr


@pytest.mark.parametrize(
    ("module", "heavy"),
    [
        ("app.cli.main", "torch faiss fastapi numpy"),
        ("app.workers.launch", "index models numpy pydantic"),
        ("app.main", "torch faiss numba scipy shapely osmium"),
    ],
)
def test_import_is_light(module, heavy):
    code = f"import sys, {module}; print(set('{heavy}'.split()) & set(sys.modules))"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout == "set()\n"


def test_threads_are_set_before_any_command(opened, monkeypatch):
    monkeypatch.delenv("OMP_NUM_THREADS")
    records = []
    fake = FakeLocalizer()
    fake.localize, answer = lambda q: records.append(os.environ["OMP_NUM_THREADS"]) or answer(q), fake.localize
    opened(fake)
    assert run("localize", TEXT).exit_code == 0
    assert int(records[0]) >= 1


RING = [[0, 0], [9, 0], [0, 9], [0, 0]]


@pytest.mark.parametrize("text", [TEXT, "-"])
def test_fields_of_the_service_narrow_the_search(opened, text):
    fake = FakeLocalizer()
    opened(fake)
    prior = {"position": [1, 2], "semi_major_m": 30, "semi_minor_m": 10, "orientation_deg": 45}
    fields = json.dumps({"within": {"type": "Polygon", "coordinates": [RING]}, "prior": prior})
    arguments = ["localize", text, "--fields", fields, "--top-k", "1", "--refine", "none"]
    assert CliRunner().invoke(app, arguments, input=TEXT).exit_code == 0
    [[query]] = fake.batches
    assert (query.description, query.top_k, query.refine) == (TEXT, 1, "none")
    assert query.within.polygons == ((tuple(map(tuple, RING)),),)
    assert (query.prior.orientation_deg, query.prior.sigma_m / query.prior.minor_sigma_m) == (45, pytest.approx(3))


@pytest.mark.parametrize(
    ("fields", "phrase"),
    [
        ("within", "not JSON"),
        ("[]", "JSON object"),
        ('{"top_k": 3}', "within"),
        ('{"prior": {"position": [0, 0]}}', "prior.sigma_m"),
        ('{"within": {"bbox": [60.165, 24.93, 60.175, 24.95]}, "crs": "wgs84"}', "within.bbox"),
    ],
)
def test_fields_that_cannot_be_used_are_named(opened, fields, phrase):
    fake = FakeLocalizer()
    opened(fake)
    result = run("localize", TEXT, "--fields", fields)
    assert (result.exit_code, fake.batches) == (2, [])
    assert phrase in result.stderr


def test_lines_of_standard_input_are_answered_a_line_each_and_a_bad_one_fails_alone(opened):
    fake = FakeLocalizer()
    opened(fake)
    given = f"{TEXT}\n\n   \n...\nnowhere to be seen\n"
    result = CliRunner().invoke(app, ["localize", "-", "--top-k", "1"], input=given)
    first, second, third = map(json.loads, result.stdout.splitlines())
    assert first["status"] == "ok"
    assert len(first["candidates"]) == 1
    assert "error" in second
    assert third["status"] == "no_match"
    assert result.exit_code == 1
    assert [query.description for [query] in fake.batches] == [TEXT, "nowhere to be seen"]
