"""Find the addresses of a text: house numbers beside a street, or elsewhere in the text."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from models.language.languages.translation import translate
from models.language.measures import CharacterSpan, find_measures, overlaps
from models.language.mentions.abbreviations import is_abbreviated
from models.language.mentions.house_numbers import WrittenNumber, number_beside, numbers_apart
from models.language.mentions.lookup import AddressMatch, Lookup
from models.language.mentions.mentions import Mention
from models.language.mentions.names import STREET_ABBREVIATIONS, Word, full_words, plain_words, split_words

OTHER_STREET_WEIGHT: Final = 0.5  # of a number of a street that is not the nearest in the text
MAX_PLACE_WORDS: Final = 5  # of a place with house numbers that is no street
_CODE = r"(?:[A-Z]{1,3}-)?(?:\d{2,4}[ -]\d{2,4}|\d{4,6}|[A-Z]{1,2}\d[A-Z\d]? \d[A-Z]{2})(?!\w)"
_NAME = r"[^\W\d_a-z][\w'’.-]*(?: (?:(?:am|an|der|de|do|da|la|le|of|upon)[ -])?[^\W\d_a-z][\w'’.-]*){0,3}"  # noqa: RUF001
# ", 00120 Helsinki, Finland"
_TAIL = re.compile(
    rf"(?:\s*,\s*(?:{_CODE}\s*)?(?:{_NAME}(?:\s+{_CODE})?)?|\s+{_CODE}(?:\s+{_NAME})?)(?=\s*(?:[,.;!?)\n]|$))"
)
_CITY = re.compile(rf",\s*{_NAME}\s*,\s*(?P<country>{_NAME}?)(?P<end>[\s.!]*)$")
_HAS_CODE = re.compile(_CODE)


def add_addresses(mentions: Sequence[Mention], text: str, lookup: Lookup) -> list[Mention]:
    """Turn streets with a house number into addresses; add those whose number is elsewhere, and those of places.

    What follows an address, such as the city, is no mention.
    """
    if not any(c.isdecimal() for c in text):
        return [_with_full_stop(mention, text) for mention in mentions]
    result, measures = list[Mention](), find_measures(text)
    for mention in (_with_full_stop(mention, text) for mention in mentions):
        number = number_beside(text, mention.start, mention.end) if mention.form == "street" else None
        if number is None or overlaps(number, measures):
            result.append(mention)
        else:
            result += _address(text, mention, number, lookup)
    result += _addresses_apart(text, mentions, [*result, *measures], lookup)
    result += _addresses_of_places(text, result, lookup)
    addresses = [mention for mention in result if mention.form == "address"]
    others = [mention for mention in result if mention in addresses or not overlaps(mention, addresses)]
    return sorted(_without_tails(others, text), key=lambda mention: mention.start)


def _with_full_stop(mention: Mention, text: str) -> Mention:
    """Return a mention with the full stop of its abbreviation: "Unionink."."""
    words = plain_words(mention.text)
    if mention.form != "street" or not words or text[mention.end : mention.end + 1] != ".":
        return mention
    if words[-1] in STREET_ABBREVIATIONS or not is_abbreviated(words[-1]):
        return mention
    return replace(mention, text=f"{mention.text}.", end=mention.end + 1)


def _address(text: str, street: Mention, number: WrittenNumber, lookup: Lookup) -> list[Mention]:
    """Return a street's address; without such a number the street, and the address as unknown."""
    start, end = min(street.start, number.start), max(street.end, number.end)
    match = lookup.address(number.number, street.objects)
    if match is not None:
        return [_mention(text, start, end, match)]
    words = text[start:end]
    note = translate(
        "'{address}' is not on the map, and no neighbouring numbers are; only the street was used", address=words
    )
    return [street, Mention(words, start, end, "unknown", note=note)]


def _mention(text: str, start: int, end: int, address: AddressMatch) -> Mention:
    words, match = text[start:end], address.match
    note = ""
    if match.between:
        low, high = (numbers[0] for _, numbers in match.between)
        note = translate(
            "'{address}' is not on the map; {low} and {high} are, so a place between them is assumed",
            address=words,
            low=low,
            high=high,
        )
    elif not match.is_whole:
        numbers = f" {translate('and')} ".join(dict.fromkeys(match.numbers))
        note = translate("'{address}' is not on the map; {numbers} is assumed", address=words, numbers=numbers)
    weights = np.ones(len(address.objects) or len(address.lines_m))
    is_exact = match.is_whole and not match.between
    return Mention(words, start, end, "address", address.objects, weights, address.lines_m, 1.0, is_exact, note=note)


def _addresses_apart(
    text: str, mentions: Sequence[Mention], taken: Sequence[CharacterSpan], lookup: Lookup
) -> Iterator[Mention]:
    """Yield the addresses whose street is elsewhere in the text: "on East 28th, at the door of 331"."""
    streets = [mention for mention in mentions if mention.form == "street"]
    for number, is_marked in numbers_apart(text) if streets else ():
        if overlaps(number, taken):
            continue
        nearest = sorted(streets, key=lambda street: (street.start > number.start, abs(street.start - number.start)))
        matches = [match for street in nearest if (match := lookup.address(number.number, street.objects))]
        exact = [match for match in matches if match.match.numbers]
        if exact or (matches and is_marked):
            mention = _mention(text, number.start, number.end, (exact or matches)[0])
            others = [match.objects for match in exact[1:]]  # at a corner it may be a number of either street
            weights = np.concatenate([mention.weights, *(np.full(len(rows), OTHER_STREET_WEIGHT) for rows in others)])
            yield replace(mention, objects=np.concatenate([mention.objects, *others]), weights=weights)


def _addresses_of_places(text: str, mentions: Sequence[Mention], lookup: Lookup) -> Iterator[Mention]:
    """Yield the addresses of places that are no streets of the map: "Stadtbahnbogen 96"."""
    taken = [mention for mention in mentions if mention.form in ("street", "address")]
    words, end = split_words(text), 0
    for first, word in enumerate(words):
        if word.start < end or word.plain[0].isdecimal():
            continue
        for last in reversed(range(first, min(first + MAX_PLACE_WORDS, len(words)))):
            address = _address_of_place(text, words[first : last + 1], lookup)
            characters = words[last].end - word.start
            longer = [street for street in taken if street.form == "address" or len(street.text) >= characters]
            if address is not None and not overlaps(address, longer):
                end = address.end
                yield address
                break


def _address_of_place(text: str, words: Sequence[Word], lookup: Lookup) -> Mention | None:
    name = full_words(tuple(word.plain for word in words))
    if not lookup.has_numbers(name):
        return None
    number = number_beside(text, words[0].start, words[-1].end)
    match = lookup.address_of_names(number.number, [name]) if number is not None else None
    if number is None or match is None or not match.match.numbers:
        return None
    return _mention(text, min(words[0].start, number.start), max(words[-1].end, number.end), match)


def without_city(text: str, lookup: Lookup) -> str:
    """Return a text without the city and country at its end, which tell nothing: ", Helsinki, Finland"."""
    tail = _CITY.search(text)
    if tail is None or not text[: tail.start()].strip():
        return text
    last = plain_words(tail["country"])
    return text if lookup.is_name(last) or lookup.street(last) is not None else text[: tail.start()] + tail["end"]


def _without_tails(mentions: Iterable[Mention], text: str) -> list[Mention]:
    """Leave out the city, postcode and country after an address; without a postcode, a whole name stays."""
    result = list(mentions)
    for address in [mention for mention in result if mention.form == "address"]:
        end, has_code = address.end, False
        while part := _TAIL.match(text, end):
            has_code = has_code or _HAS_CODE.search(part[0]) is not None
            result = [
                mention
                for mention in result
                if not (end <= mention.start and mention.end <= part.end()) or (mention.is_exact and not has_code)
            ]
            if part.end() == end:
                break
            end = part.end()
    return result
