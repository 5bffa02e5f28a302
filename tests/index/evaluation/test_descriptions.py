from types import SimpleNamespace

import numpy as np

from index.answering.answers import Answer, Candidate, Estimate, ModelName, Radius
from index.evaluation.descriptions import (
    descriptions_table,
    draw_positions,
    evaluate_descriptions,
    localize_descriptions,
)


def test_positions_are_found_again_by_their_descriptions(localizer) -> None:
    report = evaluate_descriptions(localizer, 40, 11, lambda *_: None)
    assert (report["data"], report["positions"], report["described"]) == ("tinytown", 40, 1.0)
    within = list(report["within"].values())
    assert within == sorted(within)
    assert report["within"]["10"] >= 0.95
    assert report["held"] >= 0.8
    head, [row] = descriptions_table(report)
    assert dict(zip(head, row, strict=True))["described"] == "1.000"


def test_positions_lie_in_the_squares_of_different_cells(localizer) -> None:
    centers_m, half_m = localizer.gallery.cells.center_m[:, :2], localizer.manifest.grid_m / 2
    drawn = draw_positions(localizer, 10**6, np.random.default_rng(0))
    assert len(drawn) == len(centers_m)
    nearest = np.abs(drawn[:, None] - centers_m).max(axis=2).argmin(axis=1)
    assert sorted(nearest.tolist()) == list(range(len(centers_m)))
    assert (np.abs(drawn - centers_m[nearest]) <= half_m).all()


def test_where_nothing_can_be_said_nothing_is_found(localizer) -> None:
    off_the_map = (-400.0, 0.0)
    figures = localize_descriptions(localizer, np.array([off_the_map, (60.0, 61.0), off_the_map]), lambda *_: None)
    assert figures.words.tolist()[::2] == [0, 0]
    assert np.isinf(figures.error_m).tolist() == [True, False, True]
    assert not (figures.is_ok | figures.is_in_radius)[::2].any()
    assert figures.words[1] > 10


def test_what_is_found_in_another_scene_is_not_found_though_a_circle_holds_it() -> None:
    position = (3.0, 4.0)
    estimate = Estimate(position, "posterior", ((1.0, 0.0), (0.0, 1.0)), Radius(1.0, 2.0), {}, 0.9, None)
    candidates = tuple(
        Candidate(1, cell, 1.0, 0.9, (*position, 0.0), (0.0, 0.0, 9.0, 9.0), position, None) for cell in ("a", "b")
    )
    answers = [Answer("ok", ModelName("m", ""), estimate, (candidate,)) for candidate in candidates]
    answers.append(Answer("no_match", ModelName("m", "")))
    localizer = SimpleNamespace(
        gallery=SimpleNamespace(cells=SimpleNamespace(ids=("a", "b"), scenes=("east", "west"))),
        describe=lambda _: SimpleNamespace(description="I am here.", cell_id="a"),
        localize=lambda _: answers,
    )
    figures = localize_descriptions(localizer, np.array([position, position, position]), lambda *_: None)
    assert figures.error_m.tolist() == [0.0, np.inf, np.inf]
    assert figures.is_in_radius.tolist() == [True, True, False]
    assert figures.is_ok.tolist() == [True, True, False]
    assert figures.words.tolist() == [3, 3, 3]
