"""Split one city into train, validation and test regions that share no cell and no described instance part."""

from dataclasses import dataclass

import numpy as np

from models.citymap.cells import CellTable
from models.citymap.hints import HINT_REACH_M
from models.citymap.types import Floats

# Shares of the extent from west to east; a cell on a boundary belongs to no region.
SPLIT_SHARES = {"train": (0.0, 0.5), "val": (0.5, 0.64), "test": (0.64, 1.0)}
SPLITS = tuple(SPLIT_SHARES)


@dataclass(frozen=True, slots=True)
class SplitRegion:
    """A strip of a map from south to north: everything with west_m <= x < east_m."""

    west_m: float
    east_m: float

    def contains(self, x_m: Floats, margin_m: float) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Whether the interval of `margin_m` around each x_m [N] lies fully in the region."""
        return (x_m - margin_m >= self.west_m) & (x_m + margin_m < self.east_m)

    def cells(self, cells: CellTable) -> CellTable:
        """Return the cells that lie fully in the region."""
        return cells.take(np.flatnonzero(self.contains(cells.center_m[:, 0], cells.size_m / 2)))

    def locations(self, locations_m: Floats) -> Floats:
        """Return the locations whose hints all lie in the region."""
        return locations_m[self.contains(locations_m[:, 0], HINT_REACH_M)]


def split_regions(cells: CellTable) -> dict[str, SplitRegion]:
    """Return a western region for training, a middle strip for validation and an eastern region for testing."""
    half = cells.size_m / 2
    west, east = float(cells.center_m[:, 0].min()) - half, float(cells.center_m[:, 0].max()) + half + 1e-6
    width = east - west
    return {split: SplitRegion(west + low * width, west + high * width) for split, (low, high) in SPLIT_SHARES.items()}
