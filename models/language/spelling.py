"""Misspelt words of nouns, mended by the words that things go by."""

import re
from collections.abc import Callable, Iterable
from functools import lru_cache

from rapidfuzz import process
from rapidfuzz.distance import OSA

SHORTEST = 5  # letters; shorter words are too often another word but for a letter
LIKE = 0.75  # share of the letters that must agree
_WORD = re.compile(rf"[a-z]{{{SHORTEST},}}")


class Spelling:
    """Mends what is no word.

    Args:
        known: words and phrases in lower case, any of whose words may have been meant.
        pieces: the parts that a word falls into; a word of one part is left alone, and so is one of two longer words
            ("sidewall"), given by `is_word`.
        is_word: whether a part is a word by itself.
    """

    def __init__(
        self, known: Iterable[str], pieces: Callable[[str], list[str]], is_word: Callable[[str], bool]
    ) -> None:
        self._known = sorted({word for phrase in known for word in _WORD.findall(phrase)})
        self._is_known = frozenset(self._known)
        self._pieces, self._is_word = pieces, is_word
        self._mended = lru_cache(maxsize=4096)(self._mend)

    def mend(self, phrase: str) -> str:
        """A phrase in lower case with its misspelt words mended."""
        return _WORD.sub(lambda found: self._mended(found[0]), phrase)

    def _mend(self, word: str) -> str:
        if word in self._is_known:
            return word
        pieces = self._pieces(word)
        if len(pieces) == 1 or (len(pieces) == 2 and all(len(p) > 3 and self._is_word(p) for p in pieces)):
            return word
        like = process.extractOne(word, self._known, scorer=OSA.normalized_similarity, score_cutoff=LIKE)
        return word if like is None else like[0]
