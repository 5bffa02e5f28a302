import math

import numpy as np
import pytest
import torch

from models.citymap.gazetteer.closest_points import ClosestPoints
from models.language.measures import Measure
from models.language.mentions.cues import Cue
from models.language.mentions.mentions import Mention
from models.posterior.places.field import PlaceField
from models.posterior.places.kernels import PlaceKernels
from models.posterior.places.way_kernels import WayKernels, _scaled_bessel
from tests.models.posterior.places.test_field import CENTERS, GRID_M, TOWN

POINTS = 50
CUES = (
    Cue(), Cue("across"), Cue("wind", wind=110.0), Cue(angle=90.0), Cue(measure=Measure(0, 4, 40.0)),
    Cue(measure=Measure(0, 4, 2.0, is_loose=True), angle=180.0),
    Cue(angle=-45.0, angles=((-45.0, 0.7), (None, 0.1), (135.0, 0.2))),
    Cue(angle=None, angles=((None, 0.6), (22.0, 0.4))),
)  # fmt: skip


@pytest.fixture(scope="module")
def kernels() -> PlaceKernels:
    torch.manual_seed(0)
    fitted = PlaceKernels()
    with torch.no_grad():
        for weight in fitted.parameters():
            weight.add_(torch.randn_like(weight) * 0.2)
    return fitted


def ways(rng, items: int) -> ClosestPoints:
    """Ways from most points to some things, the first without any length."""
    point = np.sort(rng.integers(1, POINTS, 400))
    way_m = rng.normal(0, 40, (400, 2))
    way_m[0] = 0
    return ClosestPoints(point, rng.integers(0, items, 400), way_m)


@pytest.mark.parametrize("cue", CUES)
@pytest.mark.parametrize("side", [None, 270.0])
@pytest.mark.parametrize("form", ["thing", "street"])
def test_they_are_what_torch_makes_of_them(kernels, cue, side, form) -> None:
    rng = np.random.default_rng(1)
    mention = Mention("x", 0, 1, form, np.arange(3), np.array([1.0, 0.5, 0.2]), cue=cue, side=side)
    some, field = ways(rng, 3), PlaceField(kernels, TOWN, CENTERS, GRID_M)
    with torch.no_grad():
        expected = field.fits(mention, some, POINTS).numpy()
    found = WayKernels(kernels).fits(mention, some, some.point, POINTS)
    assert found.shape == expected.shape
    assert found.dtype == np.float32
    assert np.allclose(found, expected, rtol=2e-5, atol=1e-7)


def test_the_scaled_bessel_function() -> None:
    x = torch.linspace(0, 40, 500, dtype=torch.float64)
    found = [_scaled_bessel(value) for value in x.tolist()]
    assert np.allclose(found, torch.special.i0e(x).numpy(), rtol=1e-6)
    assert math.isfinite(_scaled_bessel(1e6))
