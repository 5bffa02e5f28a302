"""Positions with their descriptions in columns: the queries of a data set."""

from dataclasses import dataclass

from models.citymap.points import Ints
from models.citymap.types import DIRECTIONS, Floats, Hint


@dataclass(frozen=True, slots=True, eq=False)
class PoseTable:
    """Q positions with their descriptions, in columns."""

    positions_m: Floats  # [Q, 3] float64 world metres
    cell: Ints  # [Q] best cell, row in the store's cell table
    strategies: tuple[str, ...]  # Q words: how the hints were chosen
    starts: Ints  # [Q + 1] pose q has the hints starts[q] to starts[q + 1]
    direction: Ints  # [H] index into DIRECTIONS
    label: Ints  # [H] index into `words`
    colour: Ints  # [H] index into `words`
    instance: Ints  # [H] the instance meant, row in the cell table's parts; -1 if the best cell lacks it
    words: tuple[str, ...]  # labels and colours

    def __len__(self) -> int:
        return len(self.cell)

    def hints(self, q: int) -> tuple[Hint, ...]:
        """Return the hints of pose q, in stored order."""
        return tuple(
            Hint(
                DIRECTIONS[self.direction[h]],
                self.words[self.label[h]],
                self.words[self.colour[h]],
                int(self.instance[h]) if self.instance[h] >= 0 else None,
            )
            for h in range(self.starts[q], self.starts[q + 1])
        )
