"""The forms in which people say a street's name: "West 25th Street", "W 25th St", "25th Street", "25th"."""

import re
from collections.abc import Iterator
from typing import Final

from models.language.measures import COMPASS_OF_LETTERS
from models.language.mentions.names import plain_words

# Abbreviations of kinds of streets, from libpostal's English, German and Finnish dictionaries.
TYPES: Final = {
    "st": "street", "str": "street", "strt": "street", "streets": "street", "ave": "avenue", "av": "avenue",
    "aven": "avenue", "avenu": "avenue", "avenues": "avenue", "blvd": "boulevard", "rd": "road", "dr": "drive",
    "ln": "lane", "pl": "place", "sq": "square", "ct": "court", "ter": "terrace", "pkwy": "parkway", "hwy": "highway",
    "expy": "expressway", "plz": "plaza", "xing": "crossing",
}  # fmt: skip
KINDS: Final = frozenset(
    (
        *TYPES.values(),
        "way",
        "alley",
        "row",
        "walk",
        "path",
        "esplanade",
        "circle",
        "loop",
        "bridge",
        "strasse",
        "allee",
        "damm",
    )
)
_COMPASS: Final = frozenset(COMPASS_OF_LETTERS.values())
_SHORT: Final = {"lexington": "lex", "madison": "mad", "broadway": "bway", "americas": "americas"}
_COMPOUND: Final = re.compile(r"(strasse|str)$")
ORDINAL: Final = re.compile(r"\d+(?:st|nd|rd|th)")


def full_words(words: tuple[str, ...]) -> tuple[str, ...]:
    """Return the words of a street with directions and kinds written out; a leading "st" is a saint."""
    ends = (0, len(words) - 1) if len(words) > 1 else ()
    full = [COMPASS_OF_LETTERS.get(word, word) if n in ends else word for n, word in enumerate(words)]
    full = [TYPES.get(word, word) if n else ("saint" if word == "st" else word) for n, word in enumerate(full)]
    return tuple(_COMPOUND.sub("strasse", word) if len(word) > 6 else word for word in full)


def street_forms(name: str) -> Iterator[tuple[tuple[str, ...], float]]:
    """Yield every form of a street's name with the probability that it means this street."""
    full = full_words(plain_words(name))
    yield full, 1.0
    if len(full) < 2:
        if full and full[0] in _SHORT:
            yield (_SHORT[full[0]],), 0.9
        return
    winded = full[0] in _COMPASS and len(full) > 2
    rest = full[1:] if winded else full
    if winded:
        yield rest, 0.95
    kind = (
        rest[-1]
        if rest[-1] in KINDS
        else rest[-2]
        if len(rest) > 2 and rest[-1] in _COMPASS and rest[-2] in KINDS
        else None
    )
    if kind is None:
        return
    if rest[-1] != kind:
        yield rest[:-1], 0.85  # "Hudson Boulevard" of its east side
    bare = tuple(word for word in rest if word != kind)
    if bare and not set(bare) <= _COMPASS and bare != ("the",):
        yield bare, 0.9
        if winded:
            yield (full[0], *bare), 0.95
        if len(bare) == 1 and bare[0] in _SHORT:
            yield (_SHORT[bare[0]],), 0.9
