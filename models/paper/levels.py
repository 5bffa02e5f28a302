"""Vectors of descriptions and cells at up to three levels, and their similarities."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import torch
from torch import Tensor

Level = Literal["global", "instance", "relation"]
Matching = Literal["hints", "both"]


@dataclass(frozen=True, slots=True)
class Levels:
    """Unit vectors of B descriptions with K hints each, or of B cells with K instances each."""

    global_vectors: Tensor  # [B, D] the global level
    mask: Tensor  # [B, K] bool, True where a hint or an instance is real
    instance: Tensor | None = None  # [B, K, D] the instance level; None if the retriever has none
    relation: Tensor | None = None  # [B, K, D] the relation level; None if the retriever has none

    def vectors(self, level: Level) -> Tensor:
        """Return the vectors of a level, [B, D] or [B, K, D]; raise ValueError if the retriever does not have it."""
        vectors = {"global": self.global_vectors, "instance": self.instance, "relation": self.relation}[level]
        if vectors is None:
            raise ValueError(f"the retriever has no level '{level}'")
        return vectors

    def mean_vectors(self, level: Level) -> Tensor:
        """Return the mean [B, D] of a level's vectors over the real entries."""
        vectors = self.vectors(level)
        if level == "global":
            return vectors
        return (vectors * self.mask[..., None]).sum(dim=1) / self.mask.sum(dim=1, keepdim=True)

    def split(self) -> "list[Levels]":
        """Return each description or cell with B = 1 and without padding, on the CPU."""
        vectors, mask = self.global_vectors.cpu(), self.mask.cpu()
        others = [None if x is None else x.cpu() for x in (self.instance, self.relation)]
        return [
            Levels(vectors[n : n + 1], real[real][None], *(None if x is None else x[n, real][None] for x in others))
            for n, real in enumerate(mask)
        ]


def set_similarity(
    hints: Tensor, hint_mask: Tensor, instances: Tensor, instance_mask: Tensor, matching: Matching = "hints"
) -> Tensor:
    """Return the similarity [Q, N] of sets of hints and sets of instances (MNCL, equations 6 and 12).

    "hints" is the mean over hints of the maximum over instances of the cosine (the released code); "both" averages it
    with the mean over instances of the maximum over hints (the paper matches in both directions). Hints [Q, H, D] and
    instances [N, I, D] are unit vectors; masks [Q, H] and [N, I] are True where they are real.
    """
    q, h, d = hints.shape
    n, i, _ = instances.shape
    cosine = (hints.reshape(q * h, d) @ instances.reshape(n * i, d).T).reshape(q, h, n, i)
    best_instance = cosine.masked_fill(~instance_mask, float("-inf")).amax(dim=-1)  # [Q, H, N]
    share = hint_mask / hint_mask.sum(dim=1, keepdim=True)
    of_hints = (best_instance * share[:, :, None]).sum(dim=1)
    if matching == "hints":
        return of_hints
    best_hint = cosine.masked_fill(~hint_mask[:, :, None, None], float("-inf")).amax(dim=1)  # [Q, N, I]
    of_instances = (best_hint * (instance_mask / instance_mask.sum(dim=1, keepdim=True))).sum(dim=-1)
    return (of_hints + of_instances) / 2


def level_scores(
    text: Levels, cells: Levels, levels: Sequence[Level], matching: Matching = "hints"
) -> dict[Level, Tensor]:
    """Return similarities [Q, N] of Q descriptions with N cells, by level; matching as of `set_similarity`."""
    return {
        level: text.global_vectors @ cells.global_vectors.T
        if level == "global"
        else set_similarity(text.vectors(level), text.mask, cells.vectors(level), cells.mask, matching)
        for level in levels
    }


def sum_of_z_scores(scores: dict[Level, Tensor]) -> Tensor:
    """Return the sum over levels [Q, N] of each query's z-scores over the gallery (MNCL's code)."""
    return torch.stack([_z_scores(score) for score in scores.values()]).sum(dim=0)


def _z_scores(score: Tensor) -> Tensor:
    deviation, mean = torch.std_mean(score, dim=1, keepdim=True, correction=0)
    return (score - mean) / deviation.clamp(min=1e-6)
