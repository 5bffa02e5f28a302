"""Maps with texts that are read as in service, for the fit and calibration of the hint posterior."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from models.citymap.cells import CellTable
from models.citymap.colours import Palette
from models.citymap.points import Ints
from models.citymap.queries import Queries
from models.citymap.types import DIRECTIONS, Floats, Hint
from models.language.grammar.files import Grammar
from models.language.grammar.labelled_text import ObjectFact
from models.language.grammar.wording import Wording
from models.language.measures import compass_name
from models.posterior.binding import Binding
from models.posterior.likelihood import BoundHints, Likelihood
from models.posterior.model import PosteriorModel
from models.posterior.neighbours.neighbour_index import NeighbourIndex, build_neighbour_index
from models.posterior.posterior import HintPosterior
from models.sources.source import QUERY_SPACING_M, VALIDATION_SEED, Source

TEXTS_PER_BATCH = 16
SLIP_SHARE = 0.15  # of the texts contain a false fact
CLASS_SLIP_SHARE = 0.4  # of the false facts have a wrong class; the others a wrong direction and colour
OMISSION_SHARE, MIN_FACTS = 0.3, 2  # share of the texts with fewer facts, and their minimum number
DISTANT_SHARE, DISTANT_M = 0.2, (20.0, 60.0)  # share of the texts in free wording with a distant thing; its distance
MEASURED_SHARE = 0.5  # of the distant things are mentioned with their distance


@dataclass(frozen=True, slots=True, eq=False)
class TrainingSite:
    """A map, or a part of it, with hints at known positions."""

    surroundings: NeighbourIndex
    cells: CellTable
    label: npt.NDArray[np.int64]  # [P] index into `labels` of each object of the surroundings
    labels: tuple[str, ...]
    palette: Palette
    hints: Sequence[tuple[Hint, ...]]  # Q lists of hints
    positions_m: Floats  # [Q, 2] true positions
    truth: Ints  # [Q] true cells

    @classmethod
    def from_source(cls, source: Source, spacing_m: float = QUERY_SPACING_M) -> "TrainingSite":
        """Return the site of a source, with queries from the map and from the map as a scan shows it."""
        scan, queries = source.as_scan(), source.queries(VALIDATION_SEED, spacing_m)
        if scan is not source:
            queries = Queries.concatenate([queries, scan.queries(VALIDATION_SEED, spacing_m)])
        data, hints = source.data, queries.hints
        assert hints is not None
        surroundings = build_neighbour_index(source.geometry(), data.cells)
        labels, label = surroundings.objects.labels(data.gallery)
        return cls(
            surroundings=surroundings,
            cells=replace(data.cells, sample=None),  # drops the points of the map
            label=label,
            labels=labels,
            palette=data.palette,
            hints=hints,
            positions_m=queries.positions_m,
            truth=queries.truth,
        )

    def posterior(self, likelihood: Likelihood) -> HintPosterior:
        """Return the posterior of the gallery."""
        return HintPosterior(likelihood, self.surroundings, self.cells, self.label, self.palette)

    def read(
        self, model: PosteriorModel, rows: Ints, grammars: Sequence[Grammar | None], rng: np.random.Generator
    ) -> list[BoundHints]:
        """Write and read texts about some positions.

        Some texts contain a false fact (`SLIP_SHARE`), fewer facts (`OMISSION_SHARE`), or distant things
        (`DISTANT_SHARE`). A grammar is drawn for each text; None is the wording of the benchmark.
        """
        binding = Binding(model.matcher, self.labels, self.palette)
        wordings = {grammar: Wording(grammar or "train") for grammar in grammars}
        texts = []
        for row in rows:
            grammar = grammars[int(rng.integers(len(grammars)))]
            facts = [ObjectFact(hint.label, hint.direction, hint.colour) for hint in self.hints[row]]
            if rng.random() < SLIP_SHARE:
                facts = _slip(facts, self.palette, self.labels, rng)
            if rng.random() < OMISSION_SHARE and len(facts) > MIN_FACTS:
                facts = [facts[n] for n in rng.permutation(len(facts))[: int(rng.integers(MIN_FACTS, len(facts)))]]
            if grammar and rng.random() < DISTANT_SHARE:
                facts += self._distant_facts(int(row), rng)
            wording = wordings[grammar]
            texts.append((wording.write(facts, rng) if grammar else wording.published(facts)).text)
        bound_hints = []
        for start in range(0, len(texts), TEXTS_PER_BATCH):
            read = model.reader.read(texts[start : start + TEXTS_PER_BATCH])
            bound_hints += [binding.bind(hints) if hints else binding.uninformative_hint() for hints in read]
        return bound_hints

    def _distant_facts(self, row: int, rng: np.random.Generator) -> list[ObjectFact]:
        """Return one or two facts from the hints of positions some tens of metres away."""
        scenes = np.asarray(self.cells.scenes)[self.truth]
        offset_m = self.positions_m[row] - self.positions_m
        distance_m = np.hypot(*offset_m.T)
        others = np.flatnonzero((distance_m > DISTANT_M[0]) & (distance_m < DISTANT_M[1]) & (scenes == scenes[row]))
        facts = []
        for n in rng.permutation(others)[: int(rng.integers(1, 3))]:
            hint = self.hints[n][int(rng.integers(len(self.hints[n])))]
            wind = compass_name(float(np.degrees(np.arctan2(*offset_m[n]))))
            stated_m = float(distance_m[n].round()) if rng.random() < MEASURED_SHARE else None
            facts.append(ObjectFact(hint.label, wind, hint.colour, distance_m=stated_m))
        return facts


def _slip(
    facts: Sequence[ObjectFact], palette: Palette, labels: Sequence[str], rng: np.random.Generator
) -> list[ObjectFact]:
    """Return facts of which one has a wrong class, or a wrong direction and colour."""
    n = int(rng.integers(len(facts)))
    fact = facts[n]
    if rng.random() < CLASS_SLIP_SHARE:
        others = [label for label in labels if label != fact.label] or [fact.label]
        return [*facts[:n], replace(fact, label=others[int(rng.integers(len(others)))]), *facts[n + 1 :]]
    winds = [wind for wind in DIRECTIONS[:4] if wind != fact.relation]
    words = [word for word in dict.fromkeys(palette.words) if word != fact.colour]
    colour = words[int(rng.integers(len(words)))] if fact.colour else None
    wrong = replace(fact, relation=winds[int(rng.integers(len(winds)))], colour=colour)
    return [*facts[:n], wrong, *facts[n + 1 :]]
