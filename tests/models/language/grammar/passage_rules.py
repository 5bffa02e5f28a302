"""The rules that each passage of the grammar keeps."""

import re

from models.language.grammar.passages import SLOT, Passage

NAMING = ("a", "A", "the", "The", "n", "b", "theb", "nb")
SLOTS = {*NAMING, "d", "o", "x", "c", "ns"}
ARTICLES = {"a", "an", "An", "the", "The"}


def problem_of(passage: Passage) -> str | None:
    """Return what is wrong with the phrase; None if it is valid."""
    numbers = {n for _, group, _ in passage.slots for n in group}
    named = [n for kind in (*NAMING, "ns") for group in passage.shared(kind) for n in group]
    directed = {n for kind in "do" for group in passage.shared(kind) for n in group}
    directed |= {n for group in passage.shared("x") if directed & set(group) for n in group}
    stand_ins = passage.stand_ins
    plural = [n for group in passage.shared("ns") for n in group]
    unknown = {what for what, _, _ in passage.slots} - SLOTS - {"="}
    checks = (
        (bool(unknown), f"unknown slots {sorted(unknown)}"),
        (SLOT.sub("", passage.phrase).count("{") > 0, "a brace is not part of a slot"),
        (numbers != set(range(len(numbers))), "things must be numbered 1, 2, ... without a gap"),
        (not 2 <= len(numbers) <= 6, "a passage is about two to six things"),
        (set(named) != numbers, "each thing must be named, by a slot such as {a1} or together with {ns12}"),
        (any(named.count(n) > 1 and n in plural for n in numbers), "a thing of {ns12} needs no other noun"),
        (any(len(s) < 2 for s in passage.shared("ns")), "{ns12} is for two things or more"),
        (directed | set(passage.close) != numbers, "each thing needs a direction, {a1!} or {a1~}, to be told where"),
        (
            any(len(group) != 2 or group[0] == group[1] for group in passage.shared("x")),
            "{x12} is for two things",
        ),
        (bool(directed & set(passage.close)), "a thing has a direction, or is marked with ! or ~, not both"),
        (len(set(stand_ins)) != len(stand_ins), "only one pair of words can stand for a thing"),
        (bool(ARTICLES & {mark for what, _, mark in passage.slots if what == "="}), "no article stands for a thing"),
        (not set(stand_ins) <= set(plural), "words stand for a thing only where {ns..} named it"),
        (
            any(0 < len(set(s) & set(stand_ins)) < len(s) for s in passage.shared("ns")),
            "one stand-in a thing, or none",
        ),
        (
            _splits_a_plural(passage),
            "what {ns12} names without stand-ins has one direction, {o12}, and one colour, {c12}",
        ),
        (bool(re.search(r"\b(north|south|east|west)", SLOT.sub("", passage.phrase), re.I)), "directions are slots"),
    )
    return next((message for wrong, message in checks if wrong), None)


def _splits_a_plural(passage: Passage) -> bool:
    """Return whether a slot describes only some of the things that a plural names."""
    stand_ins = set(passage.stand_ins)
    plurals = [set(group) for group in passage.shared("ns") if not stand_ins & set(group)]
    stated = [set(group) for kind in "doc" for group in passage.shared(kind)]
    return any(plural & group and not plural <= group for plural in plurals for group in stated)
