"""The process that runs one evaluation: `python -m app.jobs.worker JOB_DIR`.

JOB_DIR/evaluation.json   what to do (app.jobs.order.Evaluation)
JOB_DIR/report/           what comes out; complete when the process exits with 0
stdout                    a JSON line at a time: {"stage", "done", "total"}, or {"error"} before it exits with 1
stdin                     nothing; when it closes, whoever started this process is gone, and so is the work
"""

import json
import os
import signal
import sys
import threading
import time
from pathlib import Path
from typing import TextIO

from app.fault_logging import where
from app.jobs.order import Evaluation
from app.settings import load_settings
from app.threads import set_thread_env
from models.errors import HereaboutsError

ORDER, REPORT = "evaluation.json", "report"
NICENESS = 10  # /localize comes first
LEAST_S = 0.1  # between two lines of one stage
LONGEST_ERROR = 2000  # characters; a line has to fit into the reader's buffer


class Lines:
    """Writes progress for another process, seldom enough to be no work."""

    def __init__(self, out: TextIO) -> None:
        self._out = out
        self._stage = ""
        self._next_s = 0.0

    def progress(self, stage: str, done: int, total: int) -> None:
        """Say how far it is; said too soon after the last time, it is left out."""
        now_s = time.monotonic()
        if stage != self._stage or now_s >= self._next_s or done == total:
            self._stage, self._next_s = stage, now_s + LEAST_S
            self.write({"stage": stage, "done": done, "total": total})

    def write(self, line: dict[str, str | int]) -> None:
        """Write a line at once."""
        print(json.dumps(line), file=self._out, flush=True)


def main(job_dir: Path) -> int:
    """Run the evaluation of a job's directory.

    Returns:
        The exit status.
    """
    threading.Thread(target=_die_with_the_service, daemon=True).start()
    os.nice(NICENESS)
    set_thread_env()
    lines = Lines(_take_stdout())
    evaluation = Evaluation.model_validate_json((job_dir / ORDER).read_bytes())
    try:
        evaluation.run(job_dir / REPORT, lines.progress)
    except HereaboutsError as error:
        lines.write({"error": evaluation.public(str(error))[:LONGEST_ERROR]})
        return 1
    except Exception as error:
        if load_settings().log_descriptions:
            raise
        print(where(error), file=sys.stderr)  # of which the service logs the end
        return 1
    return 0


def _take_stdout() -> TextIO:
    """The standard output for this process alone: what libraries print goes to stderr, forked children have neither."""
    own = os.dup(1)
    os.dup2(2, 1)
    os.register_at_fork(after_in_child=lambda: os.close(own))
    return os.fdopen(own, "w", closefd=False)


def _die_with_the_service() -> None:
    """End this process and all it has forked when stdin closes."""
    while os.read(0, 1):
        pass
    if os.getpgrp() == os.getpid():
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
