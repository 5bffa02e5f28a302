"""Read which mentions a text takes back, denies, or puts in the past."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Final

from models.language.languages.tabulated import Language
from models.language.mentions.mentions import Mention

PAST_TRUST: Final = 0.2  # factor on the trust of what the speaker has left, where the text also says what is there now


def without_corrected(text: str, mentions: Sequence[Mention], language: Language) -> list[Mention]:
    """Leave out mentions that a text takes back: "on Annankatu, no wait, Yrjönkatu"."""
    result = list(mentions)
    for start, end in language.corrections(text):
        before = [mention for mention in result if mention.end <= start]
        after = [mention for mention in result if mention.start >= end]
        if not before or not after or "\n" in text[before[-1].end : start]:
            continue
        new = after[0]
        alike = [mention for mention in before if (mention.form, bool(mention.kinds)) == (new.form, bool(new.kinds))]
        old = (alike or before)[-1]
        # "near Kiasma, actually right in front of it" corrects nothing else
        if new.text.lower() != old.text.lower():
            result = [mention for mention in result if mention is not old]
    return result


def with_standing(text: str, mentions: Sequence[Mention], language: Language) -> list[Mention]:
    """Mark mentions that a text denies ("not near Kiasma"), and trust those in the past less ("passed the bank")."""
    starts = language.clause_starts(text)
    is_past = [language.is_past(text[start:end]) for start, end in pairwise([*starts, len(text)])]
    number = [sum(start <= mention.start for start in starts) - 1 for mention in mentions]
    has_present = any(not is_past[n] for n in number)
    result = []
    for mention, n in zip(mentions, number, strict=True):
        if language.is_denied(text, mention.start, mention.end):
            result.append(replace(mention, is_denied=True))
        elif has_present and is_past[n]:
            result.append(replace(mention, trust=PAST_TRUST * mention.trust))
        else:
            result.append(mention)
    return result
