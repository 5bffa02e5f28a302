"""The table from tags to classes of instances (classes.toml)."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from models.citymap.geometry.solids import Shape


@dataclass(frozen=True, slots=True)
class OsmClass:
    """A row of `classes.toml`: the tags of a class, its label and its shape."""

    label: str
    shape: Shape
    tags: tuple[str, ...]
    height_m: float = 0.0
    width_m: float = 2.0
    walkable: bool = False
    required: tuple[tuple[str, frozenset[str] | None], ...] = field(init=False)
    forbidden: tuple[tuple[str, frozenset[str] | None], ...] = field(init=False)

    def __post_init__(self) -> None:
        """Parse the tag lines once, because they are checked for every element of the map."""
        split = [(line.startswith("!"), line.lstrip("!").partition("=")) for line in self.tags]
        conditions = [(no, key, None if value == "*" else frozenset(value.split("|"))) for no, (key, _, value) in split]
        object.__setattr__(self, "required", tuple((key, values) for no, key, values in conditions if not no))
        object.__setattr__(self, "forbidden", tuple((key, values) for no, key, values in conditions if no))

    def matches(self, tags: Mapping[str, str]) -> bool:
        """Whether an element with these tags belongs to this class."""
        return all(
            key in tags and (values is None or tags[key] in values) for key, values in self.required
        ) and not any(key in tags and (values is None or tags[key] in values) for key, values in self.forbidden)


@cache
def load_classes() -> tuple[OsmClass, ...]:
    """Load the table that ships with the package."""
    table = tomllib.loads((Path(__file__).parent / "classes.toml").read_text())
    return tuple(OsmClass(**{**row, "tags": tuple(row["tags"])}) for row in table["class"])


def find_class(tags: Mapping[str, str]) -> tuple[int, OsmClass] | None:
    """Return the first row of the table that the tags match, with its number; None if there is none."""
    rows, numbers = load_classes(), _rows_by_key()
    candidates = sorted({number for key in tags for number in numbers.get(key, ())})
    return next(((number, rows[number]) for number in candidates if rows[number].matches(tags)), None)


@cache
def _rows_by_key() -> dict[str, list[int]]:
    """Return the rows by their first required key: most elements have none of most keys."""
    numbers: dict[str, list[int]] = {}
    for number, row in enumerate(load_classes()):
        numbers.setdefault(row.required[0][0], []).append(number)
    return numbers
