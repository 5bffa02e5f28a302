"""Typed clients of the service: `Client` is synchronous and `AsyncClient` asynchronous. They need no model or torch.

    from hereabouts import Client

    with Client("http://127.0.0.1:8000") as client:
        answer = client.localize("I'm on Bulevardi, a church on my left")
        print(answer.status, answer.estimate and answer.estimate.wgs84)

Requests that fail with 429 (too many requests) or 503 (starting or stopping) are retried after the delay that the
service asks for. Failed connections are retried too.
"""

import asyncio
import time
from collections.abc import Mapping, Sequence
from itertools import count
from typing import Any, Final, Self, TypedDict, TypeVar, Unpack

import httpx
from pydantic import BaseModel

from app.http.schemas.responses import DescribeResponse, InfoResponse, LocalizeResponse
from index.answering.query import Crs, Refine

URL: Final = "http://127.0.0.1:8000"
MAX_TRIES: Final = 4
RETRIED_STATUSES: Final = frozenset({429, 503})
DEFAULT_PAUSE_S, MAX_PAUSE_S = 1.0, 30.0  # before a retry; the service's Retry-After is capped

_Answer = TypeVar("_Answer", bound=BaseModel)
_Call = tuple[str, str, dict[str, Any] | None]


class ServiceError(Exception):
    """The service refused a request or could not be reached; `status` is then 0 and `code` "no_answer".

    `errors` lists the invalid fields, each with field and message.
    """

    def __init__(
        self, status: int, code: str, detail: str, errors: Sequence[Mapping[str, str]] = (), request_id: str = ""
    ) -> None:
        super().__init__(f"{code}: {detail}")
        self.status, self.code, self.detail = status, code, detail
        self.errors, self.request_id = list(errors), request_id


class Options(TypedDict, total=False):
    """The options of `localize`: fields of POST /localize with the same names, documented at /docs.

    `answers` are replies to questions of earlier answers: question id to choice.
    """

    top_k: int
    within: Mapping[str, Any]
    prior: Mapping[str, Any]
    crs: Crs
    refine: Refine
    heat_map: bool
    ros: bool
    answers: Mapping[str, str]
    deadline_ms: int
    index: str


class Client:
    """A synchronous client; its methods raise ServiceError if the request is refused or the service does not answer.

    `transport` is a transport of httpx, for tests.
    """

    def __init__(
        self,
        url: str = URL,
        key: str | None = None,
        tries: int = MAX_TRIES,
        timeout_s: float = 60.0,
        transport: httpx.BaseTransport | None = None,
    ) -> None:
        self._http = httpx.Client(base_url=url, headers=_headers(key), timeout=timeout_s, transport=transport)
        self._tries = tries

    def localize(self, text: str | Sequence[str], **options: Unpack[Options]) -> LocalizeResponse:
        """Localize the speaker of a description, or of a list of sentences."""
        return self._send(LocalizeResponse, _localize(text, options))

    def describe(self, position: tuple[float, float], crs: Crs = "map", index: str = "default") -> DescribeResponse:
        """Describe a position: [x, y] in metres, or [longitude, latitude] with crs wgs84."""
        return self._send(DescribeResponse, _describe(position, crs, index))

    def info(self) -> InfoResponse:
        """Return the limits and the indexes of the service."""
        return self._send(InfoResponse, _INFO)

    def close(self) -> None:
        """Close the connections."""
        self._http.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()

    def _send(self, kind: type[_Answer], call: _Call) -> _Answer:
        for n in count(1):
            outcome: httpx.Response | httpx.TransportError
            try:
                outcome = self._http.request(call[0], call[1], json=call[2])
            except httpx.TransportError as error:
                outcome = error
            pause_s = _pause_s(outcome) if n < self._tries else None
            if pause_s is None:
                break
            time.sleep(pause_s)
        return _read(kind, outcome)


class AsyncClient:
    """An asynchronous client with the arguments, methods and errors of `Client`."""

    def __init__(
        self,
        url: str = URL,
        key: str | None = None,
        tries: int = MAX_TRIES,
        timeout_s: float = 60.0,
        transport: httpx.AsyncBaseTransport | None = None,
    ) -> None:
        self._http = httpx.AsyncClient(base_url=url, headers=_headers(key), timeout=timeout_s, transport=transport)
        self._tries = tries

    async def localize(self, text: str | Sequence[str], **options: Unpack[Options]) -> LocalizeResponse:
        """Localize the speaker of a description, as `Client.localize`."""
        return await self._send(LocalizeResponse, _localize(text, options))

    async def describe(
        self, position: tuple[float, float], crs: Crs = "map", index: str = "default"
    ) -> DescribeResponse:
        """Describe a position, as `Client.describe`."""
        return await self._send(DescribeResponse, _describe(position, crs, index))

    async def info(self) -> InfoResponse:
        """Return the limits and the indexes of the service, as `Client.info`."""
        return await self._send(InfoResponse, _INFO)

    async def close(self) -> None:
        """Close the connections."""
        await self._http.aclose()

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_error: object) -> None:
        await self.close()

    async def _send(self, kind: type[_Answer], call: _Call) -> _Answer:
        for n in count(1):
            outcome: httpx.Response | httpx.TransportError
            try:
                outcome = await self._http.request(call[0], call[1], json=call[2])
            except httpx.TransportError as error:
                outcome = error
            pause_s = _pause_s(outcome) if n < self._tries else None
            if pause_s is None:
                break
            await asyncio.sleep(pause_s)
        return _read(kind, outcome)


_INFO: Final[_Call] = ("GET", "/info", None)


def _headers(key: str | None) -> dict[str, str]:
    return {"Authorization": f"Bearer {key}"} if key else {}


def _localize(text: str | Sequence[str], options: Options) -> _Call:
    fields = {"description": text} if isinstance(text, str) else {"hints": list(text)}
    answers = [{"question": question, "choice": choice} for question, choice in options.get("answers", {}).items()]
    return "POST", "/localize", {**fields, **options, "answers": answers}


def _describe(position: tuple[float, float], crs: Crs, index: str) -> _Call:
    return "POST", "/describe", {"position": list(position), "crs": crs, "index": index}


def _pause_s(outcome: httpx.Response | httpx.TransportError) -> float | None:
    """Return how long to wait before a retry; None if no retry is needed."""
    if isinstance(outcome, httpx.TransportError):
        return DEFAULT_PAUSE_S
    if outcome.status_code not in RETRIED_STATUSES:
        return None
    retry_after = outcome.headers.get("retry-after", "")
    return min(float(retry_after), MAX_PAUSE_S) if retry_after.isdecimal() else DEFAULT_PAUSE_S


def _read(kind: type[_Answer], response: httpx.Response | httpx.TransportError) -> _Answer:
    if isinstance(response, httpx.TransportError):
        detail = f"{response}; is the service running, and is this its address?"
        raise ServiceError(0, "no_answer", detail) from response
    if response.is_success:
        return kind.model_validate_json(response.content)
    try:
        problem = response.json()
        raise ServiceError(
            response.status_code, problem["code"], problem["detail"], problem.get("errors", ()), problem["request_id"]
        )
    except (ValueError, KeyError, TypeError):
        raise ServiceError(response.status_code, "no_answer", "this address belongs to another service") from None
