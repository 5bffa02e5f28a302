"""MNCL (AAAI 2025): global, instance and relation levels, trained with a negative contrastive loss."""

import copy
from typing import ClassVar, Literal

import torch
from pydantic import Field, field_validator
from torch import Tensor, nn

from models.language.text_encoder import TextEncoder, TokenFeatures
from models.paper.instance_encoder import CellBatch, InstanceEncoder
from models.paper.layers import HintEncoder, SetTransformer, group_by_size, masked_max, mlp
from models.paper.levels import Level, Levels, Matching, level_scores
from models.paper.losses import (
    Distance,
    Logarithms,
    clamped_share,
    contrastive_loss,
    negative_contrastive_loss,
    negative_weights,
)
from models.paper.point_model import check_point_option
from models.paper.retriever import Retriever, RetrieverConfig
from models.paper.scene_graph import Aggregate, AttentionAxis, AttentionQuery, CellEdges, HintEdges, SceneGraph

RELEASED_LEAST_WEIGHT = 0.8  # of the negative loss, in the released code


class MnclConfig(RetrieverConfig):
    """Architecture and loss of MNCL, with an option for each row of tables 3 and 4 and for both curves of figure 4."""

    # the levels to compare; "global" is always the first
    levels: tuple[Level, ...] = ("global", "instance", "relation")
    # similarity of the instance and relation levels, see `set_similarity`: "hints" in the code, "both" in the paper
    matching: Matching = "hints"
    # relation-enhanced attention among the point features of a cell (the released code); the paper does not have it
    point_relations: bool = False
    cell_layers: int = Field(default=2, ge=0)  # attention layers over the instances of a cell
    hint_layers: int = Field(default=1, ge=0)  # attention layers over the hints of a description
    dropout: float = Field(default=0.1, ge=0, lt=1)  # of the attention layers in training
    # "contrastive" is the vanilla loss (InfoNCE), "negative" the paper's
    loss: Literal["contrastive", "negative"] = "negative"
    loss_temperature: float = Field(default=0.05, gt=0)  # tau
    # a of the weights of the negative loss; 0 selects the vanilla loss (figure 4)
    exponent: float = Field(default=2.0, ge=0)
    # divisor of the distance in these weights: the maximum of the "batch" (the released code) or of "unit" vectors, 2
    distance: Distance = "batch"
    # minimum of these weights; None for 0.8 with "batch" (the released code) and 0 with "unit" (the paper)
    least_weight: float | None = Field(default=None, ge=0, le=1)
    logarithms: Logarithms = "two"  # of the negative loss: "two" in the released code, "one" of 1 - p - q in the paper
    graph_layers: int = Field(default=3, ge=0)  # m of the scene graph (figure 4)
    # "gcn" (the paper) adds the mean of its edges to each node, "code" (the released code) does not
    aggregate: Aggregate = "code"
    attention_query: AttentionQuery = "edges"  # see `ExternalSpaceAttention`
    attention_axis: AttentionAxis = "edges"  # "code" is the released code, whose edges also see earlier nodes

    _check_point_relations = field_validator("point_relations")(check_point_option)

    @field_validator("levels")
    @classmethod
    def _starts_with_global(cls, levels: tuple[Level, ...]) -> tuple[Level, ...]:
        """Refuse levels that an index cannot rank by: it searches by the global level, which the loss must train."""
        if levels[:1] != ("global",) or len(set(levels)) < len(levels):
            raise ValueError("write 'global' first, then 'instance', 'relation' or both, each once")
        return levels


class Mncl(Retriever):
    """The retriever of MNCL.

    Differs: padding is masked, labels enter as text embeddings (any word can be a label), and pairs of one cell are
    not negatives.
    """

    method: ClassVar[str] = "mncl"
    config_type: ClassVar[type[RetrieverConfig]] = MnclConfig
    config: MnclConfig

    def __init__(self, text_encoder: TextEncoder, config: MnclConfig) -> None:
        super().__init__(text_encoder, config)
        width, dropout = config.width, config.dropout
        self._clamped_shares: list[Tensor] = []  # of each level and step since `pop_loss_figures`
        self.hints = HintEncoder(text_encoder.width, width, dropout)
        self.description = SetTransformer(width, config.hint_layers, num_heads=4, dropout=dropout)
        self.instances = InstanceEncoder(text_encoder.width, width, config.inputs, config.point_relations, dropout)
        self.cell = SetTransformer(width, config.cell_layers, num_heads=4, dropout=dropout)
        if "relation" in config.levels:
            self.hint_edges, self.cell_edges = HintEdges(width), CellEdges(width)
            shape = width, config.graph_layers, config.aggregate, config.attention_query, config.attention_axis
            self.hint_graph, self.cell_graph = SceneGraph(*shape), SceneGraph(*shape)
        elif "instance" in config.levels:
            self.hint_subspace, self.cell_subspace = (mlp(width, width, width, width) for _ in range(2))

    @property
    def levels(self) -> tuple[Level, ...]:
        """The levels of the configuration."""
        return self.config.levels

    @property
    def matching(self) -> Matching:
        """The matching of the configuration."""
        return self.config.matching

    def global_only(self) -> "Mncl":
        """Return a copy with the global level only; it shares the weights."""
        reduced = copy.copy(self)
        reduced.config = self.config.model_copy(update={"levels": ("global",)})
        return reduced

    def embed_hints(self, tokens: TokenFeatures) -> Tensor:
        """Return features [S, D] of hint sentences."""
        features: Tensor = self.hints(tokens.values, tokens.mask)
        return features

    def embed_texts(self, hints: Tensor, mask: Tensor) -> Levels:
        """Return the vectors of descriptions."""
        global_vectors = nn.functional.normalize(masked_max(hints + self.description(hints, mask), mask), dim=-1)
        if "relation" in self.levels:
            return self._with_graph(global_vectors, mask, self.hint_graph(hints, self.hint_edges(hints), mask))
        if "instance" in self.levels:
            return Levels(global_vectors, mask, instance=_unit(self.hint_subspace(hints), mask))
        return Levels(global_vectors, mask)

    def embed_cells(self, batch: CellBatch, label_embeddings: Tensor) -> Levels:
        """Return the vectors of cells."""
        mask = batch.mask
        features = self.instances.encode_padded(batch, label_embeddings)
        global_vectors = nn.functional.normalize(masked_max(self.cell(features, mask), mask), dim=-1)
        if "relation" in self.levels:
            return self._with_graph(global_vectors, mask, self._run_cell_graph(features, batch.geometry[..., :3], mask))
        if "instance" in self.levels:
            return Levels(global_vectors, mask, instance=_unit(self.cell_subspace(features), mask))
        return Levels(global_vectors, mask)

    def _run_cell_graph(self, features: Tensor, centers: Tensor, mask: Tensor) -> tuple[Tensor, Tensor]:
        """Return nodes and relations [B, I, D], run on groups of equal size: the edges grow with its square."""
        nodes, relations = (torch.zeros_like(features, dtype=torch.float32) for _ in range(2))
        for rows, longest in group_by_size(mask):
            ends = self.cell_edges(centers[rows, :longest])
            states = self.cell_graph(features[rows, :longest], ends, mask[rows, :longest])
            nodes[rows, :longest], relations[rows, :longest] = (part.float() for part in states)
        return nodes, relations

    def _with_graph(self, global_vectors: Tensor, mask: Tensor, graph: tuple[Tensor, Tensor]) -> Levels:
        """Return the levels from the nodes of a scene graph (the code's instance level) and its relations."""
        nodes, relations = graph
        instance = _unit(nodes, mask) if "instance" in self.levels else None
        return Levels(global_vectors, mask, instance, _unit(relations, mask))

    def loss(self, text: Levels, cells: Levels, same_cell: Tensor) -> Tensor:
        """Return the sum of the losses of all levels."""
        config, tau = self.config, self.config.loss_temperature
        least = config.least_weight
        if least is None:
            least = RELEASED_LEAST_WEIGHT if config.distance == "batch" else 0.0
        terms = []
        for level, scores in level_scores(text, cells, self.levels, self.matching).items():
            if config.loss == "contrastive" or config.exponent == 0:
                terms.append(contrastive_loss(scores, same_cell, tau))
            else:
                means = text.mean_vectors(level), cells.mean_vectors(level)
                weights = negative_weights(*means, config.exponent, least, config.distance)
                terms.append(negative_contrastive_loss(scores, weights, same_cell, tau, config.logarithms))
                if config.logarithms == "one":
                    self._clamped_shares.append(clamped_share(scores, same_cell, tau))
        return torch.stack(terms).sum()

    def pop_loss_figures(self) -> dict[str, float]:
        """Return the share of pairs that one logarithm clamped, the mean over levels and steps since the last call."""
        shares, self._clamped_shares = self._clamped_shares, []
        return {"clamped_pairs": float(torch.stack(shares).mean())} if shares else {}


def _unit(vectors: Tensor, mask: Tensor) -> Tensor:
    """Normalize vectors to unit length, with zeros at padding."""
    return nn.functional.normalize(vectors, dim=-1) * mask[..., None]
