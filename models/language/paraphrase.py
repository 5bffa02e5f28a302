"""Facts about a position in many wordings: what the reader of free language is trained and tested on.

A grammar is a TOML file in grammar/, data only, or several (`models.language.grammar_files`). Ways to name each class
(`labels`) and colour, the eight winds (`compass`), and phrases by kind: one thing (`one`, `on_top`, `near`, `far_one`,
`absent`, `named`, `named_near`; `bare` without a sentence), a thing and a pronoun (`pronoun`, `colour_apart`), several
things (`two`, `three`, `two_same`; `two_bare` without a sentence, `two_loose` joined by anything; `one_near`,
`one_on_top` the first with a direction, the second at hand or underfoot; `two_near` both at hand), and what surrounds
them (`opener`, `closer`, `irrelevant`, `link`, `leads`). Slots: {d} where the speaker is, seen from the thing, {o} the
opposite; {a}, {A}, {the}, {The}, {n} the thing with its colour, {b}, {theb} without, {c} the colour; {dist}, {name};
numbered with several things. Validation leaves out every phrase and name that training has, and test also those of
validation.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from models.language.grammar_files import Grammar, load_grammar

# Where the speaker is, seen from the thing: the eight winds, right at it, or not said.
WINDS: Final = ("north", "northeast", "east", "southeast", "south", "southwest", "west", "northwest")
RELATIONS: Final = (*WINDS, "on-top", "near")
_SLOT = re.compile(r"\{([a-zA-Z]+?)(\d?)\}")
TYPO_TEXTS, LOWER_TEXTS, BARE_TEXTS = (
    0.2,
    0.15,
    0.1,
)  # shares of the texts with typos, in lower case, without full stops


@dataclass(frozen=True, slots=True)
class Fact:
    """One thing to say.

    Attributes:
        label: class of the thing, a key of the grammar's labels or any words.
        relation: one of RELATIONS.
        colour: word, None if it is not said.
        distance_m: said distance, None if it is not.
        absent: that there is none of it.
        name: proper name of the thing, said instead of label and colour.
    """

    label: str
    relation: str = "near"
    colour: str | None = None
    distance_m: float | None = None
    absent: bool = False
    name: str | None = None


@dataclass(frozen=True, slots=True)
class Mention:
    """Where a text names a thing.

    Attributes:
        fact: number of the fact.
        start, end: the characters of the noun, without article and colour.
        noun: what stands there, before typos.
    """

    fact: int
    start: int
    end: int
    noun: str


@dataclass(frozen=True, slots=True)
class Said:
    """A text, and what of it means what.

    Attributes:
        text: English.
        mentions: in order of the text; one a fact.
    """

    text: str
    mentions: tuple[Mention, ...]

    def then(self, other: "Said", between: str) -> "Said":
        """Both, one after the other."""
        shift = len(self.text) + len(between)
        moved = tuple(replace(m, start=m.start + shift, end=m.end + shift) for m in other.mentions)
        return Said(self.text + between + other.text, self.mentions + moved)


class Wording:
    """A grammar.

    Args:
        grammar: which; "val" without what "train" has, "test" without what either has.
    """

    def __init__(self, grammar: Grammar) -> None:
        tables = load_grammar(grammar)
        self.labels: dict[str, list[str]] = tables["labels"]
        self.colours: dict[str, list[str]] = tables["colours"]
        self.compass: dict[str, list[str]] = tables["compass"]
        self._phrases = {name: table["phrases"] for name, table in tables.items() if "phrases" in table}

    def write(self, facts: Sequence[Fact], rng: np.random.Generator, noise: bool = True) -> Said:
        """A description.

        Args:
            facts: what it says, in some order.
            rng: draws order and words.
            noise: whether typos, lower case and missing full stops may occur.
        """
        order = rng.permutation(len(facts)).tolist()
        sentences = self._surround(self._sentences(facts, order, rng), rng)
        said = sentences[0]
        for sentence in sentences[1:]:
            said = _join(said, sentence, rng)
        return _spoil(said, rng) if noise else said

    def published(self, facts: Sequence[Fact]) -> Said:
        """The benchmark's sentences, one a fact (kitti360pose.md, rule 8), in the order of the facts."""
        said = Said("", ())
        for n, fact in enumerate(facts):
            before = f"The pose is {fact.relation} of a {fact.colour + ' ' if fact.colour else ''}"
            end = len(before) + len(fact.label)
            sentence = Said(f"{before}{fact.label}.", (Mention(n, len(before), end, fact.label),))
            said = said.then(sentence, " ") if said.text else sentence
        return said

    def _sentences(self, facts: Sequence[Fact], order: list[int], rng: np.random.Generator) -> list[Said]:
        left, sentences = list(order), []
        while left:
            kind, taken = self._choose(facts, left, rng)
            left = [n for n in left if n not in taken]
            sentences.append(self._lead(self._fill(self._pick(kind, rng), facts, taken, rng), rng))
        return sentences

    def _choose(self, facts: Sequence[Fact], left: list[int], rng: np.random.Generator) -> tuple[str, list[int]]:
        """A kind of phrase, and the facts that it takes."""
        plain = [n for n in left if _is_plain(facts[n])]
        return (self._choose_plain if left[0] in plain else self._choose_other)(facts, left, plain, rng)

    def _choose_other(
        self, facts: Sequence[Fact], left: list[int], plain: list[int], rng: np.random.Generator
    ) -> tuple[str, list[int]]:
        """For a fact that is more, or less, than a thing and a direction."""
        first, kind = left[0], _kind_alone(facts[left[0]])
        close = [n for n in left[1:] if kind == "near" == _kind_alone(facts[n])]
        if close and self._drawn("two_near", 0.4, rng):
            return "two_near", [first, close[0]]
        if plain and self._drawn(f"one_{kind}", 0.5, rng):
            return f"one_{kind}", [plain[0], first]
        return kind, [first]

    def _choose_plain(
        self, facts: Sequence[Fact], left: list[int], plain: list[int], rng: np.random.Generator
    ) -> tuple[str, list[int]]:
        """For a thing and a direction."""
        first, fact = left[0], facts[left[0]]
        same = [n for n in plain[1:] if facts[n].relation == fact.relation]
        drawn = rng.random()
        if same and drawn < 0.4:
            return "two_same", [first, same[0]]
        if len(plain) > 2 and drawn < 0.5:
            return "three", plain[:3]
        if len(plain) > 1 and drawn < 0.7:
            loose = self._drawn("two_loose", 0.3, rng)
            return "two_loose" if loose else "two_bare" if self._drawn("two_bare", 0.15, rng) else "two", plain[:2]
        apart = fact.colour is not None and drawn > 0.94
        alone = "bare" if self._drawn("bare", 0.15, rng) else "one"
        return "colour_apart" if apart else "pronoun" if drawn > 0.84 else alone, [first]

    def _drawn(self, kind: str, share: float, rng: np.random.Generator) -> bool:
        """Whether a kind is taken that not every grammar has."""
        return bool(self._phrases.get(kind)) and bool(rng.random() < share)

    def _pick(self, kind: str, rng: np.random.Generator) -> str:
        return _one_of(self._phrases[kind], rng)

    def _fill(self, phrase: str, facts: Sequence[Fact], taken: Sequence[int], rng: np.random.Generator) -> Said:
        """A phrase with its slots filled."""
        nouns = [facts[n].name or self._word(self.labels, facts[n].label, rng) for n in taken]
        colours = [c if (c := facts[n].colour) is None else self._word(self.colours, c, rng) for n in taken]
        text, at, mentions = "", 0, dict[int, Mention]()
        for slot in _SLOT.finditer(phrase):
            text += phrase[at : slot.start()]
            at = slot.end()
            k = int(slot[2] or 1) - 1
            before, noun = self._slot(slot[1], facts[taken[k]], nouns[k], colours[k], rng)
            if noun and taken[k] not in mentions:
                start = len(text) + len(before)
                mentions[taken[k]] = Mention(taken[k], start, start + len(noun), nouns[k])
            text += before + noun
        return Said(text + phrase[at:], tuple(mentions.values()))

    def _slot(self, slot: str, fact: Fact, noun: str, colour: str | None, rng: np.random.Generator) -> tuple[str, str]:
        """What stands in a slot: (what comes before the noun, the noun)."""
        if slot in "do":
            wind = fact.relation if slot == "d" else opposite(fact.relation)
            return _one_of(self.compass[wind], rng), ""
        if slot == "c":
            return colour or "", ""
        if slot == "dist":
            said = _one_of(self._phrases["distance"], rng)
            return said.replace("{m}", f"{fact.distance_m or 0:.0f}"), ""
        if slot == "name":
            return "", noun
        with_colour = colour and slot not in ("b", "theb")
        phrase = f"{colour} " if with_colour else ""
        article = {"n": "", "the": "the ", "The": "The ", "theb": "the "}.get(slot)
        if article is None:
            article = _article(phrase + noun)
        if slot == "A":
            article = article.capitalize()
        return article + phrase, noun

    def _word(self, table: dict[str, list[str]], key: str, rng: np.random.Generator) -> str:
        """The key itself or another word for it."""
        others = table.get(key, [])
        plain = key if rng.random() < 0.5 else key.replace("-", " ")
        return _one_of(others, rng) if others and rng.random() < 0.6 else plain

    def _lead(self, said: Said, rng: np.random.Generator) -> Said:
        drawn = rng.random()
        if drawn < 0.08:
            return Said(self._pick("leads", rng), ()).then(_lower_first(said), ", ")
        if drawn < 0.18:
            return Said(self._pick("link", rng), ()).then(_lower_first(said), " ")
        return said

    def _surround(self, sentences: list[Said], rng: np.random.Generator) -> list[Said]:
        if rng.random() < 0.3:
            place = int(rng.integers(len(sentences) + 1))
            sentences = [*sentences[:place], Said(self._pick("irrelevant", rng), ()), *sentences[place:]]
        if rng.random() < 0.3:
            sentences = [Said(self._pick("opener", rng), ()), *sentences]
        if rng.random() < 0.2:
            sentences = [*sentences, Said(self._pick("closer", rng), ())]
        return sentences


def opposite(wind: str) -> str:
    """The other end of the compass."""
    return WINDS[(WINDS.index(wind) + 4) % 8]


def _is_plain(fact: Fact) -> bool:
    has_more = fact.absent or fact.name is not None or fact.distance_m is not None
    return fact.relation in WINDS and not has_more


def _kind_alone(fact: Fact) -> str:
    """The kind of phrase for a fact that is more than a thing and a direction."""
    if fact.name is not None:
        return "named" if fact.relation in WINDS else "named_near"
    if fact.absent:
        return "absent"
    if fact.relation in WINDS:
        return "far_one"
    return "on_top" if fact.relation == "on-top" else "near"


def _one_of(options: Sequence[str], rng: np.random.Generator) -> str:
    return options[int(rng.integers(len(options)))]


def _article(noun: str) -> str:
    if noun.endswith("s") and not noun.endswith(("ss", "us")):
        return "some "
    return "an " if noun[0].lower() in "aeiou" else "a "


def _lower_first(said: Said) -> Said:
    text = said.text
    if text[:1].isupper() and not re.match(r"(I\b|[A-Z]{2})", text) and not any(m.start == 0 for m in said.mentions):
        return replace(said, text=text[0].lower() + text[1:])
    return said


def _join(one: Said, other: Said, rng: np.random.Generator) -> Said:
    """Two sentences, now and then as one long one."""
    if rng.random() < 0.15 and one.text.endswith("."):
        joint = _one_of((", and ", ", ", "; ", " and ", " - "), rng)
        return Said(one.text[:-1], one.mentions).then(_lower_first(other), joint)
    if not one.text.endswith((".", "!", "?", ":", ";")):
        return one.then(other, _one_of(("; ", ". ", ", ", "\n"), rng))
    return one.then(other, " " if rng.random() < 0.95 else "\n")


def _spoil(said: Said, rng: np.random.Generator) -> Said:
    """A text as it is typed in a hurry."""
    drawn = rng.random(3)
    if drawn[0] < LOWER_TEXTS:
        said = replace(said, text=said.text.lower())
    if drawn[1] < BARE_TEXTS:
        said = replace(said, text=said.text.replace(". ", ", ").rstrip("."))
    if drawn[2] < TYPO_TEXTS:
        for _ in range(int(rng.integers(1, 4))):
            said = _typo(said, rng)
    return said


def typos(said: Said, count: int, rng: np.random.Generator) -> Said:
    """The same text with some mistyped letters."""
    for _ in range(count):
        said = _typo(said, rng)
    return said


def _typo(said: Said, rng: np.random.Generator) -> Said:
    """One letter left out, doubled, or changed places with the next."""
    places = [m.start() for m in re.finditer(r"(?<=[a-z])[a-z](?=[a-z])", said.text)]
    if not places:
        return said
    at = places[int(rng.integers(len(places)))]
    text = said.text
    edits: tuple[Callable[[], str], ...] = (
        lambda: text[:at] + text[at + 1 :],
        lambda: text[:at] + text[at] + text[at:],
        lambda: text[:at] + text[at + 1] + text[at] + text[at + 2 :],
    )
    spoiled = edits[int(rng.integers(len(edits)))]()
    grown = len(spoiled) - len(text)
    moved = tuple(
        replace(m, start=m.start + grown * (m.start > at), end=m.end + grown * (m.end > at)) for m in said.mentions
    )
    return Said(spoiled, moved)
