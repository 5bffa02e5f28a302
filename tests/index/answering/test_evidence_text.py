from dataclasses import replace

import numpy as np
import pytest

from index.answering.answers import Evidence
from index.answering.evidence_text import UNKNOWN_NAME, with_fit
from models.language.languages.translation import replies_in

HERE = np.array([100.0, 100.0])
PHARMACY = Evidence(
    "pharmacy", None, None, None, "near", None, False, 0.9, name="Apteekki Bulevardia", at=(116.0, 100.0)
)


@pytest.mark.parametrize(
    ("change", "heading_deg", "words"),
    [
        ({}, None, "Apteekki Bulevardia, 16 m to the east"),
        ({}, 0.0, "Apteekki Bulevardia, 16 m to your right"),
        ({}, 180.0, "Apteekki Bulevardia, 16 m to your left"),
        ({}, 45.0, "Apteekki Bulevardia, 16 m ahead on your right"),
        ({}, 95.0, "Apteekki Bulevardia, 16 m ahead of you"),
        ({}, 225.0, "Apteekki Bulevardia, 16 m behind you on your left"),
        ({}, 270.0, "Apteekki Bulevardia, 16 m behind you"),
        ({"name": "Pharmacy"}, None, "16 m to the east"),
        ({"name": None, "at": (100.0, 100.4)}, None, "right here"),
        ({"explained": 0.1, "name": None, "at": (175.0, 100.0)}, None, "75 m away to the east"),
        ({"explained": 0.1, "at": None}, None, "not found here"),
        ({"explained": 0.9, "absent": True, "at": None}, None, "none here, as described"),
        ({"explained": 0.1, "absent": True, "at": None}, None, "there is one here"),
    ],
)
def test_the_words_for_evidence(change, heading_deg, words) -> None:
    assert with_fit(replace(PHARMACY, **change), HERE, heading_deg).fit == f"pharmacy: {words}"


def test_a_name_that_the_map_lacks() -> None:
    unknown = replace(PHARMACY, text="Wawa", at=None, explained=0.0)
    assert with_fit(unknown, HERE, missing=UNKNOWN_NAME).fit == "Wawa: unknown name"


@pytest.mark.parametrize(
    ("code", "east", "left", "far", "absent", "missing"),
    [
        (
            "fi",
            "16 m itään",
            "16 m vasemmalla puolellasi",
            "vasta 16 m itään",
            "täällä on sellainen",
            "ei löydy täältä",
        ),
        (
            "sv",
            "16 m åt öster",
            "16 m till vänster om dig",
            "16 m bort, åt öster",
            "det finns här",
            "hittades inte här",
        ),
        (
            "de",
            "16 m östlich",
            "16 m links von Ihnen",
            "16 m entfernt, östlich",
            "hier vorhanden",
            "hier nicht gefunden",
        ),
        (
            "fr",
            "à 16 m à l\u2019est",
            "à 16 m à votre gauche",
            "à 16 m de là, à l\u2019est",
            "il y en a ici",
            "introuvable ici",
        ),
        (
            "es",
            "a 16 m al este",
            "a 16 m a tu izquierda",
            "lejos, a 16 m al este",
            "aquí sí hay",
            "no se encuentra aquí",
        ),
    ],
)
def test_the_words_for_evidence_in_other_languages(code, east, left, far, absent, missing) -> None:
    plain = replace(PHARMACY, name=None)
    colon = "\u00a0: " if code == "fr" else ": "
    with replies_in(code):
        texts = [
            with_fit(plain, HERE),
            with_fit(plain, HERE, 180.0),
            with_fit(replace(plain, explained=0.1), HERE),
            with_fit(replace(plain, absent=True, explained=0.1), HERE),
            with_fit(replace(plain, at=None), HERE),
        ]
    assert [text.fit for text in texts] == [f"pharmacy{colon}{words}" for words in (east, left, far, absent, missing)]
