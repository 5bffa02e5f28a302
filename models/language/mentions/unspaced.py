"""Split texts in scripts without spaces between words: Chinese and Japanese."""

import re
from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final

from models.language.mentions.names import Word

UNSPACED: Final = r"\u3040-\u30ff\u3400-\u9fff\uff66-\uff9f"  # a range of letters: kana and Han
MIN_CHARACTERS, MAX_CHARACTERS = 2, 24  # of a known word
_UNSPACED: Final = re.compile(f"[{UNSPACED}]")


def is_unspaced(text: str) -> bool:
    """Return whether a text has a letter of a script without spaces between words."""
    return _UNSPACED.search(text) is not None


def unspaced_words(words: Iterable[str]) -> frozenset[str]:
    """Return the words of the scripts without spaces."""
    return frozenset(word for word in words if len(word) >= MIN_CHARACTERS and is_unspaced(word))


def split_unspaced(words: Sequence[Word], known: Sequence[Container[str]]) -> Iterator[Word]:
    """Yield words; those without spaces between them are split at known words, preferring long ones."""
    for word in words:
        if not is_unspaced(word.plain) or len(word.plain) != word.end - word.start:
            yield word
            continue
        start = n = 0
        while n < len(word.plain):
            ends = range(min(n + MAX_CHARACTERS, len(word.plain)), n + MIN_CHARACTERS - 1, -1)
            end = next((end for end in ends if any(word.plain[n:end] in group for group in known)), None)
            if end is not None:
                yield from _part(word, start, n)
                yield from _part(word, n, end)
            start, n = (start, n + 1) if end is None else (end, end)
        yield from _part(word, start, len(word.plain))


def _part(word: Word, start: int, end: int) -> Iterator[Word]:
    if start < end:
        yield replace(word, plain=word.plain[start:end], start=word.start + start, end=word.start + end, owner="")
