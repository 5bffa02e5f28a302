"""What the service needs of a localizer; index.localizer.Localizer is one, tests bring their own."""

from collections.abc import Sequence
from typing import Protocol

from index.answers import Answer, CellDetail, Query
from models.city.frame import Frame


class LocalizerLike(Protocol):
    """Answers queries about one map with one model."""

    def localize(self, queries: Sequence[Query]) -> list[Answer]:
        """One answer a query, in order; blocks, and runs on the inference thread only."""
        ...

    def cell(self, cell_id: str) -> CellDetail | None:
        """A cell of the map; None if there is none of that name. Called from any thread."""
        ...

    @property
    def frame(self) -> Frame:
        """What the map's metres mean on Earth."""
        ...

    @property
    def map_name(self) -> str:
        """The map."""
        ...

    @property
    def attribution(self) -> str:
        """What the map data's licence asks to show."""
        ...

    @property
    def index_version(self) -> str:
        """The index directory that is served."""
        ...

    @property
    def model(self) -> str:
        """Name of the model."""
        ...

    @property
    def model_sha256(self) -> str:
        """Fingerprint of its weights."""
        ...

    @property
    def num_cells(self) -> int:
        """Cells in the index."""
        ...

    @property
    def num_instances(self) -> int:
        """Instances of the map."""
        ...

    @property
    def dim(self) -> int:
        """Width of the vectors."""
        ...

    @property
    def created(self) -> str:
        """When the index was built, ISO 8601."""
        ...
