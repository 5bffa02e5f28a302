"""Dependencies of routes: the settings, the indexes, the evaluation jobs, and a localizer that is ready."""

from collections.abc import AsyncIterator
from typing import Annotated

from fastapi import Depends, Query, Request

from app.http.indexes import Indexes
from app.http.protocol import LocalizerLike
from app.http.queue import InferenceQueue
from app.jobs.runner import EvaluationJobs
from app.settings import Settings
from index.build.artifact import DEFAULT_ALIAS
from index.build.manifest import NAME_PATTERN

IndexName = Annotated[str, Query(pattern=NAME_PATTERN, description="an index that GET /info lists")]


async def get_settings(request: Request) -> Settings:
    """Return the application's settings."""
    settings: Settings = request.app.state.settings
    return settings


async def get_indexes(request: Request) -> Indexes:
    """Return the application's indexes."""
    indexes: Indexes = request.app.state.indexes
    return indexes


async def get_queue(
    request: Request,
    index: IndexName = DEFAULT_ALIAS,
) -> AsyncIterator[InferenceQueue]:
    """Yield the queue of an index and keep it open until the request is answered; 404 without such an index."""
    async with (await get_indexes(request)).lease(index) as queue:
        yield queue


async def get_jobs(request: Request) -> EvaluationJobs:
    """Return the application's evaluation jobs."""
    jobs: EvaluationJobs = request.app.state.jobs
    return jobs


Queue = Annotated[InferenceQueue, Depends(get_queue)]


async def get_localizer(queue: Queue) -> LocalizerLike:
    """Return the localizer of an index; 503 until it is loaded."""
    return queue.localizer


SettingsNow = Annotated[Settings, Depends(get_settings)]
AllIndexes = Annotated[Indexes, Depends(get_indexes)]
Jobs = Annotated[EvaluationJobs, Depends(get_jobs)]
Localizer = Annotated[LocalizerLike, Depends(get_localizer)]
