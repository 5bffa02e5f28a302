"""Starting quickly."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def no_collection() -> Iterator[None]:
    """Collect no garbage while libraries are imported and models loaded, and never look at what is there by then.

    The collector would visit a million objects that stay, again and again: a quarter of the time to start, and a second
    when the process ends.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()
