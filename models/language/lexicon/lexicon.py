"""What things go by."""

import hashlib
import json
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

Names = Mapping[str, Sequence[str]]


@dataclass(frozen=True, eq=False)
class Lexicon:
    """The names of classes and colours.

    Attributes:
        labels: names of each class besides its label: those of maps, then those of no map, whose names compete.
        elsewhere: the classes of no map.
        unnamed: classes of maps that go by their label alone, and only where a map has them.
        colours: words for each colour besides its own.
        related: groups of classes that go by one another's names, closest first.
        sizes: words such as "small".
    """

    labels: Names
    elsewhere: frozenset[str]
    unnamed: frozenset[str]
    colours: Names
    related: Sequence[Sequence[str]]
    sizes: Sequence[str]

    @cached_property
    def sha256(self) -> str:
        """Of all that it holds."""
        return hashlib.sha256(json.dumps(asdict(self), default=sorted).encode()).hexdigest()

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Every name of every class, once."""
        return tuple(dict.fromkeys(name for label, others in self.labels.items() for name in (label, *others)))

    def meaning_in(self, map_labels: Sequence[str], label: str) -> str | None:
        """The label of a map that a class goes by there: its own, or the closest relative's; None without either."""
        if label in map_labels:
            return label
        groups = sorted((g for g in self.related if label in g), key=lambda group: group.index(label))
        return next((other for group in groups for other in group if other in map_labels), None)

    def names_in(self, map_labels: Sequence[str]) -> tuple[list[str], list[int]]:
        """Every name, and the number of the map's label that it leads to; the number of labels if to none.

        What names a label of the map does not stand for its relatives too: trees are no bushes where there are trees.
        """
        own = {name for label in map_labels for name in (label, *self.labels.get(label, ()))}
        phrases, numbers = [], []
        for label in dict.fromkeys([*map_labels, *self.labels]):
            meant = self.meaning_in(map_labels, label)
            number = len(map_labels) if meant is None else map_labels.index(meant)
            for phrase in (label, *self.labels.get(label, ())):
                if label in map_labels or not own & {phrase, phrase.removesuffix("s")}:
                    phrases.append(phrase)
                    numbers.append(number)
        return phrases, numbers


@cache
def load_lexicon() -> Lexicon:
    """The lexicon that ships with the package."""
    labels, related = _read("labels"), _read("related")
    return Lexicon(
        labels=labels["classes"] | labels["elsewhere"],
        elsewhere=frozenset(labels["elsewhere"]),
        unnamed=frozenset(labels["unnamed"]),
        colours=_read("colours"),
        related=related["groups"],
        sizes=_read("sizes")["sizes"],
    )


def _read(name: str) -> dict[str, Any]:
    return tomllib.loads((Path(__file__).parent / f"{name}.toml").read_text())
