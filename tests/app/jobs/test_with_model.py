"""Evaluations that are really run, on the tiny town: HTTP says what the command line writes."""

import json
import time

import pytest
from local_client import local_client
from typer.testing import CliRunner

from app.cli import main as cli
from app.main import create_app
from app.settings import Settings
from index.answering.ranking import Ranker
from index.evaluation.localizers import map_of_index, vectors_of_map
from models.citymap.queries import Queries
from models.sources.source import open_source

TIMEOUT_S = 120


@pytest.fixture(scope="module")
def served(strip_file, index_dir, weights_dir, until, warm_workers):
    settings = Settings(index_dir=index_dir, weights_dir=weights_dir, data_dir=strip_file.parent)
    with local_client(create_app(settings)) as served:
        until(lambda: served.get("/readyz").status_code == 200)
        yield served


@pytest.fixture
def command_line(monkeypatch, weights_dir, index_dir, tmp_path):
    """Runs `hereabouts evaluate` and gives its report."""
    monkeypatch.setenv("HEREABOUTS_WEIGHTS_DIR", str(weights_dir))
    monkeypatch.setenv("HEREABOUTS_INDEX_DIR", str(index_dir))

    def run(*args):
        result = CliRunner().invoke(cli.app, ["evaluate", "--report", str(tmp_path / "report"), *map(str, args)])
        assert result.exit_code == 0, result.output
        return json.loads((tmp_path / "report" / "report.json").read_text())

    return run


def evaluate(served, body):
    accepted = served.post("/evaluate", json=body)
    assert accepted.status_code == 202, accepted.text
    end = time.monotonic() + TIMEOUT_S
    while (now := served.get(accepted.headers["location"]).json())["status"] in {"queued", "running"}:
        assert time.monotonic() < end, now
        time.sleep(0.1)
    return now


@pytest.fixture(scope="module")
def queries(osm_file):
    every_query = open_source(osm_file, "test").queries()
    some_queries = [
        {"description": " ".join(every_query.sentences[q]), "position": every_query.positions_m[q].tolist()}
        for q in range(0, len(every_query), 20)
    ]
    return [*some_queries, {"hints": ["I am nowhere near."], "position": [5000.0, 5000.0]}]


@pytest.mark.slow
def test_inline_queries_get_the_report_of_the_command_line(served, command_line, queries, tmp_path):
    body = {"queries": queries, "grow": [60, 120]}
    (tmp_path / "queries.json").write_text(json.dumps(body))
    finished = evaluate(served, body)
    assert finished["status"] == "done", finished
    report = finished["report"]
    assert report == command_line("--data", tmp_path / "queries.json")
    assert (report["data"], report["split"]) == ("tinytown", "index")
    assert (report["queries"], report["queries_without_cell"]) == (len(queries), 1)
    assert [step["radius_m"] for step in report["growth"]] == [60, 120]


@pytest.mark.slow
def test_data_set_by_name_gets_the_report_of_the_command_line(served, command_line, strip_file):
    finished = evaluate(served, {"data": "strip", "split": "val"})
    assert finished["status"] == "done", finished
    assert finished["report"] == command_line("--data", strip_file, "--split", "val")


def test_queries_of_an_index_find_what_those_of_its_map_find(served, osm_file, localizer):
    """The index's own vectors against vectors made anew."""
    from index.evaluation.evaluation import evaluate as run

    data = map_of_index(localizer)
    every_query = open_source(osm_file).queries()
    mine = Queries.from_text(every_query.sentences[::40], every_query.positions_m[::40], data.cells)
    made = Ranker.from_cells(localizer.retriever, data.cells, data.gallery.labels)
    stored, anew = (run(data, mine, vectors_of_map(data, ranker)) for ranker in (localizer.ranker, made))
    assert stored == anew


@pytest.mark.slow
def test_what_is_wrong_with_the_data_is_the_jobs_error(served, strip_file):
    finished = evaluate(served, {"data": "strip", "split": "north"})
    assert finished["status"] == "failed"
    assert "'north' is not a split" in finished["error"]["detail"]
    assert str(strip_file.parent) not in finished["error"]["detail"]
