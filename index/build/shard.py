"""The shards of a map's cells, which several machines can index in parallel."""

import re
from dataclasses import dataclass
from typing import Final

SHARD_PATTERN: Final = re.compile(r"([1-9]\d{0,4})/([1-9]\d{0,4})", re.ASCII)
MAX_SHARDS: Final = 99_999


@dataclass(frozen=True, slots=True)
class Shard:
    """A shard of a map's cells, numbered from 1."""

    number: int
    count: int

    @classmethod
    def parse(cls, text: str) -> "Shard":
        """Parse "2/8", or raise ValueError."""
        match = SHARD_PATTERN.fullmatch(text)
        if not match or int(match[1]) > int(match[2]):
            raise ValueError(f"'{text[:40]}' is not a shard; expected I/N with I from 1 to N, such as 1/8")
        return cls(int(match[1]), int(match[2]))

    @classmethod
    def all(cls, count: int) -> list["Shard"]:
        """Return all shards of a count."""
        return [cls(number, count) for number in range(1, count + 1)]

    @property
    def name(self) -> str:
        """Return the name of the shard's directory."""
        return f"{self.number}-of-{self.count}"

    def rows(self, cells: int, block: int) -> range:
        """Return the rows of the shard's cells: whole blocks, or none if there are more shards than blocks."""
        blocks = -(-cells // block)
        ends = (blocks * n // self.count * block for n in (self.number - 1, self.number))
        return range(*(min(end, cells) for end in ends))

    def __str__(self) -> str:
        return f"{self.number}/{self.count}"
