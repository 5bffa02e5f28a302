"""Tracebacks without messages, which may quote a user's text."""

import traceback

from app.workers.messages import WorkerFault


def redacted_traceback(error: BaseException) -> str:
    """Return the traceback of an error and its causes with the types of the errors but without their messages."""
    origin = error.__cause__ or (None if error.__suppress_context__ else error.__context__)
    causes = [*([origin] if origin else []), *(error.exceptions if isinstance(error, BaseExceptionGroup) else [])]
    in_worker = [error.redacted_traceback] if isinstance(error, WorkerFault) else []
    own = "".join(traceback.format_tb(error.__traceback__)) + type(error).__qualname__
    return "\n".join([*map(redacted_traceback, causes), *in_worker, own])
