import numpy as np
import pytest
import torch

from models.paper.fine.checkpoint import FINE_METHODS
from models.paper.instance_encoder import CellFeatures
from models.training.fine_data import FineSet
from models.training.retrieval_data import TrainingSet


@pytest.fixture(scope="session")
def fine_set(source, text_encoder):
    return FineSet(TrainingSet(source.statements(30.0, np.random.default_rng(0)), text_encoder))


@pytest.fixture(scope="session")
def features(city, cells):
    return CellFeatures.from_cells(cells, np.array([i.label for i in city.instances]))


@pytest.fixture(scope="session", params=sorted(FINE_METHODS))
def fine_model(request, text_encoder):
    """Untrained, of each method."""
    torch.manual_seed(0)
    method = FINE_METHODS[request.param]
    return method(text_encoder, method.config_type(width=32, max_instances=6)).eval()
