"""Estimate what indexing a map takes."""

from dataclasses import dataclass
from typing import Final

from models.citymap.summary import MapSummary

# Fitted to TODO
BASE_S: Final = 5.0
BASE_BYTES: Final = 1e6
S_PER_KM: Final = 0.1
S_PER_OBJECT: Final = 0.001
BYTES_PER_KM: Final = 1e5
BYTES_PER_OBJECT: Final = 500.0


@dataclass(frozen=True, slots=True)
class IndexCost:
    """The cost of an index."""

    cpu_s: float  # of all processes together
    bytes: float


def estimate_cost(summary: MapSummary) -> IndexCost:
    """Estimate the cost of indexing a map."""
    return IndexCost(
        cpu_s=BASE_S + S_PER_KM * summary.walkable_km + S_PER_OBJECT * summary.objects,
        bytes=BASE_BYTES + BYTES_PER_KM * summary.walkable_km + BYTES_PER_OBJECT * summary.objects,
    )
