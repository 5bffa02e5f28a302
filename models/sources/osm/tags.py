"""The tags of an element, as far as they describe what is on the ground, with names on one line."""

import re
from collections.abc import Iterable, Mapping
from typing import Any, Final

# Keys with these prefixes describe what is out of use, gone or planned
_PREFIX: Final = re.compile(
    "(?:disused|abandoned|was|demolished|razed|removed|destroyed|dismantled|proposed|planned|construction):"
)
FEATURE_KEYS: Final = frozenset(
    (
        "aeroway", "amenity", "barrier", "bridge", "building", "club", "craft", "emergency", "healthcare", "highway",
        "historic", "landuse", "leisure", "man_made", "natural", "office", "place", "public_transport", "railway",
        "shop", "tourism",
    )
)  # fmt: skip
# Keys of what people do somewhere: it ends when it is out of use, while a building or a wall stays
ACTIVITY_KEYS: Final = frozenset(
    ("amenity", "club", "craft", "healthcare", "leisure", "office", "public_transport", "railway", "shop", "tourism")
)
GONE_STATES: Final = frozenset(("demolished", "razed", "removed", "destroyed", "dismantled", "proposed", "planned"))
UNUSED_STATES: Final = frozenset(("disused", "abandoned", "vacant", "closed"))
_STATES: Final = GONE_STATES | UNUSED_STATES  # values of a feature ("shop=vacant"), or keys ("disused=yes")
_CONTROL: Final = re.compile("[\x00-\x1f\x7f-\x9f\u2028\u2029]")
_DIRECTION: Final = re.compile("[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ufeff]")  # marks of right-to-left text
_NAME: Final = re.compile(r"(?:[a-z]+_)?name(?::.+)?|brand|operator|addr:housename")


def read_tags(tags: Iterable[Any]) -> dict[str, str]:
    """Return the tags of an element without features that are not there.

    If none of its features is there, it has no names either: they are those of what was there.
    """
    lines = {tag.k: tag.v if tag.v.isprintable() else one_line(tag.v) for tag in tags}
    is_plain = _STATES.isdisjoint(lines) and _STATES.isdisjoint(lines.values())
    return lines if is_plain and not any(map(_PREFIX.match, lines)) else _drop_gone(lines)


def one_line(text: str) -> str:
    """Return a text on one line, without marks of direction."""
    return " ".join(_CONTROL.sub(" ", _DIRECTION.sub("", text)).split())


def _drop_gone(tags: Mapping[str, str]) -> dict[str, str]:
    """Return tags without features that are gone, planned or out of use, and without names that were theirs."""
    states = {state for state in _STATES if tags.get(state) == "yes"}
    gone = {key for key, value in tags.items() if _PREFIX.match(key) or _is_gone(key, value, states)}
    present = {key: value for key, value in tags.items() if key not in gone}
    was_feature = not FEATURE_KEYS.isdisjoint(_PREFIX.sub("", key) for key in gone)
    if was_feature and FEATURE_KEYS.isdisjoint(present):
        return {key: value for key, value in present.items() if not _NAME.fullmatch(key)}
    return present


def _is_gone(key: str, value: str, states: set[str]) -> bool:
    """Whether a tag is of a feature that is gone; a road or a building that is out of use is still there."""
    if key not in FEATURE_KEYS:
        return False
    is_activity = key in ACTIVITY_KEYS or (key, value) == ("highway", "bus_stop")
    return (
        value in GONE_STATES
        or not GONE_STATES.isdisjoint(states)
        or (value in UNUSED_STATES and (is_activity or key == "highway"))
        or (is_activity and not UNUSED_STATES.isdisjoint(states))
    )
