import gc

import pytest

from app.startup import without_garbage_collection


@pytest.fixture(autouse=True)
def collecting():
    yield
    gc.unfreeze()
    gc.enable()


def test_nothing_is_collected_inside_and_what_stays_is_not_looked_at_afterwards():
    gc.unfreeze()
    with without_garbage_collection():
        assert not gc.isenabled()
    assert gc.isenabled()
    assert gc.get_freeze_count() > 0


def test_collection_is_on_again_after_an_error():
    with pytest.raises(RuntimeError), without_garbage_collection():
        raise RuntimeError
    assert gc.isenabled()
