"""The interface of a localizer, as the service uses it."""

from collections.abc import Sequence
from typing import Protocol

from index.answering.answers import Answer, CellDetail, CellSummary, Described, IndexFacts
from index.answering.query import Query
from models.citymap.frame import Frame
from models.citymap.scenery.files import SceneryPart


class LocalizerLike(Protocol):
    """A localizer of one map: `index.answering.localizer.Localizer`, a worker process, or a fake in tests.

    `localize` runs on one thread. All other methods may be called from any thread.
    """

    def localize(self, queries: Sequence[Query]) -> list[Answer]:
        """Return one answer per query, in order; blocks."""

    def describe(self, position_m: tuple[float, float], language: str | None = None) -> Described | None:
        """Describe the position (x, y), its `place` in a language; None off the map and where nothing is near."""

    def position_of(self, source_id: str) -> tuple[float, float] | None:
        """Return the position (x, y) of an object; None if the map has no such object."""

    def cell(self, cell_id: str) -> CellDetail | None:
        """Return a cell of the map; None if there is no such cell."""

    def cells(self, first: int, count: int) -> list[CellSummary]:
        """Return at most `count` cells from row `first`, in the map's order."""

    def scenery(self, number: int) -> SceneryPart | None:
        """Return a part of the map's scenery; None if there is no such part."""

    def close(self) -> None:
        """Release all resources; the localizer cannot be used afterwards."""

    @property
    def frame(self) -> Frame:
        """The coordinate frame of the map."""

    @property
    def facts(self) -> IndexFacts:
        """The facts in the manifest of the index."""
