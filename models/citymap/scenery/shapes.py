"""A map as outlines, lines and points with heights and names, in as few bytes as drawing needs."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt
import shapely

from models.citymap.points import ranges
from models.citymap.scenery.files import SceneryBlob
from models.citymap.types import Floats, MapShape
from models.spool import ROWS_PER_BLOCK, Spool, spooled

UNITS_PER_M: Final = 10  # coordinates are sent in decimetres
SIMPLIFY_TOLERANCE_M: Final = 0.3  # greatest distance of a drawn outline from the mapped one
OSM_TYPES: Final = ("node", "way", "relation")
MAX_UNITS: Final = 65535  # heights have 16 bits
PATH_COLUMNS: Final = ("size", "hole")


@dataclass(frozen=True, slots=True)
class NamedPoint:
    """A named object that is drawn as a point: a shop, a museum."""

    position_m: tuple[float, float]  # x, y, map frame
    name: str
    kind: str


@dataclass(frozen=True, slots=True, eq=False)
class Outlines:
    """O objects of R paths of V vertices as they are drawn, by label, then by position; numbers are decimetres."""

    labels: list[str]  # the topmost first
    names: dict[int, str]  # by number of the object
    # [O]: "label" (number in `labels`), "form" (0 point, 1 line, 2 area), "base", "top", "width", "paths" (count),
    # "source" (OpenStreetMap's number times 4, plus 0 node, 1 way, 2 relation; -1 for none).
    # [R]: "size" (vertices), "hole" (of an area). [V, 2]: "steps", from the vertex before it, the first from the origin
    tensors: dict[str, npt.NDArray[Any]]

    @classmethod
    def from_shapes(cls, shapes: Sequence[MapShape]) -> "Outlines":
        """Build the outlines of shapes, given the topmost first; labels keep this order."""
        builder = OutlinesBuilder(dict.fromkeys(shape.label for shape in shapes))
        builder.add(DrawnObjects.from_shapes(shapes, np.arange(len(shapes))))
        return builder.build()

    def encode(self, places: Iterable[NamedPoint] = ()) -> SceneryBlob:
        """Return a part of scenery; its metadata have "labels", "names" and "places" [[x, y, name, kind]] as JSON."""
        lists: dict[str, Any] = {
            "labels": self.labels,
            "names": self.names,
            "places": [
                [*(round(v * UNITS_PER_M) for v in place.position_m), place.name, place.kind] for place in places
            ],
        }
        texts = {key: json.dumps(value, ensure_ascii=False, separators=(",", ":")) for key, value in lists.items()}
        return SceneryBlob(self.tensors, {"kind": "shapes", **texts})


@dataclass(frozen=True, slots=True, eq=False)
class DrawnObjects:
    """O objects as they are drawn."""

    labels: list[str]
    names: list[str | None]
    # As in `Outlines` without "label" and "steps"; also "place" [O], the rank among all objects, "low" [O, 2], the
    # lowest coordinates in metres, and "xy" [V, 2]
    tensors: dict[str, npt.NDArray[Any]]

    @classmethod
    def from_shapes(cls, shapes: Sequence[MapShape], rank: npt.NDArray[Any]) -> "DrawnObjects":
        """Build the objects of shapes, with the rank [S] of each among all."""
        geometry = shapely.simplify(np.array([shape.geometry for shape in shapes], dtype=object), SIMPLIFY_TOLERANCE_M)
        rows = np.flatnonzero(~(shapely.is_missing(geometry) | shapely.is_empty(geometry)))
        shapes, geometry = [shapes[n] for n in rows.tolist()], geometry[rows]
        form = shapely.get_dimensions(geometry).astype(np.uint8) if shapes else np.zeros(0, np.uint8)
        path, owner, hole = _paths(geometry, form)
        xy, of_path = shapely.get_coordinates(path, return_index=True)
        tensors = {
            "form": form,
            "base": _to_units([shape.base_m for shape in shapes]),
            "top": _to_units([shape.top_m for shape in shapes]),
            "width": _to_units([shape.width_m for shape in shapes]),
            "paths": np.bincount(owner, minlength=len(shapes)).astype(np.uint32),
            "source": np.array([_encode_source(shape.source_id) for shape in shapes], dtype=np.float64),
            "size": np.bincount(of_path, minlength=len(path)).astype(np.uint32),
            "hole": hole.astype(np.uint8),
            "place": rank[rows],
            "low": np.nan_to_num(shapely.bounds(geometry))[:, :2],
            "xy": np.rint(xy * UNITS_PER_M).astype(np.int32),
        }
        return cls([shape.label for shape in shapes], [shape.name for shape in shapes], tensors)


class OutlinesBuilder:
    """Collects the drawn objects of a map on disk, given the labels of all objects, the topmost first."""

    def __init__(self, labels: Iterable[str]) -> None:
        self._number = {label: n for n, label in enumerate(labels)}
        self._spool, self._names, self._count = Spool(), dict[int, str](), 0

    def add(self, objects: DrawnObjects) -> None:
        """Add objects; at least one call is needed."""
        self._spool.add(
            {"label": np.array([self._number[label] for label in objects.labels], np.uint16), **objects.tensors}
        )
        self._names |= {self._count + n: name for n, name in enumerate(objects.names) if name}
        self._count += len(objects.labels)

    def build(self) -> Outlines:
        """Return the outlines; nothing can be added after this."""
        columns = self._spool.columns()
        order = np.lexsort((columns.pop("place"), _morton_codes(columns.pop("low")), columns["label"]))
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        names = dict(sorted((int(place[row]), name) for row, name in self._names.items()))
        return Outlines(list(self._number), names, spooled(_sorted_tensors(columns, order)))


def _sorted_tensors(columns: Mapping[str, npt.NDArray[Any]], order: npt.NDArray[Any]) -> Iterator[dict[str, Any]]:
    """Yield the tensors of Outlines from the columns of drawn objects, some objects at a time."""
    ends = {name: np.cumsum(columns[name], dtype=np.int64) for name in ("paths", "size")}
    last = np.zeros((1, 2), np.int32)
    for first in range(0, len(order) or 1, ROWS_PER_BLOCK):
        rows = order[first : first + ROWS_PER_BLOCK]
        paths = _group_rows(ends["paths"], columns["paths"], rows)
        xy = columns["xy"][_group_rows(ends["size"], columns["size"], paths)]
        tensors = {
            name: column[paths if name in PATH_COLUMNS else rows] for name, column in columns.items() if name != "xy"
        }
        yield tensors | {"steps": np.diff(xy, axis=0, prepend=last).astype(np.int32)}
        last = xy[-1:] if len(xy) else last


def _group_rows(ends: npt.NDArray[Any], sizes: npt.NDArray[Any], groups: npt.NDArray[Any]) -> npt.NDArray[Any]:
    return ranges(ends[groups] - sizes[groups], ends[groups])


def _paths(geometry: Any, form: npt.NDArray[np.uint8]) -> tuple[Any, npt.NDArray[np.intp], npt.NDArray[np.bool_]]:
    """Return points, lines and rings in order of objects, the object of each, and whether it is a hole."""
    parts, owner = shapely.get_parts(geometry, return_index=True)
    is_drawn = shapely.get_dimensions(parts) == form[owner]  # a collection also holds what a clip left over
    parts, owner = parts[is_drawn], owner[is_drawn]
    is_area = shapely.get_dimensions(parts) == 2
    rings, polygon = shapely.get_rings(parts[is_area], return_index=True)
    is_hole = np.diff(polygon, prepend=-1) == 0
    others = ~is_area
    path = np.concatenate([rings, parts[others]])
    of_object = np.concatenate([owner[is_area][polygon], owner[others]])
    hole = np.concatenate([is_hole, np.zeros(int(others.sum()), dtype=bool)])
    order = np.argsort(of_object, kind="stable")
    return path[order], of_object[order], hole[order]


def _to_units(values_m: Sequence[float]) -> npt.NDArray[np.uint16]:
    rounded = np.rint(np.array(values_m, dtype=np.float64) * UNITS_PER_M)
    return rounded.clip(0, MAX_UNITS).astype(np.uint16)


def _encode_source(source_id: str | None) -> float:
    element_type, _, number = (source_id or "").partition("/")
    return (
        float(int(number) * 4 + OSM_TYPES.index(element_type))
        if element_type in OSM_TYPES and number.isdigit()
        else -1.0
    )


def _morton_codes(low_m: Floats) -> npt.NDArray[np.int64]:
    """Return a number [O] for the position of each object [O, 2]; near objects have near numbers."""
    low = low_m - low_m.min(axis=0, initial=0.0)
    cell = np.minimum(low / 4, 0xFFFFF).astype(np.int64)
    codes = np.zeros(len(cell), dtype=np.int64)
    for bit in range(20):
        codes |= ((cell[:, 0] >> bit & 1) << 2 * bit) | ((cell[:, 1] >> bit & 1) << 2 * bit + 1)
    return codes
