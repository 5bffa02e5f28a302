"""Text2Loc (Xia et al., CVPR 2024), global place recognition: a hierarchical transformer with max pooling, InfoNCE."""

from typing import ClassVar, Literal

from pydantic import Field
from torch import Tensor, nn

from models.language.text_encoder import TextEncoder, TokenFeatures
from models.paper.instance_encoder import CellBatch, InstanceEncoder
from models.paper.layers import CauchyTransformer, HintEncoder, SetTransformer, masked_max
from models.paper.levels import Levels
from models.paper.losses import contrastive_loss
from models.paper.retriever import Retriever, RetrieverConfig

NUM_HEADS = 4


class Text2LocConfig(RetrieverConfig):
    """Architecture and loss of Text2Loc."""

    cell_layers: int = Field(default=2, ge=0)  # attention layers over the instances of a cell
    # how instances of a cell attend to each other: by features alone, or less with distance (CMMLoc, see `CauchyLayer`)
    cell_attention: Literal["plain", "cauchy"] = "plain"
    hint_layers: int = Field(
        default=1, ge=0
    )  # attention layers over the hints of a description, each with a residual connection
    dropout: float = Field(default=0.1, ge=0, lt=1)  # of the attention layers in training
    loss_temperature: float = Field(default=0.1, gt=0)  # tau


class Text2Loc(Retriever):
    """The global place recognition of Text2Loc, on which MNCL's global level is based.

    Text branch (the paper's hierarchical transformer with max pooling): a frozen language model, one transformer layer
    over the tokens of a hint, maximum, linear and batch norm; then one layer over the hints with a residual,
    maximum. Submap branch: unit instance features, two attention layers, maximum. Loss: the paper's text-submap
    contrastive loss; its two directions are averaged here, added there.

    Differs: padding is masked (the released code attends to it and takes the maximum over it), any number of hints
    (there: the same for a whole batch), instances from the encoder that all methods share (by default without
    PointNet++), tokens are projected to D before their layer (see HintEncoder), feed-forward layers are 2D wide on the
    text side too (there: 4D), pairs of one cell are not negatives, and the default language model is MiniLM, not T5.
    """

    method: ClassVar[str] = "text2loc"
    config_type: ClassVar[type[RetrieverConfig]] = Text2LocConfig
    config: Text2LocConfig

    def __init__(self, text_encoder: TextEncoder, config: Text2LocConfig) -> None:
        super().__init__(text_encoder, config)
        width, dropout = config.width, config.dropout
        self.hints = HintEncoder(text_encoder.width, width, dropout)
        self.description = nn.ModuleList(
            SetTransformer(width, num_layers=1, num_heads=NUM_HEADS, dropout=dropout) for _ in range(config.hint_layers)
        )
        self.instances = InstanceEncoder(text_encoder.width, width, config.inputs)
        transformer = CauchyTransformer if config.cell_attention == "cauchy" else SetTransformer
        self.cell = transformer(width, config.cell_layers, num_heads=NUM_HEADS, dropout=dropout)

    def embed_hints(self, tokens: TokenFeatures) -> Tensor:
        """Return features [S, D] of hint sentences."""
        features: Tensor = self.hints(tokens.values, tokens.mask)
        return features

    def embed_texts(self, hints: Tensor, mask: Tensor) -> Levels:
        """Return the vectors of descriptions."""
        for layer in self.description:
            hints = hints + layer(hints, mask)
        return Levels(nn.functional.normalize(masked_max(hints, mask), dim=-1), mask)

    def embed_cells(self, batch: CellBatch, label_embeddings: Tensor) -> Levels:
        """Return the vectors of cells."""
        mask = batch.mask
        features = nn.functional.normalize(self.instances.encode_padded(batch, label_embeddings), dim=-1)
        if self.config.cell_attention == "cauchy":
            features = self.cell(features, mask, batch.geometry[..., :3])
        else:
            features = self.cell(features, mask)
        return Levels(nn.functional.normalize(masked_max(features, mask), dim=-1), mask)

    def loss(self, text: Levels, cells: Levels, same_cell: Tensor) -> Tensor:
        """Return the contrastive loss of the global vectors."""
        return contrastive_loss(text.global_vectors @ cells.global_vectors.T, same_cell, self.config.loss_temperature)
