from dataclasses import replace

import pytest

from index.answering import picture
from index.answering.query import Query


@pytest.mark.parametrize(("p90_m", "is_whole"), [(5000.0, True), (30.0, False)])
def test_a_picture_shows_no_more_than_the_map_however_wide_an_answer_is(
    localizer, tmp_path, monkeypatch, p90_m, is_whole
) -> None:
    boxes, draw = [], picture._draw_map

    def drawn(axes, shapes, box, colours) -> None:
        boxes.append(box)
        draw(axes, shapes, box, colours)

    monkeypatch.setattr(picture, "_draw_map", drawn)
    [answer] = localizer.localize([Query("I am north of a gray building. A black pole is to my west.")])
    radius = replace(answer.estimate.radius_m, p90=p90_m)
    wide = replace(answer, estimate=replace(answer.estimate, radius_m=radius))
    picture.draw_answer(localizer, "words", wide, tmp_path / "answer.png")
    (_, south, _, north), (_, low, _, high) = boxes
    assert north - south <= 2 * (high - low)
    assert (south <= low and north >= high) == is_whole
    assert (tmp_path / "answer.png").read_bytes().startswith(b"\x89PNG")
