"""The names of classes and colours."""

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
    """The names of classes and colours."""

    # further names of each class: first classes of maps, then classes that no map has, whose names compete
    labels: Names
    elsewhere: frozenset[str]  # the classes that no map has
    unnamed: frozenset[str]  # classes of maps that have no other names
    colours: Names  # further words for each colour
    related: Sequence[Sequence[str]]  # groups of classes that share names, closest first
    sizes: Sequence[str]  # words such as "small"

    @cached_property
    def sha256(self) -> str:
        """The sha256 of its content."""
        return hashlib.sha256(json.dumps(asdict(self), default=sorted).encode()).hexdigest()

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Every name of every class, once."""
        return tuple(dict.fromkeys(name for label, others in self.labels.items() for name in (label, *others)))

    def find_map_label(self, map_labels: Sequence[str], label: str) -> str | None:
        """Return the map's label for a class: its own, or that of the closest relative; None without either."""
        if label in map_labels:
            return label
        groups = sorted((g for g in self.related if label in g), key=lambda group: group.index(label))
        return next((other for group in groups for other in group if other in map_labels), None)

    def map_names_to_labels(self, map_labels: Sequence[str]) -> tuple[list[str], list[int]]:
        """Return every name and the index of the map's label that it means; the number of labels if it means none.

        A name of a label of the map does not stand for relatives too: trees are not bushes in a map with trees.
        """
        own = {name for label in map_labels for name in (label, *self.labels.get(label, ()))}
        phrases, numbers = [], []
        for label in dict.fromkeys([*map_labels, *self.labels]):
            meant = self.find_map_label(map_labels, label)
            number = len(map_labels) if meant is None else map_labels.index(meant)
            for phrase in (label, *self.labels.get(label, ())):
                if label in map_labels or not own & {phrase, phrase.removesuffix("s")}:
                    phrases.append(phrase)
                    numbers.append(number)
        return phrases, numbers


@cache
def load_lexicon() -> Lexicon:
    """Load the lexicon that ships with the package."""
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
