"""Maps with texts, read as they would be in service: what the hint posterior is fitted to and calibrated on."""

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
from models.language.grammar.labelled_text import Fact
from models.language.grammar.wording import Wording
from models.language.measures import compass_name
from models.posterior.binding import Binding
from models.posterior.likelihood import Likelihood, Reading
from models.posterior.model import PosteriorModel
from models.posterior.neighbours.neighbour_index import Surroundings, surroundings_of
from models.posterior.posterior import HintPosterior
from models.sources.source import QUERY_SPACING_M, VALIDATION_SEED, Source

READ_AT_ONCE = 16
SLIPS = 0.15  # share of the texts that say something wrong, as people do
FEWER, FEWEST = 0.3, 2  # share of the texts that tell of less, and of how few things
DISTANT, DISTANT_M = 0.2, (20.0, 60.0)  # share of the texts in free wording that also tell of what is so far away
MEASURED = 0.5  # of that, with its distance
SLIPS_OF_CLASS = 0.4  # of those, that name something else; the others give another direction and colour


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """A map (or a part of it) with what was said in it.

    Attributes:
        surroundings, cells: of the gallery.
        label: [P] number of the label of each of the surroundings' things.
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

    @classmethod
    def of(cls, source: Source, spacing_m: float = QUERY_SPACING_M) -> "Place":
        """A source with what is said in it: by who knows the map, and by who looks at it as a scan shows it."""
        scan, told = source.as_scan(), [source.queries(VALIDATION_SEED, spacing_m)]
        queries = Queries.concatenate(told if scan is source else [*told, scan.queries(VALIDATION_SEED, spacing_m)])
        data, hints = source.data, queries.hints
        assert hints is not None
        surroundings = surroundings_of(source.geometry(), data.cells)
        labels, label = surroundings.things.labels(data.gallery)
        return cls(
            surroundings=surroundings,
            cells=replace(data.cells, sample=None),  # lets go of the map's points
            label=label,
            labels=labels,
            palette=data.palette,
            hints=hints,
            positions_m=queries.positions_m,
            truth=queries.truth,
        )

    def posterior(self, likelihood: Likelihood) -> HintPosterior:
        """The posterior of this gallery."""
        return HintPosterior(likelihood, self.surroundings, self.cells, self.label, self.palette)

    def read(
        self, model: PosteriorModel, rows: Ints, grammars: Sequence[Grammar | None], rng: np.random.Generator
    ) -> list[Reading]:
        """Texts about some positions, worded and read.

        Some of them say something wrong (`SLIPS`), tell of less (`FEWER`), or of what is further off (`DISTANT`).

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
            if rng.random() < FEWER and len(facts) > FEWEST:
                facts = [facts[n] for n in rng.permutation(len(facts))[: int(rng.integers(FEWEST, len(facts)))]]
            if grammar and rng.random() < DISTANT:
                facts += self._further_off(int(row), rng)
            wording = wordings[grammar]
            texts.append((wording.write(facts, rng) if grammar else wording.published(facts)).text)
        readings = []
        for start in range(0, len(texts), READ_AT_ONCE):
            read = model.reader.read(texts[start : start + READ_AT_ONCE])
            readings += [binding.reading(noticed) if noticed else binding.nothing() for noticed in read]
        return readings

    def _further_off(self, row: int, rng: np.random.Generator) -> list[Fact]:
        """One or two things that are told of at other positions, some tens of metres away."""
        scenes = np.asarray(self.cells.scenes)[self.truth]
        way = self.positions_m[row] - self.positions_m
        metres = np.hypot(*way.T)
        others = np.flatnonzero((metres > DISTANT_M[0]) & (metres < DISTANT_M[1]) & (scenes == scenes[row]))
        facts = []
        for n in rng.permutation(others)[: int(rng.integers(1, 3))]:
            hint = self.hints[n][int(rng.integers(len(self.hints[n])))]
            wind = compass_name(float(np.degrees(np.arctan2(*way[n]))))
            said = float(metres[n].round()) if rng.random() < MEASURED else None
            facts.append(Fact(hint.label, wind, hint.colour, distance_m=said))
        return facts


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
