"""The reader of hints: tags the nouns of a description and predicts the attributes of each."""

import copy
import re
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import Final

import torch
from pydantic import BaseModel, ConfigDict
from torch import Tensor, nn

from models.language.int8 import Int8Layer, can_quantize, run_int8_layers
from models.language.lexicon.lexicon import load_lexicon
from models.language.measures import find_measures, match_facts_to_spans
from models.language.parsed_hint import RELATIONS, ParsedHint, resolve
from models.language.text_encoder import DEFAULT_TEXT_ENCODER, TextEncoder, TextEncoderModel, TokenFeatures, run_layers

# Tags of tokens: outside, a further token of a span, and the first token of a noun, a plural or a stand-in.
TAGS: Final = ("outside", "further", "noun", "plural", "stand-in")
COLOURS: Final = (
    "dark-green", "gray", "gray-green", "bright-gray", "black", "green", "beige", "white", "red", "brown", "orange",
    "yellow", "blue", "purple", "pink",
)  # fmt: skip
CONVOLUTION_TOKENS = 5  # width of a convolution
_LOOSE_END = re.compile(r"(?<=\w)\s+(?:of|with|along|down|up|by|in|on|at|and|to)$", re.I)


class ReaderConfig(BaseModel):
    """Shape of the reader."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    text_encoder: str = DEFAULT_TEXT_ENCODER  # a BERT-like language model
    frozen_layers: int = 3  # first layers of the text encoder
    tuned_layers: int = 2  # layers after those, which are fine-tuned
    width: int = 192  # of the layers above them
    local_layers: int = 2  # convolutions over neighbouring tokens
    dropout: float = 0.1  # while training, in the convolutions


class Reader(TextEncoderModel):
    """Tags the nouns of a text, and predicts the direction, the colour and the absence of each.

    It reads the whole description at once, so that pronouns, joined clauses and colours in other sentences find their
    noun. It is trained on the paraphrase grammar (`models.language.grammar.wording`).
    """

    def __init__(self, text_encoder: TextEncoder, config: ReaderConfig) -> None:
        super().__init__(text_encoder)
        self.config = config
        width, frozen = config.width, config.frozen_layers
        self.tuned = copy.deepcopy(text_encoder.layers(frozen, frozen + config.tuned_layers)).requires_grad_(True)
        self.project = nn.Linear(text_encoder.width, width)
        self.near = nn.ModuleList(_Near(width, config.dropout) for _ in range(config.local_layers))
        self.tag = nn.Linear(width, len(TAGS))
        self.relation = _head(width, len(RELATIONS))
        self.colour = _head(width, len(COLOURS) + 1)
        self.absent = _head(width, 1)
        self._int8_layers: list[Int8Layer] | None = None

    def forward(self, tokens: TokenFeatures) -> Tensor:
        """Return features [B, T, D] of tokens from those of the frozen layers."""
        x: Tensor = self.project(self._run(tokens.values, tokens.mask))
        for layer in self.near:
            x = layer(x, tokens.mask)
        return x

    def _run(self, hidden: Tensor, mask: Tensor) -> Tensor:
        if self.training or not can_quantize(self.tuned, hidden):
            return run_layers(self.tuned, hidden, mask)
        if self._int8_layers is None:
            self._int8_layers = [Int8Layer(layer) for layer in self.tuned]
        return run_int8_layers(self._int8_layers, hidden, mask)

    def train(self, mode: bool = True) -> "Reader":
        """Set the training mode and drop the quantized layers."""
        self._int8_layers = None
        return super().train(mode)

    def attributes(self, spans: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """Return logits of nouns from their features [S, D]: relation [S, 10], colour [S, C + 1], absent [S]."""
        return self.relation(spans), self.colour(spans), self.absent(spans).squeeze(-1)

    @torch.no_grad()
    def read(self, texts: Sequence[str]) -> list[list[ParsedHint]]:
        """Return the hints of each text, in text order."""
        tokens, characters = self.text_encoder.read(texts, self.config.frozen_layers)
        features = self(tokens)
        tags = self.tag(features).argmax(dim=-1)
        hints: list[list[ParsedHint]] = []
        for n, text in enumerate(texts):
            spans = _spans(tags[n], characters[n], tokens.mask[n], text)
            if not spans:
                hints.append([])
                continue
            pooled = torch.stack([features[n, a:b].mean(dim=0) for a, b, _ in spans])
            relation, colour, absent = self.attributes(pooled)
            places = [_trim_noun(text, int(characters[n, a, 0]), int(characters[n, b - 1, 1])) for a, b, _ in spans]
            rows = zip(places, relation.softmax(-1), colour.softmax(-1), absent.sigmoid().tolist(), strict=True)
            things = [ParsedHint(_noun(text, a, b), a, b, *rest) for (a, b), *rest in rows]
            measures = find_measures(text)
            # The blocks of "two blocks" are not things.
            real = [n for n, thing in enumerate(things) if not any(measure.contains(thing) for measure in measures)]
            nearest = match_facts_to_spans(text, measures, [things[n] for n in real])
            things = [replace(things[n], measure=nearest.get(k)) for k, n in enumerate(real)]
            hints.append(resolve(text, things, [TAGS[spans[n][2]] for n in real]))
        return hints


class _Near(nn.Module):
    """A convolution over neighbouring tokens."""

    def __init__(self, width: int, dropout: float) -> None:
        super().__init__()
        self.mix = nn.Conv1d(width, width, CONVOLUTION_TOKENS, padding=CONVOLUTION_TOKENS // 2)
        self.norm, self.dropout = nn.LayerNorm(width), nn.Dropout(dropout)

    def forward(self, x: Tensor, mask: Tensor) -> Tensor:
        mixed = self.mix((x * mask[..., None]).transpose(1, 2)).transpose(1, 2)
        normed: Tensor = self.norm(x + self.dropout(nn.functional.gelu(mixed)))
        return normed


def _head(width: int, outputs: int) -> nn.Sequential:
    return nn.Sequential(nn.Linear(width, width), nn.GELU(), nn.Linear(width, outputs))


def _spans(tags: Tensor, characters: Tensor, mask: Tensor, text: str) -> list[tuple[int, int, int]]:
    """Return (first token, end, tag) of each span; a word that the tokenizer split stays whole."""
    spans: list[list[int]] = []
    real = (mask & (characters[:, 1] > characters[:, 0])).tolist()
    starts, ends = characters.T.tolist()
    for t, tag in enumerate(tags.tolist()):
        if not real[t]:
            continue
        same_word = t > 0 and real[t - 1] and starts[t] == ends[t - 1]
        inside = bool(spans) and spans[-1][1] == t
        goes_on = tag == 1 or (inside and tag > 1 and text[: starts[t]].endswith((" of ", " for ")))
        if inside and (goes_on or (same_word and text[starts[t]].isalnum())):
            spans[-1][1] = t + 1
        elif tag > 1:
            spans.append([t, t + 1, tag])
    return [(a, b, tag) for a, b, tag in spans]


def _trim_noun(text: str, start: int, end: int) -> tuple[int, int]:
    """Return the characters of a noun, without a preposition at its end."""
    loose = _LOOSE_END.search(text, start, end)
    return start, loose.start() if loose else end


@cache
def _size_pattern() -> re.Pattern[str]:
    """Match a size that a colour separates from its noun: "a small dark green pole"."""
    lexicon = load_lexicon()
    colours = [name for colour, names in lexicon.colours.items() for name in (colour, *names)]
    words = {word for name in colours for word in re.split(r"[\s-]", name)}
    colour, size = ("|".join(map(re.escape, sorted(options))) for options in (words, lexicon.sizes))
    return re.compile(rf"\b({size})(?:[\s-]+(?:{colour}))+\s+$", re.I)


def _noun(text: str, start: int, end: int) -> str:
    size = _size_pattern().search(text[max(0, start - 40) : start])
    return f"{size[1]} {text[start:end]}" if size else text[start:end]
