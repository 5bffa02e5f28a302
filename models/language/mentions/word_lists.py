"""The words that say where, of one language."""

import re
import tomllib
from functools import cache, cached_property
from pathlib import Path
from typing import Any


class Words:
    """Word lists and patterns of `english.toml`."""

    def __init__(self, path: Path) -> None:
        self._said: dict[str, dict[str, Any]] = tomllib.loads(path.read_text(encoding="utf-8"))

    def list(self, name: str) -> frozenset[str]:
        """A list of words."""
        return frozenset(self._said["words"][name].split())

    def table(self, name: str) -> dict[str, Any]:
        """Return a table as it is written."""
        return dict(self._said[name])

    @cached_property
    def metres(self) -> dict[str, float]:
        """Metres of a unit."""
        return dict(self._said["metres"])

    def text(self, table: str, name: str) -> str:
        """A pattern as it is written, line ends left out."""
        return str(self._said[table][name]).replace("\n", "")

    def pattern(self, table: str, name: str, form: str = "{}") -> re.Pattern[str]:
        """A pattern, in a form; case is ignored."""
        return re.compile(form.format(self.text(table, name)), re.IGNORECASE)


@cache
def english() -> Words:
    """The words of English."""
    return Words(Path(__file__).parent / "english.toml")
