"""Import the features of a map, strip by strip: pieces, instances and outlines."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.geometry.piece_rows import PieceRows, cut_band
from models.citymap.geometry.pieces import PieceTable
from models.citymap.geometry.rich_blocks import find_rich_blocks
from models.citymap.geometry.tiling import BlockSet
from models.citymap.instances import InstanceTable
from models.citymap.points import Ints
from models.citymap.scenery.shapes import DrawnObjects, Outlines, OutlinesBuilder
from models.citymap.types import CutRules, Floats, MapShape
from models.processes import map_forked
from models.sources.osm.feature_strips import FeatureInstances, FeatureStrips
from models.sources.osm.features import Feature
from models.strings import Categorical

UNKNOWN_RGB: Final = (np.nan, np.nan, np.nan)


@dataclass(frozen=True, slots=True, eq=False)
class _ImportedStrip:
    rows: PieceRows
    drawing: DrawnObjects  # the features that it owns
    instance: Ints  # [n] the instances whose first features are among these
    names: list[str | None]  # [n] of the instances
    sources: npt.NDArray[np.bytes_]  # [n] of the instances
    rgb: Floats  # [n, 3] of the instances


def _find_rich_blocks(strips: FeatureStrips, rules: CutRules, number: int) -> BlockSet:
    numbers = [n for n in (number - 1, number, number + 1) if n in strips.numbers]
    features = {each.number: each.feature for n in numbers for each in strips.read(n)}.values()
    geometry = np.array([feature.geometry for feature in features], dtype=object)
    is_walkable = np.array([feature.walkable for feature in features], np.bool_)
    return find_rich_blocks(geometry, is_walkable, strips.band(number), rules)


def _import_strip(
    strips: FeatureStrips, instances: FeatureInstances, blocks: BlockSet | None, number: int
) -> _ImportedStrip:
    features = [each for each in strips.read(number) if instances.feature_instance[each.number] >= 0]
    instance = instances.feature_instance[[each.number for each in features]]
    heights_m = strips.heights_m[instances.first[instance]]
    solids = [
        each.feature.solid(int(n), *heights)
        for each, n, heights in zip(features, instance, heights_m.tolist(), strict=True)
    ]
    owned = [each for each in features if each.is_owned]
    rank = instances.rank[[each.number for each in owned]]
    first = [each for each in owned if instances.first[instances.feature_instance[each.number]] == each.number]
    return _ImportedStrip(
        rows=cut_band(solids, strips.band(number), blocks),
        drawing=DrawnObjects.from_shapes([_shape(each.feature) for each in owned], rank),
        instance=instances.feature_instance[[each.number for each in first]],
        names=[each.feature.name for each in first],
        sources=np.array([each.feature.source_id.encode() for each in first], np.bytes_),
        rgb=np.array([each.feature.rgb or UNKNOWN_RGB for each in first], np.float32).reshape(-1, 3),
    )


def _shape(feature: Feature) -> MapShape:
    top_m = feature.base_m + feature.height_m if feature.shape != "outline" else feature.height_m
    drawn = feature.geometry if feature.axis is None else feature.axis
    heights = feature.base_m, 0.0 if feature.shape == "ground" else max(top_m, feature.base_m)
    return MapShape(feature.label, drawn, *heights, feature.width_m, feature.name, feature.source_id)


@dataclass(frozen=True, slots=True, eq=False)
class ImportedMap:
    """An imported map."""

    instances: InstanceTable  # those with pieces; others are fully covered
    is_walkable: npt.NDArray[np.bool_]  # [I] whether a person can stand there
    pieces: PieceTable
    outlines: Outlines

    @classmethod
    def from_strips(cls, strips: FeatureStrips, rules: CutRules | None = None) -> "ImportedMap":
        """Import features in several processes, some strips at a time, without pieces that no cell of `rules` needs."""
        instances, classes = FeatureInstances.join(strips), strips.classes
        blocks = None
        if rules is not None:
            rich = BlockSet.concatenate(list(map_forked(partial(_find_rich_blocks, strips, rules), strips.numbers)))
            blocks = rich.with_neighbours() if len(rich.keys) else None  # then the cells say what is missing
        labels = dict.fromkeys(classes[n].label for n in np.unique(strips.order[instances.feature_instance >= 0]))
        importer = _StripImporter(strips, instances, blocks, OutlinesBuilder(labels))
        pieces = PieceTable.from_bands(importer.rows())
        numbers = np.unique(pieces.instance)
        pieces = pieces.renumber_instances(numbers)
        order = strips.order[instances.first[numbers]]
        table = InstanceTable(
            Categorical.from_strings([classes[n].label for n in order]),
            Categorical.from_strings([importer.names.get(n) for n in numbers.tolist()]),
            Categorical.from_bytes(importer.sources[numbers]),
            Categorical.from_strings([classes[n].shape for n in order]),
            importer.rgb[numbers],
        )
        is_walkable = np.array([row.walkable for row in classes])[order]
        return cls(table, is_walkable, pieces, importer.drawings.build())


class _StripImporter:
    """Collects the results of strips, except their pieces, for I instances."""

    def __init__(
        self, strips: FeatureStrips, instances: FeatureInstances, blocks: BlockSet | None, drawings: OutlinesBuilder
    ) -> None:
        count = len(instances.first)
        self._strips, self._instances, self._blocks, self.drawings = strips, instances, blocks, drawings
        self.names = dict[int, str]()  # by number of the instance
        self.sources = np.empty(count, f"S{strips.max_source_bytes}")
        self.rgb = np.empty((count, 3), np.float32)

    def rows(self) -> Iterator[PieceRows]:
        """Yield the pieces of one strip after the other."""
        work = partial(_import_strip, self._strips, self._instances, self._blocks)
        for strip in map_forked(work, self._strips.numbers):
            self.drawings.add(strip.drawing)
            self.sources[strip.instance], self.rgb[strip.instance] = strip.sources, strip.rgb
            self.names |= {
                n: name for n, name in zip(strip.instance.tolist(), strip.names, strict=True) if name is not None
            }
            yield strip.rows
