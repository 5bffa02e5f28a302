"""What a text says of places: things, streets, corners, spans and addresses, and where each is from the speaker."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from models.city.points import Ints
from models.city.types import Floats
from models.language.places.cues import SEEN, WIND_WORD, Cue, cue_of, spelt, wind_of
from models.language.places.names import Word
from models.language.places.spans import Form, Span
from models.language.places.words import english

NO_OBJECTS: Final = np.zeros(0, np.int64)
NO_WEIGHTS: Final = np.zeros(0)
NO_LINES: Final = np.zeros((0, 4))


@dataclass(frozen=True, slots=True, eq=False)
class Mention:
    """A thing, street, corner, span or address that a text names.

    Attributes:
        text: the words.
        start, end: where they stand.
        form: what it is; "unknown" for a name that the map has not.
        objects: [n] of the gazetteer that may be meant.
        weights: [n + e] relative, of these and of the lines.
        lines_m: [e, 4] places that are no object: corners, spans, house numbers between others.
        trust: that the words mean these at all.
        is_exact: whether a name of the map was said whole.
        kinds: what it is said to be.
        cue: where it is from the speaker.
        side: degrees of the side that is said ("the north side of"); None if none.
    """

    text: str
    start: int
    end: int
    form: Form
    objects: Ints = field(default_factory=lambda: NO_OBJECTS)
    weights: Floats = field(default_factory=lambda: NO_WEIGHTS)
    lines_m: Floats = field(default_factory=lambda: NO_LINES)
    trust: float = 1.0
    is_exact: bool = False
    kinds: tuple[str, ...] = ()
    cue: Cue = SEEN
    side: float | None = None

    @classmethod
    def of(cls, span: Span, words: Sequence[Word], text: str) -> "Mention":
        """A span of a text, without its cue."""
        start, end = words[span.first].start, words[span.last].end
        given, kinds = (text[start:end], start, end, span.form), tuple(span.kinds)
        if span.match is None:
            return cls(*given, kinds=kinds)
        match = span.match
        return cls(*given, match.objects, match.weights, NO_LINES, match.trust, match.is_exact, kinds)


_W = english()
_BREAK = _W.pattern("clauses", "break")
_GOES_ON, _ENDS_OPEN = _W.pattern("clauses", "goes_on"), _W.pattern("clauses", "ends_open")
_EGO_END = _W.pattern("clauses", "ego_end")
_SENTENCE = re.compile(r"[.;!?\n]+(?:\s|$)")
_SIDE = re.compile(
    rf"\b(?:on|in|at|to|along|up on)?\s*(?:the\s+)?(?:very\s+|far\s+)?({WIND_WORD})(?:ern|most)?\s+"
    r"(?:side|end|corner|edge|part|half|bank)(?:\s+(?:of|on))?\b"
)
_APPOSED = re.compile(r"(?:the|a|an|that|this|those|our)\s+(?:[\w'-]+\s*){1,4}")
_LISTED = re.compile(r"\s*(?:,|and|&|n|or|with|,\s*(?:and|with))?\s*(?:the|a|an|that|some|our)?\s*", re.IGNORECASE)
_WITH = re.compile(r"\bwith\s+(?:the|a|an|that|some|our)?\s*$", re.IGNORECASE)
_OWNER = re.compile(r"['’`´]s$")  # noqa: RUF001
_BARE = re.compile(r"^\s*(?:on|at|in|to)\s*(?:the)?\s*$")
_SEEN_FROM = re.compile(r"\b(?:of|from|to|than)\s+$", re.IGNORECASE)
_AGAIN = re.compile(r"\b(?:the|this|that|our|my)\s+$", re.IGNORECASE)


def without_again(text: str, mentions: Sequence[Mention]) -> tuple[str, list[Mention]]:
    """Without kinds that others are seen from, which become "it": "The Apple Store is a block east of the cafe"."""
    first: dict[tuple[str, ...], Mention] = {}
    kept = []
    for mention in mentions:
        known = first.get(mention.kinds) if mention.kinds and mention.form == "thing" else None
        again = _AGAIN.search(text[: mention.start]) if known is not None else None
        is_again = known is not None and mention.text.lower() in known.text.lower() and not mention.is_exact
        if again is not None and is_again and _SEEN_FROM.search(text[: again.start()]):
            text = text[: again.start()] + "it".ljust(mention.end - again.start()) + text[mention.end :]
            continue
        first.setdefault(mention.kinds, mention)
        kept.append(mention)
    return text, kept


def with_cues(text: str, mentions: Sequence[Mention]) -> list[Mention]:
    """Mentions with what the words round each say of it."""
    order = sorted(range(len(mentions)), key=lambda n: mentions[n].start)
    before, after = [""] * len(mentions), [""] * len(mentions)
    end = 0
    for k, n in enumerate(order):
        gap = text[end : mentions[n].start]
        if k == 0:
            before[n] = _SENTENCE.split(gap)[-1]
        else:
            after[order[k - 1]], before[n] = _shared(gap)
        end = max(end, mentions[n].end)
    if order:
        after[order[-1]] = _SENTENCE.split(text[end:])[0]
    return [_with_cue(mention, spelt(before[n]), spelt(after[n])) for n, mention in enumerate(mentions)]


def listed(text: str, mentions: Sequence[Mention]) -> list[Mention]:
    """Things of a list share where they are: "the bank and the cash machine to my left"."""
    found = sorted(mentions, key=lambda mention: mention.start)
    for n in range(len(found) - 1):
        one, other = found[n], found[n + 1]
        gap = text[one.end : other.start]
        if not one.form == other.form == "thing" or not gap.strip():
            continue
        is_list = _LISTED.fullmatch(gap) is not None
        if is_list and one.cue == SEEN and other.cue.angle is not None:
            found[n] = replace(one, cue=other.cue)
        elif (is_list or _WITH.search(gap)) and other.cue == SEEN and one.cue.angle is not None:
            found[n + 1] = replace(other, cue=one.cue)
    return found


def joined(text: str, mentions: Sequence[Mention]) -> list[Mention]:
    """Mentions of one thing as one, with what each says of it: "by the TV tower ... The tower's on my left"."""
    kept: list[Mention] = []
    for mention in mentions:
        name = _OWNER.sub("", mention.text.lower())
        again = _AGAIN.search(text[: mention.start]) is not None and mention.form == "thing" and not mention.is_exact
        same = [n for n, one in enumerate(kept) if again and one.form == "thing" and _is_same(one.text.lower(), name)]
        same = same or _called_so(kept, mention)
        if not same:
            kept.append(mention)
            continue
        first, later = kept[same[-1]], mention.cue
        cue = replace(
            first.cue,
            angle=first.cue.angle if later.angle is None else later.angle,
            wind=first.cue.wind if later.wind is None else later.wind,
            distance_m=first.cue.distance_m if later.distance_m is None else later.distance_m,
            is_loose=first.cue.is_loose or later.is_loose,
        )
        kept[same[-1]] = replace(first, cue=cue)
    return kept


def _called_so(kept: Sequence[Mention], mention: Mention) -> list[int]:
    """The named thing right before that a mere kind stands for: "outside the Motel One, hotel's on my right"."""
    last = kept[-1] if kept else None
    if last is None or last.form != "thing" or mention.form != "thing" or not mention.kinds or mention.is_exact:
        return []
    is_named = last.is_exact and last.cue.angle is None and last.cue.relation in ("at", "outside", "beside", "inside")
    is_such = bool(np.isin(last.objects, mention.objects).all()) and mention.cue.angle is not None
    return [len(kept) - 1] if is_named and is_such else []


def _is_same(longer: str, name: str) -> bool:
    return f" {_OWNER.sub('', longer)}".endswith(f" {name}")


def _with_cue(mention: Mention, before: str, after: str) -> Mention:
    has_side = mention.form in ("street", "span", "corner")
    side = _SIDE.search(f"{before} | {after}") if has_side else None
    told = mention.form in ("corner", "span") and mention.cue != SEEN  # by the words between its streets
    cue = mention.cue if told else cue_of(_SIDE.sub(" on ", before), _SIDE.sub(" ", after))
    return replace(mention, cue=cue, side=wind_of(side[1]) if side else None)


def _shared(gap: str) -> tuple[str, str]:
    """What of the words between two things belongs to the first, and what to the second."""
    ends = list(_SENTENCE.finditer(gap))
    if ends:
        return gap[: ends[0].start()], gap[ends[-1].end() :]
    breaks = list(_BREAK.finditer(gap))
    if breaks:
        # of several clauses those that go on about where ("ahead on my left, across 29th, and") belong to the first
        cut = breaks[0]
        begin = cut.end()
        for piece in breaks[1:]:
            part = spelt(gap[begin : piece.start()])
            begin = piece.end()
            if _APPOSED.fullmatch(part):
                continue  # "Sanomatalo, the glass building, is ahead"
            if not part or _ENDS_OPEN.search(part) or not _GOES_ON.search(f"{part} "):
                break
            cut = piece
        return gap[: cut.start()], gap[cut.end() :]
    side = _SIDE.search(gap.lower())
    if side and side.start() > 0:
        return gap[: side.start()], gap[side.start() :]
    words = spelt(gap)
    if _GOES_ON.search(f"{words} ") and not _BARE.search(words):
        ego = list(_EGO_END.finditer(gap))
        if ego:
            return gap[: ego[-1].end()], gap[ego[-1].end() :]
    return "", gap
