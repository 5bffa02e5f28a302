"""Grammars from their files, each without what another one must not share with it."""

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
    """What a grammar holds, see models.language.grammar.wording.

    Attributes:
        labels, colours: names of classes and colours besides their own.
        compass: words for each wind.
        phrases: by kind.
    """

    labels: Names
    colours: Names
    compass: Names
    phrases: Mapping[str, Sequence[str]]

    @property
    def sha256(self) -> str:
        """Of the phrases and words for winds, whatever their files and order."""
        said = {f"{kind}: {phrase}" for kind, some in [*self.compass.items(), *self.phrases.items()] for phrase in some}
        return hashlib.sha256("\n".join(sorted(said)).encode()).hexdigest()

    def without(self, known: "Tables") -> "Tables":
        """What another grammar does not have, but for winds and distances."""
        return replace(
            self,
            labels=_new_names(self.labels, known.labels),
            colours=_new_names(self.colours, known.colours),
            phrases={
                kind: some if kind == "distance" else _new_phrases(some, known.phrases.get(kind, ()))
                for kind, some in self.phrases.items()
            },
        )


@cache
def load_grammar(grammar: Grammar) -> Tables:
    """A grammar of all its files; training calls things what the lexicon does."""
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
    """A phrase but for capitals, punctuation and articles: two that agree in it are one."""
    return " ".join(re.sub(r"[^a-z0-9{ ]", "", re.sub(r"\{(the|a|n)(?![a-z])", "{thing", phrase.lower())).split())


def _new_phrases(phrases: Sequence[str], known: Sequence[str]) -> list[str]:
    taken = {gist(phrase) for phrase in known}
    return [phrase for phrase in phrases if gist(phrase) not in taken]


def _new_names(names: Names, known: Names) -> Names:
    taken = {_plain(word) for key, words in known.items() for word in (key, *words)}
    return {key: [word for word in words if _plain(word) not in taken] for key, words in names.items()}


def _plain(word: str) -> str:
    return word.lower().replace("-", " ")
