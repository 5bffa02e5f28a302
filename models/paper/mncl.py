"""MNCL (AAAI 2025): global, instance and relation levels, trained with a negative contrastive loss."""

import copy
from typing import ClassVar, Literal

import torch
from pydantic import Field
from torch import Tensor, nn

from models.language.text_encoder import TextEncoder, TokenFeatures
from models.paper.instance_encoder import CellBatch, InstanceEncoder
from models.paper.layers import HintEncoder, SetTransformer, groups_by_size, masked_max, mlp
from models.paper.levels import Level, Levels, level_scores
from models.paper.losses import contrastive_loss, negative_contrastive_loss
from models.paper.retriever import Retriever, RetrieverConfig
from models.paper.scene_graph import Aggregate, Axis, CellEdges, HintEdges, Query, SceneGraph


class MnclConfig(RetrieverConfig):
    """Shape and loss of MNCL; every row of the paper's tables 3 and 4 and both curves of figure 4 is one of these.

    Attributes:
        levels: what is compared; "global" is always among them.
        cell_layers: attention layers over the instances of a cell.
        hint_layers: attention layers over the hints of a description.
        dropout: in the attention layers, while training.
        loss: "contrastive" is the vanilla loss (InfoNCE), "negative" the paper's.
        loss_temperature: tau.
        exponent: a of the negative loss's weights; 0 is the vanilla loss (figure 4).
        least_weight: what these weights are at least: 0.8 in the released code, 0 in the paper.
        graph_layers: m of the scene graph (figure 4).
        aggregate: whether the graph's nodes gather their edges ("gcn", the paper's word) or only pass on their own
            state ("code").
        attention_query, attention_axis: of external space attention, see `ExternalSpaceAttention`.
    """

    levels: tuple[Level, ...] = ("global", "instance", "relation")
    cell_layers: int = 2
    hint_layers: int = 1
    dropout: float = 0.1
    loss: Literal["contrastive", "negative"] = "negative"
    loss_temperature: float = 0.05
    exponent: float = 2.0
    least_weight: float = Field(default=0.8, ge=0, le=1)
    graph_layers: int = 3
    aggregate: Aggregate = "code"
    attention_query: Query = "edges"
    attention_axis: Axis = "edges"


class Mncl(Retriever):
    """MNCL's retriever.

    Differs: padding is masked, labels enter as text embeddings (any word can be a label), and the loss leaves pairs
    of one cell out of the negatives.
    """

    method: ClassVar[str] = "mncl"
    config_type: ClassVar[type[RetrieverConfig]] = MnclConfig
    config: MnclConfig

    def __init__(self, text_encoder: TextEncoder, config: MnclConfig) -> None:
        super().__init__(text_encoder, config)
        width, dropout = config.width, config.dropout
        self.hints = HintEncoder(text_encoder.width, width, dropout)
        self.description = SetTransformer(width, config.hint_layers, num_heads=4, dropout=dropout)
        self.instances = InstanceEncoder(text_encoder.width, width, config.inputs)
        self.cell = SetTransformer(width, config.cell_layers, num_heads=4, dropout=dropout)
        if "relation" in config.levels:
            self.hint_edges, self.cell_edges = HintEdges(width), CellEdges(width)
            shape = width, config.graph_layers, config.aggregate, config.attention_query, config.attention_axis
            self.hint_graph, self.cell_graph = SceneGraph(*shape), SceneGraph(*shape)
        elif "instance" in config.levels:
            self.hint_subspace, self.cell_subspace = (mlp(width, width, width, width) for _ in range(2))

    @property
    def levels(self) -> tuple[Level, ...]:
        """See Retriever."""
        return self.config.levels

    def global_alone(self) -> "Mncl":
        """See Retriever."""
        lean = copy.copy(self)
        lean.config = self.config.model_copy(update={"levels": ("global",)})
        return lean

    def read(self, tokens: TokenFeatures) -> Tensor:
        """See Retriever."""
        features: Tensor = self.hints(tokens.values, tokens.mask)
        return features

    def describe(self, hints: Tensor, mask: Tensor) -> Levels:
        """See Retriever."""
        whole = nn.functional.normalize(masked_max(hints + self.description(hints, mask), mask), dim=-1)
        if "relation" in self.levels:
            return self._with_graph(whole, mask, self.hint_graph(hints, self.hint_edges(hints), mask))
        if "instance" in self.levels:
            return Levels(whole, mask, instance=_unit(self.hint_subspace(hints), mask))
        return Levels(whole, mask)

    def look(self, batch: CellBatch, label_embeddings: Tensor) -> Levels:
        """See Retriever."""
        mask = batch.mask
        features = self.instances.padded(batch, label_embeddings)
        whole = nn.functional.normalize(masked_max(self.cell(features, mask), mask), dim=-1)
        if "relation" in self.levels:
            return self._with_graph(whole, mask, self._graph_of_cells(features, batch.geometry[..., :3], mask))
        if "instance" in self.levels:
            return Levels(whole, mask, instance=_unit(self.cell_subspace(features), mask))
        return Levels(whole, mask)

    def _graph_of_cells(self, features: Tensor, centers: Tensor, mask: Tensor) -> tuple[Tensor, Tensor]:
        """Nodes and relations [B, I, D]: cells of like size together, as the edges grow with its square."""
        nodes, relations = (torch.zeros_like(features, dtype=torch.float32) for _ in range(2))
        for rows, longest in groups_by_size(mask):
            ends = self.cell_edges(centers[rows, :longest])
            found = self.cell_graph(features[rows, :longest], ends, mask[rows, :longest])
            nodes[rows, :longest], relations[rows, :longest] = (part.float() for part in found)
        return nodes, relations

    def _with_graph(self, whole: Tensor, mask: Tensor, graph: tuple[Tensor, Tensor]) -> Levels:
        """Levels from a scene graph's nodes (the code's instance level) and relations."""
        nodes, relations = graph
        instance = _unit(nodes, mask) if "instance" in self.levels else None
        return Levels(whole, mask, instance, _unit(relations, mask))

    def loss(self, text: Levels, cells: Levels, same_cell: Tensor) -> Tensor:
        """The sum over the levels, weights 1; see Retriever."""
        config = self.config
        terms = []
        for level, scores in level_scores(text, cells, self.levels).items():
            if config.loss == "contrastive" or config.exponent == 0:
                terms.append(contrastive_loss(scores, same_cell, config.loss_temperature))
            else:
                means = text.mean_of(level), cells.mean_of(level)
                weights = config.loss_temperature, config.exponent, config.least_weight
                terms.append(negative_contrastive_loss(scores, *means, same_cell, *weights))
        return torch.stack(terms).sum()


def _unit(vectors: Tensor, mask: Tensor) -> Tensor:
    """Unit vectors, zero where nothing is real."""
    return nn.functional.normalize(vectors, dim=-1) * mask[..., None]
