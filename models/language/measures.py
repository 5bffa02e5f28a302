"""The one parser of numbers, measures and compass directions in English text.

Hints, mentions and plurals use it. Its words and units are tables of `mentions/english.toml`.
"""

import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final, Protocol, TypeVar

from models.language.mentions.word_lists import english

MAX_MEASURE_M: Final = 1e5  # no map is wider, so a longer distance is ignored
MAX_GAP_CHARACTERS: Final = 80  # between a measure and the span it belongs to
VAGUE_FEW_FACTOR: Final = 3.0  # "a few" of a measured unit, such as metres, is this much more than "a few blocks"
COMPASS: Final = ("north", "northeast", "east", "southeast", "south", "southwest", "west", "northwest")
COMPASS_OF_LETTERS: Final = {
    "n": "north", "e": "east", "s": "south", "w": "west", "ne": "northeast", "nw": "northwest",
    "se": "southeast", "sw": "southwest",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Number:
    """A number in a text."""

    start: int
    end: int
    value: float
    is_vague: bool = False  # whether it is a word such as "few"
    is_article: bool = False  # whether it is the "a" of "a block"


@dataclass(frozen=True, slots=True)
class Measure:
    """A distance in a text."""

    start: int
    end: int
    metres: float
    is_loose: bool = False  # whether its number is vague or its unit is blocks, doors or minutes
    is_of: bool = False  # whether the reference follows it: "30 m short of the bridge"

    def contains(self, span: "CharacterSpan") -> bool:
        """Return whether a span is part of the measure, such as its unit."""
        return self.start <= span.start and span.end <= self.end


@dataclass(frozen=True, slots=True)
class Bearing:
    """A compass direction in a text."""

    start: int
    end: int
    degrees: float  # clockwise from north
    is_of: bool = False  # whether it is "north of" something


class CharacterSpan(Protocol):
    """A span of characters in a text, without the one at `end`."""

    @property
    def start(self) -> int: ...  # noqa: D102

    @property
    def end(self) -> int: ...  # noqa: D102


@dataclass(frozen=True, slots=True)
class TextSpan:
    """A span of characters without a meaning yet."""

    start: int
    end: int


def overlaps(one: CharacterSpan, others: Iterable[CharacterSpan]) -> bool:
    """Return whether a span shares a character with any of the others."""
    return any(one.start < other.end and other.start < one.end for other in others)


Fact = TypeVar("Fact", Measure, Bearing)

_WORDS = english()
_NUMBERS = _WORDS.table("numbers")
ONES: Final[dict[str, int]] = {word: n for n, word in enumerate(_NUMBERS["ones"].split())}
TENS: Final[dict[str, int]] = {word: 10 * n for n, word in enumerate(_NUMBERS["tens"].split(), 2)}
ORDINALS: Final[dict[str, int]] = {word: n for n, word in enumerate(_NUMBERS["ordinals"].split(), 1)} | {
    f"{word[:-1]}ieth": n for word, n in TENS.items()
}
_VAGUE: Final[Mapping[str, float]] = _NUMBERS["vague"]
_SCALES: Final = {"dozen": 12, "hundred": 100, "thousand": 1000}
_PARTS: Final = {"half": 2, "quarter": 4} | {word: n for word, n in ORDINALS.items() if n > 2}


def _any_of(words: Iterable[str]) -> str:
    return rf"(?:{'|'.join(sorted(words, key=len, reverse=True))})\b"


# Numbers in words: from 1 to 9, below 100, below 1000, and all.
_GAP = r"[\s-]+"
_ONE = _any_of(word for word, n in ONES.items() if 0 < n < 10)
_BELOW_100 = rf"(?:{_any_of(TENS)}(?:{_GAP}{_ONE})?|{_any_of(word for word, n in ONES.items() if n)})"
_AND = rf"{_GAP}(?:and{_GAP})?"
_BELOW_1000 = rf"(?:(?:(?:an?|{_BELOW_100}){_GAP})?hundred\b(?:{_AND}{_BELOW_100})?|{_BELOW_100})"
_DOZENS = rf"(?:(?:half{_GAP}an?|an?|{_BELOW_100}){_GAP})?dozen\b"
_SPOKEN = rf"{_DOZENS}|(?:(?:an?|{_BELOW_1000}){_GAP})?thousand\b(?:{_AND}{_BELOW_1000})?|{_BELOW_1000}|zero\b"
# Numbers in digits: thousands in groups, or a decimal comma or point.
_GROUP_MARK = re.compile(r"[,\u00a0\u202f\u2009]")
_GROUPED = rf"\d{{1,3}}(?:{_GROUP_MARK.pattern}\d{{3}})+(?![\d,])(?:\.\d+)?"
_FRACTION = r"(?:[1-8]/[2-9](?![\d/])|[¼½¾⅓⅔])"
_PART = rf"(?:half|quarters?)\b|{_any_of(f'{word}s?' for word in _PARTS)}(?={_GAP}of{_GAP}an?\b)"
_NUMBER = re.compile(
    rf"(?<!\w)(?<!\d[.,/])(?:"
    rf"(?P<vague>(?:an?{_GAP})?(?P<few>{_any_of(_VAGUE)})(?:{_GAP}of\b)?(?:{_GAP}(?P<scale>{_any_of(_SCALES)}))?)"
    rf"|(?!{_DOZENS})(?:(?P<parts>an?|{_ONE}){_GAP})?(?P<part>{_PART})(?:{_GAP}of)?(?:{_GAP}an?\b)?"
    rf"|(?P<fraction>{_FRACTION})(?:{_GAP}of)?(?:{_GAP}an?\b)?"
    rf"|(?P<words>{_SPOKEN})(?:{_GAP}point(?P<decimals>(?:{_GAP}(?:zero\b|{_ONE}))+))?"
    rf"|(?:(?P<grouped>{_GROUPED})|(?P<digits>\d+(?:[.,]\d+)?))(?:[\s-]?(?P<rest>{_FRACTION}))?"
    rf"|(?P<article>an?)(?=[\s-]))"
    rf"(?:{_GAP}and{_GAP}(?P<more>an?|{_ONE}){_GAP}(?P<share>half|quarters?|thirds?)\b)?",
    re.IGNORECASE,
)
# Measures: a unit behind a number, and what tells a distance from a size, a time or a thing.
_MEASURES = _WORDS.table("measures")
_LOOSE, _MINUTES = _WORDS.list("loose_units"), frozenset(("minute", "min"))
_THINGS, _COUNTED = frozenset(_MEASURES["things"].split()), frozenset(_MEASURES["counted"].split())
_RANGE = re.compile(r"\s*[-–—]\s*|\s+(?:to|or|of)\s+|(?P<and>\s+and\s+)")  # noqa: RUF001  # dashes of print
_BETWEEN = re.compile(r"\bbetween\s+$", re.IGNORECASE)
_UNIT = re.compile(
    rf"(?:(?:(?<=[\d¼½¾⅓⅔])[\s-]*|{_GAP})(?:{_any_of(_MEASURES['fillers'].split(','))}{_GAP})?"
    rf"(?P<unit>{'|'.join(sorted(_WORDS.metres, key=len, reverse=True))})e?s?(?!\w)"
    r"|(?<=\d)(?P<foot>['′’])(?![\w'’]))"  # noqa: RUF001  # signs of feet
    r"(?:\s+and\s+an?\s+(?P<half>half|quarter)\b|\s+or\s+(?P<or>two|three)\b)?",
    re.IGNORECASE,
)
_AWAY, _WALK, _SIZE, _FROM = (
    _WORDS.pattern("measures", name, r"['\u2019]?[\s-]+(?:{})\b") for name in ("away", "walk", "size", "from")
)
_WITHIN = _WORDS.pattern("measures", "within", r"\b(?:{})\s+(?:[a-z]+\s+)?$")
_INSIDE = re.compile(r"\b(?:in|into|inside|across|through)\s+$", re.IGNORECASE)  # a yard, say
_OF_WORD = re.compile(r"\s+of\b", re.IGNORECASE)
_STRIDES: Final = frozenset(("step", "pace"))
_SENTENCE_END = re.compile(r"[.;!?\n]\s")
_PAUSE = re.compile(r"\s*[,)]|\s+and\b", re.IGNORECASE)
_QUOTE = re.compile(r"(?<!\w)['‘’]\w")  # noqa: RUF001
_CLAUSE_END = re.compile(r"\s*(?:[.,;:!?)]|$)")
# Compass directions: 16 points in words, and in letters where they are no part of a street's name.
_POINTS = ["n", "nne", "ne", "ene", "e", "ese", "se", "sse", "s", "ssw", "sw", "wsw", "w", "wnw", "nw", "nnw"]
_SIDE = re.compile("north|south|east|west", re.IGNORECASE)
_SIDES = {"n": "north", "e": "east", "s": "south", "w": "west"}


def _point_in_words(letters: str) -> str:
    words = [_SIDES[letter] for letter in letters]
    return rf"{words[0]}[\s-]{words[1]}[\s-]?{words[2]}" if len(words) == 3 else r"[\s-]?".join(words)


COMPASS_WORD: Final = "|".join(_point_in_words(letters) for letters in sorted(_POINTS, key=len, reverse=True))
_LETTERS = "|".join(letters.upper() for letters in sorted(_POINTS, key=len, reverse=True) if len(letters) > 1)
_BEARING = re.compile(
    rf"\b(?P<words>(?i:{COMPASS_WORD}))(?i:ern|erly|wards?|bound)?\b"
    rf"|\b(?P<letters>(?:{_LETTERS})\b(?!\.?\s+[A-Z\d])"
    rf"|[NESW]\b(?=\s+of\b)"
    rf"|(?:(?<=\bdue )|(?<=\bthe )|(?<=\bmy )|(?<=\d m ))[NESW]\b"
    rf"(?=\s+(?:and|side|end|corner)\b|{_CLAUSE_END.pattern}))"
)
_OF_A_PLACE = re.compile(
    r"(?:\s+(?:side|end|corner))?\s+(?:of|from|to)\b(?!\s+(?:me|us|it|here|this|you|there|where|that)\b)", re.IGNORECASE
)


def find_numbers(text: str) -> list[Number]:
    """Return the numbers in a text, including "a few", "half a" and the "a" of "a block"."""
    return [
        Number(match.start(), match.end(), _value(match), bool(match["vague"]), bool(match["article"]))
        for match in _NUMBER.finditer(text)
    ]


@lru_cache(maxsize=256)  # hints, streets, addresses and cues all need those of the same text
def find_measures(text: str) -> tuple[Measure, ...]:
    """Return the distances in a text, without sizes, times, house numbers and names."""
    measures, numbers = list[Measure](), find_numbers(text)
    for n, number in enumerate(numbers):
        unit = _UNIT.match(text, number.end)
        if unit is None or not _is_distance(text, number, unit):
            continue
        low = _low_end(text, numbers[n - 1], number) if n else number
        name = (unit["unit"] or "ft").lower()
        count = (low.value + number.value) / 2
        count += 1 / _PARTS[unit["half"].lower()] if unit["half"] else 0.0
        count = (count + ONES[unit["or"].lower()]) / 2 if unit["or"] else count
        if number.is_vague and number.value < 12 and name not in _LOOSE and name not in _STRIDES:
            count *= VAGUE_FEW_FACTOR
        metres = count * _WORDS.metres[name]
        if metres <= MAX_MEASURE_M:
            is_of = _FROM.match(text, unit.end()) is not None
            measures.append(Measure(low.start, unit.end(), metres, number.is_vague or name in _LOOSE, is_of))
    return tuple(measures)


def find_bearings(text: str) -> list[Bearing]:
    """Return the compass directions in a text."""
    return [
        Bearing(match.start(), match.end(), _degrees(match), _OF_A_PLACE.match(text, match.end()) is not None)
        for match in _BEARING.finditer(text)
    ]


def first_bearing(words: str) -> float | None:
    """Return the first compass direction in a text, in degrees; None if there is none."""
    bearings = find_bearings(words)
    return bearings[0].degrees if bearings else None


def compass_name(degrees: float) -> str:
    """Return the nearest of the eight compass directions."""
    return COMPASS[round((degrees % 360) / 45) % 8]


def ordinal(number: int) -> str:
    """Return a number as an ordinal: 42 is "42nd"."""
    if 10 < number % 100 < 14:
        return f"{number}th"
    return f"{number}" + {1: "st", 2: "nd", 3: "rd"}.get(number % 10, "th")


def match_facts_to_spans(text: str, facts: Sequence[Fact], spans: Sequence[CharacterSpan | None]) -> dict[int, Fact]:
    """Assign each fact to the nearest span, at most one fact per span, by the index of the span.

    A fact inside a span is part of a name; a span inside a fact is its unit. None is a span that takes no fact.
    """
    pairs = sorted(
        (distance_in_text(text, fact, span), k, n)
        for k, fact in enumerate(facts)
        if not any(span.start <= fact.start and fact.end <= span.end for span in spans if span is not None)
        for n, span in enumerate(spans)
        if span is not None and not (fact.start <= span.start and span.end <= fact.end)
    )
    matched: dict[int, Fact] = {}
    used: set[int] = set()
    for gap, k, n in pairs:
        if gap < MAX_GAP_CHARACTERS and n not in matched and k not in used:
            matched[n] = facts[k]
            used.add(k)
    return matched


def distance_in_text(text: str, fact: Measure | Bearing, span: CharacterSpan) -> int:
    """Return the number of characters between a fact and a span.

    The end of a sentence or clause adds to it, and so does a fact whose reference follows if the span precedes.
    """
    is_before = fact.start < span.start
    start, end = (fact.end, span.start) if is_before else (span.end, fact.start)
    is_far = _SENTENCE_END.search(text, start, max(start, end)) is not None or (fact.is_of and not is_before)
    is_over = is_before and _PAUSE.match(text, fact.end) is not None
    extra = (MAX_GAP_CHARACTERS // 2 if is_far else 0) + (MAX_GAP_CHARACTERS // 4 if is_over else 0)
    return max(0, end - start) + extra


def _value(match: re.Match[str]) -> float:
    """Return the value of a match of _NUMBER."""
    more = _count(match["more"]) / _PARTS[_singular(match["share"])] if match["more"] else 0.0
    if match["vague"]:
        return _VAGUE[match["few"].lower()] * (_SCALES[match["scale"].lower()] if match["scale"] else 1) + more
    if match["part"]:
        return _count(match["parts"] or "a") / _PARTS[_singular(match["part"])] + more
    if match["fraction"]:
        return _share(match["fraction"]) + more
    if match["words"]:
        tenths = "".join(str(ONES[word]) for word in re.findall(r"[a-z]+", (match["decimals"] or "").lower()))
        return _in_words(match["words"]) + float(f"0.{tenths or 0}") + more
    digits = _GROUP_MARK.sub("", match["grouped"]) if match["grouped"] else (match["digits"] or "1").replace(",", ".")
    return float(digits) + (_share(match["rest"]) if match["rest"] else 0.0) + more


def _count(word: str) -> int:
    return ONES.get(word.lower(), 1)


def _singular(word: str) -> str:
    return word.lower().removesuffix("s")


def _share(fraction: str) -> float:
    over, slash, under = fraction.partition("/")
    return int(over) / int(under) if slash else unicodedata.numeric(fraction)


def _in_words(words: str) -> float:
    """Return the value of a number in words."""
    thousands, rest = 0.0, 0.0
    for word in re.findall(r"[a-z]+", words.lower()):
        if word == "half":
            rest = 0.5
        elif word in _SCALES:
            rest = (rest or 1.0) * _SCALES[word]
            if word == "thousand":
                thousands, rest = rest, 0.0
        else:
            rest += ONES.get(word, TENS.get(word, 0))
    return thousands + rest


def _low_end(text: str, before: Number, number: Number) -> Number:
    """Return the number that begins a range: 10 of "10 to 15 metres"; the number itself if there is none."""
    to = _RANGE.fullmatch(text, before.end, number.start)
    is_range = to is not None and (to["and"] is None or _BETWEEN.search(text, 0, before.start) is not None)
    return before if is_range and 0 < before.value < number.value <= 10 * before.value else number


def _is_distance(text: str, number: Number, unit: re.Match[str]) -> bool:
    """Return whether a number and a unit are a distance, not a size, time, thing or name."""
    end, name = unit.end(), (unit["unit"] or "ft").lower()
    if name in _MINUTES:
        return _WALK.match(text, end) is not None
    if unit["foot"] is not None and not _is_foot(text, number):
        return False
    if _SIZE.match(text, end) or (_OF_WORD.match(text, end) and _WITHIN.search(text[: number.start]) is None):
        return False
    is_away = _AWAY.match(text, end) is not None or unit["or"] is not None
    if len(name) > 2 and unit["unit"][0].isupper() and unit["unit"][1:].islower():  # a Foot Locker, 2 Miles Gallery
        ends = text[number.start].isdecimal() and _CLAUSE_END.match(text, end) is not None
        return is_away or ends or _BEARING.match(text, end + 1) is not None
    if number.is_article and ((len(name) < 3 and name != "km") or _INSIDE.search(text, 0, number.start) is not None):
        return False
    is_some = number.is_article or text[number.start : number.end].lower() == "some"
    return is_away or not (name in _COUNTED or (is_some and name in _THINGS))


def _is_foot(text: str, number: Number) -> bool:
    """Return whether the mark after a number means feet, not minutes of arc or the end of a quotation."""
    is_degree = text[: number.start].rstrip().endswith("°") or not text[number.start : number.end].isdecimal()
    return not is_degree and _QUOTE.search(text, 0, number.start) is None


def _degrees(match: re.Match[str]) -> float:
    letters = match["letters"] or "".join(side[0] for side in _SIDE.findall(match["words"]))
    return 360.0 / len(_POINTS) * _POINTS.index(letters.lower())
