import os
import threading

import pytest

from models.threads import beside, end_second_thread, shared_out


def test_two_tasks_run_at_the_same_time() -> None:
    meet = threading.Barrier(2, timeout=30)
    found = shared_out(lambda n: (meet.wait(), n * n)[1], range(4), is_much=True)
    assert found == [0, 1, 4, 9]


def test_little_stays_in_one_thread() -> None:
    found = shared_out(lambda _: threading.get_ident(), range(3), is_much=False)
    assert set(found) == {threading.get_ident()}


def test_where_the_second_thread_is_busy_the_first_does_all() -> None:
    done = threading.Event()
    waits = beside(lambda: done.wait(30))
    found = shared_out(lambda _: threading.get_ident(), range(3), is_much=True)
    done.set()
    assert set(found) == {threading.get_ident()}
    assert waits()


@pytest.mark.parametrize("is_much", [False, True])
def test_what_fails_is_raised(is_much) -> None:
    with pytest.raises(KeyError, match="lost"):
        shared_out({"a": 1}.__getitem__, ["a", "lost"], is_much)


def test_what_fails_beside_is_raised_to_who_waits_for_it() -> None:
    waits = beside(lambda: {"a": 1}["lost"])
    with pytest.raises(KeyError, match="lost"):
        waits()


def test_the_second_thread_ends_and_comes_again() -> None:
    ended = beside(threading.current_thread)()
    end_second_thread()
    end_second_thread()
    assert not ended.is_alive()
    assert beside(threading.current_thread)() is not ended


def test_a_forked_process_has_a_second_thread_of_its_own() -> None:
    assert beside(lambda: 1)() == 1
    child = os.fork()
    if child == 0:
        os._exit(beside(lambda: 7)())
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
