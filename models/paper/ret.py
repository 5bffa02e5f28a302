"""RET (Wang, Fan and Kankanhalli, AAAI 2023), coarse stage: transformers whose values include pair relations."""

from typing import ClassVar

from pydantic import Field
from torch import Tensor, nn

from models.language.text_encoder import TextEncoder, TokenFeatures
from models.paper.instance_encoder import CellBatch, InstanceEncoder
from models.paper.layers import masked_max, mlp
from models.paper.levels import Levels
from models.paper.relation_attention import InstanceRelation, RelationAttention
from models.paper.retriever import Retriever, RetrieverConfig
from models.paper.text2pos import WordEncoder, pairwise_ranking_loss


class RetConfig(RetrieverConfig):
    """Architecture and loss of RET."""

    cell_layers: int = Field(default=2, ge=0)  # relation-enhanced layers over the instances of a cell
    hint_layers: int = Field(default=2, ge=0)  # relation-enhanced layers over the hints of a description
    dropout: float = Field(default=0.1, ge=0, lt=1)  # of these layers in training
    margin: float = Field(default=0.35, ge=0)  # of the ranking loss


class HintRelation(nn.Module):
    """Pooled relations of hints: max over j of R_ij = W [h_i; h_j] (RET, relation-enhanced self-attention)."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.of_first, self.of_second = nn.Linear(width, width), nn.Linear(width, width, bias=False)

    def forward(self, hints: Tensor, mask: Tensor) -> Tensor:
        """Return [B, K, D] from features [B, K, D] with mask [B, K]."""
        pooled: Tensor = self.of_first(hints) + masked_max(self.of_second(hints), mask)[:, None]
        return pooled


class RelationLayer(RelationAttention):
    """A transformer layer with relation-enhanced self-attention."""

    def __init__(self, width: int, dropout: float) -> None:
        super().__init__(width, dropout)
        self.feed_forward = mlp(width, 2 * width, width)
        self.attention_norm, self.feed_forward_norm = nn.LayerNorm(width), nn.LayerNorm(width)

    def forward(self, x: Tensor, relation: Tensor, mask: Tensor) -> Tensor:
        """Apply the layer to x and pooled relations, both [B, K, D]; the result is undefined at padding."""
        x = self.attention_norm(x + self.dropout(self.attend(x, relation, mask)))
        updated: Tensor = self.feed_forward_norm(x + self.dropout(self.feed_forward(x)))
        return updated


class RelationTransformer(nn.Module):
    """Relation-enhanced layers and the maximum over the set as a unit vector, for texts or cells (RET)."""

    def __init__(self, width: int, num_layers: int, dropout: float) -> None:
        super().__init__()
        self.layers = nn.ModuleList(RelationLayer(width, dropout) for _ in range(num_layers))

    def forward(self, x: Tensor, relation: Tensor, mask: Tensor) -> Tensor:
        """Return unit vectors [B, D] of sets; arguments as in `RelationLayer`."""
        for layer in self.layers:
            x = layer(x, relation, mask)
        return nn.functional.normalize(masked_max(x, mask), dim=-1)


class Ret(Retriever):
    """The coarse stage of RET: an LSTM over the words of a hint, relation-enhanced transformers, a ranking loss.

    The authors' repository (daoyuan98/text2pos-ret) has no code, so this follows the paper. The paper leaves open how
    relations are pooled: here by their maximum over the partners, once for all layers. Differs: padding is masked (in
    the pooling too), any number of hints, instances from the encoder that all methods share, and pairs of one cell are
    not negatives.
    """

    method: ClassVar[str] = "ret"
    config_type: ClassVar[type[RetrieverConfig]] = RetConfig
    config: RetConfig

    def __init__(self, text_encoder: TextEncoder, config: RetConfig) -> None:
        super().__init__(text_encoder, config)
        width, dropout = config.width, config.dropout
        self.hints = WordEncoder(text_encoder, width)
        self.hint_relation = HintRelation(width)
        self.description = RelationTransformer(width, config.hint_layers, dropout)
        self.instances = InstanceEncoder(text_encoder.width, width, config.inputs)
        self.instance_relation = InstanceRelation(width)
        self.cell = RelationTransformer(width, config.cell_layers, dropout)

    def embed_hints(self, tokens: TokenFeatures) -> Tensor:
        """Return features [S, D] of hint sentences."""
        features: Tensor = self.hints(tokens.ids, tokens.mask)
        return features

    def embed_texts(self, hints: Tensor, mask: Tensor) -> Levels:
        """Return the vectors of descriptions."""
        return Levels(self.description(hints, self.hint_relation(hints, mask), mask), mask)

    def embed_cells(self, batch: CellBatch, label_embeddings: Tensor) -> Levels:
        """Return the vectors of cells."""
        mask = batch.mask
        features = self.instances.encode_padded(batch, label_embeddings)
        relation = self.instance_relation(batch.geometry[..., :3], mask)
        return Levels(self.cell(features, relation, mask), mask)

    def loss(self, text: Levels, cells: Levels, same_cell: Tensor) -> Tensor:
        """Return the ranking loss of the global vectors."""
        return pairwise_ranking_loss(text.global_vectors @ cells.global_vectors.T, same_cell, self.config.margin)
