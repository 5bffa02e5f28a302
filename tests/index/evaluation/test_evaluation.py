import json
from dataclasses import replace

import numpy as np
import pytest
import torch

from index.answering.ranking import Ranker
from index.evaluation import evaluation
from index.evaluation.ambiguity import ambiguity
from index.evaluation.evaluation import evaluate, evaluate_growth, grow_gallery, rescore
from index.evaluation.localizers import vectors_of_map
from index.evaluation.predictions import PREDICTIONS_FILE, Predictions
from index.evaluation.scoring import score
from models.citymap.hints import build_hint_table
from models.citymap.queries import Queries
from models.citymap.types import DIRECTIONS
from models.errors import DataError
from models.language.text_encoder import load_text_encoder, loaded
from models.paper.fine.regressor import Regressor, RegressorConfig
from models.paper.instance_encoder import CellFeatures
from models.paper.mncl import Mncl, MnclConfig
from models.sources.source import open_source
from tests.encoding import write_tiny_t5


@pytest.fixture(scope="module")
def vectors(data_and_queries, model):
    data = data_and_queries[0]
    return vectors_of_map(data, Ranker.from_cells(model, data.cells, data.gallery.labels))


@pytest.fixture(scope="module")
def run_dir(data_and_queries, vectors, tmp_path_factory):
    directory = tmp_path_factory.mktemp("report")
    evaluate(*data_and_queries, vectors, directory, [60, 120])
    return directory


@pytest.fixture(scope="module")
def report(run_dir):
    return json.loads((run_dir / "report.json").read_text())


def test_the_report_has_the_fixed_names(report, data_and_queries) -> None:
    assert set(report["retrieval"]) == {"1", "3", "5"}
    assert set(report["localization"]) == {"1", "5", "10"}
    assert all(set(row) == {"5", "10", "15"} for row in report["localization"].values())
    data, queries = data_and_queries
    assert (report["cells"], report["queries"]) == (len(data.cells), len(queries))
    assert report["cells"] > 400
    assert report["queries"] > 300


def test_recalls_grow_and_stay_under_the_oracle(report) -> None:
    r = report["retrieval"]
    assert 0 <= r["1"] <= r["3"] <= r["5"] <= 1
    assert report["oracle"]["1"]["15"] == 1, "the best cell's centre is within 15 m by definition"
    for k in ("1", "5", "10"):
        row, oracle = report["localization"][k], report["oracle"][k]
        assert row["5"] <= row["10"] <= row["15"]
        assert row["5"] <= oracle["5"] or k != "1"


def test_strategies_make_up_the_whole(report) -> None:
    parts = report["by_strategy"].values()
    assert set(report["by_strategy"]) == {"closest", "class", "direction"}
    total = sum(part["queries"] * part["retrieval"]["3"] for part in parts)
    assert total / report["queries"] == pytest.approx(report["retrieval"]["3"])


def test_chance_is_what_random_candidates_reach(report, data_and_queries) -> None:
    data, queries = data_and_queries
    rng = np.random.default_rng(0)
    drawn = rng.integers(len(data.cells), size=(10, len(queries), 5))
    errors = np.linalg.norm(data.cells.center_m[drawn, :2] - queries.positions_m[:, None], axis=-1).min(axis=-1)
    assert report["chance"]["localization"]["5"]["15"] == pytest.approx(np.mean(errors <= 15), abs=0.01)


def test_it_is_the_same_twice_and_when_scored_again(run_dir, report, data_and_queries, vectors) -> None:
    assert evaluate(*data_and_queries, vectors, None, [120, 60]) == report
    written = (run_dir / "report.json").read_bytes()
    assert rescore(run_dir) == report
    assert (run_dir / "report.json").read_bytes() == written


def test_tables_and_plots_are_written(run_dir, report) -> None:
    page = (run_dir / "report.md").read_text()
    assert f"{report['retrieval']['5']:.3f}" in page
    for name in ("recall", "errors", "calibration", "map", "growth"):
        assert (run_dir / f"{name}.png").read_bytes()[:4] == b"\x89PNG"
        assert f"({name}.png)" in page


def test_a_growing_gallery_asks_the_same_queries(report, data_and_queries) -> None:
    data, queries = data_and_queries
    first, second = report["growth"]
    assert first["queries"] == second["queries"] > 10
    assert first["cells"] < second["cells"] < len(data.cells)
    assert first["retrieval"]["5"] >= second["retrieval"]["5"]
    (radius, (small, part), rows), _ = grow_gallery(data, queries, [120, 60])
    assert radius == 60
    assert [small.cells.ids[n] for n in part.truth] == [
        data.cells.ids[queries.truth[list(queries.sentences).index(query_sentences)]]
        for query_sentences in part.sentences
    ]
    assert [data.cells.ids[n] for n in rows] == list(small.cells.ids)


def test_a_gallery_grows_in_one_scene_alone(streets, model) -> None:
    source = open_source(streets, "train")
    data, queries = source.data, source.queries()
    scenes = sorted(set(queries.scenes))
    assert len(scenes) == 2, "which lie over each other"
    localizer = vectors_of_map(data, Ranker.from_cells(model, data.cells, data.gallery.labels))
    for scene in scenes:
        positions = [queries.positions_m[q] for q in range(len(queries)) if queries.scenes[q] == scene]
        mean = sum(positions) / len(positions)
        middle = min(positions, key=lambda p: float(np.hypot(*(p - mean))))
        within = {
            radius: [
                n
                for n in range(len(data.cells))
                if data.cells.scenes[n] == scene and np.hypot(*(data.cells.center_m[n, :2] - middle)) <= radius
            ]
            for radius in (20, 40)
        }
        steps = grow_gallery(data, queries, [40, 20], scene)
        assert {radius: rows.tolist() for radius, _, rows in steps} == within
        chosen = [
            queries.sentences[q]
            for q in range(len(queries))
            if queries.scenes[q] == scene and queries.truth[q] in within[20]
        ]
        assert all(list(part.sentences) == chosen for _, (_, part), _ in steps)
        report = evaluate_growth(data, queries, localizer, [20, 40], scene)
        assert [(row["radius_m"], row["cells"], row["queries"]) for row in report] == [
            (radius, len(rows), len(chosen)) for radius, rows in within.items()
        ]
        assert report[0]["retrieval"]["5"] >= report[1]["retrieval"]["5"]


@pytest.mark.parametrize(("radii", "message"), [([0], "not a valid radius"), ([1e-6], "larger radius")])
def test_radii_that_hold_nothing_are_refused(data_and_queries, radii, message) -> None:
    data, queries = data_and_queries
    shifted = replace(queries, positions_m=queries.positions_m + 3.3)
    with pytest.raises(DataError, match=message):
        grow_gallery(data, shifted, radii)


def test_another_scene_is_never_a_hit(run_dir) -> None:
    whole = Predictions.load(run_dir / PREDICTIONS_FILE)
    elsewhere = replace(whole, cell_scenes=np.array(["other"] * len(whole.cell_ids)))
    assert np.isfinite(whole.errors_m()).all()
    assert np.isinf(elsewhere.errors_m()).all()
    everywhere = replace(elsewhere, radius_m=np.full((len(elsewhere.positions_m), 2), 1e9))
    assert score(everywhere)["coverage"]["p90"]["true"] == 1.0, "a circle round the whole map holds every scene"


def test_a_query_far_from_every_cell_is_asked_and_missed(data_and_queries, vectors) -> None:
    data, queries = data_and_queries
    positions = queries.positions_m[:2] + np.array([[0, 0], [1e4, 0]])
    own = Queries.from_text(queries.sentences[:2], positions, data.cells)
    assert own.truth.tolist() == [queries.truth[0], -1]
    figures = evaluate(data, own, vectors)
    assert figures["queries_without_cell"] == 1
    assert max(figures["retrieval"]["5"], figures["localization"]["10"]["15"]) <= 0.5


def test_broken_predictions_are_refused(run_dir, tmp_path) -> None:
    with pytest.raises(DataError, match="no such file"):
        rescore(tmp_path)
    (tmp_path / PREDICTIONS_FILE).write_bytes(b"nothing")
    with pytest.raises(DataError, match="no predictions"):
        rescore(tmp_path)
    whole = Predictions.load(run_dir / PREDICTIONS_FILE)
    replace(whole, scenes=whole.scenes[:-1]).save(tmp_path / PREDICTIONS_FILE)
    with pytest.raises(DataError, match="scenes"):
        rescore(tmp_path)
    replace(whole, ranked=whole.ranked + 10_000).save(tmp_path / PREDICTIONS_FILE)
    with pytest.raises(DataError, match="outside the gallery"):
        rescore(tmp_path)


def test_exact_matching_against_a_naive_count(osm_file) -> None:
    val = open_source(osm_file, "val")
    data, queries = val.data, val.queries()
    assert queries.hints
    hints, truths = queries.hints[::9], queries.truth[::9]
    table = build_hint_table(data.palette, data.cells.parts, data.cells.center_m)
    words = (*data.palette.words, None)
    true_at = [
        {
            (data.gallery.labels[table.instance[r]], words[table.colour[r]], DIRECTIONS[table.direction[r]])
            for r in range(table.starts[n], table.starts[n + 1])
        }
        for n in range(len(data.cells))
    ]
    ranks = []
    for query_sentences, truth in zip(hints, truths, strict=True):
        fits = [sum((h.label, h.colour, h.direction) in true for h in query_sentences) for true in true_at]
        better, equal = sum(f > fits[truth] for f in fits), sum(f == fits[truth] for f in fits)
        ranks.append((better, equal))
    figures = ambiguity(data, replace(queries, truth=truths), hints)
    assert figures["median_cells_that_fit_as_well"] == np.median([b + e for b, e in ranks])
    for k in (1, 3, 5):
        assert figures["exact_matching"][k] == pytest.approx(np.mean([min(1, max(0, (k - b) / e)) for b, e in ranks]))


def test_a_second_evaluation_does_not_run_a_heavy_text_encoder(data_and_queries, tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("HEREABOUTS_CACHE_DIR", str(tmp_path / "cache"))
    data, queries = data_and_queries
    queries = queries.take(np.arange(40))
    words = {word.strip(".") for sentences in queries.sentences for hint in sentences for word in hint.split()}
    write_tiny_t5(tmp_path / "t5", [".", *sorted(words)])

    def measured() -> tuple[dict, int]:
        loaded.cache_clear()  # as another process
        encoder = load_text_encoder(str(tmp_path / "t5"))
        torch.manual_seed(0)
        retriever, refiner = Mncl(encoder, MnclConfig(width=32)), Regressor(encoder, RegressorConfig(width=32))
        localizer = vectors_of_map(
            data, Ranker.from_cells(retriever.eval(), data.cells, data.gallery.labels), refiner.eval()
        )
        refiner._embed(CellFeatures.from_cells(data.cells, np.array(data.gallery.labels)).labels)  # not of queries
        calls = []
        encoder.model.register_forward_hook(lambda *_: calls.append(1))
        return evaluate(data, queries, localizer), len(calls)

    first, second = measured(), measured()
    loaded.cache_clear()
    assert first[1] > 0
    assert second == (first[0], 0)
    assert [path.suffix for path in sorted((tmp_path / "cache" / "tokens").iterdir())] == [".lock", ".safetensors"]


def test_minilm_computes_its_features(data_and_queries, vectors, monkeypatch) -> None:
    monkeypatch.setattr(evaluation, "frozen_features", None)
    evaluate(data_and_queries[0], data_and_queries[1].take(np.arange(3)), vectors)
