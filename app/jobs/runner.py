"""The queue of evaluation jobs: they run one at a time, each in its own process."""

import asyncio
import json
import os
import signal
import sys
import uuid
from asyncio.subprocess import PIPE, Process
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Literal

import structlog

from app.http.errors import Code, Problem
from app.jobs.evaluation import Evaluation
from app.jobs.job import EvaluationJob, JobError, JobProgress, Status
from app.jobs.store import JobStore
from app.jobs.worker import REPORT_DIR
from app.limits import MAX_WAITING_JOBS

WORKER = (sys.executable, "-m", "app.jobs.worker")
ROOT = Path(__file__).parents[2]  # the worker imports the same code
MAX_FINISHED_JOBS = 32  # older ones are deleted
EXIT_TIMEOUT_S = 5.0  # for a worker to exit after it closed its output
STDERR_FILE = "stderr.txt"
MAX_LOGGED_STDERR_BYTES = 4000  # the end of a crashed worker's stderr
INTERNAL_ERROR = JobError(code="internal_error", detail="an internal error, which is in the service's log")

log = structlog.get_logger()


class EvaluationJobs:
    """Runs evaluations in the order of their submission; the job's directory is appended to the worker's `command`.

    `directory` keeps jobs over restarts: waiting jobs start again, a running job becomes interrupted, and reports stay.
    """

    def __init__(
        self, directory: Path | None = None, command: Sequence[str] = WORKER, max_waiting: int = MAX_WAITING_JOBS
    ) -> None:
        self._max_waiting = max_waiting
        self._command = command
        self._jobs: dict[str, EvaluationJob] = {}
        self._ready: asyncio.Queue[EvaluationJob] = asyncio.Queue()
        self._runner: asyncio.Task[None] | None = None
        self._store = JobStore(directory)

    def start(self) -> None:
        """Start running jobs, stored ones first; must be called on the event loop of the jobs."""
        self._jobs, self._ready = {job.id: job for job in self._store.open()}, asyncio.Queue()
        for job in self._jobs.values():
            if job.status == "queued":
                self._ready.put_nowait(job)
        self._runner = asyncio.create_task(self._run())

    async def close(self) -> None:
        """Stop all jobs and wait for the worker to exit; without a directory, remove all files."""
        runner, self._runner = self._runner, None
        if runner is None:
            return
        status: Literal["cancelled", "interrupted"] = "interrupted" if self._store.is_persistent else "cancelled"
        await asyncio.gather(*(self._stop(job, status) for job in list(self._jobs.values())))
        runner.cancel()
        await asyncio.gather(runner, return_exceptions=True)
        self._store.close()

    async def submit(self, evaluation: Evaluation) -> EvaluationJob:
        """Queue an evaluation; 503 while shutting down, 429 if too many wait, 409 if the job cannot be stored."""
        if self._runner is None:
            raise Problem(Code.DRAINING)
        if sum(job.status == "queued" for job in self._jobs.values()) >= self._max_waiting:
            raise Problem(Code.JOBS_FULL)
        job_id = uuid.uuid4().hex
        job = EvaluationJob(self._store.job_dir(job_id), job_id)
        self._jobs[job.id] = job
        try:
            await asyncio.to_thread(self._store.add, job, evaluation)
        except OSError as error:
            self._forget(job)
            log.error("job not written", job=job.id, reason=error.strerror)
            raise Problem(Code.NOT_WRITABLE) from None
        except BaseException:
            self._forget(job)
            raise
        if not job.requested_end:
            self._ready.put_nowait(job)
        return job

    def get(self, job_id: str) -> EvaluationJob:
        """Return a job; 404 if there is none."""
        try:
            return self._jobs[job_id]
        except KeyError:
            raise Problem(Code.JOB_NOT_FOUND) from None

    async def delete(self, job_id: str) -> EvaluationJob:
        """Cancel a job and wait for its worker to exit, or delete a finished job; 404 if there is none."""
        job = self.get(job_id)
        if job.is_finished:
            self._forget(job)
        else:
            await self._stop(job, "cancelled")
        return job

    async def _stop(self, job: EvaluationJob, status: Literal["cancelled", "interrupted"]) -> None:
        if job.is_finished:
            return
        job.requested_end = status
        if job.status == "queued":
            if status == "interrupted":
                job.finish(status)  # only for followers; it is stored as queued
            else:
                self._finish(job, status)
            return
        _kill(job.process)
        async for _state in job.follow():
            pass

    async def _run(self) -> None:
        while True:
            job = await self._ready.get()
            if job.requested_end:
                continue
            job.begin()
            self._store.write(job)
            try:
                await self._work(job)
            except Exception:
                log.exception("evaluation failed", job=job.id)
                self._finish(job, "failed", error=INTERNAL_ERROR)

    async def _work(self, job: EvaluationJob) -> None:
        with (job.directory / STDERR_FILE).open("wb") as errors:
            job.process = process = await asyncio.create_subprocess_exec(
                *self._command,
                str(job.directory),
                stdin=PIPE,  # the worker exits when this pipe closes
                stdout=PIPE,
                stderr=errors,
                cwd=ROOT,
                start_new_session=True,
            )
        if job.requested_end:  # stopped during the start
            _kill(process)
        failure = await self._follow(job, process)
        if job.requested_end:
            self._finish(job, job.requested_end)
        elif failure is not None:
            self._finish(job, "failed", error=JobError(code="evaluation_failed", detail=failure))
        elif process.returncode == 0:
            report = await asyncio.to_thread((job.directory / REPORT_DIR / "report.json").read_text)
            self._finish(job, "done", report=json.loads(report))
        else:
            stderr_text = (job.directory / STDERR_FILE).read_bytes()[-MAX_LOGGED_STDERR_BYTES:].decode(errors="replace")
            log.error("evaluation crashed", job=job.id, exit_status=process.returncode, stderr=stderr_text)
            self._finish(job, "failed", error=INTERNAL_ERROR)

    async def _follow(self, job: EvaluationJob, process: Process) -> str | None:
        """Read the lines of a worker until it exits; return its error message about the input, if any."""
        failure = None
        assert process.stdout is not None
        try:
            async for line in process.stdout:
                message = json.loads(line)
                if "error" in message:
                    failure = str(message["error"])
                else:
                    job.progress = JobProgress.model_validate(message)
                    job.notify()
        finally:
            with suppress(TimeoutError):  # the worker is exiting, unless it wrote invalid JSON
                await asyncio.wait_for(process.wait(), EXIT_TIMEOUT_S)
            _kill(process)  # children of a crashed worker may still run
            await process.communicate()
        return failure

    def _finish(
        self, job: EvaluationJob, status: Status, report: dict[str, Any] | None = None, error: JobError | None = None
    ) -> None:
        job.finish(status, report, error)
        self._store.write(job)
        log.info("evaluation", job=job.id, status=status, seconds=job.state().seconds)
        finished = [job for job in self._jobs.values() if job.is_finished]
        for old in finished[:-MAX_FINISHED_JOBS]:
            self._forget(old)

    def _forget(self, job: EvaluationJob) -> None:
        """Delete a job; if its files cannot be removed, it is back after a restart."""
        self._jobs.pop(job.id, None)
        try:
            self._store.remove(job)
        except OSError as error:
            log.error("job not removed", job=job.id, reason=error.strerror)


def _kill(process: Process | None) -> None:
    """Kill a worker and its children; they have no state to save."""
    if process is not None:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
