"""Maps with texts, read as they would be in service: what the hint posterior is fitted to and calibrated on."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from models.city.cells import CellTable, cut_cells
from models.city.colours import KITTI360_PALETTE, Palette
from models.city.hints import describe_poses, sample_positions
from models.city.osm.map import load_osm
from models.city.points import Ints, PointTable
from models.city.regions import split_regions
from models.city.store.files import load_data
from models.city.types import DIRECTIONS, CutRules, Floats, Hint
from models.language.grammar.files import Grammar
from models.language.grammar.labelled_text import Fact
from models.language.grammar.wording import Wording
from models.posterior.binding import Binding
from models.posterior.likelihood import Likelihood, Reading
from models.posterior.model import PosteriorModel
from models.posterior.posterior import HintPosterior
from models.posterior.surroundings import Bodies, Surroundings

READ_AT_ONCE = 16
POSITION_SPACING_M = 10.0
SLIPS = 0.15  # share of the texts that say something wrong, as people do
SLIPS_OF_CLASS = 0.4  # of those, that name something else; the others give another direction and colour


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """A map (or a part of it) with what was said in it.

    Attributes:
        surroundings, cells: of the gallery.
        label: [R] number of the label of each of the cells' parts.
        labels: all labels.
        palette: colour words.
        hints: Q lists of what was said.
        positions_m: [Q, 2] where it was said.
        truth: [Q] cells.
    """

    surroundings: Surroundings
    cells: CellTable
    label: npt.NDArray[np.int64]
    labels: tuple[str, ...]
    palette: Palette
    hints: Sequence[tuple[Hint, ...]]
    positions_m: Floats
    truth: Ints

    def posterior(self, likelihood: Likelihood) -> HintPosterior:
        """The posterior of this gallery."""
        return HintPosterior(likelihood, self.surroundings, self.cells, self.label, self.palette)

    def read(
        self, model: PosteriorModel, rows: Ints, grammars: Sequence[Grammar | None], rng: np.random.Generator
    ) -> list[Reading]:
        """Texts about some positions, worded and read; some of them (`SLIPS`) say something wrong.

        Args:
            model: reads them.
            rows: of the positions.
            grammars: drawn from for each text; None is the benchmark's wording.
            rng: draws grammars and words.
        """
        binding = Binding(model.matcher, self.labels, self.palette)
        wordings = {grammar: Wording(grammar or "train") for grammar in grammars}
        texts = []
        for row in rows:
            grammar = grammars[int(rng.integers(len(grammars)))]
            facts = [Fact(hint.label, hint.direction, hint.colour) for hint in self.hints[row]]
            if rng.random() < SLIPS:
                facts = _slip(facts, self.palette, self.labels, rng)
            wording = wordings[grammar]
            texts.append((wording.write(facts, rng) if grammar else wording.published(facts)).text)
        readings = []
        for start in range(0, len(texts), READ_AT_ONCE):
            read = model.reader.read(texts[start : start + READ_AT_ONCE])
            readings += [binding.reading(noticed) if noticed else binding.nothing() for noticed in read]
        return readings


def _slip(facts: Sequence[Fact], palette: Palette, labels: Sequence[str], rng: np.random.Generator) -> list[Fact]:
    """The same but for one: it is of another class, or of another colour and in another direction, than is true."""
    at = int(rng.integers(len(facts)))
    fact = facts[at]
    if rng.random() < SLIPS_OF_CLASS:
        others = [label for label in labels if label != fact.label] or [fact.label]
        return [*facts[:at], replace(fact, label=others[int(rng.integers(len(others)))]), *facts[at + 1 :]]
    winds = [wind for wind in DIRECTIONS[:4] if wind != fact.relation]
    words = [word for word in dict.fromkeys(palette.words) if word != fact.colour]
    colour = words[int(rng.integers(len(words)))] if fact.colour else None
    wrong = replace(fact, relation=winds[int(rng.integers(len(winds)))], colour=colour)
    return [*facts[:at], wrong, *facts[at + 1 :]]


def load_place(data: Path, split: str) -> Place:
    """A part of a map or data set, with its positions.

    Args:
        data: an OpenStreetMap file, or a directory in KITTI360Pose's layout or a converted store.
        split: train, val or test; of a data set also a comma list of scenes.

    Raises:
        MapError, DataError: it cannot be read, or has no such split.
    """
    place = _of_store(data, split) if data.is_dir() else _of_map(data, split)
    return replace(place, cells=replace(place.cells, sample=None))  # lets go of the map's points


def _of_store(data: Path, split: str) -> Place:
    store = load_data(data, split)
    cells, poses = store.cell_table(), store.poses
    surroundings = Surroundings.of(Bodies.of_store(store, cells), cells, CutRules().thing_share)
    names, label = np.unique(np.array(store.labels), return_inverse=True)
    hints = [poses.hints(q) for q in range(len(poses))]
    truth = poses.cell.astype(np.int64)
    labels = tuple(names.tolist())
    positions_m = poses.positions_m[:, :2]
    return Place(surroundings, cells, label.astype(np.int64), labels, KITTI360_PALETTE, hints, positions_m, truth)


def _of_map(data: Path, split: str) -> Place:
    city_map = load_osm(data)
    points = PointTable.of(city_map, city_map.rules.eps_m)
    whole = cut_cells(city_map, points)
    region = {str(name): region for name, region in split_regions(whole).items()}[split]
    cells = region.cells(whole)
    locations = region.locations(city_map.locations_m)
    positions = sample_positions(locations, POSITION_SPACING_M, np.random.default_rng(0))
    poses = describe_poses(city_map, points, cells, positions)
    surroundings = Surroundings.of(Bodies.of_map(city_map, points, cells), cells, city_map.rules.thing_share)
    names, number = np.unique([i.label for i in city_map.instances], return_inverse=True)
    row = {cell_id: n for n, cell_id in enumerate(cells.ids)}
    return Place(
        surroundings,
        cells,
        number.astype(np.int64)[cells.parts.instance],
        tuple(names.tolist()),
        city_map.palette,
        [pose.description.hints for pose in poses],
        np.array([pose.position_m[:2] for pose in poses]),
        np.array([row[pose.cell_id] for pose in poses]),
    )
