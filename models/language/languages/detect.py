"""Detect the languages of a text by their everyday words, which names cannot sway."""

import re
from collections.abc import Mapping
from functools import cache
from typing import Final

from py3langid.langid import MODEL_FILE, LanguageIdentifier

from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.languages.table import load_table, table_codes
from models.language.mentions.names import ELIDED_ARTICLE, split_words
from models.language.mentions.word_lists import english

ENGLISH: Final = "en"
ENGLISH_ONLY_WORDS: Final = frozenset(("the", "an", "and", "of", "with", "for"))
MIN_WORDS: Final = 3  # that are no names; texts with fewer, and no everyday words, count as English
MIN_SCORE: Final = 0.9  # of a language with a table, in words that no other has
MIN_SECOND: Final = 1.5  # of a language that a text mixes in ...
MIN_SECOND_SHARE: Final = 0.2  # ... and its share of the text's everyday words
MIN_MARGIN_NATS: Final = 25.0  # by which a language without a table must be likelier than English
_OTHER_SCRIPT: Final = re.compile(r"[\u0370-\u1dff\u2e80-\ufdff]")  # a letter that is not Latin
LANGUAGE_NAMES: Final = {
    "da": "Danish", "no": "Norwegian", "uk": "Ukrainian", "ja": "Japanese", "zh": "Chinese", "ko": "Korean",
    "ar": "Arabic", "he": "Hebrew", "el": "Greek", "cs": "Czech", "hu": "Hungarian", "ro": "Romanian",
    "vi": "Vietnamese",
}  # fmt: skip


def detect_languages(text: str) -> tuple[str, ...]:
    """Return the language codes of a text, such as ("fi",), or ("en", "fi") if it mixes two; English by default."""
    words = split_words(text)
    plain = {word.plain for n, word in enumerate(words) if n == 0 or not word.is_capital or word.plain in _corners()}
    plain |= {article[0].lower() for word in words if (article := ELIDED_ARTICLE.match(text, word.start, word.end))}
    known = {word: languages for word in plain if (languages := _everyday().get(word))}
    score = dict.fromkeys((ENGLISH, *sorted(table_codes())), 0.0)
    for languages in known.values():
        for code in languages:
            score[code] += 1 / len(languages)
    best, second = sorted(score, key=lambda code: -score[code])[:2]
    if score[best] < MIN_SCORE and (len(plain) >= MIN_WORDS or _OTHER_SCRIPT.search(text)):
        return (_without_table(text),)
    if score[best] < MIN_SCORE:
        return (best if score[best] > score[ENGLISH] else ENGLISH,)
    own = [languages for languages in known.values() if second in languages and best not in languages]
    weight = sum(1 / len(languages) for languages in own)
    is_mixed = weight >= MIN_SECOND and weight >= MIN_SECOND_SHARE * len(known)
    return tuple(sorted((best, second))) if is_mixed and len(own) > 1 else (best,)


def _without_table(text: str) -> str:
    ranked = dict(_identifier().rank(text))
    best = max(ranked, key=lambda language: ranked[language])
    return str(best) if ranked[best] - ranked[ENGLISH] >= MIN_MARGIN_NATS else ENGLISH


@cache
def _corners() -> frozenset[str]:
    """Return the words for corners, which German writes with a capital letter: "Rosenstraße Ecke Münzstraße"."""
    return frozenset(word for code in table_codes() for word in load_table((code,)).corner_words)


@cache
def _everyday() -> Mapping[str, tuple[str, ...]]:
    """Return the languages of each everyday word."""
    words: dict[str, set[str]] = {word: {ENGLISH} for word in english().list("stop") | ENGLISH_ONLY_WORDS}
    for code in table_codes():
        for word in load_table((code,)).everyday | load_table((code,)).elided_articles:
            words.setdefault(word, set()).add(code)
    return {word: tuple(sorted(languages)) for word, languages in words.items()}


@cache
def _identifier() -> LanguageIdentifier:
    identifier = LanguageIdentifier.from_model_file(MODEL_FILE)
    known = {language.partition("-")[0] for language in load_vocabulary().languages}
    identifier.set_languages(sorted(known & set(identifier.labels)))
    return identifier
