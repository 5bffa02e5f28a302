"""Match nouns with the labels of a map, through the many names of each label."""

import hashlib
import logging
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import torch
from torch import Tensor, nn

from models.language.lexicon.lexicon import load_lexicon
from models.language.recent_features import RecentFeatures
from models.language.spelling import Spelling
from models.language.text_encoder import TextEncoder, TextEncoderModel

MAX_CACHED_PHRASES = 4096  # 6 MB, the names of labels included
NAMES_PER_BATCH = 64  # of similar length, so that there is little padding

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True, eq=False)
class BoundLabels:
    """The labels of a map and all their names."""

    names: Tensor  # [N, W] unit vectors of names
    label: Tensor  # [N] the label that each name means; the number of labels for names of things that the map lacks
    count: int


class LabelMatcher(TextEncoderModel):
    """Similarity of a noun with every name of every label, in the frozen text encoder's space.

    A label's score is the soft maximum over its names. Names of things that the map lacks compete, so that a bench does
    not become a building in a map without benches.
    """

    names: Tensor
    names_of: Tensor

    def __init__(self, text_encoder: TextEncoder) -> None:
        super().__init__(text_encoder)
        self.scale = nn.Parameter(torch.tensor(20.0).log())
        self.unknown = nn.Parameter(torch.tensor(0.4))  # similarity below which a noun means no label
        self.lexicon = load_lexicon()
        names = [name.lower() for name in self.lexicon.names]
        self._spelling = Spelling(names, text_encoder.pieces, lambda part: len(text_encoder.pieces(part)) == 1)
        self._names = sorted({self._plain(name) for name in names}, key=lambda name: (len(name), name))
        # [N, W] vectors of these names, stored with the weights; empty until they are loaded or first needed.
        self.register_buffer("names", torch.empty(0, text_encoder.width))
        digest = hashlib.sha256("\n".join(self._names).encode()).digest()
        self.register_buffer("names_of", torch.tensor(list(digest), dtype=torch.uint8))  # of the names
        self._features = RecentFeatures(text_encoder.embed, MAX_CACHED_PHRASES)
        nn.Module.register_load_state_dict_pre_hook(self, LabelMatcher._prepare_names)

    def embed(self, phrases: Sequence[str]) -> Tensor:
        """Return unit vectors [S, W] of phrases with misspelt words corrected; recent ones are cached."""
        plain = [self._plain(phrase) for phrase in phrases]
        if not len(self._features) and len(self.names):
            self._features.remember(self._names, self.names)
        known = self._features(plain)
        return torch.stack([known[phrase] for phrase in plain])

    def bind(self, map_labels: Sequence[str]) -> BoundLabels:
        """Return the labels of a map, without repetition, with their names."""
        if not len(self.names):
            starts = range(0, len(self._names), NAMES_PER_BATCH)
            self.names = torch.cat([self.text_encoder.embed(self._names[n : n + NAMES_PER_BATCH]) for n in starts])
            self._features.clear()
        phrases, label = self.lexicon.map_names_to_labels(tuple(map_labels))
        return BoundLabels(self.embed(phrases), torch.tensor(label), len(map_labels))

    def _plain(self, phrase: str) -> str:
        return self._spelling.correct(phrase.lower().replace("-", " "))

    def _prepare_names(self, state: dict[str, Any], prefix: str, *_: Any) -> None:
        """Resize `names` for the vectors to load; drop stored vectors of other names."""
        key, digest_key = f"{prefix}names", f"{prefix}names_of"
        if key not in state or digest_key not in state:
            return  # load_state_dict reports missing weights itself
        if not torch.equal(state[digest_key], self.names_of):
            _log.warning("the lexicon has changed since training, so every start embeds its names; retrain the model")
            state[key], state[digest_key] = self.names[:0], self.names_of
        self.names = torch.empty_like(state[key])
        self._features.clear()

    def forward(self, nouns: Tensor, bound: BoundLabels) -> Tensor:
        """Return log-probabilities [S, L + 1] of each label, and of none, for nouns [S, W] from `embed`."""
        logits = self.scale.exp() * (nouns @ bound.names.T)
        highest = logits.amax(dim=1, keepdim=True)
        mass = torch.zeros(len(nouns), bound.count + 1).index_add(1, bound.label, (logits - highest).exp())
        scores = mass.clamp(min=1e-30).log() + highest
        none = torch.logaddexp(scores[:, -1], (self.scale.exp() * self.unknown).expand(len(nouns)))
        return torch.cat([scores[:, :-1], none[:, None]], dim=1).log_softmax(dim=1)
