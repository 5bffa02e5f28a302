"""Summarize an OpenStreetMap file: how large it is, and what descriptions can name there."""

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final

import numpy as np

from models.citymap.frame import Frame
from models.citymap.gazetteer.gazetteer import ADDRESS_KIND, WALKED_KIND, Gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND
from models.citymap.kinds.vocabulary import load_vocabulary
from models.citymap.summary import MapSummary
from models.citymap.types import Floats
from models.sources.extras.layer import ExtraLayer
from models.sources.osm.extent import FAR_KM, Box, read_extent
from models.sources.osm.gazetteer import load_gazetteer
from models.sources.osm.ordering import ordered_file
from models.sources.osm.reading_counts import ReadingCounts

MAX_KINDS: Final = 12  # the most frequent ones
MAX_LANGUAGES: Final = 20
NO_KINDS: Final = (ADDRESS_KIND, STREET_KIND, WALKED_KIND)
SEGMENTS_PER_BLOCK: Final = 2**18  # bounds the temporary arrays


def load_gazetteer_and_summary(path: Path, extras: Sequence[ExtraLayer] = ()) -> tuple[Gazetteer, MapSummary]:
    """Read the gazetteer and the summary of a file, which extras join; raise MapError if it cannot be read."""
    counts = ReadingCounts()
    for layer in extras:
        counts.extras[str(layer)] += len(layer.objects)
        counts.dropped[f"outside the map, in {layer.name}"] += layer.outside
        counts.dropped[f"no position, in {layer.name}"] += layer.unplaced
    with ordered_file(path) as ordered:
        extent = read_extent(ordered)
        if extent.num_strays:
            reason = f"more than {FAR_KM:.0f} km from the rest, such as {extent.farthest_stray}"
            counts.dropped[reason] = extent.num_strays
        if extent.is_box_ignored:
            counts.repaired["bounds that have none of the nodes inside"] = 1
        gazetteer = load_gazetteer(ordered, extent.frame, counts, extras)
    return gazetteer, summarize(gazetteer, extent.frame, extent.box, counts)


def summarize(gazetteer: Gazetteer, frame: Frame, box: Box | None, counts: ReadingCounts) -> MapSummary:
    """Summarize a file by its gazetteer, its header's box (None for the bounds of all objects) and its counts."""
    low_m, high_m = _bounds_m(gazetteer.segments_m) if box is None else _corners_m(frame, box)
    objects, is_inside = gazetteer.objects, gazetteer.overlaps(low_m, high_m)
    return MapSummary(
        bbox=_bbox(frame, low_m, high_m) if box is None else box,
        width_km=float(high_m[0] - low_m[0]) / 1000,
        height_km=float(high_m[1] - low_m[1]) / 1000,
        walkable_km=_walkable_m(gazetteer, low_m, high_m) / 1000,
        objects=int(is_inside.sum()),
        streets=int((objects.is_street & is_inside).sum()),
        named_objects=int((objects.has_name & ~objects.is_street & is_inside).sum()),
        house_numbers=int((objects.has_number & is_inside).sum()),
        kinds=_frequent_kinds(objects.count_kinds(is_inside)),
        scripts=dict(counts.scripts.most_common()),
        languages=dict(counts.languages.most_common(MAX_LANGUAGES)),
        extras=dict(counts.extras),
        cut=dict(counts.cut.most_common()),
        dropped=dict((+counts.dropped).most_common()),
        repaired=dict(counts.repaired.most_common()),
    )


def _corners_m(frame: Frame, box: Box) -> Floats:
    """Return the southwest and northeast corner [2, 2] of a box."""
    west, south, east, north = box
    return frame.from_wgs84(np.array([south, north]), np.array([west, east]))


def _bounds_m(segments_m: Floats) -> Floats:
    """Return the lowest and highest x and y [2, 2] of segments [n, 4]."""
    ends = segments_m.reshape(-1, 2)
    return np.stack([ends.min(axis=0), ends.max(axis=0)]) if len(ends) else np.zeros((2, 2))


def _bbox(frame: Frame, low_m: Floats, high_m: Floats) -> Box:
    (south, north), (west, east) = frame.to_wgs84(np.stack([low_m, high_m]))
    return float(west), float(south), float(east), float(north)


def _walkable_m(gazetteer: Gazetteer, low_m: Floats, high_m: Floats) -> float:
    """Return the length of all lines that people walk on, of the segments whose middle is in a box."""
    length_m = 0.0
    for walked in gazetteer.by_kind.get(WALKED_KIND, np.zeros(0, np.int64)).tolist():
        first, last = gazetteer.starts[walked : walked + 2].tolist()
        for row in range(first, last, SEGMENTS_PER_BLOCK):
            start, end = (
                gazetteer.segments_m[row : min(row + SEGMENTS_PER_BLOCK, last)].reshape(-1, 2, 2).swapaxes(0, 1)
            )
            middle = (start + end) / 2
            is_inside = ((middle >= low_m) & (middle <= high_m)).all(axis=1)
            length_m += float(np.hypot(*(end - start)[is_inside].T).sum(dtype=np.float64))
    return length_m


def _frequent_kinds(count_of_kind: Mapping[str, int]) -> dict[str, int]:
    names = {kind.id: kind.name for kind in load_vocabulary().kinds}
    counts = Counter[str]()
    for kind, count in count_of_kind.items():
        if kind not in NO_KINDS:
            counts[names.get(kind, kind)] += count
    return dict(counts.most_common(MAX_KINDS))
