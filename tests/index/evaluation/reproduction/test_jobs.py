"""The measurements and pictures of a job of `reproduce`, on an untrained model."""

import pytest
import torch

from index.evaluation.reproduction import jobs as module
from index.evaluation.reproduction.figures import draw_figure_3
from index.evaluation.reproduction.jobs import ALL_LEVELS, GLOBAL_ONLY, RERANKED, Z_SCORES, ReproductionJob
from models.paper.fine.regressor import Regressor, RegressorConfig
from models.paper.mncl import Mncl, MnclConfig
from models.training.experiments import TrainingRun, TrainingScale


@pytest.mark.slow
def test_rankings_are_of_one_model_by_each_way(text_encoder, osm_file) -> None:
    torch.manual_seed(1)
    retriever = Mncl(text_encoder, MnclConfig(width=32, level_weights=(1.0, 0.0, 0.0))).eval()
    rankings = module._rankings(retriever, osm_file)
    assert list(rankings) == [GLOBAL_ONLY, RERANKED, ALL_LEVELS, Z_SCORES]
    assert rankings[GLOBAL_ONLY] == rankings[ALL_LEVELS], "the other levels weigh nothing"
    assert rankings[Z_SCORES] != rankings[ALL_LEVELS]


def test_figure_3_is_drawn(data_and_queries, model, text_encoder, tmp_path) -> None:
    torch.manual_seed(0)
    refiner = Regressor(text_encoder, RegressorConfig(width=32)).eval()
    data, queries = data_and_queries
    draw_figure_3(data, queries, module._localizer(data, model, refiner=refiner), tmp_path / "figure3.png")
    assert (tmp_path / "figure3.png").stat().st_size > 50_000


@pytest.mark.parametrize("method", ["mncl", "matching"])
def test_results_go_with_the_files_of_a_text_encoder(osm_file, tmp_path, method) -> None:
    encoder = tmp_path / "encoder"
    (encoder / "pooling").mkdir(parents=True)

    def key() -> str:
        settings = (f"model.text_encoder={encoder}",)
        return ReproductionJob.build(
            TrainingRun(method), 0, osm_file, tmp_path / "out", TrainingScale(settings, settings, ())
        ).key

    keys = []
    for name, content in (("weights", "a"), ("weights", "other"), ("pooling/config", "b"), ("weights", "a")):
        (encoder / name).write_text(content)
        keys.append(key())
        assert key() == keys[-1]
    assert len(set(keys)) == 4
    (encoder / "pooling" / "config").unlink()
    assert key() == keys[0]
