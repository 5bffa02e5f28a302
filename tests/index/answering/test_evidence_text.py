from dataclasses import replace

import numpy as np
import pytest

from index.answering.answers import Evidence
from index.answering.evidence_text import UNKNOWN_NAME, with_fit

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
