"""Logging as JSON lines on stderr, for this project and its libraries."""

import logging
import sys

import structlog

from app.redaction import redacted_traceback


def configure_logging(level: str, with_messages: bool = False) -> None:
    """Send structlog and the standard library's logging to stderr as JSON lines.

    `with_messages` also logs messages of exceptions, which may quote a user's text.
    """
    without_messages = structlog.processors.ExceptionRenderer(lambda exc_info: redacted_traceback(exc_info[1]))
    shared: list[structlog.typing.Processor] = [
        structlog.stdlib.add_log_level,
        structlog.stdlib.add_logger_name,
        structlog.processors.TimeStamper(fmt="iso", utc=True),
        structlog.processors.format_exc_info if with_messages else without_messages,
    ]
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(
        structlog.stdlib.ProcessorFormatter(
            foreign_pre_chain=[*shared, structlog.stdlib.ExtraAdder(allow=set())],
            processors=[
                structlog.stdlib.ProcessorFormatter.remove_processors_meta,
                structlog.processors.JSONRenderer(),
            ],
        )
    )
    logging.basicConfig(level=level.upper(), handlers=[handler], force=True)
    # At info, this logger writes three lines about the builds of FAISS, which help only in debugging.
    logging.getLogger("faiss.loader").setLevel(logging.WARNING if level == "info" else logging.NOTSET)
    structlog.configure(
        processors=[
            structlog.stdlib.filter_by_level,
            *shared,
            structlog.stdlib.PositionalArgumentsFormatter(),
            structlog.stdlib.ProcessorFormatter.wrap_for_formatter,
        ],
        logger_factory=structlog.stdlib.LoggerFactory(),
        wrapper_class=structlog.stdlib.BoundLogger,
    )
