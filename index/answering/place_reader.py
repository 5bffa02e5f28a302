"""Named places in a description: mentions, their evidence about positions, and what explains them."""

from collections.abc import Hashable, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
import torch
from cachetools import LRUCache, cachedmethod

from index.answering.answers import Evidence, Heading
from index.answering.evidence_text import NOT_FOUND, NOT_ON_MAP, UNKNOWN_NAME, with_fit
from index.answering.meanings import Meanings
from index.answering.result import pair
from models.citymap.frame import Frame
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.kinds.vocabulary import load_vocabulary
from models.citymap.types import Floats
from models.language.languages.detect import ENGLISH
from models.language.languages.english import English
from models.language.languages.tabulated import tabulated
from models.language.languages.translation import reply_language
from models.language.measures import compass_name, distance_in_text, overlaps
from models.language.mentions.addresses import without_city
from models.language.mentions.codes.reader import CodeReader
from models.language.mentions.cue_reader import CueReader
from models.language.mentions.lookup import Lookup
from models.language.mentions.mentions import Mention
from models.language.mentions.name_table import NameTable
from models.language.mentions.reader import find_mentions, is_meeting, listener_wind, mark_goal
from models.language.mentions.spans import PASSED, STOP
from models.language.parsed_hint import ParsedHint
from models.language.text_encoder import TextEncoder
from models.posterior.distribution import PositionDistribution
from models.posterior.places.explanations import MentionExplanation
from models.posterior.places.field import PlaceEvidence, PlaceField
from models.posterior.places.kernels import HEADINGS, PlaceKernels

CACHE_BYTES: Final = 2**24  # of mentions: replies to questions send the same text again
MIN_CLASS_TRUST: Final = 0.5  # probability of a hint's class from which it describes a nearby object
HEADING_NODES: Final = 128  # the likeliest nodes decide the heading
MAX_HEADING_SPREAD_DEG: Final = 60.0  # a less certain heading is not reported
_SIDE_WORDS: Final = ((22.5, "ahead"), (67.5, "ahead {}"), (112.5, "{}"), (157.5, "behind {}"), (181.0, "behind"))
MAX_EXPLAINED_LACKING_NAME: Final = 0.4  # of a kind with a name that no object has: another station
NEAR_RELATIONS: Final = frozenset(("seen", "wind", "near", "beside", "on", "inside"))  # hints express them too


class PlaceReader:
    """Finds and explains the named places of one map. Not thread-safe."""

    def __init__(
        self,
        kernels: PlaceKernels,
        cues: CueReader,
        gazetteer: Gazetteer,  # not empty
        text_encoder: TextEncoder,
        centers_m: Floats,  # [N, 2] of the gallery's cells
        grid_m: float,  # spacing of the centres
        meanings: Meanings | None = None,  # None to go without paraphrases
        names: NameTable | None = None,  # built if None
        frame: Frame | None = None,  # None to go without codes
    ) -> None:
        self.gazetteer, self.field = gazetteer, PlaceField(kernels, gazetteer, centers_m, grid_m)
        self.meanings, self._english = meanings, English(cues)
        self._lookup = Lookup(gazetteer, load_vocabulary(), text_encoder.is_everyday, names)
        self._codes = None if frame is None else CodeReader(self._lookup, frame, centers_m)
        self._cache: LRUCache[tuple[Hashable, ...], list[Mention]] = LRUCache(CACHE_BYTES, _memory_bytes)

    def without_city(self, description: str) -> str:
        """Return a description without the city and country at its end."""
        return without_city(description, self._lookup)

    def read(
        self, description: str, codes: tuple[str, ...], nouns: Sequence[tuple[int, int]] = (), *, to_listener: bool
    ) -> list[Mention]:
        """Return the mentions of a description in languages of `detect_languages`.

        `nouns` are the start and end of the nouns that the hint reader found. With `to_listener` the position of a
        listener is known; otherwise the text decides whether it is about a meeting point.
        """
        mentions = self._mentions(description, codes, tuple(nouns))
        if codes == (ENGLISH,) and (to_listener or is_meeting(description)):
            mentions = mark_goal(mentions)
        return mentions

    @cachedmethod(lambda reader: reader._cache, key=lambda _, *read: (*read, reply_language()))  # for their notes
    def _mentions(self, description: str, codes: tuple[str, ...], nouns: tuple[tuple[int, int], ...]) -> list[Mention]:
        language = self._english if codes == (ENGLISH,) else tabulated(codes)
        like = None if self.meanings is None else self.meanings.like
        return find_mentions(description, self._lookup, language, nouns, like, self._codes)

    def place_evidence(
        self, mentions: Sequence[Mention], description: str, listener_m: Floats | None
    ) -> PlaceEvidence | None:
        """Return the evidence of mentions about positions; None if there is none."""
        wind = None if listener_m is None else listener_wind(description)
        meets = listener_m is not None or is_meeting(description)
        if not mentions and wind is None:
            return None  # saves the pass over every cell
        place_evidence = self.field.evidence(mentions, listener_m, wind, is_meeting=meets)
        return place_evidence if place_evidence.placed.mentions or wind is not None else None

    @torch.inference_mode()
    def evidence(
        self,
        mentions: Sequence[Mention],
        place_evidence: PlaceEvidence | None,
        positions_m: Floats,
        *,
        has_heading: bool = False,
    ) -> list[tuple[Evidence, ...]]:
        """Return the evidence of each mention at positions [M, 2]; with a heading in the text its words use one."""
        known: tuple[Mention, ...] = ()
        explained = [list[MentionExplanation]()] * len(positions_m)
        if place_evidence is not None:
            known = place_evidence.placed.mentions
            explained = self.field.explain(place_evidence.placed, positions_m)
        result = []
        for position, explanations in zip(positions_m, explained, strict=True):
            by = {id(mention): explanation for mention, explanation in zip(known, explanations, strict=True)}
            result.append(
                tuple(self._mention_evidence(m, by.get(id(m)), position, has_heading=has_heading) for m in mentions)
            )
        return result

    def _mention_evidence(
        self, mention: Mention, by: MentionExplanation | None, position: Floats, *, has_heading: bool
    ) -> Evidence:
        evidence = _unexplained_evidence(mention)
        if by is None or by.item < 0:
            unknown = NOT_ON_MAP if mention.kinds else UNKNOWN_NAME
            return with_fit(evidence, position, missing=unknown if mention.form == "unknown" else NOT_FOUND)
        shown: dict[str, Any] = {"away_m": round(float(np.hypot(*by.offset_m)), 1)}
        shown["at"] = pair(np.round(position + by.offset_m, 2))
        shown["bearing_deg"] = round(float(np.degrees(np.arctan2(*by.offset_m))) % 360, 1)
        if by.item < len(mention.objects):
            words = self.gazetteer.objects[int(mention.objects[by.item])]
            kind = words.kinds[0] if words.kinds else None
            shown |= {"instance": kind, "name": words.names[0] if words.names else None, "source_id": words.source_id}
        label = mention.kinds[0] if mention.kinds else shown.get("instance")
        probability = min(by.probability, MAX_EXPLAINED_LACKING_NAME if mention.lacks_name else 1.0)
        evidence = replace(evidence, label=label or mention.form, explained=probability, **shown)
        return with_fit(evidence, position, by.heading_deg if has_heading and mention.cue.angle is not None else None)

    @torch.inference_mode()
    def heading(self, place_evidence: PlaceEvidence | None, located: PositionDistribution) -> Heading | None:
        """Return the heading from the likeliest nodes; None if the text does not tell."""
        if place_evidence is None or all(mention.cue.angle is None for mention in place_evidence.placed.mentions):
            return None
        near = np.hypot(*(located.points_m - located.positions[0]).T) <= located.radii_m(0.5)[0] + 3.0
        rows = np.flatnonzero(near)
        rows = rows[np.argsort(-located.weight[rows], kind="stable")[:HEADING_NODES]]
        if not len(rows):
            return None
        by = self.field.by_heading(place_evidence.placed, located.points_m[rows], np.zeros(len(rows), np.int64))
        weight = torch.softmax(by, dim=1) * torch.from_numpy(located.weight[rows]).float()[:, None]
        share = (weight.sum(dim=0) / weight.sum().clamp(min=1e-12)).double().numpy()
        angle = np.arange(HEADINGS) * 2 * np.pi / HEADINGS
        mean = complex((share * np.exp(1j * angle)).sum())
        length = min(max(abs(mean), 1e-9), 1.0)
        spread = float(np.degrees(np.sqrt(-2 * np.log(length))))
        if spread > MAX_HEADING_SPREAD_DEG:
            return None
        return Heading(round(float(np.degrees(np.angle(mean))) % 360, 1), round(spread, 1))


def possibly_near_hints(hints: Sequence[ParsedHint], mentions: Sequence[Mention]) -> list[ParsedHint]:
    """Return the hints that `near_hints` may keep."""
    return [hint for hint in hints if all(_is_possibly_near(m) for m in mentions if overlaps(m, [hint]))]


def near_hints(
    hints: Sequence[ParsedHint], trust: Sequence[float], mentions: Sequence[Mention]
) -> tuple[list[int], list[Mention]]:
    """Divide overlapping hints and mentions: return the rows of the hints, and the mentions.

    A class with at most a compass direction is a hint. Names, streets, and places relative to the speaker's heading are
    mentions. `trust` is the probability of each hint's class.
    """
    near_rows: list[int] = []
    places = list(mentions)
    for n, hint in enumerate(hints):
        over = [m for m in places if overlaps(m, [hint])]
        if over and all(_is_possibly_near(m) for m in over) and trust[n] >= MIN_CLASS_TRUST:
            places = [m for m in places if not any(m is other for other in over)]
            near_rows.append(n)
        elif not over and (_is_informative(hint, trust[n]) or hint.absent >= MIN_CLASS_TRUST):
            near_rows.append(n)
    return near_rows, places


def with_one_owner(
    text: str, hints: Sequence[ParsedHint], mentions: Sequence[Mention]
) -> tuple[list[ParsedHint], list[Mention]]:
    """Return hints and mentions of a text, each measure with only the nearest of those that claim it."""
    hints, mentions = list(hints), list(mentions)
    for m, mention in enumerate(mentions):
        measure = mention.cue.measure
        for n, hint in enumerate(hints):
            if measure is None or hint.measure is None or not overlaps(measure, [hint.measure]):
                continue
            if distance_in_text(text, hint.measure, hint) < distance_in_text(text, measure, mention):
                mentions[m] = replace(mention, cue=replace(mention.cue, measure=None))
                break
            hints[n] = replace(hint, measure=None)
    return hints, mentions


def _memory_bytes(mentions: Sequence[Mention]) -> int:
    return 2000 + sum(1000 + m.objects.nbytes + m.weights.nbytes + m.lines_m.nbytes for m in mentions)


def _is_possibly_near(mention: Mention) -> bool:
    """Return whether a mention is only a class with a direction, which may describe a nearby object."""
    cue = mention.cue
    loose = cue.angle is not None or cue.relation not in NEAR_RELATIONS or (cue.distance_m or 0.0) > 15.0
    is_kind = mention.form in ("thing", "unknown") and bool(mention.kinds) and not mention.is_exact
    return is_kind and mention.trust == 1.0 and not loose


def _is_informative(hint: ParsedHint, trust: float) -> bool:
    words = hint.noun.lower().split()
    return trust >= MIN_CLASS_TRUST and not (
        words and words[-1] in PASSED | STOP and float(hint.relation[-1]) > MIN_CLASS_TRUST
    )


def _unexplained_evidence(mention: Mention) -> Evidence:
    return Evidence(
        text=mention.text,
        span=(mention.start, mention.end),
        label=mention.kinds[0] if mention.kinds else None,
        colour=None,
        relation=_relation_word(mention),
        distance_m=mention.cue.distance_m,
        absent=mention.is_denied,
        explained=0.0,
        exact=mention.is_exact if mention.form != "unknown" else False,
    )


def _relation_word(mention: Mention) -> str:
    cue = mention.cue
    if cue.wind is not None:
        return compass_name(cue.wind + 180)
    if cue.angle is not None:
        side = "left" if cue.angle < 0 else "right"
        return next(words.format(side) for most, words in _SIDE_WORDS if abs(cue.angle) <= most)
    if mention.form in ("corner", "span", "address", "point"):
        return mention.form
    return "near" if cue.relation == "seen" else cue.relation
