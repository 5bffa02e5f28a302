"""The composition of the service."""

from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from functools import partial
from importlib.metadata import version
from pathlib import Path

from asgi_correlation_id import CorrelationIdMiddleware
from fastapi import FastAPI
from fastapi_offline import FastAPIOffline
from starlette.middleware.cors import CORSMiddleware

from app import limits
from app.http.bodies import StrictBody
from app.http.errors import add_error_handlers
from app.http.formats.negotiation import Gzip
from app.http.indexes import Indexes
from app.http.keys import KeyCheck, open_routes
from app.http.metrics import Metrics
from app.http.middleware import AccessLog, HeadAsGet, SafeHeaders, is_sane_request_id
from app.http.openapi import describe as describe_app
from app.http.openapi import error_table
from app.http.protocol import LocalizerLike
from app.http.proxies import ProxiedRequests
from app.http.routes import batch, cells, corrections, describe, evaluate, geocoder, health, localize, maps, page
from app.http.routes import indexes as index_routes
from app.jobs.runner import EvaluationJobs
from app.settings import Settings
from app.threads import usable_cpus
from app.workers.checksums import check_version
from app.workers.messages import LocalizerSpec
from app.workers.remote import open_workers
from index.build.artifact import read_aliases
from index.build.manifest import MANIFEST

CORS_METHODS = ("GET", "HEAD", "POST", "DELETE")
EXPOSED_HEADERS = ("X-Request-ID", "Retry-After", "Content-Language", "ETag", "Location")
GZIP_LEVEL = 5  # takes at most half the time of level 9, for answers that are 2 to 13 % larger
ABOUT = """Describe in plain words what you see around you, and Hereabouts tells you where in the city you are.

Errors are problem+json (RFC 9457); `code` is stable:

"""


def create_app(
    settings: Settings, open_localizer: Callable[[], LocalizerLike] | None = None, page_dir: Path = page.PAGE_DIR
) -> FastAPI:
    """Create the application; `open_localizer` replaces the workers that open settings.index_dir."""
    indexes = _build_indexes(settings, open_localizer)
    jobs = EvaluationJobs(settings.jobs_dir)

    @asynccontextmanager
    async def lifespan(_app: FastAPI) -> AsyncIterator[None]:
        await indexes.start()
        jobs.start()
        try:
            yield
        finally:
            await jobs.close()
            await indexes.close()

    app = _create_fastapi(lifespan)
    app.state.settings = settings
    app.state.indexes = indexes
    app.state.metrics = Metrics(indexes)
    app.state.jobs = jobs
    add_error_handlers(app)
    _add_routes(app, settings, page_dir)
    app.openapi = partial(describe_app, app, needs_key=settings.read_key is not None)  # type: ignore[method-assign]
    return app


def _build_indexes(settings: Settings, open_localizer: Callable[[], LocalizerLike] | None) -> Indexes:
    if open_localizer is not None:
        return Indexes(lambda _alias, _version: [open_localizer()], dict, settings.max_wait_ms / 1000)

    def open_in_workers(_alias: str, version: str | None) -> Sequence[LocalizerLike]:
        return open_workers(localizer_spec(settings, version), settings.workers or usable_cpus())

    read, check = partial(_read_aliases, settings.index_dir), partial(check_version, settings.index_dir)
    return Indexes(open_in_workers, read, settings.max_wait_ms / 1000, check)


def _create_fastapi(lifespan: Callable[[FastAPI], AbstractAsyncContextManager[None]]) -> FastAPI:
    return FastAPIOffline(
        title="Hereabouts",
        version=version("hereabouts"),
        description=ABOUT + error_table(),
        lifespan=lifespan,
        redoc_url=None,  # ReDoc loads a logo from another origin
        redirect_slashes=False,  # a redirect would echo the client's Host header
        swagger_ui_parameters={"validatorUrl": None},  # otherwise Swagger loads a badge from swagger.io
        # FastAPI's spans would contain query strings with descriptions, and its logs the messages of errors.
        telemetry=dict.fromkeys(("tracing", "metrics", "logs", "auto_configure"), False),
    )


def _add_routes(app: FastAPI, settings: Settings, page_dir: Path) -> None:
    """Add the routes and the middleware; the middleware that is added last runs first."""
    modules = (localize, batch, describe, corrections, evaluate, geocoder, cells, maps, index_routes, health)
    routers = (*(module.router for module in modules), page.build_router(page_dir))
    for router in routers:
        app.include_router(router)
    # FastAPI hides routes of included routers.
    app.state.routes = [route for router in routers for route in router.routes]
    larger = {evaluate.PATH: limits.MAX_EVALUATE_BODY_BYTES, batch.PATH: limits.MAX_BATCH_BODY_BYTES}
    app.add_middleware(StrictBody, max_bytes=limits.MAX_BODY_BYTES, larger=larger, tables={batch.PATH})
    app.add_middleware(Gzip, compresslevel=GZIP_LEVEL)
    app.add_middleware(HeadAsGet)
    app.add_middleware(KeyCheck, read_key=settings.read_key, open_routes=open_routes(routers))
    app.add_middleware(ProxiedRequests, root_path=settings.root_path, proxies=settings.proxies)
    app.add_middleware(AccessLog, metrics=app.state.metrics, log_descriptions=settings.log_descriptions)
    if settings.cors_origins:  # outside the key check, because browsers send preflights without the key
        app.add_middleware(
            CORSMiddleware,
            allow_origins=settings.cors_origins,
            allow_methods=CORS_METHODS,
            allow_headers=("*",),
            expose_headers=EXPOSED_HEADERS,
        )
    app.add_middleware(CorrelationIdMiddleware, validator=is_sane_request_id)
    app.add_middleware(SafeHeaders)


def localizer_spec(settings: Settings, version: str | None = None) -> LocalizerSpec:
    """Return what to open: a version in the index directory, or its default version."""
    directory = settings.index_dir / version if version else settings.index_dir
    return LocalizerSpec(directory, *settings.weights)


def _read_aliases(index_dir: Path) -> dict[str, str]:
    """Return the aliases of an index directory; none if it is itself a version."""
    return {} if (index_dir / MANIFEST).is_file() else read_aliases(index_dir).aliases
