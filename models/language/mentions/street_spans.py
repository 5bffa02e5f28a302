"""Decide whether words name streets; short forms do only next to certain words."""

from collections.abc import Sequence
from typing import Final

from models.language.languages.table import LanguageTable
from models.language.measures import COMPASS_OF_LETTERS, ordinal
from models.language.mentions.lookup import Lookup, Match
from models.language.mentions.names import ORDINAL, STREET_ABBREVIATIONS, STREET_KINDS, Word
from models.language.mentions.word_lists import english

STREET_SCORE, TYPE_SCORE, WORD_SCORE = 5.0, 2.0, 3.0  # scores of street spans
MEETING_SCORE: Final = 3.0  # of a street next to a numbered one
ARTICLES_OF_STREETS: Final = frozenset(("la", "a", "na", "da", "le", "die", "der"))  # before its number alone: "la 41"
WINDS: Final = frozenset(("north", "east", "south", "west"))
_MEET: Final = frozenset(("and", "at", "&", "@", "/", "n"))
_W = english()
_STREET_BEFORE, _STREET_AFTER = _W.list("street_before"), _W.list("street_after")
_NO_STREET_AFTER, _LOWER_BEFORE = _W.list("no_street_after"), _W.list("lower_street_before")
_SAID_OF = _W.list("said_of_street")


def match_street(
    words: Sequence[Word],
    first: int,
    last: int,
    plain: tuple[str, ...],
    lookup: Lookup,
    table: LanguageTable | None = None,
) -> tuple[Match, float] | None:
    """Return the streets of a name; of a short form, such as an ordinal, only next to words that go with streets.

    In a language with a `table`, names are inflected ("Mannerheimintiellä"), numbered streets translated ("calle 41").
    """
    if len(plain) == 1 and plain[0].isdecimal() and table is None:
        return None
    has_type = plain[-1] in STREET_KINDS or plain[-1] in STREET_ABBREVIATIONS
    match = lookup.street(plain)
    if match is None and has_type and len(plain) > 1 and plain[-2].isdecimal() and plain[-2].isascii():
        match = lookup.street((*plain[:-2], ordinal(int(plain[-2])), plain[-1]))
    if match is None and table is not None:
        numbered = _numbered(words, first, plain, lookup, table)
        if numbered is not None:
            return numbered, STREET_SCORE + WORD_SCORE * len(plain) + TYPE_SCORE
        is_noun = len(plain) == 1 and bool(table.kinds(plain))  # Finnish "kirkko", a church, is not Kirkkokatu
        match = lookup.street_form(plain, not is_noun)
    if match is None and len(plain) == 1:
        match = lookup.street_like(plain[0])
    if match is None or not _is_meant(words, first, last, match, has_type, lookup, inflects=table is not None):
        return None
    score = STREET_SCORE + WORD_SCORE * len(plain) + (TYPE_SCORE if has_type else 0.0)
    return match, score + (MEETING_SCORE if _meets_ordinal(words, first, last) else 0.0)


def _numbered(
    words: Sequence[Word], first: int, plain: tuple[str, ...], lookup: Lookup, table: LanguageTable
) -> Match | None:
    """Return a numbered street of an English-speaking city: "calle 41", "la Quinta", "la 30 oeste"."""
    rest = [word for word in plain if word not in table.street_types]
    types = [table.street_types[word] for word in plain if word in table.street_types]
    winds = tuple(one for one in types if one in WINDS)
    kinds = [one for one in types if one not in WINDS]
    if len(rest) != 1 or not (kinds or _is_street_number(words, first, first + len(plain) - 1, table)):
        return None
    number = table.ordinals.get(rest[0]) or (int(rest[0]) if rest[0].isdecimal() and len(rest[0]) < 4 else None)
    if number is None or len(winds) > 1:
        return None
    kind = kinds[0] if kinds else "street" if rest[0].isdecimal() else "avenue"
    return lookup.street((*winds, ordinal(number), kind)) or lookup.street((ordinal(number), kind))


def _is_street_number(words: Sequence[Word], first: int, last: int, table: LanguageTable) -> bool:
    """Return whether a number alone is a street: "la 41", and "con 43" at the end of a phrase."""
    before = words[first - 1].plain if first else ""
    is_joined = table.ands.fullmatch(before) or table.corners.fullmatch(before)
    is_end = last + 1 == len(words) or words[last + 1].start - words[last].end > 1
    return before in ARTICLES_OF_STREETS or bool(is_joined and is_end)


def _meets_ordinal(words: Sequence[Word], first: int, last: int) -> bool:
    """Return whether words are next to a numbered street: "Vanderbilt and 43rd"."""
    after = last + 2 < len(words) and words[last + 1].plain in _MEET and ORDINAL.fullmatch(words[last + 2].plain)
    before = first > 1 and words[first - 1].plain in _MEET and ORDINAL.fullmatch(words[first - 2].plain)
    return bool(after or before)


def _is_meant(
    words: Sequence[Word], first: int, last: int, match: Match, has_type: bool, lookup: Lookup, *, inflects: bool
) -> bool:
    plain = [word.owner or word.plain for word in words[first : last + 1]]
    is_ordinal = ORDINAL.fullmatch(plain[-1]) is not None
    is_capital = words[first].is_capital or words[first].begins
    has_wind = last > first and is_ordinal and plain[0] in COMPASS_OF_LETTERS.keys() | COMPASS_OF_LETTERS.values()
    whole = match.is_exact and (last > first or words[first].is_capital or not lookup.is_common(plain[-1]))
    follower = words[last + 1] if last + 1 < len(words) else None
    if not has_type and not has_wind and not (whole and not is_ordinal):
        before, after = words[first - 1].plain if first else "", follower.plain if follower else ""
        is_name = is_ordinal or is_capital
        is_noun = not is_ordinal and plain[-1] in lookup.noun_words
        is_subject = (
            is_name and not is_noun and before != "the" and (after in _SAID_OF or words[last].owner is not None)
        )
        has_cue = (
            before in _STREET_BEFORE
            or (is_name and after in _STREET_AFTER)
            or is_subject
            or (first == 0 and is_capital)
        )
        is_common = is_ordinal or any(lookup.is_common(word) for word in plain)
        if (is_common and not has_cue) or (is_ordinal and after in _NO_STREET_AFTER):
            return False
        if is_common and not is_ordinal and not is_capital and before not in _LOWER_BEFORE:
            return False
    if follower is None or has_type or is_ordinal or inflects:
        return True
    # "Waterside Park" goes on
    goes_on = follower.is_capital and follower.start - words[last].end == 1 and not follower.plain[0].isdigit()
    return not goes_on
