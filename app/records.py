"""Answers as records: JSON files from which a description can be localized again and the answers compared."""

import base64
import hashlib
import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal
from uuid import uuid4

from jinja2 import Environment, StrictUndefined
from pydantic import AwareDatetime, BaseModel, ConfigDict, ValidationError

from app.http.errors import Problem, field_message, field_name
from app.http.routes.localize import check_positions
from app.http.schemas.requests import LocalizeRequest
from app.http.schemas.responses import LocalizeResponse
from index.answering.answers import Answer, Evidence
from models.errors import DataError
from models.files import replace_file

if TYPE_CHECKING:
    from index.answering.localizer import Localizer

NEVER_EQUAL: Final = {"request_id", "timings_ms", "ros"}  # a ROS pose has the time, and the estimate has the rest
MAX_PROBLEMS: Final = 5  # to list
MAX_SHOWN_CHARACTERS: Final = 60  # of a value that differs
TEMPLATE: Final = Path(__file__).with_name("record.html")


class Record(BaseModel):
    """A request to POST /localize and its answer."""

    model_config = ConfigDict(extra="forbid")

    record_version: Literal[1] = 1
    request: LocalizeRequest
    answer: LocalizeResponse
    created: AwareDatetime | None = None  # time of the answer

    @classmethod
    def read(cls, path: Path) -> "Record":
        """Read a file; DataError names what is wrong with it."""
        try:
            return cls.model_validate_json(path.read_bytes())
        except OSError as error:
            raise DataError(f"{path}: {error.strerror}; give a file that 'localize --record' wrote") from None
        except ValidationError as error:
            raise DataError(f"{path} is not a record: {_problems(error)}") from None

    def write(self, path: Path) -> None:
        """Write a file; the request has the fields that were given."""
        fields = {"request": self.request.model_dump(mode="json", exclude_unset=True)}
        document = self.model_dump(mode="json") | fields
        write_text(path, json.dumps(document, ensure_ascii=False, indent=1) + "\n")

    def differences(self, response: LocalizeResponse) -> list[str]:
        """Return what differs in another answer, such as "status: "ok" -> "ambiguous""; provenance comes first."""
        old, new = (answer.model_dump(mode="json", exclude=NEVER_EQUAL) for answer in (self.answer, response))
        return [*_differences(old.pop("provenance"), new.pop("provenance"), "provenance"), *_differences(old, new)]


def check_request(text: str, **fields: object) -> LocalizeRequest:
    """Return a request; DataError names an invalid field."""
    try:
        return LocalizeRequest.model_validate({"description": text, **fields})
    except ValidationError as error:
        raise DataError(f"this text cannot be recorded: {_problems(error)}") from None


def write_text(path: Path, text: str) -> None:
    """Write a file; DataError if that is not possible."""
    try:
        replace_file(path, text.encode())
    except OSError as error:
        raise DataError(f"{path} cannot be written: {error.strerror}; give a file in a directory of yours") from None


def write_answer(path: Path, request: LocalizeRequest, answer: Answer, localizer: "Localizer") -> None:
    """Write the record of an answer that was given just now."""
    response = LocalizeResponse.build(answer, localizer, uuid4().hex, {}, request.index)
    Record(request=request, answer=response, created=datetime.now(UTC)).write(path)


def replay(record: Record, localizer: "Localizer") -> LocalizeResponse:
    """Answer the request of a record again, in the language of its answer."""
    try:
        check_positions(record.request, localizer)
    except Problem as problem:
        reasons = "; ".join(f"{error.field} {error.message}" for error in problem.errors)
        raise DataError(f"the request does not fit this map: {reasons or problem.detail}") from None
    [answer] = localizer.localize([replace(record.request.to_query(), language=record.answer.language)])
    return LocalizeResponse.build(answer, localizer, "", {}, record.request.index)


def record_page(path: Path, record: Record, differences: Sequence[str], localizer: "Localizer") -> str:
    """Return a page about a record without external resources: one sheet of A4 unless the text is very long."""
    from index.answering.picture import draw_circles  # noqa: PLC0415  # heavy

    answer = record.answer
    circles = [(place.position, place.radius_m) for place in answer.places]
    if not circles and answer.estimate:
        circles = [(answer.estimate.position, answer.estimate.radius_m.p90)]
    picture = draw_circles(localizer, circles)
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    return environment.from_string(TEMPLATE.read_text(encoding="utf-8")).render(
        name=path.name,
        sha256=hashlib.sha256(path.read_bytes()).hexdigest(),
        record=record,
        answer=answer,
        chunks=_chunks(record.request.text(), answer.evidence),
        settings=record.request.model_dump(mode="json", exclude_unset=True, exclude={"description", "hints"}),
        picture=picture and base64.b64encode(picture).decode(),
        differences=differences,
        index_version=localizer.facts.version,
        replayed=datetime.now(UTC),
    )


def _chunks(text: str, evidence: Sequence[Evidence]) -> Iterator[tuple[str, int | None]]:
    """Yield the text in parts, each with the number of the mention that it is."""
    end = 0
    spans = sorted((mention.span, number) for number, mention in enumerate(evidence, 1) if mention.span)
    for (first, last), number in spans:
        if end <= first < last <= len(text):
            yield text[end:first], None
            yield text[first:last], number
            end = last
    yield text[end:], None


def _differences(old: Any, new: Any, path: str = "") -> Iterator[str]:
    if isinstance(old, dict) and isinstance(new, dict):
        for name in old | new:
            yield from _differences(old.get(name), new.get(name), f"{path}.{name}".lstrip("."))
    elif isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        for number, (one, other) in enumerate(zip(old, new, strict=True)):
            yield from _differences(one, other, f"{path}[{number}]")
    elif old != new:
        yield f"{path}: {_short(old)} -> {_short(new)}"


def _short(value: object) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= MAX_SHOWN_CHARACTERS else f"{text[:MAX_SHOWN_CHARACTERS]}…"


def _problems(error: ValidationError) -> str:
    fields = ((field_name(("", *item["loc"]), item.get("ctx", {})), field_message(item)) for item in error.errors())
    return "; ".join(f"{field}: {message}" for field, message in islice(fields, MAX_PROBLEMS))
