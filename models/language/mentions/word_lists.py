"""Word lists and patterns of a language."""

import re
import tomllib
from functools import cache, cached_property
from pathlib import Path
from typing import Any


class WordLists:
    """Word lists and patterns of `english.toml`."""

    def __init__(self, path: Path) -> None:
        self._tables: dict[str, dict[str, Any]] = tomllib.loads(path.read_text(encoding="utf-8"))

    def list(self, name: str) -> frozenset[str]:
        """Return a list of words."""
        return frozenset(self._tables["words"][name].split())

    def table(self, name: str) -> dict[str, Any]:
        """Return a table of the file."""
        return dict(self._tables[name])

    @cached_property
    def metres(self) -> dict[str, float]:
        """Metres by unit."""
        return dict(self._tables["metres"])

    def text(self, table: str, name: str) -> str:
        """Return the text of a pattern without line breaks."""
        return str(self._tables[table][name]).replace("\n", "")

    def pattern(self, table: str, name: str, form: str = "{}") -> re.Pattern[str]:
        """Compile a pattern inside a form; case is ignored."""
        return re.compile(form.format(self.text(table, name)), re.IGNORECASE)


@cache
def english() -> WordLists:
    """Load the words of English."""
    return WordLists(Path(__file__).parent / "english.toml")
