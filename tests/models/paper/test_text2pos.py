"""Text2Pos's parts against their equations written as loops."""

import pytest
import torch
from torch import nn

from index.answering.hint_features import load_hint_features, save_hint_features
from models.paper.checkpoint import load_retriever, save_retriever
from models.paper.text2pos import EdgeConvolution, Text2Pos, Text2PosConfig, WordEncoder, pairwise_ranking_loss


def test_ranking_loss_against_a_loop() -> None:
    torch.manual_seed(0)
    scores = (torch.rand(6, 6, dtype=torch.float64) * 2 - 1).requires_grad_()
    same = torch.eye(6, dtype=torch.bool)
    same[1, 4] = same[4, 1] = True  # two descriptions of one cell
    s, total = scores.tolist(), 0.0
    for i in range(6):
        for j in (j for j in range(6) if not same[i, j]):
            total += max(0.0, 0.35 - s[i][i] + s[i][j]) + max(0.0, 0.35 - s[i][i] + s[j][i])
    assert pairwise_ranking_loss(scores, same, 0.35).item() == pytest.approx(total / 6)
    assert torch.autograd.gradcheck(lambda x: pairwise_ranking_loss(x, same, 0.35), scores)


def test_no_loss_where_every_pair_is_apart_by_the_margin() -> None:
    same = torch.eye(3, dtype=torch.bool)
    assert pairwise_ranking_loss(torch.eye(3), same, 0.35).item() == 0
    assert pairwise_ranking_loss(torch.zeros(3, 3), same, 0.35).item() == pytest.approx(2 * 2 * 0.35)


@pytest.mark.parametrize("neighbours", [1, 3, 8])
def test_edge_convolution_against_a_loop(neighbours) -> None:
    torch.manual_seed(1)
    convolution = EdgeConvolution(4, neighbours)
    x, mask = torch.randn(2, 6, 4), torch.arange(6) < torch.tensor([[6], [2]])
    first = torch.cat([convolution.of_node.weight, convolution.of_difference.weight], dim=1)
    with torch.no_grad():
        features = convolution(x, mask)
        for b, size in enumerate([6, 2]):
            nodes = x[b, :size]
            for i in range(size):
                nearest = sorted(nodes, key=lambda node: (node - nodes[i]).norm().item())[:neighbours]
                edges = [
                    convolution.head(
                        nn.functional.linear(torch.cat([nodes[i], j - nodes[i]]), first, convolution.of_node.bias)
                    )
                    for j in nearest
                ]
                assert torch.allclose(features[b, i], torch.stack(edges).amax(dim=0), atol=1e-5)


def test_words_are_read_one_after_another(text_encoder) -> None:
    torch.manual_seed(2)
    encoder = WordEncoder(text_encoder, 8)
    forward, backward = nn.LSTMCell(8, 8), nn.LSTMCell(8, 8)
    for name in ("weight_ih", "weight_hh", "bias_ih", "bias_hh"):
        getattr(forward, name).data = getattr(encoder.lstm, f"{name}_l0").data
        getattr(backward, name).data = getattr(encoder.lstm, f"{name}_l0_reverse").data
    sentences = ["A tree is to my west.", "I stand on the old gray road.", "Tree."]
    with torch.inference_mode():
        tokens = text_encoder(sentences)
        features = encoder(tokens.ids, tokens.mask)
        for s, mask in enumerate(tokens.mask):
            words = encoder.words(tokens.ids[s, mask])
            states = []
            for cell, order in ((forward, words), (backward, words.flip(0))):
                state = torch.zeros(8), torch.zeros(8)
                for word in order:
                    state = cell(word, state)
                states.append(state[0])
            assert torch.allclose(features[s], (states[0] + states[1]) / 2, atol=1e-5)


WHOLE_TEXTS = [
    ["A tree is to my west.", "I stand on the old gray road.", "Tree."],
    ["A black pole is to my west."],
]


@pytest.fixture
def whole(text_encoder):
    torch.manual_seed(3)
    return Text2Pos(text_encoder, Text2PosConfig(width=8, text="whole")).eval()


def test_one_lstm_reads_the_whole_text(whole) -> None:
    forward, backward = nn.LSTMCell(8, 8), nn.LSTMCell(8, 8)
    for name in ("weight_ih", "weight_hh", "bias_ih", "bias_hh"):
        getattr(forward, name).data = getattr(whole.hints.lstm, f"{name}_l0").data
        getattr(backward, name).data = getattr(whole.hints.lstm, f"{name}_l0_reverse").data
    encoded = whole.encode_texts(WHOLE_TEXTS)
    padded = whole.encode_texts_padded(WHOLE_TEXTS)
    for text, levels, in_batch in zip(WHOLE_TEXTS, encoded, padded, strict=True):
        ids = [i for hint in text for i in whole.text_encoder.tokenizer.encode(hint).ids]
        with torch.inference_mode():
            words, states = [whole.hints.words(torch.tensor(i)) for i in ids], []
            for cell, order in ((forward, words), (backward, words[::-1])):
                state = torch.zeros(8), torch.zeros(8)
                for word in order:
                    state = cell(word, state)
                states.append(state[0])
        mean = (states[0] + states[1]) / 2
        assert torch.allclose(levels.global_vectors[0], mean / mean.norm(), atol=1e-5)
        assert torch.allclose(in_batch.global_vectors[0], mean / mean.norm(), atol=1e-5)


def test_the_order_of_hints_matters_to_the_whole_text_alone(whole, text_encoder) -> None:
    for model in (whole, Text2Pos(text_encoder, Text2PosConfig(width=8)).eval()):
        one, other = (model.encode_description(text).global_vectors for text in (WHOLE_TEXTS[0], WHOLE_TEXTS[0][::-1]))
        assert torch.allclose(one, other, atol=1e-6) != model.reads_whole_text


def test_an_index_stores_what_the_whole_text_is_made_of(whole, tmp_path, monkeypatch) -> None:
    hints = tuple(WHOLE_TEXTS[0])
    expected = whole.encode_description(hints).global_vectors
    save_hint_features(tmp_path, whole, hints)
    save_retriever(whole, tmp_path / "weights", {})
    again = load_retriever(tmp_path / "weights")
    load_hint_features(tmp_path, again)
    monkeypatch.setattr(again, "embed_hints", None)  # what would run the text encoder
    # weights are saved in half precision
    assert torch.allclose(again.encode_description(hints).global_vectors, expected, atol=1e-3)


def test_word_order_matters_inside_a_hint(text_encoder) -> None:
    encoder = WordEncoder(text_encoder, 8)
    with torch.inference_mode():
        tokens = text_encoder(["north of a pole east", "east of a pole north"])
        one, other = encoder(tokens.ids, tokens.mask)
    assert not torch.allclose(one, other, atol=1e-4)


def test_config_has_the_papers_numbers() -> None:
    assert (Text2PosConfig().margin, Text2PosConfig().neighbours, Text2PosConfig().width) == (0.35, 8, 256)
    with pytest.raises(ValueError, match="greater than or equal"):
        Text2PosConfig(neighbours=0)
