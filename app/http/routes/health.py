"""Liveness, readiness, metrics and information about the service."""

from importlib.metadata import version

from fastapi import APIRouter, Request
from starlette.responses import PlainTextResponse, Response

from app.http.dependencies import AllIndexes, SettingsNow
from app.http.errors import Problem
from app.http.keys import OPEN
from app.http.openapi import problems
from app.http.queue import UNAVAILABLE
from app.http.schemas.responses import Health, IndexInfo, InfoResponse, Limits
from app.jobs.evaluation import list_data_sets

router = APIRouter(tags=["service"])


@router.get("/healthz", openapi_extra=OPEN)
async def healthz() -> Health:
    """Report that the process runs; never waits for the model."""
    return Health(status="ok")


@router.get("/readyz", responses=problems(*UNAVAILABLE), openapi_extra=OPEN)
async def readyz(indexes: AllIndexes) -> Health:
    """Report whether a description would be answered now."""
    indexes.check_accepting()
    return Health(status="ready")


@router.get("/metrics", response_class=PlainTextResponse, openapi_extra=OPEN)
async def metrics(request: Request) -> Response:
    """Return the metrics for Prometheus."""
    return request.app.state.metrics.response()


@router.get("/info", openapi_extra=OPEN)
async def info(indexes: AllIndexes, settings: SettingsNow) -> InfoResponse:
    """Return the version and the limits of the service, and the index it serves."""
    try:
        index = IndexInfo.build(indexes.queue().localizer)
    except Problem:
        index = None
    return InfoResponse(
        service="hereabouts",
        version=version("hereabouts"),
        key_required=settings.read_key is not None,
        limits=Limits.from_settings(settings),
        index=index,
        indexes=indexes.names(),
        data_sets=[path.name for path in list_data_sets(settings.data_dir)],
        corrections=settings.corrections_file is not None and index is not None and index.crs.origin is not None,
    )
