"""The public interface of Hereabouts; `app`, `index` and `models` are internal and may change.

`Client` and `AsyncClient` call a running service and do not import torch. `Localizer` opens an index in this process
and answers each `Query`; torch is imported on first use.
"""

from typing import TYPE_CHECKING, Any

from app.client import AsyncClient, Client, ServiceError
from index.answering.query import Box, Circle, Prior, Query, Reply

if TYPE_CHECKING:
    from index.answering.localizer import Localizer

__all__ = ["AsyncClient", "Box", "Circle", "Client", "Localizer", "Prior", "Query", "Reply", "ServiceError"]


def __getattr__(name: str) -> Any:
    """Import `Localizer`, and with it torch, on first use."""
    if name != "Localizer":
        raise AttributeError(f"module 'hereabouts' has no attribute {name!r}")
    from index.answering.localizer import Localizer  # noqa: PLC0415  # the client needs no torch

    return Localizer
