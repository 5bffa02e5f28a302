"""Descriptions through the reader, in pieces that it can take, and back to the places in them."""

from collections import OrderedDict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from index.answering.answers import Evidence
from models.language.parsed_hint import ParsedHint
from models.language.reader import Reader
from models.language.sentences import locate_spans, split_for_reader

LONGEST = 800  # characters that are read at once; longer descriptions are read in pieces
KEPT_TEXTS = 2000
READ_AT_ONCE = 16


class Texts:
    """Reads descriptions. Not thread-safe.

    Args:
        reader: trained.
    """

    def __init__(self, reader: Reader) -> None:
        self._reader = reader
        self._kept: OrderedDict[str, tuple[ParsedHint, ...]] = OrderedDict()

    def parse(self, descriptions: Sequence[str]) -> list[tuple[ParsedHint, ...]]:
        """What each description names; several go through the reader together, the latest are remembered.

        Characters are those of `split_for_reader`, joined by blanks.
        """
        pieces = [split_for_reader(description, LONGEST) for description in descriptions]
        texts = [text for some in pieces for text in some]
        kept = self._kept
        new = sorted({text for text in texts if text not in kept}, key=len)  # those of like length together
        for start in range(0, len(new), READ_AT_ONCE):
            some = new[start : start + READ_AT_ONCE]
            kept.update((text, tuple(found)) for text, found in zip(some, self._reader.read(some), strict=True))
        for text in texts:
            kept.move_to_end(text)
        parsed = [tuple(_shifted(some, kept)) for some in pieces]
        while len(kept) > KEPT_TEXTS:
            kept.popitem(last=False)
        return parsed


def as_read(description: str) -> str:
    """The text that the places of hints and mentions are of."""
    return " ".join(split_for_reader(description, LONGEST)) or description


def in_the_text(description: str, evidence: Sequence[Evidence]) -> tuple[Evidence, ...]:
    """Evidence with its places in the description, not in what was made of it for the reader."""
    spans = locate_spans(description, as_read(description), [hint.span or (0, 0) for hint in evidence])
    return tuple(replace(hint, span=span) for hint, span in zip(evidence, spans, strict=True))


def _shifted(pieces: Sequence[str], read: Mapping[str, Sequence[ParsedHint]]) -> Iterator[ParsedHint]:
    """The hints of the pieces of a text, with their places in the whole."""
    before = 0
    for piece in pieces:
        yield from (hint.shifted(before) for hint in read[piece])
        before += len(piece) + 1
