import threading

import pytest

from models.posterior.threads import shared_out


def test_two_tasks_run_at_the_same_time() -> None:
    meet = threading.Barrier(2, timeout=30)
    found = shared_out(lambda n: (meet.wait(), n * n)[1], range(4), is_much=True)
    assert list(found) == [0, 1, 4, 9]


def test_little_stays_in_one_thread() -> None:
    found = shared_out(lambda _: threading.get_ident(), range(3), is_much=False)
    assert set(found) == {threading.get_ident()}


@pytest.mark.parametrize("is_much", [False, True])
def test_what_fails_is_raised(is_much) -> None:
    with pytest.raises(KeyError, match="lost"):
        list(shared_out({"a": 1}.__getitem__, ["a", "lost"], is_much))
