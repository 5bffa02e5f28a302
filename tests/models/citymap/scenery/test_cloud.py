import numpy as np

from models.citymap.scenery import cloud
from models.citymap.scenery.cloud import encode_cloud


def test_every_part_shows_all_of_the_map(monkeypatch) -> None:
    monkeypatch.setattr(cloud, "POINTS_PER_PART", 400)
    rng = np.random.default_rng(0)
    xyz, rgb = rng.uniform(-500, 500, (1000, 3)), rng.integers(0, 256, (1000, 3)).astype(np.uint8)
    parts = [part.tensors for part in encode_cloud(xyz, rgb)]
    assert [len(part["steps"]) for part in parts] == [400, 400, 200]
    result = np.concatenate([part["steps"].cumsum(axis=0) for part in parts])
    wanted = {(*row, *colour) for row, colour in zip(np.rint(xyz * 10).astype(int).tolist(), rgb.tolist(), strict=True)}
    colours = np.concatenate([part["rgb"] for part in parts])
    assert {(*a, *b) for a, b in zip(result.tolist(), colours.tolist(), strict=True)} == wanted
    for part in parts:
        positions_m = part["steps"].cumsum(axis=0) / 10
        assert (positions_m[:, :2].min(axis=0) < -450).all()
        assert (positions_m[:, :2].max(axis=0) > 450).all()


def test_no_points_are_one_empty_part() -> None:
    (part,) = encode_cloud(np.zeros((0, 3)), np.zeros((0, 3), np.uint8))
    assert part.tensors["steps"].shape == (0, 3)
