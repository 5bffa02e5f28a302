"""What a model is trained on and chosen by: two parts of a map or a data set that share no cell."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from models.city.gallery import Gallery
from models.city.queries import Queries
from models.city.source import CHOSEN_BY, Source, open_sources
from models.language.text_encoder import TextEncoder
from models.training.retrieval_data import TrainingSet
from models.training.settings import TrainingConfig


@dataclass(frozen=True, slots=True, eq=False)
class TrainingData:
    """One map or data set to train on.

    Attributes:
        training: the one part.
        gallery, queries: cells of the other, and what they are asked; for choosing.
        facts: what it is, for the record beside the weights.
    """

    training: TrainingSet
    gallery: Gallery
    queries: Queries
    facts: dict[str, Any]

    @classmethod
    def of(
        cls, taught: Source, asked: Source, encoder: TextEncoder, config: TrainingConfig, rng: np.random.Generator
    ) -> "TrainingData":
        """Of two sources.

        Args:
            taught: what is trained on.
            asked: what is chosen by.
            encoder: the frozen text encoder.
            config: says how densely a map is described, and in which words.
            rng: draws positions in a map.
        """
        training = TrainingSet(taught.statements(config.spacing_m, rng), encoder, config.wording)
        facts = {
            name: fact | asked.facts[name] if isinstance(fact, dict) else fact for name, fact in taught.facts.items()
        }
        return cls(training, asked.data.gallery, asked.queries(CHOSEN_BY), facts)


def load_training(
    path: Path, splits: tuple[str, str], encoder: TextEncoder, config: TrainingConfig, rng: np.random.Generator
) -> TrainingData:
    """Open a map or a data set and take two splits of it; the rest as `open_sources` and `TrainingData.of`."""
    taught, asked = open_sources(path, splits)
    return TrainingData.of(taught, asked, encoder, config, rng)
