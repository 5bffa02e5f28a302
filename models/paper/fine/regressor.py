"""The regressor, the fine stage of Text2Loc (CVPR 2024), which MNCL uses unchanged."""

import math
from typing import ClassVar, Literal

import torch
from pydantic import Field
from torch import Tensor, nn

from models.language.text_encoder import TextEncoder
from models.paper.fine.fine_model import FineConfig, FineMethod, FineModel, FineTargets, InstanceFeatures
from models.paper.layers import masked_max, mlp

MIN_STANDARD_DEVIATION = 0.01  # of a Gaussian, in half cells: 0.15 m in cells of 30 m


class RegressorConfig(FineConfig):
    """Architecture and loss of the regressor."""

    # whether hints receive the coordinates of the instances they attend to, see Regressor; False is the matching-free
    # model of the paper
    point: bool = True
    # loss of a position: its error "squared" (Text2Loc's code) or as a "norm", not squared (MNCL, equation 14), or the
    # negative log-likelihood of a "gaussian" (PMSH, SpatiaLoc), see `gaussian_loss`
    error: Literal["squared", "norm", "gaussian"] = "squared"
    # weight of the log-likelihood that a hint attends to its true instance, relative to this error
    match_weight: float = Field(default=0.1, ge=0)


class Regressor(FineModel):
    """Fine stage by regression: cascaded cross-attention, maximum over hints, MLP to a position.

    Differs from Text2Loc: any number of hints and instances, masked; instances have geometry and label, see
    `models.paper.instance_encoder`. With `point`, a last attention has the plain geometry of the instances as values
    and is trained with the true instance of each hint. Without it, coordinates must pass all layers, which takes ten
    times as many training steps. Predictions use soft shares, no matches.

    With the error "gaussian" the head also gives the covariance of a position, which only the loss uses: positions are
    means, and `error_m`, one figure for all positions, is measured on validation data as for the other errors.
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
        self.head = mlp(width, width // 2, 5 if config.error == "gaussian" else 2)

    @property
    def needs_matches(self) -> bool:
        """Whether the attention is trained with the true instances."""
        return self.config.point and self.config.match_weight > 0

    def locate(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures) -> Tensor:
        """Return positions [B, 2] in the cells, 0..1 inside; the means of Gaussians."""
        return self.point_to_instances(hints, hint_mask, instances)[0]

    def loss(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures, targets: FineTargets) -> Tensor:
        """Return the error in half cells minus the weighted log-likelihood of the true instances.

        The squared error is the mean over the batch and both coordinates, the others the mean over the batch.
        """
        offset, factor, log_share = self.point_to_instances(hints, hint_mask, instances)
        residual = 2 * (offset - targets.offset)
        if factor is not None:
            error = gaussian_loss(residual, factor)
        else:
            error = residual.norm(dim=-1).mean() if self.config.error == "norm" else residual.square().mean()
        if log_share is None:
            return error
        log_likelihood = log_share[instances.match_mask(targets, hint_mask)]
        return error - self.config.match_weight * log_likelihood.sum() / max(1, len(log_likelihood))

    def point_to_instances(
        self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures
    ) -> tuple[Tensor, Tensor | None, Tensor | None]:
        """Return the positions, their uncertainty, and the instances that the hints refer to; arguments as `locate`.

        Returns:
            offset: positions [B, 2] in the cells, 0..1 inside.
            factor: [B, 2, 2] Cholesky factor of their covariance, in half cells; None if the error is not Gaussian.
            log_share: [B, H, I] logarithm of the share of each hint in each instance; None without `point`.
        """
        attended, features = self.cross_attend(hints, hint_mask, instances)
        log_share = None
        if self.config.point:
            scores = self.point_from(attended) @ self.point_to(features).transpose(1, 2) / math.sqrt(attended.shape[-1])
            log_share = scores.masked_fill(~instances.mask[:, None, :], float("-inf")).log_softmax(dim=2)
            attended = attended + self.pointed_at(torch.matmul(log_share.exp(), instances.geometry[..., self.columns]))
        output: Tensor = self.head(masked_max(self.vote(attended), hint_mask))  # [B, 2 or 5], in half cells
        factor = cholesky_factor(output[:, 2:]) if self.config.error == "gaussian" else None
        return output[:, :2] / 2 + 0.5, factor, log_share


def cholesky_factor(output: Tensor) -> Tensor:
    """Return lower triangular matrices [B, 2, 2] with a positive diagonal, from three numbers [B, 3] each."""
    diagonal = nn.functional.softplus(output[:, :2]) + MIN_STANDARD_DEVIATION
    return torch.diag_embed(diagonal) + torch.diag_embed(output[:, 2:], offset=-1)


def gaussian_loss(residual: Tensor, factor: Tensor) -> Tensor:
    """Return the mean negative log-likelihood of residuals [B, 2] under the covariances L L^T of factors L [B, 2, 2].

    It is 1/2 |L^-1 r|^2 + log det L + log(2 pi).
    """
    first = residual[:, 0] / factor[:, 0, 0]
    second = (residual[:, 1] - factor[:, 1, 0] * first) / factor[:, 1, 1]
    log_determinant = factor.diagonal(dim1=1, dim2=2).log().sum(dim=1)
    return ((first.square() + second.square()) / 2 + log_determinant).mean() + math.log(2 * math.pi)
