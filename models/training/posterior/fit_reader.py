"""Training the reader of free language on texts from the paraphrase grammar."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from models.language.grammar.files import Grammar
from models.language.grammar.labelled_text import Fact, LabelledText, Mention
from models.language.grammar.wording import Wording
from models.language.measures import COMPASS
from models.language.parsed_hint import RELATIONS
from models.language.reader import COLOURS, TAGS, Reader
from models.language.text_encoder import TextEncoder, TokenFeatures

ENCODED_AT_ONCE = 32
MOST_FACTS = 8
LIKE_LENGTH = 8  # a batch is drawn from so many batches' worth of texts, neighbours in length
WHOLE = 0.4  # share of the texts that are one long passage
PUBLISHED = 0.3  # share of the others in the benchmark's words, of those that it can say
ALIKE = (0.3, 0.25, 0.2)  # how often a fact has the class, the direction, the colour of an earlier one
CARDINAL = (0, 2, 4, 6)  # of COMPASS; people and the benchmark say them most
# Names are made of these, so that the reader learns how a name is used and no name by heart.
NAME_WORDS = (
    "Stockmann", "Esplanadi", "Lidl", "Kamp", "Alexa", "Galeria", "Sokos", "Karl", "Tesco", "Roma", "Aroma", "Nine",
    "Mary", "Nordic", "Union", "Kauppatori", "Lehto", "Schiller", "Marx", "Turner", "Hakaniemi", "Linden", "Orion",
    "Victoria", "Baker", "Rossi", "Golden", "Old Town", "Central", "Harbour", "Blue Moon", "Kings", "Museo", "Forum",
    "Ainola", "Weber", "Fischer", "Sunrise", "Metro", "Atlas", "Zara", "Kiasma", "Ateneum", "Runeberg", "Park", "Nokia",
)  # fmt: skip
NAME_FRAMES = (
    "{}", "{}", "{}", "Cafe {}", "the Hotel {}", "{} Street", "{}strasse", "{}katu", "the {} Museum", "{} Market",
    "Saint {}'s", "the {} Theatre", "{} Pharmacy", "{}'s", "Restaurant {}", "Bar {}", "the {} Bank", "{} Square",
    "{} School", "{} Books", "Pizzeria {}", "the {} Centre", "{} Tower", "the {} Library", "{} & Sons", "{} Avenue",
)  # fmt: skip


def draw_text(wording: Wording, rng: np.random.Generator) -> tuple[list[Fact], LabelledText]:
    """Made-up facts, and a text that tells them."""
    if rng.random() >= WHOLE:
        facts = draw_facts(wording, rng)
        return facts, _say(wording, facts, rng)
    simple = [_draw_simple(tuple(wording.labels), rng) for _ in range(MOST_FACTS)]
    return wording.whole([_alike(fact, simple[int(rng.integers(n + 1))], rng) for n, fact in enumerate(simple)], rng)


def draw_facts(wording: Wording, rng: np.random.Generator, labels: Sequence[str] | None = None) -> list[Fact]:
    """Made-up facts of a text: what a reader must be ready for, not what a place looks like."""
    names = labels or tuple(wording.labels)
    facts = [_draw_fact(names, rng) for _ in range(int(rng.integers(1, MOST_FACTS + 1)))]
    return [_alike(fact, facts[int(rng.integers(n + 1))], rng) for n, fact in enumerate(facts)]


def _alike(fact: Fact, other: Fact, rng: np.random.Generator) -> Fact:
    """Now and then of another's class, where it is, or of its colour, as the things of a place are."""
    if not (fact.is_simple and other.is_simple):
        return fact
    label, relation, colour = rng.random(3) < ALIKE
    return Fact(
        other.label if label else fact.label,
        other.relation if relation else fact.relation,
        other.colour if colour else fact.colour,
    )


def _draw_simple(labels: Sequence[str], rng: np.random.Generator) -> Fact:
    label = labels[int(rng.integers(len(labels)))]
    colour = COLOURS[int(rng.integers(len(COLOURS)))] if rng.random() < 0.65 else None
    wind = COMPASS[CARDINAL[int(rng.integers(4))]] if rng.random() < 0.85 else COMPASS[int(rng.integers(8))]
    return Fact(label, wind, colour)


def _draw_fact(labels: Sequence[str], rng: np.random.Generator) -> Fact:
    simple = _draw_simple(labels, rng)
    label, colour = simple.label, simple.colour
    drawn, special = rng.random(2)
    relation = simple.relation if drawn < 0.8 else "on-top" if drawn < 0.9 else "near"
    if special < 0.06:
        return Fact(label, absent=True, colour=colour)
    if special < 0.12:
        return Fact(label, relation if relation in COMPASS else "near", name=_draw_name(rng))
    distance = float(rng.integers(2, 40)) if special > 0.86 and relation in COMPASS else None
    return Fact(label, relation, colour, distance)


def _draw_name(rng: np.random.Generator) -> str:
    frame, word = (some[int(rng.integers(len(some)))] for some in (NAME_FRAMES, NAME_WORDS))
    return frame.format(word)


def _say(wording: Wording, facts: Sequence[Fact], rng: np.random.Generator) -> LabelledText:
    plain = all(f.relation != "near" and not f.absent and f.name is None and f.distance_m is None for f in facts)
    return wording.published(facts) if plain and rng.random() < PUBLISHED else wording.write(facts, rng)


@dataclass(frozen=True, slots=True, eq=False)
class ReadingBatch:
    """B texts and their S mentions.

    Attributes:
        tokens: of the texts.
        tags: [B, T] -100 where there is no token.
        text: [S] text of each mention.
        start, end: [S] its tokens.
        relation, colour, absent: [S] what is said; -100 where the text does not settle it.
    """

    tokens: TokenFeatures
    tags: Tensor
    text: Tensor
    start: Tensor
    end: Tensor
    relation: Tensor
    colour: Tensor
    absent: Tensor

    def to(self, device: torch.device) -> "ReadingBatch":
        """The same on a device."""
        return ReadingBatch(*(getattr(self, field.name).to(device) for field in fields(self)))


class ReadingSet:
    """Texts of a grammar with what the frozen layers make of them, encoded once and kept on the CPU.

    Args:
        encoder: the text encoder, on any device.
        depth: its frozen layers.
        grammar: which wording.
        size: how many texts.
        seed: of facts and words.
        progress: called with (texts encoded, texts in all).
    """

    def __init__(
        self,
        encoder: TextEncoder,
        depth: int,
        grammar: Grammar,
        size: int,
        seed: int,
        progress: Callable[[int, int], None] | None = None,
    ) -> None:
        wording, rng = Wording(grammar), np.random.default_rng(seed)
        drawn = [draw_text(wording, rng) for _ in range(size)]
        self.facts, self.said = [facts for facts, _ in drawn], [said for _, said in drawn]
        self.by_length = np.argsort([len(s.text) for s in self.said], kind="stable")
        self._values: list[Tensor] = [torch.empty(0)] * size
        self._targets: list[tuple[Tensor, list[tuple[int, int]]]] = [(torch.empty(0), [])] * size
        for start in range(0, size, ENCODED_AT_ONCE):
            rows = self.by_length[start : start + ENCODED_AT_ONCE]
            tokens, characters = encoder.read([self.said[n].text for n in rows], depth)
            values, mask = tokens.values.cpu(), tokens.mask.cpu()
            for k, n in enumerate(rows.tolist()):
                length = int(mask[k].sum())
                self._values[n] = values[k, :length].half()
                whole = torch.ones(length, dtype=torch.bool)
                self._targets[n] = example_targets(self.said[n].mentions, characters[k, :length], whole)
            if progress:
                progress(min(start + ENCODED_AT_ONCE, size), size)

    def __len__(self) -> int:
        return len(self.said)

    def batch(self, rows: Sequence[int]) -> ReadingBatch:
        """Some of the texts."""
        longest = max(len(self._values[n]) for n in rows)
        values = torch.zeros(len(rows), longest, self._values[rows[0]].shape[1])
        tags = torch.full((len(rows), longest), -100)
        spans: list[tuple[int, ...]] = []
        for k, n in enumerate(rows):
            length = len(self._values[n])
            values[k, :length] = self._values[n].float()
            tags[k, :length] = self._targets[n][0]
            for mention, (a, b) in zip(self.said[n].mentions, self._targets[n][1], strict=True):
                if b > a and mention.facts:
                    spans.append((k, a, b, *_wanted(self.facts[n][mention.facts[0]], mention)))
        mask = tags != -100
        columns = torch.tensor(spans, dtype=torch.long).reshape(-1, 6).T
        return ReadingBatch(TokenFeatures(values, mask, torch.zeros_like(tags)), tags, *columns)


def _wanted(fact: Fact, mention: Mention) -> tuple[int, int, int]:
    """Relation, colour and absence that a text settles of a fact where it mentions it."""
    relation = -100 if fact.absent else RELATIONS.index(fact.relation)
    return relation, COLOURS.index(str(fact.colour)) if mention.coloured else len(COLOURS), int(fact.absent)


def example_targets(
    mentions: Sequence[Mention], characters: Tensor, mask: Tensor
) -> tuple[Tensor, list[tuple[int, int]]]:
    """What training wants of one text: tags [T] and the token range of each mention (empty if it was cut off)."""
    tags = torch.zeros(len(mask), dtype=torch.long)
    ranges = []
    for mention in mentions:
        inside = (characters[:, 0] < mention.end) & (characters[:, 1] > mention.start) & mask
        tokens = inside.nonzero().flatten().tolist()
        if tokens:
            tags[tokens] = 1
            tags[tokens[0]] = TAGS.index(mention.kind)
        ranges.append((tokens[0], tokens[-1] + 1) if tokens else (0, 0))
    return tags, ranges


class ReadingTask:
    """What `run_training` makes of the reader (models.training.engine.loop.Task).

    Args:
        model: trained in place.
        training, validation: texts of two grammars.
        batch_size: texts a step.
    """

    criterion = "f1"

    def __init__(self, model: Reader, training: ReadingSet, validation: ReadingSet, batch_size: int) -> None:
        self.model, self.training, self.validation, self.batch_size = model, training, validation, batch_size

    def batch(self, rng: np.random.Generator) -> ReadingBatch:
        """Texts of like length, so that little is padding."""
        window = min(len(self.training), LIKE_LENGTH * self.batch_size)
        first = int(rng.integers(len(self.training) - window + 1))
        rows = self.training.by_length[first : first + window]
        return self.training.batch(rng.choice(rows, self.batch_size, replace=False).tolist())

    def loss(self, batch: ReadingBatch) -> Tensor:
        """Cross-entropies of tags and attributes, added."""
        examples = batch.to(next(self.model.parameters()).device)
        features = self.model(examples.tokens)
        tags = nn.functional.cross_entropy(self.model.tag(features).flatten(0, 1), examples.tags.flatten())
        relation, colour, absent = self.model.attributes(pooled(features, examples))
        said = nn.functional.cross_entropy(relation, examples.relation)
        said = said + nn.functional.cross_entropy(colour, examples.colour)
        return tags * 3 + said + nn.functional.binary_cross_entropy_with_logits(absent, examples.absent.float())

    def validate(self) -> dict[str, float]:
        """Shares of validation mentions that are read right, see `reading_figures`."""
        return reading_figures(self.model, self.validation)


def pooled(features: Tensor, batch: ReadingBatch) -> Tensor:
    """[S, D] mean features of the mentions' tokens."""
    sums = torch.cat([torch.zeros_like(features[:, :1]), features.cumsum(dim=1)], dim=1)
    width = (batch.end - batch.start)[:, None]
    mean: Tensor = (sums[batch.text, batch.end] - sums[batch.text, batch.start]) / width
    return mean


@torch.no_grad()
def reading_figures(model: Reader, texts: ReadingSet) -> dict[str, float]:
    """Shares of mentions: noun found, relation, colour, absence right; "hints" all four; "extra" nouns a text.

    "f1" weighs both: the harmonic mean of "hints" and of the share of the nouns found that are hints read right.
    """
    rows: dict[str, list[Any]] = {"noun": [], "relation": [], "colour": [], "absent": []}
    extra, device = 0, next(model.parameters()).device
    for start in range(0, len(texts), 64):
        batch = texts.batch(range(start, min(start + 64, len(texts)))).to(device)
        features = model(batch.tokens)
        tags = model.tag(features).argmax(dim=-1)
        extra += int(((tags > 1) & (batch.tags == 0)).sum())
        relation, colour, absent = model.attributes(pooled(features, batch))
        found = tags[batch.text, batch.start] == batch.tags[batch.text, batch.start]
        rows["noun"].append(found)
        rows["relation"].append((relation.argmax(-1) == batch.relation) | (batch.relation < 0))
        rows["colour"].append(colour.argmax(-1) == batch.colour)
        rows["absent"].append((absent > 0) == (batch.absent > 0))
    columns = {name: torch.cat(parts) for name, parts in rows.items()}
    whole = torch.stack(list(columns.values())).all(dim=0)
    figures = {name: float(column.float().mean()) for name, column in columns.items()}
    f1 = 2 * int(whole.sum()) / max(len(whole) + int(columns["noun"].sum()) + extra, 1)
    return figures | {"hints": float(whole.float().mean()), "extra": extra / len(texts), "f1": f1}
