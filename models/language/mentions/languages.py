"""Which language a text is in, where that is sure enough to matter."""

from functools import cache
from typing import Final

from py3langid.langid import MODEL_FILE, LanguageIdentifier

from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.mentions.names import words_of
from models.language.mentions.word_lists import english

ENGLISH: Final = "en"
LEAST_ENGLISH: Final = 0.2  # share of everyday English words from which on nothing else is asked
ENGLISH_ALONE: Final = frozenset(("the", "an", "and", "of", "with", "for"))
FEWEST: Final = 3  # different words; fewer tell nothing
MARGIN: Final = 25.0  # nats by which another language must be likelier than English
NAMES: Final = {
    "de": "German", "fr": "French", "es": "Spanish", "it": "Italian", "pt": "Portuguese", "nl": "Dutch",
    "sv": "Swedish", "fi": "Finnish", "da": "Danish", "no": "Norwegian", "pl": "Polish", "ru": "Russian",
    "uk": "Ukrainian", "tr": "Turkish", "ja": "Japanese", "zh": "Chinese", "ko": "Korean", "ar": "Arabic",
    "he": "Hebrew", "el": "Greek", "cs": "Czech",
}  # fmt: skip


def language_of(text: str) -> str:
    """The language of a text, "fi" say; English unless another one is much likelier."""
    words = words_of(text)
    everyday = english().list("stop") | ENGLISH_ALONE
    # names may be English in any text
    said = [word.plain for n, word in enumerate(words) if n == 0 or not word.is_capital]
    english_words = sum(word in everyday for word in said)
    is_english = english_words > 1 and english_words >= LEAST_ENGLISH * len(said)
    if len({word.plain for word in words}) < FEWEST or is_english:
        return ENGLISH
    ranked = dict(_identifier().rank(text))
    best = max(ranked, key=lambda language: ranked[language])
    return str(best) if ranked[best] - ranked[ENGLISH] >= MARGIN else ENGLISH


@cache
def _identifier() -> LanguageIdentifier:
    identifier = LanguageIdentifier.from_model_file(MODEL_FILE)
    known = {language.partition("-")[0] for language in load_vocabulary().languages}
    identifier.set_languages(sorted(known & set(identifier.labels)))
    return identifier
