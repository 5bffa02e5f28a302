"""The table tag -> class of instance (classes.toml)."""

import tomllib
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from models.city.tiled.solids import Shape


@dataclass(frozen=True, slots=True)
class OsmClass:
    """A row of `classes.toml`: which tags make an instance of which label, and its shape."""

    label: str
    shape: Shape
    tags: tuple[str, ...]
    height_m: float = 0.0
    width_m: float = 2.0
    walkable: bool = False
    required: tuple[tuple[str, frozenset[str] | None], ...] = field(init=False)
    forbidden: tuple[tuple[str, frozenset[str] | None], ...] = field(init=False)

    def __post_init__(self) -> None:
        """Split the tag lines once, because they are asked for every element of the map."""
        split = [(line.startswith("!"), line.lstrip("!").partition("=")) for line in self.tags]
        conditions = [(no, key, None if value == "*" else frozenset(value.split("|"))) for no, (key, _, value) in split]
        object.__setattr__(self, "required", tuple((key, values) for no, key, values in conditions if not no))
        object.__setattr__(self, "forbidden", tuple((key, values) for no, key, values in conditions if no))

    def matches(self, tags: dict[str, str]) -> bool:
        """Whether an element with these tags belongs to this class."""
        return all(
            key in tags and (values is None or tags[key] in values) for key, values in self.required
        ) and not any(key in tags and (values is None or tags[key] in values) for key, values in self.forbidden)


@cache
def load_classes() -> tuple[OsmClass, ...]:
    """The table tag -> class that ships with the package."""
    table = tomllib.loads((Path(__file__).parent / "classes.toml").read_text())
    return tuple(OsmClass(**{**row, "tags": tuple(row["tags"])}) for row in table["class"])
