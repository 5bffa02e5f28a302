"""Hint sentences as features: what trains on top of the frozen text encoder."""

from torch import Tensor, nn

from models.retrieval.layers import SetTransformer, masked_max


class HintEncoder(nn.Module):
    """Hint features F^T from token features (MNCL, text backbone).

    Differs: the tokens are projected to D before the transformer layer, which costs a third and
    measures the same.
    """

    def __init__(self, text_width: int, width: int, dropout: float) -> None:
        super().__init__()
        self.project = nn.Linear(text_width, width)
        self.tokens = SetTransformer(width, num_layers=1, num_heads=4, dropout=dropout)
        self.head = nn.Linear(width, width)
        self.norm = nn.BatchNorm1d(width)

    def forward(self, tokens: Tensor, mask: Tensor) -> Tensor:
        """[S, D] features of sentences from token features [S, T, W] with mask [S, T]."""
        pooled = masked_max(self.tokens(self.project(tokens), mask), mask)
        features: Tensor = self.norm(self.head(pooled))
        return features
