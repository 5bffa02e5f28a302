"""The process that runs one evaluation: `python -m app.jobs.worker JOB_DIR`.

JOB_DIR/evaluation.json   the evaluation (app.jobs.evaluation.Evaluation)
JOB_DIR/report/           the report; complete when the process exits with 0
stdout                    JSON lines: {"stage", "done", "total"}, or {"error"} before it exits with 1
stdin                     empty; when it closes, the service is gone and this process exits
"""

import json
import os
import signal
import sys
import threading
import time
from pathlib import Path
from typing import TextIO

from app.jobs.evaluation import Evaluation
from app.redaction import redacted_traceback
from app.settings import load_settings
from app.threads import set_thread_env
from models.errors import HereaboutsError

EVALUATION_FILE, REPORT_DIR = "evaluation.json", "report"
NICENESS = 10  # requests to /localize come first
MIN_LINE_INTERVAL_S = 0.1  # between two progress lines of one stage
MAX_ERROR_CHARACTERS = 2000  # a line has to fit into the buffer of asyncio's StreamReader


class ProgressWriter:
    """Writes progress as JSON lines, rarely enough to cost nothing."""

    def __init__(self, out: TextIO) -> None:
        self._out = out
        self._stage = ""
        self._next_s = 0.0

    def progress(self, stage: str, done: int, total: int) -> None:
        """Write progress, unless a line of the same stage was written just before."""
        now_s = time.monotonic()
        if stage != self._stage or now_s >= self._next_s or done == total:
            self._stage, self._next_s = stage, now_s + MIN_LINE_INTERVAL_S
            self.write({"stage": stage, "done": done, "total": total})

    def write(self, line: dict[str, str | int]) -> None:
        """Write a line at once."""
        print(json.dumps(line), file=self._out, flush=True)


def main(job_dir: Path) -> int:
    """Run the evaluation of a job's directory and return the exit status."""
    threading.Thread(target=_exit_with_service, daemon=True).start()
    os.nice(NICENESS)
    set_thread_env()
    lines = ProgressWriter(_take_stdout())
    evaluation = Evaluation.model_validate_json((job_dir / EVALUATION_FILE).read_bytes())
    try:
        evaluation.run(job_dir / REPORT_DIR, lines.progress)
    except HereaboutsError as error:
        lines.write({"error": evaluation.hide_paths(str(error))[:MAX_ERROR_CHARACTERS]})
        return 1
    except Exception as error:
        if load_settings().log_descriptions:
            raise
        print(redacted_traceback(error), file=sys.stderr)  # the service logs the end of it
        return 1
    return 0


def _take_stdout() -> TextIO:
    """Return the real standard output; redirect prints of libraries to stderr and close it in forked children."""
    own = os.dup(1)
    os.dup2(2, 1)
    os.register_at_fork(after_in_child=lambda: os.close(own))
    return os.fdopen(own, "w", closefd=False)


def _exit_with_service() -> None:
    while os.read(0, 1):
        pass
    if os.getpgrp() == os.getpid():
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
