"""Read which mentions a text takes back, denies, or puts in the past."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

from models.language.mentions.mentions import Mention
from models.language.mentions.word_lists import english

PAST_TRUST: Final = 0.2  # factor on the trust of what the speaker has left, where the text also says what is there now
_W = english()
_CORRECTION = _W.pattern("discourse", "correction", r"[\s,.;:!?\u2013\u2014-]*\b(?:{})\b[\s,:-]*")
_DENIED = _W.pattern("discourse", "denied", r"\b(?:{})\s+(?:the\s+)?$")
_PAST, _NOW = (_W.pattern("discourse", name, r"\b(?:{})\b") for name in ("past", "now"))
_CLAUSE_END = _W.pattern("discourse", "clause_end")


def without_corrected(text: str, mentions: Sequence[Mention]) -> list[Mention]:
    """Leave out mentions that a text takes back: "on Annankatu, no wait, Yrjönkatu"."""
    result = list(mentions)
    for marker in _CORRECTION.finditer(text):
        before = [mention for mention in result if mention.end <= marker.start()]
        after = [mention for mention in result if mention.start >= marker.end()]
        if not before or not after or "\n" in text[before[-1].end : marker.start()]:
            continue
        new = after[0]
        alike = [mention for mention in before if (mention.form, bool(mention.kinds)) == (new.form, bool(new.kinds))]
        old = (alike or before)[-1]
        # "near Kiasma, actually right in front of it" corrects nothing else
        if new.text.lower() != old.text.lower():
            result = [mention for mention in result if mention is not old]
    return result


def with_standing(text: str, mentions: Sequence[Mention]) -> list[Mention]:
    """Mark mentions that a text denies ("not near Kiasma"), and trust those in the past less ("passed the bank")."""
    clauses = list(_clauses(text))
    is_past = [_PAST.search(clause) is not None and _NOW.search(clause) is None for _, clause in clauses]
    number = [sum(start <= mention.start for start, _ in clauses) - 1 for mention in mentions]
    has_present = any(not is_past[n] for n in number)
    result = []
    for mention, n in zip(mentions, number, strict=True):
        if _DENIED.search(text[: mention.start]) is not None:
            result.append(replace(mention, is_denied=True))
        elif has_present and is_past[n]:
            result.append(replace(mention, trust=PAST_TRUST * mention.trust))
        else:
            result.append(mention)
    return result


def _clauses(text: str) -> Iterator[tuple[int, str]]:
    """Yield the clauses of a text with their starts."""
    starts = [0, *(match.end() for match in _CLAUSE_END.finditer(text))]
    for start, end in zip(starts, [*starts[1:], len(text)], strict=True):
        yield start, text[start:end]
