"""Index, evaluation and training look at the same cells and positions."""

import numpy as np
import pytest

from app.jobs.evaluation import Evaluation
from index.answering.localizer import Localizer
from index.build.build import IndexJob
from index.evaluation.predictions import PREDICTIONS_FILE, Predictions
from models.sources.source import VALIDATION_SEED, open_source
from models.training.settings import TrainingConfig
from models.training.training_data import load_training_data


@pytest.mark.slow
def test_all_three_come_through_one_door(osm_file, weights_dir, text_encoder, tmp_path) -> None:
    source = open_source(osm_file, "val")
    cells = source.data.cells
    IndexJob(osm_file, tmp_path / "index", weights_dir, "val").build()
    indexed = Localizer.open(tmp_path / "index", weights_dir)
    Evaluation(weights_dir=weights_dir, data=osm_file, split="val").run(tmp_path / "report", lambda *_: None)
    measured = Predictions.load(tmp_path / "report" / PREDICTIONS_FILE)
    config, rng = TrainingConfig(spacing_m=30.0), np.random.default_rng(0)
    trained = load_training_data(osm_file, ("train", "val"), text_encoder, config, rng)

    assert indexed.gallery.cells.ids == trained.gallery.cells.ids == cells.ids == tuple(measured.cell_ids.tolist())
    assert indexed.gallery.labels == trained.gallery.labels
    assert (indexed.gallery.cells.center_m == trained.gallery.cells.center_m).all()
    queries, chosen_by = source.queries(), source.queries(VALIDATION_SEED)
    assert (measured.positions_m == queries.positions_m).all()
    assert (measured.queried_cells == queries.truth).all()
    assert (trained.queries.positions_m == chosen_by.positions_m).all()
    assert trained.queries.sentences == chosen_by.sentences
    training_statements = trained.training.statements
    assert not set(training_statements.gallery.cells.ids) & set(cells.ids), "what is trained on is elsewhere"
