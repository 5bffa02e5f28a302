"""Logs as JSON lines on stderr, ours and the libraries'."""

import logging
import sys

import structlog

from app.fault_logging import where


def configure_logging(level: str, with_words: bool = False) -> None:
    """Send structlog and the standard library's logging to stderr as JSON lines.

    Args:
        level: least severe level to show: "debug", "info", "warning" or "error".
        with_words: whether faults are shown with what they say, which may quote what somebody typed.
    """
    without_words = structlog.processors.ExceptionRenderer(lambda exc_info: where(exc_info[1]))
    shared: list[structlog.typing.Processor] = [
        structlog.stdlib.add_log_level,
        structlog.stdlib.add_logger_name,
        structlog.processors.TimeStamper(fmt="iso", utc=True),
        structlog.processors.format_exc_info if with_words else without_words,
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
    # It says at info which of its builds it tries and loads: three lines that are of use when debugging alone.
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
