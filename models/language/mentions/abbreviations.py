"""Abbreviated names of streets in the languages of cities: "Unionink.", "Moda Cad.", "ул. Покровка", "R. do Loureiro"."""

from collections.abc import Iterator, Sequence
from itertools import islice, product
from typing import Final

from models.language.mentions.names import plain_word

MAX_READINGS: Final = 64  # of one name
MIN_STEM: Final = 3  # letters of a name before an abbreviated ending

# After libpostal's dictionaries. Words without accents, as `plain_word` writes them.
WORDS: Final = {
    plain_word(short): tuple(plain_word(word) for word in full.split())
    for short, full in {
        "k": "katu kuja", "t": "tie", "g": "gatan gasse", "v": "vägen via", "esplan": "esplanadi", "espl": "esplanadi",
        "p": "pohjois", "e": "etelä", "it": "itäinen", "l": "läntinen largo", "n": "norra", "s": "södra",
        "str": "straße strasse", "pl": "platz place plac plaza", "cad": "caddesi", "cd": "caddesi",
        "sok": "sokak sokağı", "sk": "sokak sokağı", "bulv": "bulvarı", "blv": "bulvarı", "meyd": "meydanı",
        "ul": "ulica", "al": "aleja aleje", "av": "avenida avenue", "ave": "avenida avenue", "avda": "avenida",
        "bd": "boulevard", "bld": "boulevard", "bvd": "boulevard", "boul": "boulevard", "r": "rue rua",
        "imp": "impasse", "crs": "cours", "fbg": "faubourg", "fg": "faubourg", "ch": "chemin", "pass": "passage",
        "tv": "travessa", "trav": "travessa", "pc": "praça", "pr": "praça", "pca": "praça", "lg": "largo",
        "c": "calle", "cl": "calle", "cra": "carrera", "kr": "carrera", "ул": "улица",
        "пер": "переулок", "пр": "проспект проезд", "просп": "проспект", "пл": "площадь", "наб": "набережная",
        "бул": "бульвар", "đ": "đường", "st": "saint sankt", "ste": "sainte", "dr": "doktor", "gen": "generała",
    }.items()
}  # fmt: skip
ENDINGS: Final = {
    "k": ("katu", "kuja", "kaari"), "t": ("tie",), "g": ("gatan", "gasse"), "v": ("vagen",), "r": ("ranta",),
    "str": ("straße", "strasse"), "pl": ("platz",), "gt": ("gate", "gata"), "tr": ("tori",), "esplan": ("esplanadi",),
}  # fmt: skip
_OPTIONAL: Final = frozenset(("ul", "улица", "ул", "ulica"))  # maps leave them out, or write them last


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
