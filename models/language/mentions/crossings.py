"""Combine streets of a text (corners, spans between two cross streets), and resolve repeated ones."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.languages.tabulated import Language
from models.language.mentions.cues import Cue
from models.language.mentions.lookup import Lookup
from models.language.mentions.mentions import Mention
from models.language.mentions.names import full_words, plain_words
from models.language.mentions.word_lists import english

LONGEST_SPAN_M: Final = 600.0
_W = english()
_AGAIN = _W.pattern("streets", "again")  # a street repeated by its kind: "I'm on Fifth, the avenue is behind me"


def add_corners(text: str, mentions: Sequence[Mention], lookup: Lookup, language: Language) -> list[Mention]:
    """Replace streets that a text combines by corners and spans."""
    streets = [n for n, mention in enumerate(mentions) if mention.form == "street"]
    joined: dict[int, Mention] = {}
    apart: list[Mention] = []
    used: set[int] = set()
    for k, n in enumerate(streets[:-1]):
        m = streets[k + 1]
        if n in used or m in used:
            continue
        main = _main(mentions, [s for s in streets if s not in (n, m)], n, m)
        is_last = k + 2 >= len(streets)
        combined = _combine(text, mentions[n], mentions[m], main, lookup, language, is_last=is_last)
        if combined is not None and combined.form == "unknown":
            apart.append(combined)
        elif combined is not None:
            joined[n] = combined
            used |= {n, m}
    result: list[Mention] = []
    for n, mention in enumerate(mentions):
        if n in joined:
            result.append(joined[n])
            if joined[n].form == "corner" and joined[n].cue.relation == "near":
                result.append(mention)  # "on 49th just past Second" is also on 49th
        elif n not in used:
            result.append(mention)
    return result + apart


def _main(mentions: Sequence[Mention], others: Sequence[int], n: int, m: int) -> Mention | None:
    """Return the street of a span between two others: the last one before them, else the first after."""
    objects = np.concatenate([mentions[n].objects, mentions[m].objects])
    apart = [s for s in others if not np.isin(mentions[s].objects, objects).any()]
    before = [s for s in apart if s < n]
    return mentions[before[-1] if before else apart[0]] if apart else None


def _combine(
    text: str, one: Mention, other: Mention, main: Mention | None, lookup: Lookup, language: Language, *, is_last: bool
) -> Mention | None:
    """Combine two neighbouring streets to a span or a corner; "unknown" if the map has no such corner."""
    between = one.end, other.start
    whole = text[one.start : other.end], one.start, other.end
    if language.is_between(text, one.start, *between, other.end):
        span = _span(one, other, main, lookup)
        return span and _place_in_text(span, *whole)
    if not (language.meets(text, one.start, *between, other.end) or language.meets_at_end(text, *between, other.end)):
        return None
    if not is_last and language.begins_between(text, other.start):
        return None
    corner = _corner(one, other, lookup)
    cue = Cue("near" if language.is_loose(text, *between) else "at")
    if corner is None:
        return _place_in_text(Mention("", 0, 0, "unknown"), *whole) if language.is_sure(text, *between) else None
    return replace(_place_in_text(corner, *whole), cue=cue)


def _place_in_text(mention: Mention, text: str, start: int, end: int) -> Mention:
    return replace(mention, text=text, start=start, end=end)


def _corner(one: Mention, other: Mention, lookup: Lookup) -> Mention | None:
    """Return the places where two streets meet; None if they do not."""
    g = lookup.gazetteer
    weight = np.zeros((2, len(g)))
    weight[0, one.objects], weight[1, other.objects] = one.weights, other.weights
    a, b = g.corner_streets.T
    value = np.maximum(weight[0, a] * weight[1, b], weight[0, b] * weight[1, a])
    rows = np.flatnonzero(value > 0)
    if not len(rows):
        return None
    corners_m = g.corners_m[rows].astype(np.float64)
    lines = np.concatenate([corners_m, corners_m], axis=1)
    return Mention("", 0, 0, "corner", lines_m=lines, weights=value[rows], is_exact=True)


def _span(one: Mention, other: Mention, main: Mention | None, lookup: Lookup) -> Mention | None:
    """Return the pieces of a street between two others; of any street without `main`."""
    mains: Ints = main.objects if main is not None else np.arange(len(lookup.gazetteer))
    lines = [
        np.concatenate([p, q])
        for s, p in _ends(one, mains, lookup)
        for t, q in _ends(other, mains, lookup)
        if s == t and np.hypot(*(p - q)) < LONGEST_SPAN_M
    ]
    if not lines:
        return None
    return Mention("", 0, 0, "span", lines_m=np.array(lines), weights=np.ones(len(lines)), is_exact=True, cue=Cue("on"))


def _ends(side: Mention, mains: Ints, lookup: Lookup) -> list[tuple[int, Floats]]:
    """Return the corners of cross streets with main streets: (main street, position)."""
    g = lookup.gazetteer
    a, b = g.corner_streets.T
    ends = []
    for street, cross in ((a, b), (b, a)):
        rows = np.flatnonzero(np.isin(cross, side.objects) & np.isin(street, mains))
        ends += [(int(street[n]), g.corners_m[n].astype(np.float64)) for n in rows]
    return ends


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
        meant = _referent(mention, streets, lookup) if mention.cue.angle is not None else None
        if meant is not None:
            result.append(replace(mention, objects=meant.objects, weights=meant.weights, trust=meant.trust))
    return result


def _referent(mention: Mention, streets: Sequence[Mention], lookup: Lookup) -> Mention | None:
    """Return the last street of the kind before a mention, else the last street."""
    before = [street for street in streets if street.end <= mention.start]
    kind = full_words(plain_words(mention.text))[-1]
    of_kind = [street for street in before if kind in _street_kinds(street.objects, lookup)]
    return next(reversed(of_kind or before), None)


def _street_kinds(objects: Ints, lookup: Lookup) -> set[str]:
    names = (name for n in np.asarray(objects)[:20] for name in lookup.gazetteer.objects[n].names)
    return {full_words(plain)[-1] for name in names if (plain := plain_words(name))}
