import pytest

from models.language.mentions.cue_reader import MAX_CHARACTERS, CueReader
from models.training.posterior.cue_texts import LABELLED_DIR, load_labelled
from models.training.posterior.fit_cues import accuracy


def angles(cues: CueReader, text: str, *things: str) -> list[float | None]:
    """Return the angles of objects in a text."""
    places = [(text.index(thing), text.index(thing) + len(thing), "thing") for thing in things]
    return [read.angle for read in cues.read(text, places)]


def test_texts_that_it_was_not_trained_on_are_read_well(cues) -> None:
    right = accuracy(cues, load_labelled(LABELLED_DIR / "held_out.jsonl"))
    assert right["angle"] >= 0.85
    assert right["relation"] >= 0.7
    assert right["meant"] >= 0.95


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("the bank is on my left and the cafe on my right", [-90, 90]),
        ("There's a bank on my left, a cafe behind me.", [-90, 180]),
        ("behind me there's a bank, and straight ahead the cafe", [180, 0]),
        ("the bank and the cafe are on my right", [90, 90]),
        ("with the bank at my back im looking at the cafe", [180, 0]),
        ("the bank is ahead on the left, the cafe is behind me to the right", [-45, 135]),
        ("I'm outside the bank, next to the cafe", [None, None]),
    ],
)
def test_angles(cues, text, expected) -> None:
    assert angles(cues, text, "bank", "cafe") == expected


def test_an_angle_that_is_not_sure_is_several(cues) -> None:
    text = "the bank is on my left"
    [read] = cues.read(text, [(4, 8, "thing")])
    assert read.angles == ()
    [read] = cues.read("bank left cafe right behind", [(0, 4, "thing")])
    assert sum(p for _, p in read.angles) == pytest.approx(1) or read.angles == ()


def test_mentions_of_a_long_text_are_all_read(cues) -> None:
    text = ("The bank is on my left. " + "I wait for you here, it is cold. " * 24) * 3
    assert len(text) > 2 * MAX_CHARACTERS
    starts = [position for position in range(len(text)) if text.startswith("bank", position)]
    read = cues.read(text, [(start, start + 4, "thing") for start in starts])
    assert [cue.angle for cue in read] == [-90] * 3


def test_nothing_to_read(cues) -> None:
    assert cues.read("the bank", []) == []
    assert cues.read("", []) == []


def test_merged_weights_are_forgotten_in_training(cues) -> None:
    text, places = "the bank is on my left", [(4, 8, "thing")]
    before = cues.read(text, places)
    try:
        cues.train()
        assert cues._int8_layers is None
    finally:
        cues.eval()
    assert cues.read(text, places) == before
