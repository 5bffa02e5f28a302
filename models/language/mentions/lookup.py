"""Look up the objects of a map by name: exact, partial or misspelt, and by kind."""

from collections.abc import Callable, Container, Iterable, Iterator, KeysView, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, reduce
from itertools import chain, islice, product
from math import log
from typing import Final

import numpy as np
from cachetools import LRUCache, cachedmethod
from rapidfuzz import fuzz, process

from models.citymap.gazetteer.gazetteer import ADDRESS_KIND, WALKED_KIND, Gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND
from models.citymap.kinds.vocabulary import Vocabulary
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.languages.table import is_inflected, shared_letters
from models.language.mentions.abbreviations import MAX_READINGS, written_out
from models.language.mentions.house_numbers import NumberMatch, first_value, match_number, plain_number
from models.language.mentions.name_table import NUMBER_SEPARATOR, NameTable
from models.language.mentions.names import ARTICLES, full_words, plain_word, plain_words
from models.language.mentions.unspaced import unspaced_words
from models.language.mentions.word_lists import english

Nouns = Mapping[str, tuple[tuple[str, float], ...]]
MIN_LIKENESS: Final = 84.0  # rapidfuzz.fuzz.ratio, of 100, of a misspelt name
MIN_MISSPELT_CHARACTERS: Final = 5
MIN_PART_SHARE: Final = 0.35  # of the word weights of a name that a part must have
PART_WEIGHT: Final = 0.5  # weight of a partial match next to exact ones
MAX_CACHED_PHRASES: Final = 4096  # with their kinds, and with their streets
SHORT_BEGINNING: Final = 2  # letters by which the words of names are grouped
MAX_BASES: Final = 4  # base forms of a word
FORM_TRUST: Final = 0.9  # of a name in another case
COMPOUND_KINDS: Final = (
    "strasse",
    "allee",
    "gasse",
    "weg",
    "platz",
    "damm",
    "ufer",
    "ring",
    "katu",
    "tie",
    "gatan",
    "straat",
    "laan",
)
MAX_CACHED_BYTES: Final = 2**24  # of objects by kind
# Between neighbours of the same side: up to this, interpolation is off by 20 m in the median, 45 m in a tenth of cases,
# measured by leaving out known numbers of 18 cities; beyond, by 40 and 150 m.
MAX_INTERPOLATED_M: Final = 150.0
_NONE: Final = np.zeros(0, np.int64)
NO_LINES: Final = np.zeros((0, 4))
OWN_KINDS: Final = {ADDRESS_KIND, STREET_KIND, WALKED_KIND}  # of the gazetteer
EMPTY: Final = ARTICLES | english().list("empty")


@dataclass(frozen=True, slots=True, eq=False)
class Match:
    """The objects that words may mean."""

    objects: Ints  # [n] of the gazetteer
    weights: Floats  # [n] relative
    trust: float  # probability that the words mean one of them
    is_exact: bool  # whether the words are a whole name, or another name of a chain


@dataclass(frozen=True, slots=True, eq=False)
class AddressMatch:
    """Where a house number is."""

    objects: Ints  # [n] of the gazetteer that have it
    lines_m: Floats  # [e, 4] without such objects, a position between its neighbours
    match: NumberMatch  # which numbers of the map it means


class Lookup:
    """Lookup in one gazetteer; `is_common` says whether a plain word is an everyday word, which is rarely a name."""

    def __init__(
        self,
        gazetteer: Gazetteer,
        vocabulary: Vocabulary,
        is_common: Callable[[str], bool],
        table: NameTable | None = None,
    ) -> None:
        self.gazetteer, self.vocabulary, self.is_common = gazetteer, vocabulary, is_common
        self._table = NameTable.from_gazetteer(gazetteer, vocabulary, is_common) if table is None else table
        self._nouns = self._plain_nouns()
        self._kinds = lru_cache(maxsize=MAX_CACHED_PHRASES)(self._kinds_of)
        self._streets = lru_cache(maxsize=MAX_CACHED_PHRASES)(self._streets_of)
        self.street_form = lru_cache(maxsize=MAX_CACHED_PHRASES)(self._street_form_of)
        self.named_form = lru_cache(maxsize=MAX_CACHED_PHRASES)(self._named_form_of)
        self._of_kinds: LRUCache[tuple[tuple[str, float], ...], Match | None] = LRUCache(MAX_CACHED_BYTES, _match_bytes)

    def word_weight(self, word: str) -> float:
        """Return the weight of a word in a name; rare words weigh more."""
        if word in EMPTY:
            return 0.1
        weight = log((len(self._table.names) + 10) / (self._table.words.count(word) + 1))
        return weight * (0.6 if self.is_common(word) else 1.0)

    def street(self, words: Sequence[str]) -> Match | None:
        """Return the streets of a name in any of its forms."""
        return self._streets(tuple(words))

    def _streets_of(self, words: tuple[str, ...]) -> Match | None:
        rows = self._table.streets.find(" ".join(words))
        readings = (full_words(words), *written_out(words)) if not len(rows) else ()
        for reading in readings:
            rows = self._table.streets.find(" ".join(reading))
            if len(rows):
                break
        if not len(rows):
            return None
        weights = self._table.weight[rows]
        return Match(self._table.street[rows], weights, 1.0, bool(weights.max() == 1.0))

    def _street_form_of(self, words: tuple[str, ...], may_be_short: bool = True) -> Match | None:
        """Return the streets of a name in another case or, if it `may_be_short`, without its kind: "Memhard-"."""
        known, beginnings = self._table.street_words, self._street_beginnings
        for reading in _readings(words, known, beginnings, loosely=len(words) > 1, may_be_short=may_be_short):
            match = self.street(reading)
            if match is not None:
                return match
        return None

    def _named_form_of(self, words: tuple[str, ...]) -> Match | None:
        """Return the objects with a name in another case: "Stockmannin"."""
        for reading in _readings(words, self._table.words, self._name_beginnings):
            match = self.named(reading)
            if match is not None:
                return replace(match, trust=FORM_TRUST * match.trust)
        return None

    @cached_property
    def _street_beginnings(self) -> Mapping[str, list[str]]:
        return _by_beginning(self._table.street_words.all_keys)

    @cached_property
    def _name_beginnings(self) -> Mapping[str, list[str]]:
        return _by_beginning(self._table.words.all_keys)

    @cached_property
    def unspaced_words(self) -> frozenset[str]:
        """The words of names and streets in scripts without spaces between words."""
        return unspaced_words(chain(self._table.words.all_keys, self._table.street_words.all_keys))

    @property
    def street_words(self) -> Container[str]:
        """All words of street names."""
        return self._table.street_words

    def street_like(self, word: str) -> Match | None:
        """Return the streets that a long misspelt word may mean."""
        if len(word) < MIN_MISSPELT_CHARACTERS + 2 or self.is_common(word):
            return None
        similar = process.extract(word, self._single_streets, scorer=fuzz.ratio, score_cutoff=MIN_LIKENESS, limit=2)
        if not similar:
            return None
        rows = [self._table.streets.find(name) for name, _, _ in similar]
        weights = {
            n: s / 100
            for form_rows, (_, s, _) in zip(rows, similar, strict=True)
            for n in self._table.street[form_rows].tolist()
        }
        return _match(weights, 0.8, is_exact=False)

    def address(self, number: str, streets: Ints) -> AddressMatch | None:
        """Return where a house number of streets is; None if it is past their ends, or far from its neighbours."""
        of_streets = (name for s in streets for name in self.gazetteer.objects[s].names)
        return self.address_of_names(number, [full_words(plain_words(name)) for name in of_streets])

    def address_of_names(self, number: str, names: Sequence[tuple[str, ...]]) -> AddressMatch | None:
        """Return where a house number is in streets or places whose names are given in plain words."""
        known = dict[str, Ints]()
        for name in dict.fromkeys(" ".join(words) for words in names):
            for key, rows in self._table.numbers.with_prefix(name + NUMBER_SEPARATOR):
                known[key] = np.concatenate([known.get(key, _NONE), rows])
        match = match_number(number, known)
        if match is None:
            return None
        if match.numbers:
            return AddressMatch(np.concatenate([known[one] for one in match.numbers]), NO_LINES, match)
        (low, low_m), (high, high_m) = (
            (n, self.gazetteer.middles_m[known[numbers[0]]].mean(axis=0)) for n, numbers in match.between
        )
        if np.hypot(*(high_m - low_m)) > MAX_INTERPOLATED_M:
            return None
        share = (first_value(plain_number(number)) - low) / (high - low)
        position = (1 - share) * low_m + share * high_m
        return AddressMatch(_NONE, np.concatenate([position, position])[None], match)

    def coded(self, kind: str, code: str) -> Ints:
        """Return the objects with a code: a stop, an exit or a road with a reference, an address with a postcode."""
        return self._table.codes.find(f"{kind} {code}").astype(np.int64)

    def has_numbers(self, name: tuple[str, ...]) -> bool:
        """Return whether a street or place of a name has house numbers."""
        return next(self._table.numbers.with_prefix(" ".join(name) + NUMBER_SEPARATOR), None) is not None

    def named(self, words: Sequence[str]) -> Match | None:
        """Return the objects with a name, or with names of which the words are a distinctive part."""
        table, joined = self._table, " ".join(words)
        exact = dict.fromkeys(table.names.find(joined).tolist(), 1.0)
        if not exact and joined in table.spellings:
            return _match(dict.fromkeys(table.spellings.find(joined).tolist(), 1.0), 1.0, is_exact=True)
        content = [word for word in words if word not in EMPTY]
        is_part = bool(content) and all(word in table.words for word in content)
        if not is_part or not any(self._is_telling(word) for word in content):
            return _match(exact, 1.0, is_exact=True)
        rows = reduce(np.intersect1d, (table.words.find(word) for word in content))
        said_weight = sum(self.word_weight(word) for word in content)
        weights: dict[int, float] = {}
        for row in rows.tolist():
            share = said_weight / sum(self.word_weight(word) for word in table.names.key(row).split())
            if share >= MIN_PART_SHARE:
                for number in table.names.row_numbers(row).tolist():
                    weights[number] = max(weights.get(number, 0.0), share**0.5)
        if exact:
            return _match({n: PART_WEIGHT * weight for n, weight in weights.items()} | exact, 1.0, is_exact=True)
        return _match(weights, 0.9, is_exact=False)

    def misspelt(self, words: Sequence[str]) -> Match | None:
        """Return the objects with a similar name."""
        joined = " ".join(words)
        if len(joined) < MIN_MISSPELT_CHARACTERS or all(self.is_common(word) for word in words):
            return None
        names = self._table.names
        similar = process.extract(joined, names.all_keys, scorer=fuzz.ratio, score_cutoff=MIN_LIKENESS, limit=3)
        weights = {n: (score / 100) ** 4 for _, score, row in similar for n in names.row_numbers(row).tolist()}
        return _match(weights, 0.8, is_exact=False)

    def is_strange(self, word: str) -> bool:
        """Return whether a word is in no name, street or noun and is not an everyday word."""
        is_noun = any(form in self.noun_words for form in _singulars(word))
        known = is_noun or word in self._table.words or word in self._table.street_words
        return not known and not self.is_common(word) and word.isalpha()

    def is_name(self, words: Sequence[str]) -> bool:
        """Return whether words are a whole name."""
        return " ".join(words) in self._table.names

    def phrases(self) -> list[str]:
        """Return the names, and the nouns of kinds in the map, that have several words."""
        by_kind = self.gazetteer.by_kind
        nouns = (noun for noun, kinds in self._nouns.items() if any(kind in by_kind for kind, _ in kinds))
        return sorted({phrase for phrase in (*self._table.names.all_keys, *nouns) if " " in phrase})

    def kinds(self, words: Sequence[str]) -> Mapping[str, float]:
        """Return the kinds that an English noun means with their weights; often none."""
        return self._kinds(tuple(words))

    def kinds_in_any_language(self, word: str) -> Mapping[str, float]:
        """Return the kinds that a word means in any language: "the Kahvila"."""
        return dict(self._foreign.get(word, ()))

    def of_kinds(self, kinds: Mapping[str, float]) -> Match | None:
        """Return the objects of kinds, each with the highest weight of its kinds."""
        return self._objects_of(tuple(kinds.items()))

    @cachedmethod(lambda lookup: lookup._of_kinds)
    def _objects_of(self, kinds: tuple[tuple[str, float], ...]) -> Match | None:
        groups = [self.gazetteer.by_kind.get(kind, _NONE) for kind, _ in kinds]
        objects, row = np.unique(np.concatenate([_NONE, *groups]), return_inverse=True)
        if not len(objects):
            return None
        weights = np.zeros(len(objects))
        np.maximum.at(weights, row, np.repeat([weight for _, weight in kinds], [len(rows) for rows in groups]))
        return Match(objects, weights, 1.0, False)

    @cached_property
    def noun_words(self) -> KeysView[str]:
        """The words of all nouns, short ones first: a misspelt word means the first similar one."""
        words = {word for noun in self._nouns for word in noun.split()}
        return dict.fromkeys(sorted(words, key=lambda word: (len(word), word))).keys()

    @cached_property
    def _single_streets(self) -> list[str]:
        return [form for form in self._table.streets.all_keys if " " not in form]

    def _is_telling(self, word: str) -> bool:
        return self._table.words.count(word) <= 40 and word not in EMPTY and len(word) > 1 and not word[0].isdigit()

    def _plain_nouns(self) -> Nouns:
        nouns = {**self._own_nouns, **self.vocabulary.nouns("en")}
        return {" ".join(plain_words(noun)): kinds for noun, kinds in nouns.items()}

    @cached_property
    def _own_nouns(self) -> Nouns:
        """Kinds of a city's own data that the vocabulary lacks; each is its own noun."""
        known = {kind.id for kind in self.vocabulary.kinds} | OWN_KINDS
        return {kind: ((kind, 1.0),) for kind in self.gazetteer.objects.known_kinds if kind not in known}

    @cached_property
    def _foreign(self) -> Nouns:
        """Nouns of one word in every language of the vocabulary, without accents."""
        nouns: dict[str, tuple[tuple[str, float], ...]] = {}
        for noun, kinds in self.vocabulary.single_words(MIN_MISSPELT_CHARACTERS):
            nouns.setdefault(plain_word(noun), kinds)
        return nouns

    def _kinds_of(self, words: tuple[str, ...]) -> Mapping[str, float]:
        for last in _singulars(words[-1]):
            kinds = self._nouns.get(" ".join((*words[:-1], last)))
            if kinds:
                return dict(kinds)
        return {}


def _by_beginning(words: Iterable[str]) -> Mapping[str, list[str]]:
    beginnings: dict[str, list[str]] = {}
    for word in words:
        if not word[0].isdecimal():
            beginnings.setdefault(word[:SHORT_BEGINNING], []).append(word)
    return beginnings


def _readings(
    words: Sequence[str],
    known: Container[str],
    beginnings: Mapping[str, list[str]],
    *,
    loosely: bool = False,
    may_be_short: bool = True,
) -> Iterator[tuple[str, ...]]:
    """Yield the names of which words may be a form, likely ones first."""
    options = []
    for word in words:
        similar = beginnings.get(word[:SHORT_BEGINNING], ())
        near = [
            base
            for base in similar
            if is_inflected(word, base, loosely=loosely) or (may_be_short and _is_without_kind(word, base))
        ]
        near.sort(key=lambda base: (-shared_letters(word, base), len(base)))
        options.append([word] if word in known or not near else near[:MAX_BASES])
    for reading in islice(product(*options), MAX_READINGS):
        if reading != tuple(words):
            yield reading


def _is_without_kind(word: str, base: str) -> bool:
    return any(base == word + kind for kind in COMPOUND_KINDS)


def _singulars(word: str) -> list[str]:
    forms = [word]
    if word.endswith("ies") and len(word) > 4:
        forms.append(word[:-3] + "y")
    if word.endswith("es") and len(word) > 4:
        forms.append(word[:-2])
    if word.endswith("s") and not word.endswith("ss") and len(word) > 3:
        forms.append(word[:-1])
    return forms


def _match(weights: Mapping[int, float], trust: float, *, is_exact: bool) -> Match | None:
    if not weights:
        return None
    return Match(np.array(list(weights)), np.array(list(weights.values())), trust, is_exact)


def _match_bytes(match: Match | None) -> int:
    """Return the approximate size of a match in memory."""
    return 500 + (0 if match is None else match.objects.nbytes + match.weights.nbytes)
