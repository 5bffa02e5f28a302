"""Matching of hints and instances in the fine stage (Text2Pos, CVPR 2022): the baselines' fine stage.

RET (AAAI 2023) cascades the two: hints that have met the instances, not the hints alone, say the offsets (`refine`).
Its relation-enhanced encoders are the retriever's (`models.paper.ret`), not repeated here.
"""

import math
from typing import ClassVar

import torch
from torch import Tensor, nn

from models.language.text_encoder import TextEncoder
from models.paper.fine.fine_model import FineConfig, FineMethod, FineModel, Instances, Truth
from models.paper.layers import mlp


class MatchingConfig(FineConfig):
    """Shape and loss of the matching.

    Attributes:
        refine: whether the offset of a match is read from the hint alone (Text2Pos), or from the hint after it met the
            instances (RET's cascaded matching and refinement).
        iterations: of Sinkhorn's algorithm.
        threshold: least share of a match that counts.
        offset_weight: of the offsets' squared error beside the matches' negative log-likelihood.
    """

    refine: bool = False
    iterations: int = 50
    threshold: float = 0.2
    offset_weight: float = 5.0


class Matching(FineModel):
    """Each hint finds its instance and says how far the position lies from its middle.

    Attention, then Sinkhorn's optimal transport; the position is the mean over the matches, the cell's centre without
    any. Differs from Text2Pos: any number of hints and instances, masked; attention as in the regressor; the frozen
    text encoder in place of an LSTM.
    """

    method: ClassVar[FineMethod] = "matching"
    config_type: ClassVar[type[FineConfig]] = MatchingConfig
    config: MatchingConfig

    def __init__(self, text_encoder: TextEncoder, config: MatchingConfig) -> None:
        super().__init__(text_encoder, config)
        self.project_hints, self.project_instances = (mlp(config.width, config.width) for _ in range(2))
        self.unmatched = nn.Parameter(torch.tensor(1.0))  # score of having no partner
        self.offset = mlp(config.width, config.width // 2, 2)

    def locate(self, hints: Tensor, hint_mask: Tensor, instances: Instances) -> Tensor:
        """See FineModel."""
        log_share, offset = self.match(hints, hint_mask, instances)
        share = log_share[:, :-1, :-1].exp()
        # Hard matches: each the other's best, and sure enough.
        of_hint, of_instance = share == share.amax(dim=2, keepdim=True), share == share.amax(dim=1, keepdim=True)
        matched = (of_hint & of_instance & (share > self.config.threshold)).float()
        position = instances.center[:, None, :, :] + offset[:, :, None, :]  # [B, H, I, 2]
        count = matched.sum(dim=(1, 2))[:, None]
        mean = (position * matched[..., None]).sum(dim=(1, 2)) / count.clamp(min=1)
        return torch.where(count > 0, mean, 0.5)

    def match(self, hints: Tensor, hint_mask: Tensor, instances: Instances) -> tuple[Tensor, Tensor]:
        """Who is meant, and where the position lies from there; arguments as `locate`.

        Returns:
            log_share: [B, H + 1, I + 1] logarithm of the share of each hint in each instance; a real hint's row and a
                real instance's column add up to one, the last of each stands for "no partner".
            offset: [B, H, 2] from the middle of the instance that a hint means to the position, in cells.
        """
        met, seen = self.meet(hints, hint_mask, instances)
        scores = self.project_hints(met) @ self.project_instances(seen).transpose(1, 2) / math.sqrt(met.shape[-1])
        share = sinkhorn(scores.float(), hint_mask, instances.mask, self.unmatched, self.config.iterations)
        return share, self.offset(met if self.config.refine else hints)

    def loss(self, hints: Tensor, hint_mask: Tensor, instances: Instances, truth: Truth) -> Tensor:
        """Negative log-likelihood of the matches, squared error of their offsets (Text2Pos); see FineModel."""
        log_share, offset = self.match(hints, hint_mask, instances)
        is_meant = instances.meant_by(truth, hint_mask)
        has_partner, is_partner = is_meant.any(dim=2), is_meant.any(dim=1)
        terms = (
            log_share[:, :-1, :-1][is_meant],
            log_share[:, :-1, -1][hint_mask & ~has_partner],
            log_share[:, -1, :-1][instances.mask & ~is_partner],
        )
        likelihood = -torch.cat(terms).mean()
        position = instances.center[:, None, :, :] + offset[:, :, None, :]
        error = ((position - truth.offset[:, None, None, :]) ** 2)[is_meant]
        return likelihood + self.config.offset_weight * error.sum() / max(1, len(error))


def sinkhorn(scores: Tensor, row_mask: Tensor, column_mask: Tensor, unmatched: Tensor, iterations: int) -> Tensor:
    """Optimal transport with a bin for what has no partner (SuperGlue, CVPR 2020, Eq. 8 to 10; in logarithms).

    Args:
        scores: [B, H, I].
        row_mask: [B, H] bool, True where a row is real.
        column_mask: [B, I] bool, True where a column is real.
        unmatched: scalar, score of having no partner.
        iterations: of normalising rows and columns.

    Returns:
        [B, H + 1, I + 1] logarithm of the assignment: a real row and a real column add up to 1, the bins' to the
        number of columns and of rows; -inf at padding.
    """
    b, h, i = scores.shape
    rows, columns = (mask.sum(dim=1, keepdim=True) for mask in (row_mask, column_mask))
    log_rows = torch.cat([row_mask, columns], dim=1).log()  # what a row adds up to: 1, nothing at padding
    log_columns = torch.cat([column_mask, rows], dim=1).log()
    couplings = torch.cat([scores, unmatched.expand(b, h, 1)], dim=2)
    couplings = torch.cat([couplings, unmatched.expand(b, 1, i + 1)], dim=1)
    v = torch.zeros_like(log_columns).masked_fill(log_columns.isinf(), -torch.inf)
    for _ in range(iterations):
        u = log_rows - torch.logsumexp(couplings + v[:, None, :], dim=2)
        v = log_columns - torch.logsumexp(couplings + u[:, :, None], dim=1)
    return couplings + u[:, :, None] + v[:, None, :]
