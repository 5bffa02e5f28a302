"""What a noun means in a map: any words compared with any labels, through the many names that things go by."""

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
from models.language.text_encoder import OnTextEncoder, TextEncoder

MOST_KEPT = 4096  # phrases, the names of labels among them; 6 MB
READ_AT_ONCE = 64  # names, of like length, so that little is padding

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True, eq=False)
class BoundLabels:
    """A map's labels with all names that lead to them.

    Attributes:
        names: [N, W] unit vectors of names.
        label: [N] the map's label that each leads to; the number of labels for names of what the map has not.
        count: number of labels.
    """

    names: Tensor
    label: Tensor
    count: int


class LabelMatcher(OnTextEncoder):
    """Similarity of a noun with every name of every label, in the frozen text encoder's space.

    A label's score is the soft maximum over its names; names of things that the map has not compete, so that a bench is
    no building where there are no benches.
    """

    names: Tensor
    names_of: Tensor

    def __init__(self, text_encoder: TextEncoder) -> None:
        super().__init__(text_encoder)
        self.scale = nn.Parameter(torch.tensor(20.0).log())
        self.unknown = nn.Parameter(torch.tensor(0.4))  # similarity that a noun must exceed to mean anything
        self.lexicon = load_lexicon()
        names = [name.lower() for name in self.lexicon.names]
        self._spelling = Spelling(names, text_encoder.pieces, lambda part: len(text_encoder.pieces(part)) == 1)
        self._names = sorted({self._plain(name) for name in names}, key=lambda name: (len(name), name))
        # [N, W] vectors of these, stored with the weights; empty until they are loaded or a map asks for them.
        self.register_buffer("names", torch.empty(0, text_encoder.width))
        digest = hashlib.sha256("\n".join(self._names).encode()).digest()
        self.register_buffer("names_of", torch.tensor(list(digest), dtype=torch.uint8))  # tells whether stored ones fit
        self._known = RecentFeatures(text_encoder.embed, MOST_KEPT)
        nn.Module.register_load_state_dict_pre_hook(self, LabelMatcher._take_names)

    def embed(self, phrases: Sequence[str]) -> Tensor:
        """[S, W] unit vectors of the frozen text encoder, misspelt words mended; those seen before are kept."""
        plain = [self._plain(phrase) for phrase in phrases]
        if not len(self._known) and len(self.names):
            self._known.remember(self._names, self.names)
        known = self._known(plain)
        return torch.stack([known[phrase] for phrase in plain])

    def bind(self, map_labels: Sequence[str]) -> BoundLabels:
        """Prepare for a map.

        Args:
            map_labels: its labels, each once.
        """
        if not len(self.names):
            starts = range(0, len(self._names), READ_AT_ONCE)
            self.names = torch.cat([self.text_encoder.embed(self._names[n : n + READ_AT_ONCE]) for n in starts])
            self._known.clear()
        phrases, label = self.lexicon.names_in(tuple(map_labels))
        return BoundLabels(self.embed(phrases), torch.tensor(label), len(map_labels))

    def _plain(self, phrase: str) -> str:
        return self._spelling.mend(phrase.lower().replace("-", " "))

    def _take_names(self, state: dict[str, Any], prefix: str, *_: Any) -> None:
        """Make room for stored vectors before they are loaded; those of other names are left out."""
        key, of = f"{prefix}names", f"{prefix}names_of"
        if key not in state or of not in state:
            return  # what is missing is then said of all weights
        if not torch.equal(state[of], self.names_of):
            _log.warning("the names of the lexicon have changed and are embedded anew at every start; train again")
            state[key], state[of] = self.names[:0], self.names_of
        self.names = torch.empty_like(state[key])
        self._known.clear()

    def forward(self, nouns: Tensor, bound: BoundLabels) -> Tensor:
        """[S, L + 1] log-probability of each label for nouns [S, W]; the last, of none of them.

        Args:
            nouns: of `embed`.
            bound: the map's labels.
        """
        logits = self.scale.exp() * (nouns @ bound.names.T)
        highest = logits.amax(dim=1, keepdim=True)
        mass = torch.zeros(len(nouns), bound.count + 1).index_add(1, bound.label, (logits - highest).exp())
        scores = mass.clamp(min=1e-30).log() + highest
        none = torch.logaddexp(scores[:, -1], (self.scale.exp() * self.unknown).expand(len(nouns)))
        return torch.cat([scores[:, :-1], none[:, None]], dim=1).log_softmax(dim=1)
