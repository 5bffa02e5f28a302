"""An executor for tests of what other processes compute: an import of torch takes each of them seconds."""

import pickle
from concurrent.futures import Executor, Future
from typing import Any


class InProcess(Executor):
    """Runs each task in this process at once; functions, arguments and results are pickled, as for another one."""

    def __init__(self, *_: Any) -> None:
        pass

    def submit(self, *call: Any, **kwargs: Any) -> "Future[Any]":
        function, *args = pickle.loads(pickle.dumps(call))
        future: Future[Any] = Future()
        future.set_result(pickle.loads(pickle.dumps(function(*args, **kwargs))))
        return future
