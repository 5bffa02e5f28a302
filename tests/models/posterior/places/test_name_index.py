import pytest

from models.posterior.places.name_index import NameIndex

STREETS = [("East 42nd Street",), ("West 42nd Street",), ("Fabianinkatu", "Fabiansgatan"), ("Broadway",)]
PLACES = [("Café Zoë",), ("R-Kioski",), ("R-kioski", "Ärrä"), ("The Strand", "Strand Books"), ("Ärrä",), ("!!!",)]


def columns(names, text, *, are_streets):
    spelt = NameIndex.build(names, are_streets=are_streets)
    return [spelt.shown[n] for n in spelt.find(text)]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("fabianinkatu", ["Fabianinkatu"]),
        ("FABIANSGATAN", ["Fabianinkatu"]),
        ("E 42nd St", ["East 42nd Street"]),
        ("forty-second street", ["East 42nd Street", "West 42nd Street"]),
        ("Elm Street", []),
        ("", []),
    ],
)
def test_streets(text, names):
    assert columns(STREETS, text, are_streets=True) == names


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("cafe zoe", ["Café Zoë"]),
        ("R kioski", ["R-Kioski"]),
        ("strand", ["The Strand"]),
        ("arra", ["R-Kioski", "Ärrä"]),
        ("!!!", ["!!!"]),
        ("???", []),
        ("Zoë", []),
    ],
)
def test_places(text, names):
    assert columns(PLACES, text, are_streets=False) == names


def test_objects_of_one_name_share_a_column():
    spelt = NameIndex.build(PLACES, are_streets=False)
    assert spelt.column.tolist() == [0, 1, 1, 2, 3, 4]
    assert len(spelt) == len(spelt.shown) == 5
    assert len(NameIndex.build([], are_streets=True)) == 0
