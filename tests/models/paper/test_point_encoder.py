from dataclasses import replace

import numpy as np
import pytest
import torch

from models.citymap.map_geometry import ScanGeometry, cut_cells
from models.citymap.point_sample import POINTS_PER_PART, PointSampling, sample_points
from models.citymap.points import PointTable
from models.errors import WeightsError
from models.paper import instance_encoder, level_table, retriever
from models.paper.instance_encoder import DEFAULT_INPUTS, PAPER_INPUTS, CellFeatures, InstanceEncoder
from models.paper.level_table import LevelTable, encode_gallery
from models.paper.mncl import Mncl, MnclConfig
from models.paper.point_encoder import (
    INSTANCES_PER_CHECKPOINT,
    POINT_WIDTH,
    PointEncoder,
    SetAbstraction,
    farthest_points,
    nearest_in_ball,
)
from models.paper.relation_attention import NUM_HEADS


@pytest.fixture(scope="module")
def clouds():
    return torch.randn(3, POINTS_PER_PART, 6, generator=torch.Generator().manual_seed(0)) / 3


@pytest.fixture(scope="module")
def features(city, cells):
    return CellFeatures.from_cells(cells, np.array([i.label for i in city.instances]))


def test_farthest_points_are_those_of_a_naive_loop(clouds) -> None:
    xyz = clouds[..., :3]
    for cloud, chosen_rows in zip(xyz, farthest_points(xyz, 12), strict=True):
        chosen = [0]
        while len(chosen) < 12:
            chosen.append(int(torch.cdist(cloud, cloud[chosen]).min(dim=1).values.argmax()))
        assert chosen_rows.tolist() == chosen


def test_a_ball_holds_the_nearest_within_its_radius(clouds) -> None:
    xyz, centers = clouds[..., :3], clouds[:, :5, :3]
    near = nearest_in_ball(xyz, centers, 0.25, 8)
    for r in range(3):
        for m in range(5):
            distance = (xyz[r] - centers[r, m]).norm(dim=1)
            inside = sorted((distance <= 0.25).nonzero().flatten().tolist(), key=lambda p, d=distance: float(d[p]))[:8]
            assert set(near[r, m].tolist()) == set(inside), "the centre itself is always in it"


def test_a_set_abstraction_agrees_with_loops() -> None:
    torch.manual_seed(0)
    level = SetAbstraction(2, 4, 0.4, 3, (5, 6))
    xyz, features = torch.rand(2, 12, 3), torch.rand(2, 12, 2)
    with torch.inference_mode():
        centers, pooled = level(xyz, features)
    state = {name: tensor.numpy().astype(float) for name, tensor in level.layers.state_dict().items()}
    for r in range(2):
        points, columns, chosen = xyz[r].numpy().astype(float), features[r].numpy(), [0]
        while len(chosen) < 4:
            chosen.append(int(np.argmax([min(np.sum((p - points[c]) ** 2) for c in chosen) for p in points])))
        for m, center in enumerate(points[chosen]):
            assert np.allclose(centers[r, m], center)
            metres = [float(np.sqrt(np.sum((p - center) ** 2))) for p in points]
            inside = sorted((p for p in range(12) if metres[p] <= 0.4), key=metres.__getitem__)[:3]
            best = np.full(6, -np.inf)
            for p in inside:
                x = np.concatenate([points[p] - center, columns[p]])
                for n in (0, 3):  # linear, layer norm, ReLU
                    x = state[f"{n}.weight"] @ x + state[f"{n}.bias"]
                    x = (x - x.mean()) / np.sqrt(x.var() + 1e-5)
                    x = np.maximum(0, x * state[f"{n + 1}.weight"] + state[f"{n + 1}.bias"])
                best = np.maximum(best, x)
            assert np.allclose(pooled[r, m], best, atol=1e-5)


def test_the_official_encoder_has_the_size_of_the_released_one() -> None:
    counts = {kind: sum(p.numel() for p in PointEncoder(kind).parameters()) for kind in ("small", "official")}
    widths = [(6, 32), (32, 64), (67, 128), (128, 128), (131, 256), (256, 256), (259, 512), (512, 1024)]
    normed = sum(a * b + 3 * b for a, b in widths)  # with a norm's scale and shift
    assert counts == {"small": 66_272, "official": normed + 1025 * 512 + 513 * 256}
    assert counts["official"] == 1_446_496


def test_features_do_not_depend_on_the_batch_of_the_official_encoder(clouds) -> None:
    torch.manual_seed(0)
    encoder, many = PointEncoder("official"), clouds.repeat(INSTANCES_PER_CHECKPOINT // 3 + 1, 1, 1)
    encoded = encoder(many)
    assert encoded.shape == (len(many), POINT_WIDTH)
    for n in (0, 1, 2, len(many) - 1):
        assert torch.allclose(encoded[n], encoder(many[n : n + 1])[0], atol=1e-5)
    encoded[-1].sum().backward()
    by_checkpoint = {name: p.grad.clone() for name, p in encoder.named_parameters()}
    encoder.zero_grad()
    encoder._encode(many[-1:]).sum().backward()
    assert all(torch.allclose(by_checkpoint[name], p.grad, atol=1e-4) for name, p in encoder.named_parameters())
    with torch.inference_mode():
        assert encoder(clouds[:0]).shape == (0, POINT_WIDTH)
        assert not torch.allclose(encoder(clouds), encoder(clouds + torch.tensor([0.3, 0, 0, 0, 0, 0])), atol=1e-3)


@pytest.mark.parametrize("kind", ["lines", "scan"])
def test_points_in_the_frame_of_the_cell_keep_size_and_place(kind, cells, scan) -> None:
    if kind == "scan":
        geometry = ScanGeometry(PointTable.from_map(scan, scan.rules.eps_m), scan.rules)
        cells = cut_cells(scan, geometry)
    rows = np.array([5, 0, 5])
    sampled, taken = cells.sample(rows, PointSampling("cell")), cells.take(rows)
    parts, again = taken.parts, taken.sample(np.arange(3), PointSampling("cell"))
    assert np.array_equal(sampled, again)
    xyz_m = sampled[..., :3] * cells.size_m + cells.center_m[rows][parts.cube][:, None]
    whole = parts.count <= POINTS_PER_PART  # all of their points are in the sample
    slack_m = 0.01 if kind == "scan" else 0.51  # points of a line lie apart
    assert (xyz_m.min(axis=1) >= parts.low_m - slack_m)[:, :2].all()
    assert (xyz_m.max(axis=1) <= parts.high_m + slack_m)[:, :2].all()
    assert np.allclose(xyz_m[whole].min(axis=1)[:, :2], parts.low_m[whole, :2], atol=slack_m)
    assert np.array_equal(sampled[..., 3:], cells.sample(rows)[..., 3:]), "the same points"


def test_a_fresh_sample_has_points_of_the_part_and_is_seeded() -> None:
    rng = np.random.default_rng(0)
    xyz, rgb = rng.normal(size=(400, 3)), rng.random((400, 3))
    drawn = [sample_points(xyz, rgb, PointSampling("cell", np.random.default_rng(s)), 0.5, 2.0) for s in (1, 1, 2)]
    assert np.array_equal(drawn[0], drawn[1])
    assert not np.array_equal(drawn[0], drawn[2])
    rows = [int(np.argmin(((rgb - colour) ** 2).sum(axis=1))) for colour in drawn[0][:, 3:]]
    assert np.allclose(drawn[0][:, :3], (xyz[rows] - 0.5) / 2.0, atol=1e-6)
    assert len(set(rows)) > 150, "all of them are drawn from"
    assert np.array_equal(sample_points(xyz, rgb), sample_points(xyz, rgb, PointSampling("part")))


def test_relations_of_point_features_agree_with_loops(features) -> None:
    torch.manual_seed(0)
    encoder = InstanceEncoder(8, 16, PAPER_INPUTS, relations=True).eval()
    batch = features.batch(np.array([0, 3, 7]))
    mask, geometry = batch.mask, batch.geometry[batch.mask]
    shape = torch.randn(len(geometry), 16)
    with torch.inference_mode():
        related = encoder._relate(shape, geometry, mask).numpy()
        project, merge = encoder.attention.project, encoder.attention.merge
        linear = encoder.relation.linear.weight.numpy()
    start = 0
    for size in mask.sum(dim=1).tolist():
        x, centers = shape[start : start + size], geometry[start : start + size, :3].numpy()
        query, key, value = project(x).detach().numpy().reshape(size, 3, NUM_HEADS, 4).transpose(1, 2, 0, 3)
        for i in range(size):
            heads = []
            for head in range(NUM_HEADS):
                logits = np.array([query[head, i] @ key[head, j] / 2.0 for j in range(size)])
                weights = np.exp(logits) / np.exp(logits).sum()
                pooled = [
                    np.max([linear @ (centers[j] - centers[k]) for k in range(size)], axis=0)[4 * head : 4 * head + 4]
                    for j in range(size)
                ]
                heads.append(sum(weights[j] * (value[head, j] + pooled[j]) for j in range(size)))
            expected = merge.weight.detach().numpy() @ np.concatenate(heads) + merge.bias.detach().numpy()
            assert np.allclose(related[start + i], expected, atol=1e-4)
        start += size


@pytest.mark.parametrize("relations", [False, True])
def test_a_cell_with_points_has_one_vector_alone_or_in_a_batch(features, text_encoder, relations) -> None:
    torch.manual_seed(0)
    options = {"point_encoder": "official", "points_frozen": False, "point_relations": relations}
    model = Mncl(text_encoder, MnclConfig(width=32, inputs=PAPER_INPUTS, **options)).eval()
    few = first_cells(features, 3)
    labels = text_encoder.embed(few.labels)
    with torch.inference_mode():
        batches = [few.batch(np.array(rows), PointSampling("cell")) for rows in ([0, 1, 2], [1])]
        together, alone = (model.embed_cells(model.encode_points(batch), labels) for batch in batches)
        cached = encode_gallery(model, model.with_point_features(few))[0]
    assert torch.allclose(together.global_vectors[1], alone.global_vectors[0], atol=1e-5)
    size = int(alone.mask.sum())
    assert together.relation is not None
    assert alone.relation is not None
    assert torch.allclose(together.relation[1, :size], alone.relation[0, :size], atol=1e-5)
    assert np.allclose(cached, together.global_vectors, atol=1e-5), "those of an index"


def test_features_do_not_depend_on_the_order_of_the_points(clouds) -> None:
    torch.manual_seed(0)
    encoder = PointEncoder()
    order = torch.cat([torch.zeros(1, dtype=torch.long), 1 + torch.randperm(POINTS_PER_PART - 1)])
    with torch.inference_mode():
        encoded, again = encoder(clouds), encoder(clouds[:, order])
    assert encoded.shape == (3, POINT_WIDTH)
    assert torch.allclose(encoded, again, atol=1e-6)
    assert not torch.allclose(encoded[0], encoded[1], atol=1e-3), "another cloud, another feature"


def test_every_parameter_learns(clouds) -> None:
    encoder = PointEncoder()
    encoder(clouds).sum().backward()
    assert all(p.grad is not None and p.grad.abs().sum() > 0 for p in encoder.parameters())


def test_a_sample_is_a_shape_whatever_the_unit() -> None:
    rng = np.random.default_rng(0)
    xyz, rgb = rng.normal(size=(40, 3)), np.full((40, 3), np.nan)
    sampled = sample_points(xyz, rgb)
    assert sampled.shape == (POINTS_PER_PART, 6)
    assert np.linalg.norm(sampled[:, :3], axis=1).max() == pytest.approx(1, abs=1e-6)
    assert (sampled[:, 3:] == -1).all()
    assert np.allclose(sampled, sample_points(xyz * 30 + 100, rgb), atol=1e-5)
    assert np.isfinite(sample_points(xyz[:1], rgb[:1])).all(), "a single point"


def test_samples_belong_to_their_parts(city, cells) -> None:
    chosen = np.array([5, 0])
    part = cells.take(chosen)
    sampled_part = part.sample(np.array([1, 0]))
    assert np.array_equal(sampled_part, cells.sample(np.array([0, 5])))
    parts = cells.take(chosen[::-1]).parts
    assert len(sampled_part) == len(parts.count)
    extent = sampled_part[..., :3].max(axis=1) - sampled_part[..., :3].min(axis=1)
    size = parts.high_m - parts.low_m
    whole = parts.count <= POINTS_PER_PART  # all of their points are in the sample
    assert whole.any()
    known = ~np.isnan(parts.rgb).any(axis=1)
    assert ((sampled_part[..., 3:] >= 0).all(axis=(1, 2)) == known).all()
    ratio = extent[whole].max(axis=1) / size[whole].max(axis=1)
    assert np.allclose(extent[whole], size[whole] * ratio[:, None], atol=0.05), "boxes are the geometry's"


def first_cells(features: CellFeatures, count: int) -> CellFeatures:
    end = features.starts[count]
    parts = {name: getattr(features, name)[:end] for name in ("geometry", "label", "point_features")}
    return replace(features, starts=features.starts[: count + 1], **parts)


def test_a_retriever_with_points_looks_at_them(features, text_encoder) -> None:
    torch.manual_seed(0)
    features = first_cells(features, 80)  # more than one batch of the point encoder
    model = Mncl(text_encoder, MnclConfig(width=32, levels=("global",), inputs=(*DEFAULT_INPUTS, "points"))).eval()
    with_points = model.with_point_features(features)
    assert with_points.point_features.shape == (len(features.label), POINT_WIDTH)
    vectors = encode_gallery(model, with_points)[0]
    flat = encode_gallery(model, replace(with_points, point_features=np.zeros_like(with_points.point_features)))[0]
    assert np.abs(vectors - flat).max() > 1e-3
    first = with_points.batch(np.arange(3))
    assert torch.equal(
        first.point_features[first.mask], torch.from_numpy(with_points.point_features[: int(first.mask.sum())])
    )


def test_a_slice_that_begins_at_a_block_gives_the_bits_of_the_whole(
    city, cells, text_encoder, monkeypatch, tmp_path
) -> None:
    for module in (instance_encoder, level_table, retriever):
        monkeypatch.setattr(module, "CELLS_PER_BLOCK", 16)
    monkeypatch.setenv("HEREABOUTS_CACHE_DIR", str(tmp_path))
    torch.manual_seed(0)
    cells, labels = cells.take(np.arange(90)), np.array([i.label for i in city.instances])
    model = Mncl(text_encoder, MnclConfig(width=32, inputs=(*DEFAULT_INPUTS, "points"))).eval()
    vectors, table = encode_gallery(model, model.with_point_features(CellFeatures.from_cells(cells, labels)))
    slices = (CellFeatures.from_cells(cells, labels, range(*ends)) for ends in ((0, 48), (48, 48), (48, 90)))
    parts = [encode_gallery(model, model.with_point_features(cells_slice)) for cells_slice in slices]
    assert np.array_equal(np.concatenate([part[0] for part in parts]), vectors)
    joined = LevelTable.concatenate([part[1] for part in parts])
    assert np.array_equal(joined.starts, table.starts)
    assert all(np.array_equal(joined.vectors[level], table.vectors[level]) for level in ("instance", "relation"))


def test_without_points_the_message_says_what_to_do(features, text_encoder) -> None:
    model = Mncl(text_encoder, MnclConfig(width=32, levels=("global",), inputs=(*DEFAULT_INPUTS, "points")))
    with pytest.raises(WeightsError, match="inputs"):
        model.with_point_features(replace(features, sample=None))


def test_what_is_made_of_points_is_kept_and_found_again(features, monkeypatch, tmp_path) -> None:
    monkeypatch.setenv("HEREABOUTS_CACHE_DIR", str(tmp_path))
    few = first_cells(features, 4)
    encoder, encode_points = PointEncoder().eval(), CellFeatures._encode_points
    expected = few.with_point_features(encoder).point_features
    monkeypatch.setattr(CellFeatures, "_encode_points", None)
    assert np.array_equal(few.with_point_features(encoder).point_features, expected), "read, not computed"
    monkeypatch.setattr(CellFeatures, "_encode_points", lambda *_: np.zeros((0, 0)))
    assert not few.with_point_features(PointEncoder().eval()).point_features.size, (
        "another encoder makes something else of them"
    )
    assert not replace(few, geometry=few.geometry + 1).with_point_features(encoder).point_features.size
    assert not replace(few, sample=lambda *how: few.sample(*how) * 2).with_point_features(encoder).point_features.size
    monkeypatch.setattr(CellFeatures, "_encode_points", encode_points)
    for path in (tmp_path / "points").iterdir():
        path.write_bytes(b"junk")
    assert np.array_equal(few.with_point_features(encoder).point_features, expected), "a broken file is made anew"
    (tmp_path / "file").write_bytes(b"")
    monkeypatch.setenv("HEREABOUTS_CACHE_DIR", str(tmp_path / "file"))
    assert np.array_equal(few.with_point_features(encoder).point_features, expected), "without a place to keep it too"
