import numpy as np
import pytest
import torch

from models.city.hints import sample_positions
from models.localization.checkpoint import FINE_METHODS
from models.retrieval.instance_encoder import CellFeatures
from models.training.fine_data import FineSet
from models.training.retrieval_data import TrainingPlace, TrainingSet


@pytest.fixture(scope="session")
def fine_set(city, points, cells, text_encoder):
    positions = sample_positions(city.locations_m, 30.0, np.random.default_rng(0))
    return FineSet(TrainingSet(TrainingPlace.of_map(city, points, cells, positions), text_encoder))


@pytest.fixture(scope="session")
def features(city, cells):
    return CellFeatures.of(cells, np.array([i.label for i in city.instances]))


@pytest.fixture(scope="session", params=sorted(FINE_METHODS))
def fine_model(request, text_encoder):
    """Untrained, of each method."""
    torch.manual_seed(0)
    method = FINE_METHODS[request.param]
    return method(text_encoder, method.config_type(width=32, max_instances=6)).eval()
