import pickle

import numpy as np
import pytest

from models import strings as strings_module
from models.strings import Categorical, Postings, StringArray, merge_columns

STRINGS = ["", "Café Zoë", "Кафе", "", "北京", "a"]


def test_strings_come_back_as_they_were() -> None:
    strings = StringArray.from_strings(STRINGS)
    assert list(strings) == STRINGS
    assert strings[-1] == "a"
    assert strings[1:4] == STRINGS[1:4]
    assert list(StringArray.from_columns(strings.columns("x"), "x")) == STRINGS
    with pytest.raises(IndexError):
        strings[6]


def test_no_strings() -> None:
    assert list(StringArray.from_strings(())) == []


PAIRS = [("b", 5), ("a b", 3), ("b", 2), ("a b", 3), ("", 9), ("a c", 1)]


@pytest.fixture(params=["made", "opened", "pickled"])
def postings(request) -> Postings:
    made = Postings.from_pairs(PAIRS)
    if request.param == "made":
        return made
    return Postings.from_columns(merge_columns([made.columns("x")]), "x") if request.param == "opened" else again(made)


def again(postings: Postings) -> Postings:
    unpickled: Postings = pickle.loads(pickle.dumps(postings))
    return unpickled


def test_numbers_are_found_in_the_order_in_which_they_came(postings) -> None:
    assert postings.find("b").tolist() == [5, 2]
    assert postings.find("a b").tolist() == [3], "once"
    assert postings.find("").tolist() == [9]
    assert postings.find("a").tolist() == []
    assert [postings.count(key) for key in ("b", "a")] == [2, 0]
    assert "a b" in postings
    assert "a" not in postings
    assert len(postings) == 4


def test_rows_have_keys_and_numbers(postings) -> None:
    assert set(postings.all_keys) == {"", "b", "a b", "a c"}
    for row, key in enumerate(postings.all_keys):
        assert postings.key(row) == key
        assert postings.row_numbers(row).tolist() == postings.find(key).tolist()


def test_what_is_below_a_prefix(postings) -> None:
    assert {rest: numbers.tolist() for rest, numbers in postings.with_prefix("a ")} == {"b": [3], "c": [1]}
    assert list(postings.with_prefix("z")) == []


def test_the_same_pairs_are_the_same_bytes() -> None:
    one, other = (Postings.from_pairs(pairs).columns("x") for pairs in (PAIRS, sorted(PAIRS)))
    assert one["x.keys"].tobytes() == other["x.keys"].tobytes()


def test_no_postings() -> None:
    none = Postings.from_pairs(())
    assert not len(none)
    assert not len(none.find("a"))
    assert not len(Postings.from_columns(merge_columns([none.columns("x")]), "x").find("a"))
    assert np.diff(none.starts).tolist() == []


@pytest.mark.parametrize("strings", [("b", None, "ä", "b", ""), ("x",) * 300, (), (None,)])
def test_categories_come_back(strings) -> None:
    categorical = Categorical.from_strings(strings)
    again = Categorical.from_columns(merge_columns([categorical.columns("x")]), "x")
    for one in (categorical, again):
        assert one == strings
        assert Categorical.from_strings(one) is one
        assert one[1:] == strings[1:]
        assert np.array(one).tolist() == list(strings)
    assert list(again.categories) == sorted({*strings} - {None})
    assert categorical.codes.dtype == np.int8
    assert categorical != (*strings, "x")


@pytest.mark.parametrize("at_once", [1, 2, 3, 1000])
@pytest.mark.parametrize("strings", [("b", "a", "b", "ab", "", "b", "a"), ("x",) * 7, ("one",), ()])
def test_categories_of_bytes_are_those_of_strings_however_many_are_looked_at(at_once, strings, monkeypatch) -> None:
    monkeypatch.setattr(strings_module, "STRINGS_PER_BLOCK", at_once)
    from_bytes, expected = Categorical.from_bytes(np.array(strings, "S8")), Categorical.from_strings(strings)
    for name, column in merge_columns([expected.columns("x")]).items():
        assert np.array_equal(from_bytes.columns("x")[name], column)
        assert from_bytes.columns("x")[name].dtype == column.dtype


def test_many_categories_take_more_bytes() -> None:
    strings = [str(n) for n in range(200)]
    assert Categorical.from_strings(strings).codes.dtype == np.int16
    assert Categorical.from_strings(strings) == strings
    assert np.array(Categorical.from_strings(strings[:3])).dtype.kind == "U"


def test_strings_are_found_whole() -> None:
    strings = StringArray.from_strings(["way/1", "", "way/12", "a way/1", "way/1", "ä"])
    assert [*strings.find("way/1")] == [0, 4]
    assert [*strings.find("way/12")] == [2]
    assert [*strings.find("ä")] == [5]
    assert [*strings.find("way/")] == [*strings.find("/1way")] == [*StringArray.from_strings([]).find("a")] == []
