"""Where jobs are kept: a directory each, with its order, its state and its report; what was acknowledged is there."""

import fcntl
import os
import re
import shutil
import tempfile
from pathlib import Path
from typing import Final

import structlog
from pydantic import ValidationError

from app.jobs.job import Job, JobState
from app.jobs.order import Evaluation
from app.jobs.worker import ORDER
from models.files import remove_abandoned, replace_file, sync

JOB: Final = re.compile(r"[0-9a-f]{32}")  # the name of its directory
STATE: Final = "state.json"  # written after the order, and at each change; a directory without one was never promised

log = structlog.get_logger()


class JobStore:
    """The jobs of one service.

    Args:
        directory: outlives the service; None: a temporary one, which does not.
    """

    def __init__(self, directory: Path | None) -> None:
        self._wanted = directory
        self._lock: int | None = None
        self._root: Path | None = None
        self.is_kept = False

    def open(self) -> list[Job]:
        """The jobs that were kept, oldest first; what was running when the service ended is interrupted."""
        self._root, self.is_kept = self._take()
        ours = [path for path in self._root.iterdir() if JOB.fullmatch(path.name)]  # who knows what else is there
        jobs = [job for path in ours if (job := self._load(path)) is not None]
        return sorted(jobs, key=lambda job: job.created)

    def close(self) -> None:
        """Let go of the directory; a temporary one is removed."""
        if self._root is not None and not self.is_kept:
            shutil.rmtree(self._root, ignore_errors=True)
        if self._lock is not None:
            os.close(self._lock)
        self._lock = self._root = None

    def directory_of(self, job_id: str) -> Path:
        """Where a job lies."""
        assert self._root is not None
        return self._root / job_id

    def add(self, job: Job, evaluation: Evaluation) -> None:
        """Write a new job; once this returns it may be promised."""
        job.directory.mkdir()
        sync(job.directory.parent)
        replace_file(job.directory / ORDER, evaluation.model_dump_json().encode())
        self._write(job)

    def write(self, job: Job) -> None:
        """Write a job's state; where that fails, the next start finds it as it was written last."""
        try:
            self._write(job)
        except OSError as error:
            log.error("job not written", job=job.id, status=job.status, reason=error.strerror)

    def _write(self, job: Job) -> None:
        if self.is_kept and job.directory.is_dir():
            replace_file(job.directory / STATE, job.state().model_dump_json().encode())

    def remove(self, job: Job) -> None:
        """Remove a job, and all that it wrote.

        Raises:
            OSError: it cannot be removed.
        """
        (job.directory / STATE).unlink(missing_ok=True)  # first: what is removed in part was never there
        shutil.rmtree(job.directory, ignore_errors=True)

    def _take(self) -> tuple[Path, bool]:
        """A directory of this service alone, and whether it is kept."""
        if self._wanted is not None:
            try:
                self._wanted.mkdir(parents=True, exist_ok=True)
                self._lock = os.open(self._wanted, os.O_RDONLY)
                fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                with tempfile.TemporaryFile(dir=self._wanted):
                    pass
                return self._wanted.absolute(), True
            except OSError as error:
                log.warning("jobs are not kept", directory=str(self._wanted), reason=error.strerror)
        return Path(tempfile.mkdtemp(prefix="hereabouts-evaluate-")), False

    def _load(self, path: Path) -> Job | None:
        """A job; None if it was never promised, which is removed, or cannot be read, which the operator looks after."""
        try:
            state = JobState.model_validate_json((path / STATE).read_bytes())
        except FileNotFoundError:
            shutil.rmtree(path, ignore_errors=True)
            return None
        except (OSError, ValidationError) as error:
            log.error("job not read", job=path.name, reason=getattr(error, "strerror", "its state is broken"))
            return None
        remove_abandoned(path)
        job = Job.of(path, state)
        if job.status == "running":
            job.finish("interrupted")
            self.write(job)
        return job
