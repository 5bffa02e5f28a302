from dataclasses import replace

import pytest

from index.build.estimate import estimate_cost
from models.citymap.summary import MapSummary

HELSINKI = MapSummary(
    bbox=(24.9352, 60.1642, 24.9534, 60.1791), width_km=1.01, height_km=1.67, walkable_km=94.6,
    objects=8598, streets=93, named_objects=1868, house_numbers=1445,
    kinds={}, scripts={}, languages={}, extras={}, cut={}, dropped={}, repaired={},
)  # fmt: skip


def test_the_shipped_map_takes_about_what_is_estimated() -> None:
    cost = estimate_cost(HELSINKI)
    assert cost.cpu_s == pytest.approx(31, rel=0.25)
    assert cost.bytes == pytest.approx(24e6, rel=0.33)


def test_an_estimate_grows_with_paths_and_names() -> None:
    cost = estimate_cost(HELSINKI)
    for change in ({"walkable_km": 200.0}, {"streets": 500}, {"named_objects": 4000}):
        larger = estimate_cost(replace(HELSINKI, **change))
        assert larger.cpu_s > cost.cpu_s
        assert larger.bytes > cost.bytes
