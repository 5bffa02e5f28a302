"""What is heavy to make of some cells of a map: a whole index is made of one part or of several, to the same bytes."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
import torch
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save_file
from scipy.sparse import csr_array

from index.stores.store import Floats
from models.city.cells import CellTable
from models.city.gallery import MapData
from models.city.types import Progress
from models.errors import IndexBroken
from models.posterior.likelihood import Likelihood
from models.posterior.statements import statement_rows
from models.posterior.surroundings.scan_surroundings import FILE as SURROUNDINGS_FILE
from models.posterior.surroundings.scan_surroundings import ScanSurroundings
from models.posterior.surroundings.surroundings import Surroundings
from models.processes import map_forked
from models.retrieval.instance_encoder import CellFeatures
from models.retrieval.level_table import NO_LEVELS, LevelTable, encode_gallery
from models.retrieval.levels import Level
from models.retrieval.retriever import Retriever

FILE: Final = "part.safetensors"


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """C cells of a map, one after the other.

    Attributes:
        vectors: [C, D] float32, the global level.
        levels: the others, if there are any.
        rows: [C, S] of `statement_rows`.
        scanned: what lies around them, of a scan; None of a map of pieces, which finds that when it is asked for.
    """

    vectors: Floats
    levels: LevelTable
    rows: csr_array
    scanned: ScanSurroundings | None

    @classmethod
    def of(
        cls,
        retriever: Retriever,
        likelihood: Likelihood,
        data: MapData,
        surroundings: Surroundings,
        rows: range,
        report: Progress,
    ) -> "Part":
        """Make the part of some cells.

        Args:
            retriever: makes the vectors, of all its levels.
            likelihood: makes the statements.
            data: the whole map.
            surroundings: of these cells.
            rows: which they are.
            report: called as the work goes on.
        """
        report("encode cells", 0, 0)
        features = CellFeatures.of(data.cells, np.array(data.gallery.labels)).between(rows.start, rows.stop)
        vectors, levels = encode_gallery(retriever, retriever.seen(features), map_forked)
        report("tabulate statements", 0, 0)
        things = surroundings.things
        label, rgb = torch.from_numpy(things.labels(data.gallery)[1]), torch.from_numpy(things.rgb.astype(np.float32))
        with torch.inference_mode():
            words = likelihood.words(rgb, data.palette)
        told = statement_rows(likelihood, surroundings, label, rgb, words)
        scanned = surroundings if isinstance(surroundings, ScanSurroundings) else None
        return cls(vectors, NO_LEVELS if levels.is_empty else levels, told, scanned)

    def save(self, directory: Path) -> None:
        """Write some files, which `load` reads."""
        columns = {
            "vectors": self.vectors,
            "holds": self.rows.data.astype(np.float16),  # as it was rounded
            "statement": self.rows.indices.astype(np.int32),
            "starts": self.rows.indptr.astype(np.int64),
        }
        save_file(columns, directory / FILE, {"statements": str(self.rows.shape[1])})
        if not self.levels.is_empty:
            self.levels.save(directory)
        if self.scanned is not None:
            self.scanned.save(directory)

    @classmethod
    def load(cls, directory: Path, levels: Sequence[Level], cells: CellTable) -> "Part":
        """Read what `save` wrote.

        Args:
            directory: where.
            levels: of the retriever that made it.
            cells: all cells of the map.

        Raises:
            IndexBroken: the files do not hold a part of it.
        """
        try:
            with safe_open(directory / FILE, framework="numpy") as file:
                columns = {name: file.get_tensor(name) for name in ("vectors", "holds", "statement", "starts")}
                shape = len(columns["vectors"]), int(file.metadata()["statements"])
            content = columns["holds"].astype(np.float32), columns["statement"], columns["starts"]
            rows = csr_array(content, shape)
        except (OSError, SafetensorError, KeyError, TypeError, ValueError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; make this shard again") from error
        table = NO_LEVELS if tuple(levels) == ("global",) else LevelTable.load(directory, levels)
        is_scan = (directory / SURROUNDINGS_FILE).exists()
        scanned = ScanSurroundings.load(directory, cells) if is_scan else None
        return cls(columns["vectors"], table, rows, scanned)
