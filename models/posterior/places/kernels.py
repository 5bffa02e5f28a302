"""Kernels: the likelihood of a mention by distance and direction (docs/method.md, places)."""

from typing import Final

import torch
from torch import Tensor, nn

from models.language.mentions.mentions import Mention

# Initial scales, in metres, of each type of mention; fitted on training texts afterwards.
SCALES: Final = {
    "at": 8.0, "outside": 10.0, "beside": 14.0, "near": 30.0, "across": 14.0, "inside": 10.0, "past": 40.0,
    "off": 30.0, "on": 14.0, "far": 60.0, "block": 70.0, "wind": 60.0, "seen": 28.0, "side": 22.0, "ahead": 30.0,
    "behind": 25.0, "street": 10.0, "street near": 35.0, "corner": 16.0, "corner near": 35.0, "span": 10.0,
    "address": 14.0,
}  # fmt: skip
TYPES: Final = tuple(SCALES)
# Initial probabilities that a mention is no evidence: misread, wrong or not on the map.
FLOORS: Final = {"exact": 0.10, "part": 0.25, "kind": 0.20, "street": 0.06, "corner": 0.08}
FLOOR_NAMES: Final = tuple(FLOORS)
HEADINGS: Final = 16
INITIAL_ACROSS_M: Final = 24.0  # from an object to the other side of its street; fitted afterwards
KERNEL_POWER: Final = 1.5
MAX_AHEAD_DEG: Final = 60.0  # from ahead or behind; beyond, an object is at the side


class PlaceKernels(nn.Module):
    """The weights: scales, tails and floors, precision of directions and distances. Parameters are logs or logits."""

    def __init__(self) -> None:
        super().__init__()
        self.scale = nn.Parameter(torch.tensor(list(SCALES.values())).log())
        self.tail = nn.Parameter(torch.full((len(SCALES),), -1.4))  # logit of the share of the heavy tail
        self.floor = nn.Parameter(torch.tensor(list(FLOORS.values())).logit())
        self.across_m = nn.Parameter(torch.tensor(INITIAL_ACROSS_M).log())
        self.ego = nn.Parameter(torch.tensor(2.0).log())  # log concentration of left, right, ahead, behind
        self.wind = nn.Parameter(torch.tensor(2.0).log())
        self.listener = nn.Parameter(torch.tensor(2.5).log())  # of winds seen from the listener
        self.slip = nn.Parameter(torch.tensor(0.1).logit())  # of directions
        self.measured = nn.Parameter(torch.tensor([0.4, 0.7]).log())  # log-normal width of exact and of loose distances
        self.side_m = nn.Parameter(torch.tensor(4.0).log())  # how sharp the side of a street is
        self.walk_m = nn.Parameter(torch.tensor(4.0).log())  # how far people stand from where they walk
        self.walk_floor = nn.Parameter(torch.tensor(0.12).logit())  # how seldom they stand elsewhere
        self.temper = nn.Parameter(torch.tensor(0.0))  # log power of the whole

    def near(self, kind: int, metres: Tensor) -> Tensor:
        """Return the kernel of a type of TYPES at distances, at most 1."""
        scale, tail = self.scale[kind].exp(), self.tail[kind].sigmoid()
        if TYPES[kind] == "across":
            ring = torch.exp(-0.5 * ((metres - self.across_m.exp()) / scale) ** 2)
        else:
            ring = torch.exp(-((metres / scale).clamp(min=1e-4) ** KERNEL_POWER))
        return (1 - tail) * ring + tail * torch.exp(-metres / (4 * scale))

    def stated_distance(self, metres: Tensor, stated_m: float, *, is_loose: bool) -> Tensor:
        """Return the kernel of a stated distance."""
        width = self.measured[int(is_loose)].exp()
        ratio = torch.log((metres + 4.0) / (stated_m + 4.0))
        return torch.exp(-0.5 * (ratio / width) ** 2)

    def toward(self, concentration: Tensor, cosine: Tensor, metres: Tensor) -> Tensor:
        """Return the density, 1 on average, of a direction by the cosine of its angle; nearby things may be in any."""
        kappa = concentration.exp() * metres / (metres + 4.0)
        slip = self.slip.sigmoid()
        return (1 - slip) / torch.special.i0e(kappa) * torch.exp(kappa * (cosine - 1)) + slip

    def standing(self, metres: Tensor) -> Tensor:
        """Return the log density, up to a constant, of people at distances from where people walk."""
        floor = self.walk_floor.sigmoid()
        return torch.log(floor + (1 - floor) * torch.exp(-0.5 * (metres / self.walk_m.exp()) ** 2))

    def on_side(self, metres: Tensor) -> Tensor:
        """Return the kernel of distances on the stated side of a street, negative on the other side."""
        return 2 * torch.sigmoid(metres / self.side_m.exp()) * 0.95 + 0.05


def kernel_of(mention: Mention, angle: float | None) -> int:
    """Return the row of TYPES of a mention at an angle from ahead."""
    relation = mention.cue.relation
    loose = relation in ("near", "far", "past", "off", "across", "block", "wind")
    if mention.form == "street":
        return TYPES.index("street near" if loose or angle is not None else "street")
    if mention.form == "corner":
        return TYPES.index("corner near" if relation in ("near", "far", "past", "off", "block", "wind") else "corner")
    if mention.form in ("address", "point"):
        return TYPES.index("across" if relation == "across" else "address")
    if mention.form == "span":
        return TYPES.index("span")
    if relation == "seen" and angle is not None:
        off = abs(angle)
        return TYPES.index("ahead" if off < MAX_AHEAD_DEG else "behind" if off > 180.0 - MAX_AHEAD_DEG else "side")
    return TYPES.index(relation)


def floor_name(mention: Mention) -> str:
    """Return the row name of FLOORS for a mention."""
    if mention.form == "street":
        return "street"
    if mention.form in ("corner", "span", "address", "point"):
        return "corner"
    if mention.kinds and not mention.is_exact and mention.trust == 1.0:
        return "kind"
    return "exact" if mention.is_exact else "part"
