"""Dependencies of routes: the settings, the indexes, the evaluation jobs, and a localizer that is ready."""

from collections.abc import AsyncIterator
from typing import Annotated, Any

from fastapi import Depends, Query, Request

from app.http.indexes import Indexes
from app.http.protocol import LocalizerLike
from app.jobs.runner import EvaluationJobs
from app.settings import Settings
from index.build.artifact import DEFAULT_ALIAS
from index.build.manifest import NAME_PATTERN

IndexName = Annotated[str, Query(pattern=NAME_PATTERN, description="an index that GET /info lists")]


def _from_state(name: str) -> Any:
    """Return the dependency on a part of the application's state."""

    async def get(request: Request) -> Any:
        return getattr(request.app.state, name)

    return Depends(get)


SettingsNow = Annotated[Settings, _from_state("settings")]
AllIndexes = Annotated[Indexes, _from_state("indexes")]
Jobs = Annotated[EvaluationJobs, _from_state("jobs")]


async def get_localizer(indexes: AllIndexes, index: IndexName = DEFAULT_ALIAS) -> AsyncIterator[LocalizerLike]:
    """Yield the localizer of an index, which stays open until the request is answered; 404 or 503 without it."""
    async with indexes.lease(index) as queue:
        yield queue.localizer


Localizer = Annotated[LocalizerLike, Depends(get_localizer)]
