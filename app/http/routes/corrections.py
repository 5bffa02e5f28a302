"""POST /corrections: an operator's corrections of answers, appended to a file for `hereabouts evaluate`."""

import asyncio
from datetime import UTC, datetime
from typing import Any

import structlog
from fastapi import APIRouter
from pydantic import BaseModel, Field

from app.http.bodies import REFUSALS
from app.http.dependencies import AllIndexes, SettingsNow
from app.http.errors import Code, Problem
from app.http.openapi import problems
from app.http.queue import QUERY_ERRORS
from app.http.routes.localize import check_positions, is_on_map
from app.http.schemas.requests import CorrectionRequest
from models.files import append_line

ERRORS = (*REFUSALS, *QUERY_ERRORS, Code.KEY_NOT_SET, Code.CORRECTIONS_OFF, Code.NOT_WRITABLE)
OFF_THE_MAP = "is off the map; send the position on the map where the speaker is"

log = structlog.get_logger()
router = APIRouter(tags=["localize"])


class Correction(BaseModel):
    """A line of the file of corrections, which `models.sources.place_texts` reads."""

    text: str
    goal: tuple[float, float] = Field(description="the true position, [latitude, longitude]")
    start: tuple[float, float] | None = Field(description="the listener, [latitude, longitude]")
    place_rank: int | None
    map: str
    index_version: str
    time: datetime
    request: dict[str, Any] = Field(description="the request as it was sent")


@router.post("/corrections", status_code=201, responses=problems(*ERRORS))
async def correct(body: CorrectionRequest, indexes: AllIndexes, settings: SettingsNow) -> Correction:
    """Store the true position of a description, which `hereabouts evaluate --data` reads later."""
    request = body.request
    async with indexes.lease(request.index) as queue:
        queue.check_accepting()
        localizer = queue.localizer
        frame, facts = localizer.frame, localizer.facts
        if settings.corrections_file is None or not frame.is_georeferenced:
            raise Problem(Code.CORRECTIONS_OFF)
        check_positions(request, localizer)
        check_positions(body, localizer)
        lat, lon = map(float, frame.to_wgs84(frame.position_m(body.position, body.crs)))
        if not is_on_map(localizer, lat, lon):
            raise Problem.for_field("position", OFF_THE_MAP)
        listener = request.listener and frame.to_wgs84(frame.position_m(request.listener, request.crs))
    correction = Correction(
        text=request.text(),
        goal=(round(lat, 7), round(lon, 7)),
        start=listener and (float(listener[0]), float(listener[1])),
        place_rank=body.place_rank,
        map=facts.map_name,
        index_version=facts.version,
        time=datetime.now(UTC),
        request=request.model_dump(mode="json", exclude_unset=True),
    )
    try:
        await asyncio.to_thread(append_line, settings.corrections_file, correction.model_dump_json().encode())
    except OSError as error:
        log.error("correction not written", reason=error.strerror)
        raise Problem(Code.NOT_WRITABLE) from None
    return correction
