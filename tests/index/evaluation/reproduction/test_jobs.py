"""The measurements and pictures of a job of `reproduce`, on an untrained model."""

import pytest
import torch

from index.evaluation.reproduction import jobs as module
from index.evaluation.reproduction.jobs import (
    ALL_LEVELS,
    GLOBAL_ONLY,
    RERANKED,
    Z_SCORES,
    ReproductionJob,
    scene_of_figure_5,
)
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


def test_figure_5_is_of_the_papers_scene_if_there_is_one() -> None:
    assert scene_of_figure_5(["0003", "2013_05_28_drive_0009_sync", "0005", "0003"]) == "2013_05_28_drive_0009_sync"
    assert scene_of_figure_5(["town-b", "town-a"]) == "town-a"


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
