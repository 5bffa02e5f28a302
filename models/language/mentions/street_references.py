"""Streets that are named again by their kind alone: "I'm on Fifth, the avenue is behind me"."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from models.citymap.points import Ints
from models.language.mentions.lookup import Lookup
from models.language.mentions.mentions import Mention
from models.language.mentions.names import plain_words
from models.language.mentions.streets import full_words
from models.language.mentions.word_lists import english

_AGAIN = english().pattern("streets", "again")


def with_again(text: str, mentions: Sequence[Mention]) -> list[Mention]:
    """Mentions, and streets without objects for what may name one of them again."""
    taken = [(mention.start, mention.end) for mention in mentions]
    again = [
        Mention(text[found.start(1) : found.end(1)], found.start(1), found.end(1), "street")
        for found in _AGAIN.finditer(text)
        if not any(start < found.end(1) and found.start(1) < end for start, end in taken)
    ]
    return sorted([*mentions, *again], key=lambda mention: mention.start)


def resolved(mentions: Sequence[Mention], streets: Sequence[Mention], lookup: Lookup) -> list[Mention]:
    """Mentions whose streets without objects, if it is said where they are, got those that are meant.

    Args:
        mentions: with cues.
        streets: all that the text names, also those that became corners and spans.
        lookup: of the map.
    """
    kept = []
    for mention in mentions:
        if mention.form != "street" or len(mention.objects):
            kept.append(mention)
            continue
        meant = _meant(mention, streets, lookup) if mention.cue.angle is not None else None
        if meant is not None:
            kept.append(replace(mention, objects=meant.objects, weights=meant.weights, trust=meant.trust))
    return kept


def _meant(mention: Mention, streets: Sequence[Mention], lookup: Lookup) -> Mention | None:
    """The street last named before that is of the kind; else the one named last."""
    before = [street for street in streets if street.end <= mention.start]
    kind = full_words(plain_words(mention.text))[-1]
    of_kind = [street for street in before if kind in _kinds(street.objects, lookup)]
    return next(reversed(of_kind or before), None)


def _kinds(objects: Ints, lookup: Lookup) -> set[str]:
    names = (name for n in np.asarray(objects)[:20] for name in lookup.gazetteer.objects[n].names)
    return {full_words(plain)[-1] for name in names if (plain := plain_words(name))}
