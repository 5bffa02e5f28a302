"""What routes are given: the settings, the queue, the evaluations, and a localizer that is ready."""

from typing import Annotated

from fastapi import Depends, Request

from app.http.protocol import LocalizerLike
from app.http.queue import InferenceQueue
from app.jobs.runner import EvaluationJobs
from app.settings import Settings


async def get_settings(request: Request) -> Settings:
    """The application's settings."""
    settings: Settings = request.app.state.settings
    return settings


async def get_queue(request: Request) -> InferenceQueue:
    """The application's queue."""
    queue: InferenceQueue = request.app.state.queue
    return queue


async def get_jobs(request: Request) -> EvaluationJobs:
    """The application's evaluations."""
    jobs: EvaluationJobs = request.app.state.jobs
    return jobs


async def get_localizer(request: Request) -> LocalizerLike:
    """The localizer.

    Raises:
        Problem: 503 until it is loaded.
    """
    return (await get_queue(request)).localizer


SettingsNow = Annotated[Settings, Depends(get_settings)]
Queue = Annotated[InferenceQueue, Depends(get_queue)]
Jobs = Annotated[EvaluationJobs, Depends(get_jobs)]
Localizer = Annotated[LocalizerLike, Depends(get_localizer)]
