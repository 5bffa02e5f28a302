"""The words of a text that may name something: names, misspelt names, kinds, streets."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Final, Literal

import numpy as np
from rapidfuzz import process
from rapidfuzz.distance import OSA

from models.language.measures import measures_in
from models.language.mentions.languages import ENGLISH
from models.language.mentions.lookup import EMPTY, Lookup, Match
from models.language.mentions.names import Word, words_of
from models.language.mentions.street_spans import streets_at
from models.language.mentions.streets import ORDINAL
from models.language.mentions.word_lists import english

Form = Literal["thing", "street", "corner", "span", "address", "unknown"]
MOST_WORDS: Final = 6  # of a name
SHORTEST: Final = 3  # characters; a shorter name behind a kind is another thing
LOOSE_TERM: Final = 0.55  # a single word must mean a kind more surely
LIKE_NOUN: Final = 0.8  # share of the letters of a misspelt noun that must agree
NOUN, NOUNS, STRANGE = 2.0, 5.0, 5.0  # what spans are worth beside names
EXACT, PART, PLAIN_ONE, PLAIN_MORE, AT_START = 1.3, 0.8, 0.5, 0.7, 0.5
OF_ANOTHER_KIND: Final = 0.4  # weight of what bears the name but is not what the text calls it
_W = english()
STOP, PASSED = _W.list("stop"), _W.list("passed")
_ABBREVIATED, _ONE = _W.list("abbreviated"), _W.list("one")
_SEEN_TOO, _OVER = _W.list("seen_too"), _W.list("over")
_APPOSED = re.compile(r"\s*,\s*(?:the|a|an|that|our)\s+(?:\w+\s+)?|\s*,?\s+called\s+")
_SENTENCE_END = re.compile(r"[.!?]\s*$")
_PAUSE = re.compile(r"[.;!?\n,:()]")
_NAMED_SO = re.compile(r"\s*,\s*|\s+|\s*,?\s+called\s+")


@dataclass(frozen=True, slots=True, eq=False)
class Span:
    """Words first..last that may be one thing, and how much they tell."""

    first: int
    last: int
    form: Form
    match: Match | None
    score: float
    kinds: Mapping[str, float] = field(default_factory=dict)


def find_spans(text: str, lookup: Lookup, language: str = ENGLISH) -> tuple[list[Word], list[Span]]:
    """The words of a text, and what they name, in order and without overlaps; kinds by the nouns of a language."""
    said = words_of(text)
    words = [_at_start(word, said[n - 1] if n else None, text, lookup) for n, word in enumerate(said)]
    cased = any(word.is_capital for word in words[1:])
    mended = {word.plain: like_noun(word.plain, lookup) for word in words if lookup.is_strange(word.plain)}
    plain = tuple(word.plain for word in words)
    ends = [_ends(word, text[word.end : after.start]) for word, after in pairwise(words)] + [True]
    found: list[Span] = []
    for first in range(len(words)):
        for last in range(first, min(first + MOST_WORDS, len(words))):
            found += _spans_at(words, first, last, plain[first : last + 1], mended, lookup, language, cased=cased)
            if ends[last]:
                break
    measures = measures_in(text)  # "twenty-five" metres are not 25th Street
    found = [
        span for span in found if not (span.form == "street" and any(m.contains(words[span.last]) for m in measures))
    ]
    chosen = _with_unknown(_chosen(found, words), words, text, lookup)
    return words, [with_objects(span, lookup) for span in _joined(chosen, words, text)]


def like_noun(word: str, lookup: Lookup) -> str:
    """The word of a noun that a misspelt one is like; itself if there is none."""
    if len(word) < 5:
        return word
    like = process.extractOne(word, lookup.noun_words, scorer=OSA.normalized_similarity, score_cutoff=LIKE_NOUN)
    return like[0] if like else word


def _starts(word: Word, before: Word | None, text: str) -> bool:
    """Whether a word begins a sentence, where a capital letter tells nothing."""
    return before is None or _SENTENCE_END.search(text[before.end : word.start]) is not None


def _at_start(word: Word, before: Word | None, text: str, lookup: Lookup) -> Word:
    if not (word.is_capital and _starts(word, before, text) and lookup.is_common(word.plain)):
        return word
    return Word(word.plain, word.start, word.end, is_capital=False, owner=word.owner, begins=True)


def _ends(word: Word, after: str) -> bool:
    """Whether a name ends behind a word: at punctuation, but for the dot of "St." and "Dr."."""
    return _PAUSE.search(after.replace(".", "", 1) if word.plain in _ABBREVIATED else after) is not None


def _spans_at(
    words: Sequence[Word],
    first: int,
    last: int,
    plain: tuple[str, ...],
    mended: Mapping[str, str],
    lookup: Lookup,
    language: str,
    *,
    cased: bool,
) -> list[Span]:
    """What words first..last may name, in plain words."""
    streets = _streets_at(words, first, last, plain, lookup)
    if words[last].owner and not streets and not lookup.is_name(plain):
        plain = (*plain[:-1], words[last].owner)
        streets = _streets_at(words, first, last, plain, lookup)
    found = list(streets)
    if (plain[0] in EMPTY or plain[-1] in EMPTY) and not lookup.is_name(plain):
        return found
    is_passed = first == last and plain[0] in PASSED and not _is_seen(words, first)
    kinds = {} if is_passed else _kinds(plain, mended, lookup, language)
    if kinds:
        found.append(Span(first, last, "thing", None, (NOUN if len(plain) == 1 else NOUNS) + NOUN * len(plain), kinds))
    is_street = any(span.match is not None and span.match.is_exact for span in streets)
    named = None if is_street else _named(words[first : last + 1], plain, lookup, cased=cased, is_kind=bool(kinds))
    if named:
        found.append(Span(first, last, "thing", *named, kinds))
    return found


def _streets_at(words: Sequence[Word], first: int, last: int, plain: tuple[str, ...], lookup: Lookup) -> list[Span]:
    found = streets_at(words, first, last, plain, lookup)
    return [] if found is None else [Span(first, last, "street", *found)]


def _kinds(plain: tuple[str, ...], mended: Mapping[str, str], lookup: Lookup, language: str) -> Mapping[str, float]:
    """The kinds that words mean; "the Thai one" is a Thai place, "the Kahvila" a cafe."""
    if len(plain) == 1 and plain[0] in STOP:
        return {}
    if language != ENGLISH:
        return lookup.kinds(plain, language)
    noun = (*plain[:-1], "place") if len(plain) > 1 and plain[-1] in _ONE else plain
    kinds = lookup.kinds(noun) or lookup.kinds([mended.get(word, word) for word in noun])
    if len(plain) > 1:
        return kinds or (lookup.kinds(noun[:-1]) if noun[-1] == "place" else {})
    if not kinds and not lookup.is_common(plain[0]):
        return lookup.foreign_kinds(plain[0])
    return {kind: weight for kind, weight in kinds.items() if weight > LOOSE_TERM}


def _is_seen(words: Sequence[Word], n: int) -> bool:
    """Whether what is often only crossed is told of itself: "by the crossing", not "across the path"."""
    before = [word.plain for word in words[max(0, n - 2) : n]]
    return words[n].plain in _SEEN_TOO and before[-1:] in (["the"], ["a"], ["this"], ["an"]) and before[0] not in _OVER


def _named(
    some: Sequence[Word], plain: tuple[str, ...], lookup: Lookup, *, cased: bool, is_kind: bool
) -> tuple[Match, float] | None:
    """What bears a name, and how much the words tell; everyday words in lower case are names seldom."""
    if _is_no_name(plain) or (is_kind and len(plain) == 1):
        return None
    match = lookup.named(plain)
    if match is None:
        return None
    if len(some) == 1 and some[0].begins and match.is_exact:
        return replace(match, trust=AT_START), lookup.worth(plain[0])
    capital = any(word.is_capital for word in some if word.plain not in EMPTY)
    is_plain = all(lookup.is_common(word) or word in lookup.noun_words for word in plain)
    trust = match.trust
    if is_plain and not capital:
        if (cased or len(plain) == 1 or is_kind) and (is_kind or not match.is_exact or len(plain) == 1):
            return None
        trust *= PLAIN_ONE if len(plain) == 1 else PLAIN_MORE
    is_odd = len(plain[0]) > 2 and not any(lookup.is_common(word) or word in lookup.noun_words for word in plain)
    of_streets = _is_crossing(plain, lookup) or all(word in lookup.street_words for word in plain)
    if not match.is_exact and (is_kind or of_streets or not (capital or is_odd or not (cased or is_plain))):
        return None
    said = sum(lookup.worth(word) for word in plain)
    return replace(match, trust=trust), said * (EXACT if match.is_exact else PART) + float(capital)


def _is_no_name(plain: tuple[str, ...]) -> bool:
    empty = all(word in STOP or word in EMPTY or ORDINAL.fullmatch(word) or word.isdecimal() for word in plain)
    return empty or (len(plain) == 1 and plain[0] in PASSED)


def _is_crossing(plain: tuple[str, ...], lookup: Lookup) -> bool:
    """Whether words are two streets: "Broadway and 41st", which is the name of a bicycle dock too."""
    return any(
        word in ("and", "at") and lookup.street(plain[:n]) is not None and lookup.street(plain[n + 1 :]) is not None
        for n, word in enumerate(plain)
        if 0 < n < len(plain) - 1
    )


def _chosen(spans: Sequence[Span], words: Sequence[Word]) -> list[Span]:
    """Spans that do not overlap, the most telling first."""
    taken = [False] * len(words)
    chosen = []
    for span in sorted(spans, key=lambda span: (-span.score, span.first - span.last)):
        rows = range(span.first, span.last + 1)
        if not any(taken[n] for n in rows):
            chosen.append(span)
            for n in rows:
                taken[n] = True
    return sorted(chosen, key=lambda span: span.first)


def _with_unknown(spans: Sequence[Span], words: Sequence[Word], text: str, lookup: Lookup) -> list[Span]:
    """Spans, and between them words that no name of the map has: misspelt ones, and names that it lacks."""
    covered = {n for span in spans for n in range(span.first, span.last + 1)}
    found, n = list(spans), 0
    while n < len(words):
        if n in covered or not _is_strange(words, n, text, lookup):
            n += 1
            continue
        end = n
        while end + 1 < len(words) and end + 1 not in covered and end - n < 3 and _follows(words, end, text, lookup):
            end += 1
        some = [word.owner or word.plain for word in words[n : end + 1]]
        is_name = words[n].is_capital and not _starts(words[n], words[n - 1] if n else None, text)
        span = _misspelt(n, end, some, lookup, is_name=is_name)
        if span is not None:
            found.append(span)
        n = end + 1
    return sorted(found, key=lambda span: span.first)


def _is_strange(words: Sequence[Word], n: int, text: str, lookup: Lookup) -> bool:
    word = words[n]
    plain = word.owner or word.plain
    if word.plain in STOP or word.plain[0].isdigit():
        return False
    strange = not lookup.is_common(plain) and word.plain not in lookup.noun_words and len(word.plain) > 3
    begins = _starts(word, words[n - 1] if n else None, text)
    return strange or (word.is_capital and not begins)


def _follows(words: Sequence[Word], end: int, text: str, lookup: Lookup) -> bool:
    follower = words[end + 1]
    close = text[words[end].end : follower.start].strip() in ("", "&")
    is_name = follower.is_capital or not lookup.is_common(follower.plain)
    return close and is_name and follower.plain not in STOP


def _misspelt(first: int, last: int, some: Sequence[str], lookup: Lookup, *, is_name: bool) -> Span | None:
    match = lookup.misspelt(some)
    if match is not None:
        return Span(first, last, "thing", match, STRANGE)
    if len(some) == 1:
        street = lookup.street_like(some[0])
        if street is not None:
            return Span(first, last, "street", street, STRANGE)
        kinds = lookup.kinds((like_noun(some[0], lookup),))
        if kinds:
            return Span(first, last, "thing", None, STRANGE, kinds)
    return Span(first, last, "unknown", None, 0.0) if is_name else None


def _joined(spans: Sequence[Span], words: Sequence[Word], text: str) -> list[Span]:
    """Names and kinds that stand side by side are one thing: "Bread & Butter deli", "the optician, T-Optik"."""
    joined: list[Span] = []
    for span in spans:
        last = joined[-1] if joined else None
        if last is None or last.form not in ("thing", "unknown") or span.form not in ("thing", "unknown"):
            joined.append(span)
            continue
        between = text[words[last.last].end : words[span.first].start].lower()
        both_kinds = last.form == span.form == "thing" and last.match is None and span.match is None
        close = between.strip() == "" or _APPOSED.fullmatch(between) is not None
        named_kind = last.form == "unknown" or last.match is not None
        kind_of_name = span.match is not None and last.match is None and last.form == "thing"
        if both_kinds and between.strip() == "":
            joined[-1] = Span(last.first, span.last, "thing", None, last.score, span.kinds)
        elif close and named_kind and span.match is None and span.form == "thing":
            joined[-1] = Span(last.first, span.last, "thing", last.match, last.score + span.score, span.kinds)
        elif (
            kind_of_name and _NAMED_SO.fullmatch(between) and words[span.last].end - words[span.first].start > SHORTEST
        ):
            joined[-1] = Span(last.first, span.last, "thing", span.match, last.score + span.score, last.kinds)
        else:
            joined.append(span)
    return joined


def with_objects(span: Span, lookup: Lookup) -> Span:
    """A span with its objects: those of the name, the more if of the kind said; without a name those of the kind."""
    if span.form != "thing":
        return span
    of_kind = lookup.of_kinds(span.kinds) if span.kinds else None
    if span.match is None:
        return replace(span, match=of_kind) if of_kind else replace(span, form="unknown")
    if of_kind is None:
        return span
    agree = np.isin(span.match.objects, of_kind.objects)
    weights = span.match.weights * np.where(agree, 1.0, OF_ANOTHER_KIND)
    return replace(span, match=replace(span.match, weights=weights))
