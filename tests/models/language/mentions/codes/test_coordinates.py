import pytest

from models.language.mentions.codes.coordinates import find_coordinates

HERE = (60.1699, 24.9384)


@pytest.mark.parametrize(
    "text",
    [
        "60.1699, 24.9384",
        "60.1699 24.9384",
        "60,16990; 24,93840",
        "lat 60.1699 lon 24.9384",
        "longitude: 24.9384, latitude: 60.1699",
        "N60.1699 E24.9384",
        "60.1699N 24.9384E",
        "60° 10.194' N, 24° 56.304' E",
        "N 60° 10.194' E 24° 56.304'",
        "60°10'11.6\"N 24°56'18.2\"E",
        "60 10 11.6 N 24 56 18.2 E",
        "geo:60.1699,24.9384",
        "https://www.google.com/maps/@60.1699,24.9384,17z",
        "https://maps.google.com/?q=60.1699,24.9384",
        "https://www.openstreetmap.org/#map=17/60.1699/24.9384",
        "https://www.openstreetmap.org/?mlat=60.1699&mlon=24.9384",
        "https://maps.apple.com/?ll=60.1699,24.9384",
        "35V 385611 6672118",
    ],
)
def test_a_notation_of_one_place(text) -> None:
    (box,) = find_coordinates(f"I'm at {text}, please hurry")
    assert (box.lat, box.lon) == pytest.approx(HERE, abs=2e-4)
    assert max(box.half_lat, box.half_lon) <= 0.001


def test_the_southern_and_western_half() -> None:
    for text in ("-33.8568, -70.6483", "33.8568 S 70.6483 W", "S 33.8568, W 70.6483"):
        (box,) = find_coordinates(text)
        assert (box.lat, box.lon) == pytest.approx((-33.8568, -70.6483))


@pytest.mark.parametrize(
    "text",
    [
        "between 10 and 12",
        "call 040 123 4567",
        "it costs 3.50, 4.20",
        "99.1699, 224.9384",
        "at 46, 48 Bulevardi",
        "25th and 10th",
    ],
)
def test_numbers_that_are_no_coordinates(text) -> None:
    assert find_coordinates(text) == []
