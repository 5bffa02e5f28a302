"""Replies in the user's language: English templates, and a catalogue of their translations for each other language."""

import tomllib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Final

DIRECTORY: Final = Path(__file__).with_name("replies")
_ENGLISH: Final = "en"
REPLY_LANGUAGES: Final = (_ENGLISH, "fi", "sv", "de", "fr", "es")
_language: ContextVar[str] = ContextVar("reply_language", default=_ENGLISH)


@dataclass(frozen=True, slots=True)
class Catalogue:
    """The translations into one language."""

    messages: Mapping[str, str] = field(default_factory=dict)  # by the English template
    # A noun with its article and as the nearest one, by the English noun: "ein Baum" and "der nächste Baum" of "tree".
    nouns: Mapping[str, tuple[str, str]] = field(default_factory=dict)


def choose_language(preferred: str | None, languages: Iterable[str]) -> str:
    """Return the language of a reply: the preferred one, else the first that replies have, else English."""
    return next((code for code in (preferred, *languages) if code in REPLY_LANGUAGES), _ENGLISH)


@contextmanager
def replies_in(language: str) -> Iterator[None]:
    """Translate into a language inside this context; outside of any, replies are in English."""
    token = _language.set(language)
    try:
        yield
    finally:
        _language.reset(token)


def reply_language() -> str:
    """Return the language that `translate` uses."""
    return _language.get()


def translate(template: str, **values: object) -> str:
    """Return an English template in the language of the reply, with its values filled in."""
    return load_catalogue(reply_language()).messages.get(template, template).format(**values)


def translatable(template: str) -> str:
    """Mark a template that `translate` gets later, so that a test sees that it is translated."""
    return template


def noun_with_article(noun: str) -> str:
    """Return an English noun in the language of the reply, with its indefinite article: "a tree"."""
    nouns = load_catalogue(reply_language()).nouns
    return nouns[noun][0] if noun in nouns else f"{'an' if noun[0] in 'aeio' else 'a'} {noun}"


def nearest_noun(noun: str) -> str:
    """Return an English noun in the language of the reply, as the nearest one: "the nearest tree"."""
    nouns = load_catalogue(reply_language()).nouns
    return nouns[noun][1] if noun in nouns else f"the nearest {noun}"


@cache
def load_catalogue(language: str) -> Catalogue:
    """Load the translations into a language; English needs none."""
    if language == _ENGLISH:
        return Catalogue()
    content = tomllib.loads((DIRECTORY / f"{language}.toml").read_text(encoding="utf-8"))
    return Catalogue(content["messages"], {noun: tuple(forms) for noun, forms in content["nouns"].items()})
