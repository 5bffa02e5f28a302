"""The regressor of the fine stage (Text2Loc, CVPR 2024; MNCL uses it unchanged)."""

import math
from typing import ClassVar

import torch
from torch import Tensor, nn

from models.language.text_encoder import TextEncoder
from models.paper.fine.fine_model import FineConfig, FineMethod, FineModel, Instances, Truth
from models.paper.layers import masked_max, mlp


class RegressorConfig(FineConfig):
    """Shape and loss of the regressor.

    Attributes:
        point: whether hints take coordinates from the instances they point at, see Regressor; False is the paper's
            matching-free model.
        match_weight: of the likelihood that a hint points at the instance it means, beside the squared error.
    """

    point: bool = True
    match_weight: float = 0.1


class Regressor(FineModel):
    """Hints and instances through cascaded cross-attention, maximum over hints, MLP to a position.

    Differs from Text2Loc: any number of hints and instances, masked; instances are described by geometry and label, see
    `models.paper.instance_encoder`. With `point`, a last attention takes the instances' plain geometry as its
    values, and is told while training which instance each hint means: without, coordinates must find their way through
    all layers, which takes an order of magnitude more steps. Soft shares, no matches, when it predicts.
    """

    method: ClassVar[FineMethod] = "regressor"
    config_type: ClassVar[type[FineConfig]] = RegressorConfig
    config: RegressorConfig

    def __init__(self, text_encoder: TextEncoder, config: RegressorConfig) -> None:
        super().__init__(text_encoder, config)
        width = config.width
        if config.point:
            self.point_from, self.point_to = nn.Linear(width, width), nn.Linear(width, width)
            self.pointed_at = nn.Linear(len(self.columns), width)
        self.vote = mlp(width, 2 * width, width)
        self.head = mlp(width, width // 2, 2)

    @property
    def needs_matches(self) -> bool:
        """See FineModel."""
        return self.config.point and self.config.match_weight > 0

    def locate(self, hints: Tensor, hint_mask: Tensor, instances: Instances) -> Tensor:
        """See FineModel."""
        return self.point(hints, hint_mask, instances)[0]

    def loss(self, hints: Tensor, hint_mask: Tensor, instances: Instances, truth: Truth) -> Tensor:
        """Squared error in half cells (Text2Loc, fine localization), and that of pointing; see FineModel."""
        offset, log_share = self.point(hints, hint_mask, instances)
        error = nn.functional.mse_loss(2 * offset, 2 * truth.offset)
        if log_share is None:
            return error
        pointed = log_share[instances.meant_by(truth, hint_mask)]
        return error - self.config.match_weight * pointed.sum() / max(1, len(pointed))

    def point(self, hints: Tensor, hint_mask: Tensor, instances: Instances) -> tuple[Tensor, Tensor | None]:
        """Positions [B, 2] and the logarithm of each hint's shares in the instances [B, H, I]; None without `point`."""
        met, seen = self.meet(hints, hint_mask, instances)
        log_share = None
        if self.config.point:
            scores = self.point_from(met) @ self.point_to(seen).transpose(1, 2) / math.sqrt(met.shape[-1])
            log_share = scores.masked_fill(~instances.mask[:, None, :], float("-inf")).log_softmax(dim=2)
            met = met + self.pointed_at(torch.matmul(log_share.exp(), instances.geometry[..., self.columns]))
        from_center: Tensor = self.head(masked_max(self.vote(met), hint_mask))  # in half cells
        return from_center / 2 + 0.5, log_share
