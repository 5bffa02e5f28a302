"""The likelihood of hints about what is near a position (docs/method.md, near hints)."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import torch
from torch import Tensor, nn

from models.citymap.colours import Palette
from models.posterior.neighbours.neighbours import STEP_M
from models.posterior.node_batch import OFFSET, RANKS, NodeBatch, colour_words

HABITS: Final = 3
FAINT: Final = 5e-3  # what fits a hint less than this is left to chance
SPOKEN: Final = 0.05  # of being absent, from which on that is heeded


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """What H hints say, in a map's own labels and colours.

    Attributes:
        relation: [H, 10] probability of each of RELATIONS: where the speaker is, seen from the thing.
        label: [H, L] probability of each of the map's labels; what is missing to 1, of none of them.
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
class Pairs:
    """Which instance may be meant by which hint at which node.

    Attributes:
        row: [K] row of the nodes' surroundings, ascending.
        hint: [K] number of the hint.
        fits: [K] p(class) p(colour) p(direction).
    """

    row: Tensor
    hint: Tensor
    fits: Tensor


class Likelihood(nn.Module):
    """log p(T | x) = sum over hints of log(eps + sum over instances of pi * p(class) * p(colour) * p(direction)).

    pi falls with distance and rank and is shared among what is near; an instance that explains several hints counts
    less for each (at most one hint an instance, softly). eps, a hint that nothing explains, is likelier for what is
    said often in the map. About a hundred weights, fitted by maximum likelihood on training towns
    (`models.training.posterior.fit_likelihood`).
    """

    def __init__(self) -> None:
        super().__init__()
        self.background = nn.Parameter(torch.tensor(-5.5))  # log eps of anything
        self.common = nn.Parameter(torch.tensor(-3.0))  # log eps of what all of the map is like
        # Log softness of the borders between winds, from what is exact and from what is vague, see `MapObjects`.
        self.border_m = nn.Parameter(torch.tensor([-0.7, -0.7]))
        self.on_top_m = nn.Parameter(torch.tensor([0.46, -1.4]))  # log radius and softness of "on-top"
        # log pi by metres / 10, and by their square / 100
        self.distance = nn.Parameter(torch.full((2, HABITS), -0.33))
        # People tell of the nearest things, of one of each kind, or of one in each direction: a mixture of habits.
        self.ranks = nn.ParameterList(nn.Parameter(_falling(size, n)) for n, size in enumerate(RANKS))
        # Of what a habit tells one of, each is told of the less, the more there are: powers of their number.
        self.among = nn.Parameter(torch.tensor([[0.0, 0.5, 0.0], [0.0, 0.0, 0.5]]))
        self.habit = nn.Parameter(torch.zeros(HABITS))  # log weights of the mixture
        self.partly = nn.Parameter(torch.tensor(-3.1))  # log weight of a thing of which little is near
        self.crowding = nn.Parameter(torch.tensor(0.7))  # power of the sum of pi that each is divided by
        self.colour_spread = nn.Parameter(torch.tensor(-4.0))  # log, in units of rgb
        self.colour_slip = nn.Parameter(torch.tensor(-4.1))  # log chance of a wrong colour word
        self.unknown_colour = nn.Parameter(torch.tensor(-2.0))  # log chance of a word for what has no known colour
        self.relation_slip = nn.Parameter(torch.tensor(-5.0))  # log chance of a wrong direction, said or read
        self.twice = nn.Parameter(torch.tensor(1.0))  # log power of the discount on what explains several hints
        self.near = nn.Parameter(torch.tensor(-1.5))  # log of 1 / metres that "near" falls over
        self.measured = nn.Parameter(torch.tensor(-1.2))  # log of the relative error of a said distance
        self.temper = nn.Parameter(torch.tensor(0.3))  # log power of the whole
        x = (torch.arange(256) - OFFSET) * STEP_M
        self._way = (x[:, None].expand(256, 256).reshape(-1), x[None].expand(256, 256).reshape(-1))

    def log_pi(self) -> Tensor:
        """[65536, 3] log pi of every way by habit, whatever else is near."""
        radius = torch.hypot(*self._way)[:, None]
        return (self.distance[0] * radius + self.distance[1] * radius**2 / 10) / 10

    def share_of(self, batch: NodeBatch, log_pi: Tensor) -> Tensor:
        """[R, 3] pi of each row by habit, shared among what is near, of any text; `log_pi` of the method."""
        node, rank = batch.node, batch.rank
        ranked = rank[:, len(RANKS) :].float().log() @ -self.among
        for n, weight in enumerate(self.ranks):
            ranked = ranked + weight.index_select(0, rank[:, n])
        pi = (log_pi.index_select(0, batch.way) + torch.where(batch.whole, 0.0, self.partly)[:, None] + ranked).exp()
        mass = torch.zeros(batch.nodes, HABITS).index_add(0, node, pi) + 1e-3
        return pi * (mass**-self.crowding).index_select(0, node)

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
        return reading.label.T.contiguous().index_select(0, label) * colour

    def ways(self) -> Tensor:
        """[2 * 65536, 11] p(relation) for every way from what is exact, then from what is vague; last, its metres."""
        east, north = self._way
        radius = torch.hypot(east, north)
        on_top = torch.sigmoid((self.on_top_m[0].exp() - radius) / self.on_top_m[1].exp())
        half = 2**-0.5
        # North, say, is where north exceeds east and west; northeast the same, half a quarter turn on.
        axes = torch.stack([north, (north + east) * half, east, (east - north) * half])
        axes = torch.cat([axes, -axes])
        near = (on_top + torch.exp(-self.near.exp() * radius)) / 2  # who is beside a thing may be right at it
        tables = []
        for soft_m in self.border_m.exp():
            winds = torch.sigmoid((axes - axes.roll(2, 0).abs()) / soft_m) * (1 - on_top)
            tables.append(torch.cat([winds, on_top[None], near[None], radius[None]]).T)
        return torch.cat(tables).contiguous()

    def places(self, reading: Reading, ways: Tensor) -> Tensor:
        """[K, H] p(direction) p(distance) for K rows of the method `ways`."""
        place = torch.addmm(self.relation_slip.exp(), ways[:, :-1], reading.relation.T)
        said = reading.distance_m
        if bool((~said.isnan()).any()):
            known = said.nan_to_num(1.0)  # a NaN that is not chosen would still be in the gradients
            spread = self.measured.exp() * known + 1.0
            fits = torch.exp(-((ways[:, -1:] - known) ** 2) / (2 * spread**2))
            place = torch.where(said.isnan(), place, place * fits)
        return place

    def pairs(self, reading: Reading, parts: Tensor, part: Tensor, ways: Tensor, towards: Tensor) -> Pairs:
        """What each hint may mean, without what is too faint.

        Args:
            reading: the text.
            parts: [P, H] of the method `parts`.
            part: [R] row of `parts`.
            ways: of the method of this name.
            towards: [R] row of `ways` of each.
        """
        known = (parts.detach().amax(dim=1) > FAINT).index_select(0, part).nonzero().flatten()
        place = self.places(reading, ways.index_select(0, towards.index_select(0, known)))
        fits = (parts.index_select(0, part.index_select(0, known)) * place).flatten()
        kept = (fits.detach() > FAINT).nonzero().flatten()
        row = torch.div(kept, parts.shape[1], rounding_mode="floor")
        return Pairs(known.index_select(0, row), kept - row * parts.shape[1], fits.index_select(0, kept))

    def chance(self, reading: Reading, usual: Tensor) -> Tensor:
        """[H] eps of each hint; `usual` as `usual_statements`."""
        share = ((reading.label[:, : len(usual)] @ usual) * reading.colour).sum(dim=1)
        eps = self.background.exp() + self.common.exp() * share
        return eps

    def combine(self, reading: Reading, node: Tensor, nodes: int, pairs: Pairs, share: Tensor, eps: Tensor) -> Tensor:
        """[M] log p(T | x).

        Args:
            reading: the text.
            node: [R] node of each row.
            nodes: M.
            pairs: what each hint may mean.
            share: [K, 3] of `share_of`, of the row of each pair.
            eps: [H] of `chance`.
        """
        hints, row = len(eps), pairs.row
        key = node.index_select(0, row) * hints + pairs.hint
        terms = (pairs.fits[:, None] * share).T.contiguous()  # [3, K]: sums along the last axis are the fast ones
        first = terms.new_zeros(HABITS, nodes * hints).index_add(1, key, terms)
        explained = first + eps.repeat(nodes)
        load = terms.new_zeros(HABITS, len(node)).index_add(1, row, terms / explained.index_select(1, key))
        single = torch.exp(-self.twice.exp() * (load.index_select(1, row) - 1).clamp(min=0).log1p())
        total = torch.zeros_like(first).index_add(1, key, terms * single)
        said = (total.view(HABITS, nodes, hints) + eps).log()
        if bool((reading.absent > SPOKEN).any()):
            # "There is none": the less there is of it, the likelier.
            around = first.view_as(said) / eps.detach().clamp(min=1e-2)
            none = torch.exp(-3 * around).clamp(min=1e-2).log()
            said = said * (1 - reading.absent) + none * reading.absent
        mixed: Tensor = (said @ torch.ones(hints) + self.habit.log_softmax(0)[:, None]).logsumexp(dim=0)
        return self.temper.exp() * mixed

    def tables(self) -> tuple[Tensor, Tensor]:
        """Return `ways` and `log_pi`, which no description changes: compute them once where nothing is learnt."""
        return self.ways(), self.log_pi()

    def forward(
        self,
        reading: Reading,
        around: NodeBatch,
        palette: Palette,
        usual: Tensor,
        tables: tuple[Tensor, Tensor] | None = None,
    ) -> Tensor:
        """[M] log p(T | x), up to a constant; `usual` as `usual_statements`, `tables` of the method `tables`."""
        ways, log_pi = tables or self.tables()
        fits = self.parts(reading, around.label, self.words(around.rgb, palette))
        share = self.share_of(around, log_pi)
        pairs = self.pairs(reading, fits, around.part, ways, around.towards)
        eps = self.chance(reading, usual)
        return self.combine(reading, around.node, around.nodes, pairs, share.index_select(0, pairs.row), eps)

    def explain(
        self, reading: Reading, around: NodeBatch, palette: Palette, usual: Tensor, tables: tuple[Tensor, Tensor]
    ) -> tuple[Tensor, Tensor]:
        """For each hint, the row of `around` (of one node) that explains it best, and the probability that any does.

        A label that may be wrong explains less: at most twice its probability.
        """
        ways, log_pi = tables
        fits = self.parts(reading, around.label, self.words(around.rgb, palette)).index_select(0, around.part)
        place = self.places(reading, ways.index_select(0, around.towards))
        terms = fits * place * self.share_of(around, log_pi).mean(dim=1, keepdim=True)
        total, best = terms.sum(dim=0), terms.argmax(dim=0)
        label = reading.label.gather(1, around.label[around.part[best]][:, None])[:, 0]
        return best, total / (total + self.chance(reading, usual)) * (2 * label).clamp(max=1.0)


def _falling(size: int, habit: int) -> Tensor:
    """[size, 3] weights by how many come before, of which one habit heeds those of this kind."""
    weights = torch.zeros(size, HABITS)
    weights[6 if habit == 0 else 1 :, habit] = -1.0
    return weights
