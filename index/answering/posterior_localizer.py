"""The hint posterior on one gallery: a description read, candidates from the vector index and the inverted list."""

import time
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from index.answering.answers import Evidence, Method, ModelName, Question
from index.answering.filters import log_prior, where_inside
from index.answering.meanings import Meanings
from index.answering.place_reader import PlaceReader, may_be_near, near_hints, with_one_owner
from index.answering.place_text import place_text
from index.answering.query import Query
from index.answering.ranking import Ranker
from index.answering.result import Finding, is_ambiguous, pair
from index.answering.text_chunks import Texts, as_read, in_the_text
from index.asking.known_facts import Heard
from index.asking.questions import Questions
from models.citymap.colours import Palette
from models.citymap.frame import Frame
from models.citymap.gallery import Gallery
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, Gazetteer
from models.citymap.points import Ints
from models.language.mentions.contradictions import contradictions
from models.language.mentions.languages import ENGLISH, LANGUAGE_NAMES, detect_language
from models.language.mentions.mentions import Mention
from models.language.mentions.name_table import NameTable
from models.language.mentions.reader import is_meeting, listener_wind
from models.language.parsed_hint import RELATIONS, ParsedHint
from models.language.reader import COLOURS
from models.paper.levels import Levels
from models.posterior.area_filter import Inside
from models.posterior.binding import Binding
from models.posterior.distribution import Located
from models.posterior.likelihood import Reading
from models.posterior.locate import locate
from models.posterior.model import PosteriorConfig, PosteriorModel
from models.posterior.neighbours.neighbour_index import NeighbourIndex
from models.posterior.places.field import PlaceEvidence
from models.posterior.places.landmarks import Landmarks
from models.posterior.posterior import CANDIDATES, HintExplanation, HintPosterior
from models.posterior.questions import Answered
from models.posterior.statements import Statements

KEPT_VECTORS = 256  # of descriptions, the latest
PLACE_CANDIDATES = 128  # cells whose nodes are looked at for texts that name places
REPLY_CANDIDATES = 1024  # where replies are all that is known: they may name a street of some kilometres
EXPLAINED = 0.5  # a hint counts as explained from this probability on
NOTHING_SAID = (
    "nothing in the description says what is around the speaker; name things and directions, for example "
    "'I am north of a gray building.'"
)
NOWHERE = "no position of the map lies inside 'within'; move it onto the map or leave it out"
NOTHING_FITS = "nothing that is said was found on the map; is it the right map?"
OF_REPLIES = "the answer is of the replies: nothing that the description says was found there"
GOOD_M = 10.0  # who has begun to reply is asked until half of the probability is this near


class PosteriorLocalizer:
    """Answers descriptions of one gallery by the hint posterior. Not thread-safe.

    Args:
        model: trained.
        gallery: the cells, with labels and names.
        palette: the map's colour words.
        frame: of the map.
        surroundings: of the gallery.
        ranker: of the gallery: gives candidates beside the inverted list's.
        gazetteer: of the map; empty where nothing has a name.
        grid_m: spacing of the cells.
        meanings: of the gazetteer; None to understand its names and nouns alone.
        statements, names, landmarks: of the gallery and its gazetteer; None to make them.
    """

    method: Method = "posterior"

    def __init__(
        self,
        model: PosteriorModel,
        gallery: Gallery,
        palette: Palette,
        frame: Frame,
        surroundings: NeighbourIndex,
        ranker: Ranker,
        gazetteer: Gazetteer = EMPTY_GAZETTEER,
        grid_m: float = 10.0,
        meanings: Meanings | None = None,
        statements: Statements | None = None,
        names: NameTable | None = None,
        landmarks: Landmarks | None = None,
    ) -> None:
        self.weights, self.gallery, self.frame, self.ranker = model, gallery, frame, ranker
        self.surroundings, self._gazetteer = surroundings, gazetteer
        self.model = ModelName(model.name, model.fingerprint)  # once: it reads all weights
        labels, label = surroundings.things.labels(gallery)
        self.nodes = HintPosterior(model.likelihood, surroundings, gallery.cells, label, palette, statements)
        self.labels = labels
        self.binding = Binding(model.matcher, list(labels), palette)
        self.places: PlaceReader | None = None
        if len(gazetteer):
            centers_m = gallery.cells.center_m[:, :2].astype(np.float64)
            of_map = gazetteer, model.text_encoder, centers_m, grid_m, meanings, names
            self.places = PlaceReader(model.places, model.cues, *of_map)
        self.questions = Questions(self.nodes.sights, list(self.labels), palette, gazetteer, gallery.cells, landmarks)
        self.texts = Texts(model.reader)
        self._encoded = lru_cache(maxsize=KEPT_VECTORS)(self._encode)

    def find(self, queries: Sequence[Query]) -> list[Finding]:
        """See CellLocalizer."""
        start = time.perf_counter()
        parsed = self.texts.parse([query.description for query in queries])
        encode_ms = _since(start)
        return [self._find(*each, encode_ms) for each in zip(queries, parsed, strict=True)]

    def _find(self, query: Query, hints: Sequence[ParsedHint], encode_ms: float) -> Finding:
        start = time.perf_counter()
        answered = self.questions.answered(query.replies)
        language = detect_language(query.description)
        hints = hints if language == ENGLISH else []
        warnings = _of_language(language)
        hints, reading, mentions, told = self._places(query, language, hints)
        timings = {"encode": encode_ms + _since(start)}
        warnings += (*_not_found(mentions), *contradictions(mentions))
        heard = Heard.of(reading, mentions, list(self.labels), self._gazetteer)
        if not hints and told is None and answered is None:
            said, question = NOTHING_FITS if mentions else NOTHING_SAID, self._rescue(query, language, heard)
            return Finding(None, said, timings_ms=timings, warnings=warnings, question=question)
        start = time.perf_counter()
        located = self._located(query, hints, reading, told, answered)
        timings["search"] = _since(start)
        if located is None:
            return Finding(None, NOWHERE, timings_ms=timings, warnings=warnings)
        start = time.perf_counter()
        finding = self._told_of(located, hints, reading, mentions, told)
        finding = replace(finding, evidence=in_the_text(query.description, finding.evidence))
        fits = any(hint.explained >= EXPLAINED for hint in finding.evidence)
        if not fits and answered is not None:
            warnings += (OF_REPLIES,)
        if not fits and answered is None and finding.evidence:
            finding = replace(finding, refusal=NOTHING_FITS, question=self._rescue(query, language, heard))
        elif self._is_wide(located, answered) and not _is_elsewhere(query):
            finding = replace(finding, question=self.questions.ask(located, heard, query.replies))
        timings["estimate"] = _since(start)
        return replace(finding, timings_ms=timings, warnings=warnings)

    def _is_wide(self, located: Located, answered: Answered | None) -> bool:
        """Whether more should be known of a place."""
        p50 = located.radii_m(0.5)[0]
        return is_ambiguous(p50, self.gallery.cells) or (answered is not None and p50 > GOOD_M)

    def _rescue(self, query: Query, language: str, heard: Heard) -> Question | None:
        """What to ask about a refused text; nothing on a map without names, and of a text that is not in English."""
        if not self.questions.has_names or language != ENGLISH or _is_elsewhere(query):
            return None
        log_p, inside = log_prior(query, self.gallery.cells.center_m[:, :2], self.frame), self._inside(query)
        log_p = log_p if inside is None else np.where(inside.cells, log_p, -np.inf)
        return self.questions.ask_anywhere(log_p, heard, query.replies)

    def _told_of(
        self,
        located: Located,
        hints: Sequence[ParsedHint],
        reading: Reading | None,
        mentions: Sequence[Mention],
        told: PlaceEvidence | None,
    ) -> Finding:
        """What was found, with what explains each hint and mention there, and the place in words."""
        evidence = self._evidence(hints, reading, located) if reading is not None else ()
        if self.places is None:
            return Finding(located, evidence=evidence)
        at = located.positions[0]
        evidence += self.places.evidence(mentions, told, at)
        place, heading = place_text(self._gazetteer, at), self.places.heading(told, located)
        return Finding(located, evidence=evidence, place=place, heading=heading)

    def _places(
        self, query: Query, language: str, hints: Sequence[ParsedHint]
    ) -> tuple[Sequence[ParsedHint], Reading | None, list[Mention], PlaceEvidence | None]:
        """The hints that tell of what is near, what they say, what the text names besides, and what that tells."""
        if self.places is None:
            return hints, self.binding.reading(hints) if hints else None, [], None
        listener_m = None if query.prior is None else self.frame.position_m(query.prior.position, query.crs)
        text = as_read(query.description)
        nouns = [(hint.start, hint.end) for hint in hints]
        mentions = self.places.read(text, language, nouns, to_listener=listener_m is not None)
        hints = [] if mentions and _is_elsewhere(query) else may_be_near(hints, mentions)
        reading = self.binding.reading(hints) if hints else None
        trust = [] if reading is None else reading.label.amax(dim=1).tolist()
        near, mentions = near_hints(hints, trust, mentions)
        hints, mentions = with_one_owner(text, [hints[n] for n in near], mentions)
        told = self.places.told(mentions, query.description, listener_m)
        return hints, self.binding.reading(hints) if hints else None, mentions, told

    def _located(
        self,
        query: Query,
        hints: Sequence[ParsedHint],
        reading: Reading | None,
        told: PlaceEvidence | None,
        answered: Answered | None,
    ) -> Located | None:
        count = REPLY_CANDIDATES if reading is None else CANDIDATES
        located = locate(
            self.nodes,
            reading,
            None if query.prior is None else lambda points_m: log_prior(query, points_m, self.frame),
            self._inside(query),
            PLACE_CANDIDATES if told is not None else count,
            further=None if reading is None else self.search(hints, reading),
            told=told,
            answered=answered,
        )
        return located and self._honest(located, query, told)

    def _inside(self, query: Query) -> Inside | None:
        return where_inside(query, self.surroundings, self.gallery.cells.center_m[:, :2], self.frame)

    def _honest(self, located: Located, query: Query, told: PlaceEvidence | None) -> Located:
        """With radii that hold what they say, as on validation data."""
        config: PosteriorConfig = self.weights.config
        if told is None:
            return replace(located, held=config.radius_held)
        is_told_to = query.prior is not None or is_meeting(query.description)
        return replace(located, radius_scale=config.meeting_scale if is_told_to else config.place_scale)

    def search(self, hints: Sequence[ParsedHint], reading: Reading) -> Ints:
        """Return the cells [A] that the vector index finds for hints in the retriever's words."""
        sentences = self.binding.sentences(hints, reading)
        if not sentences:
            return np.empty(0, np.int64)
        rows: Ints = self.ranker.search([self._encoded(sentences)], CANDIDATES)[1][0]
        return rows

    def _encode(self, sentences: tuple[str, ...]) -> Levels:
        return self.ranker.retriever.encode_description(sentences)

    def sentences(self, descriptions: Sequence[str]) -> list[tuple[str, ...]]:
        """Descriptions in the retriever's words, as far as they were read: template sentences of the map's classes."""
        return [
            self.binding.sentences(hints, self.binding.reading(hints)) if hints else ()
            for hints in self.texts.parse(descriptions)
        ]

    def _evidence(self, hints: Sequence[ParsedHint], reading: Reading, located: Located) -> tuple[Evidence, ...]:
        """How each hint was understood, and what explains it at the best position."""
        node = int(located.points[((located.points_m - located.positions[0]) ** 2).sum(axis=1).argmin()])
        found = self.nodes.explain(reading, node)
        return tuple(self._explained(node, *row) for row in zip(hints, reading.label, found, strict=True))

    def _explained(self, node: int, hint: ParsedHint, label: Any, found: HintExplanation) -> Evidence:
        explained = found.probability
        colour = int(hint.colour.argmax())
        shown: dict[str, Any] = {}
        if found.part >= 0 and explained >= EXPLAINED and hint.absent < EXPLAINED:
            gallery = self.gallery
            instance = int(self.surroundings.things.instance[found.part])
            shown = {
                "at": pair(self.surroundings.positions_m(np.array([node]))[0] - found.way_m),
                "instance": gallery.labels[instance],
                "name": gallery.names[instance],
                "source_id": gallery.sources[instance],
                "away_m": float(np.hypot(*found.way_m)),
            }
        fits = float(label.max()) >= EXPLAINED / 2
        return Evidence(
            text=hint.noun,
            span=(hint.start, hint.end),
            label=str(self.labels[int(label.argmax())]) if fits else None,
            colour=COLOURS[colour] if colour < len(COLOURS) else None,
            relation=RELATIONS[int(hint.relation.argmax())],
            distance_m=hint.distance_m,
            absent=hint.absent >= EXPLAINED,
            explained=explained,
            **shown,
        )


def _is_elsewhere(query: Query) -> bool:
    """Whether a text surely tells of a place that the speaker does not stand at: what it names need not be near."""
    is_told = query.prior is not None and listener_wind(query.description) is not None
    return is_told or is_meeting(query.description)


def _of_language(language: str) -> tuple[str, ...]:
    if language == ENGLISH:
        return ()
    name = LANGUAGE_NAMES.get(language, f"'{language}'")
    return (f"the text seems to be in {name}: only names and nouns were understood; English is read whole",)


def _not_found(mentions: Sequence[Mention]) -> tuple[str, ...]:
    return tuple(f"'{mention.text}' was not found on the map" for mention in mentions if mention.form == "unknown")


def _since(start: float) -> float:
    return (time.perf_counter() - start) * 1000
