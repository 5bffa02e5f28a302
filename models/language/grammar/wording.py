"""Write facts about a position in many wordings, to train and test the reader.

A grammar is a folder of TOML files, data only (`models.language.grammar.files`). Ways to name each class (`labels`) and
colour (`colours`), in training the lexicon's; the compass (`compass`), and phrases by kind: two to six things at once
(`passages`, see `models.language.grammar.passages`), one thing (`one`, `on_top`, `near`, `far_one`, `absent`,
`named`, `named_near`; `bare` without a sentence), a thing and a pronoun (`pronoun`, `colour_apart`), several things
(`two`, `three`, `two_same`; `two_bare` without a sentence, `two_loose` joined by anything; `one_near`, `one_on_top` the
first with a direction, the second at hand or underfoot; `two_near` both at hand), measures (`distance`), and what
surrounds them (`opener`, `closer`, `irrelevant`, `link`, `leads`). Slots: {d} where the speaker is, seen from the
thing, {o} the opposite; {a}, {A}, {the}, {The}, {n} the thing with its colour, {b}, {theb} without, {c} the colour;
{dist}, {name}; numbered with several things. Validation leaves out every phrase and name that training has, and test
also those of validation.
"""

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from models.language.grammar.files import Grammar, load_grammar
from models.language.grammar.labelled_text import LabelledMention, LabelledText, ObjectFact, opposite
from models.language.grammar.passages import Passage, plural
from models.language.grammar.typos import spoil
from models.language.lexicon.lexicon import Names
from models.language.measures import COMPASS

PASSAGE_SHARE = 0.5  # of the times that a passage is tried
PASSAGE_TRIES = 16  # random passages; if there are several things of a class, as many with plurals before
LONG_PASSAGE_THINGS = 4  # things of a passage that can be a whole description


class Wording:
    """A writer of texts with the phrases of a grammar; "train", "val" and "test" share no phrase."""

    def __init__(self, grammar: Grammar) -> None:
        tables = load_grammar(grammar)
        self.labels, self.colours, self.compass = tables.labels, tables.colours, tables.compass
        self._distances = tables.phrases["distance"]
        self._phrases = {kind: [Passage(phrase) for phrase in phrases] for kind, phrases in tables.phrases.items()}
        self._phrases["plurals"] = [p for p in self._phrases["passages"] if p.shared("ns")]
        self._phrases["whole"] = [p for p in self._phrases["passages"] if p.things >= LONG_PASSAGE_THINGS]

    def write(self, facts: Sequence[ObjectFact], rng: np.random.Generator, noise: bool = True) -> LabelledText:
        """Return a description of facts in random order; noise adds typos, lower case and missing full stops."""
        order = rng.permutation(len(facts)).tolist()
        text = self._surround(self._sentences(facts, order, rng), rng)
        return spoil(text, rng) if noise else text

    def whole(self, facts: Sequence[ObjectFact], rng: np.random.Generator) -> tuple[list[ObjectFact], LabelledText]:
        """Return a description that is one long passage, and its facts: six or more simple ones, changed to fit."""
        passage = self._pick("whole", rng)
        suited = passage.suit(facts[: passage.things], lambda: _one_of(tuple(self.colours), rng))
        text = self._surround([self._fill(passage, suited, range(passage.things), rng)], rng)
        return suited, spoil(text, rng)

    def published(self, facts: Sequence[ObjectFact]) -> LabelledText:
        """Return the benchmark's sentences, one per fact, in order (docs/formats.md, rule 8)."""
        text = LabelledText("", ())
        for n, fact in enumerate(facts):
            before = f"The pose is {fact.relation} of a {fact.colour + ' ' if fact.colour else ''}"
            end = len(before) + len(fact.label)
            mention = LabelledMention((n,), len(before), end, fact.label, coloured=fact.colour is not None)
            sentence = LabelledText(f"{before}{fact.label}.", (mention,))
            text = text.followed_by(sentence, " ") if text.text else sentence
        return text

    def _sentences(self, facts: Sequence[ObjectFact], order: list[int], rng: np.random.Generator) -> list[LabelledText]:
        left, sentences = list(order), []
        while left:
            phrase, taken = self._passage(facts, left, rng) or self._phrase(facts, left, rng)
            left = [n for n in left if n not in taken]
            sentences.append(self._lead(self._fill(phrase, facts, taken, rng), rng))
        return sentences

    def _passage(
        self, facts: Sequence[ObjectFact], left: list[int], rng: np.random.Generator
    ) -> tuple[Passage, list[int]] | None:
        """Return a random passage that fits and its facts; None at random, or if none fits."""
        simple = [n for n in left if facts[n].is_simple]
        if len(simple) < 2 or rng.random() >= PASSAGE_SHARE:
            return None
        labels = [facts[n].label for n in simple]
        kinds = ["plurals", "passages"] if len(set(labels)) < len(labels) else ["passages"]
        tried = (self._pick(kind, rng) for kind in kinds for _ in range(PASSAGE_TRIES))
        return next(((p, taken) for p in tried if (taken := p.match(facts, simple))), None)

    def _phrase(
        self, facts: Sequence[ObjectFact], left: list[int], rng: np.random.Generator
    ) -> tuple[Passage, list[int]]:
        kind, taken = self._choose(facts, left, rng)
        return self._pick(kind, rng), taken

    def _choose(self, facts: Sequence[ObjectFact], left: list[int], rng: np.random.Generator) -> tuple[str, list[int]]:
        """Draw a kind of phrase and its facts."""
        plain = [n for n in left if facts[n].is_simple and facts[n].relation in COMPASS]
        return (self._choose_plain if left[0] in plain else self._choose_other)(facts, left, plain, rng)

    def _choose_other(
        self, facts: Sequence[ObjectFact], left: list[int], plain: list[int], rng: np.random.Generator
    ) -> tuple[str, list[int]]:
        """Choose for a fact that is not just a thing and a direction."""
        first, kind = left[0], _kind_alone(facts[left[0]])
        close = [n for n in left[1:] if kind == "near" == _kind_alone(facts[n])]
        if close and self._drawn("two_near", 0.4, rng):
            return "two_near", [first, close[0]]
        if plain and self._drawn(f"one_{kind}", 0.5, rng):
            return f"one_{kind}", [plain[0], first]
        return kind, [first]

    def _choose_plain(
        self, facts: Sequence[ObjectFact], left: list[int], plain: list[int], rng: np.random.Generator
    ) -> tuple[str, list[int]]:
        """Choose for a thing and a direction."""
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
        """Draw whether to use a kind of phrase that not every grammar has."""
        return bool(self._phrases.get(kind)) and bool(rng.random() < share)

    def _pick(self, kind: str, rng: np.random.Generator) -> Passage:
        phrases = self._phrases[kind]
        return phrases[int(rng.integers(len(phrases)))]

    def _fill(
        self, phrase: Passage, facts: Sequence[ObjectFact], taken: Sequence[int], rng: np.random.Generator
    ) -> LabelledText:
        """Fill the slots of a phrase."""
        chosen = [facts[n] for n in taken]
        nouns = [fact.name or self._word(self.labels, fact.label, rng) for fact in chosen]
        colours = [c and self._word(self.colours, c, rng) for c in (fact.colour for fact in chosen)]
        named, text = set[int](), ""
        mentions: list[LabelledMention] = []
        for before, (what, numbers, mark), after in phrase.pieces:
            text += before
            k = numbers[0]
            lead, noun = self._slot(what, mark, chosen[k], nouns[k], colours[k], rng)
            if what in ("d", "o"):
                wind = chosen[k].relation if what == "d" else opposite(chosen[k].relation)
                lead = wind if re.match("-?[a-z]", after) else _one_of(self.compass[wind], rng)  # "ern", "-facing"
            if noun and (what in ("=", "c") or not named.intersection(numbers)):
                start = len(text) + len(lead)
                mention = _mention(phrase, (what, numbers), chosen, start, noun)
                mentions.append(replace(mention, facts=tuple(taken[n] for n in mention.facts)))
                named.update(numbers)
            text += lead + noun
        return LabelledText(text + phrase.end, tuple(mentions))

    def _slot(
        self, what: str, mark: str, fact: ObjectFact, noun: str, colour: str | None, rng: np.random.Generator
    ) -> tuple[str, str]:
        """Return the text of a slot as (words before the noun, noun)."""
        if what in ("d", "o", "x"):
            return "", ""  # no noun
        if what == "c":
            return ("", colour or "") if mark == "=" else (colour or "", "")
        if what == "dist":
            return _one_of(self._distances, rng).replace("{m}", f"{fact.distance_m or 0:.0f}"), ""
        if what in ("name", "nb", "ns", "="):
            return "", {"=": mark, "ns": plural(noun)}.get(what, noun)
        phrase = f"{colour} " if colour and what not in ("b", "theb") else ""
        article = {"n": "", "the": "the ", "The": "The ", "theb": "the "}.get(what)
        if article is None:
            article = _article(phrase + noun)
        if what == "A":
            article = article.capitalize()
        return article + phrase, noun

    def _word(self, table: Names, key: str, rng: np.random.Generator) -> str:
        """Draw the key itself or another word for it."""
        others = table.get(key, [])
        plain = key if rng.random() < 0.5 else key.replace("-", " ")
        return _one_of(others, rng) if others and rng.random() < 0.6 else plain

    def _lead(self, sentence: LabelledText, rng: np.random.Generator) -> LabelledText:
        drawn = rng.random()
        if drawn < 0.08:
            return LabelledText(self._pick("leads", rng).phrase, ()).followed_by(_lower_first(sentence), ", ")
        if drawn < 0.18:
            return LabelledText(self._pick("link", rng).phrase, ()).followed_by(_lower_first(sentence), " ")
        return sentence

    def _surround(self, sentences: list[LabelledText], rng: np.random.Generator) -> LabelledText:
        """Join sentences, at random with an opener, a closer or an irrelevant sentence."""
        if rng.random() < 0.3:
            place = int(rng.integers(len(sentences) + 1))
            sentences = [*sentences[:place], LabelledText(self._pick("irrelevant", rng).phrase, ()), *sentences[place:]]
        if rng.random() < 0.3:
            sentences = [LabelledText(self._pick("opener", rng).phrase, ()), *sentences]
        if rng.random() < 0.2:
            sentences = [*sentences, LabelledText(self._pick("closer", rng).phrase, ())]
        text = sentences[0]
        for sentence in sentences[1:]:
            text = _join(text, sentence, rng)
        return text


def _kind_alone(fact: ObjectFact) -> str:
    """Return the kind of phrase for a fact that is not just a thing and a direction."""
    if fact.name is not None:
        return "named" if fact.relation in COMPASS else "named_near"
    if fact.absent:
        return "absent"
    if fact.relation in COMPASS:
        return "far_one"
    return "on_top" if fact.relation == "on-top" else "near"


def _mention(
    phrase: Passage, slot: tuple[str, tuple[int, ...]], facts: Sequence[ObjectFact], start: int, noun: str
) -> LabelledMention:
    """Return the mention of a slot; its facts are numbers of things."""
    what, numbers = slot
    apart = any(set(numbers) & set(group) for group in phrase.shared("c"))
    coloured = facts[numbers[0]].colour is not None and (apart or what in ("a", "A", "the", "The", "n"))
    end = start + len(noun)
    if what != "ns":
        return LabelledMention(numbers, start, end, noun, "stand-in" if what in ("=", "c") else "noun", coloured)
    is_all = not set(numbers) & set(phrase.stand_ins)
    return LabelledMention(numbers if is_all else (), start, end, noun, "plural", coloured and is_all)


def _one_of(options: Sequence[str], rng: np.random.Generator) -> str:
    return options[int(rng.integers(len(options)))]


def _article(noun: str) -> str:
    if noun.endswith("s") and not noun.endswith(("ss", "us")):
        return "some "
    return "an " if noun[0].lower() in "aeiou" else "a "


def _lower_first(sentence: LabelledText) -> LabelledText:
    text = sentence.text
    is_name = re.match(r"(I\b|[A-Z]{2})", text) or any(m.start == 0 for m in sentence.mentions)
    return replace(sentence, text=text[0].lower() + text[1:]) if text[:1].isupper() and not is_name else sentence


def _join(one: LabelledText, other: LabelledText, rng: np.random.Generator) -> LabelledText:
    """Join two sentences, at random into a single one."""
    if rng.random() < 0.15 and one.text.endswith("."):
        joint = _one_of((", and ", ", ", "; ", " and ", " - "), rng)
        return LabelledText(one.text[:-1], one.mentions).followed_by(_lower_first(other), joint)
    if not one.text.endswith((".", "!", "?", ":", ";")):
        return one.followed_by(other, _one_of(("; ", ". ", ", ", "\n"), rng))
    return one.followed_by(other, " " if rng.random() < 0.95 else "\n")
