"""The table of names of a gazetteer, built once per map and memory-mapped."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from safetensors import SafetensorError
from safetensors.numpy import save_file

from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.citymap.kinds.vocabulary import Vocabulary
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.errors import IndexBroken
from models.files import map_arrays
from models.language.mentions.names import full_words, latin_spellings, plain_words, street_forms
from models.strings import Postings, PostingsBuilder, merge_columns

FILE: Final = "names.safetensors"
NUMBER_SEPARATOR: Final = "\t"  # between a street and a house number
_POSTINGS: Final = ("names", "words", "spellings", "numbers", "codes", "streets", "street_words")


@dataclass(frozen=True, slots=True, eq=False)
class NameTable:
    """The names, streets and house numbers of one gazetteer, in plain words."""

    names: Postings  # from a name to its objects, without streets
    words: Postings  # from a word to the rows of the names with it
    spellings: Postings  # from another name of a chain to objects: Kentucky Fried Chicken is KFC
    numbers: Postings  # from a street in full, NUMBER_SEPARATOR and a house number to its objects
    codes: Postings  # from a code to its objects: "stop h2002"
    streets: Postings  # from a form of a street's name to rows of the next two
    street_words: Postings  # the words of these forms; its numbers are unused
    street: Ints  # [R] an object that the form means
    weight: Floats  # [R] probability that the form means it

    @classmethod
    def from_gazetteer(
        cls, gazetteer: Gazetteer, vocabulary: Vocabulary, is_common: Callable[[str], bool]
    ) -> "NameTable":
        """Build the table of a gazetteer; arguments as of Lookup."""
        names, numbers, codes = PostingsBuilder(), PostingsBuilder(), PostingsBuilder()
        others = list[tuple[str, int]]()
        forms = dict[tuple[str, int], float]()
        for number, words in enumerate(gazetteer.objects):
            for address in _addresses(words):
                numbers.add(address, number)
            for code in words.codes:
                codes.add(code, number)
            if words.kinds == (STREET_KIND,):
                for form, weight in (form for name in words.names for form in street_forms(name)):
                    key = " ".join(form), number
                    forms[key] = max(weight, forms.get(key, 0.0))
                continue
            spellings = (spelling for name in words.names for spelling in (name, *latin_spellings(name)))
            for plain in (" ".join(plain_words(spelling)) for spelling in spellings):
                if plain:
                    names.add(plain, number)
            if words.kinds:
                others += ((other, number) for name in words.names for other in vocabulary.spellings(name))
        of_names = names.build()
        nouns = {" ".join(plain_words(noun)) for noun in vocabulary.nouns("en")}

        def is_new(plain: tuple[str, ...]) -> bool:
            is_telling = any(len(word) > 2 and not is_common(word) for word in plain)
            name = " ".join(plain)
            return is_telling and name not in of_names and name not in nouns

        spelt = [(plain_words(other), number) for other, number in others]
        return cls(
            of_names,
            Postings.from_pairs(
                (word, row) for row, name in enumerate(of_names.all_keys) for word in set(name.split())
            ),
            Postings.from_pairs((" ".join(plain), number) for plain, number in spelt if is_new(plain)),
            numbers.build(),
            codes.build(),
            Postings.from_pairs((form, row) for row, (form, _) in enumerate(forms)),
            Postings.from_pairs((word, 0) for form, _ in forms for word in form.split()),
            np.array([number for _, number in forms], np.int64),
            np.array(list(forms.values()), np.float64),
        )

    def save(self, directory: Path) -> None:
        """Write the table to one file."""
        postings = [getattr(self, name).columns(name) for name in _POSTINGS]
        save_file(merge_columns([*postings, {"street": self.street, "weight": self.weight}]), directory / FILE)

    @classmethod
    def load(cls, directory: Path) -> "NameTable":
        """Load a saved table; raise IndexBroken if the file is missing or not such a table."""
        try:
            columns = map_arrays(directory / FILE)[0]
            postings = {name: Postings.from_columns(columns, name) for name in _POSTINGS}
            return cls(**postings, street=columns["street"], weight=columns["weight"])
        except (OSError, SafetensorError, ValueError, KeyError, TypeError, RuntimeError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error


def _addresses(words: GazetteerObject) -> Iterator[str]:
    """Yield the keys of an object's house numbers."""
    if words.number and words.street:
        street = " ".join(full_words(plain_words(words.street)))
        for number in words.numbers:
            yield street + NUMBER_SEPARATOR + number
