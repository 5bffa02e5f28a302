from pathlib import Path

import pytest

from app.settings import load_settings
from models.errors import HereaboutsError


def test_environment_then_what_is_given(monkeypatch):
    monkeypatch.setenv("HEREABOUTS_PORT", "9000")
    monkeypatch.setenv("HEREABOUTS_WEIGHTS_DIR", "/w")
    assert (load_settings().port, load_settings(port=9001).port) == (9000, 9001)
    assert load_settings().weights_dir == Path("/w")


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"max_batch": 0}, "max_batch"),
        ({"port": 70_000}, "port"),
        ({"log_level": "loud"}, "log_level"),
        ({"deadline_ms": 9, "max_deadline_ms": 8}, "deadline_ms 9 is above max_deadline_ms 8"),
    ],
)
def test_value_that_cannot_be_used_is_named(given, named):
    with pytest.raises(HereaboutsError, match=named):
        load_settings(**given)
