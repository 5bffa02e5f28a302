"""Match the words of a person with the choices of a question."""

from typing import Final

from index.answering.answers import Question
from models.language.mentions.names import plain_words

UNKNOWN: Final = "unknown"  # a choice of every question
# In plain form: lower case, without accents and apostrophes.
_NOT_KNOWN: Final = (
    "dont know", "do not know", "not know", "dunno", "no idea", "no clue", "not sure", "unsure", "not certain",
    "uncertain", "cant tell", "cannot tell", "cant say", "hard to say", "unknown", "skip", "en tieda", "ei tietoa",
    "en ole varma", "vet inte", "vet ej", "ingen aning", "weiss nicht", "weiss es nicht", "keine ahnung",
    "ne sais pas", "sais pas", "aucune idee", "no lo se", "no se", "ni idea",
)  # fmt: skip
_YES: Final = (
    "yes", "yeah", "yep", "yup", "yea", "aye", "sure", "correct", "indeed", "definitely", "affirmative", "ok", "okay",
    "there is", "i do", "i see one", "i can see one", "kylla", "joo", "juu", "ja", "jo", "jawohl", "oui", "si",
)  # fmt: skip
_NO: Final = (
    "no", "nope", "nah", "not", "none", "neither", "negative", "isnt", "arent", "dont", "cant", "cannot", "doesnt",
    "nothing", "ei", "en nae", "nej", "ingen", "inget", "nein", "kein", "keine", "keinen", "nicht", "non", "pas",
    "aucun", "ningun", "ninguno", "ninguna",
)  # fmt: skip
_ANOTHER: Final = ("another", "other", "different", "else", *_NO)
_NO_NAME: Final = frozenset((*_NO, "of", "them", "these", "those", "any", "there", "one"))
_COUNTERS: Final = ("one", "choice", "option", "answer", "number")  # as in "the second one", "option 2"
_ORDINALS: Final = {"1st": 1, "2nd": 2, "3rd": 3, "4th": 4, "5th": 5, "last": -1}  # "last": of those with a name
_NUMBERS: Final = {"one": 1, "two": 2, "three": 3, "four": 4, "five": 5}
# Words before or after a name that are not part of it: "I think I'm on Bulevardi". Articles such as "la" begin names.
_FILLERS: Final = (
    "i", "im", "am", "we", "are", "were", "is", "its", "it", "this", "that", "the", "on", "at", "in", "by", "near",
    "next", "to", "beside", "see", "can", "ive", "think", "guess", "believe", "maybe", "perhaps", "probably", "called",
    "named", "yes", "or", "so", "please", "olen", "luulen", "etta", "ehka", "jag", "ar", "pa", "vid", "ich", "bin",
    "auf", "je", "suis", "dans", "estoy", "en",
)  # fmt: skip


def choose(question: Question, reply: str) -> str | None:
    """Return the value of the choice that a reply means, or the name in it; None if it is unclear."""
    words = _plain(reply)
    listed = {choice.value: (_plain(choice.value), _plain(choice.text)) for choice in question.choices}
    exact = next((value for value, names in listed.items() if words in names), None)
    if exact is not None:
        return exact
    if _has(words, _NOT_KNOWN) or not words:
        return UNKNOWN
    values = [value for value in listed if value != UNKNOWN]
    number = _number(words, question.is_open)
    if number is not None and number <= len(values):
        return values[number - 1 if number > 0 else number]
    return _name(_without_fillers(words), listed) if question.is_open else _closed(words, listed)


def _name(name: str, listed: dict[str, tuple[str, str]]) -> str | None:
    """Return the choice or the other name that answers an open question; "none of them" is no name."""
    if _NO_NAME.issuperset(name.split()) and _has(name, _NO):
        return UNKNOWN
    if not name or _has(name, ("yes", "no", "nope", "none", "neither")):
        return None
    return next((value for value, names in listed.items() if name in names), name)


def _closed(words: str, listed: dict[str, tuple[str, str]]) -> str | None:
    """Return the choice of a question without other names: yes or no, a direction or a colour."""
    if "yes" in listed:
        is_yes, is_no = _has(words, _YES), _has(words, _NO)
        return None if is_yes == is_no else "yes" if is_yes else "no"
    named = [value for value, names in listed.items() if value not in ("none", "other") and _has(words, names)]
    if named:
        return named[0] if len(named) == 1 and not _has(words, _NO) else None
    rest = {"none": _NO, "other": _ANOTHER}
    return next((value for value, phrases in rest.items() if value in listed and _has(words, phrases)), None)


def _number(words: str, is_open: bool) -> int | None:
    """Return the number of a choice in "the second one" or "option 2"; None if the words are something else.

    To an open question "2" or "second" may be a name.
    """
    parts = [word for word in words.split() if word != "the"]
    counters = [word for word in parts if word in _COUNTERS]
    left = [word for word in parts if word not in _COUNTERS] or counters[-1:]
    if len(left) != 1 or (is_open and not (counters and len(parts) > 1)):
        return None
    word = left[0]
    return int(word) or None if word.isdecimal() else _ORDINALS.get(word, _NUMBERS.get(word))


def _without_fillers(words: str) -> str:
    parts = words.split()
    while parts and parts[0] in _FILLERS:
        parts.pop(0)
    while parts and parts[-1] in _FILLERS:
        parts.pop()
    return " ".join(parts)


def _plain(text: str) -> str:
    return " ".join(plain_words(text))


def _has(words: str, phrases: tuple[str, ...]) -> bool:
    return any(f" {phrase} " in f" {words} " for phrase in phrases)
