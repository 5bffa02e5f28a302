import json

import numpy as np
import pytest

from models.citymap.gallery import CELLS_FILE, NAMES_FILE, Gallery, NumberedCellIds
from models.errors import IndexBroken


def test_a_gallery_comes_back(source, tmp_path) -> None:
    gallery = source.data.gallery
    gallery.save(tmp_path)
    again = Gallery.load(tmp_path)
    assert (again.cells.ids, again.cells.scenes) == (gallery.cells.ids, gallery.cells.scenes)
    assert (again.labels, again.names, again.sources) == (gallery.labels, gallery.names, gallery.sources)
    assert (again.cells.parts.closest_m == gallery.cells.parts.closest_m).all()


def test_numbered_names_are_found_without_a_list_of_them() -> None:
    names = NumberedCellIds("town", 100_002)
    assert (len(names), names[7], names[-1], names[1:3]) == (
        100_002,
        "town_00007",
        "town_100001",
        ("town_00001", "town_00002"),
    )
    assert [names.index(names[row]) for row in (0, 99_999, 100_001)] == [0, 99_999, 100_001]
    for name in (
        "town_7",
        "town_000007",
        "town_100002",
        "city_00007",
        "town_",
        "town_\u0667",
        "",
        "town_" + 9999 * "9",
    ):
        assert name not in names
        with pytest.raises(ValueError, match="no cell"):
            names.index(name)
    with pytest.raises(IndexError):
        names[100_002]
    assert NumberedCellIds("town", 2) == ("town_00000", "town_00001") == NumberedCellIds("town", 2)
    assert NumberedCellIds("town", 2) != NumberedCellIds("town", 3)
    assert NumberedCellIds("town", 2) != ("town_00000", "town_00002")


def test_names_that_are_no_numbers_of_one_scene_come_back_too(source, tmp_path) -> None:
    gallery = source.data.gallery
    rows = np.array([5, 2])
    part = Gallery(gallery.cells.take(rows), gallery.labels, gallery.names, gallery.sources)
    part.save(tmp_path)
    assert Gallery.load(tmp_path).cells.ids == tuple(gallery.cells.ids[row] for row in rows)


def test_parts_are_cut_when_they_are_asked_for(source, geometry, tmp_path) -> None:
    gallery, requested = source.data.gallery, []

    def cut(rows):
        requested.append(rows.tolist())
        return geometry.cut(gallery.cells.center_m[rows])

    gallery.save(tmp_path, with_parts=False)
    cells = Gallery.load(tmp_path, cut).cells
    part = cells.take(np.array([9, 4])).take(np.array([1]))
    assert requested == []
    begin, end = gallery.cells.parts.starts[4:6]
    assert (part.parts.instance == gallery.cells.parts.instance[begin:end]).all()
    assert part.parts is part.parts
    assert requested == [[4]]
    assert (cells.parts.starts == gallery.cells.parts.starts).all()


def test_what_is_no_gallery_is_named(source, tmp_path) -> None:
    gallery = source.data.gallery
    gallery.save(tmp_path, with_parts=False)
    with pytest.raises(IndexBroken, match="hereabouts index"):
        Gallery.load(tmp_path)  # nothing can cut them
    gallery.save(tmp_path)
    names = json.loads((tmp_path / NAMES_FILE).read_text())
    (tmp_path / NAMES_FILE).write_text(json.dumps({name: names[name] for name in names if name != "scene"}))
    with pytest.raises(IndexBroken, match="hereabouts index"):
        Gallery.load(tmp_path)
    (tmp_path / CELLS_FILE).write_bytes(b"no")
    with pytest.raises(IndexBroken, match="hereabouts index"):
        Gallery.load(tmp_path)
