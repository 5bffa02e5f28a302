"""Descriptions as people type them: their sentences, and as texts that the reader takes."""

import re
from collections.abc import Sequence

from models.errors import DescriptionError

# A sentence ends at . ! ? ; or a line break; a dot inside a number or an abbreviation's letter does not end one.
_BREAK = re.compile(r"(?<=[.!?;。！？])(?<!\b\w\.)(?=\s|$)|[\r\n]+")  # noqa: RUF001  # Chinese and Japanese too
_BULLET = re.compile(r"^[ \t]*(?:[-*•–—·]+|\(?\d{1,2}[.)])[ \t]+", re.M)  # noqa: RUF001  # a dash too
_HAS_WORD = re.compile(r"\w")
_SEMICOLON = re.compile(r";(?=\s|$)")
_SENTENCE_ENDS = (".", "!", "?", ";", ":")


def split_hints(description: str) -> tuple[str, ...]:
    """The sentences of a description, or the lines of a list, one hint each.

    Args:
        description: any text; sentences end at . ! ? ; or a line break.

    Raises:
        DescriptionError: there is no letter or digit in it, but for the numbers of a list.
    """
    sentences = (part.strip(" \t;,") for part in _BREAK.split(_BULLET.sub("", description)))
    hints = tuple(sentence for sentence in sentences if _HAS_WORD.search(sentence))
    if not hints:
        raise DescriptionError(
            "the description has no words; say what is around you, for example 'I am north of a gray building.'"
        )
    return hints


def spans_in(description: str, text: str, spans: Sequence[tuple[int, int]]) -> list[tuple[int, int] | None]:
    """Where parts of what the reader took stand in the description itself; None for what does not stand there.

    Args:
        description: any text.
        text: `reader_texts` of it, joined by blanks: the same words, a few marks and blanks away.
        spans: characters start..end of `text`.
    """
    found: list[tuple[int, int] | None] = [None] * len(spans)
    drift, last, last_at = 0, -1, -1
    for n in sorted(range(len(spans)), key=lambda n: spans[n]):
        start, end = spans[n]
        places = [match.start() for match in re.finditer(re.escape(text[start:end]), description)]
        places = [place for place in places if place > last_at or start == last]
        if places and start < end:
            at = min(places, key=lambda place: abs(place - start - drift))
            found[n], drift, last, last_at = (at, at + end - start), at - start, start, at
    return found


def reader_texts(description: str, longest: int) -> list[str]:
    """A description as the reader takes it: lines become sentences; what is long is cut between sentences.

    Args:
        description: any text.
        longest: characters of a text; a longer sentence is left whole.
    """
    lines = (line.strip(" \t;,") for line in _BULLET.sub("", description).splitlines())
    ended = (line if line.endswith(_SENTENCE_ENDS) else line + "." for line in lines if _HAS_WORD.search(line))
    whole = _SEMICOLON.sub(".", " ".join(ended))
    if len(whole) <= longest:
        return [whole] if whole else []
    texts = [""]
    for sentence in filter(None, map(str.strip, _BREAK.split(whole))):
        if texts[-1] and len(texts[-1]) + len(sentence) > longest:
            texts.append("")
        texts[-1] = f"{texts[-1]} {sentence}".strip()
    return texts
