import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
import torch

from index.answering.localizer import Localizer
from index.answering.query import Circle, Query
from index.answering.ranking import Ranker
from index.build.build import IndexJob
from index.evaluation.evaluation import evaluate
from index.evaluation.localizers import vectors_of_map
from index.evaluation.predictions import PREDICTIONS_FILE, Predictions
from models.errors import WeightsError
from models.language.text_encoder import DEFAULT_TEXT_ENCODER
from models.paper.fine.checkpoint import load_refiner, save_fine
from models.paper.fine.matching import Matching, MatchingConfig
from models.paper.fine.regressor import Regressor, RegressorConfig
from models.paper.instance_encoder import CellFeatures

TEXT = "I am north of a red building. A bench is to my west. I stand on the road."


class OracleRefiner:
    """A refiner that knows where each description was said."""

    method, name, fingerprint, error_m = "regressor", "oracle", "told", 0.5

    text_encoder = SimpleNamespace(source=DEFAULT_TEXT_ENCODER)

    def __init__(self, cells, positions_m):
        self.cells, self.positions_m, self.rows_refined = cells, positions_m, 0

    def with_point_features(self, cells):
        return cells

    def predict(self, descriptions, cells, rows):
        assert len(cells) == len(self.cells)
        assert len(descriptions) == len(rows)
        positions = self.positions_m[
            self.rows_refined : self.rows_refined + len(rows)
        ]  # they are asked in order, some at a time
        self.rows_refined += len(rows)
        return (positions[:, None] - self.cells.center_m[rows, :2]) / self.cells.size_m + 0.5


@pytest.fixture(scope="module")
def ranker(data_and_queries, model):
    return Ranker.from_cells(model, data_and_queries[0].cells, data_and_queries[0].gallery.labels)


@pytest.fixture
def regressor(text_encoder):
    torch.manual_seed(0)
    return Regressor(text_encoder, RegressorConfig(width=32, error_m=2.0)).eval()


def test_a_refiner_that_knows_the_truth_scores_one(data_and_queries, ranker, tmp_path) -> None:
    data, queries = data_and_queries
    report = evaluate(
        *data_and_queries, vectors_of_map(data, ranker, OracleRefiner(data.cells, queries.positions_m)), tmp_path
    )
    plain = evaluate(*data_and_queries, vectors_of_map(data, ranker))
    assert {v for row in report["localization"].values() for v in row.values()} == {1.0}
    assert report["method"] == "regressor"
    assert (report["model"], report["model_fingerprint"]) == ("oracle", "told")
    assert plain["method"] == "cell_center"
    for row in ("cell_center", "oracle", "chance", "retrieval"):
        assert report[row] == plain[row], "what does not depend on the position stays"
    assert plain["localization"] == plain["cell_center"]
    assert "retrieved cell's centre" in (tmp_path / "report.md").read_text()


def test_refined_positions_are_saved_and_lie_in_their_cells(data_and_queries, ranker, regressor, tmp_path) -> None:
    data, queries = data_and_queries
    part = dataclasses.replace(queries.take(np.arange(9)), hints=None)
    evaluate(data, part, vectors_of_map(data, ranker, regressor), tmp_path)
    saved = Predictions.load(tmp_path / PREDICTIONS_FILE)
    first = saved.ranked[:, : saved.predicted_m.shape[1]]
    away = np.abs(saved.predicted_m - saved.cell_centers_m[first])
    assert 0 < away.max() <= data.cells.size_m / 2 + 1e-6
    alone = vectors_of_map(data, ranker, regressor).find([Query(" ".join(part.sentences[4]), top_k=10)])
    assert alone[0].located.positions[:10] == pytest.approx(saved.predicted_m[4], abs=1e-3)


def refining(localizer, load):
    return Localizer(localizer._directory, localizer.manifest, localizer.retriever, load)


def test_a_query_may_ask_for_positions_inside_the_cells(localizer, regressor) -> None:
    fine = refining(localizer, lambda _: regressor)
    plain, refined = fine.localize([Query(TEXT, 3, refine="none"), Query(TEXT, 3, refine="regressor")])
    [again] = localizer.localize([Query(TEXT, 3, refine="none")])
    assert plain == dataclasses.replace(again, timings_ms=plain.timings_ms)
    assert [c.cell_id for c in plain.candidates] == [c.cell_id for c in refined.candidates]
    assert [c.probability for c in plain.candidates] == [c.probability for c in refined.candidates]
    assert (plain.estimate.method, refined.estimate.method) == ("cell_center", "regressor")
    assert refined.estimate.position == refined.candidates[0].position != refined.candidates[0].center
    for candidate in refined.candidates:
        west, south, east, north = candidate.bbox
        x, y = candidate.position
        assert west <= x <= east
        assert south <= y <= north
        back = fine.frame.from_wgs84(candidate.wgs84.lat, candidate.wgs84.lon)
        assert back == pytest.approx(candidate.position, abs=0.02)


def test_uncertainty_is_that_of_what_made_the_estimate(localizer) -> None:
    center = localizer.gallery.cells.center_m[:, :2]
    oracle = OracleRefiner(localizer.gallery.cells, center[:1] + 4)
    # One cell alone is surely the right one.
    sure = Query(TEXT, 1, within=Circle(tuple(center[0]), 1.0), refine="none")
    plain, refined = refining(localizer, lambda _: oracle).localize(
        [sure, dataclasses.replace(sure, refine="regressor")]
    )
    assert refined.estimate.position == pytest.approx(tuple(center[0] + 4))
    assert np.diag(refined.estimate.covariance) == pytest.approx(oracle.error_m**2)
    assert np.diag(plain.estimate.covariance) == pytest.approx(localizer.manifest.grid_m**2 / 12)
    assert refined.estimate.radius_m.p90 < plain.estimate.radius_m.p90


def test_each_refine_has_its_fine_stage(index_dir, weights_dir, text_encoder, tmp_path) -> None:
    """Weights of one's own serve their own method; others are those that ship."""
    matching = Matching(text_encoder, MatchingConfig(width=32)).eval()
    save_fine(matching, tmp_path, {})
    fine = Localizer.open(index_dir, weights_dir, tmp_path)
    own, shipped = fine.localize([Query(TEXT, refine="matching"), Query(TEXT, refine="regressor")])
    assert (own.estimate.method, shipped.estimate.method) == ("matching", "regressor")
    assert own.model.sha256 == matching.fingerprint
    assert shipped.model.sha256 == load_refiner("regressor").fingerprint
    [matched] = Localizer.open(index_dir, weights_dir).localize([Query(TEXT, refine="matching")])
    assert matched.model.sha256 == load_refiner("matching").fingerprint != own.model.sha256


def test_weights_are_missed_only_when_asked_for(index_dir, weights_dir, tmp_path) -> None:
    fine = Localizer.open(index_dir, weights_dir, tmp_path)
    estimate = fine.localize([Query(TEXT, refine="none")])[0].estimate
    assert estimate is not None
    assert estimate.method == "cell_center"
    with pytest.raises(WeightsError, match=r"no weights in .*--method regressor"):
        fine.localize([Query(TEXT, refine="regressor")])


def test_an_index_ranks_by_all_levels_without_an_option(deep_file, rich_dir, mncl, tmp_path) -> None:
    localizer = Localizer.open(IndexJob(deep_file, tmp_path, rich_dir).build(), rich_dir)
    table, gallery = localizer.vector_localizer("none").ranker.table, localizer.gallery
    exact = Ranker.from_cells(mncl, gallery.cells, gallery.labels).table
    texts = mncl.encode_texts([("I am north of a tree.", "A bench is east of me.")])
    rows = np.arange(len(gallery.cells))
    expected = exact.scores(texts, rows)
    assert set(expected) == {"instance", "relation"}
    for level, scores in table.scores(texts, rows).items():
        assert scores == pytest.approx(expected[level], abs=0.02)
    without = Localizer.open(IndexJob(deep_file, tmp_path, rich_dir, levels=False).build(), rich_dir)
    assert without.vector_localizer("none").ranker.table.is_empty
    assert without.localize([Query(TEXT, refine="none")])[0].status != "no_match"


def test_positions_follow_from_the_candidates_alone(localizer, regressor) -> None:
    whole = Localizer(localizer._directory, localizer.manifest, localizer.retriever, lambda _: regressor)
    cut, cut_parts = [], whole.gallery.cells.content
    cells = dataclasses.replace(whole.gallery.cells, content=lambda rows: cut.append(len(rows)) or cut_parts(rows))
    whole.gallery = dataclasses.replace(whole.gallery, cells=cells)
    [refined] = whole.localize([Query(TEXT, 3, refine="regressor")])
    assert 0 < sum(cut) <= 3
    features = CellFeatures.from_cells(localizer.gallery.cells, np.array(localizer.gallery.labels))
    rows = np.array([[cells.ids.index(candidate.cell_id) for candidate in refined.candidates]])
    offset = regressor.predict(whole.sentences([TEXT]), features, rows)[0]
    for k, candidate in enumerate(refined.candidates):
        expected = cells.center_m[rows[0, k], :2] + (offset[k] - 0.5) * cells.size_m
        assert candidate.position == pytest.approx(expected, abs=2e-3)
