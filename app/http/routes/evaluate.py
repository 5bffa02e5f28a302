"""Evaluations on queries with known positions: jobs that a client starts, follows and cancels."""

import asyncio
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

from fastapi import APIRouter, Request, Response
from pydantic import BaseModel
from sse_starlette import EventSourceResponse, ServerSentEvent

from app.http.bodies import REFUSALS
from app.http.dependencies import AllIndexes, Jobs, SettingsNow
from app.http.errors import Code
from app.http.openapi import problems
from app.http.queue import QUERY_ERRORS
from app.http.schemas.requests import EvaluateRequest
from app.jobs.evaluation import build_evaluation
from app.jobs.job import FINISHED, EvaluationJob, JobState, Status

PATH = "/evaluate"
PING_S = 15  # interval of keep-alive comments on an idle event stream
POST_ERRORS = (*REFUSALS, *QUERY_ERRORS, Code.KEY_NOT_SET, Code.JOBS_FULL, Code.NOT_WRITABLE)
EVENT_STREAM: dict[str, Any] = {
    "description": "Server-sent events `progress`, then one of `done`, `failed`, `cancelled` and `interrupted` (the "
    "service stopped). The data of each event is the answer of GET /evaluate/{job}. A new client gets the current "
    "state at once; disconnecting does not cancel the job.",
    "content": {"text/event-stream": {"schema": {"type": "string"}}},
}


class JobLinks(BaseModel):
    """The paths of a job's state and events."""

    status: str
    events: str


class JobAccepted(BaseModel):
    """An evaluation that was accepted and is queued."""

    job: str
    status: Status
    links: JobLinks


router = APIRouter(tags=["evaluate"])


@router.post(PATH, status_code=202, responses=problems(*POST_ERRORS))
async def evaluate(
    request: Request,
    body: EvaluateRequest,
    response: Response,
    indexes: AllIndexes,
    jobs: Jobs,
    settings: SettingsNow,
) -> JobAccepted:
    """Start an evaluation on your own queries or on a data set of the service."""
    queue = indexes.queue(body.index)
    queue.check_accepting()
    localizer = queue.localizer
    index_dir = version_dir(settings.index_dir, localizer.facts.version)
    job = await jobs.submit(await asyncio.to_thread(build_evaluation, body, settings, index_dir, localizer.frame))
    path = f"{request.scope['root_path']}{PATH}/{job.id}"
    links = JobLinks(status=path, events=f"{path}/events")
    response.headers["Location"] = links.status
    return JobAccepted(job=job.id, status="queued", links=links)


@router.get(PATH + "/{job}", responses=problems(Code.JOB_NOT_FOUND))
async def evaluation(job: str, jobs: Jobs) -> JobState:
    """Return the progress of an evaluation, and its report once it is done."""
    return jobs.get(job).state()


@router.delete(PATH + "/{job}", responses=problems(Code.KEY_NOT_SET, Code.JOB_NOT_FOUND))
async def cancel(job: str, jobs: Jobs) -> JobState:
    """Cancel an evaluation, or delete a finished one."""
    return (await jobs.delete(job)).state()


@router.get(
    PATH + "/{job}/events",
    response_class=EventSourceResponse,
    responses={200: EVENT_STREAM, **problems(Code.JOB_NOT_FOUND)},
)
async def follow(job: str, jobs: Jobs) -> EventSourceResponse:
    """Stream the states of an evaluation as server-sent events."""
    return EventSourceResponse(events(jobs.get(job)), ping=PING_S)


async def events(job: EvaluationJob) -> AsyncIterator[ServerSentEvent]:
    """Yield the states of a job as events."""
    async for state in job.follow():
        name = state.status if state.status in FINISHED else "progress"
        yield ServerSentEvent(state.model_dump_json(), event=name)


def version_dir(index_dir: Path, version: str) -> Path:
    """Return the directory of the served version, even if the alias names another one by now."""
    return index_dir / version if (index_dir / version).is_dir() else index_dir
