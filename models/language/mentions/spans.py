"""Find the spans of a text that may name something: names, misspelt names, kinds, streets."""

import re
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Final

import numpy as np
from rapidfuzz import process
from rapidfuzz.distance import OSA

from models.language.languages.tabulated import Language
from models.language.measures import find_measures
from models.language.mentions.abbreviations import WORDS as STREET_WORDS
from models.language.mentions.cues import Form
from models.language.mentions.lookup import EMPTY, Lookup, Match
from models.language.mentions.names import ELIDED_ARTICLE, ORDINAL, Word, plain_word, split_words
from models.language.mentions.street_spans import match_street
from models.language.mentions.unspaced import split_unspaced
from models.language.mentions.word_lists import english

MAX_NAME_WORDS: Final = 6  # of a span
MIN_NAME_CHARACTERS: Final = 3  # a shorter name after a kind is another thing
MIN_SINGLE_WORD_WEIGHT: Final = 0.55  # of the kinds of a single word
MIN_NOUN_SIMILARITY: Final = 0.8  # normalized OSA similarity of a misspelt noun
WORD_SCORE, PHRASE_SCORE, STRANGE_SCORE = 2.0, 5.0, 5.0  # of spans of kinds and of unknown words
EXACT_FACTOR, PART_FACTOR = 1.3, 0.8  # of the weight of the words of a whole name and of a part of one
PLAIN_WORD_TRUST, PLAIN_PHRASE_TRUST, SENTENCE_START_TRUST = 0.5, 0.7, 0.5  # of everyday words
LACKED_NAME_TRUST: Final = 0.3  # of a kind with a name that the map lacks
OTHER_KIND_WEIGHT: Final = 0.4  # weight of an object with the name but another kind
_W = english()
STOP, PASSED = _W.list("stop"), _W.list("passed")
_ABBREVIATED, _ONE = _W.list("abbreviated"), _W.list("one")
_SEEN_TOO, _OVER = _W.list("seen_too"), _W.list("over")
_APPOSED = re.compile(r"\s*,\s*(?:the|a|an|that|our)\s+(?:\w+\s+)?|\s*,?\s+called\s+")
_SENTENCE_END = re.compile(r"[.!?]\s*$")
_PAUSE = re.compile(r"[.;!?\n,:()。，、；：！？（）]")  # noqa: RUF001
_NAMED_SO = re.compile(r"\s*,\s*|\s+|\s*,?\s+called\s+")


@dataclass(frozen=True, slots=True, eq=False)
class Span:
    """A span of words that may name one thing, with a score."""

    first: int
    last: int
    form: Form
    match: Match | None
    score: float
    kinds: Mapping[str, float] = field(default_factory=dict)
    lacks_name: bool = False  # whether it also has a name that no object of its kinds has: "Pasila station"


def find_spans(text: str, lookup: Lookup, language: Language) -> tuple[list[Word], list[Span]]:
    """Return the words of a text and its spans, in order and without overlaps."""
    known = [lookup.unspaced_words, *([] if language.table is None else [language.table.unspaced_nouns])]
    raw = [_without_article(word, text, lookup, language) for word in split_unspaced(split_words(text), known)]
    words = [_at_start(word, raw[n - 1] if n else None, text, lookup) for n, word in enumerate(raw)]
    cased = any(word.is_capital for word in words[1:])
    strange = [word.plain for word in words if lookup.is_strange(word.plain)] if language.table is None else []
    mended = {word: correct_noun(word, lookup) for word in strange}
    plain = tuple(word.plain for word in words)
    phrases = language.cue_spans(text)
    in_phrase = [any(a <= word.start and word.end <= b for a, b in phrases) for word in words]
    ends = [_ends(word, text[word.end : after.start]) for word, after in pairwise(words)] + [True]
    spans: list[Span] = []
    for first in range(len(words)):
        for last in range(first, min(first + MAX_NAME_WORDS, len(words))):
            if all(in_phrase[first : last + 1]):
                continue
            spans += _spans_at(words, first, last, plain[first : last + 1], mended, lookup, language, cased=cased)
            if ends[last]:
                break
    measures = find_measures(text)  # "twenty-five" metres are not 25th Street
    spans = [s for s in spans if not (s.form == "street" and any(m.contains(words[s.last]) for m in measures))]
    chosen = _with_unknown(_chosen(spans, words), words, in_phrase, text, lookup, language)
    return words, [
        attach_objects(span, lookup)
        for span in _joined(_as_whole_names(chosen, words, text, lookup), words, text, language)
    ]


def _without_article(word: Word, text: str, lookup: Lookup, language: Language) -> Word:
    """Return a word without its elided article, unless it is a name: "l'avenue", but "L'Occitane"."""
    article = ELIDED_ARTICLE.match(text, word.start, word.end)
    if article is None or language.table is None:
        return word
    start = article.end()
    rest = plain_word(text[start : word.end])
    is_name = not lookup.is_strange(word.plain) and (article[0][0].isupper() or article[0].startswith("d"))
    is_known = not lookup.is_strange(rest) or bool(language.table.kinds((rest,)))
    return (
        replace(word, plain=rest, start=start, is_capital=text[start].isupper()) if is_known and not is_name else word
    )


def correct_noun(word: str, lookup: Lookup) -> str:
    """Return the word of a noun that is similar to a misspelt one; the word itself if there is none."""
    if len(word) < 5:
        return word
    scorer, nouns = OSA.normalized_similarity, lookup.noun_words
    similar = process.extractOne(word, nouns, scorer=scorer, score_cutoff=MIN_NOUN_SIMILARITY)
    return similar[0] if similar else word


def _starts(word: Word, before: Word | None, text: str) -> bool:
    """Return whether a word begins a sentence, where a capital letter means nothing."""
    return before is None or _SENTENCE_END.search(text[before.end : word.start]) is not None


def _at_start(word: Word, before: Word | None, text: str, lookup: Lookup) -> Word:
    if not (word.is_capital and _starts(word, before, text) and lookup.is_common(word.plain)):
        return word
    return Word(word.plain, word.start, word.end, is_capital=False, owner=word.owner, begins=True)


def _ends(word: Word, after: str) -> bool:
    """Return whether a name ends after a word: at punctuation, except the dot of "St." and "Dr."."""
    is_abbreviated = word.plain in _ABBREVIATED or word.plain in STREET_WORDS
    return _PAUSE.search(after.replace(".", "", 1) if is_abbreviated else after) is not None


def _spans_at(
    words: Sequence[Word],
    first: int,
    last: int,
    plain: tuple[str, ...],
    mended: Mapping[str, str],
    lookup: Lookup,
    language: Language,
    *,
    cased: bool,
) -> list[Span]:
    """Return the spans that words first..last may be."""
    streets = _streets_at(words, first, last, plain, lookup, language)
    if words[last].owner and not streets and not lookup.is_name(plain):
        plain = (*plain[:-1], words[last].owner)
        streets = _streets_at(words, first, last, plain, lookup, language)
    spans = list(streets)
    if (plain[0] in EMPTY or plain[-1] in EMPTY) and not lookup.is_name(plain):
        return spans
    is_passed = first == last and plain[0] in PASSED and not _is_seen(words, first)
    kinds = {} if is_passed else _kinds(plain, mended, lookup, language, is_name=words[last].is_capital)
    if kinds:
        score = (WORD_SCORE if len(plain) == 1 else PHRASE_SCORE) + WORD_SCORE * len(plain)
        spans.append(Span(first, last, "thing", None, score, kinds))
    is_street = any(span.match is not None and span.match.is_exact for span in streets)
    rows = slice(first, last + 1)
    named = None if is_street else _named(words[rows], plain, lookup, language, cased=cased, is_kind=bool(kinds))
    if named:
        match, score = named
        if kinds and match.is_exact and all(word.is_capital or word.begins for word in words[first : last + 1]):
            score = max(score, spans[-1].score + WORD_SCORE)  # "Coffee Bar" is rather its name
            kinds = {}
        spans.append(Span(first, last, "thing", match, score, kinds))
    return spans


def _streets_at(
    words: Sequence[Word], first: int, last: int, plain: tuple[str, ...], lookup: Lookup, language: Language
) -> list[Span]:
    street = match_street(words, first, last, plain, lookup, table=language.table)
    return [] if street is None else [Span(first, last, "street", *street)]


def _kinds(
    plain: tuple[str, ...], mended: Mapping[str, str], lookup: Lookup, language: Language, *, is_name: bool
) -> Mapping[str, float]:
    """Return the kinds that words mean; "the Thai one" is a Thai place, "the Kahvila" a cafe."""
    if len(plain) == 1 and (plain[0] in language.stop or (plain[0] in STOP and language.table is None)):
        return {}
    if language.table is not None:
        return language.table.kinds(plain, inflects=not is_name or language.table.has_capital_nouns)
    noun = (*plain[:-1], "place") if len(plain) > 1 and plain[-1] in _ONE else plain
    kinds = lookup.kinds(noun) or lookup.kinds([mended.get(word, word) for word in noun])
    if len(plain) > 1:
        return kinds or (lookup.kinds(noun[:-1]) if noun[-1] == "place" else {})
    if not kinds and not lookup.is_common(plain[0]):
        return lookup.kinds_in_any_language(plain[0])
    return {kind: weight for kind, weight in kinds.items() if weight > MIN_SINGLE_WORD_WEIGHT}


def _is_seen(words: Sequence[Word], n: int) -> bool:
    """Return whether a word for a way means the thing itself: "by the crossing", not "across the path"."""
    before = [word.plain for word in words[max(0, n - 2) : n]]
    return words[n].plain in _SEEN_TOO and before[-1:] in (["the"], ["a"], ["this"], ["an"]) and before[0] not in _OVER


def _named(
    words: Sequence[Word], plain: tuple[str, ...], lookup: Lookup, language: Language, *, cased: bool, is_kind: bool
) -> tuple[Match, float] | None:
    """Return the match of a name and its score; everyday words in lower case are rarely names."""
    if _is_no_name(plain, language) or (is_kind and len(plain) == 1):
        return None
    match = lookup.named(plain)
    inflects = language.table is not None and language.table.inflects_names
    if match is None and inflects and (words[0].is_capital or not cased):
        match = lookup.named_form(plain)
    if match is None:
        return None
    if len(words) == 1 and words[0].begins and match.is_exact:
        return replace(match, trust=SENTENCE_START_TRUST), lookup.word_weight(plain[0])
    capital = any(word.is_capital for word in words if word.plain not in EMPTY)
    is_plain = all(lookup.is_common(word) or word in lookup.noun_words for word in plain)
    trust = match.trust
    if is_plain and not capital:
        if (cased or len(plain) == 1 or is_kind) and (is_kind or not match.is_exact or len(plain) == 1):
            return None
        trust *= PLAIN_WORD_TRUST if len(plain) == 1 else PLAIN_PHRASE_TRUST
    is_odd = len(plain[0]) > 2 and not any(lookup.is_common(word) or word in lookup.noun_words for word in plain)
    of_streets = _is_crossing(plain, lookup) or all(word in lookup.street_words for word in plain)
    if not match.is_exact and (is_kind or of_streets or not (capital or is_odd or not (cased or is_plain))):
        return None
    weight = sum(lookup.word_weight(word) for word in plain)
    return replace(match, trust=trust), weight * (EXACT_FACTOR if match.is_exact else PART_FACTOR) + float(capital)


def _is_no_name(plain: tuple[str, ...], language: Language) -> bool:
    empty = all(
        word in STOP or word in language.stop or word in EMPTY or ORDINAL.fullmatch(word) or word.isdecimal()
        for word in plain
    )
    return empty or (len(plain) == 1 and plain[0] in PASSED)


def _is_crossing(plain: tuple[str, ...], lookup: Lookup) -> bool:
    """Return whether words are two streets: "Broadway and 41st" is also the name of a bicycle dock."""
    return any(
        word in ("and", "at") and lookup.street(plain[:n]) is not None and lookup.street(plain[n + 1 :]) is not None
        for n, word in enumerate(plain)
        if 0 < n < len(plain) - 1
    )


def _chosen(spans: Sequence[Span], words: Sequence[Word]) -> list[Span]:
    """Return spans without overlaps, preferring high scores."""
    taken = [False] * len(words)
    chosen = []
    for span in sorted(spans, key=lambda span: (-span.score, span.first - span.last)):
        rows = range(span.first, span.last + 1)
        if not any(taken[n] for n in rows):
            chosen.append(span)
            for n in rows:
                taken[n] = True
    return sorted(chosen, key=lambda span: span.first)


def _with_unknown(
    spans: Sequence[Span],
    words: Sequence[Word],
    in_phrase: Sequence[bool],
    text: str,
    lookup: Lookup,
    language: Language,
) -> list[Span]:
    """Add spans of misspelt words and of names that the map lacks."""
    covered = {n for span in spans for n in range(span.first, span.last + 1)}
    firsts_of_kinds = {span.first for span in spans if span.form == "thing" and span.match is None}
    cased = any(word.is_capital for word in words)
    result, n = list(spans), 0
    while n < len(words):
        is_plain = language.table is not None and (
            words[n].plain in language.stop or (cased and not words[n].is_capital)
        )
        if n in covered or in_phrase[n] or is_plain or not _is_strange(words, n, text, lookup):
            n += 1
            continue
        end = n
        while end + 1 < len(words) and end + 1 not in covered and end - n < 3 and _follows(words, end, text, lookup):
            is_end = cased and language.table is not None and not words[end + 1].is_capital
            if is_end or in_phrase[end + 1] or words[end + 1].plain in language.stop:
                break
            end += 1
        plain = [word.owner or word.plain for word in words[n : end + 1]]
        before_kind = _is_next(end, firsts_of_kinds, words, text)
        is_name = words[n].is_capital and not _starts(words[n], words[n - 1] if n else None, text)
        is_name = is_name or (before_kind and (not cased or words[n].is_capital or words[n].begins))
        if language.table is not None:
            is_name = is_name and cased and (before_kind or end > n or not language.table.has_capital_nouns)
        span = _misspelt(n, end, plain, lookup, is_name=is_name)
        if span is not None:
            result.append(span)
        n = end + 1
    return sorted(result, key=lambda span: span.first)


def _is_strange(words: Sequence[Word], n: int, text: str, lookup: Lookup) -> bool:
    word = words[n]
    plain = word.owner or word.plain
    if word.plain in STOP or word.plain[0].isdigit():
        return False
    strange = not lookup.is_common(plain) and word.plain not in lookup.noun_words and len(word.plain) > 3
    begins = _starts(word, words[n - 1] if n else None, text)
    if word.begins:  # "National Museum"
        return _is_next(n, [m for m in range(n + 1, len(words)) if words[m].is_capital], words, text)
    return strange or (word.is_capital and not begins)


def _is_next(n: int, rows: Container[int], words: Sequence[Word], text: str) -> bool:
    """Return whether the word after word n is one of `rows`, with only a space between."""
    return n + 1 in rows and text[words[n].end : words[n + 1].start].strip() == ""


def _follows(words: Sequence[Word], end: int, text: str, lookup: Lookup) -> bool:
    follower = words[end + 1]
    close = text[words[end].end : follower.start].strip() in ("", "&")
    is_name = follower.is_capital or not lookup.is_common(follower.plain)
    return close and is_name and follower.plain not in STOP


def _misspelt(first: int, last: int, plain: Sequence[str], lookup: Lookup, *, is_name: bool) -> Span | None:
    match = lookup.misspelt(plain)
    if match is not None:
        return Span(first, last, "thing", match, STRANGE_SCORE)
    if len(plain) == 1:
        street = lookup.street_like(plain[0])
        if street is not None:
            return Span(first, last, "street", street, STRANGE_SCORE)
        kinds = lookup.kinds((correct_noun(plain[0], lookup),))
        if kinds:
            return Span(first, last, "thing", None, STRANGE_SCORE, kinds)
    return Span(first, last, "unknown", None, 0.0) if is_name else None


def _as_whole_names(spans: Sequence[Span], words: Sequence[Word], text: str, lookup: Lookup) -> list[Span]:
    """Turn parts of different names that stand together into one unknown name: "Finlandia Hall"."""
    result: list[Span] = []
    for span in spans:
        last = result[-1] if result else None
        if (
            last is not None
            and last.form == span.form == "thing"
            and all(part.match is not None and not part.match.is_exact for part in (last, span))
            and all(word.is_capital or word.begins for word in words[last.first : span.last + 1])
            and text[words[last.last].end : words[span.first].start] == " "
        ):
            kinds = lookup.kinds([word.plain for word in words[span.first : span.last + 1]])
            form: Form = "thing" if kinds else "unknown"
            result[-1] = Span(last.first, span.last, form, None, last.score, kinds, lacks_name=bool(kinds))
        else:
            result.append(span)
    return result


def _joined(spans: Sequence[Span], words: Sequence[Word], text: str, language: Language) -> list[Span]:
    """Join neighbouring names and kinds of one thing: "Bread & Butter deli", "the optician, T-Optik"."""
    joined: list[Span] = []
    for span in spans:
        last = joined[-1] if joined else None
        between = text[words[last.last].end : words[span.first].start].lower() if last else ""
        is_list = language.table is not None and "," in between
        if last is None or is_list or {last.form, span.form} - {"thing", "unknown"}:
            joined.append(span)
            continue
        both_kinds = last.form == span.form == "thing" and last.match is None and span.match is None
        close = between.strip() == "" or _APPOSED.fullmatch(between) is not None
        named_kind = last.form == "unknown" or last.match is not None
        is_kind = last.match is None and last.form == "thing" and not last.lacks_name
        kind_of_name = span.match is not None and is_kind
        characters = words[span.last].end - words[span.first].start
        if both_kinds and between.strip() == "":
            joined[-1] = Span(last.first, span.last, "thing", None, last.score, span.kinds)
        elif close and named_kind and span.match is None and span.form == "thing":
            lacks_name = last.form == "unknown"
            joined[-1] = Span(
                last.first, span.last, "thing", last.match, last.score + span.score, span.kinds, lacks_name
            )
        elif is_kind and between == " " and span.form == "unknown" and last.form == "thing":  # "Hotel Astoria"
            joined[-1] = Span(last.first, span.last, "thing", None, last.score, last.kinds, lacks_name=True)
        elif kind_of_name and _NAMED_SO.fullmatch(between) and characters > MIN_NAME_CHARACTERS:
            joined[-1] = Span(last.first, span.last, "thing", span.match, last.score + span.score, last.kinds)
        else:
            joined.append(span)
    return joined


def attach_objects(span: Span, lookup: Lookup) -> Span:
    """Return a span with its objects: those of the name, weighted by kind, or without a name those of the kind."""
    if span.form != "thing":
        return span
    of_kind = lookup.of_kinds(span.kinds) if span.kinds else None
    if span.match is None:
        if of_kind is None:
            return replace(span, form="unknown")
        return replace(span, match=replace(of_kind, trust=LACKED_NAME_TRUST) if span.lacks_name else of_kind)
    if of_kind is None:
        return span
    agree = np.isin(span.match.objects, of_kind.objects)
    if not span.match.is_exact and not agree.any():  # "Finlandia Hall" is no shop called Finlandia Caviar
        return replace(span, match=replace(of_kind, trust=LACKED_NAME_TRUST), lacks_name=True)
    weights = span.match.weights * np.where(agree, 1.0, OTHER_KIND_WEIGHT)
    return replace(span, match=replace(span.match, weights=weights))
