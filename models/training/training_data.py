"""What is trained on and what is chosen by: two parts of a map or a data set that share no cell."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from models.citymap.gallery import Gallery
from models.citymap.queries import Queries
from models.language.text_encoder import TextEncoder
from models.paper.instance_encoder import CellFeatures
from models.sources.source import VALIDATION_SEED, Source, open_sources
from models.training.retrieval_data import TrainingSet
from models.training.settings import TrainingConfig


@dataclass(frozen=True, slots=True, eq=False)
class TrainingCells:
    """Cells of one map or data set, all that a point encoder is trained on.

    Attributes:
        training: of the one part.
        validation: of the other; for choosing.
        facts: what it is, for the record beside the weights.
    """

    training: CellFeatures
    validation: CellFeatures
    facts: dict[str, Any]

    @classmethod
    def of(cls, taught: Source, asked: Source) -> "TrainingCells":
        """Of two sources, see `TrainingData.of`."""
        return cls(_features(taught.data.gallery), _features(asked.data.gallery), _facts(taught, asked))


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
        return cls(training, asked.data.gallery, asked.queries(VALIDATION_SEED), _facts(taught, asked))

    @property
    def cells(self) -> TrainingCells:
        """Its cells alone."""
        return TrainingCells(self.training.features, _features(self.gallery), self.facts)


def load_training(
    path: Path, splits: tuple[str, str], encoder: TextEncoder, config: TrainingConfig, rng: np.random.Generator
) -> TrainingData:
    """Open a map or a data set and take two splits of it; the rest as `open_sources` and `TrainingData.of`."""
    taught, asked = open_sources(path, splits)
    return TrainingData.of(taught, asked, encoder, config, rng)


def load_cells(path: Path, splits: tuple[str, str]) -> TrainingCells:
    """The cells of what `load_training` opens; nothing is said about them, so no text encoder is needed."""
    return TrainingCells.of(*open_sources(path, splits))


def _features(gallery: Gallery) -> CellFeatures:
    return CellFeatures.from_cells(gallery.cells, np.array(gallery.labels))


def _facts(taught: Source, asked: Source) -> dict[str, Any]:
    """Of both."""
    return {name: fact | asked.facts[name] if isinstance(fact, dict) else fact for name, fact in taught.facts.items()}
