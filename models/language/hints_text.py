"""From a description as people type it to hint sentences, and from hints to sentences."""

import re
from typing import Final

from models.city.types import Direction, Hint
from models.errors import DescriptionError

# A sentence ends at . ! ? ; or a line break; a dot inside a number or an abbreviation's letter does not end one.
_BREAK = re.compile(r"(?<=[.!?;。！？])(?<!\b\w\.)(?=\s|$)|[\r\n]+")  # noqa: RUF001  # Chinese and Japanese too
_BULLET = re.compile(r"^[ \t]*(?:[-*•–—·]+|\(?\d{1,2}[.)])[ \t]+", re.M)  # noqa: RUF001  # a dash too
_HAS_WORD = re.compile(r"\w")
OPPOSITE: Final[dict[Direction, Direction]] = {
    "north": "south",
    "south": "north",
    "east": "west",
    "west": "east",
    "on-top": "on-top",
}
# The first is the benchmark's (docs/formats.md, rule 8); the others are how people say the same. {d} is where
# the speaker is seen from the instance, {o} the opposite: where the instance is seen from the speaker.
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


def split_hints(description: str) -> tuple[str, ...]:
    """The sentences of a description, or the lines of a list, one hint each.

    Args:
        description: any text; sentences end at . ! ? ; or a line break.

    Raises:
        DescriptionError: there is no letter or digit in it, but for the numbers of a list.
    """
    sentences = (part.strip(" \t;,") for part in _BREAK.split(_BULLET.sub("", description)))
    hints = tuple(sentence for sentence in sentences if _HAS_WORD.search(sentence))
    if not hints:
        raise DescriptionError(
            "the description has no words; say what is around you, for example 'I am north of a gray building.'"
        )
    return hints


def render_hint(hint: Hint, template: int = 0) -> str:
    """A hint as an English sentence.

    Args:
        hint: what to say; without a colour, none is said.
        template: index into TEMPLATES.
    """
    noun = f"{hint.colour} {hint.label}" if hint.colour else hint.label
    # The benchmark writes "a" before any word; people do not.
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
