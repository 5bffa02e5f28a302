"""What a retriever makes of a description or a cell: vectors of up to three levels, and how they are compared."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import torch
from torch import Tensor

Level = Literal["global", "instance", "relation"]
LEVELS: tuple[Level, ...] = ("global", "instance", "relation")


@dataclass(frozen=True, slots=True)
class Levels:
    """B descriptions, with K hints each, or B cells, with K instances each, as unit vectors.

    Attributes:
        whole: [B, D] the global level.
        mask: [B, K] bool, True where a hint or an instance is real.
        instance: [B, K, D] the instance level; None if the retriever has none.
        relation: [B, K, D] the relation level; None if the retriever has none.
    """

    whole: Tensor
    mask: Tensor
    instance: Tensor | None = None
    relation: Tensor | None = None

    def of(self, level: Level) -> Tensor:
        """The vectors of a level: [B, D] of the global one, [B, K, D] of the others.

        Raises:
            ValueError: the retriever has no such level.
        """
        vectors = {"global": self.whole, "instance": self.instance, "relation": self.relation}[level]
        if vectors is None:
            raise ValueError(f"there is no level '{level}'")
        return vectors

    def mean_of(self, level: Level) -> Tensor:
        """[B, D] mean of a level's vectors over what is real."""
        vectors = self.of(level)
        if level == "global":
            return vectors
        return (vectors * self.mask[..., None]).sum(dim=1) / self.mask.sum(dim=1, keepdim=True)

    def each(self) -> "list[Levels]":
        """Each description or cell with B = 1 and without padding, on the CPU."""
        whole, mask = self.whole.cpu(), self.mask.cpu()
        others = [None if x is None else x.cpu() for x in (self.instance, self.relation)]
        return [
            Levels(whole[n : n + 1], real[real][None], *(None if x is None else x[n, real][None] for x in others))
            for n, real in enumerate(mask)
        ]


def set_similarity(hints: Tensor, hint_mask: Tensor, instances: Tensor, instance_mask: Tensor) -> Tensor:
    """[Q, N] mean over real hints of the maximum over real instances of the cosine (MNCL, equations 6 and 12).

    Args:
        hints: [Q, H, D] unit vectors.
        hint_mask: [Q, H] bool, True where a hint is real.
        instances: [N, I, D] unit vectors.
        instance_mask: [N, I] bool, True where an instance is real.
    """
    q, h, d = hints.shape
    n, i, _ = instances.shape
    cosine = (hints.reshape(q * h, d) @ instances.reshape(n * i, d).T).reshape(q, h, n, i)
    best = cosine.masked_fill(~instance_mask, float("-inf")).amax(dim=-1)  # [Q, H, N]
    share = hint_mask / hint_mask.sum(dim=1, keepdim=True)
    return (best * share[:, :, None]).sum(dim=1)


def level_scores(text: Levels, cells: Levels, levels: Sequence[Level]) -> dict[Level, Tensor]:
    """Similarities [Q, N] of Q descriptions with N cells at some levels."""
    return {
        level: text.whole @ cells.whole.T
        if level == "global"
        else set_similarity(text.of(level), text.mask, cells.of(level), cells.mask)
        for level in levels
    }


def sum_of_z_scores(scores: dict[Level, Tensor]) -> Tensor:
    """[Q, N] levels made comparable by each query's mean and deviation over the gallery, and added (MNCL's code)."""
    return torch.stack([_z(score) for score in scores.values()]).sum(dim=0)


def _z(score: Tensor) -> Tensor:
    deviation, mean = torch.std_mean(score, dim=1, keepdim=True, correction=0)
    return (score - mean) / deviation.clamp(min=1e-6)
