"""Normalize names (case, accents, apostrophes, articles, ordinals), and list the forms of a street's name."""

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

from anyascii import anyascii

from models.language.measures import COMPASS_OF_LETTERS, ONES, ORDINALS, TENS, ordinal

_WORD = re.compile(r"\d+(?:[-/]\d+)?\w*|[^\W\d_](?:['’`´]?[\w\u0300-\u036f])*|&|@|\+|/")  # noqa: RUF001  # a typeset apostrophe
_APOSTROPHE = re.compile(r"['’`´]")  # noqa: RUF001
_OWNED = re.compile(r"['’`´]s$", re.I)  # noqa: RUF001
ELIDED_ARTICLE: Final = re.compile(r"(?:[dl]|un|(?:a|co|da|de|ne|que|su)ll|quest)['’](?=\w)", re.IGNORECASE)  # noqa: RUF001
ARTICLES: Final = frozenset(("the", "a", "an"))
_SIMPLE: Final = re.compile(r"[a-z]+(?: [a-z]+)*")
_SPELT: Final = frozenset(ORDINALS) | frozenset(TENS)  # the parts of "forty second"

# Abbreviations of kinds of streets, from libpostal's English, German and Finnish dictionaries.
STREET_ABBREVIATIONS: Final = {
    "st": "street", "str": "street", "strt": "street", "streets": "street", "ave": "avenue", "av": "avenue",
    "aven": "avenue", "avenu": "avenue", "avenues": "avenue", "blvd": "boulevard", "rd": "road", "dr": "drive",
    "ln": "lane", "pl": "place", "sq": "square", "ct": "court", "ter": "terrace", "pkwy": "parkway", "hwy": "highway",
    "expy": "expressway", "plz": "plaza", "xing": "crossing",
}  # fmt: skip
_RUSSIAN_KINDS: Final = {
    "ulitsa": "street", "pereulok": "lane", "bulvar": "boulevard", "prospekt": "avenue", "ploshchad": "square",
    "proezd": "drive", "naberezhnaya": "embankment", "shosse": "highway", "tupik": "alley",
}  # fmt: skip
_CYRILLIC_KINDS: Final = (
    "улица", "переулок", "бульвар", "проспект", "площадь", "проезд", "набережная", "шоссе", "тупик", "вулиця",
)  # fmt: skip
_TURKISH_KINDS: Final = ("sokagi", "sokak", "caddesi", "cadde", "bulvari", "yolu", "cikmazi", "meydani")
_OTHER_KINDS: Final = (
    "way", "alley", "row", "walk", "path", "esplanade", "circle", "loop", "bridge", "strasse", "allee", "damm",
)  # fmt: skip
STREET_KINDS: Final = frozenset(
    (*STREET_ABBREVIATIONS.values(), *_RUSSIAN_KINDS, *_CYRILLIC_KINDS, *_TURKISH_KINDS, *_OTHER_KINDS)
)
# Words for kinds of streets that stand before a name, in plain form, with the little words between them and the name
STREET_PREFIXES: Final = frozenset(
    (
        "rue", "avenue", "boulevard", "cours", "place", "quai", "allee", "impasse", "chemin", "passage", "square",
        "pont", "faubourg", "montee", "esplanade", "promenade", "route", "voie", "sentier", "villa",
        "calle", "avenida", "plaza", "paseo", "carrera", "ronda", "carrer", "avinguda", "placa", "passeig",
        "via", "viale", "piazza", "corso", "vicolo", "largo", "salita",
        "rua", "travessa", "praca", "alameda", "estrada", "calcada",
        "ulica", "ul", "aleja", "al", "plac", "pl", "duong", "hem", "jalan", "strada", "bulevardul", "sharia",
        *_RUSSIAN_KINDS, *_CYRILLIC_KINDS, "odos", "leoforos", "plateia", "οδοσ", "λεωφοροσ", "πλατεια",
        "شارع", "طريق", "ميدان", "רחוב", "שדרות", "דרך", "כיכר",
    )
)  # fmt: skip
_LINKS: Final = frozenset(
    (
        "de", "du", "des", "la", "le", "les", "l", "d", "del", "las", "los", "da", "do", "dos", "das", "di", "della",
        "degli", "dei", "of", "the",
    )
)  # fmt: skip
_LETTERS: Final = str.maketrans(
    {"đ": "d", "ð": "d", "ł": "l", "ø": "o", "\u0131": "i", "æ": "ae", "œ": "oe", "þ": "th"}
)
_COMPASS: Final = frozenset(COMPASS_OF_LETTERS.values())
_SHORT: Final = {"lexington": "lex", "madison": "mad", "broadway": "bway", "americas": "americas"}
_COMPOUND: Final = re.compile(r"(strasse|str)$")
# Scripts whose Latin spellings tell the name: Greek, Cyrillic, Armenian, Georgian, Hangul, kana
_SPELT_IN_LATIN: Final = re.compile(r"[\u0370-\u058f\u10a0-\u11ff\u3040-\u30ff\uac00-\ud7af]")
_GREEK: Final = re.compile(r"[\u0370-\u03ff]")
MIN_LAST_NAME_CHARACTERS: Final = 3
ORDINAL: Final = re.compile(r"\d+(?:st|nd|rd|th)")


@dataclass(frozen=True, slots=True)
class Word:
    """A word of a text."""

    plain: str  # in lower case, without accents and apostrophes; ordinals as "42nd"
    start: int
    end: int
    is_capital: bool  # whether it begins with a capital letter
    owner: str = ""  # without the "'s" of "the library's ahead"; empty without "'s"
    begins: bool = False  # whether it is an everyday word that is capitalized because it begins a sentence


def split_words(text: str) -> list[Word]:
    """Split a text into words; "forty second" and "forty-second" are one word."""
    words = [
        Word(plain_word(m[0]), m.start(), m.end(), m[0][:1].isupper() or m[0][:1].isdigit(), _owner(m[0]))
        for m in _WORD.finditer(text)
        if plain_word(m[0])
    ]
    joined: list[Word] = []
    for word in words:
        last = joined[-1] if joined else None
        ones = ORDINALS.get(word.plain, 0) or ONES.get(word.plain, 0)
        if last and last.plain in TENS and 0 < ones < 10 and word.start - last.end == 1:
            joined[-1] = Word(ordinal(TENS[last.plain] + ones), last.start, word.end, last.is_capital)
        elif word.plain in ORDINALS:
            joined.append(Word(ordinal(ORDINALS[word.plain]), word.start, word.end, word.is_capital))
        else:
            joined.append(word)
    return joined


def _owner(word: str) -> str:
    bare = _OWNED.sub("", word)
    if bare == word or not bare:
        return ""
    plain = plain_word(bare)
    return ordinal(ORDINALS[plain]) if plain in ORDINALS else plain


@lru_cache(maxsize=4096)
def plain_words(name: str) -> tuple[str, ...]:
    """Return the normalized words of a name, without a leading article."""
    words = tuple(name.split(" "))
    if not _SIMPLE.fullmatch(name) or not _SPELT.isdisjoint(words):  # fast path: most nouns are simple
        words = tuple(word.plain for word in split_words(name))
    return words[1:] if len(words) > 1 and words[0] in ARTICLES else words


@lru_cache(maxsize=4096)
def plain_word(word: str) -> str:
    """Return a word in lower case, without accents and apostrophes."""
    if word in ("&", "+"):
        return "and"
    bare = _APOSTROPHE.sub("", word)
    if bare.isascii():
        return bare.casefold()
    folded = unicodedata.normalize("NFKD", bare).casefold()
    letters = unicodedata.normalize("NFKD", folded).translate(_LETTERS)
    return "".join(c for c in letters if not unicodedata.combining(c))


def full_words(words: tuple[str, ...]) -> tuple[str, ...]:
    """Return the words of a street with directions and kinds written out; a leading "st" is a saint."""
    ends = (0, len(words) - 1) if len(words) > 1 else ()
    full = [COMPASS_OF_LETTERS.get(word, word) if n in ends else word for n, word in enumerate(words)]
    full[:1] = ["saint" if word == "st" else word for word in full[:1]]
    full[1:] = [STREET_ABBREVIATIONS.get(word, word) for word in full[1:]]
    return tuple(_COMPOUND.sub("strasse", word) if len(word) > 6 else word for word in full)


def latin_spellings(name: str) -> tuple[str, ...]:
    """Return Latin spellings of a name in another script, by its letters and as people write it; often none."""
    if not _SPELT_IN_LATIN.search(name):
        return ()
    spelling = anyascii(name).replace("'", "")
    popular = spelling.replace("oy", "ou") if _GREEK.search(name) else spelling  # Ermou
    popular = re.sub(r"[iy]y\b", "y", popular)  # Chistoprudny
    return tuple(dict.fromkeys((spelling, popular)))


def street_forms(name: str) -> Iterator[tuple[tuple[str, ...], float]]:
    """Yield every form of a street's name with the probability that it means this street."""
    for spelling in latin_spellings(name):
        yield from street_forms(spelling)
        kinds = [_RUSSIAN_KINDS[word] for word in plain_words(spelling) if word in _RUSSIAN_KINDS]
        yield (*(word for word in plain_words(spelling) if word not in _RUSSIAN_KINDS), *kinds[:1]), 0.9
    full = full_words(plain_words(name))
    yield full, 1.0
    yield from _without_prefix(plain_words(name))
    if len(full) < 2:
        if full and full[0] in _SHORT:
            yield (_SHORT[full[0]],), 0.9
        return
    winded = full[0] in _COMPASS and len(full) > 2
    rest = full[1:] if winded else full
    if winded:
        yield rest, 0.95
    if rest[-1] in STREET_KINDS:
        kind = rest[-1]
    elif len(rest) > 2 and rest[-1] in _COMPASS and rest[-2] in STREET_KINDS:
        kind = rest[-2]
    else:
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


def _without_prefix(words: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], float]]:
    """Yield "emile zola" and "zola" of "cours emile zola", and "faubourg poissonniere" with and without its prefix."""
    rest = words
    while len(rest) > 1 and rest[0] in STREET_PREFIXES:
        rest = rest[1:]
        while len(rest) > 1 and rest[0] in _LINKS:
            rest = rest[1:]
        if len(rest[0]) >= MIN_LAST_NAME_CHARACTERS or len(rest) > 1:
            yield rest, 0.9
    if rest is not words and len(rest) > 1 and len(rest[-1]) > MIN_LAST_NAME_CHARACTERS and not rest[-1].isdecimal():
        yield rest[-1:], 0.6  # people say the last name only: "Pressensé" of Rue Francis de Pressensé
