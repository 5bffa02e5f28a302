"""Text2Pos (Kolmet et al., CVPR 2022), coarse stage: an LSTM over words, a graph over instances, a ranking loss."""

from typing import ClassVar, Literal

import torch
from pydantic import Field
from torch import Tensor, nn
from torch.nn.utils.rnn import pack_padded_sequence

from models.language.text_encoder import MAX_TOKENS, TextEncoder, TokenFeatures
from models.paper.instance_encoder import CellBatch, InstanceEncoder
from models.paper.layers import masked_max, mlp
from models.paper.levels import Levels
from models.paper.retriever import Retriever, RetrieverConfig


class Text2PosConfig(RetrieverConfig):
    """Architecture and loss of Text2Pos."""

    # what the LSTM reads: each of the "hints" alone, or the "whole" text, as in the paper
    text: Literal["hints", "whole"] = "hints"
    neighbours: int = Field(default=8, ge=1)  # k of the edge convolution, including the instance itself
    margin: float = Field(default=0.35, ge=0)  # of the ranking loss


class WordEncoder(nn.Module):
    """A bidirectional LSTM over learned word embeddings (Text2Pos, language encoder).

    The last states of the two directions are averaged, as in the released code. Differs: the words are the pieces of
    the tokenizer, so no word is unknown. The weights of the language model are not used.
    """

    def __init__(self, text_encoder: TextEncoder, width: int) -> None:
        super().__init__()
        tokenizer = text_encoder.tokenizer
        assert tokenizer.padding is not None
        self.words = nn.Embedding(tokenizer.get_vocab_size(), width, padding_idx=tokenizer.padding["pad_id"])
        self.lstm = nn.LSTM(width, width, batch_first=True, bidirectional=True)

    def forward(self, ids: Tensor, mask: Tensor) -> Tensor:
        """Return features [S, D] of sentences from token ids [S, T], padded at the end, with mask [S, T]."""
        lengths = mask.sum(dim=1).cpu()  # packing requires it
        packed = pack_padded_sequence(self.words(ids), lengths, batch_first=True, enforce_sorted=False)
        _, (last, _) = self.lstm(packed)  # [2, S, D], one per direction
        features: Tensor = last.mean(dim=0)
        return features


class EdgeConvolution(nn.Module):
    """x_i <- max over the k nearest j of MLP([x_i; x_j - x_i]), near in feature space (Text2Pos, cell encoder).

    This is DynamicEdgeConv of DGCNN, as in the released code. Differs: padding is never a neighbour, and there is no
    batch norm, so a cell does not depend on the rest of the batch.
    """

    def __init__(self, width: int, neighbours: int) -> None:
        super().__init__()
        self.neighbours = neighbours
        # The first layer of the MLP, split, so that nodes are mapped once instead of once per edge.
        self.of_node, self.of_difference = nn.Linear(width, width), nn.Linear(width, width, bias=False)
        self.head = nn.Sequential(nn.ReLU(), nn.Linear(width, width))

    def forward(self, x: Tensor, mask: Tensor) -> Tensor:
        """Return features [B, K, D] of sets with mask [B, K], undefined at padding."""
        batch = torch.arange(len(x), device=x.device)[:, None, None]
        nearest = self._nearest(x.detach(), mask)
        ends = self.of_difference(x)
        edges = (self.of_node(x) - ends)[:, :, None] + ends[batch, nearest]
        return masked_max(self.head(edges), mask[batch, nearest])

    def _nearest(self, x: Tensor, mask: Tensor) -> Tensor:
        """Return indices [B, K, k] of the nearest real entries, padding last."""
        # Without matrix products, whose rounding depends on the batch size and so could change the neighbours.
        distance = torch.cdist(x, x, compute_mode="donot_use_mm_for_euclid_dist")
        distance = distance.masked_fill(~mask[:, None], float("inf"))
        return distance.topk(min(self.neighbours, x.shape[1]), largest=False).indices


class Text2Pos(Retriever):
    """The coarse stage of Text2Pos, which has no attention.

    In the paper one LSTM runs over the whole description, in the order of its hints; the option `text="whole"` does so.
    By default the LSTM reads each hint alone and the description is the maximum over its hints, in any order.

    Differs: in a whole text the tokenizer's marks stay at the ends of each hint; instances come from the encoder that
    all methods share (by default without PointNet++), and padding is masked. The released code ends its MLPs with a
    ReLU, so that its cell vectors are never negative while its descriptions can be; here the last layer is linear.
    """

    method: ClassVar[str] = "text2pos"
    config_type: ClassVar[type[RetrieverConfig]] = Text2PosConfig
    config: Text2PosConfig

    def __init__(self, text_encoder: TextEncoder, config: Text2PosConfig) -> None:
        super().__init__(text_encoder, config)
        width = config.width
        self.hints = WordEncoder(text_encoder, width)
        self.instances = InstanceEncoder(text_encoder.width, width, config.inputs)
        self.graph = EdgeConvolution(width, config.neighbours)
        self.cell = mlp(width, width, width)

    @property
    def reads_whole_text(self) -> bool:
        """Whether the order of the hints matters."""
        return self.config.text == "whole"

    def embed_hints(self, tokens: TokenFeatures) -> Tensor:
        """Return features [S, D] of hint sentences; for the whole text their token ids [S, MAX_TOKENS], -1 at padding.

        Ids are exact in float32, so caches and indexes store them like features.
        """
        if self.reads_whole_text:
            ids = tokens.ids.masked_fill(~tokens.mask, -1).float()
            return nn.functional.pad(ids, (0, MAX_TOKENS - ids.shape[1]), value=-1)
        features: Tensor = self.hints(tokens.ids, tokens.mask)
        return features

    def embed_texts(self, hints: Tensor, mask: Tensor) -> Levels:
        """Return the vectors of descriptions."""
        if not self.reads_whole_text:
            return Levels(nn.functional.normalize(masked_max(hints, mask), dim=-1), mask)
        real = ((hints >= 0) & mask[..., None]).flatten(1)  # [B, H * MAX_TOKENS]
        order = (~real).long().argsort(dim=1, stable=True)[:, : int(real.sum(dim=1).max())]  # padding last
        ids = hints.flatten(1).gather(1, order).clamp(min=0).long()
        return Levels(nn.functional.normalize(self.hints(ids, real.gather(1, order)), dim=-1), mask)

    def embed_cells(self, batch: CellBatch, label_embeddings: Tensor) -> Levels:
        """Return the vectors of cells."""
        mask = batch.mask
        features = self.instances.encode_padded(batch, label_embeddings)
        features = self.graph(nn.functional.normalize(features, dim=-1), mask)
        return Levels(nn.functional.normalize(self.cell(masked_max(features, mask)), dim=-1), mask)

    def loss(self, text: Levels, cells: Levels, same_cell: Tensor) -> Tensor:
        """Return the ranking loss of the global vectors."""
        return pairwise_ranking_loss(text.global_vectors @ cells.global_vectors.T, same_cell, self.config.margin)


def pairwise_ranking_loss(scores: Tensor, same_cell: Tensor, margin: float) -> Tensor:
    """Return the pairwise ranking loss in both directions (Text2Pos, and RET after it; first in Kiros et al., 2014).

    L = mean over i of the sum over j != i of max(0, m - s_ii + s_ij) + max(0, m - s_ii + s_ji): all other pairs of the
    batch are negatives. Differs: pairs of one cell are not negatives. Arguments as of `contrastive_loss`; margin m.
    """
    true_pairs = scores.diagonal()
    other_cells = (margin - true_pairs[:, None] + scores).clamp(min=0)
    other_texts = (margin - true_pairs[None, :] + scores).clamp(min=0)
    return (other_cells + other_texts).masked_fill(same_cell, 0.0).sum() / len(scores)
