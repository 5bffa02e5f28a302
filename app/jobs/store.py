"""Evaluation jobs on disk: each has a directory with its evaluation, its state and its report."""

import fcntl
import os
import re
import shutil
import tempfile
from pathlib import Path
from typing import Final

import structlog
from pydantic import ValidationError

from app.jobs.evaluation import Evaluation
from app.jobs.job import EvaluationJob, JobState
from app.jobs.worker import EVALUATION_FILE
from models.files import remove_abandoned, replace_file, sync

JOB_ID: Final = re.compile(r"[0-9a-f]{32}")  # also the name of its directory
STATE: Final = "state.json"  # written last and at each change; a directory without it was never acknowledged

log = structlog.get_logger()


class JobStore:
    """The stored jobs of one service, in a directory kept over restarts, or in a temporary one."""

    def __init__(self, directory: Path | None) -> None:
        self._directory = directory
        self._lock: int | None = None
        self._root: Path | None = None
        self.is_persistent = False

    def open(self) -> list[EvaluationJob]:
        """Return the stored jobs, oldest first; those that were running become interrupted."""
        self._root, self.is_persistent = self._lock_directory()
        job_dirs = [path for path in self._root.iterdir() if JOB_ID.fullmatch(path.name)]  # ignore other files
        jobs = [job for path in job_dirs if (job := self._load(path)) is not None]
        return sorted(jobs, key=lambda job: job.created)

    def close(self) -> None:
        """Release the directory; remove a temporary one."""
        if self._root is not None and not self.is_persistent:
            shutil.rmtree(self._root, ignore_errors=True)
        if self._lock is not None:
            os.close(self._lock)
        self._lock = self._root = None

    def job_dir(self, job_id: str) -> Path:
        """Return the directory of a job."""
        assert self._root is not None
        return self._root / job_id

    def add(self, job: EvaluationJob, evaluation: Evaluation) -> None:
        """Write a new job durably, so that it can be acknowledged."""
        job.directory.mkdir()
        sync(job.directory.parent)
        replace_file(job.directory / EVALUATION_FILE, evaluation.model_dump_json().encode())
        self._write(job)

    def write(self, job: EvaluationJob) -> None:
        """Write the state of a job; on failure, the previously written state stays."""
        try:
            self._write(job)
        except OSError as error:
            log.error("job not written", job=job.id, status=job.status, reason=error.strerror)

    def _write(self, job: EvaluationJob) -> None:
        if self.is_persistent and job.directory.is_dir():
            replace_file(job.directory / STATE, job.state().model_dump_json().encode())

    def remove(self, job: EvaluationJob) -> None:
        """Remove a job and its files; OSError if it cannot be removed."""
        (job.directory / STATE).unlink(missing_ok=True)  # first, so that a partly removed job is not loaded
        shutil.rmtree(job.directory, ignore_errors=True)

    def _lock_directory(self) -> tuple[Path, bool]:
        """Return a directory that only this service uses, and whether it is kept."""
        if self._directory is not None:
            try:
                self._directory.mkdir(parents=True, exist_ok=True)
                self._lock = os.open(self._directory, os.O_RDONLY)
                fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                with tempfile.TemporaryFile(dir=self._directory):
                    pass
                return self._directory.absolute(), True
            except OSError as error:
                log.warning("jobs are not kept", directory=str(self._directory), reason=error.strerror)
        return Path(tempfile.mkdtemp(prefix="hereabouts-evaluate-")), False

    def _load(self, path: Path) -> EvaluationJob | None:
        """Load a job; None if it was never acknowledged, and is removed, or if it is unreadable, and is left alone."""
        try:
            state = JobState.model_validate_json((path / STATE).read_bytes())
        except FileNotFoundError:
            shutil.rmtree(path, ignore_errors=True)
            return None
        except (OSError, ValidationError) as error:
            log.error("job not read", job=path.name, reason=getattr(error, "strerror", "its state is corrupt"))
            return None
        remove_abandoned(path)
        job = EvaluationJob.from_state(path, state)
        if job.status == "running":
            job.finish("interrupted")
            self.write(job)
        return job
