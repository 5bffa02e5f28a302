"""Texts as they are typed in a hurry."""

import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from models.language.grammar.labelled_text import LabelledText

# shares of the texts with typos, in lower case, without full stops
TYPO_TEXTS, LOWER_TEXTS, BARE_TEXTS = 0.2, 0.15, 0.1


def spoil(said: LabelledText, rng: np.random.Generator) -> LabelledText:
    """A text as it is typed in a hurry."""
    drawn = rng.random(3)
    if drawn[0] < LOWER_TEXTS:
        said = replace(said, text=said.text.lower())
    if drawn[1] < BARE_TEXTS:
        said = replace(said, text=said.text.replace(". ", ", ").rstrip("."))
    if drawn[2] < TYPO_TEXTS:
        for _ in range(int(rng.integers(1, 4))):
            said = _typo(said, rng)
    return said


def typos(said: LabelledText, count: int, rng: np.random.Generator) -> LabelledText:
    """The same text with some mistyped letters."""
    for _ in range(count):
        said = _typo(said, rng)
    return said


def _typo(said: LabelledText, rng: np.random.Generator) -> LabelledText:
    """One letter left out, doubled, or changed places with the next."""
    places = [m.start() for m in re.finditer(r"(?<=[a-z])[a-z](?=[a-z])", said.text)]
    if not places:
        return said
    at = places[int(rng.integers(len(places)))]
    text = said.text
    edits: tuple[Callable[[], str], ...] = (
        lambda: text[:at] + text[at + 1 :],
        lambda: text[:at] + text[at] + text[at:],
        lambda: text[:at] + text[at + 1] + text[at] + text[at + 2 :],
    )
    spoiled = edits[int(rng.integers(len(edits)))]()
    grown = len(spoiled) - len(text)
    moved = tuple(
        replace(m, start=m.start + grown * (m.start > at), end=m.end + grown * (m.end > at)) for m in said.mentions
    )
    return LabelledText(spoiled, moved)
