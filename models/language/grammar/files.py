"""Load grammars from their files, each without the phrases of the others."""

import hashlib
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, Literal

from models.language.lexicon.lexicon import Names, load_lexicon

GRAMMARS = Path(__file__).parent
Grammar = Literal["train", "val", "test"]


@dataclass(frozen=True, slots=True, eq=False)
class Tables:
    """The tables of a grammar; `models.language.grammar.wording` describes them."""

    labels: Names  # further names of classes and colours
    colours: Names
    compass: Names
    phrases: Mapping[str, Sequence[str]]

    @property
    def sha256(self) -> str:
        """The sha256 of the phrases and compass words, independent of files and order."""
        lines = {
            f"{kind}: {phrase}"
            for kind, phrases in [*self.compass.items(), *self.phrases.items()]
            for phrase in phrases
        }
        return hashlib.sha256("\n".join(sorted(lines)).encode()).hexdigest()

    def without(self, known: "Tables") -> "Tables":
        """Return the tables without names and phrases of another grammar; compass words and distances stay."""
        return replace(
            self,
            labels=_new_names(self.labels, known.labels),
            colours=_new_names(self.colours, known.colours),
            phrases={
                kind: phrases if kind == "distance" else _new_phrases(phrases, known.phrases.get(kind, ()))
                for kind, phrases in self.phrases.items()
            },
        )


@cache
def load_grammar(grammar: Grammar) -> Tables:
    """Load a grammar from its files; the training grammar takes its names from the lexicon."""
    read: dict[str, Any] = {}
    for file in sorted((GRAMMARS / grammar).glob("*.toml")):
        read |= tomllib.loads(file.read_text())
    lexicon = load_lexicon()
    own = {name: read.pop(name, getattr(lexicon, name)) for name in ("labels", "colours")}
    tables = Tables(compass=read.pop("compass"), phrases=read, **own)
    for other in {"train": (), "val": ("train",), "test": ("train", "val")}[grammar]:
        tables = tables.without(load_grammar(other))
    return tables


def gist(phrase: str) -> str:
    """Return a phrase without capitals, punctuation and articles, to detect duplicates."""
    return " ".join(re.sub(r"[^a-z0-9{ ]", "", re.sub(r"\{(the|a|n)(?![a-z])", "{thing", phrase.lower())).split())


def _new_phrases(phrases: Sequence[str], known: Sequence[str]) -> list[str]:
    taken = {gist(phrase) for phrase in known}
    return [phrase for phrase in phrases if gist(phrase) not in taken]


def _new_names(names: Names, known: Names) -> Names:
    taken = {_plain(word) for key, words in known.items() for word in (key, *words)}
    return {key: [word for word in words if _plain(word) not in taken] for key, words in names.items()}


def _plain(word: str) -> str:
    return word.lower().replace("-", " ")
