"""Estimate what indexing a map takes, from its summary."""

from dataclasses import dataclass
from typing import Final

from models.citymap.summary import MapSummary

# Fitted by least squares of relative errors to the indexes of nine windows of 1 to 11 km2 and Andorra (468 km2).
# Time is right within a quarter there; size within a third, but Andorra's is 1.7 times the estimate.
BASE_S: Final = 4.7
S_PER_KM: Final = 0.066
S_PER_NAME: Final = 0.0082
BYTES_PER_KM: Final = 18_700.0
BYTES_PER_NAME: Final = 10_000.0


@dataclass(frozen=True, slots=True)
class IndexCost:
    """The cost of an index."""

    cpu_s: float  # of all processes together
    bytes: float


def estimate_cost(summary: MapSummary) -> IndexCost:
    """Estimate the cost of indexing a map, which grows with the length of its paths and the number of its names."""
    names = summary.streets + summary.named_objects
    return IndexCost(
        cpu_s=BASE_S + S_PER_KM * summary.walkable_km + S_PER_NAME * names,
        bytes=BYTES_PER_KM * summary.walkable_km + BYTES_PER_NAME * names,
    )
