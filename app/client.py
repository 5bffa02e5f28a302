"""A client of the service, typed, in two kinds: `Client` waits, `AsyncClient` is awaited. No model, no torch.

    from app.client import Client
    with Client("http://127.0.0.1:8000") as here:
        found = here.localize("I'm on Bulevardi, a church on my left")
        print(found.status, found.estimate and found.estimate.wgs84)

What is refused because too many ask (429), or because the service starts or ends (503), is asked again after the time
that the service names, as is what no connection could be made for.
"""

import asyncio
import time
from collections.abc import Mapping, Sequence
from itertools import count
from types import TracebackType
from typing import Any, Final, Self, TypedDict, TypeVar, Unpack

import httpx
from pydantic import BaseModel

from app.http.schemas.responses import DescribeResponse, InfoResponse, LocalizeResponse
from index.answering.query import Crs, Refine

URL: Final = "http://127.0.0.1:8000"
TRIES: Final = 4
AGAIN: Final = frozenset({429, 503})
PAUSE_S, LONGEST_PAUSE_S = 1.0, 30.0  # before it is asked again

_Answer = TypeVar("_Answer", bound=BaseModel)
_Asked = tuple[str, str, dict[str, Any] | None]


class ServiceError(Exception):
    """What the service refused, or that it could not be reached.

    Attributes:
        status: of HTTP; 0 if there was no answer.
        code: stable, see /docs; "no_answer" if there was none.
        detail: what is wrong, and what to do.
        errors: the fields that are wrong: field, message.
        request_id: of the request, for the service's operator.
    """

    def __init__(
        self, status: int, code: str, detail: str, errors: Sequence[Mapping[str, str]] = (), request_id: str = ""
    ) -> None:
        super().__init__(f"{code}: {detail}")
        self.status, self.code, self.detail = status, code, detail
        self.errors, self.request_id = list(errors), request_id


class Options(TypedDict, total=False):
    """What `localize` takes besides the text: fields of POST /localize of the same names, see /docs.

    Attributes:
        answers: to questions of earlier answers: their ids, and what was chosen or said.
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
    """Asks the service.

    Args:
        url: of the service.
        key: its read key, if it needs one.
        tries: how often something is asked at most.
        timeout_s: for one answer.
        transport: see httpx; for tests.
    """

    def __init__(
        self,
        url: str = URL,
        key: str | None = None,
        tries: int = TRIES,
        timeout_s: float = 60.0,
        transport: httpx.BaseTransport | None = None,
    ) -> None:
        self._http = httpx.Client(base_url=url, headers=_headers(key), timeout=timeout_s, transport=transport)
        self._tries = tries

    def localize(self, text: str | Sequence[str], **options: Unpack[Options]) -> LocalizeResponse:
        """Where the speaker of a description (or of hints, a sentence each) is.

        Raises:
            ServiceError: it was refused, or nobody answered.
        """
        return self._ask(LocalizeResponse, _localize(text, options))

    def describe(self, position: tuple[float, float], crs: Crs = "map", index: str = "default") -> DescribeResponse:
        """What the map says at [x, y], metres, or [longitude, latitude] with crs wgs84.

        Raises:
            ServiceError: it was refused, or nobody answered.
        """
        return self._ask(DescribeResponse, _describe(position, crs, index))

    def info(self) -> InfoResponse:
        """The service, its limits, and what it serves.

        Raises:
            ServiceError: nobody answered.
        """
        return self._ask(InfoResponse, _INFO)

    def close(self) -> None:
        """Close the connections."""
        self._http.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _ask(self, kind: type[_Answer], asked: _Asked) -> _Answer:
        for n in count(1):
            outcome: httpx.Response | httpx.TransportError
            try:
                outcome = self._http.request(asked[0], asked[1], json=asked[2])
            except httpx.TransportError as error:
                outcome = error
            pause_s = _pause_s(outcome) if n < self._tries else None
            if pause_s is None:
                break
            time.sleep(pause_s)
        return _read(kind, outcome)


class AsyncClient:
    """`Client`, awaited; the same arguments, methods and errors."""

    def __init__(
        self,
        url: str = URL,
        key: str | None = None,
        tries: int = TRIES,
        timeout_s: float = 60.0,
        transport: httpx.AsyncBaseTransport | None = None,
    ) -> None:
        self._http = httpx.AsyncClient(base_url=url, headers=_headers(key), timeout=timeout_s, transport=transport)
        self._tries = tries

    async def localize(self, text: str | Sequence[str], **options: Unpack[Options]) -> LocalizeResponse:
        """See `Client.localize`."""
        return await self._ask(LocalizeResponse, _localize(text, options))

    async def describe(
        self, position: tuple[float, float], crs: Crs = "map", index: str = "default"
    ) -> DescribeResponse:
        """See `Client.describe`."""
        return await self._ask(DescribeResponse, _describe(position, crs, index))

    async def info(self) -> InfoResponse:
        """See `Client.info`."""
        return await self._ask(InfoResponse, _INFO)

    async def close(self) -> None:
        """Close the connections."""
        await self._http.aclose()

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.close()

    async def _ask(self, kind: type[_Answer], asked: _Asked) -> _Answer:
        for n in count(1):
            outcome: httpx.Response | httpx.TransportError
            try:
                outcome = await self._http.request(asked[0], asked[1], json=asked[2])
            except httpx.TransportError as error:
                outcome = error
            pause_s = _pause_s(outcome) if n < self._tries else None
            if pause_s is None:
                break
            await asyncio.sleep(pause_s)
        return _read(kind, outcome)


_INFO: Final[_Asked] = ("GET", "/info", None)


def _headers(key: str | None) -> dict[str, str]:
    return {"Authorization": f"Bearer {key}"} if key else {}


def _localize(text: str | Sequence[str], options: Options) -> _Asked:
    said = {"description": text} if isinstance(text, str) else {"hints": list(text)}
    answers = [{"question": asked, "choice": choice} for asked, choice in options.get("answers", {}).items()]
    return "POST", "/localize", {**said, **options, "answers": answers}


def _describe(position: tuple[float, float], crs: Crs, index: str) -> _Asked:
    return "POST", "/describe", {"position": list(position), "crs": crs, "index": index}


def _pause_s(outcome: httpx.Response | httpx.TransportError) -> float | None:
    """How long to wait before it is asked again; None if the answer will do."""
    if isinstance(outcome, httpx.TransportError):
        return PAUSE_S
    if outcome.status_code not in AGAIN:
        return None
    said = outcome.headers.get("retry-after", "")
    return min(float(said), LONGEST_PAUSE_S) if said.isdecimal() else PAUSE_S


def _read(kind: type[_Answer], response: httpx.Response | httpx.TransportError) -> _Answer:
    if isinstance(response, httpx.TransportError):
        detail = f"{response}; is the service running, and is this its address?"
        raise ServiceError(0, "no_answer", detail) from response
    if response.is_success:
        return kind.model_validate_json(response.content)
    try:
        said = response.json()
        raise ServiceError(
            response.status_code, said["code"], said["detail"], said.get("errors", ()), said["request_id"]
        )
    except (ValueError, KeyError, TypeError):
        raise ServiceError(response.status_code, "no_answer", "something else answers at this address") from None
