"""What the service needs of a localizer; index.answering.localizer.Localizer is one, tests bring their own."""

from collections.abc import Sequence
from typing import Protocol

from index.answering.answers import Answer, CellDetail, CellSummary, Described, IndexFacts
from index.answering.query import Query
from models.citymap.frame import Frame
from models.citymap.scenery.files import SceneryPart


class LocalizerLike(Protocol):
    """Answers queries about one map."""

    def localize(self, queries: Sequence[Query]) -> list[Answer]:
        """One answer a query, in order; blocks, and runs on one thread only."""
        ...

    def describe(self, position_m: tuple[float, float]) -> Described | None:
        """What the map says at (x, y); None off the map, and where nothing is near. Called from any thread."""
        ...

    def cell(self, cell_id: str) -> CellDetail | None:
        """A cell of the map; None if there is none of that name. Called from any thread."""
        ...

    def cells(self, first: int, count: int) -> list[CellSummary]:
        """Cells in the map's order, from row `first`, at most `count`. Called from any thread."""
        ...

    def scenery(self, number: int) -> SceneryPart | None:
        """A part of what the map looks like; None if there is no such part. Called from any thread."""
        ...

    def close(self) -> None:
        """Let go of what it holds; nothing is asked any more."""
        ...

    @property
    def frame(self) -> Frame:
        """What the map's metres mean on Earth."""
        ...

    @property
    def facts(self) -> IndexFacts:
        """What the index says of itself."""
        ...
