"""How likely a description is at a position (method.md, the hint posterior)."""

from dataclasses import dataclass
from typing import Final

import torch
from torch import Tensor, nn

from models.city.hints import ON_TOP_M
from models.city.surroundings import STEP_M

# Where the speaker is, seen from the thing: the eight winds, right at it, or not said.
WINDS: Final = ("north", "northeast", "east", "southeast", "south", "southwest", "west", "northwest")
RELATIONS: Final = (*WINDS, "on-top", "near")
TURNS: Final = (16, 4, 4)  # numbers beyond these are as their last
_OFFSET = 128  # ways are int8; a pair of them numbers a row of the tables


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """What H hints say.

    Attributes:
        relation: [H, 10] probability of each of RELATIONS.
        label: [H, L] how well each of the map's labels fits what is named, 0..1.
        colour: [H, W + 1] probability of each of the palette's words; the last, that none was said.
        distance_m: [H] said distance, NaN if none was.
        absent: [H] probability that the hint says there is none of it.
    """

    relation: Tensor
    label: Tensor
    colour: Tensor
    distance_m: Tensor
    absent: Tensor


@dataclass(frozen=True, slots=True, eq=False)
class Around:
    """The surroundings of M nodes, as torch takes them.

    Attributes:
        node: [R] node of each row, ascending.
        way: [R] number of the way from the instance's closest point, see `way_number`.
        whole: [R] bool, see `models.city.surroundings.Surroundings`.
        turn: [R, 3] how many nearer instances there are: in all, of its class, in its direction; see TURNS.
        part: [R] row of `label` and `rgb`.
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
    """log p(T | x) = sum over hints of log(eps + (1 - eps) * sum over instances of pi * p(class) p(colour) p(direction)).

    pi falls with distance and is shared among what is near; at most one hint an instance, softly. All weights are few,
    and fitted by maximum likelihood on training towns (`models.training.posterior`).
    """

    def __init__(self, palette_rgb: Tensor) -> None:
        super().__init__()
        self.palette_rgb = palette_rgb  # [C, 3] and the word of each
        self.background = nn.Parameter(torch.tensor(-5.0))  # log eps, in units of one symbol's chance
        self.border_m = nn.Parameter(torch.tensor(0.7).log())  # softness of the borders between winds
        self.on_top_m = nn.Parameter(torch.tensor([1.6, 0.5]).log())  # radius and softness of "on-top"
        self.distance = nn.Parameter(torch.tensor([-0.1, -0.1]))  # log pi falls with metres / 10, and its square
        self.turns = nn.ParameterList(nn.Parameter(torch.zeros(size)) for size in TURNS)
        self.partly = nn.Parameter(torch.tensor(-3.0))  # log weight of a thing of which little is near
        self.crowding = nn.Parameter(torch.tensor(0.5))  # power of the sum of pi that each is divided by
        self.colour_spread = nn.Parameter(torch.tensor(0.04).log())
        self.colour_slip = nn.Parameter(torch.tensor(-3.0))  # log chance of any other colour word
        self.unknown_colour = nn.Parameter(torch.tensor(-2.0))
        self.label_slip = nn.Parameter(torch.tensor(-6.0))
        self.twice = nn.Parameter(torch.tensor(0.0))  # how much an instance that explains much is discounted
        self.temper = nn.Parameter(torch.tensor(0.0))  # log power of the whole
        x = (torch.arange(256) - _OFFSET) * STEP_M
        self._way = (x[:, None].expand(256, 256).reshape(-1), x[None].expand(256, 256).reshape(-1))

    def tables(self) -> tuple[Tensor, Tensor, Tensor]:
        """For every way [65536]: log pi, p of each relation [65536, 10], and the distance in metres."""
        east, north = self._way
        radius = torch.hypot(east, north)
        on_top = torch.sigmoid((self.on_top_m[0].exp() - radius) / self.on_top_m[1].exp())
        border = self.border_m.exp()
        half = 2**-0.5
        # North, say, is where north exceeds east and west; northeast the same a turn of 45 degrees on.
        axes = torch.stack([north, (north + east) * half, east, (east - north) * half])
        axes = torch.cat([axes, -axes])  # [8, 65536] along each wind
        across = axes.roll(2, 0).abs()
        winds = torch.sigmoid((axes - across) / border) * (1 - on_top)
        log_pi = (self.distance[0] * radius + self.distance[1] * radius**2 / 10) / 10
        return log_pi, torch.cat([winds, on_top[None], torch.ones_like(on_top)[None]]).T, radius

    def parts(self, reading: Reading, around: Around) -> Tensor:
        """[P, H] p(class) p(colour) of each part."""
        label = reading.label.T[around.label]
        slip = self.label_slip.exp()
        known = ~around.rgb.isnan().any(dim=1)
        distance = torch.cdist(around.rgb.nan_to_num(), self.palette_rgb) ** 2
        word = torch.softmax(-distance / (2 * self.colour_spread.exp() ** 2), dim=1)  # [P, C]
        words = word.shape[1]
        word = word + self.colour_slip.exp()
        word = torch.where(known[:, None], word, self.unknown_colour.exp())
        said = reading.colour[:, :words]
        colour = word @ said.T + reading.colour[:, words]
        return (label + slip) * colour

    def forward(self, reading: Reading, around: Around) -> Tensor:
        """[M] log p(T | x), up to a constant."""
        log_pi, relations, _radius = self.tables()
        place = relations @ reading.relation.T  # [65536, H]
        turn = torch.stack([weight[around.turn[:, n]] for n, weight in enumerate(self.turns)]).sum(dim=0)
        pi = (log_pi[around.way] + turn + torch.where(around.whole, 0.0, self.partly)).exp()
        mass = torch.zeros(around.nodes).index_add(0, around.node, pi) + 1e-3
        share = pi / mass[around.node] ** self.crowding
        terms = self.parts(reading, around)[around.part] * place[around.way] * share[:, None]  # [R, H]
        empty = torch.zeros(around.nodes, terms.shape[1])
        eps = self.background.exp()
        first = empty.index_add(0, around.node, terms) + eps
        # At most one hint an instance: what explains several hints counts less for each.
        load = (terms / first[around.node]).sum(dim=1, keepdim=True)
        terms = terms * (1 + (load - 1).clamp(min=0)) ** (-self.twice.exp())
        total = empty.index_add(0, around.node, terms) + eps
        return self.temper.exp() * total.log().sum(dim=1)
