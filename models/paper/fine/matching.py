"""Matching of hints and instances, the fine stage of Text2Pos (CVPR 2022) and RET (AAAI 2023).

RET predicts offsets from hints after they have attended to the instances (`refine`). Its relation-enhanced encoders are
part of the retriever only (`models.paper.ret`).
"""

import math
from typing import ClassVar

import torch
from pydantic import Field
from torch import Tensor, nn

from models.language.text_encoder import TextEncoder
from models.paper.fine.fine_model import FineConfig, FineMethod, FineModel, FineTargets, InstanceFeatures
from models.paper.layers import mlp


class MatchingConfig(FineConfig):
    """Architecture and loss of the matching."""

    # whether offsets are predicted from hints after cross-attention (RET's cascaded matching and refinement) instead of
    # hints alone (Text2Pos)
    refine: bool = False
    iterations: int = Field(default=50, ge=1)  # of Sinkhorn's algorithm
    threshold: float = Field(default=0.2, ge=0, le=1)  # minimum share of a match that counts
    offset_weight: float = Field(default=5.0, ge=0)  # weight of the squared error of the offsets in the loss


class Matching(FineModel):
    """Fine stage that matches each hint to an instance and predicts the offset of the position from its centre.

    Cross-attention, then Sinkhorn's optimal transport; the position is the mean over the matches, or the centre of the
    cell if there is none. Differs from Text2Pos: any number of hints and instances, masked; attention as in the
    regressor; the frozen text encoder in place of an LSTM.
    """

    method: ClassVar[FineMethod] = "matching"
    config_type: ClassVar[type[FineConfig]] = MatchingConfig
    config: MatchingConfig

    def __init__(self, text_encoder: TextEncoder, config: MatchingConfig) -> None:
        super().__init__(text_encoder, config)
        self.project_hints, self.project_instances = (mlp(config.width, config.width) for _ in range(2))
        self.unmatched = nn.Parameter(torch.tensor(1.0))  # score of having no match
        self.offset = mlp(config.width, config.width // 2, 2)

    def locate(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures) -> Tensor:
        """Return positions [B, 2] in the cells, 0..1 inside."""
        log_share, offset = self.match(hints, hint_mask, instances)
        share = log_share[:, :-1, :-1].exp()
        # Hard matches: mutual best matches with a share above the threshold.
        of_hint, of_instance = share == share.amax(dim=2, keepdim=True), share == share.amax(dim=1, keepdim=True)
        matched = (of_hint & of_instance & (share > self.config.threshold)).float()
        position = instances.center[:, None, :, :] + offset[:, :, None, :]  # [B, H, I, 2]
        count = matched.sum(dim=(1, 2))[:, None]
        mean = (position * matched[..., None]).sum(dim=(1, 2)) / count.clamp(min=1)
        return torch.where(count > 0, mean, 0.5)

    def match(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures) -> tuple[Tensor, Tensor]:
        """Return the matches and the offsets from them to the position; arguments as `locate`.

        Returns:
            log_share: [B, H + 1, I + 1] logarithm of the share of each hint in each instance; rows of real hints and
                columns of real instances sum to one, the last row and column stand for "no match".
            offset: [B, H, 2] from the centre of the matched instance to the position, in cell units.
        """
        attended, features = self.cross_attend(hints, hint_mask, instances)
        scores = (
            self.project_hints(attended)
            @ self.project_instances(features).transpose(1, 2)
            / math.sqrt(attended.shape[-1])
        )
        share = sinkhorn(scores.float(), hint_mask, instances.mask, self.unmatched, self.config.iterations)
        return share, self.offset(attended if self.config.refine else hints)

    def loss(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures, targets: FineTargets) -> Tensor:
        """Return the negative log-likelihood of the matches plus the squared error of their offsets (Text2Pos)."""
        log_share, offset = self.match(hints, hint_mask, instances)
        is_match = instances.match_mask(targets, hint_mask)
        has_match, is_matched = is_match.any(dim=2), is_match.any(dim=1)
        terms = (
            log_share[:, :-1, :-1][is_match],
            log_share[:, :-1, -1][hint_mask & ~has_match],
            log_share[:, -1, :-1][instances.mask & ~is_matched],
        )
        likelihood = -torch.cat(terms).mean()
        position = instances.center[:, None, :, :] + offset[:, :, None, :]
        error = ((position - targets.offset[:, None, None, :]) ** 2)[is_match]
        return likelihood + self.config.offset_weight * error.sum() / max(1, len(error))


def sinkhorn(scores: Tensor, row_mask: Tensor, column_mask: Tensor, unmatched: Tensor, iterations: int) -> Tensor:
    """Compute optimal transport with bins for unmatched rows and columns (SuperGlue, CVPR 2020, Eq. 8 to 10).

    Returns the logarithm of the assignment [B, H + 1, I + 1] for scores [B, H, I]: real rows and columns sum to 1, the
    bins to the number of columns and rows; -inf at padding. `unmatched` is the score of having no match.
    """
    b, h, i = scores.shape
    rows, columns = (mask.sum(dim=1, keepdim=True) for mask in (row_mask, column_mask))
    log_rows = torch.cat([row_mask, columns], dim=1).log()  # sum of each row: 1, or 0 at padding
    log_columns = torch.cat([column_mask, rows], dim=1).log()
    couplings = torch.cat([scores, unmatched.expand(b, h, 1)], dim=2)
    couplings = torch.cat([couplings, unmatched.expand(b, 1, i + 1)], dim=1)
    v = torch.zeros_like(log_columns).masked_fill(log_columns.isinf(), -torch.inf)
    for _ in range(iterations):
        u = log_rows - torch.logsumexp(couplings + v[:, None, :], dim=2)
        v = log_columns - torch.logsumexp(couplings + u[:, :, None], dim=1)
    return couplings + u[:, :, None] + v[:, None, :]
