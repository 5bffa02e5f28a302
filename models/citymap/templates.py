"""The benchmark's hint sentences and other wordings of the same hints (docs/formats.md, rule 8)."""

import re
from collections.abc import Sequence
from functools import cache
from typing import Final, cast

from models.citymap.types import Direction, Hint

OPPOSITE: Final[dict[Direction, Direction]] = {
    "north": "south",
    "south": "north",
    "east": "west",
    "west": "east",
    "on-top": "on-top",
}
# The first is the benchmark's (docs/formats.md, rule 8); the others are more natural wordings. {d} is the
# direction of the speaker as seen from the instance, {o} that of the instance as seen from the speaker.
TEMPLATES: Final[tuple[str, ...]] = (
    "The pose is {d} of {a}.",
    "I am {d} of {a}.",
    "There is {a} {o} of me.",
    "{A} is to my {o}.",
    "I stand to the {d} of {the}.",
    "To my {o} there is {a}.",
    "{The} lies {o} of where I am.",
    "I can see {a} to the {o}.",
)
ON_TOP_TEMPLATES: Final[tuple[str, ...]] = (
    "The pose is on-top of {a}.",
    "I am on top of {a}.",
    "There is {a} right where I am.",
    "{A} is right beside me.",
    "I stand on {the}.",
    "Directly at my feet there is {a}.",
    "{The} is right here.",
    "I can touch {a}.",
)


def render_hint(hint: Hint, template: int = 0) -> str:
    """Return a hint as an English sentence, in the wording of an index into TEMPLATES."""
    noun = f"{hint.colour} {hint.label}" if hint.colour else hint.label
    # The benchmark writes "a" before any word; the other wordings are correct English.
    article = "an" if template and noun[0] in "aeiou" else "a"
    words = {
        "a": f"{article} {noun}",
        "A": f"{article.capitalize()} {noun}",
        "the": f"the {noun}",
        "The": f"The {noun}",
    }
    if hint.direction == "on-top":
        return ON_TOP_TEMPLATES[template].format(**words)
    return TEMPLATES[template].format(**words, d=hint.direction, o=OPPOSITE[hint.direction])


def parse_hint(sentence: str, colours: Sequence[str]) -> Hint | None:
    """Return the hint that `render_hint` writes as this sentence, in any wording; None for any other sentence.

    `colours` are the words that are colours where they stand before the label.
    """
    for template, pattern in _patterns():
        if match := pattern.fullmatch(sentence):
            noun, direction = match["noun"], cast(Direction, match.groupdict().get("direction", "on-top"))
            colour = next((word for word in colours if noun.startswith(f"{word} ")), None)
            label = noun[len(colour) + 1 :] if colour else noun
            return Hint(OPPOSITE[direction] if "{o}" in template else direction, label, colour)
    return None


@cache
def _patterns() -> tuple[tuple[str, re.Pattern[str]], ...]:
    """Return each template with a pattern of its sentences."""
    winds, noun = "(?P<direction>north|south|east|west)", "(?P<noun>.+)"
    slots = {"d": winds, "o": winds} | dict.fromkeys(("a", "A", "the", "The"), f"(?:An?|an?|The|the) {noun}")
    templates = *TEMPLATES, *ON_TOP_TEMPLATES
    return tuple((text, re.compile(text.replace(".", r"\.").format(**slots))) for text in templates)
