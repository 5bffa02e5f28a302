import pytest

from models.language.languages.detect import detect_languages


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        ("I'm on Mannerheimintie next to the Sokos, the tram stop is ahead", ("en",)),
        ("Uudenmaankatu, Diana Park hostel", ("en",)),
        ("12345", ("en",)),
        ("Aleksanterinkatu and Keskuskatu", ("en",)),
        ("Ich stehe vor der Apotheke neben dem Alexanderplatz", ("de",)),
        ("Olen Mannerheimintiellä Sokoksen vieressä, kahvila on edessäni", ("fi",)),
        ("je suis devant la boulangerie au coin de la rue", ("fr",)),
        ("stand to the left of the bank, jag står framför kyrkan och väntar på dig", ("en", "sv")),
        ("Sto davanti alla farmacia, il bar è alla mia destra", ("it",)),
        ("Estoy en la esquina, la farmacia está a mi derecha", ("es",)),
        ("Rosenstraße Ecke Münzstraße", ("de",)),
        ("davanti all'edicola", ("it",)),
        ("右手邊有一間銀行", ("zh",)),
        ("右側にコンビニがあります", ("ja",)),
        ("ночь", ("ru",)),
        ("Я стою рядом с аптекой на Бродвее", ("ru",)),  # noqa: RUF001
    ],
)
def test_languages(text, codes) -> None:
    assert detect_languages(text) == codes
