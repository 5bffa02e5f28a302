import numpy as np
import pytest

from models.citymap.frame import Frame


@pytest.mark.parametrize(
    "frame", [Frame(origin_lat=60.17, origin_lon=24.94), Frame(origin_lat=60.17, origin_lon=24.94, epsg=32635)]
)
def test_there_and_back(frame) -> None:
    position = np.array([[0.0, 0.0], [420.0, -650.0], [-1500.0, 900.0]])
    lat, lon = frame.to_wgs84(position)
    assert lat[0] == pytest.approx(60.17, abs=1e-9)
    assert frame.from_wgs84(lat, lon) == pytest.approx(position, abs=1e-3)


def test_axes_are_east_and_north_in_metres() -> None:
    frame = Frame(origin_lat=60.0, origin_lon=25.0)
    assert frame.from_wgs84(60.001, 25.0) == pytest.approx([0, 111.41], abs=0.1)
    assert frame.from_wgs84(60.0, 25.001) == pytest.approx([55.8, 0], abs=0.1)


def test_a_map_without_georeference_says_so() -> None:
    assert not Frame().is_georeferenced
    with pytest.raises(ValueError, match="no georeference"):
        Frame().to_wgs84(np.zeros(2))


def test_a_wgs84_position_is_longitude_then_latitude() -> None:
    frame = Frame(origin_lat=60.0, origin_lon=25.0)
    assert frame.position_m((25.001, 60.0), "wgs84") == pytest.approx([55.8, 0], abs=0.1)
    assert frame.position_m((25.001, 60.0), "map").tolist() == [25.001, 60.0]
