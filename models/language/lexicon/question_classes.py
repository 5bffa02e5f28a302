"""What people can be asked about."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True, slots=True)
class AskedAbout:
    """What people know at sight.

    Attributes:
        things: classes of maps, and what each is called in a question.
        kinds: beginnings of the kinds of places that are known by their names.
    """

    things: Mapping[str, str]
    kinds: tuple[str, ...]


@cache
def load_asked() -> AskedAbout:
    """Read asked.toml."""
    with Path(__file__).with_name("asked.toml").open("rb") as file:
        found = tomllib.load(file)
    return AskedAbout(found["things"], tuple(found["names"]["kinds"]))
