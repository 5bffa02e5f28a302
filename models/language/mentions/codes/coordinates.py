"""Find coordinates in a text, in any common notation, and in links of maps."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from pyproj import Transformer

MAX_LAT, MAX_LON = 90.0, 180.0
MAX_ERROR_DEG: Final = 0.01  # of coordinates with whole minutes, or two decimals
MAX_BARE_ERROR_DEG: Final = 1e-4  # of two numbers without another sign that they are coordinates
_SIGN: Final = str.maketrans("−", "-")  # noqa: RUF001  # a typeset minus


@dataclass(frozen=True, slots=True)
class CodedBox:
    """A code and the box of positions that it stands for, in degrees."""

    start: int
    end: int
    lat: float
    lon: float
    half_lat: float  # half of the box's height
    half_lon: float


_DEGREES = r"[-+−]?\d{1,3}(?:[.,]\d+)?"  # noqa: RUF001
_MINUTES = r"\d{1,2}(?:[.,]\d+)?"
_MARKED = (  # 60° 10' 11.6"
    rf"[-+−]?\d{{1,3}}(?:[.,]\d+)?\s*(?:[°º˚]|deg(?:rees?)?\b)\s*(?:{_MINUTES}\s*(?:['’′´]|min\b)\s*"  # noqa: RUF001
    rf"(?:{_MINUTES}\s*(?:[\"”″]|''|’’|sec\b)?)?)?"  # noqa: RUF001
)
_SPACED = r"\d{1,3}[ :]\d{1,2}(?:[.,]\d+)?(?:[ :]\d{1,2}(?:[.,]\d+)?)?"  # 60 10 11.6, 60 10.194
_ANGLE = rf"(?:{_MARKED}|{_SPACED}|{_DEGREES})"
_GAP = r"\s*[,;/|]?\s*"
_LAT_WORD, _LON_WORD = r"lat(?:itude)?\b\.?\s*[:=]?\s*", r"(?:lon|lng|long|longitude)\b\.?\s*[:=]?\s*"
_DECIMAL = r"[-+−]?\d{1,3}(?:\.\d{3,}|,\d{4,})"  # noqa: RUF001
_TEXT_FORMS: Final = tuple(
    re.compile(rf"(?<![\w.,]){form}", re.IGNORECASE)
    for form in (
        rf"{_LAT_WORD}(?P<lat>{_ANGLE}\s*[NS]?\b){_GAP}(?:and\s+)?{_LON_WORD}(?P<lon>{_ANGLE})(?:\s*[EW]\b)?",
        rf"{_LON_WORD}(?P<lon>{_ANGLE}\s*[EW]?\b){_GAP}(?:and\s+)?{_LAT_WORD}(?P<lat>{_ANGLE})(?:\s*[NS]\b)?",
        rf"(?P<lat>[NS]\s*{_ANGLE}){_GAP}(?P<lon>[EW]\s*{_ANGLE})",
        rf"(?P<lon>[EW]\s*{_ANGLE}){_GAP}(?P<lat>[NS]\s*{_ANGLE})",
        rf"(?P<lat>{_ANGLE}\s*[NS]){_GAP}(?P<lon>{_ANGLE}\s*[EW])(?!\w)",
        rf"(?P<lon>{_ANGLE}\s*[EW]){_GAP}(?P<lat>{_ANGLE}\s*[NS])(?!\w)",
        rf"(?P<lat>{_MARKED}){_GAP}(?P<lon>{_MARKED})",
        rf"(?P<lat>{_DECIMAL})(?:\s*[,;/|]\s*|\s+)(?P<lon>{_DECIMAL})(?![\w.,]\d)(?!\w)",
    )
)
_LINK = re.compile(r"(?:https?://|geo:|www\.)[^\s<>\"]+|\b(?:maps\.[a-z]+|goo\.gl|openstreetmap\.org)[^\s<>\"]*", re.I)
_URL_PAIR = r"(?P<lat>[-+]?\d{1,2}\.\d+)(?:,|%2C)\+?(?:%20)?(?P<lon>[-+]?\d{1,3}\.\d+)"
_LINK_FORMS: Final = tuple(
    re.compile(form, re.IGNORECASE)
    for form in (
        r"!3d(?P<lat>-?\d+\.\d+)!4d(?P<lon>-?\d+\.\d+)",
        r"mlat=(?P<lat>-?\d+\.?\d*)&mlon=(?P<lon>-?\d+\.?\d*)",
        rf"[?&](?:q|query|ll|sll|daddr|destination|center|cp|coordinate|at|near)=(?:loc:)?{_URL_PAIR}",
        r"[?&]lat=(?P<lat>-?\d+\.?\d*)&(?:lon|lng)=(?P<lon>-?\d+\.?\d*)",
        rf"@{_URL_PAIR}",
        r"map=\d+(?:\.\d+)?/(?P<lat>-?\d+\.?\d*)/(?P<lon>-?\d+\.?\d*)",
        rf"geo:{_URL_PAIR}",
        rf"/{_URL_PAIR}",
    )
)
_UTM = re.compile(
    r"(?<!\w)(?P<zone>[1-5]?\d|60)\s?(?P<band>[C-HJ-NP-X])\s+(?P<east>\d{6})(?:\.\d+)?\s?(?:m\s?E|E)?[\s,]+"
    r"(?P<north>\d{7})(?:\.\d+)?\s?(?:m\s?N\b|N\b)?"
)
_NUMBER = re.compile(r"\d+(?:[.,](\d+))?")
_UTM_ERROR_DEG: Final = 1e-5


def find_coordinates(text: str) -> list[CodedBox]:
    """Return the coordinates of a text, without overlaps."""
    boxes = [*_in_links(text)]
    for form in _TEXT_FORMS:
        boxes += [box for match in form.finditer(text) if (box := _box(match, match.start(), match.end())) is not None]
    boxes += [_from_utm(match) for match in _UTM.finditer(text)]
    result: list[CodedBox] = []
    for box in boxes:
        if not any(box.start < other.end and other.start < box.end for other in result):
            result.append(box)
    return sorted(result, key=lambda box: box.start)


def find_links(text: str) -> list[tuple[int, int]]:
    """Return the links of a text, start and end."""
    return [(match.start(), _link_end(match)) for match in _LINK.finditer(text)]


def _link_end(match: re.Match[str]) -> int:
    return match.start() + len(match[0].rstrip(".,;:!?)"))


def _in_links(text: str) -> Iterator[CodedBox]:
    for link in _LINK.finditer(text):
        match = next((match for form in _LINK_FORMS if (match := form.search(link[0]))), None)
        box = match and _box(match, link.start(), _link_end(link))
        if box:
            yield box


def _box(match: re.Match[str], start: int, end: int) -> CodedBox | None:
    """Return the box of a match; None for impossible degrees."""
    (lat, half_lat), (lon, half_lon) = _value(match["lat"]), _value(match["lon"])
    is_bare = match.re is _TEXT_FORMS[-1]
    if max(half_lat, half_lon) > MAX_ERROR_DEG or (is_bare and min(half_lat, half_lon) > MAX_BARE_ERROR_DEG):
        return None
    if abs(lat) > MAX_LON or abs(lon) > MAX_LON or min(abs(lat), abs(lon)) > MAX_LAT:
        return None
    return CodedBox(start, end, lat, lon, half_lat, half_lon)


def _value(angle: str) -> tuple[float, float]:
    """Return an angle in degrees, and half the unit of its last digit."""
    text = angle.translate(_SIGN)
    numbers = list(_NUMBER.finditer(text))[:3]
    parts = [float(number[0].replace(",", ".")) for number in numbers]
    value = sum(part / 60**n for n, part in enumerate(parts))
    half = 0.5 * 10.0 ** -len(numbers[-1][1] or "") / 60 ** (len(parts) - 1)
    is_negative = "-" in text or any(letter in text.upper() for letter in "SW")
    return -value if is_negative else value, half


def _from_utm(match: re.Match[str]) -> CodedBox:
    is_south = match["band"] < "N"
    transformer = Transformer.from_crs(32700 + int(match["zone"]) if is_south else 32600 + int(match["zone"]), 4326)
    lat, lon = transformer.transform(float(match["east"]), float(match["north"]))
    return CodedBox(match.start(), match.end(), lat, lon, _UTM_ERROR_DEG, _UTM_ERROR_DEG)
