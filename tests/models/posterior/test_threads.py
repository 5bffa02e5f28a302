import threading

import pytest

from models.posterior.threads import both


def test_two_things_run_at_the_same_time() -> None:
    meet = threading.Barrier(2, timeout=30)
    assert both(lambda: (meet.wait(), "a")[1], lambda: (meet.wait(), "b")[1]) == ("a", "b")


@pytest.mark.parametrize("fails", [0, 1])
def test_what_fails_in_either_is_raised(fails) -> None:
    def fail() -> int:
        raise KeyError("lost")

    with pytest.raises(KeyError, match="lost"):
        both(*[(lambda: 1), fail][:: -1 if fails == 0 else 1])
