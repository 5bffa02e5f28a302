"""Relation-enhanced self-attention (RET), which MNCL's code also has among the point features of a cell."""

from torch import Tensor, nn

from models.paper.layers import masked_max

NUM_HEADS = 4


class InstanceRelation(nn.Module):
    """Pooled relations of instances: max over j of R_ij = W (c_i - c_j) (RET, relation-enhanced self-attention)."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.linear = nn.Linear(3, width, bias=False)

    def forward(self, centers: Tensor, mask: Tensor) -> Tensor:
        """Return [B, K, D] from centres [B, K, 3] with mask [B, K]."""
        mapped = self.linear(centers)
        # The maximum over j does not depend on c_i, so no tensor of size K x K x D is needed.
        pooled: Tensor = mapped + masked_max(-mapped, mask)[:, None]
        return pooled


class RelationAttention(nn.Module):
    """Self-attention whose values include pooled relations: softmax(Q K^T / sqrt(d)) (V + pooled R)."""

    def __init__(self, width: int, dropout: float) -> None:
        super().__init__()
        self.project = nn.Linear(width, 3 * width)
        self.merge = nn.Linear(width, width)
        self.dropout = nn.Dropout(dropout)

    def attend(self, x: Tensor, relation: Tensor, mask: Tensor) -> Tensor:
        """Apply the attention to x and pooled relations, both [B, K, D], with mask [B, K] of the real entries."""
        b, k, d = x.shape
        query, key, value = self.project(x).chunk(3, dim=-1)
        query, key, value = (
            part.view(b, k, NUM_HEADS, -1).transpose(1, 2) for part in (query, key, value + relation)
        )  # [B, NUM_HEADS, K, D / NUM_HEADS]
        dropout = self.dropout.p if self.training else 0.0
        mixed = nn.functional.scaled_dot_product_attention(
            query, key, value, attn_mask=mask[:, None, None], dropout_p=dropout
        )
        merged: Tensor = self.merge(mixed.transpose(1, 2).reshape(b, k, d))
        return merged
