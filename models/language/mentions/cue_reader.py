"""The cue reader: predicts where each mention of a text is from the speaker."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, get_args

import torch
from torch import Tensor, nn
from torch.func import functional_call

from models.language.int8 import Int8Layer, attention_bias, can_quantize, run_int8_layers
from models.language.mentions.cues import Form, Relation
from models.language.text_encoder import TextEncoder, TokenFeatures

# Degrees; None without a direction.
ANGLES: Final = (None, 0.0, 22.0, 45.0, 90.0, 135.0, 180.0, -135.0, -90.0, -45.0, -22.0)
RELATIONS: Final[tuple[Relation, ...]] = get_args(Relation)
FORMS: Final[tuple[Form, ...]] = get_args(Form)
FLAGS: Final = ("wind", "meant")
LORA_RANK: Final = 11
HEAD_WIDTH: Final = 80
DROPOUT: Final = 0.1
MIN_WIND, MIN_MEANT = 0.15, 0.3  # probabilities from which on a flag is set
MIN_MEANT_UNKNOWN: Final = 0.06  # MIN_MEANT of names that the map lacks, which are rare in training
MIN_ANGLE_PROBABILITY: Final = 0.06  # less likely angles are dropped
MAX_CHARACTERS: Final = 600  # of a text that is read at once; longer ones are split
_SENTENCE_END = re.compile(r"[.!?\n]\s")
MentionSpan = tuple[int, int, Form]


@dataclass(frozen=True, slots=True)
class ReadCue:
    """The predicted cue of a mention."""

    angle: float | None  # the likeliest, degrees clockwise from the heading; None without one
    # likely angles with their probabilities; empty if only one is likely
    angles: tuple[tuple[float | None, float], ...]
    relation: Relation
    has_wind: bool  # whether it may have a compass direction
    is_meant: bool  # whether it says where the speaker is; not so for an order of food or a repeated mention


class CueReader(nn.Module):
    """Predicts the fields of `ReadCue` for each mention.

    It uses the frozen layers of the text encoder and the tuned layers of the hint reader (not saved with it) with a
    low-rank update (LoRA: Hu et al., ICLR 2022, equation 3). The tokens of each mention are marked with its form.
    """

    def __init__(self, text_encoder: TextEncoder, tuned: nn.ModuleList, frozen_layers: int) -> None:
        super().__init__()
        self._base = text_encoder, tuned  # a tuple hides them from state_dict
        self._frozen_layers = frozen_layers
        width = text_encoder.width
        matrices = [weight for _, weight in self._matrices()]
        self.down = nn.ParameterList(torch.randn(LORA_RANK, w.shape[1]) / w.shape[1] ** 0.5 for w in matrices)
        self.up = nn.ParameterList(torch.zeros(w.shape[0], LORA_RANK) for w in matrices)
        self.mark = nn.Embedding(2 * len(FORMS) + 1, width)  # 0 outside mentions; then first and further tokens
        nn.init.normal_(self.mark.weight, std=0.05)
        self.dropout = nn.Dropout(DROPOUT)
        self.head = nn.Sequential(
            nn.Linear(2 * width, HEAD_WIDTH), nn.GELU(), nn.Dropout(DROPOUT),
            nn.Linear(HEAD_WIDTH, len(ANGLES) + len(RELATIONS) + len(FLAGS)),
        )  # fmt: skip
        self._int8_layers: list[Int8Layer] | None = None  # with the low-rank update merged

    def forward(self, tokens: TokenFeatures, spans: Sequence[Sequence[tuple[int, int, int]]]) -> tuple[Tensor, ...]:
        """Return logits of the mentions of all texts: angle [S, 11], relation [S, R], flags [S, 2].

        `spans` has the first token, end and row of FORMS of each mention of each text.
        """
        mark = torch.zeros(tokens.mask.shape, dtype=torch.int64)
        for row, text_spans in zip(mark, spans, strict=True):
            for first, end, form in text_spans:
                row[first], row[first + 1 : end] = 1 + 2 * form, 2 + 2 * form
        x = self._run(self.dropout(tokens.values + self.mark(mark.to(tokens.mask.device))), tokens.mask)
        pooled = [
            torch.cat([x[n, a:b].mean(dim=0), x[n, a]]) for n, text_spans in enumerate(spans) for a, b, _ in text_spans
        ]
        logits = self.head(self.dropout(torch.stack(pooled) if pooled else x.new_zeros(0, 2 * x.shape[2])))
        return torch.split(logits, [len(ANGLES), len(RELATIONS), len(FLAGS)], dim=1)

    @torch.no_grad()
    def read(self, text: str, places: Sequence[MentionSpan]) -> list[ReadCue]:
        """Return the cue of each mention; an empty cue for a mention beyond the last token read."""
        cues = [ReadCue(None, (), "seen", has_wind=False, is_meant=True)] * len(places)
        pieces = [(a, b, [n for n, place in enumerate(places) if a <= place[0] < b]) for a, b in _split_text(text)]
        pieces = [piece for piece in pieces if piece[2]]
        if not pieces:
            return cues
        tokens, characters = self.encode([text[a:b] for a, b, _ in pieces])
        spans, rows = [], []
        for (a, _, numbers), where in zip(pieces, characters, strict=True):
            located = [(n, token_span(where, places[n][0] - a, places[n][1] - a)) for n in numbers]
            spans.append([(*span, FORMS.index(places[n][2])) for n, span in located if span is not None])
            rows += [n for n, span in located if span is not None]
        angle, relation, flags = self(tokens, spans)
        likely = angle.softmax(dim=1).tolist(), relation.argmax(dim=1).tolist(), flags.sigmoid().tolist()
        for n, angles, r, (wind, meant) in zip(rows, *likely, strict=True):
            best = ANGLES[max(range(len(ANGLES)), key=angles.__getitem__)]
            is_meant = meant > (MIN_MEANT_UNKNOWN if places[n][2] == "unknown" else MIN_MEANT)
            cues[n] = ReadCue(best, _likely(angles), RELATIONS[r], wind > MIN_WIND, is_meant)
        return cues

    def encode(self, texts: Sequence[str]) -> tuple[TokenFeatures, Tensor]:
        """Return token features of texts from the frozen layers, and the characters [S, T, 2] of each token."""
        return self._base[0].read(texts, self._frozen_layers)

    def train(self, mode: bool = True) -> "CueReader":
        """Set the training mode and drop the quantized layers."""
        self._int8_layers = None
        return super().train(mode)

    def _matrices(self) -> list[tuple[int, Tensor]]:
        """Return the weight matrices of the layers with the index of the layer."""
        return [(n, p) for n, layer in enumerate(self._base[1]) for p in layer.parameters() if p.dim() == 2]

    def _weights(self) -> list[dict[str, Tensor]]:
        """Return the parameters of each layer with the low-rank update."""
        added = (up @ down for up, down in zip(self.up, self.down, strict=True))
        return [
            {name: p.detach() + next(added) if p.dim() == 2 else p.detach() for name, p in layer.named_parameters()}
            for layer in self._base[1]
        ]

    def _run(self, x: Tensor, mask: Tensor) -> Tensor:
        layers = self._base[1]
        if self.training or not can_quantize(layers, x):
            for layer, weights in zip(layers, self._weights(), strict=True):
                x = functional_call(layer, weights, (x, attention_bias(mask, x)))
            return x
        if self._int8_layers is None:
            self._int8_layers = [Int8Layer(*each) for each in zip(layers, self._weights(), strict=True)]
        return run_int8_layers(self._int8_layers, x, mask)


def _likely(angles: Sequence[float]) -> tuple[tuple[float | None, float], ...]:
    """Return likely angles with probabilities that add up to 1; empty if there is only one."""
    likely = [(angle, p) for angle, p in zip(ANGLES, angles, strict=True) if p >= MIN_ANGLE_PROBABILITY]
    total = sum(p for _, p in likely)
    return tuple((angle, p / total) for angle, p in likely) if len(likely) > 1 else ()


def token_span(characters: Tensor, start: int, end: int) -> tuple[int, int] | None:
    """Return the tokens (first, end) of a span of characters; None if there are none."""
    inside = (characters[:, 0] < end) & (characters[:, 1] > start) & (characters[:, 1] > characters[:, 0])
    rows = torch.nonzero(inside).flatten()
    return (int(rows[0]), int(rows[-1]) + 1) if len(rows) else None


def _split_text(text: str) -> list[tuple[int, int]]:
    """Split a text into spans of at most MAX_CHARACTERS, between sentences where possible."""
    pieces, start = [], 0
    while len(text) - start > MAX_CHARACTERS:
        ends = [match.end() for match in _SENTENCE_END.finditer(text, start, start + MAX_CHARACTERS)]
        end = ends[-1] if ends else start + MAX_CHARACTERS
        pieces.append((start, end))
        start = end
    return [*pieces, (start, len(text))]
