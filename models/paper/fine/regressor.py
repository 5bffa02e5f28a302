"""The regressor, the fine stage of Text2Loc (CVPR 2024), which MNCL uses unchanged."""

import math
from typing import ClassVar, Literal

import torch
from pydantic import Field
from torch import Tensor, nn

from models.language.text_encoder import TextEncoder
from models.paper.fine.fine_model import FineConfig, FineMethod, FineModel, FineTargets, InstanceFeatures
from models.paper.layers import masked_max, mlp


class RegressorConfig(FineConfig):
    """Architecture and loss of the regressor."""

    # whether hints receive the coordinates of the instances they attend to, see Regressor; False is the matching-free
    # model of the paper
    point: bool = True
    # loss of a position: its error "squared" (Text2Loc's code) or as a "norm", not squared (MNCL, equation 14)
    error: Literal["squared", "norm"] = "squared"
    # weight of the log-likelihood that a hint attends to its true instance, relative to this error
    match_weight: float = Field(default=0.1, ge=0)


class Regressor(FineModel):
    """Fine stage by regression: cascaded cross-attention, maximum over hints, MLP to a position.

    Differs from Text2Loc: any number of hints and instances, masked; instances have geometry and label, see
    `models.paper.instance_encoder`. With `point`, a last attention has the plain geometry of the instances as values
    and is trained with the true instance of each hint. Without it, coordinates must pass all layers, which takes ten
    times as many training steps. Predictions use soft shares, no matches.
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
        """Whether the attention is trained with the true instances."""
        return self.config.point and self.config.match_weight > 0

    def locate(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures) -> Tensor:
        """Return positions [B, 2] in the cells, 0..1 inside."""
        return self.point_to_instances(hints, hint_mask, instances)[0]

    def loss(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures, targets: FineTargets) -> Tensor:
        """Return the error in half cells minus the weighted log-likelihood of the true instances.

        The squared error is the mean over the batch and both coordinates, the norm the mean over the batch.
        """
        offset, log_share = self.point_to_instances(hints, hint_mask, instances)
        residual = 2 * (offset - targets.offset)
        error = residual.norm(dim=-1).mean() if self.config.error == "norm" else residual.square().mean()
        if log_share is None:
            return error
        log_likelihood = log_share[instances.match_mask(targets, hint_mask)]
        return error - self.config.match_weight * log_likelihood.sum() / max(1, len(log_likelihood))

    def point_to_instances(
        self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures
    ) -> tuple[Tensor, Tensor | None]:
        """Return positions [B, 2] and log shares [B, H, I] of the hints in the instances; None without `point`."""
        attended, features = self.cross_attend(hints, hint_mask, instances)
        log_share = None
        if self.config.point:
            scores = self.point_from(attended) @ self.point_to(features).transpose(1, 2) / math.sqrt(attended.shape[-1])
            log_share = scores.masked_fill(~instances.mask[:, None, :], float("-inf")).log_softmax(dim=2)
            attended = attended + self.pointed_at(torch.matmul(log_share.exp(), instances.geometry[..., self.columns]))
        from_center: Tensor = self.head(masked_max(self.vote(attended), hint_mask))  # in half cells
        return from_center / 2 + 0.5, log_share
