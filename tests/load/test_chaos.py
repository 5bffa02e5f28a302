import pytest

from tests.load.chaos import run

KILLS, SEED = 5, 7

pytestmark = pytest.mark.slow


def test_no_kill_loses_what_was_acknowledged_or_leaves_anything_half_done(tmp_path):
    counts = list(run(KILLS, SEED, tmp_path))
    assert [row["operation"] for row in counts] == ["build", "switch", "evaluate"]
    assert sum(row["kills"] for row in counts) == KILLS
    for row in counts:
        assert row["before"] + row["during"] + row["after"] == row["kills"]
