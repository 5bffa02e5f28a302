"""The likelihood of hints about what is near a position (docs/method.md, near hints)."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import torch
from torch import Tensor, nn

from models.citymap.colours import Palette
from models.posterior.neighbours.neighbours import STEP_M
from models.posterior.node_batch import OFFSET_STEPS, RANKS, NodeBatch, colour_words

HABITS: Final = 3
MIN_FIT: Final = 5e-3  # objects that fit a hint less count as background, which saves time
MIN_ABSENT_PROBABILITY: Final = 0.05  # below, the absence of a hint is ignored


@dataclass(frozen=True, slots=True, eq=False)
class BoundHints:
    """H hints as distributions over a map's own labels and colours."""

    relation: Tensor  # [H, 10] probability of each of RELATIONS: where the speaker is, seen from the object
    label: Tensor  # [H, L] probability of each label; the rest to 1 is that of none of them
    colour: Tensor  # [H, W + 1] probability of each colour word; last, that none was stated
    distance_m: Tensor  # [H] stated distance, NaN without one
    absent: Tensor  # [H] probability that the hint denies the object


@dataclass(frozen=True, slots=True, eq=False)
class Pairs:
    """K pairs of a neighbour and a hint that may mean it."""

    row: Tensor  # [K] row of the neighbours, ascending
    hint: Tensor  # [K]
    fits: Tensor  # [K] p(label) p(colour) p(relation) p(distance)


class Likelihood(nn.Module):
    """log p(T | x) by hints, neighbours and habits (docs/method.md, M23 to M26).

    About a hundred weights, fitted by `models.training.posterior.fit_likelihood`.
    """

    def __init__(self) -> None:
        super().__init__()
        self.background = nn.Parameter(torch.tensor(-5.5))  # log eps of anything
        self.common = nn.Parameter(torch.tensor(-3.0))  # log eps of a hint that fits all of the map
        # Log softness of the borders between winds, for exact and for vague objects, see `MapObjects`.
        self.border_m = nn.Parameter(torch.tensor([-0.7, -0.7]))
        self.on_top_m = nn.Parameter(torch.tensor([0.46, -1.4]))  # log radius and softness of "on-top"
        # log pi by metres / 10, and by their square / 100
        self.distance = nn.Parameter(torch.full((2, HABITS), -0.33))
        # People mention the nearest objects, one of each class, or one in each direction: a mixture of habits.
        self.ranks = nn.ParameterList(nn.Parameter(_initial_rank_weights(size, n)) for n, size in enumerate(RANKS))
        # The more objects of a class or direction, the less each is mentioned: powers of their number.
        self.among = nn.Parameter(torch.tensor([[0.0, 0.5, 0.0], [0.0, 0.0, 0.5]]))
        self.habit = nn.Parameter(torch.zeros(HABITS))  # log weights of the mixture
        self.partly = nn.Parameter(torch.tensor(-3.1))  # log weight of an object of which little is near
        self.crowding = nn.Parameter(torch.tensor(0.7))  # power of the sum of pi that each is divided by
        self.colour_spread = nn.Parameter(torch.tensor(-4.0))  # log, in units of rgb
        self.colour_slip = nn.Parameter(torch.tensor(-4.1))  # log probability of a wrong colour word
        self.unknown_colour = nn.Parameter(torch.tensor(-2.0))  # log probability of a word for an unknown colour
        self.relation_slip = nn.Parameter(torch.tensor(-5.0))  # log probability of a wrong relation
        self.twice = nn.Parameter(torch.tensor(1.0))  # log power of the discount on an object for several hints
        self.near = nn.Parameter(torch.tensor(-1.5))  # log of 1 / metres that "near" falls over
        self.measured = nn.Parameter(torch.tensor(-1.2))  # log of the relative error of a stated distance
        self.temper = nn.Parameter(torch.tensor(0.3))  # log power of the whole
        x = (torch.arange(256) - OFFSET_STEPS) * STEP_M
        self._offset_m = (x[:, None].expand(256, 256).reshape(-1), x[None].expand(256, 256).reshape(-1))

    def log_pi(self) -> Tensor:
        """Return log pi [65536, 3] of every offset by habit, without the effect of other objects."""
        radius = torch.hypot(*self._offset_m)[:, None]
        return (self.distance[0] * radius + self.distance[1] * radius**2 / 10) / 10

    def mention_share(self, batch: NodeBatch, log_pi: Tensor) -> Tensor:
        """Return pi [R, 3] of each neighbour by habit, shared among those of a node; the same for any text."""
        node, rank = batch.node, batch.rank
        ranked = rank[:, len(RANKS) :].float().log() @ -self.among
        for n, weight in enumerate(self.ranks):
            ranked = ranked + weight.index_select(0, rank[:, n])
        partly = torch.where(batch.whole, 0.0, self.partly)[:, None]
        pi = (log_pi.index_select(0, batch.offset_code) + partly + ranked).exp()
        mass = torch.zeros(batch.nodes, HABITS).index_add(0, node, pi) + 1e-3
        return pi * (mass**-self.crowding).index_select(0, node)

    def colour_word_p(self, rgb: Tensor, palette: Palette) -> Tensor:
        """Return the probability [P, W] of each of the palette's words for colours [P, 3]."""
        centers = torch.tensor(np.asarray(palette.centers) / 255, dtype=torch.float32)
        names = colour_words(palette)
        column = torch.tensor([names.index(word) for word in palette.words])
        distance = torch.cdist(rgb.nan_to_num(), centers) ** 2
        word = torch.softmax(-distance / (2 * self.colour_spread.exp() ** 2), dim=1)
        p = torch.zeros(len(rgb), len(names)).index_add(1, column, word) + self.colour_slip.exp()
        return torch.where(rgb.isnan().any(dim=1, keepdim=True), self.unknown_colour.exp(), p)

    def appearance_fit(self, hints: BoundHints, label: Tensor, colour_word_p: Tensor) -> Tensor:
        """Return p(label) p(colour) [P, H] of objects with labels [P] and colour words [P, W]."""
        count = colour_word_p.shape[1]
        colour = colour_word_p @ hints.colour[:, :count].T + hints.colour[:, count]
        return hints.label.T.contiguous().index_select(0, label) * colour

    def relation_table(self) -> Tensor:
        """Return p(relation) [2 * 65536, 11] of each offset, of exact objects, then of vague ones; last, its metres."""
        east, north = self._offset_m
        radius = torch.hypot(east, north)
        on_top = torch.sigmoid((self.on_top_m[0].exp() - radius) / self.on_top_m[1].exp())
        half = 2**-0.5
        # "north" holds where north exceeds east and west; "northeast" is the same, turned by 45 degrees.
        axes = torch.stack([north, (north + east) * half, east, (east - north) * half])
        axes = torch.cat([axes, -axes])
        near = (on_top + torch.exp(-self.near.exp() * radius)) / 2  # "near" may mean right at the object
        tables = []
        for soft_m in self.border_m.exp():
            winds = torch.sigmoid((axes - axes.roll(2, 0).abs()) / soft_m) * (1 - on_top)
            tables.append(torch.cat([winds, on_top[None], near[None], radius[None]]).T)
        return torch.cat(tables).contiguous()

    def position_fit(self, hints: BoundHints, relation_rows: Tensor) -> Tensor:
        """Return p(relation) p(distance) [K, H] for K rows of `relation_table`."""
        fit = torch.addmm(self.relation_slip.exp(), relation_rows[:, :-1], hints.relation.T)
        stated_m = hints.distance_m
        if bool((~stated_m.isnan()).any()):
            known_m = stated_m.nan_to_num(1.0)  # a NaN, even unused, would spoil the gradients
            spread_m = self.measured.exp() * known_m + 1.0
            distance_fit = torch.exp(-((relation_rows[:, -1:] - known_m) ** 2) / (2 * spread_m**2))
            fit = torch.where(stated_m.isnan(), fit, fit * distance_fit)
        return fit

    def find_pairs(
        self, hints: BoundHints, appearance: Tensor, part: Tensor, relation_table: Tensor, relation_row: Tensor
    ) -> Pairs:
        """Return the pairs of neighbour and hint that fit.

        Neighbours [R] have a `part`, a row of `appearance` [P, H], and a row of `relation_table`.
        """
        known = (appearance.detach().amax(dim=1) > MIN_FIT).index_select(0, part).nonzero().flatten()
        position = self.position_fit(hints, relation_table.index_select(0, relation_row.index_select(0, known)))
        fits = (appearance.index_select(0, part.index_select(0, known)) * position).flatten()
        fitting = (fits.detach() > MIN_FIT).nonzero().flatten()
        row = torch.div(fitting, appearance.shape[1], rounding_mode="floor")
        return Pairs(known.index_select(0, row), fitting - row * appearance.shape[1], fits.index_select(0, fitting))

    def background_p(self, hints: BoundHints, mean_statements: Tensor) -> Tensor:
        """Return eps [H] of each hint; `mean_statements` as the function of this name returns them."""
        share = ((hints.label[:, : len(mean_statements)] @ mean_statements) * hints.colour).sum(dim=1)
        eps = self.background.exp() + self.common.exp() * share
        return eps

    def combine(self, hints: BoundHints, node: Tensor, nodes: int, pairs: Pairs, share: Tensor, eps: Tensor) -> Tensor:
        """Return log p(T | x) [M] of M nodes.

        `node` [R] is that of each neighbour, `share` [K, 3] the mention share of each pair, `eps` [H] the background.
        """
        count, row = len(eps), pairs.row
        key = node.index_select(0, row) * count + pairs.hint
        terms = (pairs.fits[:, None] * share).T.contiguous()  # [3, K]: sums along the last axis are fast
        first = terms.new_zeros(HABITS, nodes * count).index_add(1, key, terms)
        explained = first + eps.repeat(nodes)
        load = terms.new_zeros(HABITS, len(node)).index_add(1, row, terms / explained.index_select(1, key))
        single = torch.exp(-self.twice.exp() * (load.index_select(1, row) - 1).clamp(min=0).log1p())
        total = torch.zeros_like(first).index_add(1, key, terms * single)
        log_p = (total.view(HABITS, nodes, count) + eps).log()
        if bool((hints.absent > MIN_ABSENT_PROBABILITY).any()):
            # The fewer such objects are near, the likelier is "there is none".
            present = first.view_as(log_p) / eps.detach().clamp(min=1e-2)
            none = torch.exp(-3 * present).clamp(min=1e-2).log()
            log_p = log_p * (1 - hints.absent) + none * hints.absent
        mixed: Tensor = (log_p @ torch.ones(count) + self.habit.log_softmax(0)[:, None]).logsumexp(dim=0)
        return self.temper.exp() * mixed

    def tables(self) -> tuple[Tensor, Tensor]:
        """Return `relation_table` and `log_pi`, which do not depend on the text."""
        return self.relation_table(), self.log_pi()

    def forward(
        self,
        hints: BoundHints,
        batch: NodeBatch,
        palette: Palette,
        mean_statements: Tensor,
        tables: tuple[Tensor, Tensor] | None = None,
    ) -> Tensor:
        """Return log p(T | x) [M], up to a constant; pass `tables` unless the weights change."""
        relation_table, log_pi = tables or self.tables()
        appearance = self.appearance_fit(hints, batch.label, self.colour_word_p(batch.rgb, palette))
        share = self.mention_share(batch, log_pi)
        pairs = self.find_pairs(hints, appearance, batch.part, relation_table, batch.relation_row)
        eps = self.background_p(hints, mean_statements)
        return self.combine(hints, batch.node, batch.nodes, pairs, share.index_select(0, pairs.row), eps)

    def explain(
        self,
        hints: BoundHints,
        batch: NodeBatch,
        palette: Palette,
        mean_statements: Tensor,
        tables: tuple[Tensor, Tensor],
    ) -> tuple[Tensor, Tensor]:
        """Return the row of `batch` (of one node) that explains each hint best, and the probability that any does.

        An uncertain label limits the probability to twice its own.
        """
        relation_table, log_pi = tables
        appearance = self.appearance_fit(hints, batch.label, self.colour_word_p(batch.rgb, palette))
        position = self.position_fit(hints, relation_table.index_select(0, batch.relation_row))
        share = self.mention_share(batch, log_pi).mean(dim=1, keepdim=True)
        terms = appearance.index_select(0, batch.part) * position * share
        total, best = terms.sum(dim=0), terms.argmax(dim=0)
        label = hints.label.gather(1, batch.label[batch.part[best]][:, None])[:, 0]
        return best, total / (total + self.background_p(hints, mean_statements)) * (2 * label).clamp(max=1.0)


def _initial_rank_weights(size: int, habit: int) -> Tensor:
    """Return the weights [size, 3] of ranks; only one habit cares about each kind of rank at first."""
    weights = torch.zeros(size, HABITS)
    weights[6 if habit == 0 else 1 :, habit] = -1.0
    return weights
