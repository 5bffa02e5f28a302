import numpy as np
import pytest
import torch

from models.citymap.frame import Frame
from models.errors import TrainingError
from models.posterior.model import load_posterior
from models.posterior.places.kernels import PlaceKernels
from models.sources.place_texts import PlaceText
from models.training.posterior import fit_kernels as fit_kernels_module
from models.training.posterior.fit_kernels import KernelExample, MapTexts, calibrate_kernels, fit_kernels, read_examples
from tests.models.citymap.gazetteer.made_town import is_common, made_gazetteer

FRAME = Frame("map", 40.75, -74.0)
GRID_M = 15.0
CENTERS = np.stack(np.meshgrid(np.arange(-45, 446, GRID_M), np.arange(-45, 206, GRID_M)), axis=-1).reshape(-1, 2)
TEXTS: dict[str, tuple[float, float]] = {
    "I'm at 25th and 10th": (202, 84),
    "on 26th street, Elmo is across the street": (121, 170),
    "right next to Bottino": (213, 96),
    "the Whole Foods is on my left and a bench on my right": (297, 93),
    "Meet me at the cafe, north of you": (386, 90),
    "hello there": (0, 0),  # names nothing
}


class Everyday:
    """In place of a text encoder."""

    def is_everyday(self, word: str) -> bool:
        return is_common(word)


def map_texts(texts: dict[str, tuple[float, float]]) -> MapTexts:
    def degrees(position_m: tuple[float, float]) -> tuple[float, float]:
        lat, lon = FRAME.to_wgs84(np.array(position_m, dtype=float))
        return float(lat), float(lon)

    start = degrees((380, 0))
    rows = [
        PlaceText(text, degrees(position_m), start if "you" in text else None) for text, position_m in texts.items()
    ]
    return MapTexts(made_gazetteer(), FRAME, CENTERS, GRID_M, rows)


def cases_of(kernels: PlaceKernels, texts: dict[str, tuple[float, float]] = TEXTS) -> list[KernelExample]:
    return read_examples(
        kernels, map_texts(texts), Everyday(), lambda _: load_posterior().cues, np.random.default_rng(0)
    )


def fitted(steps: int, **changed: float) -> tuple[PlaceKernels, list[tuple[int, int, float]]]:
    kernels, done = PlaceKernels(), []
    with torch.no_grad():
        for name, value in changed.items():
            getattr(kernels, name).add_(value)
    cases = cases_of(kernels)
    fit_kernels(kernels, cases, steps, np.random.default_rng(0), lambda *row: done.append(row))
    return kernels, done


@pytest.fixture(autouse=True)
def _small(monkeypatch):
    """Few cells, so that a step takes hundredths of a second; means of the last step alone."""
    for name, value in {
        "HARD_CELLS": 60,
        "RANDOM_CELLS": 20,
        "SAMPLED_CELLS": 300,
        "TEXTS_PER_BATCH": 1,
        "PULL_WEIGHT": 0.0,
    }.items():
        monkeypatch.setattr(fit_kernels_module, name, value)


def test_fitting_lowers_the_surprise(monkeypatch) -> None:
    monkeypatch.setattr(fit_kernels_module, "TEXTS_PER_BATCH", 5)
    _, done = fitted(30, scale=1.5)  # far too wide
    assert [step for step, _, _ in done] == list(range(1, 31))
    first, last = done[0][2], done[-1][2]
    assert np.isfinite([first, last]).all()
    assert last < first - 0.3


def test_fitting_is_seeded_and_changes_the_weights() -> None:
    (one, _), (same, _) = fitted(3), fitted(3)
    assert all(torch.equal(a, b) for a, b in zip(one.parameters(), same.parameters(), strict=True))
    began = PlaceKernels()
    assert any(not torch.equal(a, b) for a, b in zip(one.parameters(), began.parameters(), strict=True))
    assert all(p.isfinite().all() for p in one.parameters())


def test_a_strong_pull_keeps_the_weights(monkeypatch) -> None:
    def moved(kernels: PlaceKernels) -> float:
        pairs = zip(kernels.parameters(), PlaceKernels().parameters(), strict=True)
        return sum(float(((a - b) ** 2).sum().detach()) for a, b in pairs)

    free = moved(fitted(12)[0])
    monkeypatch.setattr(fit_kernels_module, "PULL_WEIGHT", 100.0)
    assert moved(fitted(12)[0]) < free / 2


def test_texts_that_name_nothing_are_left_out() -> None:
    kernels = PlaceKernels()
    assert len(cases_of(kernels)) == len(TEXTS) - 1
    assert cases_of(kernels, {"hello there": (0, 0)}) == []


def test_nothing_to_fit_to_is_refused() -> None:
    with pytest.raises(TrainingError):
        fit_kernels(PlaceKernels(), [], 2, np.random.default_rng(0))


def test_calibrating_makes_what_is_too_sure_less_sure() -> None:
    wrong = {text: ((x + 130.0) % 400.0, y) for text, (x, y) in TEXTS.items()}
    temper = {}
    for name, texts in (("right", TEXTS), ("wrong", wrong)):
        kernels = PlaceKernels()
        before = kernels.scale.detach().clone()
        scale = calibrate_kernels(kernels, cases_of(kernels, texts), 2, np.random.default_rng(0))
        assert torch.equal(kernels.scale, before), "it is as it was given"
        temper[name] = scale
    assert temper["wrong"] < temper["right"]
