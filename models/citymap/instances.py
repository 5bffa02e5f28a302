"""The instances of a city in columns, each made on access: a city has a million."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, overload

import numpy as np

from models.citymap.types import Floats, Instance
from models.strings import Categorical

NO_POINTS: Final = np.zeros((0, 3), np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class InstanceTable(Sequence[Instance]):
    """The I instances of a map of lines and areas."""

    labels: Categorical
    names: Categorical
    sources: Categorical
    shapes: Categorical
    rgb: Floats  # [I, 3] float32, NaN where unknown

    def __len__(self) -> int:
        return len(self.labels)

    @overload
    def __getitem__(self, n: int) -> Instance: ...

    @overload
    def __getitem__(self, n: slice) -> tuple[Instance, ...]: ...

    def __getitem__(self, n: int | slice) -> Instance | tuple[Instance, ...]:
        """Return one instance, or those of a slice."""
        if isinstance(n, slice):
            return tuple(self[row] for row in range(*n.indices(len(self))))
        row = range(len(self))[n]
        rgb = None if np.isnan(self.rgb[row, 0]) else self.rgb[row]
        return Instance(row, self.labels[row], NO_POINTS, rgb, self.names[row], self.sources[row], self.shapes[row])
