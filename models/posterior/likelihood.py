"""How likely a description is at a position (method.md, the hint posterior)."""

from dataclasses import dataclass, field
from typing import Final

import numpy as np
import torch
from torch import Tensor, nn

from models.city.colours import Palette
from models.city.hints import ON_TOP_M
from models.city.surroundings import STEP_M
from models.language.paraphrase import RELATIONS

HABITS: Final = 3
TURNS: Final = (16, 4, 4)  # numbers beyond these are as their last
_OFFSET = 128  # ways are int8; a pair of them numbers a row of the tables


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """What H hints say, in a map's own labels and colours.

    Attributes:
        relation: [H, 10] probability of each of RELATIONS: where the speaker is, seen from the thing.
        label: [H, L] probability of each of the map's labels; what is missing to 1, of none of them.
        colour: [H, W + 1] probability of each of the palette's words; the last, that none was said.
        distance_m: [H] said distance, NaN if none was.
        absent: [H] probability that the hint says there is none of it.
        named: for hints that name a landmark, by their number: [R] bool, the cells' parts that bear the name.
    """

    relation: Tensor
    label: Tensor
    colour: Tensor
    distance_m: Tensor
    absent: Tensor
    named: dict[int, Tensor] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class Around:
    """The surroundings of M nodes, as torch takes them.

    Attributes:
        node: [R] node of each row, ascending.
        way: [R] number of the way from the instance's closest point, see `way_number`.
        whole: [R] bool, see `models.city.surroundings.Surroundings`.
        turn: [R, 3] how many nearer instances there are, see `turns_of`.
        part: [R] row of `label` and `word`.
        label: [P] label of each part.
        rgb: [P, 3] colour of each, 0..1, NaN where unknown.
        nodes: M.
    """

    node: Tensor
    way: Tensor
    whole: Tensor
    turn: Tensor
    part: Tensor
    label: Tensor
    rgb: Tensor
    nodes: int


def way_number(way: Tensor) -> Tensor:
    """[R] int64 of ways [R, 2] int8."""
    shifted = way.long() + _OFFSET
    return shifted[:, 0] * 256 + shifted[:, 1]


def turns_of(node: Tensor, way: Tensor, label: Tensor) -> Tensor:
    """[R, 3] how many nearer instances a node has: in all, of the same class, in the same direction.

    Args:
        node: [R] node of each row, ascending, nearest first.
        way: [R, 2] int8, see Surroundings.
        label: [R] label of each row.
    """
    east, north = way.long().unbind(1)
    sector = torch.where(east.abs() > north.abs(), (east > 0).long(), 2 + (north > 0).long())
    sector = torch.where(torch.hypot(east.float(), north.float()) * STEP_M < ON_TOP_M, 4, sector)
    columns = [_earlier(node), _earlier(node * (int(label.max()) + 1) + label), _earlier(node * 5 + sector)]
    return torch.stack([c.clamp(max=size - 1) for c, size in zip(columns, TURNS, strict=True)], dim=1)


def _earlier(key: Tensor) -> Tensor:
    """[R] how many earlier rows have the same key."""
    ordered, order = key.sort(stable=True)
    position = torch.arange(len(key))
    is_first = torch.ones_like(ordered, dtype=torch.bool)
    is_first[1:] = ordered[1:] != ordered[:-1]
    first = torch.where(is_first, position, 0).cummax(dim=0).values
    return torch.empty_like(position).index_put_((order,), position - first)


class Likelihood(nn.Module):
    """log p(T | x) = sum over hints of log(eps + sum over instances of pi * p(class) * p(colour) * p(direction)).

    pi falls with distance and rank and is shared among what is near; an instance that explains several hints counts
    less for each (at most one hint an instance, softly). About ninety weights, fitted by maximum likelihood on training
    towns (`models.training.posterior`).
    """

    def __init__(self) -> None:
        super().__init__()
        self.background = nn.Parameter(torch.tensor(-5.5))  # log eps
        self.border_m = nn.Parameter(torch.tensor(-0.7))  # log softness of the borders between winds
        self.on_top_m = nn.Parameter(torch.tensor([0.46, -1.4]))  # log radius and softness of "on-top"
        self.distance = nn.Parameter(torch.tensor([-0.33, -0.33]))  # log pi by metres / 10, and by their square / 100
        # People tell of the nearest things, of one of each kind, or of one in each direction: a mixture of habits.
        self.turns = nn.ParameterList(nn.Parameter(_falling(size, n)) for n, size in enumerate(TURNS))
        self.habit = nn.Parameter(torch.zeros(HABITS))  # log weights of the mixture
        self.partly = nn.Parameter(torch.tensor(-3.1))  # log weight of a thing of which little is near
        self.crowding = nn.Parameter(torch.tensor(0.7))  # power of the sum of pi that each is divided by
        self.colour_spread = nn.Parameter(torch.tensor(-4.0))  # log, in units of rgb
        self.colour_slip = nn.Parameter(torch.tensor(-4.1))  # log chance of a wrong colour word
        self.unknown_colour = nn.Parameter(torch.tensor(-2.0))  # log chance of a word for what has no known colour
        self.label_slip = nn.Parameter(torch.tensor(-7.0))
        self.relation_slip = nn.Parameter(torch.tensor(-5.0))  # log chance of a wrong direction, said or read
        self.twice = nn.Parameter(torch.tensor(1.0))  # log power of the discount on what explains several hints
        self.near = nn.Parameter(torch.tensor(-1.5))  # log of 1 / metres that "near" falls over
        self.measured = nn.Parameter(torch.tensor(-1.2))  # log of the relative error of a said distance
        self.temper = nn.Parameter(torch.tensor(0.3))  # log power of the whole
        x = (torch.arange(256) - _OFFSET) * STEP_M
        self._way = (x[:, None].expand(256, 256).reshape(-1), x[None].expand(256, 256).reshape(-1))

    def share_of(self, way: Tensor, whole: Tensor, turn: Tensor, node: Tensor, nodes: int) -> Tensor:
        """[R, 3] pi of each row of M nodes by habit, shared among what is near, the same for every text; see Around."""
        radius = torch.hypot(*self._way)
        log_pi = (self.distance[0] * radius + self.distance[1] * radius**2 / 10) / 10
        turned = torch.stack([weight[turn[:, n]] for n, weight in enumerate(self.turns)]).sum(dim=0)
        pi = ((log_pi[way] + torch.where(whole, 0.0, self.partly))[:, None] + turned).exp()
        mass = torch.zeros(nodes, HABITS).index_add(0, node, pi) + 1e-3
        return pi / mass[node] ** self.crowding

    def words(self, rgb: Tensor, palette: Palette) -> Tensor:
        """[P, W] chance of each of the palette's words for colours [P, 3]."""
        centers = torch.tensor(np.asarray(palette.centers) / 255, dtype=torch.float32)
        names = colour_words(palette)
        column = torch.tensor([names.index(word) for word in palette.words])
        distance = torch.cdist(rgb.nan_to_num(), centers) ** 2
        word = torch.softmax(-distance / (2 * self.colour_spread.exp() ** 2), dim=1)
        chance = torch.zeros(len(rgb), len(names)).index_add(1, column, word) + self.colour_slip.exp()
        return torch.where(rgb.isnan().any(dim=1, keepdim=True), self.unknown_colour.exp(), chance)

    def parts(self, reading: Reading, label: Tensor, words: Tensor) -> Tensor:
        """[P, H] p(class) p(colour) of parts with labels [P] and words [P, W]."""
        count = words.shape[1]
        colour = words @ reading.colour[:, :count].T + reading.colour[:, count]
        return (reading.label.T[label] + self.label_slip.exp()) * colour

    def ways(self) -> Tensor:
        """[65536, 10] p(relation) for every way from an instance, whatever was said."""
        east, north = self._way
        radius = torch.hypot(east, north)
        on_top = torch.sigmoid((self.on_top_m[0].exp() - radius) / self.on_top_m[1].exp())
        half = 2**-0.5
        # North, say, is where north exceeds east and west; northeast the same, half a quarter turn on.
        axes = torch.stack([north, (north + east) * half, east, (east - north) * half])
        axes = torch.cat([axes, -axes])
        winds = torch.sigmoid((axes - axes.roll(2, 0).abs()) / self.border_m.exp()) * (1 - on_top)
        near = torch.exp(-self.near.exp() * radius)
        return torch.cat([winds, on_top[None], near[None]]).T.contiguous()

    def places(self, reading: Reading, ways: Tensor) -> Tensor:
        """[65536, H] p(direction) p(distance) for every way from an instance; `ways` as the method of this name."""
        place = ways @ reading.relation.T + self.relation_slip.exp()
        said = reading.distance_m
        if bool((~said.isnan()).any()):
            radius = torch.hypot(*self._way)
            known = said.nan_to_num(1.0)  # a NaN that is not chosen would still be in the gradients
            spread = self.measured.exp() * known + 1.0
            fits = torch.exp(-((radius[:, None] - known) ** 2) / (2 * spread**2))
            place = torch.where(said.isnan(), place, place * fits)
        return place

    def combine(self, reading: Reading, node: Tensor, nodes: int, fits: Tensor, share: Tensor) -> Tensor:
        """[M] log p(T | x).

        Args:
            reading: the text.
            node: [R] node of each row.
            nodes: M.
            fits: [R, H] p(class) p(colour) p(direction) of each row's instance.
            share: [R, 3] of `share_of`.
        """
        eps = self.background.exp()
        hints = fits.shape[1]
        empty = torch.zeros(nodes, hints * HABITS)
        terms = (fits[:, :, None] * share[:, None]).flatten(1)
        first = empty.index_add(0, node, terms)
        load = (terms * (1 / (first + eps))[node]).view(-1, hints, HABITS).sum(dim=1)
        single = (1 + (load - 1).clamp(min=0)) ** (-self.twice.exp())
        total = empty.index_add(0, node, (terms.view(-1, hints, HABITS) * single[:, None]).flatten(1))
        said = (total + eps).log().view(nodes, hints, HABITS)
        if bool((reading.absent > 0.05).any()):
            # "There is none": the less there is of it, the likelier.
            absent = reading.absent[:, None]
            none = torch.exp(-3 * first.view_as(said) / eps.detach().clamp(min=1e-2)).clamp(min=1e-2).log()
            said = said * (1 - absent) + none * absent
        mixed = (said.sum(dim=1) + self.habit.log_softmax(0)).logsumexp(dim=1)
        return self.temper.exp() * mixed

    def forward(self, reading: Reading, around: Around, palette: Palette) -> Tensor:
        """[M] log p(T | x), up to a constant."""
        fits = self.parts(reading, around.label, self.words(around.rgb, palette))
        share = self.share_of(around.way, around.whole, around.turn, around.node, around.nodes)
        here = fits[around.part] * self.places(reading, self.ways())[around.way]
        return self.combine(reading, around.node, around.nodes, here, share)


def _falling(size: int, habit: int) -> Tensor:
    """[size, 3] weights by how many come before, of which one habit heeds those of this kind."""
    weights = torch.zeros(size, HABITS)
    weights[6 if habit == 0 else 1 :, habit] = -1.0
    return weights


def colour_words(palette: Palette) -> list[str]:
    """A palette's words, each once, in order."""
    return list(dict.fromkeys(palette.words))


__all__ = ["RELATIONS", "Around", "Likelihood", "Reading", "colour_words", "turns_of", "way_number"]
