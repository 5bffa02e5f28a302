"""Find the codes of a text, and what each stands for on a map."""

import re
from collections.abc import Iterator, Sequence
from math import hypot
from pathlib import Path
from typing import Final

import numpy as np
import shapely
from openlocationcode import openlocationcode

from models.citymap.frame import Frame
from models.citymap.gazetteer.name_columns import plain_code
from models.citymap.points import Ints, bounding_corners
from models.citymap.types import Floats
from models.language.languages.translation import translate
from models.language.measures import CharacterSpan, TextSpan, find_measures, overlaps
from models.language.mentions.codes.coordinates import CodedBox, find_coordinates, find_links
from models.language.mentions.lookup import NO_LINES, Lookup
from models.language.mentions.mentions import NO_OBJECTS, Mention, MentionForm
from models.language.mentions.word_lists import WordLists

MARGIN_M: Final = 100.0  # around the cells, where a code is still on the map
POINT_M: Final = 15.0  # a box that reaches no farther from its middle is a point
HATCH_M, MAX_HATCHES = 20.0, 60  # between the lines that fill an area, and their number
POSTCODE_MARGIN_M: Final = 30.0  # around the addresses with a postcode
MIN_POSTCODE_ADDRESSES: Final = 3

_W = WordLists(Path(__file__).parent / "words.toml")
_PLUS_CODE = re.compile(
    r"(?<![\w+])(?=[^+\s]{4,8}\+)[23456789CFGHJMPQRVWX0]{4,8}\+[23456789CFGHJMPQRVWX]{0,7}(?!\w)", re.I
)
_THREE_WORDS = re.compile(
    rf"///\s?\w+\.\w+\.\w+|(?<=\b)(?:{_W.text('undecodable', 'three_words')})[ :]+(?:is |are |at )?"
    r"(?://)?/?\w+[. ]\w+[. ]\w+\b",
    re.IGNORECASE,
)
_MAPS = _W.pattern("undecodable", "maps")
_REF = r"(?P<ref>(?-i:[A-ZА-Я]{0,6})[ -]?\d{1,6}(?-i:[A-Z])?|(?-i:[A-ZА-Я])\d?)(?![\w]|[.,:]\d)"  # noqa: RUF001
_NUMBER = rf"[ ,:]*(?:{_W.text('refs', 'number')}[ :]*)?"
_WITH_WORD: Final = tuple(
    (kind, form)
    for kind in ("stop", "exit", "road")
    for form in (
        re.compile(rf"\b(?:{_W.text('refs', kind)})\b{_NUMBER}{_REF}", re.IGNORECASE),
        re.compile(rf"(?<![\w-]){_REF} (?:{_W.text('refs', kind)})\b", re.IGNORECASE),
    )
)
_BARE: Final = (
    ("stop", re.compile(r"(?<![\w-])(?P<ref>[A-Z]{1,5}-?\d{2,5}[A-Z]?)(?![\w-])")),
    ("road", re.compile(r"(?<![\w-])(?P<ref>[A-Z]{1,3}[ -]?\d{1,4}[A-Z]?)(?![\w-])")),
)
_MIN_STRONG: Final = 3  # characters of a reference that is one without being on the map
_POSTCODE_WORD = _W.pattern("refs", "postcode", r"\b(?:{})[ :]*$")
_POSTCODE = re.compile(
    r"(?<![\w.-])(?:[A-Z]{1,3}-)?(?P<ref>\d{3,6}(?:[ -]\d{2,4})?|[A-Z]{1,2}\d[A-Z\d]? ?\d[A-Z]{2})(?![\w-]|\.\d)"
)
_NAMES_ONLY = re.compile(r"[\s,.;:]*(?:[^\W\d_a-z][\w'’.-]*[\s,.;:]*){0,4}")  # noqa: RUF001


_DIGITS = re.compile(r"\d+[a-z]?")


class CodeReader:
    """Finds codes and places them on one map, whose cells have centres [N, 2]."""

    def __init__(self, lookup: Lookup, frame: Frame, centers_m: Floats) -> None:
        self._lookup, self._frame = lookup, frame
        self._low_m, self._high_m = bounding_corners(centers_m)

    def find(self, text: str) -> list[Mention]:
        """Return the mentions of codes, without overlaps; their `note` says what cannot be decoded or used."""
        result = list[Mention]()
        for mention in (*self._undecodable(text), *self._places(text), *self._references(text)):
            if not overlaps(mention, result):
                result.append(mention)
        return sorted(result, key=lambda mention: mention.start)

    def postcodes(self, text: str, mentions: Sequence[Mention]) -> Iterator[Mention]:
        """Yield postcodes, as the areas of their addresses; an address or a place of the text says more."""
        if any(mention.form in ("address", "point") for mention in mentions):
            return
        for match in _POSTCODE.finditer(text):
            has_word = _POSTCODE_WORD.search(text[: match.start()]) is not None
            is_all = not text[: match.start()].strip() and _NAMES_ONLY.fullmatch(text, match.end()) is not None
            objects = self._lookup.coded("post", plain_code(match["ref"]))
            if not (has_word or is_all) or overlaps(_span(match), mentions):
                continue
            if len(objects) < MIN_POSTCODE_ADDRESSES:
                if has_word:
                    yield _unknown(text, match, translate("'{code}' is no postcode of this map", code=match[0]))
                continue
            points_m = shapely.multipoints(self._lookup.gazetteer.middles_m[objects])
            yield _point(text, _span(match), _hatched(shapely.concave_hull(points_m, 0.4).buffer(POSTCODE_MARGIN_M)))

    def _undecodable(self, text: str) -> Iterator[Mention]:
        for match in _THREE_WORDS.finditer(text):
            note = translate(
                "'{code}' is a three-word address, which cannot be decoded; send coordinates or a plus code",
                code=match[0],
            )
            yield _unknown(text, match, note)

    def _places(self, text: str) -> Iterator[Mention]:
        """Yield coordinates, plus codes and links."""
        if not self._frame.is_georeferenced:
            return
        coordinates = find_coordinates(text)
        yield from (self._placed(text, box) for box in coordinates)
        for match in _PLUS_CODE.finditer(text):
            if (box := self._plus_code(match)) is not None:
                yield self._placed(text, box)
        for start, end in find_links(text):
            link = text[start:end]
            if _MAPS.search(link):
                note = translate("'{link}' has no coordinates; send coordinates or a plus code", link=link)
            else:
                note = translate("'{link}' was not read", link=link)
            yield Mention(link, start, end, "unknown", note=note)

    def _plus_code(self, match: re.Match[str]) -> CodedBox | None:
        code = match[0].upper()
        if not openlocationcode.isFull(code):
            if not openlocationcode.isShort(code) or len(code.partition("+")[2]) < 2:
                return None
            lat, lon = self._frame.to_wgs84((self._low_m + self._high_m) / 2)
            code = openlocationcode.recoverNearest(code, float(lat), float(lon))
        area = openlocationcode.decode(code)
        half = (area.latitudeHi - area.latitudeLo) / 2, (area.longitudeHi - area.longitudeLo) / 2
        return CodedBox(match.start(), match.end(), area.latitudeCenter, area.longitudeCenter, *half)

    def _placed(self, text: str, box: CodedBox) -> Mention:
        words, note = text[box.start : box.end], ""
        middle_m, corner_m = self._box_m(box.lat, box.lon, box.half_lat, box.half_lon)
        outside_m = self._outside_m(middle_m)
        if outside_m > 0:
            swapped_m, swapped_corner_m = self._box_m(box.lon, box.lat, box.half_lon, box.half_lat)
            if self._outside_m(swapped_m) > 0:
                note = _outside_note(words, outside_m)
                return Mention(words, box.start, box.end, "unknown", note=note)
            middle_m, corner_m = swapped_m, swapped_corner_m
            note = translate(
                "'{code}' is on the map only as longitude and latitude, so it was read in this order", code=words
            )
        half_m = np.abs(corner_m - middle_m)
        is_point = max(half_m) <= POINT_M
        area = (
            np.concatenate([middle_m, middle_m])[None]
            if is_point
            else _hatched(shapely.box(*(middle_m - half_m), *(middle_m + half_m)))
        )
        return _point(text, box, area, note)

    def _box_m(self, lat: float, lon: float, half_lat: float, half_lon: float) -> tuple[Floats, Floats]:
        """Return the middle [2] and a corner [2] of a box; far away for what is no latitude."""
        if abs(lat) >= 90.0:
            return np.full(2, np.inf), np.full(2, np.inf)
        middle_m, corner_m = self._frame.from_wgs84(np.array([lat, lat + half_lat]), np.array([lon, lon + half_lon]))
        return middle_m, corner_m

    def _outside_m(self, position_m: Floats) -> float:
        """Return how far a position [2] is from the map; 0 on it."""
        if not np.isfinite(position_m).all():
            return np.inf
        outside = np.maximum(np.maximum(self._low_m - MARGIN_M - position_m, position_m - self._high_m - MARGIN_M), 0.0)
        return hypot(*outside)

    def _references(self, text: str) -> Iterator[Mention]:
        """Yield references of stops, exits, doors and roads."""
        measures = find_measures(text)
        for n, (kind, form) in enumerate((*_WITH_WORD, *_BARE)):
            is_word_first = n < len(_WITH_WORD) and n % 2 == 0
            for match in form.finditer(text):
                if overlaps(_span(match), measures):
                    continue
                objects = self._coded(kind, plain_code(match["ref"]))
                words = match[0], match.start(), match.end()
                if len(objects):
                    shape: MentionForm = "street" if kind == "road" else "thing"
                    yield Mention(*words, shape, objects, np.ones(len(objects)), NO_LINES, 1.0, is_exact=True)
                elif is_word_first and kind != "road" and len(plain_code(match["ref"])) >= _MIN_STRONG:
                    yield Mention(*words, "unknown")

    def _coded(self, kind: str, ref: str) -> Ints:
        """Return the objects with a reference; a stop's may lack the letters of its city, and an exit be a door."""
        objects = self._lookup.coded(kind, ref)
        if len(objects) or kind == "road":
            return objects
        if kind == "exit":
            return self._lookup.coded("door", ref)
        digits = _DIGITS.search(ref)
        return objects if digits is None or len(digits[0]) < _MIN_STRONG else self._lookup.coded(kind, digits[0])


def _unknown(text: str, match: re.Match[str], note: str) -> Mention:
    return Mention(text[match.start() : match.end()], match.start(), match.end(), "unknown", note=note)


def _point(text: str, span: CharacterSpan, lines_m: Floats, note: str = "") -> Mention:
    words, weights = text[span.start : span.end], np.ones(len(lines_m))
    return Mention(words, span.start, span.end, "point", NO_OBJECTS, weights, lines_m, 1.0, is_exact=True, note=note)


def _span(match: re.Match[str]) -> CharacterSpan:
    return TextSpan(*match.span())


def _hatched(area: shapely.Geometry) -> Floats:
    """Return lines [n, 4] that fill an area."""
    west, south, east, north = shapely.bounds(area).tolist()
    count = int(min(max(1.0, np.ceil((north - south) / HATCH_M)), MAX_HATCHES))
    y = south + (np.arange(count) + 0.5) * (north - south) / count
    rows = shapely.linestrings([((west, one), (east, one)) for one in y.tolist()])
    parts = shapely.get_parts(shapely.intersection(rows, area))
    ends = [shapely.get_coordinates(part)[[0, -1]].ravel() for part in parts if shapely.length(part) > 0]
    return np.array(ends).reshape(-1, 4)


def _outside_note(code: str, metres: float) -> str:
    if not np.isfinite(metres) or metres > 1e6:
        return translate("'{code}' is far outside the map and was not used", code=code)
    distance = f"{metres / 1000:.0f} km" if metres >= 1000 else f"{metres:.0f} m"
    return translate("'{code}' is {distance} outside the map and was not used", code=code, distance=distance)
