"""One evaluation on its way, and what clients see of it."""

import asyncio
import time
import uuid
from asyncio.subprocess import Process
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, Field

Status = Literal["queued", "running", "done", "failed", "cancelled", "interrupted"]
FINISHED = ("done", "failed", "cancelled", "interrupted")  # interrupted: the service ended; ask again


class JobProgress(BaseModel):
    """How far a job is."""

    stage: str = Field(examples=["ask"])
    done: int
    total: int = Field(description="0 if that is not known")


class JobError(BaseModel):
    """Why a job failed."""

    code: Literal["evaluation_failed", "internal_error"]
    detail: str


class JobState(BaseModel):
    """An evaluation."""

    job: str
    status: Status
    progress: JobProgress
    created: str = Field(description="UTC, ISO 8601")
    seconds: float = Field(description="that it has run")
    report: dict[str, Any] | None = Field(description="what `hereabouts evaluate` writes as report.json, once done")
    error: JobError | None


@dataclass(eq=False, slots=True)
class Job:
    """An evaluation on its way; changed on the event loop only.

    Attributes:
        directory: holds what the worker reads and writes; removed with the job.
        changed: set, and replaced, at every change.
        stops: how it is to end, if it was told to, be the worker still alive or not.
    """

    directory: Path
    id: str = field(default_factory=lambda: uuid.uuid4().hex)
    created: datetime = field(default_factory=lambda: datetime.now(UTC))
    status: Status = "queued"
    progress: JobProgress = field(default_factory=lambda: JobProgress(stage="queued", done=0, total=0))
    report: dict[str, Any] | None = None
    error: JobError | None = None
    stops: Literal["cancelled", "interrupted"] | None = None
    process: Process | None = None
    changed: asyncio.Event = field(default_factory=asyncio.Event)
    _started_s: float | None = None
    _ended_s: float | None = None
    _ran_s: float = 0.0  # in an earlier life of the service

    @classmethod
    def of(cls, directory: Path, state: JobState) -> "Job":
        """A job as it was kept."""
        return cls(
            directory,
            state.job,
            datetime.fromisoformat(state.created),
            state.status,
            state.progress,
            state.report,
            state.error,
            _ran_s=state.seconds,
        )

    @property
    def is_finished(self) -> bool:
        """Whether nothing more will happen."""
        return self.status in FINISHED

    def state(self) -> JobState:
        """What clients see of it."""
        started_s, ended_s = self._started_s, self._ended_s or time.monotonic()
        return JobState(
            job=self.id,
            status=self.status,
            progress=self.progress,
            created=self.created.isoformat(timespec="milliseconds"),
            seconds=self._ran_s if started_s is None else round(ended_s - started_s, 2),
            report=self.report,
            error=self.error,
        )

    async def follow(self) -> AsyncIterator[JobState]:
        """The state now and after every change, until it is finished; a slow reader misses states, never the last."""
        while True:
            changed = self.changed  # taken before the state is read, so that no change goes by between the two
            state = self.state()
            yield state
            if state.status in FINISHED:
                return
            await changed.wait()

    def begin(self) -> None:
        """Note that the work begins."""
        self._started_s = time.monotonic()
        self.status = "running"
        self.notify()

    def finish(self, status: Status, report: dict[str, Any] | None = None, error: JobError | None = None) -> None:
        """Note how it ended."""
        self._ended_s = time.monotonic()
        self.status, self.report, self.error = status, report, error
        self.notify()

    def notify(self) -> None:
        """Wake whoever follows."""
        self.changed.set()
        self.changed = asyncio.Event()
