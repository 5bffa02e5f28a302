"""The hint posterior on one gallery: reading, candidates, positions, evidence."""

from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt
import torch

from index.answers import Evidence
from index.gallery import Gallery
from models.city.colours import Palette
from models.city.points import ranges
from models.language.landmarks import Landmarks
from models.language.parsed_hint import RELATIONS, ParsedHint
from models.language.reader import COLOURS
from models.posterior.binding import Binding
from models.posterior.likelihood import Reading
from models.posterior.locate import Located, locate
from models.posterior.model import PosteriorModel
from models.posterior.posterior import HintPosterior, LogPrior
from models.posterior.surroundings import SPACING_M, STEP_M, Surroundings

LONGEST = 800  # characters that are read at once; longer descriptions are read in pieces
KEPT_TEXTS = 2000
READ_AT_ONCE = 16
EXPLAINED = 0.5  # a hint counts as explained from this probability on


class MapPosterior:
    """Answers descriptions of one gallery. Not thread-safe.

    Args:
        model: trained.
        gallery: the cells, with labels and names.
        palette: the map's colour words.
        surroundings: of the gallery.
    """

    def __init__(self, model: PosteriorModel, gallery: Gallery, palette: Palette, surroundings: Surroundings) -> None:
        self.model, self.gallery, self.surroundings, self._palette = model, gallery, surroundings, palette
        self.labels, number = np.unique(np.array(gallery.labels), return_inverse=True)
        label = number.astype(np.int64)[gallery.cells.parts.instance]
        self.posterior = HintPosterior(model.likelihood, surroundings, gallery.cells, label, palette)
        self.binding = Binding(model.matcher, self.labels.tolist(), palette)
        self.landmarks = Landmarks(gallery.names)
        self.extent_m = float(np.linalg.norm(np.ptp(gallery.cells.center_m[:, :2], axis=0)) + gallery.cells.size_m)
        self._noticed: OrderedDict[str, tuple[ParsedHint, ...]] = OrderedDict()

    def take(self, rows: npt.NDArray[np.intp]) -> "MapPosterior":
        """The same of some cells of the gallery."""
        parts = self.gallery.cells.parts
        kept = ranges(parts.starts[rows], parts.starts[rows + 1])
        part_of = np.full(len(parts.instance), -1)
        part_of[kept] = np.arange(len(kept))
        gallery = replace(self.gallery, cells=self.gallery.cells.take(rows))
        return MapPosterior(self.model, gallery, self._palette, self.surroundings.take(rows, part_of))

    def notice(self, hints: Sequence[str]) -> tuple[ParsedHint, ...]:
        """What a description names; sentences are read together, so that one may speak of another's thing."""
        return tuple(thing for piece in _pieces(hints) for thing in self._read([piece])[0])

    def read_ahead(self, descriptions: Sequence[Sequence[str]]) -> None:
        """Read many descriptions at once, so that `notice` of them costs nothing."""
        self._read([piece for hints in descriptions for piece in _pieces(hints)])

    def _read(self, texts: Sequence[str]) -> list[tuple[ParsedHint, ...]]:
        """What each text names; the latest texts are remembered."""
        noticed = self._noticed
        new = sorted({text for text in texts if text not in noticed}, key=len)  # those of like length together
        for start in range(0, len(new), READ_AT_ONCE):
            some = new[start : start + READ_AT_ONCE]
            noticed.update((text, tuple(found)) for text, found in zip(some, self.model.reader.read(some), strict=True))
        for text in texts:
            noticed.move_to_end(text)
        found = [noticed[text] for text in texts]
        while len(noticed) > KEPT_TEXTS:
            noticed.popitem(last=False)
        return found

    def reading(self, noticed: Sequence[ParsedHint]) -> Reading:
        """Hints in the map's own labels, colours and names; of no hint, one that anything fits."""
        if not noticed:
            return self.binding.nothing()
        reading = self.binding.reading(noticed)
        for n, thing in enumerate(noticed):
            found = self.landmarks.meant_by(thing.noun)
            if found:
                bears = np.isin(self.gallery.cells.parts.instance, found)
                reading.named[n] = torch.from_numpy(bears)
        return reading

    def locate(
        self,
        reading: Reading,
        log_prior: LogPrior | None = None,
        inside: npt.NDArray[np.bool_] | None = None,
    ) -> Located | None:
        """See `models.posterior.locate.locate`."""
        return locate(self.posterior, reading, log_prior, inside)

    def radii_m(self, located: Located) -> tuple[float, float]:
        """Radii round the first position that hold the truth with probability .5 and .9."""
        scale = self.model.config.radius_scale
        p50, p90 = located.radii_m((0.5, 0.9), self.extent_m, SPACING_M)
        return min(p50 * scale, self.extent_m), min(p90 * scale, self.extent_m)

    def evidence(self, noticed: Sequence[ParsedHint], reading: Reading, located: Located) -> tuple[Evidence, ...]:
        """How each hint was understood, and what explains it at the best position."""
        node = int(located.nodes[((located.nodes_m - located.positions[0]) ** 2).sum(axis=1).argmin()])
        found = self.posterior.explain(reading, node)
        return tuple(self._evidence(*row, node) for row in zip(noticed, reading.label, found, strict=True))

    def _evidence(self, thing: ParsedHint, label: Any, found: tuple[int, float], node: int) -> Evidence:
        part, explained = found
        colour = int(thing.colour.argmax())
        shown: dict[str, Any] = {}
        if part >= 0 and explained >= EXPLAINED and thing.absent < EXPLAINED:
            gallery, s = self.gallery, self.surroundings
            instance = int(gallery.cells.parts.instance[part])
            rows = np.arange(s.starts[node], s.starts[node + 1])
            way = s.way[rows[s.part[rows] == part][0]].astype(np.float64) * STEP_M
            shown = {
                "instance": gallery.labels[instance],
                "name": gallery.names[instance],
                "source_id": gallery.sources[instance],
                "away_m": float(np.hypot(*way)),
            }
        fits = float(label.max()) >= EXPLAINED / 2
        return Evidence(
            text=thing.noun,
            label=str(self.labels[int(label.argmax())]) if fits else None,
            colour=COLOURS[colour] if colour < len(COLOURS) else None,
            relation=RELATIONS[int(thing.relation.argmax())],
            distance_m=thing.distance_m,
            absent=thing.absent >= EXPLAINED,
            explained=explained,
            **shown,
        )


def _pieces(hints: Sequence[str]) -> list[str]:
    """A description as texts that the reader takes whole."""
    pieces = [""]
    for hint in hints:
        sentence = hint if hint.endswith((".", "!", "?", ";", ":")) else hint + "."
        if pieces[-1] and len(pieces[-1]) + len(sentence) > LONGEST:
            pieces.append("")
        pieces[-1] = f"{pieces[-1]} {sentence}".strip()
    return pieces
