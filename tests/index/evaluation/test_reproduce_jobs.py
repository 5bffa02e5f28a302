"""What a job of `reproduce` measures and draws, on an untrained model."""

import pytest
import torch

from index.evaluation import reproduce_jobs as module
from index.evaluation.figure_3 import draw_figure_3
from index.evaluation.reproduce_jobs import ALL, ALONE, LISTED, Z_SCORES
from models.localization.regressor import Regressor, RegressorConfig
from models.retrieval.mncl import Mncl, MnclConfig


@pytest.mark.slow
def test_rankings_are_of_one_model_by_each_way(text_encoder, osm_file) -> None:
    torch.manual_seed(0)
    retriever = Mncl(text_encoder, MnclConfig(width=32, level_weights=(1.0, 0.0, 0.0))).eval()
    found = module._rankings(retriever, osm_file)
    assert list(found) == [ALONE, LISTED, ALL, Z_SCORES]
    assert found[ALONE] == found[ALL], "the other levels weigh nothing"
    assert found[Z_SCORES] != found[ALL]


def test_figure_3_is_drawn(asked, model, text_encoder, tmp_path) -> None:
    torch.manual_seed(0)
    refiner = Regressor(text_encoder, RegressorConfig(width=32)).eval()
    data, queries = asked
    draw_figure_3(data, queries, module._localizer(data, model, refiner=refiner), tmp_path / "figure3.png")
    assert (tmp_path / "figure3.png").stat().st_size > 50_000
