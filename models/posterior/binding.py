"""What a reader noticed, in a map's own words."""

from collections.abc import Sequence

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
from models.posterior.likelihood import Reading
from models.posterior.node_batch import colour_words

LIKELY, TRUSTED = 0.5, 0.25  # of being absent; of a label, from which on it is said
_ALIKE = 0.15  # in units of rgb: how far a colour may be from one that the palette has


class Binding:
    """A map's labels and colours, ready to take what is said.

    Args:
        matcher: compares nouns with labels.
        labels: the map's, each once.
        palette: its colour words.
    """

    def __init__(self, matcher: LabelMatcher, labels: Sequence[str], palette: Palette) -> None:
        self.matcher, self.labels = matcher, tuple(labels)
        with torch.no_grad():
            self._bound: BoundLabels = matcher.bind(self.labels)
        self._colours, self._words = colour_table(palette), colour_words(palette)
        self._label = RecentFeatures(self._labels_of, MAX_CACHED_PHRASES)

    def _labels_of(self, nouns: Sequence[str]) -> Tensor:
        """[S, L] probability of each label; noun by noun, so that what stands beside one changes nothing."""
        rows = [self.matcher(noun[None], self._bound) for noun in self.matcher.embed(nouns)]
        return torch.cat(rows).exp()[:, :-1]

    @torch.no_grad()
    def reading(self, noticed: Sequence[ParsedHint]) -> Reading:
        """Hints as distributions over what the map has."""
        label = self._label(thing.noun for thing in noticed)
        said = [float("nan") if thing.distance_m is None else thing.distance_m for thing in noticed]
        return Reading(
            relation=torch.stack([thing.relation for thing in noticed]),
            label=torch.stack([label[thing.noun] for thing in noticed]),
            colour=torch.stack([thing.colour for thing in noticed]) @ self._colours,
            distance_m=torch.tensor(said),
            absent=torch.tensor([thing.absent for thing in noticed]),
        )

    def sentences(self, hints: Sequence[ParsedHint], reading: Reading) -> tuple[str, ...]:
        """Hints in the words that a retriever knows: template sentences of the map's own classes and colours.

        A hint that is absent, means nothing that the map has, or says no direction has none.

        Args:
            hints: as they were read.
            reading: of them.
        """
        label, trust = reading.label.argmax(dim=1).tolist(), reading.label.amax(dim=1).tolist()
        colour = reading.colour.argmax(dim=1).tolist()
        direction = (reading.relation @ _DIRECTION_OF_RELATION).argmax(dim=1).tolist()
        return tuple(
            render_hint(Hint(DIRECTIONS[direction[n]], self.labels[label[n]], (*self._words, None)[colour[n]]))
            for n, hint in enumerate(hints)
            if hint.absent < LIKELY and trust[n] >= TRUSTED
        )

    def nothing(self) -> Reading:
        """A text that names nothing: one hint that anything fits."""
        colour = torch.zeros(1, self._colours.shape[1])
        colour[0, -1] = 1.0
        label = torch.full((1, len(self.labels)), 1 / len(self.labels))
        relation = torch.zeros(1, len(RELATIONS))
        relation[0, -1] = 1.0
        return Reading(relation, label, colour, torch.tensor([float("nan")]), torch.zeros(1))


def colour_table(palette: Palette) -> Tensor:
    """[C + 1, W + 1] from the reader's colours to a palette's words; the last of both, that none is said.

    A colour that the palette has no word for goes to the words of the most alike.
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
        weight = np.exp(-(distance**2) / (2 * _ALIKE**2))
        for word, value in zip(palette.words, weight / weight.sum(), strict=True):
            table[row, words.index(word)] += float(value)
    return table


def centers_of(colour: str) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """[n, 3] rgb centres (0..255) of a colour of the reader."""
    for palette in (BASIC_PALETTE, KITTI360_PALETTE):
        if colour in palette.words:
            return np.array([c for word, c in zip(palette.words, palette.centers, strict=True) if word == colour])
    raise ValueError(f"no palette has '{colour}'")


def _directions_of_relations() -> Tensor:
    """[10, 5] how much of each relation each of DIRECTIONS is: between two winds half of both, "near" right at it."""
    table = torch.zeros(len(RELATIONS), len(DIRECTIONS))
    for row, relation in enumerate(RELATIONS):
        winds = [n for n, direction in enumerate(DIRECTIONS[:4]) if direction in relation]
        table[row, winds or [DIRECTIONS.index("on-top")]] = 1 / max(1, len(winds))
    return table


_DIRECTION_OF_RELATION = _directions_of_relations()
