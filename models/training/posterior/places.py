"""Maps with texts, read as they would be in service: what the hint posterior is fitted to and calibrated on."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from models.city.cells import CellTable
from models.city.colours import Palette
from models.city.points import Ints
from models.city.queries import Queries
from models.city.source import Source
from models.city.types import DIRECTIONS, Floats, Hint
from models.language.grammar.files import Grammar
from models.language.grammar.labelled_text import Fact
from models.language.grammar.wording import Wording
from models.posterior.binding import Binding
from models.posterior.likelihood import Likelihood, Reading
from models.posterior.model import PosteriorModel
from models.posterior.posterior import HintPosterior
from models.posterior.surroundings import Surroundings

READ_AT_ONCE = 16
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

    @classmethod
    def of(cls, source: Source, queries: Queries) -> "Place":
        """A source with what is asked of it."""
        data, hints = source.data, queries.hints
        assert hints is not None
        labels, number = np.unique(data.gallery.labels, return_inverse=True)
        return cls(
            surroundings=Surroundings.of(source.bodies(), data.cells),
            cells=replace(data.cells, sample=None),  # lets go of the map's points
            label=number.astype(np.int64)[data.cells.parts.instance],
            labels=tuple(labels.tolist()),
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
