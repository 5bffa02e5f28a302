"""Training and validation data: two parts of a map or a data set that share no cell."""

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
    """Cells of one map or data set, for the training of a point encoder."""

    training: CellFeatures
    validation: CellFeatures
    facts: dict[str, Any]  # for the config.json of the weights

    @classmethod
    def from_sources(cls, training: Source, validation: Source) -> "TrainingCells":
        """Return the cells of a training and a validation source."""
        return cls(_features(training.data.gallery), _features(validation.data.gallery), _facts(training, validation))


@dataclass(frozen=True, slots=True, eq=False)
class TrainingData:
    """One map or data set to train on."""

    training: TrainingSet
    gallery: Gallery  # of the validation part, like the queries
    queries: Queries
    facts: dict[str, Any]  # for the config.json of the weights

    @classmethod
    def from_sources(
        cls,
        training: Source,
        validation: Source,
        encoder: TextEncoder,
        config: TrainingConfig,
        rng: np.random.Generator,
    ) -> "TrainingData":
        """Return the data of a training and a validation source; `rng` draws positions in a map."""
        training_set = TrainingSet(
            training.statements(config.spacing_m, rng), encoder, config.wording, config.wrong_hints
        )
        gallery, queries = validation.data.gallery, validation.queries(VALIDATION_SEED)
        return cls(training_set, gallery, queries, _facts(training, validation))

    @property
    def cells(self) -> TrainingCells:
        """The cells alone."""
        return TrainingCells(self.training.features, _features(self.gallery), self.facts)


def load_training_data(
    path: Path, splits: tuple[str, str], encoder: TextEncoder, config: TrainingConfig, rng: np.random.Generator
) -> TrainingData:
    """Load two splits of a map or a data set; see `open_sources` and `TrainingData.from_sources`."""
    training, validation = open_sources(path, splits)
    return TrainingData.from_sources(training, validation, encoder, config, rng)


def load_training_cells(path: Path, splits: tuple[str, str]) -> TrainingCells:
    """Load the cells alone, which need no text encoder; see `load_training_data`."""
    return TrainingCells.from_sources(*open_sources(path, splits))


def _features(gallery: Gallery) -> CellFeatures:
    return CellFeatures.from_cells(gallery.cells, np.array(gallery.labels))


def _facts(training: Source, validation: Source) -> dict[str, Any]:
    """Return the facts of the training source, with the dictionaries of both sources merged."""
    return {
        name: fact | validation.facts[name] if isinstance(fact, dict) else fact for name, fact in training.facts.items()
    }
