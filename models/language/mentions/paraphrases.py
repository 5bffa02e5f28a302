"""Find paraphrases: nouns of a text that mean a name or noun of the map."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final

from models.language.mentions.lookup import Lookup
from models.language.mentions.names import Word, plain_words
from models.language.mentions.spans import Span, attach_objects
from models.language.mentions.word_lists import english

PARAPHRASE_TRUST: Final = 0.8  # of a mention found by meaning
_SHOPS = english().pattern("things", "shops")
FindParaphrase = Callable[[str], tuple[str, ...] | None]


def add_paraphrases(
    spans: Sequence[Span],
    words: Sequence[Word],
    nouns: Sequence[tuple[int, int]],
    text: str,
    lookup: Lookup,
    find_paraphrase: FindParaphrase,
) -> list[Span]:
    """Add spans of nouns that mean a name or noun of the map.

    `nouns` are characters start..end; those that end in "shop" and the like are found here. `find_paraphrase` returns
    the plain words of the name or noun that a phrase means.
    """
    result = [span for span in spans if span.form != "unknown"]
    taken = {n for span in result for n in range(span.first, span.last + 1)}
    for start, end in sorted({*nouns, *(shop.span(1) for shop in _SHOPS.finditer(text))}):
        rows = [n for n, word in enumerate(words) if start <= word.start and word.end <= end]
        plain = find_paraphrase(text[start:end]) if rows and taken.isdisjoint(rows) else None
        if plain is None or plain == plain_words(text[start:end]):
            continue  # `find_spans` has looked it up already
        kinds = lookup.kinds(plain)
        match = lookup.named(plain) if not kinds and lookup.is_name(plain) else None  # "makeup store" is a noun first
        span = attach_objects(Span(rows[0], rows[-1], "thing", match, 0.0, kinds), lookup)
        if span.match is not None:
            result.append(replace(span, match=replace(span.match, trust=PARAPHRASE_TRUST, is_exact=False)))
            taken.update(rows)
    unknown = [span for span in spans if span.form == "unknown" and taken.isdisjoint(range(span.first, span.last + 1))]
    return sorted([*result, *unknown], key=lambda span: span.first)
