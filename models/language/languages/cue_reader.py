"""Read where each mention of a text is from the speaker by the phrases of a language's table."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, get_args

import numpy as np

from models.language.languages.table import LETTER, LanguageTable, fold, lower
from models.language.measures import Bearing, Measure
from models.language.mentions.cue_reader import MentionSpan, ReadCue
from models.language.mentions.cues import Relation
from models.language.mentions.unspaced import is_unspaced

EGO_DEG: Final = {
    "ahead": 0.0, "ahead_right": 45.0, "right": 90.0, "behind_right": 135.0,
    "behind": 180.0, "behind_left": -135.0, "left": -90.0, "ahead_left": -45.0,
}  # fmt: skip
SOFT: Final = ((0.0, 0.8), (45.0, 0.1), (-45.0, 0.1))  # how far a thing is from where it is said to be, with weights
COMPASS_DEG: Final = {
    "north": 0.0, "northeast": 45.0, "east": 90.0, "southeast": 135.0,
    "south": 180.0, "southwest": 225.0, "west": 270.0, "northwest": 315.0,
}  # fmt: skip
LOOSE_METRES: Final = 0.75  # units from this on, other than metres and kilometres, are loose: steps, blocks
MAX_MEASURE_M: Final = 5000.0
RELATIONS: Final = frozenset(get_args(Relation))
_PAUSE: Final = re.compile(r"[.,;:!?\n()–—]+(?:\s|$)|\s-\s|[。，、；：！？（）]")  # noqa: RUF001
_DIGITS: Final = r"\d+(?:[.,]\d+)?"


@dataclass(slots=True)
class _StatedPhrase:
    """A phrase in a clause that is about the nearest thing."""

    start: int
    end: int
    cue: str


class TableCueReader:
    """Reads cues, distances and compass directions in the languages of one table."""

    def __init__(self, table: LanguageTable) -> None:
        self._table = table
        numbers = sorted(map(re.escape, table.numbers), key=len, reverse=True)
        units = sorted(table.metres, key=len, reverse=True)
        self._units = [
            (re.compile(re.escape(unit.removesuffix("*")) + (r"\w*" if unit.endswith("*") else "")), unit)
            for unit in units
        ]
        unit = "|".join(pattern.pattern for pattern, _ in self._units)
        count = rf"(?:(?P<digits>{_DIGITS})|(?P<word>{'|'.join(numbers) or '(?!)'}))"
        self._measure = re.compile(rf"(?<!{LETTER})(?<!\d[.,]){count}[\s-]*(?P<unit>{unit or '(?!)'})(?!{LETTER})")

    def find_measures(self, text: str) -> list[Measure]:
        """Return the distances of a text."""
        measures = []
        for match in self._measure.finditer(fold(text)):
            unit = next(name for pattern, name in self._units if pattern.fullmatch(match["unit"]))
            metres = self._table.metres[unit]
            count = self._table.numbers[match["word"]] if match["word"] else float(match["digits"].replace(",", "."))
            is_loose = (LOOSE_METRES <= metres < 1000 and metres != 1) or not float(count).is_integer()
            if 0 < count * metres <= MAX_MEASURE_M:
                measures.append(Measure(match.start(), match.end(), count * metres, is_loose))
        return measures

    def find_bearings(self, text: str) -> list[Bearing]:
        """Return the compass directions of a text."""
        folded, bearings = fold(text), list[Bearing]()
        for wind, pattern in self._table.winds.items():
            for match in pattern.finditer(folded):
                if not any(one.start < match.end() and match.start() < one.end for one in bearings):
                    is_of = self._table.of_words.match(folded, match.end()) is not None
                    bearings.append(Bearing(match.start(), match.end(), COMPASS_DEG[wind], is_of))
        return sorted(bearings, key=lambda bearing: bearing.start)

    def read(self, text: str, mentions: Sequence[MentionSpan]) -> list[ReadCue]:
        """Return the cue of each mention (start, end, form), in their order."""
        folded = fold(text)
        relations: list[Relation] = ["seen"] * len(mentions)
        taken = [(start, end) for start, end, _ in mentions]
        angles: list[list[float]] = [[] for _ in mentions]
        used = list(taken)
        is_on = False  # whether a street was said to be where the speaker is
        for n, (start, end, form) in enumerate(mentions):
            relation = self._relation(folded, start, end, taken)
            if relation is not None:
                relations[n] = relation[0]
                used.append(relation[1])
            elif form == "street":
                relations[n], is_on = "near" if is_on else "inside", True
        stated = self._alone(folded, used)
        for n, cue in self._matched(text, taken, stated):
            if cue in EGO_DEG:
                angles[n].append(EGO_DEG[cue])
                if mentions[n][2] == "street" and relations[n] == "inside":
                    relations[n] = "seen"
            elif cue in RELATIONS:
                relations[n] = cue  # type: ignore[call-overload]
        return [_cue(degrees, relation) for degrees, relation in zip(angles, relations, strict=True)]

    def phrase_spans(self, text: str) -> list[tuple[int, int]]:
        """Return the start and end of the phrases without a thing, and of distances."""
        stated = [(one.start, one.end) for one in self._alone(fold(text), ())]
        return [*stated, *((measure.start, measure.end) for measure in self.find_measures(text))]

    def _relation(
        self, folded: str, start: int, end: int, taken: Sequence[tuple[int, int]]
    ) -> tuple[Relation, tuple[int, int]] | None:
        """Return the relation of the phrase round a thing, with the phrase's start and end; long phrases first."""
        best: tuple[Relation, tuple[int, int]] | None = None
        others = [other for other in taken if other != (start, end)]
        for name, phrases in self._table.cues.items():
            for phrase in phrases if name in RELATIONS else ():
                span = phrase.around(folded, start, end)
                if span is None or any(a < span[1] and span[0] < b for a, b in others):
                    continue
                if best is None or span[1] - span[0] > best[1][1] - best[1][0]:
                    best = name, span  # type: ignore[assignment]
        return best

    def _alone(self, folded: str, taken: Sequence[tuple[int, int]]) -> list[_StatedPhrase]:
        """Return the phrases without a thing, outside the mentions; of overlapping ones the longest."""
        matches = [
            _StatedPhrase(*match.span(), name)
            for name, phrases in self._table.cues.items()
            for phrase in phrases
            if phrase.alone is not None
            for match in phrase.alone.finditer(folded)
        ]
        chosen: list[_StatedPhrase] = []
        for one in sorted(matches, key=lambda one: one.start - one.end):
            spans = [*taken, *((other.start, other.end) for other in chosen)]
            if not any(one.start < end and start < one.end for start, end in spans):
                chosen.append(one)
        return sorted(chosen, key=lambda one: one.start)

    def _matched(
        self, text: str, taken: Sequence[tuple[int, int]], stated: Sequence[_StatedPhrase]
    ) -> list[tuple[int, str]]:
        """Return which mention each phrase is about, with its cue; one of a list may be about several.

        In a clause that begins with a phrase, phrases are about what follows ("left the bank, right the shop"), else
        about what precedes; one in a clause without a thing is about the thing before ("the bank, it is on my left").
        """
        folded = fold(text)
        pairs: list[tuple[int, str]] = []
        carried: list[str] = []  # cues of the clause before, where its last part was a thing
        pending: list[str] = []  # cues of clauses without a thing that are about the next one: "straight on, 30 m, X"
        last = -1  # the mention before
        for start, end, is_joined in self._clauses(text, taken):
            things = [n for n, (a, _) in enumerate(taken) if start <= a < end]
            phrases = [one for one in stated if start <= one.start < end]
            if not phrases:
                if things and pending:
                    pairs += [(things[0], cue) for cue in pending]
                    pending = []
                elif is_joined and carried:
                    pairs += [(n, cue) for n in things for cue in carried]
                last = things[-1] if things else last
                continue
            if not things:
                if self._is_about_another(folded, start, end, phrases):
                    carried = []
                    continue
                cues = [one.cue for one in phrases]
                if last >= 0 and not is_joined and not any(n == last and cue in EGO_DEG for n, cue in pairs):
                    pairs += [(last, cue) for cue in cues]
                else:
                    pending = cues
                carried = []
                continue
            pending = []
            is_forward = phrases[0].start < taken[things[0]][0]
            groups: dict[int, list[str]] = {n: [] for n in things}
            for one in phrases:
                after = [n for n in things if taken[n][0] >= one.end]
                before = [n for n in things if taken[n][1] <= one.start]
                target = (after[0] if after else before[-1]) if is_forward else (before[-1] if before else after[0])
                if (
                    is_forward
                    and not after
                    and groups[target]
                    and len(things) > 1
                    and not _adjoins(folded, one, phrases)
                ):
                    groups[target] = []
                groups[target].append(one.cue)
            current: list[str] = []
            for n in things:
                current = groups[n] or (current if is_forward else [])
                pairs += [(n, cue) for cue in current]
            carried, last = (current if is_forward else []), things[-1]
        return pairs

    def _is_about_another(self, folded: str, start: int, end: int, phrases: Sequence[_StatedPhrase]) -> bool:
        """Return whether a clause without a known thing has a word for another one."""
        for one in phrases:
            folded = folded[: one.start] + " " * (one.end - one.start) + folded[one.end :]
        return any(
            len(word) > 3 and word not in self._table.stop and not word.isdecimal() and not is_unspaced(word)
            for word in re.findall(r"\w+", folded[start:end])
        )

    def _clauses(self, text: str, taken: Sequence[tuple[int, int]]) -> list[tuple[int, int, bool]]:
        """Return the clauses of a text; the third says whether "and" joins one to the clause before."""
        breaks = [(match.start(), match.end(), False) for match in _PAUSE.finditer(text)]
        breaks += [(match.start(), match.end(), True) for match in self._table.ands.finditer(lower(text))]
        breaks = sorted(b for b in breaks if not any(start < b[1] and b[0] < end for start, end in taken))
        clauses, start, is_joined = [], 0, False
        for begin, end, joins in breaks:
            clauses.append((start, begin, is_joined))
            start, is_joined = end, joins
        return [*clauses, (start, len(text), is_joined)]


def _adjoins(folded: str, one: _StatedPhrase, phrases: Sequence[_StatedPhrase]) -> bool:
    """Return whether a phrase follows another directly: "ahead on the left"."""
    return any(other.end <= one.start and len(folded[other.end : one.start].split()) <= 1 for other in phrases)


def _cue(degrees: Sequence[float], relation: Relation) -> ReadCue:
    """Return the cue of a direction, which two phrases may state together: "ahead on the left"."""
    if not degrees:
        return ReadCue(None, (), relation, has_wind=True, is_meant=True)
    radians = np.radians(degrees)
    mean = complex(np.cos(radians).sum(), np.sin(radians).sum())
    if abs(mean) < 0.1:  # it cannot be both: the first counts
        mean = complex(np.cos(radians[0]), np.sin(radians[0]))
    angle = round(float(np.degrees(np.angle(mean))) / 45) * 45.0
    angles = tuple(((angle + off + 180) % 360 - 180, weight) for off, weight in SOFT)
    return ReadCue(angle, angles, relation, has_wind=True, is_meant=True)
