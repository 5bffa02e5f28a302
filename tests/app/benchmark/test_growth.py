"""How a city grows: what `hereabouts benchmark --cells` prints, on the tiny town, and what its figures mean."""

import json

import pytest
from typer.testing import CliRunner

from app.benchmark import growth, questions, searches, service
from app.benchmark.growth import parse_sizes, ratios, run_growth
from app.benchmark.plots import draw_costs, draw_latencies
from app.cli import measure
from app.cli.main import app
from models.errors import DataError, HereaboutsError, MapError

PARTS = ("read_ms", "encode_ms", "candidates_ms", "posterior_ms")


@pytest.fixture
def run(monkeypatch, weights_dir):
    monkeypatch.setenv("HEREABOUTS_WEIGHTS_DIR", str(weights_dir))
    monkeypatch.setenv("HEREABOUTS_WORKERS", "1")
    for module, name, count in ((questions, "QUERIES_PER_KIND", 2), (questions, "WARM_UP", 1), (growth, "PARTS", 2)):
        monkeypatch.setattr(module, name, count)
    return lambda *args: CliRunner().invoke(app, ["benchmark", *(str(arg) for arg in args)])


@pytest.mark.slow
def test_a_city_of_two_copies_is_measured_whole(run, osm_file, cells, tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(searches, "find_spec", lambda name: None)
    result = run("--cells", 2 * len(cells), "--map", osm_file, "--out", tmp_path / "r")
    assert result.exit_code == 0, result.output
    report = json.loads((tmp_path / "r" / "benchmark.json").read_text())
    assert "PostGIS and Nominatim are not measured" in report["compared"]
    assert str(len(cells)) in report["assumed"]
    [size], [ratio] = report["sizes"], report["ratios"]
    assert size["copies"] == 2
    assert size["cells"] == pytest.approx(2 * len(cells), rel=0.1)
    assert size["map"]["size_mb"] > 0
    assert size["index"]["seconds"] > 0.5
    assert size["index"]["peak_memory_mib"] > 100
    by_file = size["index"]["bytes_a_cell"]
    assert by_file.pop("all") == pytest.approx(sum(by_file.values()), abs=0.1 * len(by_file))
    assert by_file["vectors.faiss"] == pytest.approx(4 * 32, rel=0.1)
    assert size["serve"]["ready_seconds"] > 0.5
    assert min(size["serve"]["memory_mib"].values()) > 150, "the workers count, which torch is in"
    for name in ("anywhere", *questions.WITHIN):
        queries = size["localize"][name]
        assert 0 < queries["p50"] <= queries["p99"]
        assert queries["unanswered"] == 0
        assert queries["accuracy"]["queries"] == 2
        assert queries["accuracy"]["within_30_m"] <= queries["accuracy_in_any_copy"]["within_30_m"]
    assert size["localize"]["within_0.1_percent"]["accuracy"]["within_30_m"] == 1, "the box is 20 m wide"
    assert "p50" not in size["localize"]["with_street"]
    assert all(size["one_thread"][part] > 0 for part in PARTS)
    assert size["vector_search"]["faiss_ms"] > 0
    assert size["vector_search"]["milvus"] == "not installed"
    assert ratio["index"]["seconds"] == 1
    for name in ("costs.png", "latencies.png"):
        assert (tmp_path / "r" / name).read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize("text", ["abc", "", "1e4,", "0", "-5,100", "nan", "inf", "1e4;1e5"])
def test_what_is_no_list_of_sizes_says_what_one_is(run, text) -> None:
    result = run("--cells", text)
    assert result.exit_code == 1
    assert "write it as 1e4,1e5,1e6" in result.output


def test_sizes_are_ascending_and_come_once() -> None:
    assert parse_sizes("1e5, 1e4,10000") == [10_000, 100_000]


def test_a_size_below_one_copy_is_refused_before_anything_is_built(run, osm_file, cells) -> None:
    result = run("--cells", f"{len(cells) - 1},1e6", "--map", osm_file)
    assert result.exit_code == 1
    assert f"give at least {len(cells)}" in " ".join(result.output.split())


def test_no_such_map_and_no_map_are_said(run, tmp_path) -> None:
    result = run("--cells", "1e4", "--map", tmp_path / "nothing.osm.pbf")
    assert result.exit_code == 1
    assert "not an OpenStreetMap file" in result.output
    assert run().exit_code == 2, "without --cells a map is needed"
    assert measure.SHIPPED_MAP.is_file()


def test_out_without_cells_is_refused(run, osm_file, tmp_path) -> None:
    result = run("--map", osm_file, "--out", tmp_path)
    assert result.exit_code == 1
    assert "--cells" in result.output


def test_what_fails_is_told_with_what_was_measured(run, osm_file, cells, monkeypatch, tmp_path) -> None:
    def measured(extract, copies, queries, scratch):
        if copies > 1:
            raise HereaboutsError("too large")
        return {"cells": len(cells), "index": {"seconds": 2.0}}

    monkeypatch.setattr(growth, "_measure_size", measured)
    sizes = ",".join(str(n * len(cells)) for n in (1, 2, 3))
    result = run("--cells", sizes, "--map", osm_file, "--out", tmp_path)
    assert result.exit_code == 1
    assert "too large" in result.output
    report = json.loads((tmp_path / "benchmark.json").read_text())
    assert len(report["sizes"]) == 1
    assert report["failed"] == {"cells": 2 * len(cells), "why": "too large"}


def test_an_out_that_cannot_be_written_is_said(osm_file, cells, monkeypatch, tmp_path) -> None:
    monkeypatch.setattr(growth, "_measure_size", lambda *_: {"cells": 1})
    monkeypatch.setattr(growth, "draw_queries", lambda _: [None] * 100)
    (tmp_path / "file").write_text("")
    with pytest.raises(DataError, match="another directory as --out"):
        run_growth(osm_file, [len(cells)], tmp_path / "file")


def test_ratios_are_of_numbers_alone() -> None:
    first = {"a": 2, "b": {"c": 4.0, "d": 0, "e": None, "f": "x"}}
    assert ratios({"a": 3, "b": {"c": 2.0, "d": 1, "e": 5, "f": "x"}, "g": 1}, first) == {
        "a": 1.5,
        "b": {"c": 0.5, "d": None, "e": None, "f": None},
        "g": None,
    }


def test_pictures_leave_out_what_was_not_measured(tmp_path) -> None:
    sizes = [{"cells": 10, "index": {"seconds": 1.0}, "vector_search": {"milvus": "not installed"}}, {"cells": 99}]
    for draw in (draw_costs, draw_latencies):
        draw(tmp_path / "a.png", sizes)
        assert (tmp_path / "a.png").stat().st_size > 1000


@pytest.mark.slow
def test_milvus_is_asked_the_same_and_leaves_nothing(localizer, monkeypatch) -> None:
    pytest.importorskip("pymilvus")
    pytest.importorskip("milvus_lite")
    monkeypatch.delenv("HEREABOUTS_MILVUS_URI", raising=False)
    figures = searches.measure_searches(localizer, [("I am north of a bench.",), ("A tree is to my west.",)])
    assert figures["milvus"]["kind"] == "milvus-lite"
    assert figures["milvus"]["ms"] > 0
    assert figures["faiss_ms"] > 0
    assert figures["found"] == 1.0
    assert "HEREABOUTS_MILVUS_URI" not in searches.os.environ
    monkeypatch.setenv("HEREABOUTS_MILVUS_URI", "http://127.0.0.1:9/none")
    assert "Milvus cannot" in searches.measure_searches(localizer, [("A tree is to my west.",)])["milvus"]


def test_too_few_places_are_said() -> None:
    with pytest.raises(MapError, match="a larger one as --map"):
        questions.split_questions([questions.BenchmarkQuery(("a",), None, 60.0, 25.0)] * questions.WARM_UP)


def test_percentiles_are_in_milliseconds() -> None:
    assert service.percentiles([0.001] * 99 + [1.0])["p50"] == 1.0
