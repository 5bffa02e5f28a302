"""One of the shards into which the cells of a map are shared out, so that several machines make an index."""

import re
from dataclasses import dataclass
from typing import Final

FORM: Final = re.compile(r"([1-9]\d{0,4})/([1-9]\d{0,4})", re.ASCII)
MOST_SHARDS: Final = 99_999


@dataclass(frozen=True, slots=True)
class Shard:
    """A shard of a map's cells.

    Attributes:
        number: which, from 1.
        count: of how many.
    """

    number: int
    count: int

    @classmethod
    def parse(cls, text: str) -> "Shard":
        """A shard from "2/8".

        Raises:
            ValueError: there is no such shard.
        """
        found = FORM.fullmatch(text)
        if not found or int(found[1]) > int(found[2]):
            raise ValueError(f"'{text[:40]}' is no shard: give which, from 1, and of how many, as 1/8 or 8/8")
        return cls(int(found[1]), int(found[2]))

    @classmethod
    def all(cls, count: int) -> list["Shard"]:
        """All of so many."""
        return [cls(number, count) for number in range(1, count + 1)]

    @property
    def name(self) -> str:
        """As a directory is called."""
        return f"{self.number}-of-{self.count}"

    def rows(self, cells: int, block: int) -> range:
        """Its cells, some whole blocks of so many cells; none where there are more shards than blocks.

        Args:
            cells: of the map.
            block: cells of a block; the last may have fewer.
        """
        blocks = -(-cells // block)
        ends = (blocks * n // self.count * block for n in (self.number - 1, self.number))
        return range(*(min(end, cells) for end in ends))

    def __str__(self) -> str:
        return f"{self.number}/{self.count}"
