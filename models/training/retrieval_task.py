"""What the training loop needs to know to train a retriever."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import torch
from torch import Tensor

from models.retrieval.levels import Levels
from models.retrieval.retriever import Retriever
from models.training.engine import distributed
from models.training.retrieval_data import Batch, HintVocabulary
from models.training.training_data import TrainingData
from models.training.validation import Validation, mean_recall


@dataclass(frozen=True, slots=True)
class SourceBatch:
    """A batch of one source.

    Attributes:
        source: which one.
        examples: its examples; of several processes each has its own, of the same source.
    """

    source: int
    examples: Batch


class RetrievalTask:
    """A retriever on some sources, drawn from in turn, by their numbers of positions.

    Args:
        model: any retriever.
        sources: what to train on, and what to validate on.
        batch_size: descriptions a step, of all processes together.
        cluster: of these, how many lie near each other (hard negatives).

    Raises:
        TrainingError: the batch cannot be split over the processes.
    """

    criterion = "recall@5"

    def __init__(self, model: Retriever, sources: Sequence[TrainingData], batch_size: int, cluster: int) -> None:
        self.model: Retriever = model
        self.sources, self.cluster, self.share = sources, cluster, distributed.share_of(batch_size)
        sizes = np.array([len(source.training) for source in sources])
        self._probability = sizes / sizes.sum()

    @cached_property
    def validations(self) -> list[Validation]:
        """Of each source; the first process alone asks for them."""
        return [Validation(source.gallery, source.queries, self.model) for source in self.sources]

    def batch(self, rng: np.random.Generator) -> SourceBatch:
        """See Task; all processes draw from the first one's choice of source."""
        turn = 0
        if len(self.sources) > 1:
            turn = distributed.from_first(lambda: int(rng.choice(len(self.sources), p=self._probability)))
        training = self.sources[turn].training
        return SourceBatch(turn, training.batch(training.draw(self.share, self.cluster, rng), rng))

    def loss(self, batch: SourceBatch) -> Tensor:
        """See Task: the retriever's loss over all pairs of the whole batch, in float32."""
        device = next(self.model.parameters()).device
        training, examples = self.sources[batch.source].training, batch.examples
        training.to(device)
        hints = self._hint_features(training.vocabulary, examples, device)
        text = self.model.describe(hints, examples.hint_mask.to(device))
        # Rows of one source, so a cell's row names it in all processes.
        cell = distributed.gather(examples.cell.to(device))
        # Retrievers put instance features into a tensor of their input's float32, where half precision does not fit.
        with torch.autocast(device.type, enabled=False):
            cells = self.model.look(examples.cells.to(device), training.label_embeddings)
            text, cells = (distributed.gather_levels(_in_float32(levels)) for levels in (text, cells))
            return self.model.loss(text, cells, cell[:, None] == cell[None, :])

    def _hint_features(self, vocabulary: HintVocabulary, batch: Batch, device: torch.device) -> Tensor:
        """[B, H, D]; each different sentence of the whole batch is read once."""
        mask = batch.hint_mask.to(device)
        sentences = batch.sentences.to(device).masked_fill(~mask, -1)
        different, features = distributed.gather_features(
            sentences, lambda asked: self.model.read(vocabulary.tokens(asked))
        )
        hints = features.new_zeros(*sentences.shape, features.shape[-1])
        hints[mask] = features[torch.searchsorted(different, sentences[mask])]
        return hints

    def validate(self) -> dict[str, float]:
        """See Task: recall@1, 3 and 5, the mean over the sources."""
        self.model.text_encoder.to(next(self.model.parameters()).device)
        recalls = [validation.recall(self.model) for validation in self.validations]
        return {f"recall@{k}": recall for k, recall in mean_recall(recalls).items()}


def _in_float32(levels: Levels) -> Levels:
    instance, relation = (x if x is None else x.float() for x in (levels.instance, levels.relation))
    return replace(levels, whole=levels.whole.float(), instance=instance, relation=relation)
