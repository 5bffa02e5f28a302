"""The relation level: a graph over the instances of a cell or the hints of a description (MNCL, scene graphs)."""

from typing import Literal

import torch
from torch import Tensor, nn


class CellEdges(nn.Module):
    """E_ij = linear(c_i - c_j) of instance centres."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.linear = nn.Linear(3, width)

    def forward(self, centers: Tensor) -> Tensor:
        """[B, K, K, D] from centres [B, K, 3]."""
        edges: Tensor = self.linear(centers[:, :, None] - centers[:, None])
        return edges


class HintEdges(nn.Module):
    """E_ij = linear([h_i; h_j]) of hint features; the linear map is split, so that nothing of size 2D is made."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.of_first, self.of_second = nn.Linear(width, width), nn.Linear(width, width, bias=False)

    def forward(self, hints: Tensor) -> Tensor:
        """[B, K, K, D] from features [B, K, D]."""
        edges: Tensor = self.of_first(hints)[:, :, None] + self.of_second(hints)[:, None]
        return edges


class SceneGraph(nn.Module):
    """m layers with shared weights, then external space attention over the edges of each node.

    A layer is V <- tanh(W_o V) and E_ij <- tanh(W_r [V_i; V_j; E_ij]) (the released code). With aggregate "gcn" a
    node also takes the mean of its edges: V_i <- tanh(W_o V_i + mean over j of E_ij), a reading of the paper's "GCN".
    Attention: a_ij = softmax over j of linear(E_ij), for each channel; R_i = sum over j of a_ij * E_ij. Differs:
    softmax and sum run over the same axis, and padding is masked.
    """

    def __init__(self, width: int, num_layers: int, aggregate: Literal["code", "gcn"]) -> None:
        super().__init__()
        self.num_layers, self.aggregate = num_layers, aggregate
        self.node = nn.Linear(width, width)
        # W_r [V_i; V_j; E_ij] = W_1 V_i + W_2 V_j + W_3 E_ij: nodes are mapped once, not once an edge.
        self.from_first, self.from_second = nn.Linear(width, width), nn.Linear(width, width, bias=False)
        self.from_edge = nn.Linear(width, width, bias=False)
        self.attention = nn.Linear(width, width)

    def forward(self, nodes: Tensor, edges: Tensor, mask: Tensor) -> tuple[Tensor, Tensor]:
        """Run the graph.

        Args:
            nodes: [B, K, D].
            edges: [B, K, K, D]; edges[b, i, j] leads from node i to node j.
            mask: [B, K] bool, True where a node is real.

        Returns:
            node states and relation features, both [B, K, D]; what stands at padding means nothing.
        """
        real = mask[:, None, :, None]  # by the node that an edge leads to
        for _ in range(self.num_layers):
            gathered = (edges * real).sum(dim=2) / real.sum(dim=2) if self.aggregate == "gcn" else 0.0
            nodes = torch.tanh(self.node(nodes) + gathered)
            ends = self.from_first(nodes)[:, :, None] + self.from_second(nodes)[:, None]
            edges = torch.tanh(ends + self.from_edge(edges))
        weights = self.attention(edges).masked_fill(~real, float("-inf")).softmax(dim=2)
        return nodes, (weights * edges).sum(dim=2)
