"""Find the mentions of a text."""

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from models.language.languages.english import English
from models.language.languages.tabulated import Language
from models.language.measures import COMPASS_WORD, find_measures, first_bearing
from models.language.mentions.addresses import add_addresses
from models.language.mentions.codes.reader import CodeReader
from models.language.mentions.crossings import (
    add_corners,
    add_repeated_streets,
    resolve_repeated_streets,
)
from models.language.mentions.discourse import with_standing, without_corrected
from models.language.mentions.lookup import Lookup
from models.language.mentions.mentions import Mention, add_cues
from models.language.mentions.names import Word
from models.language.mentions.paraphrases import FindParaphrase, add_paraphrases
from models.language.mentions.spans import Span, find_spans
from models.language.mentions.word_lists import english

MAX_OBJECTS: Final = 2500  # a mention with more candidates is ignored
_W = english()
_LISTENER = (_W.text("listener", name).replace("<compass>", COMPASS_WORD) for name in ("of_you", "goes"))
_OF_YOU, _GOES = (re.compile(pattern, re.IGNORECASE) for pattern in _LISTENER)
_MEETING = _W.pattern("listener", "meeting")


def find_mentions(
    text: str,
    lookup: Lookup,
    language: Language,
    nouns: Sequence[tuple[int, int]] = (),
    find_paraphrase: FindParaphrase | None = None,
    codes: CodeReader | None = None,
) -> list[Mention]:
    """Return the mentions of a text with their cues, in text order, without absent things.

    `nouns` are characters start..end from the hint reader, which reads English; `codes` reads coordinates and
    references.
    """
    coded = [] if codes is None else codes.find(text)
    bare = _blanked(text, coded)
    if isinstance(language, English):
        text, bare = (_without_listener(one) for one in (_blanked(text, [m for m in coded if m.form != "thing"]), bare))
    words, spans = find_spans(bare, lookup, language)
    if find_paraphrase is not None and isinstance(language, English):
        spans = add_paraphrases(spans, words, nouns, bare, lookup, find_paraphrase)
    mentions = _mentions(bare, coded, lookup, codes, words, spans)
    streets = [mention for mention in mentions if mention.form == "street"]
    corrected = without_corrected(text, add_corners(text, mentions, lookup, language), language)
    mentions = add_repeated_streets(text, with_standing(text, corrected, language))
    cued = add_cues(text, mentions, language)
    return resolve_repeated_streets(cued, streets, lookup)


def _mentions(
    bare: str,
    coded: Sequence[Mention],
    lookup: Lookup,
    codes: CodeReader | None,
    words: Sequence[Word],
    spans: Sequence[Span],
) -> list[Mention]:
    """Return the mentions of spans with addresses and codes, without those that could be almost anything."""
    mentions = add_addresses([Mention.from_span(span, words, bare) for span in spans], bare, lookup)
    if codes is not None:
        postcodes = list(codes.postcodes(bare, [*mentions, *coded]))
        mentions = sorted([*mentions, *coded, *postcodes], key=lambda mention: mention.start)
    return [mention for mention in mentions if len(mention.objects) <= MAX_OBJECTS]


def _blanked(text: str, mentions: Sequence[Mention]) -> str:
    """Return a text with blanks in the place of mentions."""
    for mention in mentions:
        text = text[: mention.start] + " " * (mention.end - mention.start) + text[mention.end :]
    return text


def _without_listener(text: str) -> str:
    """Blank out phrases about the listener's position: "two blocks north of you"."""
    measures = {measure.end: measure.start for measure in find_measures(text)}
    for match in _OF_YOU.finditer(text):
        end = len(text[: match.start()].rstrip())
        start = measures.get(end, match.start())
        text = text[:start] + " " * (match.end() - start) + text[match.end() :]
    return text


def mark_goal(mentions: Sequence[Mention]) -> list[Mention]:
    """Mark the first kind of thing as the meeting point, unless the text names another."""
    result = list(mentions)
    if any(mention.form == "thing" and mention.cue.relation == "at" for mention in result):
        return result
    for n, mention in enumerate(result):
        cue = mention.cue
        is_near = cue.relation not in ("across", "block", "past") and cue.wind is None and cue.distance_m is None
        if mention.form == "thing" and is_near:
            result[n] = replace(mention, cue=replace(cue, relation="at", angle=None))
            break
    return result


def is_meeting(text: str) -> bool:
    """Return whether a text describes a meeting point."""
    return _MEETING.search(text) is not None


def listener_wind(text: str) -> float | None:
    """Return the degrees from the listener to the speaker ("north of you", "head southwest"); None without any."""
    match = _OF_YOU.search(text)
    if match:
        return first_bearing(match[0])
    goes = _GOES.search(text)
    return first_bearing(goes[1]) if goes else None
