"""Find the kinds of an object by its tags."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

ANY_VALUE = "*"
NEGATIVE_VALUES = ("", "no", "none")  # values of a tag whose feature is absent
Tags = Mapping[str, str]
Conditions = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of objects in a city."""

    id: str  # of the preset, "amenity/fast_food/pizza"
    name: str  # English, lower case: "pizza fast food"
    tags: Tags  # all must match ("*" is any value)


def specificity_key(kind: Kind) -> tuple[bool, bool, int, str]:
    """Return a sort key: buildings after other kinds, special before general, kinds of any value last."""
    exact = sum(value != ANY_VALUE for value in kind.tags.values())
    return (exact == 0, kind.id.startswith("building"), -exact, kind.id)


class Matcher:
    """Finds the kinds of objects, using an index over one tag of each kind.

    `same` has tags "key=value" that mean the same as the kind of an id.
    """

    def __init__(self, kinds: Iterable[Kind], same: Tags) -> None:
        kinds = tuple(kinds)
        self._ids = [kind.id for kind in kinds]
        place = {key: number for number, key in enumerate(self._ids)}
        self._above = [[place[parent] for parent in parents(key) if parent in place] for key in self._ids]
        self._index: dict[str, tuple[dict[str, list[tuple[int, Conditions]]], list[tuple[int, Conditions]]]] = {}
        for number, kind in enumerate(kinds):
            pairs = sorted(kind.tags.items(), key=lambda pair: (pair[1] == ANY_VALUE, pair[0] == "amenity", pair))
            (key, value), *rest = pairs
            exact, anything = self._index.setdefault(key, ({}, []))
            rows = anything if value == ANY_VALUE else exact.setdefault(value, [])
            rows.append((number, tuple(rest)))
        for tag, one in same.items():
            key, _, value = tag.partition("=")
            if one in place:
                self._index.setdefault(key, ({}, []))[0].setdefault(value, []).append((place[one], ()))

    def kinds_of(self, tags: Tags) -> tuple[str, ...]:
        """Return the ids of all kinds of an object, with their parents, most specific first."""
        numbers: set[int] = set()
        for key, value in tags.items():
            rows = self._index.get(key)
            if rows is None or value in NEGATIVE_VALUES:
                continue
            exact, anything = rows
            candidates = exact.get(value, ())
            if ";" in value:
                candidates = [row for one in value.split(";") for row in exact.get(one.strip(), ())]
            for number, rest in (*candidates, *anything):
                if not rest or has_tags(rest, tags):
                    numbers.add(number)
                    numbers.update(self._above[number])
        return tuple([self._ids[number] for number in sorted(numbers)])


def has_tags(rest: Conditions, tags: Tags) -> bool:
    """Whether an object has all tags; a list of values counts as each of them."""
    for key, wanted in rest:
        value = tags.get(key, "")
        if value == wanted or (wanted == ANY_VALUE and value not in NEGATIVE_VALUES):
            continue
        if ";" not in value or wanted not in [one.strip() for one in value.split(";")]:
            return False
    return True


def parents(key: str) -> list[str]:
    """Return the ids above an id: "shop/beauty" and "shop" for "shop/beauty/nails"."""
    parts = key.split("/")
    return ["/".join(parts[:length]) for length in range(len(parts) - 1, 0, -1)]
