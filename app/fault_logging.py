"""A fault as it may be logged: where it happened, without what it says, which may quote what somebody typed."""

import traceback

from app.workers.order import WorkerFault


def where(error: BaseException) -> str:
    """The traceback of an error and of what it came of: their kinds, and none of their words."""
    origin = error.__cause__ or (None if error.__suppress_context__ else error.__context__)
    causes = [*([origin] if origin else []), *(error.exceptions if isinstance(error, BaseExceptionGroup) else [])]
    beyond = [error.where] if isinstance(error, WorkerFault) else []
    here = "".join(traceback.format_tb(error.__traceback__)) + type(error).__qualname__
    return "\n".join([*map(where, causes), *beyond, here])
