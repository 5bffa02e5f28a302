"""The hint posterior in one gallery: parse a description, find candidates, locate, explain."""

import time
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from index.answering.answers import Evidence, Method, ModelName, Question
from index.answering.evidence_text import EXPLAINED_PROBABILITY, NOT_FOUND, NOT_ON_MAP, speaks_for, with_fit
from index.answering.filters import log_prior, nodes_inside
from index.answering.meanings import Meanings
from index.answering.place_reader import PlaceReader, near_hints, possibly_near_hints, with_one_owner
from index.answering.place_text import place_text
from index.answering.query import Query
from index.answering.ranking import Ranker
from index.answering.result import LocalizerResult, PlaceView, elapsed_ms, is_ambiguous, pair
from index.answering.text_chunks import ChunkReader, reader_text, with_description_spans
from index.asking.known_facts import KnownFacts
from index.asking.questions import Questions
from models.citymap.colours import Palette
from models.citymap.frame import Frame
from models.citymap.gallery import Gallery
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, Gazetteer
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.languages.detect import ENGLISH, LANGUAGE_NAMES, detect_languages
from models.language.languages.table import table_codes
from models.language.languages.translation import choose_language, replies_in, reply_language, translatable, translate
from models.language.mentions.contradictions import contradictions
from models.language.mentions.mentions import Mention
from models.language.mentions.name_table import NameTable
from models.language.mentions.reader import is_meeting, listener_wind
from models.language.parsed_hint import RELATIONS, ParsedHint
from models.language.reader import COLOURS
from models.language.sentences import without_capitals, without_repetition, without_speakers
from models.paper.levels import Levels
from models.posterior.area_filter import AreaFilter
from models.posterior.binding import Binding
from models.posterior.certainty import TextFacts
from models.posterior.distribution import PositionDistribution
from models.posterior.likelihood import BoundHints
from models.posterior.locate import locate
from models.posterior.model import PosteriorModel
from models.posterior.neighbours.neighbour_index import NeighbourIndex
from models.posterior.places.field import PlaceEvidence
from models.posterior.places.landmarks import Landmarks
from models.posterior.posterior import CANDIDATE_CELLS, HintExplanation, HintPosterior, PositionEvidence
from models.posterior.questions import ReplyEvidence
from models.posterior.statements import Statements

CACHED_DESCRIPTIONS = 256  # retriever vectors of the latest descriptions
PLACE_CANDIDATE_CELLS = 128  # examined cells for texts that name places
REPLY_CANDIDATE_CELLS = 1024  # without hints: a reply may name a street of some kilometres
MIN_MARGIN_NATS = 4.0  # of the first retrieved cell over the last; fitted on validation (docs/method.md#candidates)
NO_HINTS = translatable(
    "the description does not say what is around the speaker; mention objects and directions, for example "
    "'I am north of a gray building.'"
)
OUTSIDE_MAP = translatable("'within' contains no position of the map; move it onto the map or leave it out")
NO_MATCH = translatable("nothing in the description was found on the map; check that this is the right map")
UNKNOWN_LANGUAGE = translatable("a language that is not known here")
REPLIES_ONLY = translatable("the answer follows from the replies alone: nothing in the description was found there")
WELL_LOCATED_M = 10.0  # after a reply, questions go on until the 50 % radius is this small


class PosteriorLocalizer:
    """Localizes descriptions by the hint posterior. Not thread-safe."""

    method: Method = "posterior"

    def __init__(
        self,
        model: PosteriorModel,
        gallery: Gallery,
        palette: Palette,
        frame: Frame,
        surroundings: NeighbourIndex,
        ranker: Ranker,  # proposes the candidates
        gazetteer: Gazetteer = EMPTY_GAZETTEER,
        grid_m: float = 10.0,
        meanings: Meanings | None = None,  # None to go without paraphrases
        statements: Statements | None = None,  # these three are built if None
        names: NameTable | None = None,
        landmarks: Landmarks | None = None,
    ) -> None:
        self.weights, self.gallery, self.frame, self.ranker = model, gallery, frame, ranker
        self.surroundings, self._gazetteer = surroundings, gazetteer
        self.model = ModelName(model.name, model.fingerprint)  # once: it reads all weights
        labels, label = surroundings.objects.labels(gallery)
        self.nodes = HintPosterior(model.likelihood, surroundings, gallery.cells, label, palette, statements)
        self.labels = labels
        self.binding = Binding(model.matcher, list(labels), palette)
        self.places: PlaceReader | None = None
        if len(gazetteer):
            centers_m = gallery.cells.center_m[:, :2].astype(np.float64)
            map_arguments = gazetteer, model.text_encoder, centers_m, grid_m, meanings, names, frame
            self.places = PlaceReader(model.places, model.cues, *map_arguments)
        self.questions = Questions(
            self.nodes.nearby_objects, list(self.labels), palette, gazetteer, gallery.cells, landmarks
        )
        self.chunk_reader = ChunkReader(model.reader)
        self._encoded = lru_cache(maxsize=CACHED_DESCRIPTIONS)(self._encode)

    def find(self, queries: Sequence[Query]) -> list[LocalizerResult]:
        """Implement CellLocalizer."""
        start = time.perf_counter()
        texts = [without_capitals(without_repetition(without_speakers(query.description))) for query in queries]
        texts = texts if self.places is None else [self.places.without_city(text) for text in texts]
        queries = [replace(query, description=text) for query, text in zip(queries, texts, strict=True)]
        parsed = self.chunk_reader.parse([query.description for query in queries])
        encode_ms = elapsed_ms(start)
        return [self._find_in_language(*each, encode_ms) for each in zip(queries, parsed, strict=True)]

    def _find_in_language(self, query: Query, hints: Sequence[ParsedHint], encode_ms: float) -> LocalizerResult:
        start = time.perf_counter()
        languages = detect_languages(query.description)
        with replies_in(choose_language(query.language, languages)):
            result = self._find(query, languages, hints, encode_ms + elapsed_ms(start))
            return replace(result, language=reply_language())

    def _find(
        self, query: Query, languages: tuple[str, ...], hints: Sequence[ParsedHint], encode_ms: float
    ) -> LocalizerResult:
        start = time.perf_counter()
        reply_evidence = self.questions.reply_evidence(query.replies)
        hints = hints if languages == (ENGLISH,) else []
        warnings = _language_warnings(languages)
        hints, bound_hints, mentions, place_evidence = self._read(query, languages, hints)
        timings = {"encode": encode_ms + elapsed_ms(start)}
        warnings += (*(mention.warning for mention in mentions if mention.warning), *contradictions(mentions))
        known_facts = KnownFacts.from_text(bound_hints, mentions, list(self.labels), self._gazetteer)
        if not hints and place_evidence is None and reply_evidence is None:
            question = self._question_for_refused(query, known_facts)
            refusal = translate(NO_MATCH if mentions else NO_HINTS)
            return LocalizerResult(None, refusal, timings_ms=timings, warnings=warnings, question=question)
        start = time.perf_counter()
        located = self._locate(query, hints, bound_hints, place_evidence, reply_evidence)
        timings["search"] = elapsed_ms(start)
        if located is None:
            return LocalizerResult(None, translate(OUTSIDE_MAP), timings_ms=timings, warnings=warnings)
        start = time.perf_counter()
        result = self._explain(located, hints, bound_hints, mentions, place_evidence)
        first, *others = result.views
        if place_evidence is not None:
            facts = _text_facts(query, languages, mentions, len(hints), first.evidence, located.other)
            located = replace(located, facts=facts, certainty=self.weights.config.certainty)
        first = replace(first, evidence=with_description_spans(query.description, first.evidence))
        result = replace(result, located=located, views=(first, *others))
        fits = any(map(speaks_for, first.evidence))
        if not fits and reply_evidence is not None:
            warnings += (translate(REPLIES_ONLY),)
        if not fits and reply_evidence is None and first.evidence:
            result = replace(
                result, refusal=translate(NO_MATCH), question=self._question_for_refused(query, known_facts)
            )
        elif self._is_uncertain(located, reply_evidence) and not _is_about_another_place(query):
            result = replace(result, question=self.questions.ask(located, known_facts, query.replies))
        timings["estimate"] = elapsed_ms(start)
        return replace(result, timings_ms=timings, warnings=warnings)

    def _is_uncertain(self, located: PositionDistribution, reply_evidence: ReplyEvidence | None) -> bool:
        return is_ambiguous(located) or (reply_evidence is not None and located.radii_m(0.5)[0] > WELL_LOCATED_M)

    def _question_for_refused(self, query: Query, known_facts: KnownFacts) -> Question | None:
        """Return the question for a refused text; None on a map without names."""
        if not self.questions.has_names or _is_about_another_place(query):
            return None
        log_p, inside = log_prior(query, self.gallery.cells.center_m[:, :2], self.frame), self._inside(query)
        log_p = log_p if inside is None else np.where(inside.has_node, log_p, -np.inf)
        return self.questions.ask_anywhere(log_p, known_facts, query.replies)

    def _explain(
        self,
        located: PositionDistribution,
        hints: Sequence[ParsedHint],
        bound_hints: BoundHints | None,
        mentions: Sequence[Mention],
        place_evidence: PlaceEvidence | None,
    ) -> LocalizerResult:
        positions_m, heading = np.array([mode.position_m for mode in located.modes]), None
        named: list[tuple[Evidence, ...]] = [()] * len(positions_m)
        places: list[str | None] = [None] * len(positions_m)
        if self.places is not None:
            heading = self.places.heading(place_evidence, located)
            has_heading = heading is not None
            named = self.places.evidence(mentions, place_evidence, positions_m, has_heading=has_heading)
            places = [place_text(self._gazetteer, position) for position in positions_m]
        near = [() if bound_hints is None else self._evidence(hints, bound_hints, located, p) for p in positions_m]
        views = [PlaceView(place, (*one, *other)) for place, one, other in zip(places, near, named, strict=True)]
        return LocalizerResult(located, views=tuple(views), heading=heading)

    def _read(
        self, query: Query, languages: tuple[str, ...], hints: Sequence[ParsedHint]
    ) -> tuple[Sequence[ParsedHint], BoundHints | None, list[Mention], PlaceEvidence | None]:
        """Return the hints about nearby objects, these bound to the map, the mentions of places, and their evidence."""
        if self.places is None:
            return hints, self.binding.bind(hints) if hints else None, [], None
        listener_m = None if query.listener is None else self.frame.position_m(query.listener, query.crs)
        text = reader_text(query.description)
        nouns = [(hint.start, hint.end) for hint in hints]
        mentions = self.places.read(text, languages, nouns, to_listener=listener_m is not None)
        hints = [] if mentions and _is_about_another_place(query) else possibly_near_hints(hints, mentions)
        bound_hints = self.binding.bind(hints) if hints else None
        trust = [] if bound_hints is None else bound_hints.label.amax(dim=1).tolist()
        near, mentions = near_hints(hints, trust, mentions)
        hints, mentions = with_one_owner(text, [hints[n] for n in near], mentions)
        place_evidence = self.places.place_evidence(mentions, query.description, listener_m)
        return hints, self.binding.bind(hints) if hints else None, mentions, place_evidence

    def _locate(
        self,
        query: Query,
        hints: Sequence[ParsedHint],
        bound_hints: BoundHints | None,
        place_evidence: PlaceEvidence | None,
        reply_evidence: ReplyEvidence | None,
    ) -> PositionDistribution | None:
        count = REPLY_CANDIDATE_CELLS if bound_hints is None else CANDIDATE_CELLS
        evidence = PositionEvidence(
            hints=bound_hints,
            places=place_evidence,
            replies=reply_evidence,
            log_prior=None if query.prior is None else lambda points_m: log_prior(query, points_m, self.frame),
            area=self._inside(query),
        )
        candidates = PLACE_CANDIDATE_CELLS if place_evidence is not None else count
        # Vectors know nothing of other evidence, the scores of the inverted list contain it.
        proposed = self.search(hints, bound_hints) if bound_hints is not None and evidence.is_hints_only else None
        located = locate(self.nodes, evidence, candidates, proposed)
        return located and replace(located, calibrated_masses=self.weights.config.radius_held)

    def _inside(self, query: Query) -> AreaFilter | None:
        return nodes_inside(query, self.surroundings, self.gallery.cells.center_m[:, :2], self.frame)

    def search(self, hints: Sequence[ParsedHint], bound_hints: BoundHints) -> Ints | None:
        """Return the cells [A] that the vector index retrieves for hints in the retriever's words.

        None if there are no such words, or the margin is low; then the inverted list proposes.
        """
        sentences = self.binding.sentences(hints, bound_hints)
        if not sentences:
            return None
        scores, rows = self.ranker.search([self._encoded(sentences)], CANDIDATE_CELLS)
        return rows[0] if self.ranker.margin_nats(scores[0], len(sentences)) >= MIN_MARGIN_NATS else None

    def _encode(self, sentences: tuple[str, ...]) -> Levels:
        return self.ranker.retriever.encode_description(sentences)

    def sentences(self, descriptions: Sequence[str]) -> list[tuple[str, ...]]:
        """Return descriptions as template sentences with the map's classes, as far as they were parsed."""
        return [
            self.binding.sentences(hints, self.binding.bind(hints)) if hints else ()
            for hints in self.chunk_reader.parse(descriptions)
        ]

    def _evidence(
        self, hints: Sequence[ParsedHint], bound_hints: BoundHints, located: PositionDistribution, position: Floats
    ) -> tuple[Evidence, ...]:
        node = int(located.points[((located.points_m - position) ** 2).sum(axis=1).argmin()])
        explanations = self.nodes.explain(bound_hints, node)
        return tuple(
            self._hint_evidence(node, position, *row)
            for row in zip(hints, bound_hints.label, explanations, strict=True)
        )

    def _hint_evidence(
        self, node: int, position: Floats, hint: ParsedHint, label: Any, explanation: HintExplanation
    ) -> Evidence:
        probability = explanation.probability
        colour = int(hint.colour.argmax())
        shown: dict[str, Any] = {}
        if explanation.part >= 0 and probability >= EXPLAINED_PROBABILITY and hint.absent < EXPLAINED_PROBABILITY:
            gallery = self.gallery
            instance = int(self.surroundings.objects.instance[explanation.part])
            shown = {
                "at": pair(self.surroundings.positions_m(np.array([node]))[0] - explanation.offset_m),
                "instance": gallery.labels[instance],
                "name": gallery.names[instance],
                "source_id": gallery.sources[instance],
                "away_m": float(np.hypot(*explanation.offset_m)),
            }
        fits = float(label.max()) >= EXPLAINED_PROBABILITY / 2
        evidence = Evidence(
            text=hint.noun,
            span=(hint.start, hint.end),
            label=str(self.labels[int(label.argmax())]) if fits else None,
            colour=COLOURS[colour] if colour < len(COLOURS) else None,
            relation=RELATIONS[int(hint.relation.argmax())],
            distance_m=hint.distance_m,
            absent=hint.absent >= EXPLAINED_PROBABILITY,
            explained=probability,
            **shown,
        )
        return with_fit(evidence, position, missing=NOT_FOUND if fits else NOT_ON_MAP)


def _is_about_another_place(query: Query) -> bool:
    """Return whether a text is about a place away from the speaker, so its objects need not be near the speaker."""
    is_for_listener = query.listener is not None and listener_wind(query.description) is not None
    return is_for_listener or is_meeting(query.description)


def _text_facts(
    query: Query,
    languages: tuple[str, ...],
    mentions: Sequence[Mention],
    hints: int,
    evidence: Sequence[Evidence],
    other: float,  # mass outside the candidates
) -> TextFacts:
    known = [mention for mention in mentions if not mention.is_unknown and not mention.is_denied]
    unknown = sum(mention.is_unknown for mention in mentions)
    unexplained = sum(item.explained < EXPLAINED_PROBABILITY for item in evidence if not item.absent)
    return TextFacts.count(
        unknown=unknown,
        understood=len(known) + hints,
        unexplained=max(0, unexplained - unknown),
        other=other,
        anchor=any(mention.is_anchor for mention in known),
        foreign=not _is_understood(languages),
        meeting=query.listener is not None or is_meeting(query.description),
    )


def _is_understood(languages: tuple[str, ...]) -> bool:
    return table_codes().issuperset(set(languages) - {ENGLISH})


def _language_warnings(languages: tuple[str, ...]) -> tuple[str, ...]:
    if _is_understood(languages):
        return ()
    name = translate(LANGUAGE_NAMES.get(languages[0], UNKNOWN_LANGUAGE))
    return (translate("the text seems to be in {language}: only names and nouns were used", language=name),)
