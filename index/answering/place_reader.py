"""Places that a description names, on one map: what is read, what it tells of positions, and what explains it."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
import torch
from cachetools import LRUCache, cachedmethod

from index.answering.answers import Evidence, Heading
from index.answering.meanings import Meanings
from index.answering.result import pair
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.kinds.vocabulary import load_vocabulary
from models.citymap.types import Floats
from models.language.measures import Measure, compass_name, distance_in_text
from models.language.mentions.cue_reader import CueReader
from models.language.mentions.languages import ENGLISH
from models.language.mentions.lookup import Lookup
from models.language.mentions.mentions import Mention
from models.language.mentions.name_table import NameTable
from models.language.mentions.reader import find_mentions, is_meeting, listener_wind, mark_goal
from models.language.mentions.spans import PASSED, STOP
from models.language.parsed_hint import ParsedHint
from models.language.text_encoder import TextEncoder
from models.posterior.distribution import Located
from models.posterior.places.explanations import MentionExplanation
from models.posterior.places.field import PlaceEvidence, PlaceField
from models.posterior.places.kernels import HEADINGS, PlaceKernels

KEPT_BYTES: Final = 2**24  # of what was read of texts lately: who answers a question sends the text again
TRUSTED: Final = 0.5  # of a hint's class, from which on it is no place but what is near
HEADING_NODES: Final = 128  # that the heading is told from: the likeliest
SPREAD: Final = 60.0  # degrees; a heading that is less sure is none
_EGO: Final = ((22.5, "ahead"), (67.5, "ahead {}"), (112.5, "{}"), (157.5, "behind {}"), (181.0, "behind"))
NEAR_WINDS: Final = frozenset(
    ("seen", "wind", "near", "beside", "on", "inside")
)  # relations that hints about what is near have too


class PlaceReader:
    """The names and kinds of one map. Not thread-safe.

    Args:
        kernels: fitted.
        cues: trained.
        gazetteer: of the map, not empty.
        text_encoder: says which words are everyday ones.
        centers_m: [N, 2] of the gallery's cells.
        grid_m: spacing of these.
        meanings: of the map; None to understand names and nouns of it alone.
        names: of the map; None to make them.
    """

    def __init__(
        self,
        kernels: PlaceKernels,
        cues: CueReader,
        gazetteer: Gazetteer,
        text_encoder: TextEncoder,
        centers_m: Floats,
        grid_m: float,
        meanings: Meanings | None = None,
        names: NameTable | None = None,
    ) -> None:
        self.gazetteer, self.field = gazetteer, PlaceField(kernels, gazetteer, centers_m, grid_m)
        self.meanings, self._cues = meanings, cues
        self._lookup = Lookup(gazetteer, load_vocabulary(), text_encoder.is_everyday, names)
        self._kept: LRUCache[tuple[str, str, tuple[tuple[int, int], ...]], list[Mention]] = LRUCache(
            KEPT_BYTES, _bytes_of
        )

    def read(
        self, description: str, language: str, nouns: Sequence[tuple[int, int]] = (), *, to_listener: bool
    ) -> list[Mention]:
        """What a description names.

        Args:
            description: any text.
            language: of the text.
            nouns: characters start..end of the nouns that the reader of hints found in it.
            to_listener: whether it is said to somebody whose place is known; else the text tells whether it is of a
                place to meet at.
        """
        mentions = self._mentions(description, language, tuple(nouns))
        if language == ENGLISH and (to_listener or is_meeting(description)):
            mentions = mark_goal(mentions)
        return mentions

    @cachedmethod(lambda reader: reader._kept)
    def _mentions(self, description: str, language: str, nouns: tuple[tuple[int, int], ...]) -> list[Mention]:
        """As `find_mentions`; of the latest texts it is remembered."""
        like = None if self.meanings is None else self.meanings.like
        return find_mentions(description, self._lookup, self._cues, language, nouns, like)

    def told(self, mentions: Sequence[Mention], description: str, listener_m: Floats | None) -> PlaceEvidence | None:
        """What mentions tell of positions; None if they tell nothing."""
        wind = None if listener_m is None else listener_wind(description)
        meets = listener_m is not None or is_meeting(description)
        if not mentions and wind is None:
            return None  # without looking at every cell
        told = self.field.told(mentions, listener_m, wind, is_meeting=meets)
        return told if told.places.mentions or wind is not None else None

    @torch.inference_mode()
    def evidence(
        self, mentions: Sequence[Mention], told: PlaceEvidence | None, position: Floats
    ) -> tuple[Evidence, ...]:
        """How each mention was understood, and what explains it at a position [2]."""
        known = told.places.mentions if told is not None else ()
        explained = self.field.explain(told.places, position[None]) if told is not None else []
        found = []
        for mention in mentions:
            row = next((n for n, other in enumerate(known) if other is mention), None)
            found.append(_unexplained(mention) if row is None else self._explained(mention, explained[row], position))
        return tuple(found)

    def _explained(self, mention: Mention, by: MentionExplanation, position: Floats) -> Evidence:
        found = _unexplained(mention)
        if by.item < 0:
            return found
        shown: dict[str, Any] = {"away_m": round(float(np.hypot(*by.way_m)), 1)}
        shown["at"] = pair(np.round(position + by.way_m, 2))
        shown["bearing_deg"] = round(float(np.degrees(np.arctan2(*by.way_m))) % 360, 1)
        if by.item < len(mention.objects):
            words = self.gazetteer.objects[int(mention.objects[by.item])]
            kind = words.kinds[0] if words.kinds else None
            shown |= {"instance": kind, "name": words.names[0] if words.names else None, "source_id": words.source_id}
        label = mention.kinds[0] if mention.kinds else shown.get("instance")
        return replace(found, label=label or mention.form, explained=by.probability, **shown)

    @torch.inference_mode()
    def heading(self, told: PlaceEvidence | None, located: Located) -> Heading | None:
        """Where the speaker looks, from the likeliest nodes; None where the text tells none."""
        if told is None or not any(mention.cue.angle is not None for mention in told.places.mentions):
            return None
        near = np.hypot(*(located.points_m - located.positions[0]).T) <= located.radii_m(0.5)[0] + 3.0
        rows = np.flatnonzero(near)
        rows = rows[np.argsort(-located.weight[rows], kind="stable")[:HEADING_NODES]]
        if not len(rows):
            return None
        by = self.field.by_heading(told.places, located.points_m[rows], np.zeros(len(rows), np.int64))
        weight = torch.softmax(by, dim=1) * torch.from_numpy(located.weight[rows]).float()[:, None]
        share = (weight.sum(dim=0) / weight.sum().clamp(min=1e-12)).double().numpy()
        angle = np.arange(HEADINGS) * 2 * np.pi / HEADINGS
        mean = complex((share * np.exp(1j * angle)).sum())
        length = min(max(abs(mean), 1e-9), 1.0)
        spread = float(np.degrees(np.sqrt(-2 * np.log(length))))
        return (
            Heading(round(float(np.degrees(np.angle(mean))) % 360, 1), round(spread, 1)) if spread <= SPREAD else None
        )


def may_be_near(hints: Sequence[ParsedHint], mentions: Sequence[Mention]) -> list[ParsedHint]:
    """The hints that `near_hints` may keep: what a name, a street or the speaker's heading tells of is none of them."""
    return [
        hint
        for hint in hints
        if all(_may_be_near(mention) for mention in mentions if mention.start < hint.end and hint.start < mention.end)
    ]


def near_hints(
    hints: Sequence[ParsedHint], trust: Sequence[float], mentions: Sequence[Mention]
) -> tuple[list[int], list[Mention]]:
    """Which hints tell of what is near, and which mentions of places; what is both is one of them.

    A class of the map that is said with a wind or none is a hint; whatever has a name, a street, or a place that only
    the speaker's heading tells, is a mention.

    Args:
        hints: as they were read.
        trust: of each one's class.
        mentions: of the same text.
    """
    kept: list[int] = []
    places = list(mentions)
    for n, hint in enumerate(hints):
        over = [m for m in places if m.start < hint.end and hint.start < m.end]
        if over and all(_may_be_near(m) for m in over) and trust[n] >= TRUSTED:
            places = [m for m in places if not any(m is other for other in over)]
            kept.append(n)
        elif (not over and _tells(hint, trust[n])) or (hint.absent >= TRUSTED and not over):
            kept.append(n)
    return kept, places


def with_one_owner(
    text: str, hints: Sequence[ParsedHint], mentions: Sequence[Mention]
) -> tuple[list[ParsedHint], list[Mention]]:
    """Return hints and mentions of a text, each measure with only the nearest of those that claim it."""
    hints, mentions = list(hints), list(mentions)
    for m, mention in enumerate(mentions):
        measure = mention.cue.measure
        for n, hint in enumerate(hints):
            if measure is None or hint.measure is None or not _overlap(measure, hint.measure):
                continue
            if distance_in_text(text, hint.measure, hint) < distance_in_text(text, measure, mention):
                mentions[m] = replace(mention, cue=replace(mention.cue, measure=None))
                break
            hints[n] = replace(hint, measure=None)
    return hints, mentions


def _overlap(one: Measure, other: Measure) -> bool:
    return one.start < other.end and other.start < one.end


def _bytes_of(mentions: Sequence[Mention]) -> int:
    """About what they take in memory."""
    return 2000 + sum(1000 + m.objects.nbytes + m.weights.nbytes + m.lines_m.nbytes for m in mentions)


def _may_be_near(mention: Mention) -> bool:
    """Whether no more is said than a class and a wind; the gazetteer may lack it: driveways are near or nowhere."""
    cue = mention.cue
    loose = cue.angle is not None or cue.relation not in NEAR_WINDS or (cue.distance_m or 0.0) > 15.0
    is_kind = mention.form in ("thing", "unknown") and bool(mention.kinds) and not mention.is_exact
    return is_kind and mention.trust == 1.0 and not loose


def _tells(hint: ParsedHint, trust: float) -> bool:
    words = hint.noun.lower().split()
    return trust >= TRUSTED and not (words and words[-1] in PASSED | STOP and float(hint.relation[-1]) > TRUSTED)


def _unexplained(mention: Mention) -> Evidence:
    return Evidence(
        text=mention.text,
        span=(mention.start, mention.end),
        label=mention.kinds[0] if mention.kinds else None,
        colour=None,
        relation=_relation(mention),
        distance_m=mention.cue.distance_m,
        absent=False,
        explained=0.0,
        exact=mention.is_exact if mention.form != "unknown" else False,
    )


def _relation(mention: Mention) -> str:
    cue = mention.cue
    if cue.wind is not None:
        return compass_name(cue.wind + 180)
    if cue.angle is not None:
        side = "left" if cue.angle < 0 else "right"
        return next(words.format(side) for most, words in _EGO if abs(cue.angle) <= most)
    if mention.form in ("corner", "span", "address"):
        return mention.form
    return "near" if cue.relation == "seen" else cue.relation
