"""Parsing of descriptions in chunks that the hint reader accepts, and character spans in the original text."""

from collections import OrderedDict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from index.answering.answers import Evidence
from models.language.parsed_hint import ParsedHint
from models.language.reader import Reader
from models.language.sentences import locate_spans, split_for_reader

MAX_CHUNK_CHARS = 800  # bounds the reader's memory
CACHED_CHUNKS = 2000
CHUNKS_PER_BATCH = 16


class ChunkReader:
    """Parses descriptions chunk by chunk. Not thread-safe."""

    def __init__(self, reader: Reader) -> None:
        self._reader = reader
        self._cache: OrderedDict[str, tuple[ParsedHint, ...]] = OrderedDict()

    def parse(self, descriptions: Sequence[str]) -> list[tuple[ParsedHint, ...]]:
        """Return the hints of each description; chunks form batches, and the latest are cached.

        Spans refer to the chunks of `split_for_reader`, joined by blanks.
        """
        chunked = [split_for_reader(description, MAX_CHUNK_CHARS) for description in descriptions]
        texts = [text for chunks in chunked for text in chunks]
        cache = self._cache
        new = sorted({text for text in texts if text not in cache}, key=len)  # similar lengths form a batch
        for start in range(0, len(new), CHUNKS_PER_BATCH):
            chunks = new[start : start + CHUNKS_PER_BATCH]
            cache.update((text, tuple(hints)) for text, hints in zip(chunks, self._reader.read(chunks), strict=True))
        for text in texts:
            cache.move_to_end(text)
        parsed = [tuple(_shift_hints(chunks, cache)) for chunks in chunked]
        while len(cache) > CACHED_CHUNKS:
            cache.popitem(last=False)
        return parsed


def reader_text(description: str) -> str:
    """Return the text that the spans of hints and mentions refer to."""
    return " ".join(split_for_reader(description, MAX_CHUNK_CHARS)) or description


def with_description_spans(description: str, evidence: Sequence[Evidence]) -> tuple[Evidence, ...]:
    """Return evidence with spans in the original description."""
    spans = locate_spans(description, reader_text(description), [hint.span or (0, 0) for hint in evidence])
    return tuple(replace(hint, span=span) for hint, span in zip(evidence, spans, strict=True))


def _shift_hints(chunks: Sequence[str], read: Mapping[str, Sequence[ParsedHint]]) -> Iterator[ParsedHint]:
    before = 0
    for chunk in chunks:
        yield from (hint.shifted(before) for hint in read[chunk])
        before += len(chunk) + 1
