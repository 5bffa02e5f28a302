import math

import pytest
import torch

from models.posterior.places.kernels import TYPES, PlaceKernels

METRES = torch.arange(0.0, 400.0, 1.0)


@pytest.fixture
def kernels() -> PlaceKernels:
    return PlaceKernels()


@pytest.mark.parametrize("kind", [kind for kind in TYPES if kind != "across"])
def test_kernels_fall_from_one(kernels, kind) -> None:
    with torch.no_grad():
        fits = kernels.near(TYPES.index(kind), METRES)
    assert fits[0] == pytest.approx(1, abs=1e-3)
    assert fits.max() <= 1
    assert (fits.diff() <= 1e-7).all()
    assert (fits > 0).all()
    assert fits[-1] < 0.1


def test_across_is_a_street_away(kernels) -> None:
    with torch.no_grad():
        fits = kernels.near(TYPES.index("across"), METRES)
        street = float(kernels.across_m.exp())
    assert fits.max() <= 1
    assert abs(float(METRES[fits.argmax()]) - street) <= 4
    assert fits[round(street)] > 1.5 * fits[0]
    assert (fits[round(street) :].diff() <= 1e-7).all()


@pytest.mark.parametrize("stated_m", [3.0, 50.0, 220.0])
def test_a_distance_that_was_said_is_likeliest(kernels, stated_m) -> None:
    with torch.no_grad():
        exact, loose = (kernels.stated_distance(METRES, stated_m, is_loose=is_loose) for is_loose in (False, True))
    for fits in (exact, loose):
        assert float(METRES[fits.argmax()]) == stated_m
        assert fits.max() == pytest.approx(1)
    assert (loose >= exact).all(), "blocks are less exact than metres"


@pytest.mark.parametrize("metres", [0.0, 1.0, 10.0, 200.0])
@pytest.mark.parametrize("concentration", [-2.0, 0.7, 3.0])
def test_directions_have_mean_one(kernels, metres, concentration) -> None:
    away = torch.arange(720) * (2 * math.pi / 720)
    with torch.no_grad():
        density = kernels.toward(torch.tensor(concentration), away.cos(), torch.tensor(metres))
    assert density.mean() == pytest.approx(1, abs=1e-4)
    assert density.argmax() == 0
    assert density.min() > 0


def test_what_is_near_may_be_in_any_direction(kernels) -> None:
    with torch.no_grad():
        density = kernels.toward(kernels.ego, torch.tensor([1.0, -1.0]), torch.tensor([0.0, 0.0]))
        far = kernels.toward(kernels.ego, torch.tensor([1.0, -1.0]), torch.tensor([50.0, 50.0]))
    assert density == pytest.approx(torch.ones(2))
    assert far[0] > 5 * far[1]


def test_a_side_tells_sides_apart(kernels) -> None:
    with torch.no_grad():
        fits = kernels.on_side(torch.tensor([-30.0, -2.0, 0.0, 2.0, 30.0]))
    assert (fits.diff() > 0).all()
    assert fits[2] == pytest.approx(1)
    assert fits[0] > 0
    assert fits[-1] > 10 * fits[0]


def test_about_fifty_numbers_all_of_which_learn(kernels) -> None:
    assert 50 <= sum(p.numel() for p in kernels.parameters()) <= 80
