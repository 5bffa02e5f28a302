"""Split texts in scripts without spaces between words: Chinese and Japanese."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final

from marisa_trie import Trie

from models.language.mentions.names import Word

UNSPACED: Final = r"\u3040-\u30ff\u3400-\u9fff\uff66-\uff9f"  # a range of letters: kana and Han
MIN_CHARACTERS: Final = 2  # of a known word
_UNSPACED: Final = re.compile(f"[{UNSPACED}]")


def is_unspaced(text: str) -> bool:
    """Return whether a text has a letter of a script without spaces between words."""
    return _UNSPACED.search(text) is not None


def known_words(words: Iterable[str]) -> Trie:
    """Return the words of the scripts without spaces."""
    return Trie(word for word in words if len(word) >= MIN_CHARACTERS and is_unspaced(word))


def split_unspaced(words: Sequence[Word], known: Sequence[Trie]) -> Iterator[Word]:
    """Yield words; those without spaces between them are split at known words, preferring long ones."""
    for word in words:
        if not is_unspaced(word.plain) or len(word.plain) != word.end - word.start:
            yield word
            continue
        start = n = 0
        while n < len(word.plain):
            rest = word.plain[n:]
            longest = max((found for trie in known for found in trie.prefixes(rest)), key=len, default="")
            if longest:
                yield from _part(word, start, n)
                yield from _part(word, n, n + len(longest))
                start = n + len(longest)
            n += max(len(longest), 1)
        yield from _part(word, start, len(word.plain))


def _part(word: Word, start: int, end: int) -> Iterator[Word]:
    if start < end:
        yield replace(word, plain=word.plain[start:end], start=word.start + start, end=word.start + end, owner="")
