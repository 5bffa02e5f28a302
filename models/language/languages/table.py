"""The table of a language: its words and phrases for relations, corners, distances and corrections, and its nouns."""

import re
import tomllib
import unicodedata
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from itertools import chain
from pathlib import Path
from typing import Any, Final

from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.mentions.names import plain_words
from models.language.mentions.unspaced import UNSPACED, is_unspaced, unspaced_words

DIRECTORY: Final = Path(__file__).parent
MIN_SHARED: Final = 4  # letters that an inflected word and its base form begin with
MAX_ENDING, MAX_LONG_ENDING = 6, 8  # letters of an inflected word beyond these, and beyond many
MIN_SHORTENED: Final = 6  # letters of a word that may be a shorter form of another
MAX_DROPPED: Final = 3  # letters of a base form beyond these
_SINGLE: Final = str.maketrans({"ß": "s", "æ": "a", "œ": "o", "ø": "o", "ł": "l", "đ": "d", "ı": "i", "İ": "i"})  # noqa: RUF001
LETTER: Final = rf"[^\W{UNSPACED}]"  # next to a letter, a word begins or ends only at a space
_GAP: Final = r"[\s'’-]+"  # noqa: RUF001
_UNSPACED_GAP: Final = r"[\s'’-]*"  # noqa: RUF001
_PARTS: Final = (
    "words",
    "cues",
    "numbers",
    "metres",
    "winds",
    "discourse",
    "nouns",
    "ordinals",
    "streets",
    "addresses",
)
Nouns = Mapping[str, tuple[tuple[str, float], ...]]
Table = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True, slots=True)
class Phrase:
    """A phrase that may stand for a cue; `before` and `after` are its words around the thing."""

    before: re.Pattern[str] | None  # ends where the thing begins
    after: re.Pattern[str] | None  # begins where the thing ends
    alone: re.Pattern[str] | None  # without a thing
    ending: str = ""  # of the thing's last word

    def around(self, folded: str, start: int, end: int) -> tuple[int, int] | None:
        """Return the span of the phrase and the thing at start..end of a folded text; None if it is not there."""
        if self.alone is not None or not folded[start:end].endswith(self.ending):
            return None
        before = None if self.before is None else self.before.search(folded, max(0, start - 80), start)
        after = None if self.after is None else self.after.match(folded, end)
        if (self.before is not None and before is None) or (self.after is not None and after is None):
            return None
        return (before.start() if before else start, after.end() if after else end)


def lower(text: str) -> str:
    """Return a text in lower case, with as many characters."""
    return text.replace("İ", "i").lower()[: len(text)]


@lru_cache(maxsize=256)  # every question about a text folds it
def fold(text: str) -> str:
    """Return a text in lower case without accents, with as many characters."""
    return "".join(
        unicodedata.normalize("NFKD", c)[:1] or c for c in text.translate(_SINGLE).lower().translate(_SINGLE)
    )[: len(text)]


class LanguageTable:
    """The words and phrases of a language, or of several that a text mixes."""

    def __init__(self, codes: tuple[str, ...]) -> None:
        self.codes = codes
        self._tables = [_load(code) for code in codes]
        self.stop = frozenset(
            plain for word in self._joined("words", "stop", " ").split() for plain in plain_words(word)
        )
        self.inflects_names = any(table["words"].get("inflects_names", False) for table in self._tables)
        self.has_capital_nouns = any(table["words"].get("capital_nouns", False) for table in self._tables)
        lists = (self._joined("words", name, " ").split() for name in ("and", "corner", "between", "articles"))
        self.stop |= {plain for words in lists for word in words if "*" not in word for plain in plain_words(word)}
        articles = _words(self._joined("words", "articles", " ").split())
        self._between_words = rf"(?:(?:{articles}){_gap(articles)})" + "{0,3}" if articles else ""
        self.elided_articles = frozenset(self._joined("words", "elided_articles", " ").split())
        self.ands = _pattern(self._joined("words", "and", " ").split(), lower)  # Italian "e" is "and", "è" is "is"
        corners = self._joined("words", "corner", " ").split()
        self.corners = _pattern(corners)
        self.corner_words = {plain for word in corners for plain in plain_words(word.removesuffix("*"))}
        self.between = _pattern(self._joined("words", "between", " ").split())
        self.winds = {
            wind: _pattern(_phrases(self._joined("winds", wind, "|")))
            for wind in ("northeast", "northwest", "southeast", "southwest", "north", "south", "east", "west")
        }
        of_word = _words(self._joined("winds", "of", " ").split())
        self.of_words = re.compile(rf"{_GAP}(?:{of_word})(?!\w)") if of_word else re.compile(r"(?!)")

    @cached_property
    def cues(self) -> dict[str, list[Phrase]]:
        """The phrases of each cue."""
        return {name: self.phrases("cues", name) for table in self._tables for name in table["cues"]}

    @cached_property
    def numbers(self) -> dict[str, float]:
        """Numbers by their words."""
        return {fold(word): float(n) for table in self._tables for word, n in table["numbers"].items()}

    @cached_property
    def ordinals(self) -> dict[str, int]:
        """The numbers of streets by their words: "Quinta" is the fifth."""
        return {fold(word): int(n) for table in self._tables for word, n in table["ordinals"].items()}

    @cached_property
    def street_types(self) -> dict[str, str]:
        """The English kind or wind of a numbered street by its words: "calle" 41 "este" is East 41st Street."""
        return {
            fold(word): kind
            for table in self._tables
            for kind, words in table["streets"].items()
            for word in words.split()
        }

    @cached_property
    def metres(self) -> dict[str, float]:
        """Metres by unit."""
        return {fold(word): float(n) for table in self._tables for word, n in table["metres"].items()}

    def phrases(self, table: str, name: str) -> list[Phrase]:
        """Return the phrases of an entry, long ones first."""
        phrases = sorted(_phrases(self._joined(table, name, "|")), key=len, reverse=True)
        return [self._phrase(phrase) for phrase in phrases]

    def pattern(self, table: str, name: str) -> re.Pattern[str]:
        """Return the pattern of an entry, without its things."""
        return _pattern(phrase.replace("~", "").strip() for phrase in _phrases(self._joined(table, name, "|")))

    def _joined(self, table: str, name: str, separator: str) -> str:
        return separator.join(str(one.get(table, {}).get(name, "")) for one in self._tables)

    def _phrase(self, phrase: str) -> Phrase:
        if "~" not in phrase:
            return Phrase(None, None, _pattern([phrase]))
        before, after = phrase.split("~", 1)
        ending = re.match(f"{LETTER}*", after)
        assert ending is not None
        after = after[ending.end() :]
        letter, gap = _letter(phrase), _gap(phrase)
        lead = rf"(?<!{letter}){_words([before])}(?:{gap}{self._between_words}|{gap})$" if before.strip() else ""
        tail = rf"\s*(?:\w+\s+)?{_words([after])}(?!{letter})" if after.strip() else ""
        return Phrase(re.compile(lead) if lead else None, re.compile(tail) if tail else None, None, fold(ending[0]))

    @cached_property
    def everyday(self) -> frozenset[str]:
        """Everyday words: those that are no names, and those of phrases without a wildcard."""
        phrases = (
            str(entry) for table in self._tables for name in ("cues", "discourse") for entry in table[name].values()
        )
        words = (word for phrase in phrases for word in phrase.replace("|", " ").split() if not set(word) & {"*", "~"})
        lists = (str(table["words"][name]) for table in self._tables for name in ("and", "articles", "corner"))
        more = (word for entry in lists for word in entry.split() if "*" not in word)
        return self.stop | frozenset(plain for word in chain(words, more) for plain in plain_words(word))

    @cached_property
    def nouns(self) -> Nouns:
        """The kinds of each noun, in plain words."""
        vocabulary, nouns = load_vocabulary(), dict[str, tuple[tuple[str, float], ...]]()
        english = vocabulary.nouns("en")
        for code, table in zip(self.codes, self._tables, strict=True):
            for variant in vocabulary.languages:  # zh-CN and zh-TW of zh
                for noun, kinds in vocabulary.nouns(variant).items() if variant.partition("-")[0] == code else ():
                    nouns[" ".join(plain_words(noun))] = kinds
            own = dict[str, dict[str, float]]()
            for noun, words in table["nouns"].items():
                for word in _phrases(words):
                    own.setdefault(" ".join(plain_words(word)), {}).update(english[noun])
            nouns.update((noun, tuple(kinds.items())) for noun, kinds in own.items())
        return nouns

    @cached_property
    def unspaced_nouns(self) -> frozenset[str]:
        """The nouns of scripts without spaces between words."""
        return unspaced_words(self.nouns)

    @cached_property
    def _by_beginning(self) -> dict[str, list[str]]:
        beginnings: dict[str, list[str]] = {}
        for noun in self.nouns:
            beginnings.setdefault(noun[:MIN_SHARED], []).append(noun)
        return beginnings

    def kinds(self, words: tuple[str, ...], *, inflects: bool = True) -> Mapping[str, float]:
        """Return the kinds that a noun means, in any of its forms if it `inflects`, with their weights; often none."""
        noun = " ".join(words)
        if noun not in self.nouns and inflects:
            near = (base for base in self._by_beginning.get(noun[:MIN_SHARED], ()) if _is_form(words, base.split(" ")))
            noun = max(near, key=lambda base: shared_letters(noun, base), default="")
        return dict(self.nouns.get(noun, ()))


def is_inflected(word: str, base: str, *, loosely: bool = False) -> bool:
    """Return whether a word may be a form of another: it differs at the end only, and not by much.

    Next to another word of a name it may do so `loosely`: "kadulla" of "katu".
    """
    shared = shared_letters(word, base)
    dropped, added = len(base) - shared, len(word) - shared
    if dropped and not added and len(word) < MIN_SHORTENED:
        return False
    if word == base or (loosely and shared >= len(base) // 2 and shared > 1 and added <= MAX_ENDING):
        return True
    is_near = dropped <= min(MAX_DROPPED, len(base) // 3) and added <= (MAX_LONG_ENDING if shared >= 10 else MAX_ENDING)
    return is_near and shared >= max(3, min(MIN_SHARED, len(base)))


def _is_form(words: tuple[str, ...], base: list[str]) -> bool:
    return len(words) == len(base) and all(map(is_inflected, words, base))


def shared_letters(one: str, other: str) -> int:
    """Return how many letters two words begin with in common."""
    return next((n for n, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), min(len(one), len(other)))


def _phrases(text: str) -> list[str]:
    return [" ".join(phrase.split()) for phrase in re.split(r"[|\n]", text) if phrase.strip()]


def _words(phrases: Iterable[str], fold: Callable[[str], str] = fold) -> str:
    """Return the expression of one of several phrases; `*` stands for any ending."""
    folded = sorted({fold(phrase).strip() for phrase in phrases if phrase.strip()}, key=len, reverse=True)
    return "|".join(_GAP.join(_word(word) for word in re.split(_GAP, phrase) if word) for phrase in folded)


def _word(word: str) -> str:
    escaped = re.escape(word.removesuffix("*")).replace("ss", "ss?")
    return escaped + r"\w*" if word.endswith("*") else escaped


def _pattern(phrases: Iterable[str], fold: Callable[[str], str] = fold) -> re.Pattern[str]:
    words = _words(phrases, fold)
    letter = _letter(words)
    return re.compile(rf"(?<!{letter})(?:{words})(?!{letter})") if words else re.compile(r"(?!)")


def _letter(phrase: str) -> str:
    """Return the expression of a letter beside which a phrase neither begins nor ends."""
    return LETTER if is_unspaced(phrase) else r"\w"


def _gap(phrase: str) -> str:
    """Return the expression of what is between a phrase and its thing."""
    return _UNSPACED_GAP if is_unspaced(phrase) else _GAP


@cache
def _load(code: str) -> Table:
    path = DIRECTORY / f"{code}.toml"
    table = tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    return {part: table.get(part, {}) for part in _PARTS}


@cache
def load_table(codes: tuple[str, ...]) -> LanguageTable:
    """Load the table of languages, such as ("fi",)."""
    return LanguageTable(codes)


@cache
def table_codes() -> frozenset[str]:
    """Return the codes of the languages with a table."""
    return frozenset(path.stem for path in DIRECTORY.glob("*.toml"))


@cache
def address_words(name: str) -> tuple[str, ...]:
    """Return the expressions of an entry about house numbers in all languages, long ones first."""
    entries = (_load(code)["addresses"].get(name, "") for code in sorted(table_codes()))
    phrases = dict.fromkeys(phrase for entry in entries for phrase in _phrases(entry))
    return tuple(_spaced(phrase) for phrase in sorted(phrases, key=len, reverse=True))


def _spaced(phrase: str) -> str:
    ending = r"(?![^\W\d_])" if phrase[-1].isalpha() else ""
    return re.escape(phrase).replace(r"\ ", r"\s+") + ending
