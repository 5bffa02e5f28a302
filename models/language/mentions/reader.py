"""From a text to its mentions."""

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from models.language.measures import COMPASS_WORD, bearing_of, measures_in
from models.language.mentions.crossings import with_addresses, with_corners
from models.language.mentions.cue_reader import CueReader
from models.language.mentions.languages import ENGLISH
from models.language.mentions.lookup import Lookup
from models.language.mentions.mentions import Mention, with_cues
from models.language.mentions.paraphrases import Like, with_meant
from models.language.mentions.spans import find_spans
from models.language.mentions.street_references import resolved, with_again
from models.language.mentions.word_lists import english

MOST_OBJECTS: Final = 2500  # what so many things may be tells nothing
_W = english()
_LISTENER = (_W.text("listener", name).replace("<compass>", COMPASS_WORD) for name in ("of_you", "goes"))
_OF_YOU, _GOES = (re.compile(pattern, re.IGNORECASE) for pattern in _LISTENER)
_MEETING = _W.pattern("listener", "meeting")


def find_mentions(
    text: str,
    lookup: Lookup,
    cues: CueReader,
    language: str = ENGLISH,
    nouns: Sequence[tuple[int, int]] = (),
    like: Like | None = None,
) -> list[Mention]:
    """What a text names on a map, in its order, each with where it is from the speaker; not what it says is not there.

    Args:
        text: any.
        lookup: of the map.
        cues: says where each thing is from the speaker.
        language: of the text; what the words of others than English say of where things are is not read.
        nouns: characters start..end of each noun that was found in another way.
        like: see `with_meant`; None to leave out what is no name or noun of the map.
    """
    if language != ENGLISH:
        words, spans = find_spans(text, lookup, language)
        mentions = with_addresses([Mention.of(span, words, text) for span in spans], text, lookup)
        return [mention for mention in mentions if len(mention.objects) <= MOST_OBJECTS]
    text = _without_listener(text)
    words, spans = find_spans(text, lookup)
    if like is not None:
        spans = with_meant(spans, words, nouns, text, lookup, like)
    mentions = with_addresses([Mention.of(span, words, text) for span in spans], text, lookup)
    mentions = [mention for mention in mentions if len(mention.objects) <= MOST_OBJECTS]
    streets = [mention for mention in mentions if mention.form == "street"]
    told = with_cues(text, with_again(text, with_corners(text, mentions, lookup)), cues)
    return resolved(told, streets, lookup)


def _without_listener(text: str) -> str:
    """Return a text with blanks for what it says of the listener's place: "two blocks north of you"."""
    measures = {measure.end: measure.start for measure in measures_in(text)}
    for found in _OF_YOU.finditer(text):
        end = len(text[: found.start()].rstrip())
        start = measures.get(end, found.start())
        text = text[:start] + " " * (found.end() - start) + text[found.end() :]
    return text


def with_goal(mentions: Sequence[Mention]) -> list[Mention]:
    """The first kind of thing that is named is where to meet, if the text does not say so of another."""
    found = list(mentions)
    if any(mention.form == "thing" and mention.cue.relation == "at" for mention in found):
        return found
    for n, mention in enumerate(found):
        cue = mention.cue
        is_near = cue.relation not in ("across", "block", "past") and cue.wind is None and cue.distance_m is None
        if mention.form == "thing" and is_near:
            found[n] = replace(mention, cue=replace(cue, relation="at", angle=None))
            break
    return found


def is_meeting(text: str) -> bool:
    """Whether a text tells somebody else where to come."""
    return _MEETING.search(text) is not None


def listener_wind(text: str) -> float | None:
    """Degrees from the listener to the speaker ("north of you", "head southwest"); None if the text tells none."""
    found = _OF_YOU.search(text)
    if found:
        return bearing_of(found[0])
    goes = _GOES.search(text)
    return bearing_of(goes[1]) if goes else None
