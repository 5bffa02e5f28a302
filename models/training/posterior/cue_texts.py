"""Labelled texts that the reader of cues is trained on, and how they are varied (docs/method.md)."""

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from models.errors import TrainingError
from models.language.mentions.cue_reader import ANGLES, FORMS, RELATIONS

LABELLED: Final = Path(__file__).parents[2] / "language" / "mentions" / "labelled"
REAL_PLACES: Final = "real_places"  # the kernels of places are fitted to some of these, so they are read by halves
OTHERS: Final = ("invented", "meeting")
TRAINED_ON: Final = (REAL_PLACES, *OTHERS)
MIRRORED, SPOILT, LEFT_OUT = 0.5, 0.4, 0.15  # shares of texts
RENAMED, RENAMED_TRIES = 0.4, 3  # so often, and so many times, a thing or street gets another's name
_SIDES = re.compile(r"\b(left|right)\b", re.IGNORECASE)
_LONG_WORD = re.compile(r"\w{4,}")
_OTHER = {"left": "right", "right": "left"}
# "right" is an adverb too, which has no mirror image
_ADVERB = re.compile(
    r"\bright\s+(?!(?:hand|side|of|and|is|are|s|then|there|with|now)\b)(?:[a-z]+)|\bleft\s+(?:the|my|a)\b|\b(?:just|have|i|we)\s+left\b",
    re.IGNORECASE,
)
Names = Mapping[tuple[int, bool], Sequence[str]]


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


def names_of(texts: Sequence[CueText]) -> Names:
    """What things and streets are called in texts, by row of FORMS and whether they begin with a capital letter."""
    found: dict[tuple[int, bool], list[str]] = {}
    for text in texts:
        for item in text.items:
            if item.is_meant and FORMS[item.form] in ("thing", "street"):
                name = text.text[item.start : item.end]
                found.setdefault((item.form, name[:1].isupper()), []).append(name)
    return found


def varied(text: CueText, names: Names, rng: np.random.Generator) -> CueText:
    """A text, often with other names, now and then its mirror image, misspelt, without punctuation or a mention less.

    Args:
        text: as it was labelled.
        names: see `names_of`.
        rng: draws what is changed.
    """
    for _ in range(RENAMED_TRIES):
        if rng.random() < RENAMED:
            text = renamed(text, names, rng)
    if rng.random() < MIRRORED:
        text = mirrored(text)
    if rng.random() < SPOILT:
        text = replace(text, text=_spoilt(text.text, rng))
    if rng.random() < LEFT_OUT and len(text.items) > 1:
        gone = int(rng.integers(len(text.items)))
        text = replace(text, items=text.items[:gone] + text.items[gone + 1 :])
    return text


def renamed(text: CueText, names: Names, rng: np.random.Generator) -> CueText:
    """A text with another name for one of its things or streets; as it is where that is named or meant elsewhere."""
    if not text.items:
        return text
    item = text.items[int(rng.integers(len(text.items)))]
    name = text.text[item.start : item.end]
    others = names.get((item.form, name[:1].isupper()))
    if not others or any(one is not item and one.start < item.end and item.start < one.end for one in text.items):
        return text
    if any(len(re.findall(re.escape(word), text.text, re.IGNORECASE)) > 1 for word in _LONG_WORD.findall(name)):
        return text
    other = others[int(rng.integers(len(others)))]
    more = len(other) - len(name)

    def moved(one: Item) -> Item:
        if one.start < item.start:
            return one
        return replace(one, start=one.start + (0 if one is item else more), end=one.end + more)

    return CueText(text.text[: item.start] + other + text.text[item.end :], tuple(moved(one) for one in text.items))


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
