"""Labelled texts for the training of the cue reader, and their augmentation (docs/method.md)."""

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from models.errors import TrainingError
from models.language.mentions.cue_reader import ANGLES, FORMS, RELATIONS

LABELLED_DIR: Final = Path(__file__).parents[2] / "language" / "mentions" / "labelled"
# The place kernels are fitted to some of these, as read by a cue reader that was trained on the other half.
REAL_PLACES: Final = "real_places"
OTHER_SETS: Final = ("invented", "meeting")
TRAINING_SETS: Final = (REAL_PLACES, *OTHER_SETS)
# Shares of the texts that are mirrored, misspelt, and lose a mention.
MIRRORED_SHARE, MISSPELT_SHARE, OMITTED_SHARE = 0.5, 0.4, 0.15
RENAMING_SHARE, RENAMINGS = 0.4, 3  # chance of each renaming of a mention, and number of renamings
_SIDES = re.compile(r"\b(left|right)\b", re.IGNORECASE)
_LONG_WORD = re.compile(r"\w{4,}")
_OPPOSITE_SIDE = {"left": "right", "right": "left"}
# "right" and "left" with other meanings, which have no mirror image
_ADVERB = re.compile(
    r"\bright\s+(?!(?:hand|side|of|and|is|are|s|then|there|with|now)\b)(?:[a-z]+)|\bleft\s+(?:the|my|a)\b|\b(?:just|have|i|we)\s+left\b",
    re.IGNORECASE,
)
Names = Mapping[tuple[int, bool], Sequence[str]]


@dataclass(frozen=True, slots=True)
class CueMention:
    """A mention in a labelled text: its characters, indices into FORMS, ANGLES, RELATIONS, and the flags."""

    start: int
    end: int
    form: int
    angle: int = 0
    relation: int = 0
    has_wind: bool = False
    is_meant: bool = True


@dataclass(frozen=True, slots=True)
class CueText:
    """A text with its labelled mentions."""

    text: str
    mentions: tuple[CueMention, ...]


def load_labelled(path: Path) -> list[CueText]:
    """Load labelled texts, one JSON object per line.

    Raises:
        TrainingError: a line is not a labelled text.
    """
    texts = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        try:
            row = json.loads(line)
            mentions = [_mention(label) for label in row["mentions"]]
            mentions += [
                CueMention(label["start"], label["end"], FORMS.index(label["form"]), is_meant=False)
                for label in row.get("not_meant", ())
            ]
            texts.append(CueText(row["text"], tuple(sorted(mentions, key=lambda mention: mention.start))))
        except (ValueError, KeyError, TypeError) as error:
            raise TrainingError(
                f"{path}, line {number}: {type(error).__name__}: {error}; see labelled/README.md"
            ) from error
    return texts


def load_training_texts() -> list[CueText]:
    """Load all shipped labelled texts except the held-out ones."""
    return [text for name in TRAINING_SETS for text in load_labelled(LABELLED_DIR / f"{name}.jsonl")]


def _mention(label: dict[str, Any]) -> CueMention:
    angle = label["angle"]
    return CueMention(
        label["start"],
        label["end"],
        FORMS.index(label["form"]),
        ANGLES.index(None if angle is None else float(angle)),
        RELATIONS.index(label["relation"]),
        bool(label.get("wind")),
    )


def collect_names(texts: Sequence[CueText]) -> Names:
    """Collect the names of things and streets in texts, by index of FORMS and whether they are capitalized."""
    names: dict[tuple[int, bool], list[str]] = {}
    for text in texts:
        for mention in text.mentions:
            if mention.is_meant and FORMS[mention.form] in ("thing", "street"):
                name = text.text[mention.start : mention.end]
                names.setdefault((mention.form, name[:1].isupper()), []).append(name)
    return names


def augment(text: CueText, names: Names, rng: np.random.Generator) -> CueText:
    """Return a variant of a text: other names, the mirror image, misspellings, no punctuation, a mention fewer."""
    for _ in range(RENAMINGS):
        if rng.random() < RENAMING_SHARE:
            text = replace_name(text, names, rng)
    if rng.random() < MIRRORED_SHARE:
        text = mirror(text)
    if rng.random() < MISSPELT_SHARE:
        text = replace(text, text=_misspell(text.text, rng))
    if rng.random() < OMITTED_SHARE and len(text.mentions) > 1:
        omitted = int(rng.integers(len(text.mentions)))
        text = replace(text, mentions=text.mentions[:omitted] + text.mentions[omitted + 1 :])
    return text


def replace_name(text: CueText, names: Names, rng: np.random.Generator) -> CueText:
    """Rename a thing or street of a text; a name that overlaps another mention or occurs twice stays."""
    if not text.mentions:
        return text
    target = text.mentions[int(rng.integers(len(text.mentions)))]
    name = text.text[target.start : target.end]
    candidates = names.get((target.form, name[:1].isupper()))
    overlaps = (
        other is not target and other.start < target.end and target.start < other.end for other in text.mentions
    )
    if not candidates or any(overlaps):
        return text
    if any(len(re.findall(re.escape(word), text.text, re.IGNORECASE)) > 1 for word in _LONG_WORD.findall(name)):
        return text
    new_name = candidates[int(rng.integers(len(candidates)))]
    growth = len(new_name) - len(name)

    def shift(mention: CueMention) -> CueMention:
        if mention.start < target.start:
            return mention
        return replace(mention, start=mention.start + (0 if mention is target else growth), end=mention.end + growth)

    return CueText(text.text[: target.start] + new_name + text.text[target.end :], tuple(map(shift, text.mentions)))


def mirror(text: CueText) -> CueText:
    """Exchange left and right in a text; a text with another meaning of these words stays."""
    sides = list(_SIDES.finditer(text.text))
    if not sides or _ADVERB.search(text.text):
        return text

    def shift(offset: int) -> int:
        growth = (len(_OPPOSITE_SIDE[side[0].lower()]) - len(side[0]) for side in sides if side.end() <= offset)
        return offset + sum(growth)

    mentions = [
        replace(mention, start=shift(mention.start), end=shift(mention.end), angle=_mirror_angle(mention.angle))
        for mention in text.mentions
    ]
    return CueText(_SIDES.sub(_opposite_side, text.text), tuple(mentions))


def _opposite_side(side: re.Match[str]) -> str:
    opposite = _OPPOSITE_SIDE[side[0].lower()]
    return opposite.capitalize() if side[0][0].isupper() else opposite


def _mirror_angle(angle: int) -> int:
    degrees = ANGLES[angle]
    return angle if degrees in (None, 180.0) else ANGLES.index(-degrees if degrees else 0.0)


def _misspell(text: str, rng: np.random.Generator) -> str:
    """Drop capitals, drop punctuation, or swap letters; the length stays the same."""
    drawn = rng.random()
    if drawn < 0.4:
        text = text.lower()
        return re.sub(r"[.,;!?]", " ", text) if drawn < 0.25 else text
    letters = list(text)
    for n in rng.integers(1, max(2, len(letters) - 1), size=int(rng.integers(1, 4))):
        if "".join(letters[n - 1 : n + 2]).isalpha():
            letters[n - 1], letters[n] = letters[n], letters[n - 1]
    return "".join(letters)
