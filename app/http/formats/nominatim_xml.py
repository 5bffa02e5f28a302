"""Nominatim's XML."""

import re
from collections.abc import Mapping, Sequence
from typing import Any, Final
from xml.etree.ElementTree import Element, SubElement, tostring

NOT_IN_XML: Final = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")  # XML 1.0, 2.2
_RENAMED: Final = {"category": "class"}
_OMITTED: Final = frozenset(("licence", "name", "addresstype"))


def places_xml(places: Sequence[Mapping[str, Any]], licence: str) -> bytes:
    """Return the answer of /search and /lookup."""
    root = Element("searchresults", attribution=_plain(licence))
    for place in places:
        _add_address(SubElement(root, "place", _attributes(place)), place)
        _add_tags(root[-1], place)
    return tostring(root, encoding="UTF-8", xml_declaration=True)


def place_xml(place: Mapping[str, Any], licence: str) -> bytes:
    """Return the answer of /reverse; `place` may be an error."""
    root = Element("reversegeocode", attribution=_plain(licence))
    if "error" in place:
        SubElement(root, "error").text = place["error"]
    else:
        attributes = _attributes(place)
        name = attributes.pop("display_name")
        SubElement(root, "result", attributes).text = name
        if "address" in place:
            _add_address(SubElement(root, "addressparts"), place)
        _add_tags(root, place)
    return tostring(root, encoding="UTF-8", xml_declaration=True)


def _attributes(place: Mapping[str, Any]) -> dict[str, str]:
    """Return the fields of a place that are no objects."""
    return {
        _RENAMED.get(name, name): _plain(",".join(value) if isinstance(value, list) else str(value))
        for name, value in place.items()
        if not isinstance(value, dict) and name not in _OMITTED
    }


def _add_address(parent: Element, place: Mapping[str, Any]) -> None:
    for name, part in place.get("address", {}).items():
        SubElement(parent, name).text = _plain(part)


def _add_tags(parent: Element, place: Mapping[str, Any]) -> None:
    tags = SubElement(parent, "extratags")
    for name, value in place["extratags"].items():
        SubElement(tags, "tag", key=name, value=_plain(value))
    if "namedetails" in place:
        names = SubElement(parent, "namedetails")
        for name, value in place["namedetails"].items():
            SubElement(names, "name", desc=name).text = _plain(value)


def _plain(text: str) -> str:
    """Return a text without the characters that XML excludes."""
    return NOT_IN_XML.sub("", text)
