"""evaluate, localize --picture and benchmark, on the tiny town."""

import json
import re

import pytest
from typer.testing import CliRunner

from app.benchmark import processes, service
from app.cli.main import app
from models.errors import HereaboutsError


@pytest.fixture
def run(monkeypatch, weights_dir):
    monkeypatch.setenv("HEREABOUTS_WEIGHTS_DIR", str(weights_dir))
    monkeypatch.setenv("COLUMNS", "160")
    return lambda *args: CliRunner().invoke(app, [str(arg) for arg in args])


@pytest.mark.slow
def test_evaluate_prints_what_it_writes(run, strip_file, tmp_path) -> None:
    results = [run("evaluate", "--data", strip_file, "--split", "val", "--report", tmp_path / "r") for _ in range(2)]
    assert results[0].exit_code == 0, results[0].output
    assert results[0].stdout == results[1].stdout
    report = json.loads((tmp_path / "r" / "report.json").read_text())
    assert f"{report['retrieval']['5']:.3f}" in results[0].output
    assert "oracle" in results[0].output


def test_evaluate_refuses_an_unknown_split_in_one_line(run, osm_file) -> None:
    result = run("evaluate", "--data", osm_file, "--split", "north")
    assert result.exit_code == 1
    assert "is not a split of a map" in result.output


@pytest.mark.slow
def test_evaluate_ranks_again(run, strip_file) -> None:
    args = "evaluate", "--data", strip_file, "--split", "val", "--refine", "none"
    plain, again = run(*args), run(*args, "--rerank", "parc")
    assert again.exit_code == 0, again.output
    # The model is untrained, so there is much to gain.
    recalls = [float(re.findall(r"model\s+\S\s+([\d.]+)", result.output)[0]) for result in (plain, again)]
    assert recalls[1] > recalls[0]


@pytest.mark.parametrize(
    ("args", "other"),
    [
        (("--data", "town.osm"), "--refine posterior, the default"),
        (("--data", "town.osm", "--refine", "posterior"), "--refine posterior"),
        (("--data", "town.osm", "--refine", "none", "--robustness"), "--robustness"),
        (("--data", "texts.jsonl"), "a file of texts"),
        (("--rescore", "report"), "--rescore"),
    ],
)
def test_only_vector_search_is_ranked_again(run, args, other) -> None:
    result = run("evaluate", *args, "--rerank", "parc")
    assert result.exit_code == 1
    message = " ".join(result.output.split())
    assert f"does not work with {other}" in message
    assert "--refine none, regressor or matching" in message


def test_questions_prints_what_they_help(run, osm_file, index_dir) -> None:
    result = run("questions", "--data", osm_file, "--index", index_dir, "--texts", "3", "--plain")
    assert result.exit_code == 0, result.output
    assert "3 texts, seed 0" in result.output
    assert "within 10 m" in result.output


def test_descriptions_prints_how_many_positions_are_found_again(run, index_dir) -> None:
    result = run("descriptions", "--index", index_dir, "--positions", "3")
    assert result.exit_code == 0, result.output
    assert "tinytown: 3 positions, seed 0" in result.output
    assert "within 5/10/15/30 m" in result.output


def test_localize_draws_a_picture(run, index_dir, tmp_path) -> None:
    text = r"I am north of a red building. A bench costs $\foo{ and $2."  # is no formula
    result = run("localize", text, "--index", index_dir, "--picture", tmp_path / "a.png")
    assert result.exit_code == 0, result.output
    assert (tmp_path / "a.png").read_bytes()[:4] == b"\x89PNG"


@pytest.mark.slow
def test_benchmark_measures_index_and_service(run, strip_file, index_dir, monkeypatch) -> None:
    for name, few in (("REQUESTS", 3), ("WARM_UP", 2), ("PARTS", 5)):
        monkeypatch.setattr(service, name, few)
    monkeypatch.setenv("HEREABOUTS_READ_KEY", "of-a-service")
    result = run("benchmark", "--map", strip_file, "--index", index_dir)
    assert result.exit_code == 0, result.output
    figures = json.loads(result.output[result.output.index("{") :])
    assert figures["index"]["peak_memory_mib"] > 100
    assert figures["index"]["size_mib"] > 0
    assert all(seconds > 0.5 for seconds in figures["start_seconds"].values())  # torch alone takes longer to import
    assert 0 < figures["localize_cached_hints_ms"]["p50"] <= figures["localize_cached_hints_ms"]["p99"]
    parts = figures["one_thread"]
    assert all(parts[f"{name}_ms"] > 0 for name in ("read", "posterior", "encode", "vector_search"))
    assert parts["surroundings_bytes_a_cell"] > 100


@pytest.mark.slow
def test_benchmark_says_when_the_service_does_not_start(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(processes, "START_S", 0.5)
    with (
        pytest.raises(HereaboutsError, match="did not become ready"),
        processes.serving(tmp_path / "nothing") as served,
    ):
        served.client.get("/healthz")


def test_people_s_texts_are_asked_of_an_index(run, index_dir, tmp_path) -> None:
    file = tmp_path / "texts.jsonl"
    file.write_text('{"text": "I am on East Street 2 at North Path 3", "goal": [60.001, 25.003]}\n')
    result = run("evaluate", "--index", index_dir, "--data", file, "--report", tmp_path / "r")
    assert result.exit_code == 0, result.output
    assert "within 10/30/100/250 m" in result.output
    assert (tmp_path / "r" / "told.json").is_file()
    file.write_text('{"text": "no goal"}\n')
    result = run("evaluate", "--index", index_dir, "--data", file)
    assert result.exit_code == 1
