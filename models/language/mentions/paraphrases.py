"""Paraphrases: nouns of a text that are no name or noun of the map, but mean one."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final

from models.language.mentions.lookup import Lookup
from models.language.mentions.names import Word, plain_words
from models.language.mentions.spans import Span, with_objects
from models.language.mentions.word_lists import english

TRUST: Final = 0.8  # that words with the same meaning mean the same
_SHOPS = english().pattern("things", "shops")
Like = Callable[[str], tuple[str, ...] | None]


def with_meant(
    spans: Sequence[Span],
    words: Sequence[Word],
    nouns: Sequence[tuple[int, int]],
    text: str,
    lookup: Lookup,
    like: Like,
) -> list[Span]:
    """Spans of a text, and nouns that are in none of them but mean what the map has.

    Args:
        spans: as `find_spans`.
        words: the words of the text.
        nouns: characters start..end of nouns, beside those that end in "shop" and the like.
        text: the same.
        lookup: of the map.
        like: gives the plain words of the name or noun of the map that means what was said; None if none does.
    """
    found = [span for span in spans if span.form != "unknown"]
    taken = {n for span in found for n in range(span.first, span.last + 1)}
    for start, end in sorted({*nouns, *(shop.span(1) for shop in _SHOPS.finditer(text))}):
        rows = [n for n, word in enumerate(words) if start <= word.start and word.end <= end]
        plain = like(text[start:end]) if rows and taken.isdisjoint(rows) else None
        if plain is None or plain == plain_words(text[start:end]):
            continue  # the latter was looked up
        kinds = lookup.kinds(plain)
        match = lookup.named(plain) if not kinds and lookup.is_name(plain) else None  # "makeup store" is a noun first
        span = with_objects(Span(rows[0], rows[-1], "thing", match, 0.0, kinds), lookup)
        if span.match is not None:
            found.append(replace(span, match=replace(span.match, trust=TRUST, is_exact=False)))
            taken.update(rows)
    unknown = [span for span in spans if span.form == "unknown" and taken.isdisjoint(range(span.first, span.last + 1))]
    return sorted([*found, *unknown], key=lambda span: span.first)
