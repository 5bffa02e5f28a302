import numpy as np
import pytest

from models.citymap import colours
from models.citymap.colours import BASIC_PALETTE, KITTI360_PALETTE, PALETTES, material_colour, parse_colour


@pytest.mark.parametrize("word", sorted(set(BASIC_PALETTE.words)))
def test_a_colour_written_as_a_basic_word_is_that_word(word) -> None:
    assert BASIC_PALETTE.word(np.array(parse_colour(word))) == word


@pytest.mark.parametrize("palette", PALETTES.values(), ids=PALETTES)
def test_centres_name_themselves_and_match_a_naive_search(palette) -> None:
    assert len(palette.words) == len(palette.centers)
    rgb = np.random.default_rng(0).random((50, 3))
    for colour, result in zip(rgb, palette.word_index(rgb), strict=True):
        distances = [sum((c * 255 - k) ** 2 for c, k in zip(colour, center, strict=True)) for center in palette.centers]
        assert result == distances.index(min(distances))


def test_many_colours_are_compared_some_at_a_time(monkeypatch) -> None:
    rgb = np.random.default_rng(0).random((4, 10, 3))
    expected = BASIC_PALETTE.word_index(rgb)
    monkeypatch.setattr(colours, "COLOURS_PER_BLOCK", 7)
    assert np.array_equal(BASIC_PALETTE.word_index(rgb[::-1]), expected[::-1])
    assert expected.shape == (4, 10)


def test_an_unknown_colour_has_no_word() -> None:
    assert KITTI360_PALETTE.word(np.array([np.nan] * 3)) is None
    assert KITTI360_PALETTE.word_index(np.array([[0.1, 0.1, 0.1], [np.nan, 0.5, 0.5]])).tolist() == [5, -1]


def test_two_centres_share_the_word_gray() -> None:
    assert [w for w in KITTI360_PALETTE.words if w == "gray"] == ["gray", "gray"]


def test_materials() -> None:
    assert material_colour("asphalt") == pytest.approx((75 / 255,) * 3)
    assert material_colour("glass") is None
