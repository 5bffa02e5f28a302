"""Abbreviated names of streets in the languages of cities: "Unionink.", "Moda Cad.", "R. do Loureiro"."""

from collections.abc import Iterator, Sequence
from itertools import islice, product
from pathlib import Path
from typing import Final

from models.language.mentions.names import plain_word
from models.language.mentions.word_lists import WordLists

MAX_READINGS: Final = 64  # of one name
MIN_STEM: Final = 3  # letters of a name before an abbreviated ending

_LISTS: Final = WordLists(Path(__file__).parent / "abbreviations.toml")


def _table(name: str) -> dict[str, tuple[str, ...]]:
    table = _LISTS.table(name)
    return {plain_word(short): tuple(plain_word(word) for word in full.split()) for short, full in table.items()}


WORDS: Final = _table("words")
ENDINGS: Final = _table("endings")
_OPTIONAL: Final = frozenset(_table("optional")["words"])


def written_out(words: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """Yield the names that an abbreviated one may be, in plain words; many are no names."""
    options = [(*_full_forms(word), word) for word in words]
    for reading in islice(product(*options), MAX_READINGS):
        if reading != tuple(words):
            yield reading
        if len(reading) > 1 and words[0] in _OPTIONAL:
            yield reading[1:]
            yield (*reading[1:], reading[0])


def is_abbreviated(word: str) -> bool:
    """Return whether a full stop after a word may belong to it."""
    return bool(_full_forms(word))


def _full_forms(word: str) -> list[str]:
    forms = list(WORDS.get(word, ()))
    for ending, full in ENDINGS.items():
        if word.endswith(ending) and len(word) >= MIN_STEM + len(ending):
            forms += [word.removesuffix(ending) + one for one in full]
    return forms
