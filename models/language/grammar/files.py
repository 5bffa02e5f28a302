"""Grammars from their files, each without what another one must not share with it."""

import re
import tomllib
from functools import cache
from pathlib import Path
from typing import Any, Literal

GRAMMARS = Path(__file__).parent
Grammar = Literal["train", "val", "test"]
_KEPT = ("labels", "colours", "compass", "distance")  # tables that are not phrases of their own


@cache
def load_grammar(grammar: Grammar) -> dict[str, Any]:
    """The tables of a grammar, of all its files together; see models.language.grammar.wording."""
    tables = tomllib.loads((GRAMMARS / f"{grammar}.toml").read_text())
    for more in sorted(GRAMMARS.glob(f"{grammar}_*.toml")):
        for name, table in tomllib.loads(more.read_text()).items():
            kept = tables.setdefault(name, {})
            for key, words in table.items():
                kept[key] = list(dict.fromkeys([*kept.get(key, []), *words]))
    for name in tables.keys() - {"labels", "colours", "compass"}:
        phrases = tables[name]["phrases"]
        tables[name]["phrases"] = list({_gist(phrase): phrase for phrase in reversed(phrases)}.values())[::-1]
    for other in {"train": (), "val": ("train",), "test": ("train", "val")}[grammar]:
        _leave_out(tables, load_grammar(other))
    return tables


def _leave_out(tables: dict[str, Any], known: dict[str, Any]) -> None:
    """Take from a grammar what another one has."""
    for name, table in tables.items():
        if name in ("labels", "colours"):
            taken = {_plain(word) for key, words in known[name].items() for word in (key, *words)}
            tables[name] = {key: [w for w in words if _plain(w) not in taken] for key, words in table.items()}
        elif name not in _KEPT:
            taken = {_gist(phrase) for phrase in known.get(name, {"phrases": ()})["phrases"]}
            tables[name]["phrases"] = [phrase for phrase in table["phrases"] if _gist(phrase) not in taken]


def _gist(phrase: str) -> str:
    """A phrase but for capitals, punctuation and articles: two that agree in it are one."""
    return " ".join(re.sub(r"[^a-z0-9{ ]", "", re.sub(r"\{(the|a|n)(?![a-z])", "{thing", phrase.lower())).split())


def _plain(word: str) -> str:
    return word.lower().replace("-", " ")
