"""The relation level: a graph over the instances of a cell or the hints of a description (MNCL, scene graphs)."""

from typing import Literal, NamedTuple

import torch
from torch import Tensor, nn

Query = Literal["edges", "mixed"]
Axis = Literal["edges", "channels"]
Aggregate = Literal["code", "gcn"]


class Ends(NamedTuple):
    """Edges E_ij = first_i + second_j, as they are before the graph mixes them: K vectors of each kind, not K x K.

    Attributes:
        first: [B, K, D] of the node that an edge leaves.
        second: [B, K, D] of the node that it leads to.
    """

    first: Tensor
    second: Tensor

    def edges(self) -> Tensor:
        """[B, K, K, D]."""
        return self.first[:, :, None] + self.second[:, None]


class CellEdges(nn.Module):
    """E_ij = linear(c_i - c_j) of instance centres."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.linear = nn.Linear(3, width)

    def forward(self, centers: Tensor) -> Ends:
        """Edges from centres [B, K, 3]."""
        return Ends(self.linear(centers), -nn.functional.linear(centers, self.linear.weight))


class HintEdges(nn.Module):
    """E_ij = linear([h_i; h_j]) of hint features."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.of_first, self.of_second = nn.Linear(width, width), nn.Linear(width, width, bias=False)

    def forward(self, hints: Tensor) -> Ends:
        """Edges from features [B, K, D]."""
        return Ends(self.of_first(hints), self.of_second(hints))


class ExternalSpaceAttention(nn.Module):
    """The edges of each node as one vector, by attention to what is outside of the set (MNCL, equation 11).

    Q = W E, M_E = softmax of Q M, R = sum over the edges of M_E * E: an external learnable key M [D, D], and a
    learnable W [N_e, N_e] over the N_e edges of a node. Edges have no order here, and sets any size, so W is of the
    kind that no reordering of edges changes: a on the diagonal and b / N_e added everywhere, with a and b learned.

    Args:
        width: D.
        query: "edges" leaves W out (a = 1, b = 0), as the released code does; "mixed" learns it.
        axis: the softmax's: over "edges", for each channel, as the sum goes; over "channels", for each edge, is the
            paper's "second dimension" and the code's.
    """

    def __init__(self, width: int, query: Query, axis: Axis) -> None:
        super().__init__()
        self.axis = axis
        self.mix = nn.Parameter(torch.tensor([1.0, 0.0])) if query == "mixed" else None
        self.key = nn.Linear(width, width)

    def forward(self, edges: Tensor, real: Tensor) -> Tensor:
        """[B, K, D] from edges [B, K, K, D], each node's those that `real` [B, 1, K, 1] has at their far end."""
        query = edges
        if self.mix is not None:
            query = self.mix[0] * edges + self.mix[1] * _mean(edges, real)[:, :, None]
        if self.axis == "edges":
            weights = self.key(query).masked_fill(~real, float("-inf")).softmax(dim=2)
        else:
            weights = self.key(query).softmax(dim=3) * real
        attended: Tensor = (weights * edges).sum(dim=2)
        return attended


def _mean(edges: Tensor, real: Tensor) -> Tensor:
    """[B, K, D] mean of each node's edges; arguments as `ExternalSpaceAttention.forward`."""
    mean: Tensor = (edges * real).sum(dim=2) / real.sum(dim=2)
    return mean


class SceneGraph(nn.Module):
    """m layers with shared weights, then external space attention over the edges of each node.

    A layer is V <- tanh(W_o V) and E_ij <- tanh(W_r [V_i; V_j; E_ij]) (the released code). With aggregate "gcn" a
    node also takes the mean of its edges: V_i <- tanh(W_o V_i + mean over j of E_ij), a reading of the paper's "GCN".
    Differs: padding is masked.
    """

    def __init__(self, width: int, num_layers: int, aggregate: Aggregate, query: Query, axis: Axis) -> None:
        super().__init__()
        self.num_layers, self.aggregate = num_layers, aggregate
        self.node = nn.Linear(width, width)
        # W_r [V_i; V_j; E_ij] = W_1 V_i + W_2 V_j + W_3 E_ij: nodes are mapped once, not once an edge.
        self.from_first, self.from_second = nn.Linear(width, width), nn.Linear(width, width, bias=False)
        self.from_edge = nn.Linear(width, width, bias=False)
        self.attention = ExternalSpaceAttention(width, query, axis)

    def forward(self, nodes: Tensor, ends: Ends, mask: Tensor) -> tuple[Tensor, Tensor]:
        """Run the graph.

        Args:
            nodes: [B, K, D].
            ends: edges; edge ij leads from node i to node j.
            mask: [B, K] bool, True where a node is real.

        Returns:
            node states and relation features, both [B, K, D]; what stands at padding means nothing.
        """
        real = mask[:, None, :, None]  # by the node that an edge leads to
        edges = ends.edges() if self.aggregate == "gcn" or not self.num_layers else None
        for layer in range(self.num_layers):
            gathered = _mean(edges, real) if self.aggregate == "gcn" and edges is not None else 0.0
            nodes = torch.tanh(self.node(nodes) + gathered)
            mapped = Ends(self.from_first(nodes), self.from_second(nodes))
            if layer == 0:  # W_3 of a sum is the sum of what W_3 makes of each: nodes are mapped, not edges
                edges = torch.tanh(Ends(*(a + self.from_edge(b) for a, b in zip(mapped, ends, strict=True))).edges())
            else:
                edges = torch.tanh(mapped.edges() + self.from_edge(edges))
        return nodes, self.attention(edges, real)
