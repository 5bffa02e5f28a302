"""Training of the hint reader on texts from the grammar."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from models.language.grammar.files import Grammar
from models.language.grammar.labelled_text import LabelledMention, LabelledText, ObjectFact
from models.language.grammar.wording import Wording
from models.language.measures import COMPASS
from models.language.parsed_hint import RELATIONS
from models.language.reader import COLOURS, TAGS, Reader
from models.language.text_encoder import TextEncoder, TokenFeatures

TEXTS_PER_BATCH = 32
MAX_FACTS = 8
BATCHES_PER_WINDOW = 8  # a batch is drawn from a window of this many batches of texts with similar length
PASSAGE_SHARE = 0.4  # of the texts are one long passage
BENCHMARK_SHARE = 0.3  # of the other texts use the wording of the benchmark, where it can express the facts
REPEAT_SHARES = (0.3, 0.25, 0.2)  # of facts repeat the class, direction or colour of an earlier fact
CARDINAL_DIRECTIONS = (0, 2, 4, 6)  # indices into COMPASS; the most frequent ones in texts and the benchmark
# Made-up names, so that the reader learns how names are used instead of the names.
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


def draw_text(wording: Wording, rng: np.random.Generator) -> tuple[list[ObjectFact], LabelledText]:
    """Draw made-up facts, and a text that states them."""
    if rng.random() >= PASSAGE_SHARE:
        facts = draw_facts(wording, rng)
        return facts, _write(wording, facts, rng)
    simple = [_draw_simple(tuple(wording.labels), rng) for _ in range(MAX_FACTS)]
    return wording.whole([_repeat(fact, simple[int(rng.integers(n + 1))], rng) for n, fact in enumerate(simple)], rng)


def draw_facts(wording: Wording, rng: np.random.Generator, labels: Sequence[str] | None = None) -> list[ObjectFact]:
    """Draw made-up facts that cover what texts can say, not realistic places."""
    names = labels or tuple(wording.labels)
    facts = [_draw_fact(names, rng) for _ in range(int(rng.integers(1, MAX_FACTS + 1)))]
    return [_repeat(fact, facts[int(rng.integers(n + 1))], rng) for n, fact in enumerate(facts)]


def _repeat(fact: ObjectFact, other: ObjectFact, rng: np.random.Generator) -> ObjectFact:
    """Sometimes repeat the class, direction or colour of another fact, as real texts do."""
    if not (fact.is_simple and other.is_simple):
        return fact
    label, relation, colour = rng.random(3) < REPEAT_SHARES
    return ObjectFact(
        other.label if label else fact.label,
        other.relation if relation else fact.relation,
        other.colour if colour else fact.colour,
    )


def _draw_simple(labels: Sequence[str], rng: np.random.Generator) -> ObjectFact:
    label = labels[int(rng.integers(len(labels)))]
    colour = COLOURS[int(rng.integers(len(COLOURS)))] if rng.random() < 0.65 else None
    wind = COMPASS[CARDINAL_DIRECTIONS[int(rng.integers(4))]] if rng.random() < 0.85 else COMPASS[int(rng.integers(8))]
    return ObjectFact(label, wind, colour)


def _draw_fact(labels: Sequence[str], rng: np.random.Generator) -> ObjectFact:
    simple = _draw_simple(labels, rng)
    label, colour = simple.label, simple.colour
    drawn, special = rng.random(2)
    relation = simple.relation if drawn < 0.8 else "on-top" if drawn < 0.9 else "near"
    if special < 0.06:
        return ObjectFact(label, absent=True, colour=colour)
    if special < 0.12:
        return ObjectFact(label, relation if relation in COMPASS else "near", name=_draw_name(rng))
    distance = float(rng.integers(2, 40)) if special > 0.86 and relation in COMPASS else None
    return ObjectFact(label, relation, colour, distance)


def _draw_name(rng: np.random.Generator) -> str:
    frame, word = (table[int(rng.integers(len(table)))] for table in (NAME_FRAMES, NAME_WORDS))
    return frame.format(word)


def _write(wording: Wording, facts: Sequence[ObjectFact], rng: np.random.Generator) -> LabelledText:
    plain = all(f.relation != "near" and not f.absent and f.name is None and f.distance_m is None for f in facts)
    return wording.published(facts) if plain and rng.random() < BENCHMARK_SHARE else wording.write(facts, rng)


@dataclass(frozen=True, slots=True, eq=False)
class ReadingBatch:
    """A batch of B texts with S mentions."""

    tokens: TokenFeatures
    tags: Tensor  # [B, T], -100 at padding
    text: Tensor  # [S] index of each mention's text
    start: Tensor  # [S] token range of each mention
    end: Tensor
    relation: Tensor  # [S] labels; -100 where the text leaves them open
    colour: Tensor
    absent: Tensor

    def to(self, device: torch.device) -> "ReadingBatch":
        """Return a copy on a device."""
        return ReadingBatch(*(getattr(self, field.name).to(device) for field in fields(self)))


class ReadingSet:
    """Texts of a grammar with the output of the frozen layers, encoded once and stored on the CPU.

    `depth` is the number of frozen layers, `size` that of texts; `progress` is called with (texts encoded, texts).
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
        self.facts, self.texts = [facts for facts, _ in drawn], [text for _, text in drawn]
        self.by_length = np.argsort([len(text.text) for text in self.texts], kind="stable")
        self._values: list[Tensor] = [torch.empty(0)] * size
        self._targets: list[tuple[Tensor, list[tuple[int, int]]]] = [(torch.empty(0), [])] * size
        for start in range(0, size, TEXTS_PER_BATCH):
            rows = self.by_length[start : start + TEXTS_PER_BATCH]
            tokens, characters = encoder.read([self.texts[n].text for n in rows], depth)
            values, mask = tokens.values.cpu(), tokens.mask.cpu()
            for k, n in enumerate(rows.tolist()):
                length = int(mask[k].sum())
                self._values[n] = values[k, :length].half()
                self._targets[n] = example_targets(
                    self.texts[n].mentions, characters[k, :length], torch.ones(length, dtype=torch.bool)
                )
            if progress:
                progress(min(start + TEXTS_PER_BATCH, size), size)

    def __len__(self) -> int:
        return len(self.texts)

    def batch(self, rows: Sequence[int]) -> ReadingBatch:
        """Return some of the texts as a batch."""
        longest = max(len(self._values[n]) for n in rows)
        values = torch.zeros(len(rows), longest, self._values[rows[0]].shape[1])
        tags = torch.full((len(rows), longest), -100)
        spans: list[tuple[int, ...]] = []
        for k, n in enumerate(rows):
            length = len(self._values[n])
            values[k, :length] = self._values[n].float()
            tags[k, :length] = self._targets[n][0]
            for mention, (a, b) in zip(self.texts[n].mentions, self._targets[n][1], strict=True):
                if b > a and mention.facts:
                    spans.append((k, a, b, *_labels(self.facts[n][mention.facts[0]], mention)))
        mask = tags != -100
        columns = torch.tensor(spans, dtype=torch.long).reshape(-1, 6).T
        return ReadingBatch(TokenFeatures(values, mask, torch.zeros_like(tags)), tags, *columns)


def _labels(fact: ObjectFact, mention: LabelledMention) -> tuple[int, int, int]:
    """Return the labels (relation, colour, absent) of a fact at a mention."""
    relation = -100 if fact.absent else RELATIONS.index(fact.relation)
    return relation, COLOURS.index(str(fact.colour)) if mention.coloured else len(COLOURS), int(fact.absent)


def example_targets(
    mentions: Sequence[LabelledMention], characters: Tensor, mask: Tensor
) -> tuple[Tensor, list[tuple[int, int]]]:
    """Return the tags [T] of a text and the token range of each mention (empty if it was truncated)."""
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
    """The training task of the hint reader (models.training.engine.loop.Task) with texts of two grammars."""

    criterion = "f1"

    def __init__(self, model: Reader, training: ReadingSet, validation: ReadingSet, batch_size: int) -> None:
        self.model, self.training, self.validation, self.batch_size = model, training, validation, batch_size

    def batch(self, rng: np.random.Generator) -> ReadingBatch:
        """Draw texts of similar length, to save padding."""
        window = min(len(self.training), BATCHES_PER_WINDOW * self.batch_size)
        first = int(rng.integers(len(self.training) - window + 1))
        rows = self.training.by_length[first : first + window]
        return self.training.batch(rng.choice(rows, self.batch_size, replace=False).tolist())

    def loss(self, batch: ReadingBatch) -> Tensor:
        """Return the sum of the cross-entropies of tags and attributes."""
        examples = batch.to(next(self.model.parameters()).device)
        features = self.model(examples.tokens)
        tags = nn.functional.cross_entropy(self.model.tag(features).flatten(0, 1), examples.tags.flatten())
        relation, colour, absent = self.model.attributes(pool_mentions(features, examples))
        attributes = nn.functional.cross_entropy(relation, examples.relation)
        attributes = attributes + nn.functional.cross_entropy(colour, examples.colour)
        return tags * 3 + attributes + nn.functional.binary_cross_entropy_with_logits(absent, examples.absent.float())

    def validate(self) -> dict[str, float]:
        """Return the `reading_metrics` of the validation texts."""
        return reading_metrics(self.model, self.validation)


def pool_mentions(features: Tensor, batch: ReadingBatch) -> Tensor:
    """Return the mean features [S, D] of the tokens of each mention."""
    sums = torch.cat([torch.zeros_like(features[:, :1]), features.cumsum(dim=1)], dim=1)
    width = (batch.end - batch.start)[:, None]
    return (sums[batch.text, batch.end] - sums[batch.text, batch.start]) / width


@torch.no_grad()
def reading_metrics(model: Reader, texts: ReadingSet) -> dict[str, float]:
    """Return the shares of correct nouns, relations, colours and absences, of "hints" with all four correct, and "f1".

    "extra" is the number of false nouns per text. "f1" is the harmonic mean of "hints" and of its precision, the share
    of predicted nouns that are correct hints.
    """
    rows: dict[str, list[Any]] = {"noun": [], "relation": [], "colour": [], "absent": []}
    extra, device = 0, next(model.parameters()).device
    for start in range(0, len(texts), 64):
        batch = texts.batch(range(start, min(start + 64, len(texts)))).to(device)
        features = model(batch.tokens)
        tags = model.tag(features).argmax(dim=-1)
        extra += int(((tags > 1) & (batch.tags == 0)).sum())
        relation, colour, absent = model.attributes(pool_mentions(features, batch))
        rows["noun"].append(tags[batch.text, batch.start] == batch.tags[batch.text, batch.start])
        rows["relation"].append((relation.argmax(-1) == batch.relation) | (batch.relation < 0))
        rows["colour"].append(colour.argmax(-1) == batch.colour)
        rows["absent"].append((absent > 0) == (batch.absent > 0))
    columns = {name: torch.cat(parts) for name, parts in rows.items()}
    whole = torch.stack(list(columns.values())).all(dim=0)
    metrics = {name: float(column.float().mean()) for name, column in columns.items()}
    f1 = 2 * int(whole.sum()) / max(len(whole) + int(columns["noun"].sum()) + extra, 1)
    return metrics | {"hints": float(whole.float().mean()), "extra": extra / len(texts), "f1": f1}
