"""The hint posterior on one gallery: a description read, candidates from the vector index and the inverted list."""

import time
from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import torch

from index.answers import Evidence, Method, ModelName, Query
from index.filters import inside, log_prior
from index.finding import Finding
from index.ranking import Ranker
from models.city.colours import Palette
from models.city.frame import Frame
from models.city.gallery import Gallery, MapData
from models.city.points import Ints, ranges
from models.language.landmarks import Landmarks
from models.language.parsed_hint import RELATIONS, ParsedHint
from models.language.reader import COLOURS
from models.language.sentences import reader_texts
from models.localization.located import Located
from models.posterior.binding import Binding
from models.posterior.likelihood import Reading
from models.posterior.locate import locate
from models.posterior.model import PosteriorModel
from models.posterior.posterior import CANDIDATES, HintPosterior
from models.posterior.surroundings import STEP_M, Surroundings

LONGEST = 800  # characters that are read at once; longer descriptions are read in pieces
KEPT_TEXTS = 2000
READ_AT_ONCE = 16
EXPLAINED = 0.5  # a hint counts as explained from this probability on
NOTHING_SAID = (
    "nothing in the description says what is around the speaker; name things and directions, for example "
    "'I am north of a gray building.'"
)
NOWHERE = "no position of the map lies inside 'within'; move it onto the map or leave it out"
NOTHING_FITS = "nothing that is said was found on the map; is it the right map?"


class PosteriorLocalizer:
    """Answers descriptions of one gallery by the hint posterior. Not thread-safe.

    Args:
        model: trained.
        gallery: the cells, with labels and names.
        palette: the map's colour words.
        frame: of the map.
        surroundings: of the gallery.
        ranker: of the gallery: gives candidates beside the inverted list's.
    """

    method: Method = "posterior"

    def __init__(
        self,
        model: PosteriorModel,
        gallery: Gallery,
        palette: Palette,
        frame: Frame,
        surroundings: Surroundings,
        ranker: Ranker,
    ) -> None:
        self.weights, self.gallery, self.frame, self.ranker = model, gallery, frame, ranker
        self.surroundings, self._palette = surroundings, palette
        self.model = ModelName(model.name, model.fingerprint)  # once: it reads all weights
        self.labels, number = np.unique(np.array(gallery.labels), return_inverse=True)
        label = number.astype(np.int64)[gallery.cells.parts.instance]
        self.nodes = HintPosterior(model.likelihood, surroundings, gallery.cells, label, palette)
        self.binding = Binding(model.matcher, self.labels.tolist(), palette)
        self.landmarks = Landmarks(gallery.names)
        self._read_lately: OrderedDict[str, tuple[ParsedHint, ...]] = OrderedDict()

    @classmethod
    def of_map(
        cls, model: PosteriorModel, data: MapData, ranker: Ranker, surroundings: Surroundings
    ) -> "PosteriorLocalizer":
        """On a map that is no index."""
        return cls(model, data.gallery, data.palette, data.frame, surroundings, ranker)

    def take(self, rows: Ints) -> "PosteriorLocalizer":
        """See CellLocalizer."""
        parts = self.gallery.cells.parts
        kept = ranges(parts.starts[rows], parts.starts[rows + 1])
        part_of = np.full(len(parts.instance), -1)
        part_of[kept] = np.arange(len(kept))
        gallery = replace(self.gallery, cells=self.gallery.cells.take(rows))
        surroundings, ranker = self.surroundings.take(rows, part_of), self.ranker.take(rows)
        return PosteriorLocalizer(self.weights, gallery, self._palette, self.frame, surroundings, ranker)

    def find(self, queries: Sequence[Query]) -> list[Finding]:
        """See CellLocalizer."""
        start = time.perf_counter()
        parsed = self.parse([query.description for query in queries])
        encode_ms = _since(start)
        return [self._find(*each, encode_ms) for each in zip(queries, parsed, strict=True)]

    def _find(self, query: Query, hints: Sequence[ParsedHint], encode_ms: float) -> Finding:
        if not hints:
            return Finding(None, NOTHING_SAID, timings_ms={"encode": encode_ms})
        start = time.perf_counter()
        reading = self.reading(hints)
        timings = {"encode": encode_ms + _since(start)}
        start = time.perf_counter()
        nodes_m, frame = self.nodes.nodes_m, self.frame
        located = locate(
            self.nodes,
            reading,
            None if query.prior is None else lambda points_m: log_prior(query, points_m, frame),
            None if query.within is None else inside(query, nodes_m, frame),
            also=self.candidates(hints, reading),
        )
        timings["search"] = _since(start)
        if located is None:
            return Finding(None, NOWHERE, timings_ms=timings)
        located = replace(located, radius_scale=self.weights.config.radius_scale)
        start = time.perf_counter()
        evidence = self._evidence(hints, reading, located)
        timings["estimate"] = _since(start)
        fits = any(hint.explained >= EXPLAINED for hint in evidence)
        return Finding(located, None if fits else NOTHING_FITS, evidence, timings)

    def candidates(self, hints: Sequence[ParsedHint], reading: Reading) -> Ints:
        """[A] the cells that the vector index finds for hints, in the retriever's words."""
        sentences = self.binding.sentences(hints, reading)
        if not sentences:
            return np.empty(0, np.int64)
        text = self.ranker.retriever.encode_description(sentences)
        rows: Ints = self.ranker.search([text], CANDIDATES)[1][0]
        return rows

    def sentences(self, descriptions: Sequence[str]) -> list[tuple[str, ...]]:
        """Descriptions in the retriever's words, as far as they were read: template sentences of the map's classes."""
        return [
            self.binding.sentences(hints, self.reading(hints)) if hints else () for hints in self.parse(descriptions)
        ]

    def parse(self, descriptions: Sequence[str]) -> list[tuple[ParsedHint, ...]]:
        """What each description names; several go through the reader together, the latest are remembered."""
        pieces = [reader_texts(description, LONGEST) for description in descriptions]
        texts = [text for some in pieces for text in some]
        kept = self._read_lately
        new = sorted({text for text in texts if text not in kept}, key=len)  # those of like length together
        for start in range(0, len(new), READ_AT_ONCE):
            some = new[start : start + READ_AT_ONCE]
            kept.update((text, tuple(found)) for text, found in zip(some, self.weights.reader.read(some), strict=True))
        for text in texts:
            kept.move_to_end(text)
        parsed = [tuple(hint for text in some for hint in kept[text]) for some in pieces]
        while len(kept) > KEPT_TEXTS:
            kept.popitem(last=False)
        return parsed

    def reading(self, hints: Sequence[ParsedHint]) -> Reading:
        """Hints, at least one, in the map's own labels, colours and names."""
        reading = self.binding.reading(hints)
        for n, hint in enumerate(hints):
            found = self.landmarks.meant_by(hint.noun)
            if found:
                bears = np.isin(self.gallery.cells.parts.instance, found)
                reading.named[n] = torch.from_numpy(bears)
        return reading

    def _evidence(self, hints: Sequence[ParsedHint], reading: Reading, located: Located) -> tuple[Evidence, ...]:
        """How each hint was understood, and what explains it at the best position."""
        node = int(located.points[((located.points_m - located.positions[0]) ** 2).sum(axis=1).argmin()])
        found = self.nodes.explain(reading, node)
        return tuple(self._explained(*row) for row in zip(hints, reading.label, found, strict=True))

    def _explained(self, hint: ParsedHint, label: Any, found: tuple[int, float]) -> Evidence:
        row, explained = found
        colour = int(hint.colour.argmax())
        shown: dict[str, Any] = {}
        if row >= 0 and explained >= EXPLAINED and hint.absent < EXPLAINED:
            gallery, s = self.gallery, self.surroundings
            instance = int(gallery.cells.parts.instance[s.part[row]])
            way = s.way[row].astype(np.float64) * STEP_M
            shown = {
                "instance": gallery.labels[instance],
                "name": gallery.names[instance],
                "source_id": gallery.sources[instance],
                "away_m": float(np.hypot(*way)),
            }
        fits = float(label.max()) >= EXPLAINED / 2
        return Evidence(
            text=hint.noun,
            label=str(self.labels[int(label.argmax())]) if fits else None,
            colour=COLOURS[colour] if colour < len(COLOURS) else None,
            relation=RELATIONS[int(hint.relation.argmax())],
            distance_m=hint.distance_m,
            absent=hint.absent >= EXPLAINED,
            explained=explained,
            **shown,
        )


def _since(start: float) -> float:
    return (time.perf_counter() - start) * 1000
