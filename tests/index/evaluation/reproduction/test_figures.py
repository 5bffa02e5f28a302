"""The figures of `reproduce`, and when figure 3 is drawn again."""

import os
from collections import Counter
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import torch
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.text import Text

from index.answering.query import Query
from index.evaluation.reproduction import figures as module
from index.evaluation.reproduction import jobs, reproduce
from index.evaluation.reproduction.figures import class_colours, contains, draw_figure_3, draw_figure_4, draw_figure_5
from index.evaluation.reproduction.jobs import FIGURE_3, ReproductionJob, localization_file
from models.paper.fine.regressor import Regressor, RegressorConfig
from models.paper.text2loc import Text2Loc, Text2LocConfig
from models.training.experiments import TrainingScale
from models.training.paper_tables import HEAD, MNCL, TABLE_2, TEXT2LOC


@pytest.fixture
def drawn(monkeypatch) -> list[Any]:
    """The figures, which are not written."""
    figures: list[Any] = []

    class Canvas(FigureCanvasAgg):
        def print_png(self, *_: Any, **_options: Any) -> None:
            self.draw()
            figures.append(self.figure)

    monkeypatch.setattr(module, "FigureCanvasAgg", Canvas)
    return figures


def text_boxes(figure: Any) -> list[Any]:
    """Boxes of all texts of a figure, in pixels."""
    texts = [text for text in figure.findobj(Text) if text.get_text().strip()]
    return [text.get_window_extent() for text in texts if text.get_visible()]


def test_cells_with_the_true_position_have_a_green_frame(
    data_and_queries, model, text_encoder, drawn, tmp_path
) -> None:
    data, queries = data_and_queries
    torch.manual_seed(0)
    refiner = Regressor(text_encoder, RegressorConfig(width=32)).eval()
    other = Text2Loc(text_encoder, Text2LocConfig(width=32)).eval()
    localizers = {
        name: jobs._localizer(data, retriever, refiner=refiner) for name, retriever in (("T", other), ("M", model))
    }
    draw_figure_3(data, queries, localizers, tmp_path / "figure3.png")
    [figure] = drawn
    rows = np.random.default_rng(module.SEED).choice(len(queries), 4, replace=False)
    colours, titles = [], []
    for q in rows:
        x, y = queries.positions_m[q]
        for localizer in localizers.values():
            [result] = localizer.find([Query(" ".join(queries.sentences[q]), top_k=3)])
            for n, cell in enumerate(result.located.rows[:3]):
                east, north, _ = data.cells.center_m[cell]
                half = data.cells.size_m / 2
                inside = east - half <= x <= east + half and north - half <= y <= north + half
                colours.append("#00a000" if inside else "#e60000")
                at_x, at_y = result.located.positions[n]
                titles.append(f"{n + 1}: {((at_x - x) ** 2 + (at_y - y) ** 2) ** 0.5:.0f} m off")
    cells = [axes for axes in figure.findobj(Axes) if axes.collections]
    assert [to_hex(axes.spines["left"].get_edgecolor()) for axes in cells] == colours
    assert [axes.get_title() for axes in cells] == titles
    boxes = text_boxes(figure)
    overlapping = [
        (n, m) for n, one in enumerate(boxes) for m, two in enumerate(boxes[:n]) if one.padded(-1).overlaps(two)
    ]
    assert not overlapping, "texts lie over each other"


def test_a_cell_contains_what_is_inside_and_of_its_scene(data_and_queries) -> None:
    cells = data_and_queries[0].cells
    center, half, scene = cells.center_m[3, :2], cells.size_m / 2, cells.scenes[3]
    assert contains(cells, 3, center + np.array([half - 0.1, 0.1 - half]), scene)
    assert not contains(cells, 3, center + np.array([half + 0.1, 0]), scene)
    assert not contains(cells, 3, center, "other")


def test_classes_of_the_cells_have_colours_of_their_own(data_and_queries, monkeypatch) -> None:
    data = data_and_queries[0]
    parts, shown = data.cells.parts, np.array([0, 5])
    labels = Counter(
        data.gallery.labels[parts.instance[r]] for n in shown for r in range(parts.starts[n], parts.starts[n + 1])
    )
    colours = class_colours(data, shown)
    assert colours.keys() == labels.keys()
    assert len(set(colours.values())) == len(colours) > 3
    monkeypatch.setattr(module, "CLASS_COLOURS", {})
    monkeypatch.setattr(module, "SPARE_COLOURS", ["red", "blue"])
    few = class_colours(data, shown)
    assert list(few) == [*(label for label, _ in labels.most_common(2)), "other"]


def test_figure_3_is_drawn_when_a_model_of_it_was_measured(osm_file, tmp_path, monkeypatch) -> None:
    calls: list[Any] = []

    def here(work, tasks, workers):
        for jobs_by_name, fine_job, path in tasks:
            calls.append((sorted(jobs_by_name), fine_job.run))
            path.write_bytes(b"drawn")
            yield work

    monkeypatch.setattr(reproduce, "_run_in_processes", here)
    scale = TrainingScale((), (), ())
    head, mncl, text2loc = (ReproductionJob.build(run, 0, osm_file, tmp_path, scale) for run in (HEAD, MNCL, TEXT2LOC))
    pairs = [(mncl, head), (text2loc, head)]
    for seconds, pair in enumerate(pairs):
        pair[0].directory.mkdir(parents=True)
        localization_file(*pair).write_text("")
        os.utime(localization_file(*pair), (seconds, seconds))
    reproduce._draw_figure_3(pairs[:1])
    assert not calls, "without Text2Loc there is nothing to compare"
    reproduce._draw_figure_3(pairs)
    reproduce._draw_figure_3(pairs)
    assert calls == [(["MNCL", "Text2Loc"], HEAD)]
    os.utime(mncl.directory / FIGURE_3, (0, 0))
    reproduce._draw_figure_3(pairs)
    assert len(calls) == 2
    assert reproduce.figure_3_path(osm_file, tmp_path, scale, 0, (TABLE_2,)) is None
    assert reproduce.figure_3_path(osm_file, tmp_path, replace(scale), 0, (reproduce.EXPERIMENTS["1"],)).is_file()


def test_figure_4_has_curves_of_test_and_validation_scenes(drawn, tmp_path) -> None:
    rng = np.random.default_rng(0)
    curves = [[(rng.random((2, 3)), rng.random((1, 3))) for _ in range(points)] for points in (6, 5)]
    draw_figure_4(tmp_path / "figure4.png", ["layers m", "exponent a"], curves)
    for axes, label, points in zip(drawn[0].axes, ("layers m", "exponent a"), curves, strict=True):
        assert axes.get_xlabel() == label
        for n in range(3):
            for split, style in enumerate(("-", "--")):
                line = axes.lines[2 * n + split]
                assert line.get_linestyle() == style
                assert line.get_xydata().tolist() == [[x, p[split][0, n]] for x, p in enumerate(points)]
        low, high = axes.get_ylim()
        values = [value for point in points for part in point for value in part[0]]
        assert low <= min(values) <= max(values) <= high


def test_figure_5_has_a_plot_of_each_form(drawn, tmp_path) -> None:
    recalls = np.array([[0.5, 0.3], [0.7, 0.5]])
    forms = {"scene 0009": ([10, 20], [("M", recalls)]), "all": ([30, 60], [("T", recalls / 2), ("M", recalls)])}
    draw_figure_5(tmp_path / "figure5.png", forms)
    one, pooled = drawn[0].axes
    assert (one.get_title(), pooled.get_title()) == tuple(forms)
    assert one.lines[0].get_xydata() == pytest.approx(np.array([[10, 0.6], [20, 0.4]]))
    assert one.lines[0].get_color() == pooled.lines[3].get_color() != pooled.lines[0].get_color()
