import re

import pytest

from models.citymap.templates import ON_TOP_TEMPLATES, TEMPLATES, parse_hint, render_hint
from models.citymap.types import DIRECTIONS, Hint
from models.errors import DescriptionError
from models.language.sentences import (
    locate_spans,
    split_for_reader,
    split_hints,
    without_capitals,
    without_repetition,
    without_speakers,
)


@pytest.mark.parametrize(
    ("text", "hints"),
    [
        (
            "I am north of a gray building. A black pole is to my west.",
            ("I am north of a gray building.", "A black pole is to my west."),
        ),
        ("one thing", ("one thing",)),
        ("a tree to the north; a bench to the south", ("a tree to the north", "a bench to the south")),
        ("A lamp!\nA bin?\r\n\r\nA wall", ("A lamp!", "A bin?", "A wall")),
        ("It is 2.5 m north of a wall.", ("It is 2.5 m north of a wall.",)),
        ("Olen puun vieressä. 我在树旁。", ("Olen puun vieressä.", "我在树旁。")),
        ("... A tree. !!!", ("A tree.",)),
        (
            "What I see:\n- a lamp, north of me,\n * a wall: I am on it\n1. a bin\n(2) a tree",
            ("What I see:", "a lamp, north of me", "a wall: I am on it", "a bin", "a tree"),
        ),
        ("12 m north of a wall - a gray one", ("12 m north of a wall - a gray one",)),
    ],
)
def test_splitting(text, hints) -> None:
    assert split_hints(text) == hints


@pytest.mark.parametrize("text", ["", "   ", "...", "!?", "\n\n", "🙂🙂"])
def test_no_words_is_an_error(text) -> None:
    with pytest.raises(DescriptionError, match="no words"):
        split_hints(text)


def test_the_first_template_is_the_benchmarks() -> None:
    assert render_hint(Hint("north", "building", "gray")) == "The pose is north of a gray building."
    assert render_hint(Hint("on-top", "road")) == "The pose is on-top of a road."


def test_both_points_of_view_agree() -> None:
    assert (
        render_hint(Hint("north", "tree", "green"), TEMPLATES.index("There is {a} {o} of me."))
        == "There is a green tree south of me."
    )
    assert render_hint(Hint("east", "awning"), TEMPLATES.index("I am {d} of {a}.")) == "I am east of an awning."


def test_every_template_renders() -> None:
    assert len(TEMPLATES) == len(ON_TOP_TEMPLATES)
    texts = {render_hint(Hint(d, "wall", "red"), t) for d in DIRECTIONS for t in range(len(TEMPLATES))}
    assert len(texts) == len(DIRECTIONS) * len(TEMPLATES)
    assert all("red wall" in t and "{" not in t for t in texts)


@pytest.mark.parametrize("template", range(len(TEMPLATES)))
def test_every_template_is_parsed(template) -> None:
    for direction in DIRECTIONS:
        for colour in (None, "gray", "gray-green"):
            hint = Hint(direction, "street lamp", colour)
            assert parse_hint(render_hint(hint, template), ("gray", "gray-green")) == hint
    assert parse_hint(render_hint(Hint("west", "awning", "red"), template), ()) == Hint("west", "red awning")


@pytest.mark.parametrize(
    "text", ["", "a wall", "The pose is near a wall.", "I am north of a wall, it is red", "I stand"]
)
def test_other_sentences_are_no_template(text) -> None:
    assert parse_hint(text, ("red",)) is None


@pytest.mark.parametrize(
    "description",
    [
        "I am north of a building. A building is east.",
        "  - I am north of a building\n  - A building is east",
        "1) I am north of a building;\n\n2) A building is east, ",
        "a building?! I see it all. I am north of a building. A building is east",
    ],
)
def test_parts_of_what_is_read_are_found_in_the_text(description) -> None:
    text = " ".join(split_for_reader(description, 800))
    spans = [match.span() for match in re.finditer(r"[Aa] building|north|east", text)]
    result = [span for span in locate_spans(description, text, spans[::-1])[::-1] if span]
    assert [description[slice(*span)] for span in result] == [text[slice(*span)] for span in spans]
    assert result == sorted(result)
    assert len(set(result)) == len(spans), "a second building is not the first one again"


def test_what_does_not_stand_in_the_text_has_no_place() -> None:
    assert locate_spans("a tree", "a tree.", [(2, 6), (2, 7), (3, 3)]) == [(2, 6), None, None]


def test_a_list_with_wide_bullets_does_not_lose_its_place() -> None:
    description = "\n".join("        -        a tree" for _ in range(12))
    text = " ".join(split_for_reader(description, 800))
    result = locate_spans(description, text, [match.span() for match in re.finditer("tree", text)])
    assert result == [match.span() for match in re.finditer("tree", description)]


@pytest.mark.parametrize("times", [1, 2, 5])
@pytest.mark.parametrize("text", ["I'm at 5 Main St. A bank is on my left!", "near the bank.\nby a tree."])
def test_a_text_said_several_times_is_said_once(text, times) -> None:
    assert without_repetition(" ".join([text] * times)) == text
    assert without_repetition(f"{text} {text} A pond.") == f"{text} {text} A pond."


def test_a_passage_without_full_stops_that_is_repeated_is_read_once() -> None:
    text = "by the bank on Main Street, a tree on my left"
    assert without_repetition(" ".join([text] * 3)) == text
    assert without_repetition("no no") == "no no"


def test_a_text_in_capitals_is_read_like_one_without() -> None:
    assert without_capitals("BY THE BANK!") == "by the bank!"
    assert without_capitals("By the BANK") == "By the BANK"


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("Dispatcher: Where are you?\nCaller: On Bulevardi, at 12:30", ["Where are you?", "On Bulevardi, at 12:30"]),
        ("CALLER: HELP\r\n911 Operator: WHERE?", ["HELP", "WHERE?"]),
        ("Soittaja: Täällä!\nPäivystäjä: Missä?", ["Täällä!", "Missä?"]),
        ("Caller: I am here. Dispatcher: Where?", ["I am here.             Where?"]),
        ("**Caller:** here", ["here"]),
        ("00:12 A: a church\n00:15 B: where?", ["a church", "where?"]),
        ("Speaker 1  0:12\nA church.\n\nSpeaker 2 (1:02:03)\nOK", ["A church.", "OK"]),
        ("Anna: by a bank\nBo K.: which?\nAnna: red\nBo K.: ok", ["by a bank", "which?", "red", "ok"]),
        ("Me: by a bank\nBen: which?\nMe: red\nBen: ok", ["by a bank", "which?", "red", "ok"]),
        ("[00:12] Anna: by a bank\n[00:15] Anna: red", ["by a bank", "red"]),
        ("1\n00:00:01,000 --> 00:00:04,000\nhere\n\n2\n00:00:05,000 --> 00:00:06,000\na bank", ["here", "a bank"]),
    ],
)
def test_speakers_and_time_stamps_of_transcripts_become_blanks(text, lines) -> None:
    cleaned = without_speakers(text)
    assert len(cleaned) == len(text)
    assert [line.strip() for line in cleaned.splitlines() if line.strip()] == lines
    assert split_hints(text) == tuple(hint for line in lines for hint in re.split(r"(?<=[.])\s+", line))
    assert " ".join(split_for_reader(text, 800)).replace(".", "").split() == " ".join(lines).replace(".", "").split()


@pytest.mark.parametrize(
    "text",
    [
        "M: the sign of the metro\nB: an exit",
        "5:30 train, the station is ahead",
        "Address: Bulevardi 5",
        "Address: Bulevardi 5\nLandmark: a church\nAddress: on the corner",
        "Left: a church\nRight: a park",
        "Left: a church. Right: a park. Left: a school. Right: a bar.",
        "On my left: a church\nOn my right: a park\nOn my left: a school\nOn my right: a bar",
        "Links: eine Kirche.\nRechts: ein Park.\nLinks: eine Schule.\nRechts: ich sehe eine Bank.",
        "What I see: a lamp. On my left: a wall",
        "Bulevardi 5: a red door",
        "Bulevardi: smoke\nKamppi: fire",
        "It is 12:30: a church is to my left",
        "see https://example.org/a: b",
    ],
)
def test_texts_with_colons_stay(text) -> None:
    assert without_speakers(text) == text
