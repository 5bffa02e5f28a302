from pathlib import Path

import pytest

from app.settings import Settings, load_settings
from models.errors import HereaboutsError


def test_environment_then_what_is_given(monkeypatch):
    monkeypatch.setenv("HEREABOUTS_PORT", "9000")
    monkeypatch.setenv("HEREABOUTS_WEIGHTS_DIR", "/w")
    assert (load_settings().port, load_settings(port=9001).port) == (9000, 9001)
    assert load_settings().weights_dir == Path("/w")


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"max_wait_ms": 0}, "max_wait_ms"),
        ({"port": 70_000}, "port"),
        ({"log_level": "loud"}, "log_level"),
        *(
            ({"read_key": key}, "read_key: .*openssl")
            for key in ("", " " * 9, "sevenof", "two words", "line\n12345", "schlüssel")
        ),
    ],
)
def test_value_that_cannot_be_used_is_named(given, named):
    with pytest.raises(HereaboutsError, match=named):
        load_settings(**given)


def test_key_is_shown_by_no_error_and_no_settings(monkeypatch):
    monkeypatch.setenv("HEREABOUTS_READ_KEY", "wh1te space")
    with pytest.raises(HereaboutsError) as refused:
        load_settings()
    with pytest.raises(ValueError, match="read_key") as raised:
        Settings()
    assert "wh1te" not in str(refused.value) + str(raised.value)
    monkeypatch.setenv("HEREABOUTS_READ_KEY", "wh1te-space")
    assert "wh1te" not in repr(load_settings()) + load_settings().model_dump_json()
