"""The expensive data of some cells of a map; an index built from one shard or from many has the same bytes."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt
import torch
from safetensors import SafetensorError
from safetensors.numpy import save_file

from index.stores.store import Floats
from models.citymap.cells import CELLS_PER_BLOCK, CellTable
from models.citymap.gallery import MapData
from models.citymap.types import Progress
from models.errors import DataError, IndexBroken
from models.files import map_arrays
from models.memory import drop_pages
from models.paper.instance_encoder import CellFeatures
from models.paper.level_table import EMPTY_LEVEL_TABLE, LevelTable, encode_gallery
from models.paper.levels import Level
from models.paper.retriever import Retriever
from models.posterior.likelihood import Likelihood
from models.posterior.neighbours.neighbour_index import NeighbourIndex
from models.posterior.neighbours.piece_index import PieceNeighbourIndex
from models.posterior.neighbours.scan_index import FILE as SURROUNDINGS_FILE
from models.posterior.neighbours.scan_index import ScanNeighbourIndex
from models.posterior.statements import StatementRows, statement_rows
from models.processes import map_forked
from models.sources.source import MapSource, Source
from models.spool import spooled

FILE: Final = "part.safetensors"
COLUMNS: Final = ("starts", "statement", "holds", "vectors")
CELLS_PER_SPAN: Final = 32 * CELLS_PER_BLOCK  # bounds the memory of the features


@dataclass(frozen=True, slots=True, eq=False)
class ShardData:
    """The data of C consecutive cells of a map."""

    vectors: Floats  # [C, D] float32, the global level
    levels: LevelTable  # the other levels, possibly empty
    rows: StatementRows  # the result of `statement_rows`
    # The neighbour index of a scan; None for a map of pieces, which computes neighbours on demand.
    scanned: ScanNeighbourIndex | None

    @classmethod
    def build(
        cls,
        retriever: Retriever,
        likelihood: Likelihood,
        source: Source,
        surroundings: NeighbourIndex,
        rows: range,
        report: Progress,
    ) -> "ShardData":
        """Compute the data of some cells, and free the map data that later steps do not need."""
        if isinstance(source, MapSource):
            source.drop_geometry()
        vectors, levels = _encode_cells(retriever, source.data, rows, report)
        if isinstance(source, MapSource) and isinstance(surroundings, PieceNeighbourIndex):
            source.defer_parts(surroundings.cut)
        report("tabulate statements", 0, 0)
        data, objects = source.data, surroundings.objects
        label, rgb = torch.from_numpy(objects.labels(data.gallery)[1]), torch.from_numpy(objects.rgb.astype(np.float32))
        with torch.inference_mode():
            words = likelihood.colour_word_p(rgb, data.palette)
        statements = statement_rows(likelihood, surroundings, label, rgb, words)
        scanned = surroundings if isinstance(surroundings, ScanNeighbourIndex) else None
        return cls(vectors, levels, statements, scanned)

    def save(self, directory: Path) -> None:
        """Write the files that `load` reads."""
        columns: dict[str, npt.NDArray[Any]] = {
            "vectors": self.vectors,
            "holds": self.rows.holds,
            "statement": self.rows.statement,
            "starts": self.rows.starts,
        }
        save_file(columns, directory / FILE, {"statements": str(self.rows.possible)})
        if not self.levels.is_empty:
            self.levels.save(directory)
        if self.scanned is not None:
            self.scanned.save(directory)

    @classmethod
    def load(cls, directory: Path, levels: Sequence[Level], cells: CellTable) -> "ShardData":
        """Read the files that `save` wrote; IndexBroken if they are damaged."""
        try:
            columns, facts = map_arrays(directory / FILE)
            starts, statement, holds, vectors = (columns[name] for name in COLUMNS)
            rows = StatementRows(starts, statement, holds, int(facts["statements"]))
            if (len(rows.starts) - 1, rows.starts[-1]) != (len(vectors), len(rows.holds)):
                raise ValueError("its columns have different lengths")
        except (OSError, SafetensorError, KeyError, TypeError, ValueError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; make this shard again") from error
        table = EMPTY_LEVEL_TABLE if tuple(levels) == ("global",) else LevelTable.load(directory, levels)
        is_scan = (directory / SURROUNDINGS_FILE).exists()
        scanned = ScanNeighbourIndex.load(directory, cells) if is_scan else None
        return cls(vectors, table, rows, scanned)


@contextmanager
def explain_write_errors(out_dir: Path) -> Iterator[None]:
    """Turn write errors into a DataError that names the index directory."""
    try:
        yield
    except (OSError, SafetensorError) as error:
        raise DataError(
            f"{out_dir} cannot be written: {error}; free some space, or choose another directory"
        ) from error


def _encode_cells(retriever: Retriever, data: MapData, rows: range, report: Progress) -> tuple[Floats, LevelTable]:
    """Encode cells span by span: vectors [C, D] and the other levels, compact."""
    labels = np.array(data.gallery.labels)
    report("encode cells", 0, len(rows))
    sample = _encode_sample(retriever, data, labels)
    bases, levels = sample.fit_bases(), list(sample.vectors)

    def columns() -> Iterator[dict[str, npt.NDArray[Any]]]:
        yield {"sizes": np.empty(0, np.int64), "vectors": np.empty((0, retriever.config.width), np.float32)} | {
            level: np.empty((0, basis.shape[1]), np.int8) for level, basis in bases.items()
        }
        spans = [
            range(first, min(first + CELLS_PER_SPAN, rows.stop))
            for first in range(rows.start, rows.stop, CELLS_PER_SPAN)
        ]
        for span, features in zip(spans, CellFeatures.iterate_spans(data.cells, labels, spans), strict=True):
            with_points = retriever.with_point_features(features)
            drop_pages()  # of the parts of these cells
            vectors, table = encode_gallery(retriever, with_points, map_forked)
            codes = table.compact(bases).vectors
            yield {"sizes": np.diff(table.starts), "vectors": vectors} | {level: codes[level] for level in levels}
            report("encode cells", span.stop - rows.start, len(rows))

    columns_read = spooled(columns())
    starts = np.concatenate([[0], np.cumsum(columns_read["sizes"])])
    table = LevelTable(starts, {level: columns_read[level] for level in levels}, bases)
    return columns_read["vectors"], table if levels else EMPTY_LEVEL_TABLE


def _encode_sample(retriever: Retriever, data: MapData, labels: npt.NDArray[Any]) -> LevelTable:
    """Return the levels of cells spread over the whole map, the same for each shard."""
    if retriever.levels == ("global",):
        return EMPTY_LEVEL_TABLE
    rows = np.unique(np.linspace(0, len(data.cells) - 1, CELLS_PER_BLOCK).astype(np.int64))
    features = CellFeatures.from_cells(data.cells.take(rows), labels)
    return encode_gallery(retriever, retriever.with_point_features(features))[1]
