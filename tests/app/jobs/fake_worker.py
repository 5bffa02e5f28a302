"""Started by test_jobs.py in place of app.jobs.worker: the same process, with work that a word of
the first description chooses."""

import json
import os
import sys
import time
from pathlib import Path

from app.jobs import worker as evaluation_worker
from app.jobs.evaluation import Evaluation
from models.errors import DataError


def run(self, report_dir, progress):
    hint = self.descriptions[0]
    print("libraries may print what they like")
    progress("ask", 0, 2)
    if "held" in hint:
        time.sleep(60)
    if "wrong" in hint:
        raise DataError(f"{self.index_dir}/cells: are wrong, make them right")
    if "orphan" in hint:
        child = os.fork()
        if child == 0:
            time.sleep(60)
        Path(report_dir).with_name("child").write_text(str(child))
    if "orphan" in hint or "crash" in hint:
        print("secret of the crash", file=sys.stderr, flush=True)
        os.abort()
    if "fault" in hint:
        raise KeyError(hint)
    if "slow" in hint:
        time.sleep(0.4)
    progress("ask", 2, 2)
    report_dir.mkdir()
    (report_dir / "report.json").write_text(json.dumps({"queries": len(self.descriptions), "grow": self.grow_m}))


def main(job_dir):
    Evaluation.run = run
    return evaluation_worker.main(job_dir)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
