"""What lies around positions of a map of pieces, found when it is asked for: that takes two microseconds a node."""

from dataclasses import astuple, dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from safetensors import SafetensorError
from safetensors.numpy import load_file, save_file

from models.city.bodies import PieceBodies
from models.city.cells import CellTable, Parts
from models.city.hints import HINT_REACH_M
from models.city.points import Ints, ranges
from models.city.tiled.cutting import cut_pieces
from models.city.tiled.pieces import PieceTable
from models.city.tiled.ways import ways_around
from models.city.types import CutRules, Floats
from models.errors import IndexBroken
from models.posterior.surroundings.around import STEP_M, Around
from models.posterior.surroundings.nodes import SPACING_M, grid
from models.posterior.surroundings.things import Things

FILE: Final = "pieces.safetensors"
THINGS: Final = ("instance", "rgb", "parts", "is_flat")


@dataclass(frozen=True, slots=True, eq=False)
class PieceSurroundings:
    """See `models.posterior.surroundings.surroundings`.

    Attributes:
        things: the map's instances.
        cell_starts: see Surroundings.
        nodes_m: likewise.
        pieces: of the map.
        rules: of its cells.
        center_m: [N, 2] of these.
    """

    things: Things
    cell_starts: Ints
    nodes_m: Floats
    pieces: PieceTable
    rules: CutRules
    center_m: Floats

    @classmethod
    def of(cls, bodies: PieceBodies, cells: CellTable) -> "PieceSurroundings":
        """Those of a gallery."""
        nodes_m, owner = grid(cells)
        starts = np.searchsorted(owner, np.arange(len(cells) + 1))
        things = Things.of_instances(bodies, cells.parts)
        return cls(things, starts, nodes_m.astype(np.float32), bodies.pieces, bodies.rules, cells.center_m[:, :2])

    @property
    def cuts(self) -> bool:
        """See Surroundings."""
        return True

    @property
    def num_bytes(self) -> int:
        """See Surroundings."""
        return sum(column.nbytes for column in self._columns().values())

    def around(self, nodes: Ints) -> Around:
        """See Surroundings."""
        cell = np.searchsorted(self.cell_starts, nodes, side="right") - 1
        first = np.flatnonzero(np.diff(cell, prepend=-1))
        nodes_m = self.nodes_m[nodes].astype(np.float64)
        starts = np.append(first, len(nodes))
        node, part, way = ways_around(
            self.pieces, self.rules, self.center_m[cell[first]], nodes_m, starts, HINT_REACH_M, STEP_M
        )
        known = self.things.parts[part] > 0
        return Around(node[known], part[known], way[known], np.ones(int(known.sum()), np.bool_))

    def cut(self, centers_m: Floats) -> Parts:
        """What lies in the cubes of some cells around centres [N, 3]."""
        return cut_pieces(self.pieces, self.things.rgb, centers_m, self.rules)

    def take(self, cells: Ints, parts: Ints) -> "PieceSurroundings":
        """See Surroundings."""
        return replace(
            self,
            things=replace(self.things, parts=parts),
            cell_starts=np.concatenate([[0], np.cumsum(np.diff(self.cell_starts)[cells])]),
            nodes_m=self.nodes_m[ranges(self.cell_starts[cells], self.cell_starts[cells + 1])],
            center_m=self.center_m[cells],
        )

    def save(self, directory: Path) -> None:
        """Write one file."""
        save_file(self._columns(), directory / FILE)

    @classmethod
    def load(cls, directory: Path, cells: CellTable) -> "PieceSurroundings":
        """Read what `save` wrote.

        Raises:
            IndexBroken: the file holds something else.
        """
        try:
            columns: dict[str, Any] = load_file(directory / FILE)
            things = Things(**{name: columns[f"things.{name}"] for name in THINGS})
            pieces = PieceTable.of_columns({name[7:]: c for name, c in columns.items() if name.startswith("pieces.")})
            rules = CutRules(*columns["rules"].tolist())
            starts, center_m = columns["cell_starts"], cells.center_m[:, :2]
            owner = np.repeat(np.arange(len(cells)), np.diff(starts))
            nodes_m = (_step_of(center_m)[owner] + columns["offset"]) * SPACING_M
        except (OSError, SafetensorError, KeyError, TypeError, ValueError, IndexError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error
        return cls(things, starts, nodes_m.astype(np.float32), pieces, rules, center_m)

    def _columns(self) -> dict[str, np.ndarray]:
        owner = np.repeat(np.arange(len(self.center_m)), np.diff(self.cell_starts))
        step = np.round(self.nodes_m / SPACING_M).astype(np.int64) - _step_of(self.center_m)[owner]
        columns = {f"things.{name}": getattr(self.things, name) for name in THINGS}
        columns |= {f"pieces.{name}": column for name, column in self.pieces.columns().items()}
        columns |= {
            "cell_starts": self.cell_starts,
            "offset": step.astype(np.int8),
            "rules": np.array(astuple(self.rules), dtype=np.float64),
        }
        return {name: np.ascontiguousarray(column) for name, column in columns.items()}


def _step_of(center_m: Floats) -> Ints:
    """[N, 2] the node next to each centre, in steps of the grid."""
    step: Ints = np.round(center_m / SPACING_M).astype(np.int64)
    return step
