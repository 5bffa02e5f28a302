"""Passages: phrases about several things at once, and the facts that they can express.

A passage is a phrase with numbered slots, as in `models.language.grammar.wording`, and these besides. {o12}: the
direction that things 1 and 2 share; {c12}: their colour, if they have the same; {ns12}: the noun of both in the plural,
if they are of one class, without colour; {1:one}, {2:the other}: words that stand for one of them; {c1=}, {c2=}: the
colours of each, which stand for it ("three poles, a gray, a black and a beige"). {a3!}, {ns34!}: a thing that the
speaker stands on or touches; {a3~}: one that is close by in no direction. {nb1}: the noun alone. {x12} is empty, and
requires that things 1 and 2 lie opposite each other. A direction with an ending, {o1}ern, is the plain word.
The slots of a passage are its pattern: a thing with neither mark needs a direction, and a slot {c1} needs a colour.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any, Final

from models.language.grammar.labelled_text import ObjectFact, opposite

SLOT: Final = re.compile(r"\{(?:(\d):([^{}]+)|([a-zA-Z]+)(\d*)([!~=]?))\}")
_NAMING = ("a", "A", "the", "The", "n", "b", "theb", "nb")
_CLOSE = {"!": "on-top", "~": "near"}
_SHARED_FIELDS = (("o", "relation"), ("d", "relation"), ("ns", "label"), ("c", "colour"))  # by kind of slot
_HEAD_ENDS = re.compile(r" (?:of|that|where|which|with|for|on|in|to|by|from|beside|under|over|between|at)\b")


@dataclass(frozen=True)
class Passage:
    """A phrase and its pattern."""

    phrase: str  # with its slots

    @cached_property
    def slots(self) -> list[tuple[str, tuple[int, ...], str]]:
        """(kind, numbers from 0, mark) of each slot; the kind of stand-ins is "=", and their mark is the words."""
        return [
            ("=", (int(number) - 1,), words) if number else (what, _numbers(numbers), mark)
            for number, words, what, numbers, mark in SLOT.findall(self.phrase)
        ]

    @cached_property
    def pieces(self) -> list[tuple[str, tuple[str, tuple[int, ...], str], str]]:
        """The text before each slot, the slot, and the text after it."""
        ends = [m.span() for m in SLOT.finditer(self.phrase)]
        between = [self.phrase[a:b] for (_, a), (b, _) in pairwise([(0, 0), *ends, (len(self.phrase),) * 2])]
        return list(zip(between[:-1], self.slots, between[1:], strict=True))

    @cached_property
    def end(self) -> str:
        """The text after the last slot."""
        return SLOT.split(self.phrase)[-1]

    @cached_property
    def things(self) -> int:
        """The number of its things."""
        return 1 + max(n for _, numbers, _ in self.slots for n in numbers)

    @cached_property
    def stand_ins(self) -> list[int]:
        """The things that stand-ins or colours refer to."""
        return [
            n for what, numbers, mark in self.slots if what == "=" or (what == "c" and mark == "=") for n in numbers
        ]

    @cached_property
    def close(self) -> dict[int, str]:
        """The relation of each thing without a compass direction."""
        return {
            n: _CLOSE[mark]
            for what, numbers, mark in self.slots
            if mark in _CLOSE and (what in _NAMING or what == "ns")
            for n in numbers
        }

    def shared(self, what: str) -> list[tuple[int, ...]]:
        """Return the numbers of each slot of a kind."""
        return [numbers for kind, numbers, _ in self.slots if kind == what]

    def match(self, facts: Sequence[ObjectFact], left: Sequence[int]) -> list[int] | None:
        """Return facts of `left`, in order of preference, that fit its things; None if there are none."""
        taken: list[int] = []
        return taken if len(left) >= self.things and self._extend(facts, left, taken) else None

    def _extend(self, facts: Sequence[ObjectFact], left: Sequence[int], taken: list[int]) -> bool:
        if len(taken) == self.things:
            return True
        for n in left:
            if n not in taken and self._may_be(facts, taken, n):
                taken.append(n)
                if self._extend(facts, left, taken):
                    return True
                taken.pop()
        return False

    def suit(self, drawn: Sequence[ObjectFact], colour: Callable[[], str]) -> list[ObjectFact]:
        """Return simple facts with compass directions, changed where its pattern requires it."""
        facts: list[ObjectFact] = []
        for n, fact in enumerate(drawn):
            opposites = [opposite(facts[a].relation) for a, b in map(sorted, self.shared("x")) if b == n]
            changed: dict[str, Any] = {"relation": self.close.get(n, (opposites or [fact.relation])[0])}
            for kind, name in _SHARED_FIELDS:
                alike = [m for group in self.shared(kind) if n in group for m in group]
                if min(alike, default=n) < n:
                    changed[name] = getattr(facts[min(alike)], name)
                elif kind == "c" and alike and fact.colour is None:
                    changed[name] = colour()
            facts.append(replace(fact, **changed))
        return facts

    def _may_be(self, facts: Sequence[ObjectFact], taken: Sequence[int], fact: int) -> bool:
        """Return whether a fact can be the next thing after those taken."""
        position, candidate = len(taken), facts[fact]
        if position in self.close:
            if candidate.relation != self.close[position]:
                return False
        elif candidate.relation in _CLOSE.values():
            return False
        if candidate.colour is None and any(position in numbers for numbers in self.shared("c")):
            return False
        if any(
            facts[taken[a]].relation != opposite(candidate.relation)
            for a, b in map(sorted, self.shared("x"))
            if b == position
        ):
            return False
        return all(
            getattr(facts[taken[n]], name) == getattr(candidate, name)
            for kind, name in _SHARED_FIELDS
            for numbers in self.shared(kind)
            if position in numbers
            for n in numbers
            if n < position
        ) and self._is_alike(facts, taken, candidate)

    def _is_alike(self, facts: Sequence[ObjectFact], taken: Sequence[int], candidate: ObjectFact) -> bool:
        """Return whether the things that only a plural names have the same relation."""
        for numbers in self.shared("ns"):
            if len(taken) in numbers and len(taken) not in self.stand_ins:
                return all(facts[taken[n]].relation == candidate.relation for n in numbers if n < len(taken))
        return True


def plural(noun: str) -> str:
    """Return the plural of a noun phrase; its head changes: "sets of lights"."""
    end = _HEAD_ENDS.search(noun)
    head, rest = (noun[: end.start()], noun[end.start() :]) if end else (noun, "")
    if head.endswith("s") and not head.endswith(("ss", "us", "is")):
        return noun
    if re.search(r"(s|x|ch|sh|z)$", head):
        return f"{head}es{rest}"
    return f"{re.sub('y$', 'ie', head) if re.search('[^aeiou]y$', head) else head}s{rest}"


def _numbers(digits: str) -> tuple[int, ...]:
    return tuple(int(digit) - 1 for digit in digits) or (0,)
