"""PointNet++ (Qi et al., NeurIPS 2017), features of the points of an instance."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final, Literal

import torch
from torch import Tensor, nn
from torch.utils.checkpoint import checkpoint

from models.citymap.point_sample import PointFrame

POINT_WIDTH: Final = 256
PointArchitecture = Literal["small", "official"]
INSTANCES_PER_CHECKPOINT: Final = 32  # of the official encoder; bounds the memory for gradients


@dataclass(frozen=True, slots=True)
class PointLayers:
    """The layers of a point encoder."""

    # for each set-abstraction level: number of points to keep, radius and number of neighbours, widths of the layers
    levels: tuple[tuple[int, float, int, tuple[int, ...]], ...]
    pooled: tuple[int, ...]  # widths of the layers before the maximum over the remaining points
    head: tuple[int, ...]  # widths of the linear layers after it
    frame: PointFrame  # of the positions, see `PointSampling`


ARCHITECTURES: Final[dict[PointArchitecture, PointLayers]] = {
    "small": PointLayers(((64, 0.2, 16, (32, 64)), (16, 0.4, 16, (64, 128))), (128, POINT_WIDTH), (), "part"),
    "official": PointLayers(
        ((128, 0.2, 32, (32, 64)), (64, 0.3, 32, (128, 128)), (32, 0.4, 32, (256, 256))),
        (512, 1024),
        (512, POINT_WIDTH),
        "cell",
    ),
}


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


def _head(widths: Sequence[int]) -> nn.Sequential:
    return nn.Sequential(*(part for pair in pairwise(widths) for part in (nn.Linear(*pair), nn.ReLU())))


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
    """PointNet++ with single-scale set-abstraction levels and a level over all remaining points.

    It is trained to classify label and colour (`models.training.fit_points`), then frozen or trained further.

    "small" has two levels, 66,272 parameters, and sees each instance in a unit ball. "official" is the encoder of
    Text2Pos, Text2Loc and MNCL: three levels, each of which keeps half of the points, then linear layers of 1024, 512
    and 256; 1,446,496 parameters, 1,454,206 with the heads for the 22 classes and 8 colours of KITTI360Pose. It sees
    instances in the frame of their cell, so that it knows size and place. Differs from the released code: layer norm,
    where that has batch norm; a ball has its 32 nearest points, there any 32; and no point joins the ball of another
    instance, as the self-loops that PyG's PointConv adds by default make it there. Its gradients are computed with
    checkpoints, to bound the memory: a step of MNCL that trains it takes 9 to 14 s with 8 cells and 63 s with 64 cells
    (918 instances) on one core, and 1.9 GB.
    """

    def __init__(self, architecture: PointArchitecture = "small") -> None:
        super().__init__()
        layers = ARCHITECTURES[architecture]
        self.architecture, self.frame = architecture, layers.frame
        width, levels = 3, []
        for count, radius, neighbours, widths in layers.levels:
            levels.append(SetAbstraction(width, count, radius, neighbours, widths))
            width = widths[-1]
        self.levels = nn.ModuleList(levels)
        self.last = _layers(width + 3, *layers.pooled)
        self.head = _head((layers.pooled[-1], *layers.head))

    def forward(self, points: Tensor) -> Tensor:
        """Return features [R, POINT_WIDTH] of instances from points [R, P, 6]: position and colour."""
        if self.architecture == "small":
            return self._encode(points)
        parts = points.split(INSTANCES_PER_CHECKPOINT)
        return torch.cat([checkpoint(self._encode, part, use_reentrant=False) for part in parts])

    def _encode(self, points: Tensor) -> Tensor:
        xyz, features = points[..., :3], points[..., 3:]
        for level in self.levels:
            xyz, features = level(xyz, features)
        pooled: Tensor = self.last(torch.cat([xyz, features], dim=-1)).amax(dim=1)
        encoded: Tensor = self.head(pooled)
        return encoded
