"""House numbers as people write them and as maps have them: "46" of "46-48", "52 B" or "52B", "3 B 14"."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final

from models.language.languages.table import address_words
from models.language.mentions.unspaced import UNSPACED
from models.language.mentions.word_lists import english

MAX_RANGE: Final = 40  # between the ends of "46-48"; more is a block and a house, such as "1-296"
MAX_FRACTION: Final = 8  # between the ends of "16/18"; more is a corner or a flat


def _pattern(name: str) -> str:
    return "|".join((english().text("addresses", name), *address_words(name)))


_LETTER = r"[^\W\d_]"
_PART = rf"\d{{1,5}}{_LETTER}?(?!\w)"
# A letter apart is large, or ends the address: "52 B is", "52 b."; a flat may follow it.
_APART = r"(?-i:(?!I)[A-ZА-Я](?![\w'’.]\w)(?!\w)|(?![ai])[a-zа-я](?=\s*(?:[,;.!?)\n]|$|\d)))"  # noqa: RUF001
_FLAT = rf"(?<=[^\W\d])\s+\d{{1,4}}(?!\w|\.\d)|,?\s+(?:{_pattern('flat')})\.?\s?#?\w{{1,5}}\b"
_NUMBER = (
    rf"(?P<number>{_PART}(?:\s?[-–/;+]\s?(?:{_PART}|{_LETTER}(?!\w)))*"  # noqa: RUF001
    rf"(?:\s?(?:bis|ter|quater)\b|\s(?:{_APART}))?(?:\s?(?:с|стр\.?|к|корп\.?)\s?\d+)?|\d{{1,5}}\s?[號号])"  # noqa: RUF001
    rf"(?:{_FLAT})?"
    rf"(?:(?<=[號号])|(?![\w-]))(?![.:]\d|\s*(?:{_pattern('counted')}))"
)
_MARK = rf"(?P<mark>(?:(?:{_pattern('mark')})\s*){{1,2}})"
_OTHER = re.compile(rf"\b(?:{_pattern('other')})\s+$", re.IGNORECASE)
_LINK = rf"(?P<link>\s*,\s*|\s+(?:{_pattern('on')})(?:\s*,\s*|\s+|(?<=['’]))|\s+)"  # noqa: RUF001
_BEFORE = re.compile(rf"(?<![\w.,/-])(?<!\d[ ,]){_MARK}?{_NUMBER}{_LINK}$", re.IGNORECASE)
_AFTER = re.compile(
    rf"\s*(?P<comma>,)?(?:\s+|(?<=[{UNSPACED}])){_MARK}?{_NUMBER}(?!\s*(?:and|&|/)\s*\d)", re.IGNORECASE
)
_LONGEST = 40  # characters of a number with its mark before a street
_HOUSE_FOLLOWS = re.compile(rf"(?:^|[.,;:!?\n]|\b(?:{_pattern('before')}))\s*$", re.IGNORECASE)
_END = re.compile(r"\s*(?:[.,;!?)\n]|$)")
_OPPOSITE = english().text("addresses", "opposite")
_APART_FROM_STREET = re.compile(rf"\b(?:(?:{_pattern('door')})|(?P<loose>{_OPPOSITE}))\s*{_NUMBER}", re.IGNORECASE)
_ALONE = re.compile(rf"\s*{_MARK}?{_NUMBER}\s*", re.IGNORECASE)
_LEADING, _GLUE = re.compile(r"\d+"), re.compile(r"[\s`.號号]|(?<=\d)стр|корп")
_RANGE = re.compile(rf"(\d+){_LETTER}?(?:([-/])(\d+){_LETTER}?)?")


@dataclass(frozen=True, slots=True)
class WrittenNumber:
    """A house number in a text; the flat after it is inside the span."""

    number: str
    start: int  # of its mark, as "number", if there is one
    end: int


@dataclass(frozen=True, slots=True)
class NumberMatch:
    """The house numbers of a street that a written one means."""

    numbers: tuple[str, ...]
    is_whole: bool = True  # False if the map lacks the letter
    # Without numbers: the nearest lower and the nearest higher on the same side, each in digits and as the map has it.
    between: tuple[tuple[int, tuple[str, ...]], ...] = ()


def number_beside(text: str, start: int, end: int) -> WrittenNumber | None:
    """Return the house number before or after a street at start..end."""
    low = max(0, start - _LONGEST)
    before = _BEFORE.search(text, low, start) if start else None
    if before is not None and _is_number_before(text, before):
        return WrittenNumber(before["number"], before.start(), before.end("number"))
    after = _AFTER.match(text, end)
    if after is None or (after["comma"] and not after["mark"] and not _END.match(text, after.end())):
        return None
    return WrittenNumber(after["number"], after.start("number"), after.end())


def numbers_apart(text: str) -> list[tuple[WrittenNumber, bool]]:
    """Return the house numbers of streets that are not beside them: "the door of 331", "opposite, 328".

    The second is whether words such as "door" show that it is one.
    """
    return [
        (WrittenNumber(match["number"], match.start("number"), match.end()), match["loose"] is None)
        for match in _APART_FROM_STREET.finditer(text)
        if match["loose"] is None or _END.match(text, match.end())
    ]


def number_alone(text: str) -> str | None:
    """Return the house number that a text is; None if it is something else."""
    match = _ALONE.fullmatch(text)
    return None if match is None else match["number"]


def plain_number(number: str) -> str:
    """Return a house number in lower case, without spaces."""
    return _GLUE.sub("", number.lower().replace("–", "-"))  # noqa: RUF001


def match_number(written: str, known: Iterable[str]) -> NumberMatch | None:
    """Return the numbers of a street that a written one means; None if it lies beyond them."""
    plain = {number: plain_number(number) for number in known}
    wanted = plain_number(written)
    same = tuple(number for number, form in plain.items() if form == wanted)
    if same:
        return NumberMatch(same)
    parts = [part for part in re.split(r"[;+]", wanted) if part[:1].isdecimal()]
    values = {value for part in parts for value in _members(part)}
    members = {number: _members(form) for number, form in plain.items()}
    hits = tuple(number for number, numbers in members.items() if not values.isdisjoint(numbers))
    if hits:
        return NumberMatch(hits, is_whole=all(_RANGE.fullmatch(part) and part[-1].isdecimal() for part in parts))
    value = min(values, default=0)
    side = {n for numbers in members.values() for n in numbers if n % 2 == value % 2}
    below, above = max((n for n in side if n < value), default=None), min((n for n in side if n > value), default=None)
    if below is None or above is None:
        return None
    between = ((n, tuple(number for number, numbers in members.items() if n in numbers)) for n in (below, above))
    return NumberMatch((), is_whole=False, between=tuple(between))


def first_value(number: str) -> int:
    """Return the leading digits of a house number; -1 without any."""
    digits = _LEADING.match(number)
    return int(digits[0]) if digits else -1


def _members(number: str) -> Sequence[int]:
    """Return the numbers of a house: 46 and 48 of "46-48", 14 of "14/2с1"."""  # noqa: RUF002
    whole = _RANGE.fullmatch(number)
    if whole is None or whole[3] is None:
        value = first_value(number)
        return () if value < 0 else (value,)
    low, high = int(whole[1]), int(whole[3])
    is_even = (high - low) % 2 == 0
    is_range = low < high <= low + MAX_RANGE if whole[2] == "-" else is_even and low < high <= low + MAX_FRACTION
    return range(low, high + 1, 2 if is_even else 1) if is_range else (low,)


def _is_number_before(text: str, match: re.Match[str]) -> bool:
    before = text[: match.start()]
    if _OTHER.search(before):  # "tram 6 Bulevardi"
        return False
    return match["link"].isspace() or match["mark"] is not None or _HOUSE_FOLLOWS.search(before) is not None
