"""Bind parsed hints to the labels and colours of a map."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import torch
from torch import Tensor

from models.citymap.colours import BASIC_PALETTE, KITTI360_PALETTE, Palette
from models.citymap.templates import render_hint
from models.citymap.types import DIRECTIONS, Hint
from models.language.labels import MAX_CACHED_PHRASES, BoundLabels, LabelMatcher
from models.language.parsed_hint import RELATIONS, ParsedHint
from models.language.reader import COLOURS
from models.language.recent_features import RecentFeatures
from models.posterior.likelihood import BoundHints
from models.posterior.node_batch import colour_words

LIKELY_PROBABILITY: Final = 0.5  # of absence, a wind or a colour
MIN_LABEL_PROBABILITY: Final = 0.25  # a less certain label is not used in words
_COLOUR_SPREAD: Final = 0.15  # in units of rgb, of similar colours; not measured


class Binding:
    """The labels of a map, each once, and its colours."""

    def __init__(self, matcher: LabelMatcher, labels: Sequence[str], palette: Palette) -> None:
        self.matcher, self.labels = matcher, tuple(labels)
        with torch.no_grad():
            self._bound: BoundLabels = matcher.bind(self.labels)
        self._colours, self._words = colour_table(palette), colour_words(palette)
        self._label = RecentFeatures(self._labels_of, MAX_CACHED_PHRASES)

    def _labels_of(self, nouns: Sequence[str]) -> Tensor:
        """Return the probability [S, L] of each label, one noun at a time, so that nouns do not affect each other."""
        rows = [self.matcher(noun[None], self._bound) for noun in self.matcher.embed(nouns)]
        return torch.cat(rows).exp()[:, :-1]

    @torch.no_grad()
    def bind(self, hints: Sequence[ParsedHint]) -> BoundHints:
        """Return hints, at least one, as distributions over what the map has."""
        label = self._label(hint.noun for hint in hints)
        distance_m = [float("nan") if hint.distance_m is None else hint.distance_m for hint in hints]
        return BoundHints(
            relation=torch.stack([hint.relation for hint in hints]),
            label=torch.stack([label[hint.noun] for hint in hints]),
            colour=torch.stack([hint.colour for hint in hints]) @ self._colours,
            distance_m=torch.tensor(distance_m),
            absent=torch.tensor([hint.absent for hint in hints]),
        )

    def sentences(self, hints: Sequence[ParsedHint], bound_hints: BoundHints) -> tuple[str, ...]:
        """Return hints as template sentences with the map's labels and colours, which a retriever knows.

        A hint about something absent or unknown to the map has none.
        """
        label, trust = bound_hints.label.argmax(dim=1).tolist(), bound_hints.label.amax(dim=1).tolist()
        colour = bound_hints.colour.argmax(dim=1).tolist()
        direction = (bound_hints.relation @ _DIRECTION_OF_RELATION).argmax(dim=1).tolist()
        return tuple(
            render_hint(Hint(DIRECTIONS[direction[n]], self.labels[label[n]], (*self._words, None)[colour[n]]))
            for n, hint in enumerate(hints)
            if hint.absent < LIKELY_PROBABILITY and trust[n] >= MIN_LABEL_PROBABILITY
        )

    def uninformative_hint(self) -> BoundHints:
        """Return one hint that anything fits, for a text without hints."""
        colour = torch.zeros(1, self._colours.shape[1])
        colour[0, -1] = 1.0
        label = torch.full((1, len(self.labels)), 1 / len(self.labels))
        relation = torch.zeros(1, len(RELATIONS))
        relation[0, -1] = 1.0
        return BoundHints(relation, label, colour, torch.tensor([float("nan")]), torch.zeros(1))


def colour_table(palette: Palette) -> Tensor:
    """Return the share [C + 1, W + 1] of each palette word in each of the reader's colours; last, for none.

    A colour without a word in the palette is shared among the words of similar colours.
    """
    words = colour_words(palette)
    centers = np.asarray(palette.centers)
    table = torch.zeros(len(COLOURS) + 1, len(words) + 1)
    table[-1, -1] = 1.0
    for row, colour in enumerate(COLOURS):
        if colour in words:
            table[row, words.index(colour)] = 1.0
            continue
        distance = np.linalg.norm(centers[:, None] - centers_of(colour), axis=-1).min(axis=1) / 255
        weight = np.exp(-(distance**2) / (2 * _COLOUR_SPREAD**2))
        for word, value in zip(palette.words, weight / weight.sum(), strict=True):
            table[row, words.index(word)] += float(value)
    return table


def centers_of(colour: str) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Return the rgb centres [n, 3] (0..255) of a colour of the reader."""
    for palette in (BASIC_PALETTE, KITTI360_PALETTE):
        if colour in palette.words:
            return np.array([c for word, c in zip(palette.words, palette.centers, strict=True) if word == colour])
    raise ValueError(f"no palette has '{colour}'")


def _directions_of_relations() -> Tensor:
    """Return the share [10, 5] of each of DIRECTIONS in each relation; "near" counts as "on-top"."""
    table = torch.zeros(len(RELATIONS), len(DIRECTIONS))
    for row, relation in enumerate(RELATIONS):
        winds = [n for n, direction in enumerate(DIRECTIONS[:4]) if direction in relation]
        table[row, winds or [DIRECTIONS.index("on-top")]] = 1 / max(1, len(winds))
    return table


_DIRECTION_OF_RELATION = _directions_of_relations()
