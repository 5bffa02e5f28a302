"""What a noun means in a map: any words compared with any labels, through the many names that things go by."""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import torch
from torch import Tensor, nn

from models.language.grammar.files import GRAMMARS
from models.language.grammar.wording import Wording
from models.language.spelling import Spelling
from models.language.text_encoder import OnTextEncoder, TextEncoder

MOST_KEPT = 20_000  # phrases; 30 MB


@cache
def related_labels() -> tuple[tuple[str, ...], ...]:
    """Groups of classes that go by one another's names, see grammar/related.toml."""
    groups = tomllib.loads((GRAMMARS / "related.toml").read_text())["groups"]
    return tuple(tuple(group) for group in groups)


def meaning_in(label: str, map_labels: Sequence[str]) -> str | None:
    """The label of a map that a class goes by there: itself, or the closest relative; None if the map has neither."""
    if label in map_labels:
        return label
    groups = sorted((g for g in related_labels() if label in g), key=lambda group: group.index(label))
    return next((other for group in groups for other in group if other in map_labels), None)


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

    def __init__(self, text_encoder: TextEncoder) -> None:
        super().__init__(text_encoder)
        self.scale = nn.Parameter(torch.tensor(20.0).log())
        self.unknown = nn.Parameter(torch.tensor(0.4))  # similarity that a noun must exceed to mean anything
        self._known: dict[str, Tensor] = {}
        lexicon = Wording("train").labels
        names = [name.lower() for label, others in lexicon.items() for name in (label, *others)]
        self._spelling = Spelling(names, text_encoder.pieces, lambda part: len(text_encoder.pieces(part)) == 1)

    def embed(self, phrases: Sequence[str]) -> Tensor:
        """[S, W] unit vectors of the frozen text encoder, misspelt words mended; those seen before are kept."""
        plain = [self._spelling.mend(phrase.lower().replace("-", " ")) for phrase in phrases]
        if missing := [phrase for phrase in dict.fromkeys(plain) if phrase not in self._known]:
            if len(self._known) > MOST_KEPT:
                self._known.clear()
                missing = list(dict.fromkeys(plain))
            self._known.update(zip(missing, self.text_encoder.embed(missing), strict=True))
        return torch.stack([self._known[phrase] for phrase in plain])

    def bind(self, map_labels: Sequence[str]) -> BoundLabels:
        """Prepare for a map.

        Args:
            map_labels: its labels, each once.
        """
        phrases, label = bound_names(tuple(map_labels))
        return BoundLabels(self.embed(phrases), torch.tensor(label), len(map_labels))

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


@cache
def bound_names(map_labels: tuple[str, ...]) -> tuple[list[str], list[int]]:
    """Every known name, and the number of the map's label that it leads to; the number of labels if to none.

    What names a label of the map does not stand for its relatives too: trees are no bushes where there are trees.
    """
    lexicon = Wording("train").labels
    own = {name for label in map_labels for name in (label, *lexicon.get(label, ()))}
    phrases, numbers = [], []
    for label in dict.fromkeys([*map_labels, *lexicon]):
        meant = meaning_in(label, map_labels)
        number = len(map_labels) if meant is None else map_labels.index(meant)
        for phrase in (label, *lexicon.get(label, ())):
            if label in map_labels or not own & {phrase, phrase.removesuffix("s")}:
                phrases.append(phrase)
                numbers.append(number)
    return phrases, numbers
