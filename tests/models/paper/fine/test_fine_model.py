import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from safetensors.torch import load_file, save_file

from models.checkpoint import MAX_UNROUNDED_VALUES
from models.errors import WeightsError
from models.paper.fine.checkpoint import FINE_METHODS, load_fine, save_fine
from models.paper.fine.fine_model import CrossAttentionRound, FineTargets, nearest_instances
from models.paper.fine.matching import MatchingConfig, sinkhorn
from models.paper.fine.regressor import (
    MIN_STANDARD_DEVIATION,
    Regressor,
    RegressorConfig,
    cholesky_factor,
    gaussian_loss,
)
from models.paper.instance_encoder import DEFAULT_INPUTS, geometry_columns
from models.training.fine_data import FineBatch

TEXTS = [
    ["I am north of a gray building."],
    ["A black pole is to my west.", "I stand on the road.", "There is a tree north of me."],
    [f"There is a bench number {i} to my east." for i in range(12)],
]
ROWS = np.array([[0, 5], [5, 9], [3, 0]])


def attend(layer, queries, keys):
    """Multi-head attention of one set to another, head by head and query by query."""
    width, heads = layer.embed_dim, layer.num_heads
    q, k, v = (
        part @ layer.in_proj_weight[n * width : (n + 1) * width].T + layer.in_proj_bias[n * width : (n + 1) * width]
        for n, part in enumerate((queries, keys, keys))
    )
    size = width // heads
    rows = []
    for query in q:
        parts = []
        for h in range(heads):
            of_head = slice(h * size, (h + 1) * size)
            weights = torch.stack([query[of_head] @ key[of_head] / size**0.5 for key in k]).softmax(dim=0)
            parts.append(sum(weight * value[of_head] for weight, value in zip(weights, v, strict=True)))
        rows.append(layer.out_proj(torch.cat(parts)))
    return torch.stack(rows)


def look_naively(layer, own, other):
    """A decoder layer on one unpadded set."""
    own = own + attend(layer.self_attn, layer.norm1(own), layer.norm1(own))
    own = own + attend(layer.multihead_attn, layer.norm2(own), other)
    return own + layer.linear2(layer.linear1(layer.norm3(own)).relu())


def test_cross_attention_against_a_naive_loop() -> None:
    torch.manual_seed(1)
    layer = CrossAttentionRound(16, 4, 0.1).eval()
    hints, instances = torch.randn(2, 3, 16), torch.randn(2, 5, 16)
    hint_mask = torch.tensor([[True, True, False], [True, True, True]])
    instance_mask = torch.tensor([[True] * 5, [True, True, False, False, False]])
    met, updated = layer(hints, hint_mask, instances, instance_mask)
    for b in range(2):
        h, i = hints[b, hint_mask[b]], instances[b, instance_mask[b]]
        i = look_naively(layer.of_instances, i, h)
        h = look_naively(layer.of_hints, h, i)
        assert torch.allclose(met[b, hint_mask[b]], h, atol=1e-5)
        assert torch.allclose(updated[b, instance_mask[b]], i, atol=1e-5)


def test_the_nearest_instances_are_kept(features) -> None:
    batch = features.batch(np.arange(12))
    order = nearest_instances(batch, 6)
    for row, columns in enumerate(order):
        distance = batch.geometry[row, : int(batch.mask[row].sum()), 5]
        assert torch.equal(batch.geometry[row, columns, 5], distance.sort().values[:6])
    assert nearest_instances(batch, None).shape == batch.mask.shape


def test_a_description_alone_and_in_a_batch(fine_model, features) -> None:
    together = fine_model.predict(TEXTS, features, ROWS)
    assert together.shape == (3, 2, 2)
    for q, text in enumerate(TEXTS):
        for j in range(2):
            alone = fine_model.predict([text], features, ROWS[q : q + 1, j : j + 1])
            assert np.abs(alone[0, 0] - together[q, j]).max() < 1e-5
    assert len(np.unique(together[..., 0])) > 1 or fine_model.method == "matching"


def test_padding_and_masked_instances_change_nothing(fine_model, features) -> None:
    labels = fine_model.text_encoder.embed(features.labels)
    hints, mask = torch.randn(1, 3, 32), torch.ones(1, 3, dtype=torch.bool)
    padded, longer = torch.cat([hints, torch.full((1, 4, 32), 1e3)], dim=1), torch.arange(7)[None] < 3
    alone, in_batch = (
        features.batch(np.array([4])),
        features.batch(np.array([4, int(np.diff(features.starts).argmax())])),
    )
    in_batch.geometry[0, int(in_batch.mask[0].sum()) :] = 1e3
    with torch.inference_mode():
        first = fine_model.locate(hints, mask, fine_model.embed_instances(alone, labels))
        encoded = fine_model.embed_instances(in_batch, labels).take(torch.tensor([0]))
        assert torch.allclose(fine_model.locate(padded, longer, encoded), first, atol=1e-5)


def test_order_does_not_matter(fine_model, features) -> None:
    backwards = [text[::-1] for text in TEXTS]
    before = fine_model.predict(TEXTS, features, ROWS)
    assert np.array_equal(before, fine_model.predict(backwards, features, ROWS))
    labels = fine_model.text_encoder.embed(features.labels)
    cells = features.batch(np.array([2, 8]))
    hints, mask = torch.randn(2, 5, 32), torch.ones(2, 5, dtype=torch.bool)
    with torch.inference_mode():
        encoded = fine_model.embed_instances(cells, labels)
        mixed = fine_model.locate(hints[:, [3, 1, 0, 4, 2]], mask, encoded)
        assert torch.allclose(fine_model.locate(hints, mask, encoded), mixed, atol=1e-5)


def test_no_cell_is_the_middle(fine_model, features) -> None:
    offsets = fine_model.predict(TEXTS[:1], features, np.array([[0, -1]]))
    assert offsets[0, 1].tolist() == [0.5, 0.5]
    assert ((offsets >= 0) & (offsets <= 1)).all()


def test_every_parameter_that_locates_gets_a_finite_gradient(fine_model, fine_set) -> None:
    batch: FineBatch = fine_set.batch(8, np.random.default_rng(0))
    fine_model.zero_grad()
    hints = torch.randn(*batch.sentences.shape, 32, requires_grad=True)
    instances = fine_model.embed_instances(batch.cells, fine_set.training.label_embeddings)
    fine_model.loss(hints, batch.hint_mask, instances, batch.targets).backward()
    gradients = {name: p.grad for name, p in fine_model.named_parameters() if not name.startswith("hint_encoder")}
    assert all(g is not None and torch.isfinite(g).all() for g in gradients.values())
    of_hints = hints.grad
    assert of_hints is not None
    assert (of_hints[~batch.hint_mask] == 0).all()
    assert (of_hints[batch.hint_mask].abs().sum(dim=-1) > 0).any()
    fine_model.zero_grad()


def test_sinkhorn_gives_every_real_row_and_column_its_share() -> None:
    torch.manual_seed(2)
    scores = torch.randn(2, 3, 4)
    rows, columns = (
        torch.tensor([[True, True, False], [True] * 3]),
        torch.tensor([[True] * 4, [True] * 2 + [False] * 2]),
    )
    share = sinkhorn(scores, rows, columns, torch.tensor(0.3), 100).exp()
    assert torch.allclose(share[:, :-1].sum(dim=2), rows.float(), atol=1e-4)
    assert torch.allclose(share[:, :, :-1].sum(dim=1), columns.float(), atol=1e-4)
    small = sinkhorn(scores[1:, :, :2], rows[1:], columns[1:, :2], torch.tensor(0.3), 100).exp()
    assert torch.allclose(share[1][:, [0, 1, 4]], small[0], atol=1e-5)


def test_matching_averages_over_the_matches(text_encoder, features, monkeypatch) -> None:
    model = FINE_METHODS["matching"](text_encoder, MatchingConfig(width=32)).eval()
    encoded = model.embed_instances(features.batch(np.array([3])), text_encoder.embed(features.labels))
    share = torch.full((1, 4, encoded.mask.shape[1] + 1), 1e-6)
    share[0, 0, 2], share[0, 1, 1], share[0, 2, 4] = 0.9, 0.8, 0.1  # the last is too unsure
    offset = torch.tensor([[[0.1, 0.0], [0.0, -0.2], [5.0, 5.0]]])
    monkeypatch.setattr(model, "match", lambda *_: (share.log(), offset))
    position = model.locate(torch.zeros(1, 3, 32), torch.ones(1, 3, dtype=torch.bool), encoded)
    assert torch.allclose(
        position[0], ((encoded.center[0, 2] + offset[0, 0]) + (encoded.center[0, 1] + offset[0, 1])) / 2
    )
    monkeypatch.setattr(model, "match", lambda *_: ((share * 0.1).log(), offset))
    assert model.locate(torch.zeros(1, 3, 32), torch.ones(1, 3, dtype=torch.bool), encoded).tolist() == [[0.5, 0.5]]


def test_the_instances_meant_survive_the_choice_of_the_nearest(fine_model, fine_set) -> None:
    batch = fine_set.batch(16, np.random.default_rng(3))
    encoded = fine_model.embed_instances(batch.cells, fine_set.training.label_embeddings)
    meant = encoded.match_mask(FineTargets(batch.targets.offset, batch.targets.match), batch.hint_mask)
    assert meant.any()
    for b, h, i in meant.nonzero().tolist():
        column = int(batch.targets.match[b, h])
        expected = batch.cells.geometry[b, column, :2] / 2 + 0.5
        assert torch.equal(encoded.center[b, i], expected)


@pytest.mark.parametrize("error", ["squared", "norm"])
def test_error_of_a_position_against_a_loop(text_encoder, fine_set, error) -> None:
    torch.manual_seed(0)
    model = Regressor(text_encoder, RegressorConfig(width=32, point=False, error=error)).eval()
    batch = fine_set.batch(5, np.random.default_rng(0))
    hints = torch.randn(*batch.sentences.shape, 32)
    with torch.no_grad():
        instances = model.embed_instances(batch.cells, fine_set.training.label_embeddings)
        position = model.locate(hints, batch.hint_mask, instances).tolist()
        loss = model.loss(hints, batch.hint_mask, instances, batch.targets).item()
    total = 0.0
    for (x, y), (true_x, true_y) in zip(position, batch.targets.offset.tolist(), strict=True):
        squares = (2 * x - 2 * true_x) ** 2 + (2 * y - 2 * true_y) ** 2
        total += math.sqrt(squares) if error == "norm" else squares / 2
    assert loss == pytest.approx(total / 5, rel=1e-5)


def test_a_norm_of_zero_has_a_gradient_of_zero(text_encoder, monkeypatch) -> None:
    model = Regressor(text_encoder, RegressorConfig(width=32, point=False, error="norm"))
    offset = torch.full((2, 2), 0.25, requires_grad=True)
    monkeypatch.setattr(model, "point_to_instances", lambda *_: (offset, None, None))
    model.loss(None, None, None, FineTargets(offset.detach(), None)).backward()
    assert (offset.grad == 0).all()


def test_gaussian_loss_against_a_loop(text_encoder, fine_set) -> None:
    torch.manual_seed(0)
    config = RegressorConfig(width=32, error="gaussian", match_weight=0)
    model = Regressor(text_encoder, config).eval()
    batch = fine_set.batch(5, np.random.default_rng(0))
    hints, outputs = torch.randn(*batch.sentences.shape, 32), []
    model.head.register_forward_hook(lambda *passed: outputs.append(passed[2].detach().double().numpy()))
    with torch.no_grad():
        instances = model.embed_instances(batch.cells, fine_set.training.label_embeddings)
        position = model.locate(hints, batch.hint_mask, instances)
        loss = model.loss(hints, batch.hint_mask, instances, batch.targets).item()
    assert outputs[0].shape == (5, 5)
    assert np.allclose(position, outputs[0][:, :2] / 2 + 0.5), "the mean"
    total = 0.0
    for numbers, true in zip(outputs[1], batch.targets.offset.double().numpy(), strict=True):
        first, second = (math.log(1 + math.exp(x)) + MIN_STANDARD_DEVIATION for x in numbers[2:4])
        lower = np.array([[first, 0], [numbers[4], second]])
        covariance, residual = lower @ lower.T, numbers[:2] - (2 * true - 1)  # half cells from the centre
        density = math.exp(-residual @ np.linalg.inv(covariance) @ residual / 2)
        total -= math.log(density / (2 * math.pi * math.sqrt(np.linalg.det(covariance))))
    assert loss == pytest.approx(total / 5, rel=1e-4)


def test_gaussian_loss_is_least_at_the_covariance_of_the_residuals() -> None:
    residual = torch.randn(500, 2, dtype=torch.float64, generator=torch.Generator().manual_seed(0))
    residual = residual @ torch.tensor([[0.5, 0.2], [0.0, 0.1]], dtype=torch.float64)
    best = torch.linalg.cholesky(residual.T @ residual / 500)
    least = gaussian_loss(residual, best.expand(500, 2, 2))
    for row, column in ((0, 0), (1, 0), (1, 1)):
        for change in (-0.01, 0.01):
            other = best.clone()
            other[row, column] += change
            assert gaussian_loss(residual, other.expand(500, 2, 2)) > least


def test_a_certain_and_wrong_gaussian_has_finite_gradients() -> None:
    output = torch.full((1, 3), -100.0, requires_grad=True)
    factor = cholesky_factor(output)
    assert factor.diagonal(dim1=1, dim2=2).min() >= MIN_STANDARD_DEVIATION
    gaussian_loss(torch.ones(1, 2), factor).backward()
    assert torch.isfinite(output.grad).all()


def test_saved_and_loaded_is_the_same(fine_model, features, tmp_path) -> None:
    save_fine(fine_model, tmp_path, {"note": "x"})
    again = load_fine(tmp_path)
    assert (again.fingerprint, again.config) == (fine_model.fingerprint, fine_model.config)
    assert np.array_equal(again.predict(TEXTS, features, ROWS), fine_model.predict(TEXTS, features, ROWS))


def test_weights_are_saved_to_half_a_step_of_their_row(fine_model, tmp_path) -> None:
    torch.manual_seed(1)
    model = type(fine_model)(fine_model.text_encoder, fine_model.config)
    given = {name: torch.randn_like(t) if t.is_floating_point() else t for name, t in model.state_dict().items()}
    given["hint_encoder.project.weight"][3] = 0.0
    model.load_state_dict(given)
    save_fine(model, tmp_path, {})
    loaded = load_fine(tmp_path).state_dict()
    for name, tensor in given.items():
        if tensor.dim() > 1 and tensor.numel() > MAX_UNROUNDED_VALUES:
            step = tensor.abs().amax(dim=1, keepdim=True) / 127
            assert ((loaded[name] - tensor).abs() <= 0.57 * step).all(), (
                "a half, and what a step in half precision is off"
            )
        else:
            assert torch.allclose(loaded[name], tensor, rtol=1e-3, atol=1e-6)
    stored = load_file(tmp_path / "model.safetensors")["hint_encoder.project.weight"]
    assert stored.dtype == torch.int8


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda d: (d / "config.json").unlink(), "config.json is missing"),
        (lambda d: (d / "model.safetensors").write_bytes(b"junk"), "cannot be read"),
        (lambda d: (d / "config.json").write_text("[]"), "cannot be read"),
        (lambda d: (d / "config.json").write_text('{"method": "guess", "fine": {}}'), "cannot be read"),
        (
            lambda d: (d / "config.json").write_text('{"method": "regressor", "fine": {"width": 64}}'),
            "do not match its config.json",
        ),
        (lambda d: (d / "config.json").write_text('{"method": "regressor", "fine": {"depth": 2}}'), "cannot be read"),
        (
            lambda d: leave_out(d / "model.safetensors", "hint_encoder.project.weight.scale"),
            "do not match its config.json",
        ),
    ],
)
def test_broken_weights_are_refused(fine_model, tmp_path, spoil, message) -> None:
    save_fine(fine_model, tmp_path, {})
    spoil(tmp_path)
    with pytest.raises(WeightsError, match=message):
        load_fine(tmp_path)


def leave_out(weights: Path, name: str) -> None:
    tensors = load_file(weights)
    del tensors[name]
    save_file(tensors, weights)


@pytest.mark.parametrize("method", FINE_METHODS)
def test_inputs_that_are_left_out_change_no_position(features, text_encoder, method) -> None:
    torch.manual_seed(0)
    inputs = ("position", "count", "colour")
    sure = {"threshold": 0.0} if method == "matching" else {}
    model = FINE_METHODS[method](text_encoder, FINE_METHODS[method].config_type(width=32, inputs=inputs, **sure)).eval()
    before = model.predict(TEXTS, features, ROWS)
    for name in DEFAULT_INPUTS:
        geometry, label = features.geometry.copy(), features.label
        if name == "label":
            label = (label + 1) % len(features.labels)
        geometry[:, geometry_columns([name])] += 0.5
        offsets = model.predict(TEXTS, replace(features, geometry=geometry, label=label), ROWS)
        assert np.array_equal(offsets, before) == (name not in inputs), name
