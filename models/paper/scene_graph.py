"""Scene graphs of the instances of a cell or the hints of a description (MNCL, relation level)."""

from typing import Literal, NamedTuple

import torch
from torch import Tensor, nn

AttentionQuery = Literal["edges", "mixed"]
AttentionAxis = Literal["edges", "channels", "code"]
Aggregate = Literal["code", "gcn"]


class EdgeTerms(NamedTuple):
    """The edges E_ij = first_i + second_j before the first graph layer, as 2 K vectors instead of K x K."""

    first: Tensor  # [B, K, D] terms of the first node of an edge
    second: Tensor  # [B, K, D] terms of the second node

    def edges(self) -> Tensor:
        """Return the edges [B, K, K, D]."""
        return self.first[:, :, None] + self.second[:, None]


class CellEdges(nn.Module):
    """The edges E_ij = linear(c_i - c_j) of instance centres (equation M7)."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.linear = nn.Linear(3, width)

    def forward(self, centers: Tensor) -> EdgeTerms:
        """Return the edges of centres [B, K, 3]."""
        return EdgeTerms(self.linear(centers), -nn.functional.linear(centers, self.linear.weight))


class HintEdges(nn.Module):
    """The edges E_ij = linear([h_i; h_j]) of hint features (equation M8)."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.of_first, self.of_second = nn.Linear(width, width), nn.Linear(width, width, bias=False)

    def forward(self, hints: Tensor) -> EdgeTerms:
        """Return the edges of features [B, K, D]."""
        return EdgeTerms(self.of_first(hints), self.of_second(hints))


class ExternalSpaceAttention(nn.Module):
    """External space attention: the edges of each node as one vector (MNCL, equation 11).

    Q = W E, M_E = softmax of Q M, R = sum over the edges of M_E * E: an external learnable key M [D, D], and a
    learnable W [N_e, N_e] over the N_e edges of a node. Here edges have no order and sets have any size, so W must be
    invariant to reordering: a on the diagonal plus b / N_e everywhere, with a and b learned.

    Args:
        width: D.
        query: "edges" leaves W out (a = 1, b = 0), as the released code does; "mixed" learns it.
        axis: the softmax runs over the "edges" for each channel, or over the "channels" for each edge, as in the paper
            ("second dimension"). "code" is the released code: a_ij is the softmax over the first node i, for each
            channel, and R_i = sum over j of a_ij * (M E_ij), the edges after the linear layer.
    """

    def __init__(self, width: int, query: AttentionQuery, axis: AttentionAxis) -> None:
        super().__init__()
        self.axis = axis
        self.mix = nn.Parameter(torch.tensor([1.0, 0.0])) if query == "mixed" else None
        self.key = nn.Linear(width, width)

    def forward(self, edges: Tensor, real: Tensor) -> Tensor:
        """Return [B, K, D] from edges [B, K, K, D]; `real` [B, 1, K, 1] is True where the second node is real."""
        query = edges
        if self.mix is not None:
            query = self.mix[0] * edges + self.mix[1] * _mean_edges(edges, real)[:, :, None]
        if self.axis == "edges":
            weights = self.key(query).masked_fill(~real, float("-inf")).softmax(dim=2)
        elif self.axis == "channels":
            weights = self.key(query).softmax(dim=3) * real
        else:
            edges = self.key(query)
            weights = edges.masked_fill(~real.transpose(1, 2), float("-inf")).softmax(dim=1) * real
        attended: Tensor = (weights * edges).sum(dim=2)
        return attended


def _mean_edges(edges: Tensor, real: Tensor) -> Tensor:
    """Return the mean [B, K, D] of the edges of each node; arguments as `ExternalSpaceAttention.forward`."""
    mean: Tensor = (edges * real).sum(dim=2) / real.sum(dim=2)
    return mean


class SceneGraph(nn.Module):
    """m layers with shared weights, then external space attention over the edges of each node.

    A layer is V <- tanh(W_o V) and E_ij <- tanh(W_r [V_i; V_j; E_ij]) (the released code). Aggregate "gcn" adds the
    mean of its edges to a node: V_i <- tanh(W_o V_i + mean over j of E_ij), a reading of the paper's "GCN".
    The edges of a layer see the nodes of the same layer, or with the attention axis "code" those of the layer before,
    as in the released code. Differs: padding is masked.
    """

    def __init__(
        self, width: int, num_layers: int, aggregate: Aggregate, query: AttentionQuery, axis: AttentionAxis
    ) -> None:
        super().__init__()
        self.num_layers, self.aggregate = num_layers, aggregate
        self.node = nn.Linear(width, width)
        # W_r [V_i; V_j; E_ij] = W_1 V_i + W_2 V_j + W_3 E_ij: nodes are mapped once instead of once per edge.
        self.from_first, self.from_second = nn.Linear(width, width), nn.Linear(width, width, bias=False)
        self.from_edge = nn.Linear(width, width, bias=False)
        self.attention = ExternalSpaceAttention(width, query, axis)

    def forward(self, nodes: Tensor, terms: EdgeTerms, mask: Tensor) -> tuple[Tensor, Tensor]:
        """Return node states and relation features of nodes [B, K, D], both [B, K, D] and undefined at padding."""
        real = mask[:, None, :, None]  # by the second node of an edge
        edges = terms.edges() if self.aggregate == "gcn" or not self.num_layers else None
        for layer in range(self.num_layers):
            gathered = _mean_edges(edges, real) if self.aggregate == "gcn" and edges is not None else 0.0
            before, nodes = nodes, torch.tanh(self.node(nodes) + gathered)
            ends = before if self.attention.axis == "code" else nodes
            mapped = EdgeTerms(self.from_first(ends), self.from_second(ends))
            if layer == 0:  # W_3 is linear, so it can be applied to the terms instead of the edges
                edges = torch.tanh(
                    EdgeTerms(*(a + self.from_edge(b) for a, b in zip(mapped, terms, strict=True))).edges()
                )
            else:
                edges = torch.tanh(mapped.edges() + self.from_edge(edges))
        return nodes, self.attention(edges, real)
