"""Correct misspelt words by the known names of things."""

import re
from collections.abc import Callable, Iterable
from functools import lru_cache

from rapidfuzz import process
from rapidfuzz.distance import OSA

MIN_LETTERS = 5  # shorter words are too often one letter away from another word
MIN_SIMILARITY = 0.75  # normalized OSA similarity of a correction
_WORD = re.compile(rf"[a-z]{{{MIN_LETTERS},}}")


class Spelling:
    """Corrects unknown words to known ones.

    Args:
        known: words and phrases in lower case; corrections are their words.
        pieces: the tokenizer's pieces of a word. A word of one piece is left alone, like a compound ("sidewall").
        is_word: whether a piece is a word by itself.
    """

    def __init__(
        self, known: Iterable[str], pieces: Callable[[str], list[str]], is_word: Callable[[str], bool]
    ) -> None:
        self._known = sorted({word for phrase in known for word in _WORD.findall(phrase)})
        self._is_known = frozenset(self._known)
        self._pieces, self._is_word = pieces, is_word
        self._cached_correction = lru_cache(maxsize=4096)(self._correct)

    def correct(self, phrase: str) -> str:
        """Return a phrase in lower case with its misspelt words corrected."""
        return _WORD.sub(lambda match: self._cached_correction(match[0]), phrase)

    def _correct(self, word: str) -> str:
        if word in self._is_known:
            return word
        pieces = self._pieces(word)
        if len(pieces) == 1 or (len(pieces) == 2 and all(len(p) > 3 and self._is_word(p) for p in pieces)):
            return word
        like = process.extractOne(word, self._known, scorer=OSA.normalized_similarity, score_cutoff=MIN_SIMILARITY)
        return word if like is None else like[0]
