"""An evaluation job and its state as clients see it."""

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
FINISHED = ("done", "failed", "cancelled", "interrupted")  # interrupted: the service stopped; submit it again


class JobProgress(BaseModel):
    """The progress of a job."""

    stage: str = Field(examples=["ask"])
    done: int
    total: int = Field(description="0 if unknown")


class JobError(BaseModel):
    """The reason why a job failed."""

    code: Literal["evaluation_failed", "internal_error"]
    detail: str


class JobState(BaseModel):
    """The state of an evaluation."""

    job: str
    status: Status
    progress: JobProgress
    created: str = Field(description="UTC, ISO 8601")
    seconds: float = Field(description="how long it has run")
    report: dict[str, Any] | None = Field(description="once done: the report.json of `hereabouts evaluate`")
    error: JobError | None


@dataclass(eq=False, slots=True)
class EvaluationJob:
    """An evaluation job; it is changed only on the event loop."""

    directory: Path
    id: str = field(default_factory=lambda: uuid.uuid4().hex)
    created: datetime = field(default_factory=lambda: datetime.now(UTC))
    status: Status = "queued"
    progress: JobProgress = field(default_factory=lambda: JobProgress(stage="queued", done=0, total=0))
    report: dict[str, Any] | None = None
    error: JobError | None = None
    requested_end: Literal["cancelled", "interrupted"] | None = None
    process: Process | None = None
    changed: asyncio.Event = field(default_factory=asyncio.Event)
    _started_s: float | None = None
    _ended_s: float | None = None
    _earlier_run_s: float = 0.0  # before the service restarted

    @classmethod
    def from_state(cls, directory: Path, state: JobState) -> "EvaluationJob":
        """Restore a job from its stored state."""
        return cls(
            directory,
            state.job,
            datetime.fromisoformat(state.created),
            state.status,
            state.progress,
            state.report,
            state.error,
            _earlier_run_s=state.seconds,
        )

    @property
    def is_finished(self) -> bool:
        """Whether the job has reached a final status."""
        return self.status in FINISHED

    def state(self) -> JobState:
        """Return the state that clients see."""
        started_s, ended_s = self._started_s, self._ended_s or time.monotonic()
        return JobState(
            job=self.id,
            status=self.status,
            progress=self.progress,
            created=self.created.isoformat(timespec="milliseconds"),
            seconds=self._earlier_run_s if started_s is None else round(ended_s - started_s, 2),
            report=self.report,
            error=self.error,
        )

    async def follow(self) -> AsyncIterator[JobState]:
        """Yield the current state and the state after each change; a slow reader may miss states but not the last."""
        while True:
            changed = self.changed  # taken before the state is read, so that no change in between is missed
            state = self.state()
            yield state
            if state.status in FINISHED:
                return
            await changed.wait()

    def begin(self) -> None:
        """Mark the job as running."""
        self._started_s = time.monotonic()
        self.status = "running"
        self.notify()

    def finish(self, status: Status, report: dict[str, Any] | None = None, error: JobError | None = None) -> None:
        """Record the final status of the job."""
        self._ended_s = time.monotonic()
        self.status, self.report, self.error = status, report, error
        self.notify()

    def notify(self) -> None:
        """Wake all followers."""
        self.changed.set()
        self.changed = asyncio.Event()
