"""Split descriptions into sentences, and into texts short enough for the reader."""

import re
from collections import Counter
from collections.abc import Sequence

from models.errors import DescriptionError
from models.language.languages.detect import detect_languages
from models.language.languages.table import load_table, table_codes
from models.language.mentions.names import plain_words
from models.language.mentions.word_lists import english

# A sentence ends at . ! ? ; or a line break; a dot inside a number or an abbreviation's letter does not end one.
_BREAK = re.compile(r"(?<=[.!?;。！？])(?<!\b\w\.)(?=\s|$)|[\r\n]+")  # noqa: RUF001  # Chinese and Japanese too
_BULLET = re.compile(r"^[ \t]*(?:[-*•–—·]+|\(?\d{1,2}[.)])[ \t]+", re.M)  # noqa: RUF001  # a dash too
_WORD = re.compile(r"\w+")
_CLOSING = re.compile(r"[.!?]")
MIN_REPEATED_WORDS = 3  # "bank bank" is not said twice
_HAS_WORD = re.compile(r"\w")
_SEMICOLON = re.compile(r";(?=\s|$)")
_SENTENCE_ENDS = (".", "!", "?", ";", ":")
# Transcripts: "Caller: ...", "00:12 A: ...", "[00:01:02] Anna: ...", a line "Speaker 1  0:12", SRT and WebVTT.
_CLOCK = r"[\[(]?(?:\d{1,2}:)?\d{1,2}:\d{2}(?:[.,]\d{1,3})?[\])]?"
_NAME = r"[^\W_][\w.'’-]*(?: [\w.'’-]+){0,2}"  # noqa: RUF001  # the apostrophe of phones too
_TIME_STAMP = re.compile(rf"^(?:\d+[ \t]*\r?\n)?[ \t]*{_CLOCK}(?:[ \t]*-->.*$|[ \t]+(?:[-–—][ \t]+)?)", re.M)  # noqa: RUF001
_SPEAKER = re.compile(rf"(?:^[ \t]*|(?<=[.!?] ))\**(?P<name>{_NAME})(?:[ \t]*{_CLOCK}:?|:)\**(?=\s|$)", re.M)
_ROLE = re.compile(
    r"(?:(?:emergency |9-?1-?1 |112 )?(?:caller|dispatcher|operator|agent|speaker|call[- ]?taker|customer|driver)"
    r"|soittaja|päivystäjä|hätäkeskus|asiakas|kuljettaja|inringare|larmoperatör|operatör|kund|förare"
    r"|anrufer(?:in)?|disponent(?:in)?|leitstelle|kund(?:e|in)|fahrer(?:in)?|appelante?|opérat(?:eur|rice)|client"
    r"|régulat(?:eur|rice)|chauffeur|llamante|operadora?|cliente|conductora?)(?: ?\d+)?",
    re.I,
)
_MIN_TURNS = 2  # of a person, or time stamps of a text; fewer may be a form ("Address: ...")


def without_speakers(description: str) -> str:
    """Return a transcript with blanks in place of time stamps and names of speakers; any other text as it is.

    A name before a colon is a speaker's if it is a role ("Caller"), or takes turns with another or after time stamps;
    everyday words are no names ("Left: a bank").
    """
    text, stamps = _TIME_STAMP.subn(_blank, description)
    if stamps < _MIN_TURNS and not _SPEAKER.search(text):
        return description  # "5:30 train"
    turns = Counter(match["name"] for match in _SPEAKER.finditer(text))
    has_stamps = stamps >= _MIN_TURNS
    people = {name for name, count in turns.items() if count >= _MIN_TURNS or (has_stamps and len(name) == 1)}
    if people:
        everyday = _everyday_words(text)
        people = {name for name in people if len(name) == 1 or everyday.isdisjoint(plain_words(name))}

    def blank_speaker(match: re.Match[str]) -> str:
        takes_turns = match["name"] in people and (len(people) > 1 or has_stamps)
        return _blank(match) if takes_turns or _ROLE.fullmatch(match["name"]) else match[0]

    return _SPEAKER.sub(blank_speaker, text)


def _everyday_words(text: str) -> frozenset[str]:
    """Return the everyday words of a text's languages that are not said of people."""
    tables = (load_table((code,)).everyday for code in detect_languages(text) if code in table_codes())
    return english().list("stop").union(*tables) - {"me", "you"}


def _blank(match: re.Match[str]) -> str:
    return re.sub(r"[^\r\n]", " ", match[0])


def split_hints(description: str) -> tuple[str, ...]:
    """Return the sentences of a description (ending at . ! ? ; or a line break), or the lines of a list, one hint each.

    Raises:
        DescriptionError: it has no letter or digit besides list numbers.
    """
    sentences = (part.strip(" \t;,") for part in _BREAK.split(_BULLET.sub("", without_speakers(description))))
    hints = tuple(sentence for sentence in sentences if _HAS_WORD.search(sentence))
    if not hints:
        raise DescriptionError(
            "the description has no words; say what is around you, for example 'I am north of a gray building.'"
        )
    return hints


def without_repetition(description: str) -> str:
    """Return a description that is one passage said several times as that passage; any other as it is."""
    words = [(match[0].lower(), match.end()) for match in _WORD.finditer(description)]
    plain = [word for word, _ in words]
    count = len(words)
    for length in range(MIN_REPEATED_WORDS, count // 2 + 1):
        if count % length == 0 and plain == plain[:length] * (count // length):
            mark = _CLOSING.match(description, words[length - 1][1])
            return description[: mark.end() if mark else words[length - 1][1]]
    return description


def without_capitals(description: str) -> str:
    """Return a description that is all in capital letters in lower case; any other as it is."""
    lower = description.lower()
    return lower if description.isupper() and len(lower) == len(description) else description


def locate_spans(description: str, text: str, spans: Sequence[tuple[int, int]]) -> list[tuple[int, int] | None]:
    """Locate spans of the reader's text in the original description; None for a span that is not there.

    `text` is `split_for_reader` of the description, joined by blanks; it differs in punctuation and blanks only.
    """
    located: list[tuple[int, int] | None] = [None] * len(spans)
    drift, last, last_begin = 0, -1, -1
    for n in sorted(range(len(spans)), key=lambda n: spans[n]):
        start, end = spans[n]
        places = [match.start() for match in re.finditer(re.escape(text[start:end]), description)]
        places = [place for place in places if place > last_begin or start == last]
        if places and start < end:
            begin = min(places, key=lambda place: abs(place - start - drift))
            located[n], drift, last, last_begin = (begin, begin + end - start), begin - start, start, begin
    return located


def split_for_reader(description: str, longest: int) -> list[str]:
    """Return a description as texts for the reader: lines become sentences, long texts are cut between them."""
    lines = (line.strip(" \t;,") for line in _BULLET.sub("", without_speakers(description)).splitlines())
    ended = (line if line.endswith(_SENTENCE_ENDS) else line + "." for line in lines if _HAS_WORD.search(line))
    whole = _SEMICOLON.sub(".", " ".join(ended))
    if len(whole) <= longest:
        return [whole] if whole else []
    texts = [""]
    for sentence in filter(None, map(str.strip, _BREAK.split(whole))):
        if texts[-1] and len(texts[-1]) + len(sentence) > longest:
            texts.append("")
        texts[-1] = f"{texts[-1]} {sentence}".strip()
    return texts
