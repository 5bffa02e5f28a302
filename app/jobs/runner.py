"""Evaluations that run beside the service: one at a time, each in a process of its own, the others wait."""

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
from app.jobs.job import Job, JobError, JobProgress, Status
from app.jobs.order import Evaluation
from app.jobs.store import JobStore
from app.jobs.worker import REPORT
from app.limits import MAX_WAITING_JOBS

WORKER = (sys.executable, "-m", "app.jobs.worker")
ROOT = Path(__file__).parents[2]  # where the worker finds this very code
KEPT = 32  # finished jobs
EXIT_S = 5.0
ERRORS = "stderr.txt"
SHOWN_BYTES = 4000  # of a crashed worker's last words, in the log

log = structlog.get_logger()


class EvaluationJobs:
    """Runs evaluations in the order in which they came.

    Args:
        directory: keeps jobs beyond the end of the service: those that wait are begun at the next start, the one that
            runs is interrupted, reports stay. None: nothing is kept.
        command: of the worker, which is given the job's directory.
        max_waiting: jobs that wait; one more is refused.
    """

    def __init__(
        self, directory: Path | None = None, command: Sequence[str] = WORKER, max_waiting: int = MAX_WAITING_JOBS
    ) -> None:
        self._max_waiting = max_waiting
        self._command = command
        self._jobs: dict[str, Job] = {}
        self._ready: asyncio.Queue[Job] = asyncio.Queue()
        self._runner: asyncio.Task[None] | None = None
        self._store = JobStore(directory)

    def start(self) -> None:
        """Begin to take jobs, those that were kept first; called on the event loop that the jobs belong to."""
        self._jobs, self._ready = {job.id: job for job in self._store.open()}, asyncio.Queue()
        for job in self._jobs.values():
            if job.status == "queued":
                self._ready.put_nowait(job)
        self._runner = asyncio.create_task(self._run())

    async def close(self) -> None:
        """End all jobs, wait until no worker is left; what is not kept is removed."""
        runner, self._runner = self._runner, None
        if runner is None:
            return
        status: Literal["cancelled", "interrupted"] = "interrupted" if self._store.is_kept else "cancelled"
        await asyncio.gather(*(self._stop(job, status) for job in list(self._jobs.values())))
        runner.cancel()
        await asyncio.gather(runner, return_exceptions=True)
        self._store.close()

    async def submit(self, evaluation: Evaluation) -> Job:
        """Queue an evaluation.

        Raises:
            Problem: shutting down, too many wait, or it cannot be kept.
        """
        if self._runner is None:
            raise Problem(Code.DRAINING)
        if sum(job.status == "queued" for job in self._jobs.values()) >= self._max_waiting:
            raise Problem(Code.JOBS_FULL)
        job_id = uuid.uuid4().hex
        job = Job(self._store.directory_of(job_id), job_id)
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
        if not job.stops:
            self._ready.put_nowait(job)
        return job

    def get(self, job_id: str) -> Job:
        """A job.

        Raises:
            Problem: there is none, or it was removed.
        """
        try:
            return self._jobs[job_id]
        except KeyError:
            raise Problem(Code.JOB_NOT_FOUND) from None

    async def delete(self, job_id: str) -> Job:
        """Cancel a job, returning when its worker is gone; forget it if it is finished.

        Raises:
            Problem: there is none.
        """
        job = self.get(job_id)
        if job.is_finished:
            self._forget(job)
        else:
            await self._stop(job, "cancelled")
        return job

    async def _stop(self, job: Job, status: Literal["cancelled", "interrupted"]) -> None:
        if job.is_finished:
            return
        job.stops = status
        if job.status == "queued":
            if status == "interrupted":
                job.finish(status)  # for who follows it; it is kept as one that waits
            else:
                self._finish(job, status)
            return
        _kill(job.process)
        async for _state in job.follow():
            pass

    async def _run(self) -> None:
        while True:
            job = await self._ready.get()
            if job.stops:
                continue
            job.begin()
            self._store.write(job)
            try:
                await self._work(job)
            except Exception:
                log.exception("evaluation failed", job=job.id)
                self._finish(job, "failed", error=_fault())

    async def _work(self, job: Job) -> None:
        """Run a job's worker to its end."""
        with (job.directory / ERRORS).open("wb") as errors:
            job.process = process = await asyncio.create_subprocess_exec(
                *self._command,
                str(job.directory),
                stdin=PIPE,  # its end is how the worker knows that this process is gone
                stdout=PIPE,
                stderr=errors,
                cwd=ROOT,
                start_new_session=True,
            )
        if job.stops:  # while it started
            _kill(process)
        failure = await self._follow(job, process)
        if job.stops:
            self._finish(job, job.stops)
        elif failure is not None:
            self._finish(job, "failed", error=JobError(code="evaluation_failed", detail=failure))
        elif process.returncode == 0:
            report = await asyncio.to_thread((job.directory / REPORT / "report.json").read_text)
            self._finish(job, "done", report=json.loads(report))
        else:
            said = (job.directory / ERRORS).read_bytes()[-SHOWN_BYTES:].decode(errors="replace")
            log.error("evaluation crashed", job=job.id, exit_status=process.returncode, stderr=said)
            self._finish(job, "failed", error=_fault())

    async def _follow(self, job: Job, process: Process) -> str | None:
        """Take up a worker's lines until it is gone.

        Returns:
            What it says is wrong with the input, if anything.
        """
        failure = None
        assert process.stdout is not None
        try:
            async for line in process.stdout:
                said = json.loads(line)
                if "error" in said:
                    failure = str(said["error"])
                else:
                    job.progress = JobProgress.model_validate(said)
                    job.notify()
        finally:
            with suppress(TimeoutError):  # the pipe closes as it exits, unless it says what is no JSON
                await asyncio.wait_for(process.wait(), EXIT_S)
            _kill(process)  # what it has forked outlives it if it crashed
            await process.communicate()
        return failure

    def _finish(
        self, job: Job, status: Status, report: dict[str, Any] | None = None, error: JobError | None = None
    ) -> None:
        job.finish(status, report, error)
        self._store.write(job)
        log.info("evaluation", job=job.id, status=status, seconds=job.state().seconds)
        finished = [job for job in self._jobs.values() if job.is_finished]
        for old in finished[:-KEPT]:
            self._forget(old)

    def _forget(self, job: Job) -> None:
        """Remove a job; what cannot be removed of it is there again after a restart."""
        self._jobs.pop(job.id, None)
        try:
            self._store.remove(job)
        except OSError as error:
            log.error("job not removed", job=job.id, reason=error.strerror)


def _kill(process: Process | None) -> None:
    """Kill a worker and all that it has forked; it holds nothing that is worth a farewell."""
    if process is not None:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


def _fault() -> JobError:
    return JobError(code="internal_error", detail="a fault in the service; the operator finds it in the log")
