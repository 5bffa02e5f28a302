"""The reader of cues: where each thing that a text names is from the speaker, learned from labelled texts."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, get_args

import torch
from torch import Tensor, nn
from torch.func import functional_call

from models.language.int8 import PackedLayer, may_pack, run_packed, shut_of
from models.language.mentions.cues import Relation
from models.language.mentions.spans import Form
from models.language.text_encoder import TextEncoder, TokenFeatures

ANGLES: Final = (None, 0.0, 22.0, 45.0, 90.0, 135.0, 180.0, -135.0, -90.0, -45.0, -22.0)  # None: not told
RELATIONS: Final[tuple[Relation, ...]] = get_args(Relation)
FORMS: Final[tuple[Form, ...]] = get_args(Form)
FLAGS: Final = ("wind", "meant")
RANK: Final = 11
WIDTH: Final = 80
DROPOUT: Final = 0.1
WIND_FROM, MEANT_FROM = 0.15, 0.3  # probabilities
UNKNOWN_FROM: Final = 0.06  # of being meant, of names that the map has not: few of the labelled texts have such
LEAST: Final = 0.06  # probability of an angle that is thought of
LONGEST: Final = 600  # characters that are read at once
_SENTENCE_END = re.compile(r"[.!?\n]\s")
Place = tuple[int, int, Form]


@dataclass(frozen=True, slots=True)
class ReadCue:
    """What is read of one mention.

    Attributes:
        angle: degrees clockwise from where the speaker looks, the likeliest; None if it is not told.
        angles: all that are likely enough, with their probabilities; none if one is sure.
        relation: the likeliest.
        has_wind: whether a wind may be said of it.
        is_meant: whether it tells where the speaker is: no order of food, and no thing named again.
    """

    angle: float | None
    angles: tuple[tuple[float | None, float], ...]
    relation: Relation
    has_wind: bool
    is_meant: bool


class CueReader(nn.Module):
    """Says of each mention its angle and relation, whether a wind is said of it, and whether it is meant at all.

    Upon the frozen layers of the text encoder and those that the reader of hints tuned, whose weights get a low-rank
    addition (LoRA: Hu et al., ICLR 2022, equation 3); each mention's tokens are marked by what it is, a street say.

    Args:
        text_encoder: frozen.
        tuned: the layers above its first `frozen_layers`; used, not owned.
        frozen_layers: of the text encoder.
    """

    def __init__(self, text_encoder: TextEncoder, tuned: nn.ModuleList, frozen_layers: int) -> None:
        super().__init__()
        self._base = text_encoder, tuned  # a tuple hides them from state_dict
        self._frozen_layers = frozen_layers
        width = text_encoder.width
        matrices = [weight for _, weight in self._matrices()]
        self.down = nn.ParameterList(torch.randn(RANK, w.shape[1]) / w.shape[1] ** 0.5 for w in matrices)
        self.up = nn.ParameterList(torch.zeros(w.shape[0], RANK) for w in matrices)
        self.mark = nn.Embedding(2 * len(FORMS) + 1, width)  # 0 beside mentions; then first and further tokens
        nn.init.normal_(self.mark.weight, std=0.05)
        self.dropout = nn.Dropout(DROPOUT)
        self.head = nn.Sequential(
            nn.Linear(2 * width, WIDTH), nn.GELU(), nn.Dropout(DROPOUT),
            nn.Linear(WIDTH, len(ANGLES) + len(RELATIONS) + len(FLAGS)),
        )  # fmt: skip
        self._packed: list[PackedLayer] | None = None  # with what is added merged

    def forward(self, tokens: TokenFeatures, spans: Sequence[Sequence[tuple[int, int, int]]]) -> tuple[Tensor, ...]:
        """Logits of the mentions of all texts: angle [S, 11], relation [S, R], flags [S, 2].

        Args:
            tokens: of the texts, from the frozen layers.
            spans: of each text its mentions: first token, end, row of FORMS.
        """
        mark = torch.zeros(tokens.mask.shape, dtype=torch.int64)
        for row, some in zip(mark, spans, strict=True):
            for first, end, form in some:
                row[first], row[first + 1 : end] = 1 + 2 * form, 2 + 2 * form
        x = self._run(self.dropout(tokens.values + self.mark(mark.to(tokens.mask.device))), tokens.mask)
        pooled = [torch.cat([x[n, a:b].mean(dim=0), x[n, a]]) for n, some in enumerate(spans) for a, b, _ in some]
        found = self.head(self.dropout(torch.stack(pooled) if pooled else x.new_zeros(0, 2 * x.shape[2])))
        return torch.split(found, [len(ANGLES), len(RELATIONS), len(FLAGS)], dim=1)

    @torch.no_grad()
    def read(self, text: str, places: Sequence[Place]) -> list[ReadCue]:
        """What a text says of its mentions.

        Args:
            text: any.
            places: characters and form of each mention.

        Returns:
            In the order of `places`; of what lies beyond the tokens that are read, that nothing is said.
        """
        found = [ReadCue(None, (), "seen", has_wind=False, is_meant=True)] * len(places)
        pieces = [(a, b, [n for n, place in enumerate(places) if a <= place[0] < b]) for a, b in _pieces(text)]
        pieces = [piece for piece in pieces if piece[2]]
        if not pieces:
            return found
        tokens, characters = self.encode([text[a:b] for a, b, _ in pieces])
        spans, rows = [], []
        for (a, _, some), where in zip(pieces, characters, strict=True):
            at = [(n, token_span(where, places[n][0] - a, places[n][1] - a)) for n in some]
            spans.append([(*span, FORMS.index(places[n][2])) for n, span in at if span is not None])
            rows += [n for n, span in at if span is not None]
        angle, relation, flags = self(tokens, spans)
        likely = angle.softmax(dim=1).tolist(), relation.argmax(dim=1).tolist(), flags.sigmoid().tolist()
        for n, angles, r, (wind, meant) in zip(rows, *likely, strict=True):
            best = ANGLES[max(range(len(ANGLES)), key=angles.__getitem__)]
            is_meant = meant > (UNKNOWN_FROM if places[n][2] == "unknown" else MEANT_FROM)
            found[n] = ReadCue(best, _likely(angles), RELATIONS[r], wind > WIND_FROM, is_meant)
        return found

    def encode(self, texts: Sequence[str]) -> tuple[TokenFeatures, Tensor]:
        """Token features of texts, from the frozen layers, and the characters [S, T, 2] of each token."""
        return self._base[0].read(texts, self._frozen_layers)

    def train(self, mode: bool = True) -> "CueReader":
        """As torch does; what was merged of the weights is forgotten."""
        self._packed = None
        return super().train(mode)

    def _matrices(self) -> list[tuple[int, Tensor]]:
        """The weight matrices of the layers, and which layer each is of."""
        return [(n, p) for n, layer in enumerate(self._base[1]) for p in layer.parameters() if p.dim() == 2]

    def _weights(self) -> list[dict[str, Tensor]]:
        """All parameters of each layer, with what is added to them."""
        added = (up @ down for up, down in zip(self.up, self.down, strict=True))
        return [
            {name: p.detach() + next(added) if p.dim() == 2 else p.detach() for name, p in layer.named_parameters()}
            for layer in self._base[1]
        ]

    def _run(self, x: Tensor, mask: Tensor) -> Tensor:
        layers = self._base[1]
        if self.training or not may_pack(layers, x):
            for layer, weights in zip(layers, self._weights(), strict=True):
                x = functional_call(layer, weights, (x, shut_of(mask, x)))
            return x
        if self._packed is None:
            self._packed = [PackedLayer(*each) for each in zip(layers, self._weights(), strict=True)]
        return run_packed(self._packed, x, mask)


def _likely(angles: Sequence[float]) -> tuple[tuple[float | None, float], ...]:
    """Angles that are likely enough, with probabilities that add up to 1; none if there is one alone."""
    some = [(angle, p) for angle, p in zip(ANGLES, angles, strict=True) if p >= LEAST]
    total = sum(p for _, p in some)
    return tuple((angle, p / total) for angle, p in some) if len(some) > 1 else ()


def token_span(characters: Tensor, start: int, end: int) -> tuple[int, int] | None:
    """The tokens (first, end) that stand for some characters; None if none does."""
    inside = (characters[:, 0] < end) & (characters[:, 1] > start) & (characters[:, 1] > characters[:, 0])
    rows = torch.nonzero(inside).flatten()
    return (int(rows[0]), int(rows[-1]) + 1) if len(rows) else None


def _pieces(text: str) -> list[tuple[int, int]]:
    """The text in pieces of at most LONGEST characters, cut between sentences where that is possible."""
    pieces, start = [], 0
    while len(text) - start > LONGEST:
        ends = [found.end() for found in _SENTENCE_END.finditer(text, start, start + LONGEST)]
        end = ends[-1] if ends else start + LONGEST
        pieces.append((start, end))
        start = end
    return [*pieces, (start, len(text))]
