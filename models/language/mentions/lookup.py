"""A map's objects by what they are called: exactly, in part, misspelt, by kind."""

from collections.abc import Callable, Container, KeysView, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache, reduce
from math import log
from typing import Final

import numpy as np
from cachetools import LRUCache, cachedmethod
from rapidfuzz import fuzz, process

from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.kinds.vocabulary import Vocabulary
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.mentions.languages import ENGLISH
from models.language.mentions.name_table import BETWEEN, NameTable
from models.language.mentions.names import ARTICLES, plain_word, plain_words
from models.language.mentions.streets import full_words
from models.language.mentions.word_lists import english

Nouns = Mapping[str, tuple[tuple[str, float], ...]]
LIKE: Final = 84.0  # of 100, rapidfuzz.fuzz.ratio, from which on a misspelt name is meant
SHORTEST_MISSPELT: Final = 5
LEAST_SHARE: Final = 0.35  # of a name's weight that a part of it must bear
PART: Final = 0.5  # weight of a part of a name beside whole ones
KEPT: Final = 4096  # phrases whose kinds, and whose streets, are remembered
KEPT_BYTES: Final = 2**24  # of the objects of kinds
_NONE: Final = np.zeros(0, np.int64)
EMPTY: Final = ARTICLES | english().list("empty")


@dataclass(frozen=True, slots=True, eq=False)
class Match:
    """Objects that words may mean.

    Attributes:
        objects: [n] of the gazetteer.
        weights: [n] relative.
        trust: that the words mean one of them.
        is_exact: whether a whole name was said as it is written, or as a chain is also called.
    """

    objects: Ints
    weights: Floats
    trust: float
    is_exact: bool


class Lookup:
    """Names and kinds of one gazetteer.

    Args:
        gazetteer: of the map.
        vocabulary: nouns of kinds.
        is_common: whether a plain word is an everyday one, which is seldom meant as a name.
        table: of the gazetteer; None to make it.
    """

    def __init__(
        self,
        gazetteer: Gazetteer,
        vocabulary: Vocabulary,
        is_common: Callable[[str], bool],
        table: NameTable | None = None,
    ) -> None:
        self.gazetteer, self.vocabulary, self.is_common = gazetteer, vocabulary, is_common
        self._table = NameTable.of(gazetteer, vocabulary, is_common) if table is None else table
        self._nouns = self._plain_nouns(ENGLISH)
        self._kinds = lru_cache(maxsize=KEPT)(self._kinds_of)
        self._streets = lru_cache(maxsize=KEPT)(self._streets_of)
        self._of_kinds: LRUCache[tuple[tuple[str, float], ...], Match | None] = LRUCache(KEPT_BYTES, _bytes_of)

    def worth(self, word: str) -> float:
        """How much a word of a name tells: the rarer, the more."""
        if word in EMPTY:
            return 0.1
        worth = log((len(self._table.names) + 10) / (self._table.words.count(word) + 1))
        return worth * (0.6 if self.is_common(word) else 1.0)

    def street(self, words: Sequence[str]) -> Match | None:
        """Streets of a name in any of its forms."""
        return self._streets(tuple(words))

    def _streets_of(self, words: tuple[str, ...]) -> Match | None:
        rows = self._table.streets.find(" ".join(words))
        if not len(rows):
            rows = self._table.streets.find(" ".join(full_words(words)))
        if not len(rows):
            return None
        weights = self._table.weight[rows]
        return Match(self._table.street[rows], weights, 1.0, bool(weights.max() == 1.0))

    @property
    def street_words(self) -> Container[str]:
        """Every word of a street's name."""
        return self._table.street_words

    def street_like(self, word: str) -> Match | None:
        """Streets of one long word that is misspelt."""
        if len(word) < SHORTEST_MISSPELT + 2 or self.is_common(word):
            return None
        like = process.extract(word, self._single_streets, scorer=fuzz.ratio, score_cutoff=LIKE, limit=2)
        if not like:
            return None
        rows = [self._table.streets.find(name) for name, _, _ in like]
        found = {n: s / 100 for of, (_, s, _) in zip(rows, like, strict=True) for n in self._table.street[of].tolist()}
        return _match(found, 0.8, is_exact=False)

    def address(self, number: str, streets: Ints) -> tuple[Ints, Floats]:
        """The objects with a house number of one of some streets; else [n, 4] places between the numbers beside it.

        None of either for a number past the end of the street.
        """
        of_streets = (name for s in streets for name in self.gazetteer.objects[s].names)
        names = dict.fromkeys(" ".join(full_words(plain_words(name))) for name in of_streets)
        known = {n: rows for name in names for n, rows in self._table.numbers.with_prefix(name + BETWEEN)}
        if not known:
            return np.zeros(0, np.int64), np.zeros((0, 4))
        same = [rows for n, rows in known.items() if n == number.lower()]
        if same:
            return np.concatenate([np.array(rows) for rows in same]), np.zeros((0, 4))
        plain = {int(n): rows[0] for n, rows in known.items() if n.isdecimal()}
        wanted = int("".join(c for c in number if c.isdigit()))
        low = max((n for n in plain if n < wanted and n % 2 == wanted % 2), default=None)
        high = min((n for n in plain if n > wanted and n % 2 == wanted % 2), default=None)
        if low is None or high is None:
            return np.zeros(0, np.int64), np.zeros((0, 4))
        middles, share = self.gazetteer.middles_m, (wanted - low) / (high - low)
        at = (1 - share) * middles[plain[low]] + share * middles[plain[high]]
        return np.zeros(0, np.int64), np.concatenate([at, at])[None]

    def named(self, words: Sequence[str]) -> Match | None:
        """Objects that bear a name, or of whose names the words are a telling part."""
        table, joined = self._table, " ".join(words)
        exact = dict.fromkeys(table.names.find(joined).tolist(), 1.0)
        if not exact and joined in table.spellings:
            return _match(dict.fromkeys(table.spellings.find(joined).tolist(), 1.0), 1.0, is_exact=True)
        content = [word for word in words if word not in EMPTY]
        is_part = bool(content) and all(word in table.words for word in content)
        if not is_part or not any(self._is_telling(word) for word in content):
            return _match(exact, 1.0, is_exact=True)
        rows = reduce(np.intersect1d, (table.words.find(word) for word in content))
        said = sum(self.worth(word) for word in content)
        found: dict[int, float] = {}
        for row in rows.tolist():
            share = said / sum(self.worth(word) for word in table.names.key(row).split())
            if share >= LEAST_SHARE:
                for number in table.names.row_numbers(row).tolist():
                    found[number] = max(found.get(number, 0.0), share**0.5)
        if exact:
            return _match({n: PART * weight for n, weight in found.items()} | exact, 1.0, is_exact=True)
        return _match(found, 0.9, is_exact=False)

    def misspelt(self, words: Sequence[str]) -> Match | None:
        """Objects whose names differ by a letter in six or so."""
        joined = " ".join(words)
        if len(joined) < SHORTEST_MISSPELT or all(self.is_common(word) for word in words):
            return None
        names = self._table.names
        like = process.extract(joined, names.all_keys, scorer=fuzz.ratio, score_cutoff=LIKE, limit=3)
        found = {n: (score / 100) ** 4 for _, score, row in like for n in names.row_numbers(row).tolist()}
        return _match(found, 0.8, is_exact=False)

    def is_strange(self, word: str) -> bool:
        """Whether a word is in no name, street or noun, and no everyday one: misspelt, or a name that is not here."""
        is_noun = any(form in self.noun_words for form in _singulars(word))
        known = is_noun or word in self._table.words or word in self._table.street_words
        return not known and not self.is_common(word) and word.isalpha()

    def is_name(self, words: Sequence[str]) -> bool:
        """Whether words are a whole name."""
        return " ".join(words) in self._table.names

    def phrases(self) -> list[str]:
        """Every name of two words or more, and every such noun of a kind that the map has."""
        here = self.gazetteer.by_kind
        nouns = (noun for noun, kinds in self._nouns.items() if any(kind in here for kind, _ in kinds))
        return sorted({phrase for phrase in (*self._table.names.all_keys, *nouns) if " " in phrase})

    def kinds(self, words: Sequence[str], language: str = ENGLISH) -> Mapping[str, float]:
        """The kinds that a noun means, and how surely; none for many."""
        return self._kinds(tuple(words), language)

    def foreign_kinds(self, word: str) -> Mapping[str, float]:
        """The kinds that a word means in some other language: "the Kahvila"."""
        return dict(self._foreign.get(word, ()))

    def of_kinds(self, kinds: Mapping[str, float]) -> Match | None:
        """Objects of some kinds, each as surely as the surest of its kinds."""
        return self._objects_of(tuple(kinds.items()))

    @cachedmethod(lambda lookup: lookup._of_kinds)
    def _objects_of(self, kinds: tuple[tuple[str, float], ...]) -> Match | None:
        some = [self.gazetteer.by_kind.get(kind, _NONE) for kind, _ in kinds]
        objects, row = np.unique(np.concatenate([_NONE, *some]), return_inverse=True)
        if not len(objects):
            return None
        weights = np.zeros(len(objects))
        np.maximum.at(weights, row, np.repeat([weight for _, weight in kinds], [len(rows) for rows in some]))
        return Match(objects, weights, 1.0, False)

    @cached_property
    def noun_words(self) -> KeysView[str]:
        """Every word of every noun, short ones first: a misspelt word may be like several, and means the first."""
        words = {word for noun in self._nouns for word in noun.split()}
        return dict.fromkeys(sorted(words, key=lambda word: (len(word), word))).keys()

    @cached_property
    def _single_streets(self) -> list[str]:
        return [form for form in self._table.streets.all_keys if " " not in form]

    def _is_telling(self, word: str) -> bool:
        return self._table.words.count(word) <= 40 and word not in EMPTY and len(word) > 1 and not word[0].isdigit()

    def _plain_nouns(self, language: str) -> Nouns:
        nouns = self.vocabulary.nouns(language)
        return {" ".join(plain_words(noun)): kinds for noun, kinds in nouns.items()}

    @cached_property
    def _foreign(self) -> Nouns:
        """Nouns of one word, of every language that the vocabulary has, without accents."""
        found: dict[str, tuple[tuple[str, float], ...]] = {}
        for noun, kinds in self.vocabulary.single_words(SHORTEST_MISSPELT):
            found.setdefault(plain_word(noun), kinds)
        return found

    def _kinds_of(self, words: tuple[str, ...], language: str) -> Mapping[str, float]:
        nouns = self._nouns if language == ENGLISH else self._plain_nouns(language)
        for last in _singulars(words[-1]):
            found = nouns.get(" ".join((*words[:-1], last)))
            if found:
                return dict(found)
        return {}


def _singulars(word: str) -> list[str]:
    forms = [word]
    if word.endswith("ies") and len(word) > 4:
        forms.append(word[:-3] + "y")
    if word.endswith("es") and len(word) > 4:
        forms.append(word[:-2])
    if word.endswith("s") and not word.endswith("ss") and len(word) > 3:
        forms.append(word[:-1])
    return forms


def _match(found: Mapping[int, float], trust: float, *, is_exact: bool) -> Match | None:
    if not found:
        return None
    return Match(np.array(list(found)), np.array(list(found.values())), trust, is_exact)


def _bytes_of(match: Match | None) -> int:
    """About what it takes in memory."""
    return 500 + (0 if match is None else match.objects.nbytes + match.weights.nbytes)
