"""Add typing errors to labelled texts."""

import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from models.language.grammar.labelled_text import LabelledText

# shares of the training texts with typos, in lower case, without full stops
TYPO_TEXTS, LOWER_TEXTS, BARE_TEXTS = 0.2, 0.15, 0.1


def spoil(labelled: LabelledText, rng: np.random.Generator) -> LabelledText:
    """Return a text with random typos, lower case or missing full stops."""
    drawn = rng.random(3)
    if drawn[0] < LOWER_TEXTS:
        labelled = replace(labelled, text=labelled.text.lower())
    if drawn[1] < BARE_TEXTS:
        labelled = replace(labelled, text=labelled.text.replace(". ", ", ").rstrip("."))
    if drawn[2] < TYPO_TEXTS:
        for _ in range(int(rng.integers(1, 4))):
            labelled = _typo(labelled, rng)
    return labelled


def typos(labelled: LabelledText, count: int, rng: np.random.Generator) -> LabelledText:
    """Return a text with a number of mistyped letters."""
    for _ in range(count):
        labelled = _typo(labelled, rng)
    return labelled


def _typo(labelled: LabelledText, rng: np.random.Generator) -> LabelledText:
    """Drop a letter, double it, or swap it with the next."""
    places = [m.start() for m in re.finditer(r"(?<=[a-z])[a-z](?=[a-z])", labelled.text)]
    if not places:
        return labelled
    letter = places[int(rng.integers(len(places)))]
    text = labelled.text
    edits: tuple[Callable[[], str], ...] = (
        lambda: text[:letter] + text[letter + 1 :],
        lambda: text[:letter] + text[letter] + text[letter:],
        lambda: text[:letter] + text[letter + 1] + text[letter] + text[letter + 2 :],
    )
    spoiled = edits[int(rng.integers(len(edits)))]()
    grown = len(spoiled) - len(text)
    moved = tuple(
        replace(m, start=m.start + grown * (m.start > letter), end=m.end + grown * (m.end > letter))
        for m in labelled.mentions
    )
    return LabelledText(spoiled, moved)
