"""Training the reader of cues on labelled texts (docs/method.md, how texts about places are read)."""

import json
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
import torch
from torch import Tensor, nn

from models.city.points import Ints
from models.errors import TrainingError
from models.language.places.cue_reader import ANGLES, FLAGS, FORMS, RELATIONS, CueReader, token_span

LABELLED: Final = Path(__file__).parents[2] / "language" / "places" / "labelled"
PEOPLE: Final = "people"  # of them the kernels of places are fitted to some, so that they are read by halves
OTHERS: Final = ("invented", "meeting")
TRAINED_ON: Final = (PEOPLE, *OTHERS)
EPOCHS: Final = 9
BATCH: Final = 16
DRAWN: Final = 16  # batches that are sorted by length together
RATE, HEAD_RATE = 1e-3, 2e-3
WARM_UP: Final = 40  # steps
SMOOTHING: Final = 0.03  # of labels
RELATION_WEIGHT, FLAG_WEIGHT = 0.6, 0.3
NEAR: Final = 30.0  # degrees: read right
MIRRORED, SPOILT, LEFT_OUT = 0.5, 0.4, 0.15  # shares of texts
_SIDES = re.compile(r"\b(left|right)\b", re.IGNORECASE)
_OTHER = {"left": "right", "right": "left"}
# "right" is an adverb too, which has no mirror image
_ADVERB = re.compile(
    r"\bright\s+(?!(?:hand|side|of|and|is|are|s|then|there|with|now)\b)(?:[a-z]+)|\bleft\s+(?:the|my|a)\b|\b(?:just|have|i|we)\s+left\b",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class Item:
    """A mention of a labelled text: characters, and rows of FORMS, ANGLES, RELATIONS; whether it is meant at all."""

    start: int
    end: int
    form: int
    angle: int = 0
    relation: int = 0
    has_wind: bool = False
    is_meant: bool = True


@dataclass(frozen=True, slots=True)
class CueText:
    """A labelled text."""

    text: str
    items: tuple[Item, ...]


def load_labelled(path: Path) -> list[CueText]:
    """Labelled texts, one JSON object a line.

    Raises:
        TrainingError: a line is no labelled text.
    """
    found = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        try:
            row = json.loads(line)
            items = [_item(one) for one in row["mentions"]]
            items += [
                Item(one["start"], one["end"], FORMS.index(one["form"]), is_meant=False)
                for one in row.get("not_meant", ())
            ]
            found.append(CueText(row["text"], tuple(sorted(items, key=lambda item: item.start))))
        except (ValueError, KeyError, TypeError) as error:
            raise TrainingError(
                f"{path}, line {number}: {type(error).__name__}: {error}; see labelled/README.md"
            ) from error
    return found


def labelled_texts() -> list[CueText]:
    """All that ship, but for those that are held out."""
    return [text for name in TRAINED_ON for text in load_labelled(LABELLED / f"{name}.jsonl")]


def _item(row: dict[str, Any]) -> Item:
    angle = row["angle"]
    return Item(
        row["start"],
        row["end"],
        FORMS.index(row["form"]),
        ANGLES.index(None if angle is None else float(angle)),
        RELATIONS.index(row["relation"]),
        bool(row.get("wind")),
    )


def fit_cues(
    reader: CueReader,
    texts: Sequence[CueText],
    epochs: int,
    rng: np.random.Generator,
    progress: Callable[[int, int, float], None] | None = None,
) -> float:
    """Train a reader of cues, in place.

    Args:
        reader: as it was made.
        texts: labelled.
        epochs: over all texts.
        rng: draws their order, and what is changed in them.
        progress: called with (steps done, steps, mean loss).

    Returns:
        The mean loss of the last epoch.
    """
    if not texts:
        raise TrainingError("no labelled texts")
    low = [*reader.down, *reader.up]
    high = [*reader.mark.parameters(), *reader.head.parameters()]
    optimizer = torch.optim.AdamW(
        [{"params": low, "rate": RATE}, {"params": high, "rate": HEAD_RATE}], weight_decay=0.01
    )
    reader.train()
    batches = -(-len(texts) // BATCH)
    losses: list[float] = []
    for epoch in range(epochs):
        for n, rows in enumerate(_batches(texts, rng)):
            step = epoch * batches + n
            for group in optimizer.param_groups:
                group["lr"] = group["rate"] * min(1.0, (step + 1) / WARM_UP) * max(0.02, 1 - step / (epochs * batches))
            loss = _loss(reader, [varied(texts[row], rng) for row in rows])
            optimizer.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_([*low, *high], 1.0)
            optimizer.step()
            losses.append(loss.item())
            if progress:
                progress(step + 1, epochs * batches, float(np.mean(losses[-batches:])))
    reader.eval()
    return float(np.mean(losses[-batches:]))


def _batches(texts: Sequence[CueText], rng: np.random.Generator) -> Iterator[Ints]:
    """All texts once, at random; those of like length together, as what is padded costs time."""
    order = rng.permutation(len(texts))
    length = np.array([len(text.text) for text in texts])
    some = [order[start : start + DRAWN * BATCH] for start in range(0, len(order), DRAWN * BATCH)]
    order = np.concatenate([rows[np.argsort(length[rows], kind="stable")] for rows in some])
    starts = np.arange(0, len(order), BATCH)
    for start in rng.permutation(starts):
        yield order[start : start + BATCH]


def _loss(reader: CueReader, texts: Sequence[CueText]) -> Tensor:
    tokens, characters = reader.encode([text.text for text in texts])
    at = [
        [(item, token_span(where, item.start, item.end)) for item in text.items]
        for text, where in zip(texts, characters, strict=True)
    ]
    spans = [[(*span, item.form) for item, span in some if span is not None] for some in at]
    items = [item for some in at for item, span in some if span is not None]
    angle, relation, flags = reader(tokens, spans)
    meant = torch.tensor([item.is_meant for item in items])
    told = torch.tensor([[item.has_wind, item.is_meant] for item in items]).float()
    if not items:
        none: Tensor = flags.sum()
        return none
    cross = nn.functional.cross_entropy
    total: Tensor = cross(angle, torch.tensor([item.angle for item in items]), label_smoothing=SMOOTHING)
    if bool(meant.any()):
        rows = torch.tensor([item.relation for item in items])
        total = total + RELATION_WEIGHT * cross(relation[meant], rows[meant], label_smoothing=SMOOTHING)
    flagged = nn.functional.binary_cross_entropy_with_logits(flags, told)
    loss: Tensor = total + FLAG_WEIGHT * flagged
    return loss


def accuracy(reader: CueReader, texts: Sequence[CueText]) -> dict[str, float]:
    """Shares of mentions read right: "angle" (told or not, and within 30 degrees), "relation", each of FLAGS."""
    right = dict.fromkeys(("angle", "relation", *FLAGS), 0)
    count = 0
    for text in texts:
        meant = [item for item in text.items if item.is_meant]
        read = reader.read(text.text, [(item.start, item.end, FORMS[item.form]) for item in meant])
        for item, cue in zip(meant, read, strict=True):
            angle = ANGLES[item.angle]
            right["angle"] += _is_near(angle, cue.angle)
            right["relation"] += RELATIONS[item.relation] == cue.relation
            right["wind"] += item.has_wind == cue.has_wind
            right["meant"] += cue.is_meant
            count += 1
    return {name: value / max(1, count) for name, value in right.items()}


def _is_near(one: float | None, other: float | None) -> bool:
    if one is None or other is None:
        return one is other
    return abs((one - other + 180.0) % 360.0 - 180.0) <= NEAR


def varied(text: CueText, rng: np.random.Generator) -> CueText:
    """A text, now and then its mirror image, misspelt, without punctuation or with a mention less."""
    if rng.random() < MIRRORED:
        text = mirrored(text)
    if rng.random() < SPOILT:
        text = replace(text, text=_spoilt(text.text, rng))
    if rng.random() < LEFT_OUT and len(text.items) > 1:
        gone = int(rng.integers(len(text.items)))
        text = replace(text, items=text.items[:gone] + text.items[gone + 1 :])
    return text


def mirrored(text: CueText) -> CueText:
    """A text with left and right exchanged; as it is where "right" is an adverb."""
    sides = list(_SIDES.finditer(text.text))
    if not sides or _ADVERB.search(text.text):
        return text

    def moved(at: int) -> int:
        return at + sum(len(_OTHER[side[0].lower()]) - len(side[0]) for side in sides if side.end() <= at)

    items = [
        replace(item, start=moved(item.start), end=moved(item.end), angle=_mirror(item.angle)) for item in text.items
    ]
    return CueText(_SIDES.sub(_exchanged, text.text), tuple(items))


def _exchanged(found: re.Match[str]) -> str:
    other = _OTHER[found[0].lower()]
    return other.capitalize() if found[0][0].isupper() else other


def _mirror(angle: int) -> int:
    degrees = ANGLES[angle]
    return angle if degrees in (None, 180.0) else ANGLES.index(-degrees if degrees else 0.0)


def _spoilt(text: str, rng: np.random.Generator) -> str:
    """As typed in a hurry: without capitals, without punctuation, or with letters exchanged; as long as before."""
    drawn = rng.random()
    if drawn < 0.4:
        text = text.lower()
        return re.sub(r"[.,;!?]", " ", text) if drawn < 0.25 else text
    letters = list(text)
    for at in rng.integers(1, max(2, len(letters) - 1), size=int(rng.integers(1, 4))):
        if "".join(letters[at - 1 : at + 2]).isalpha():
            letters[at - 1], letters[at] = letters[at], letters[at - 1]
    return "".join(letters)
