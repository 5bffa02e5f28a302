"""The features of a file on disk, by strips of the map, so that a large city is never in memory as a whole."""

import pickle
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Final

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from models.citymap.geometry.piece_rows import TILE_COLUMNS_PER_BAND
from models.citymap.geometry.tiling import TileSpan, tile_span
from models.citymap.points import Ints, ranges
from models.processes import map_forked
from models.sources.osm.classes import OsmClass, load_classes
from models.sources.osm.features import UPRIGHT_MERGE_M, Feature, find_joins
from models.spool import disk_errors

UPRIGHT_SHAPE: Final = "column"


@dataclass(frozen=True, slots=True)
class NumberedFeature:
    """A feature and its number."""

    number: int  # in the order in which features were read
    feature: Feature
    is_owned: bool  # whether this strip is the first that it spans, and so draws it


class FeatureStrips:
    """The N features of a map, given in batches, each stored in every strip that it spans, in an empty directory.

    `classes` are those that `Feature.order` numbers, by default the table's.
    """

    def __init__(
        self, directory: Path, features: Iterable[Sequence[Feature]], classes: Sequence[OsmClass] | None = None
    ) -> None:
        self._directory, count = directory, 0
        self.classes, self.max_source_bytes = classes or load_classes(), 1
        order, heights, numbers = [np.zeros(0, np.int16)], [np.zeros((0, 2))], set[int]()
        for batch in features:
            if not batch:
                continue
            order.append(np.array([feature.order for feature in batch], np.int16))
            heights.append(np.array([(feature.base_m, feature.height_m) for feature in batch]))
            numbers |= self._store(count, batch)
            longest = max(len(feature.source_id.encode()) for feature in batch)
            self.max_source_bytes = max(self.max_source_bytes, longest)
            count += len(batch)
        # Numbers of strips with features, from west to east; class [N] and base and height [N, 2] of each feature
        self.numbers, self.order, self.heights_m = sorted(numbers), np.concatenate(order), np.concatenate(heights)

    def _store(self, first: int, features: Sequence[Feature]) -> set[int]:
        """Add features, numbered from `first`, to their strips; return the numbers of these strips."""
        bounds = shapely.bounds([feature.geometry for feature in features])
        ends = np.stack([bounds[:, 0] - UPRIGHT_MERGE_M, bounds[:, 2] + UPRIGHT_MERGE_M], axis=1)
        low, high = (column // TILE_COLUMNS_PER_BAND for column in tile_span(ends))
        feature, strip = np.repeat(np.arange(len(features)), high + 1 - low), ranges(low, high + 1)
        numbers = set(strip.tolist())
        for number in numbers:
            numbered = [
                NumberedFeature(first + n, features[n], low[n] == number) for n in feature[strip == number].tolist()
            ]
            with disk_errors(), self._path(number).open("ab") as file:
                pickle.dump(numbered, file, pickle.HIGHEST_PROTOCOL)
        return numbers

    def _path(self, number: int) -> Path:
        return self._directory / f"{number}.pickle"

    def read(self, number: int) -> list[NumberedFeature]:
        """Read the features of a strip, in order of their classes, then as they were read."""
        features = list[NumberedFeature]()
        with self._path(number).open("rb") as file:
            while file.peek(1):
                features += pickle.load(file)  # written by this job
        return sorted(features, key=lambda placed: (placed.feature.order, placed.number))

    def band(self, number: int) -> TileSpan:
        """Return the columns of tiles of a strip."""
        return number * TILE_COLUMNS_PER_BAND, (number + 1) * TILE_COLUMNS_PER_BAND


@dataclass(frozen=True, slots=True, eq=False)
class FeatureInstances:
    """The features that make up each instance; instances are numbered in order of their first features."""

    feature_instance: Ints  # [N] instance of each feature, by its number; -1 if it is left out
    first: Ints  # [I] number of the first feature of each
    rank: Ints  # [N] place of each feature, by its number, in order of classes, then as they were read

    @classmethod
    def join(cls, strips: FeatureStrips) -> "FeatureInstances":
        """Join the features of all strips; see `find_joins`."""
        per_strip = list(map_forked(partial(_find_joins_in, strips), strips.numbers))
        left_out = np.concatenate([np.zeros(0, np.int64), *(rows for rows, _ in per_strip)])
        pairs = np.concatenate([np.zeros((0, 2), np.int64), *(rows for _, rows in per_strip)])
        count = len(strips.order)
        is_left_out = np.zeros(count, np.bool_)
        is_left_out[left_out] = True
        pairs = pairs[~is_left_out[pairs].any(axis=1)]  # one strip may leave out a feature that another one joins
        by_class = np.argsort(strips.order, kind="stable")
        rank = np.empty(count, np.int64)
        rank[by_class] = np.arange(count)
        graph = coo_array((np.ones(len(pairs), np.bool_), tuple(pairs.T)), shape=(count, count))
        group = connected_components(graph, directed=False)[1]
        first = np.full(group.max(initial=-1) + 1, count)
        np.minimum.at(first, group, rank)
        is_upright = np.array([row.shape == UPRIGHT_SHAPE for row in strips.classes])[strips.order]
        is_member = ~is_left_out & ~(is_upright & (first[group] != rank))  # the first stands for the others
        is_first = is_member & (first[group] == rank)
        first_features = by_class[is_first[by_class]]
        number = np.full(count, -1)
        number[group[first_features]] = np.arange(len(first_features))
        return cls(np.where(is_member, number[group], -1), first_features, rank)


def _find_joins_in(strips: FeatureStrips, number: int) -> tuple[Ints, Ints]:
    features = strips.read(number)
    numbers = np.array([each.number for each in features])
    left_out, pairs = find_joins([each.feature for each in features])
    return numbers[left_out], numbers[pairs]
