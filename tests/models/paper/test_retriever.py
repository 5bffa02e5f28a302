import numpy as np
import pytest
import torch

from models.errors import WeightsError
from models.paper.checkpoint import load_retriever, save_retriever
from models.paper.instance_encoder import (
    DEFAULT_INPUTS,
    GEOMETRY_WIDTH,
    PAPER_INPUTS,
    CellFeatures,
    InstanceEncoder,
    geometry_columns,
)
from models.paper.layers import HintEncoder, masked_max
from models.paper.level_table import encode_gallery
from models.paper.mncl import Mncl, MnclConfig
from tests.encoding import encode_descriptions

TEXTS = [
    ["I am north of a gray building."],
    ["A black pole is to my west.", "I stand on the road.", "There is a tree north of me."],
    [f"There is a bench number {i} to my east." for i in range(12)],
]


@pytest.fixture(scope="module")
def model(mncl):
    return mncl


@pytest.fixture(scope="module")
def features(city, cells):
    return CellFeatures.from_cells(cells, np.array([i.label for i in city.instances]))


def test_masked_max_ignores_padding() -> None:
    x = torch.tensor([[[1.0, -5.0], [9.0, 9.0]], [[-3.0, -4.0], [-2.0, -9.0]]])
    mask = torch.tensor([[True, False], [True, True]])
    assert masked_max(x, mask).tolist() == [[1.0, -5.0], [-2.0, -4.0]]


def test_hint_features_against_equation_m1() -> None:
    torch.manual_seed(0)
    encoder = HintEncoder(6, 8, 0.1).eval()
    encoder.norm.running_mean.normal_()
    encoder.norm.running_var.uniform_(0.5, 2.0)
    tokens, lengths = torch.randn(2, 5, 6), (5, 3)
    with torch.no_grad():
        features = encoder(tokens, torch.arange(5) < torch.tensor(lengths)[:, None])
        for sentence, length in enumerate(lengths):
            attended = encoder.tokens.layers[0](encoder.project(tokens[sentence, :length])[None])[0]
            largest = torch.stack([max(column) for column in attended.T])
            head = encoder.head(largest) - encoder.norm.running_mean
            expected = head / (encoder.norm.running_var + encoder.norm.eps).sqrt()
            assert torch.allclose(features[sentence], expected, atol=1e-5)


def test_a_description_alone_and_in_a_batch(model) -> None:
    together = encode_descriptions(model, TEXTS)
    for row, text in enumerate(TEXTS):
        assert np.abs(encode_descriptions(model, [text])[0] - together[row]).max() == 0
    assert np.linalg.norm(together, axis=1) == pytest.approx(1, abs=1e-6)


def test_padding_a_description_changes_nothing(model) -> None:
    hints = torch.randn(1, 3, 32)
    padded = torch.cat([hints, torch.full((1, 4, 32), 1e3)], dim=1)
    mask = torch.arange(7)[None] < 3
    alone, in_batch = model.embed_texts(hints, torch.ones(1, 3, dtype=torch.bool)), model.embed_texts(padded, mask)
    for level in ("global", "instance", "relation"):
        assert torch.allclose(in_batch.vectors(level)[:, :3], alone.vectors(level)[:, :3], atol=1e-5)


def test_order_of_hints_does_not_matter(model) -> None:
    assert np.array_equal(encode_descriptions(model, [TEXTS[2]]), encode_descriptions(model, [TEXTS[2][::-1]]))
    hints = torch.randn(2, 5, 32)
    mask = torch.ones(2, 5, dtype=torch.bool)
    order = [3, 1, 0, 4, 2]
    before, after = model.embed_texts(hints, mask), model.embed_texts(hints[:, order], mask)
    assert torch.allclose(before.global_vectors, after.global_vectors, atol=1e-5)
    for level in ("instance", "relation"):
        assert torch.allclose(before.vectors(level)[:, order], after.vectors(level), atol=1e-5)


def test_a_cell_alone_and_in_a_batch(model, features) -> None:
    every = encode_gallery(model, features)[0]
    labels = model.text_encoder.embed(features.labels)
    for n in (0, 7, len(features) - 1):
        with torch.inference_mode():
            alone = model.embed_cells(features.batch(np.array([n])), labels)
            in_batch = model.embed_cells(features.batch(np.array([n, 3, 11])), labels)
        assert np.abs(alone.global_vectors[0].numpy() - every[n]).max() < 1e-5
        real = int(alone.mask.sum())
        for level in ("instance", "relation"):
            assert torch.allclose(alone.vectors(level)[0, :real], in_batch.vectors(level)[0, :real], atol=1e-5)


def test_cached_hints_give_the_same_vector_and_are_forgotten_when_weights_change(model, text_encoder) -> None:
    fresh = Mncl(text_encoder, model.config)
    fresh.load_state_dict(model.state_dict())
    fresh.eval()
    first = encode_descriptions(fresh, TEXTS[:1])
    assert fresh._hint_cache
    assert np.array_equal(first, encode_descriptions(fresh, TEXTS[:1]))
    fresh.train()
    assert not fresh._hint_cache


def test_features_of_a_cell(city, cells, features) -> None:
    n = 4
    rows = slice(cells.parts.starts[n], cells.parts.starts[n + 1])
    geometry = features.geometry[rows]
    assert geometry.shape[1] == GEOMETRY_WIDTH
    offset = (cells.parts.closest_m[rows] - cells.center_m[n])[:, :2]
    assert geometry[:, 3:5] * 15 == pytest.approx(offset, abs=1e-3)
    assert geometry[:, 5] * 15 == pytest.approx(np.hypot(*offset.T), abs=1e-3)
    assert geometry[:, 11] * 10 == pytest.approx(np.log1p(cells.parts.count[rows]), abs=1e-4)
    assert [features.labels[i] for i in features.label[rows]] == [
        city.instances[i].label for i in cells.parts.instance[rows]
    ]
    known = ~np.isnan(cells.parts.rgb[rows]).any(axis=1)
    assert (geometry[:, 15] == known).all()
    assert (geometry[~known, 12:15] == 0).all()


def test_saved_and_loaded_is_the_same(model, tmp_path) -> None:
    save_retriever(model, tmp_path, {"note": "x"})
    again = load_retriever(tmp_path)
    assert again.fingerprint == model.fingerprint
    assert np.array_equal(encode_descriptions(again, TEXTS), encode_descriptions(model, TEXTS))


def test_another_model_of_the_same_shape_has_another_fingerprint(model, text_encoder) -> None:
    assert Mncl(text_encoder, model.config).fingerprint != model.fingerprint


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda d: (d / "config.json").unlink(), "config.json is missing"),
        (lambda d: (d / "model.safetensors").unlink(), "model.safetensors is missing"),
        (lambda d: (d / "model.safetensors").write_bytes(b"junk"), "cannot be read"),
        (lambda d: (d / "config.json").write_text("{"), "cannot be read"),
        (
            lambda d: (d / "config.json").write_text('{"method": "mncl", "retriever": {"width": 64}}'),
            "do not match its config.json",
        ),
        (lambda d: (d / "config.json").write_text('{"method": "mncl", "retriever": {"depth": 64}}'), "cannot be read"),
    ],
)
def test_broken_weights_are_refused(model, tmp_path, spoil, message) -> None:
    save_retriever(model, tmp_path, {})
    spoil(tmp_path)
    with pytest.raises(WeightsError, match=message):
        load_retriever(tmp_path)


def test_config_is_strict() -> None:
    with pytest.raises(ValueError, match="extra"):
        MnclConfig(depth=3)


@pytest.mark.parametrize("left_out", [*DEFAULT_INPUTS])
def test_an_input_left_out_is_not_looked_at(features, text_encoder, left_out) -> None:
    inputs = tuple(name for name in DEFAULT_INPUTS if name != left_out)
    torch.manual_seed(0)
    encoder = InstanceEncoder(text_encoder.width, 32, inputs)
    geometry, label = torch.from_numpy(features.geometry[:50]), torch.randn(50, text_encoder.width)
    before = encoder(geometry, label)
    for name in DEFAULT_INPUTS:
        other_geometry, other_label = geometry.clone(), label
        if name == "label":
            other_label = label + 1
        else:
            other_geometry[:, geometry_columns([name])] += 1
        same = torch.equal(encoder(other_geometry, other_label), before)
        assert same == (name == left_out), name


def test_columns_are_all_of_the_geometry() -> None:
    assert geometry_columns(DEFAULT_INPUTS) == list(range(GEOMETRY_WIDTH))
    assert geometry_columns(PAPER_INPUTS) == [0, 1, 2, 11, 12, 13, 14, 15]
    assert geometry_columns(["label"]) == []
