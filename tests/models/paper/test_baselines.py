"""Behaviour of every retriever: invariance to padding and order, training of all weights, saving and loading."""

from dataclasses import replace

import numpy as np
import pytest
import torch

from models.language.text_encoder import TokenFeatures
from models.paper.checkpoint import METHODS, load_retriever, save_retriever
from models.paper.instance_encoder import CellFeatures
from tests.encoding import encode_descriptions

WIDTH = 32
TEXTS = [
    ["I am north of a gray building."],
    ["A black pole is to my west.", "I stand on the road.", "There is a tree north of me."],
    [f"There is a bench number {i} to my east." for i in range(12)],
]


@pytest.fixture(scope="module")
def features(city, cells):
    return CellFeatures.from_cells(cells, np.array([i.label for i in city.instances]))


@pytest.fixture(scope="module")
def labels(text_encoder, features):
    return text_encoder.embed(features.labels).clone()  # out of inference mode


@pytest.fixture(params=sorted(METHODS))
def retriever(request, text_encoder):
    torch.manual_seed(0)
    method = METHODS[request.param]
    return method(text_encoder, method.config_type(width=WIDTH)).eval()


def test_a_method_is_registered_under_its_name() -> None:
    assert all(name == method.method for name, method in METHODS.items())


def test_a_sentence_alone_and_in_a_batch(retriever) -> None:
    sentences = [sentence for text in TEXTS for sentence in text]
    sentences.append("On my far left, past the second row of young trees, stands a dark green bench with a metal back.")
    with torch.inference_mode():
        together = retriever.embed_hints(retriever.text_encoder(sentences))
        for row, sentence in enumerate(sentences):
            alone = retriever.embed_hints(retriever.text_encoder([sentence]))[0]
            assert torch.allclose(together[row], alone, atol=1e-5)


def test_a_description_alone_and_in_a_batch(retriever) -> None:
    hints, mask = torch.randn(4, 6, WIDTH), torch.arange(6) < torch.tensor([[6], [1], [3], [5]])
    hints[~mask] = 1e3
    together = retriever.embed_texts(hints, mask).global_vectors
    assert together.norm(dim=-1).tolist() == pytest.approx([1] * 4)
    for row, real in enumerate(mask):
        alone = retriever.embed_texts(hints[row, real][None], real[real][None]).global_vectors[0]
        assert torch.allclose(together[row], alone, atol=1e-5)


def test_a_cell_alone_and_in_a_batch(retriever, features, labels) -> None:
    sizes = np.diff(features.starts)
    rows = np.array([sizes.argmin(), 3, sizes.argmax(), 11])
    with torch.inference_mode():
        together = retriever.embed_cells(features.batch(rows), labels).global_vectors
        assert together.norm(dim=-1).tolist() == pytest.approx([1] * 4)
        for row, expected_vector in zip(rows, together, strict=True):
            assert torch.allclose(
                retriever.embed_cells(features.batch(np.array([row])), labels).global_vectors[0],
                expected_vector,
                atol=1e-5,
            )


def test_order_of_hints_does_not_matter(retriever) -> None:
    assert np.array_equal(encode_descriptions(retriever, [TEXTS[2]]), encode_descriptions(retriever, [TEXTS[2][::-1]]))
    hints, mask = torch.randn(2, 5, WIDTH), torch.ones(2, 5, dtype=torch.bool)
    before, after = retriever.embed_texts(hints, mask), retriever.embed_texts(hints[:, [3, 1, 0, 4, 2]], mask)
    assert torch.allclose(before.global_vectors, after.global_vectors, atol=1e-5)


def test_order_of_instances_does_not_matter(retriever, features, labels) -> None:
    batch = features.batch(np.array([7]))
    order = torch.randperm(batch.mask.shape[1])
    shuffled = replace(batch, geometry=batch.geometry[:, order], label=batch.label[:, order], mask=batch.mask[:, order])
    with torch.inference_mode():
        difference = (
            retriever.embed_cells(batch, labels).global_vectors - retriever.embed_cells(shuffled, labels).global_vectors
        )
    assert difference.abs().max() < 1e-5


def test_saved_and_loaded_is_the_same(retriever, tmp_path) -> None:
    save_retriever(retriever, tmp_path, {})
    again = load_retriever(tmp_path)
    assert type(again) is type(retriever)
    assert again.fingerprint == retriever.fingerprint
    assert np.array_equal(encode_descriptions(again, TEXTS), encode_descriptions(retriever, TEXTS))


@pytest.fixture(scope="module")
def examples(features, text_encoder):
    """Eight cells, and the tokens of three hints of each."""
    rows = np.arange(0, len(features), len(features) // 8)[:8]
    tokens = text_encoder([hint for row in rows for hint in described(features, row)])
    # Copies are made out of inference mode, so they can be trained on.
    return features.batch(rows), TokenFeatures(tokens.values.clone(), tokens.mask.clone(), tokens.ids.clone())


def loss_and_recall(retriever, examples, labels):
    batch, tokens = examples
    own, mask = torch.arange(8), torch.ones(8, 3, dtype=torch.bool)
    text, cells = (
        retriever.embed_texts(retriever.embed_hints(tokens).view(8, 3, WIDTH), mask),
        retriever.embed_cells(batch, labels),
    )
    first = (text.global_vectors @ cells.global_vectors.T).argmax(dim=1)
    return retriever.loss(text, cells, own[:, None] == own), (first == own).float().mean().item()


def test_gradients_reach_every_parameter(retriever, examples, labels) -> None:
    loss_and_recall(retriever.train(), examples, labels)[0].backward()
    assert [name for name, p in retriever.named_parameters() if p.grad is None or not p.grad.any()] == []


@pytest.mark.parametrize("retriever", ["ret", "text2loc", "text2pos"], indirect=True)
def test_a_small_batch_is_learned(retriever, examples, labels) -> None:
    optimizer = torch.optim.Adam(retriever.train().parameters(), 3e-3)
    for _ in range(30):
        optimizer.zero_grad()
        loss_and_recall(retriever, examples, labels)[0].backward()
        optimizer.step()
    with torch.no_grad():
        assert loss_and_recall(retriever, examples, labels)[1] >= 0.5  # chance is 1/8


def described(features, row):
    """Three hints of a cell's first instances: what is where."""
    hints = []
    for instance in range(features.starts[row], features.starts[row] + 3):
        east, north = features.geometry[instance, 3:5]
        along = ("east" if east > 0 else "west") if abs(east) > abs(north) else ("north" if north > 0 else "south")
        hints.append(f"A {features.labels[features.label[instance]]} is to my {along}.")
    return hints
