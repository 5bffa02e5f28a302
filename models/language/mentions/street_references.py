"""Resolve streets that a text repeats by their kind: "I'm on Fifth, the avenue is behind me"."""

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


def add_repeated_streets(text: str, mentions: Sequence[Mention]) -> list[Mention]:
    """Add mentions of streets without objects where the text may repeat one by its kind."""
    taken = [(mention.start, mention.end) for mention in mentions]
    again = [
        Mention(text[match.start(1) : match.end(1)], match.start(1), match.end(1), "street")
        for match in _AGAIN.finditer(text)
        if not any(start < match.end(1) and match.start(1) < end for start, end in taken)
    ]
    return sorted([*mentions, *again], key=lambda mention: mention.start)


def resolve_repeated_streets(mentions: Sequence[Mention], streets: Sequence[Mention], lookup: Lookup) -> list[Mention]:
    """Give repeated streets with a direction the objects that they mean; drop the others.

    `streets` are all that the text names, also those that became corners and spans.
    """
    result = []
    for mention in mentions:
        if mention.form != "street" or len(mention.objects):
            result.append(mention)
            continue
        meant = _meant(mention, streets, lookup) if mention.cue.angle is not None else None
        if meant is not None:
            result.append(replace(mention, objects=meant.objects, weights=meant.weights, trust=meant.trust))
    return result


def _meant(mention: Mention, streets: Sequence[Mention], lookup: Lookup) -> Mention | None:
    """Return the last street of the kind before a mention, else the last street."""
    before = [street for street in streets if street.end <= mention.start]
    kind = full_words(plain_words(mention.text))[-1]
    of_kind = [street for street in before if kind in _kinds(street.objects, lookup)]
    return next(reversed(of_kind or before), None)


def _kinds(objects: Ints, lookup: Lookup) -> set[str]:
    names = (name for n in np.asarray(objects)[:20] for name in lookup.gazetteer.objects[n].names)
    return {full_words(plain)[-1] for name in names if (plain := plain_words(name))}
