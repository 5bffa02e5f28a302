"""Detect the language of a text."""

from functools import cache
from typing import Final

from py3langid.langid import MODEL_FILE, LanguageIdentifier

from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.mentions.names import split_words
from models.language.mentions.word_lists import english

ENGLISH: Final = "en"
MIN_ENGLISH_SHARE: Final = 0.2  # share of common English words that makes a text English
ENGLISH_ONLY_WORDS: Final = frozenset(("the", "an", "and", "of", "with", "for"))
MIN_WORDS: Final = 3  # distinct words; shorter texts count as English
MIN_MARGIN_NATS: Final = 25.0  # by which another language must be likelier than English
LANGUAGE_NAMES: Final = {
    "de": "German", "fr": "French", "es": "Spanish", "it": "Italian", "pt": "Portuguese", "nl": "Dutch",
    "sv": "Swedish", "fi": "Finnish", "da": "Danish", "no": "Norwegian", "pl": "Polish", "ru": "Russian",
    "uk": "Ukrainian", "tr": "Turkish", "ja": "Japanese", "zh": "Chinese", "ko": "Korean", "ar": "Arabic",
    "he": "Hebrew", "el": "Greek", "cs": "Czech",
}  # fmt: skip


def detect_language(text: str) -> str:
    """Return the language code of a text, such as "fi"; English unless another is much likelier."""
    words = split_words(text)
    everyday = english().list("stop") | ENGLISH_ONLY_WORDS
    # names may be English in any text
    plain = [word.plain for n, word in enumerate(words) if n == 0 or not word.is_capital]
    english_words = sum(word in everyday for word in plain)
    is_english = english_words > 1 and english_words >= MIN_ENGLISH_SHARE * len(plain)
    if len({word.plain for word in words}) < MIN_WORDS or is_english:
        return ENGLISH
    ranked = dict(_identifier().rank(text))
    best = max(ranked, key=lambda language: ranked[language])
    return str(best) if ranked[best] - ranked[ENGLISH] >= MIN_MARGIN_NATS else ENGLISH


@cache
def _identifier() -> LanguageIdentifier:
    identifier = LanguageIdentifier.from_model_file(MODEL_FILE)
    known = {language.partition("-")[0] for language in load_vocabulary().languages}
    identifier.set_languages(sorted(known & set(identifier.labels)))
    return identifier
