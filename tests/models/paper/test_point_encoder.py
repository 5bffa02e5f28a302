from dataclasses import replace

import numpy as np
import pytest
import torch

from models.citymap.point_sample import POINTS_PER_PART, sample_points
from models.errors import WeightsError
from models.paper import instance_encoder, level_table, retriever
from models.paper.instance_encoder import DEFAULT_INPUTS, CellFeatures
from models.paper.level_table import LevelTable, encode_gallery
from models.paper.mncl import Mncl, MnclConfig
from models.paper.point_encoder import POINT_WIDTH, PointEncoder, farthest_points, nearest_in_ball


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
    assert not replace(few, sample=lambda cells: few.sample(cells) * 2).with_point_features(encoder).point_features.size
    monkeypatch.setattr(CellFeatures, "_encode_points", encode_points)
    for path in (tmp_path / "points").iterdir():
        path.write_bytes(b"junk")
    assert np.array_equal(few.with_point_features(encoder).point_features, expected), "a broken file is made anew"
    (tmp_path / "file").write_bytes(b"")
    monkeypatch.setenv("HEREABOUTS_CACHE_DIR", str(tmp_path / "file"))
    assert np.array_equal(few.with_point_features(encoder).point_features, expected), "without a place to keep it too"
