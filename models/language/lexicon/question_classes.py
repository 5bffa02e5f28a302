"""The classes and kinds of places that questions are about."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True, slots=True)
class QuestionClasses:
    """The classes and kinds of places that people recognize."""

    things: Mapping[str, str]  # the noun in a question for each class of maps
    kinds: tuple[str, ...]  # prefixes of the kinds of places that people know by name


@cache
def load_question_classes() -> QuestionClasses:
    """Read asked.toml."""
    with Path(__file__).with_name("asked.toml").open("rb") as file:
        table = tomllib.load(file)
    return QuestionClasses(table["things"], tuple(table["names"]["kinds"]))
