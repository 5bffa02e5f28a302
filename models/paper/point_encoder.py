"""PointNet++ (Qi et al., NeurIPS 2017), features of the points of an instance."""

from itertools import pairwise
from typing import Final

import torch
from torch import Tensor, nn

POINT_WIDTH: Final = 256
# For each set-abstraction level: number of points to keep, radius and number of neighbours, widths of the layers.
_LEVELS: Final = ((64, 0.2, 16, (32, 64)), (16, 0.4, 16, (64, 128)))
_LAST: Final = (128, POINT_WIDTH)


def farthest_points(xyz: Tensor, count: int) -> Tensor:
    """Return rows [R, count] of points [R, P, 3] by farthest point sampling, starting with the first point."""
    chosen = torch.zeros(len(xyz), count, dtype=torch.long, device=xyz.device)
    distance = torch.full(xyz.shape[:2], float("inf"), device=xyz.device)
    row = torch.arange(len(xyz), device=xyz.device)
    for k in range(1, count):
        distance = torch.minimum(distance, (xyz - xyz[row, chosen[:, k - 1]][:, None]).square().sum(dim=-1))
        chosen[:, k] = distance.argmax(dim=1)
    return chosen


def nearest_in_ball(xyz: Tensor, centers: Tensor, radius: float, count: int) -> Tensor:
    """Return the points [R, M, count] of xyz [R, P, 3] nearest to each centre [R, M, 3].

    The nearest one replaces those outside the radius.
    """
    distance, near = torch.cdist(centers, xyz).topk(count, dim=-1, largest=False)
    return torch.where(distance <= radius, near, near[..., :1])


def _layers(*widths: int) -> nn.Sequential:
    """Return linear layers with layer norm, so that features do not depend on the batch, and ReLU."""
    layers = [(nn.Linear(*pair), nn.LayerNorm(pair[1]), nn.ReLU()) for pair in pairwise(widths)]
    return nn.Sequential(*(part for layer in layers for part in layer))


class SetAbstraction(nn.Module):
    """A level of PointNet++: the feature of a kept point is the maximum over its neighbourhood."""

    def __init__(self, width: int, count: int, radius: float, neighbours: int, widths: tuple[int, ...]) -> None:
        super().__init__()
        self.count, self.radius, self.neighbours = count, radius, neighbours
        self.layers = _layers(width + 3, *widths)

    def forward(self, xyz: Tensor, features: Tensor) -> tuple[Tensor, Tensor]:
        """Reduce points [R, P, 3] with features [R, P, F] to points [R, M, 3] with features [R, M, D]."""
        row = torch.arange(len(xyz), device=xyz.device)[:, None]
        centers = xyz[row, farthest_points(xyz, self.count)]
        near = nearest_in_ball(xyz, centers, self.radius, self.neighbours)
        offset = xyz[row[..., None], near] - centers[:, :, None]
        gathered = torch.cat([offset, features[row[..., None], near]], dim=-1)
        return centers, self.layers(gathered).amax(dim=2)


class PointEncoder(nn.Module):
    """PointNet++ with three single-scale set-abstraction levels, the last one over all remaining points.

    It is trained to classify label and colour (`models.training.fit_points`), then frozen; the papers train it further.
    """

    def __init__(self) -> None:
        super().__init__()
        width, levels = 3, []
        for count, radius, neighbours, widths in _LEVELS:
            levels.append(SetAbstraction(width, count, radius, neighbours, widths))
            width = widths[-1]
        self.levels = nn.ModuleList(levels)
        self.last = _layers(width + 3, *_LAST)

    def forward(self, points: Tensor) -> Tensor:
        """Return features [R, POINT_WIDTH] of instances from points [R, P, 6]: position and colour."""
        xyz, features = points[..., :3], points[..., 3:]
        for level in self.levels:
            xyz, features = level(xyz, features)
        pooled: Tensor = self.last(torch.cat([xyz, features], dim=-1)).amax(dim=1)
        return pooled
