import json

import numpy as np
import pytest
import torch

from models.citymap.queries import Queries
from models.paper.fine.checkpoint import FINE_METHODS, load_fine
from models.paper.fine.fine_model import FineConfig, FineModel
from models.paper.fine.regressor import Regressor, RegressorConfig
from models.sources.source import open_source
from models.sources.store.files import load_data
from models.training.fine_data import FineSet, FineValidation, cell_offsets, containing_cells, reflect_offset
from models.training.fit_fine import FineTask, train_fine
from models.training.retrieval_data import SYMMETRIES, TrainingSet, reflect_cells
from models.training.settings import TrainingConfig
from models.training.training_data import TrainingData, load_training_data


@pytest.fixture(scope="module")
def store_set(streets, text_encoder):
    return FineSet(TrainingSet(open_source(streets, "train").statements(0.0, np.random.default_rng(0)), text_encoder))


@pytest.fixture(scope="module", params=["map", "store"])
def either(request, fine_set, store_set):
    return {"map": fine_set, "store": store_set}[request.param]


def test_cloned_cells_contain_the_position_and_are_of_its_scene(either) -> None:
    cells, training = either.cells, either.training
    assert len(either.neighbours) > len(training)
    for n in range(0, len(training.best), 7):
        others = either.neighbours[either.neighbour_starts[n] : either.neighbour_starts[n + 1]]
        best = int(training.best[n])
        away = np.abs(cells.center_m[:, :2] - either.positions_m[n]).max(axis=1)
        naive = [c for c in range(len(cells)) if away[c] <= cells.size_m / 2 and cells.scenes[c] == cells.scenes[best]]
        assert sorted([best, *others.tolist()]) == naive


def test_half_of_the_cells_are_cloned_or_none(either) -> None:
    training = either.training
    positions = np.random.default_rng(0).choice(training.usable, 4000)
    drawn = either.draw_cells(positions, np.random.default_rng(1))
    has_other = (np.diff(either.neighbour_starts) > 0)[positions]
    assert np.mean(drawn[has_other] != training.best[positions][has_other]) == pytest.approx(0.5, abs=0.03)
    plain = FineSet(training, pmc="none")
    assert (plain.draw_cells(positions, np.random.default_rng(1)) == training.best[positions]).all()


def instances_of(fine_set, cell):
    parts = fine_set.cells.parts
    return set(fine_set.statements.part_number[parts.starts[cell] : parts.starts[cell + 1]].tolist())


def test_text2loc_clones_near_cells_that_lack_one_instance_at_most(either) -> None:
    published, training = FineSet(either.training, pmc="published"), either.training
    cells, rng = either.cells, np.random.default_rng(0)
    positions = rng.choice(training.usable, 60)
    drawn, clone_count = training.draw_hints(positions, np.zeros(60, np.int64), rng), 0
    for row, position in enumerate(positions):
        mentioned = either.statements.mentioned_number[drawn.hints[row, drawn.mask[row]]].tolist()
        x, y = either.positions_m[position]
        naive = {}
        for cell in range(len(cells)):
            east, north = cells.center_m[cell, 0] - x, cells.center_m[cell, 1] - y
            if cells.scenes[cell] != cells.scenes[training.best[position]] or max(abs(east), abs(north)) >= 12:
                continue
            lacking = [n for n in mentioned if n >= 0 and n not in instances_of(either, cell)]
            if cell != training.best[position] and len(lacking) <= 1:
                naive[cell] = (east**2 + north**2) ** 0.5
        clones, distance_m = published.clones(int(position), drawn.hints[row, drawn.mask[row]])
        assert dict(zip(clones.tolist(), distance_m.tolist(), strict=True)) == pytest.approx(naive)
        clone_count += len(naive)
    assert clone_count > 10


def test_text2loc_draws_clones_by_inverse_distance(fine_set, monkeypatch) -> None:
    published, training = FineSet(fine_set.training, pmc="published"), fine_set.training
    monkeypatch.setattr(published, "clones", lambda *_: (np.array([7, 9]), np.array([2.0, 6.0])))
    positions = np.full(4000, training.usable[0])
    drawn = training.draw_hints(positions, np.zeros(4000, np.int64), np.random.default_rng(0))
    cells = published.draw_published(positions, drawn, np.random.default_rng(1))
    assert np.mean(cells == 7) == pytest.approx(0.5 * 6 / 8, abs=0.03)
    assert np.mean(cells == 9) == pytest.approx(0.5 * 2 / 8, abs=0.03)
    batch = FineSet(training, pmc="published").batch(16, np.random.default_rng(2))
    assert (batch.targets.offset - 0.5).abs().max() <= 0.5 + 1e-5, "each cell contains its position"


def test_targets_turn_with_the_cell(either) -> None:
    rows = np.arange(8)
    positions = either.cells.center_m[rows, :2] + np.random.default_rng(0).uniform(-9, 9, (8, 2))
    offset = torch.from_numpy(cell_offsets(either.cells, rows, positions).astype(np.float32))
    assert torch.allclose(offset, (torch.from_numpy(positions - either.cells.center_m[rows, :2]) / 30 + 0.5).float())
    matrix = torch.from_numpy(SYMMETRIES)
    before = either.training.features.batch(rows)
    after, moved = reflect_cells(before, matrix), reflect_offset(offset, matrix)
    # From the closest point of every instance to the position: the same way, turned.
    way, turned = (2 * o[:, None] - 1 - cells.geometry[..., 3:5] for o, cells in ((offset, before), (moved, after)))
    expected = torch.einsum("bij,bnj->bni", matrix, way)
    assert torch.allclose(turned[before.mask], expected[before.mask], atol=1e-5)


class FixedPredictions(FineModel):
    """A fine stage that predicts fixed offsets."""

    def __init__(self, truth):
        torch.nn.Module.__init__(self)
        self.truth, self.config, self.points = truth, FineConfig(), None

    def predict(self, descriptions, cells, rows):
        return self.truth


def test_what_is_said_is_true_of_the_turned_position_and_the_instance_meant(either) -> None:
    batch = either.batch(64, np.random.default_rng(2))
    assert ((batch.targets.offset >= -1e-5) & (batch.targets.offset <= 1 + 1e-5)).all()
    assert (batch.sentences[batch.hint_mask] >= 0).all()
    vocabulary = either.training.vocabulary
    sentence = vocabulary.sentence
    labels, colours = np.unique(either.training.label_of), np.unique([-1, *either.training.table.colour])
    direction_of = {}
    for d in range(5):
        for t in range(8):
            numbers = sentence(labels[:, None], colours[None, :], d, t)
            direction_of |= dict.fromkeys(numbers[numbers >= 0].tolist(), d)  # less where nothing is of that colour
    agree = []
    for b, h in (batch.targets.match >= 0).nonzero().tolist():
        geometry = batch.cells.geometry[b, batch.targets.match[b, h]]
        middle, half = geometry[:2] / 2 + 0.5, geometry[8:10] / 2
        way = batch.targets.offset[b] - middle
        x, y = (way / half.clamp(min=0.02)).tolist()
        d = direction_of[int(batch.sentences[b, h])]
        if max(abs(x), abs(y)) > 1.5:  # clearly outside the instance's box
            agree.append({0: y > 0, 1: y < 0, 2: x > 0, 3: x < 0, 4: True}[d])
    assert len(agree) > 20
    assert np.mean(agree) > 0.9


def test_validation_of_the_truth_is_perfect_and_of_the_centre_is_the_centres(either) -> None:
    cells, training = either.cells, either.training
    queries = training.usable[:40]
    total = len(queries)
    positions = either.positions_m[queries]
    benchmark_queries = Queries(
        [("I am here.",)] * total, positions, training.best[queries], [""] * total, [""] * total
    )
    validation = FineValidation.from_queries(training.statements.gallery, benchmark_queries, FixedPredictions(None))
    assert set(validation.metrics(FixedPredictions(validation.offset)).values()) == {1.0}
    away = np.linalg.norm(positions - cells.center_m[training.best[queries], :2], axis=1)
    metrics = validation.center_metrics()
    assert metrics == validation.metrics(FixedPredictions(np.full((total, 2, 2), 0.5)))
    assert (metrics["within_5m"], metrics["within_10m"]) == (np.mean(away <= 5), np.mean(away <= 10))
    starts, rows = containing_cells(cells, positions, training.best[queries])
    for q in range(total):
        others = rows[starts[q] : starts[q + 1]]
        assert validation.rows[q, 1] in others if len(others) else validation.rows[q, 1] == -1


def test_matches_name_the_instances_that_the_store_says(store_set, streets) -> None:
    store, fine_set = load_data(streets, "train"), FineSet(store_set.training, pmc="none")
    poses, parts = store.poses, store.cell_table().parts
    match = fine_set.batch(80, np.random.default_rng(0)).targets.match.numpy()
    rng = np.random.default_rng(0)  # what the batch drew
    positions = rng.choice(fine_set.training.usable, 80)
    cells, symmetry = fine_set.draw_cells(positions, rng), rng.integers(len(SYMMETRIES), size=80)
    drawn = fine_set.training.draw_hints(positions, symmetry, rng)
    assert (cells == poses.cell[positions]).all()
    right = known = 0
    for n in range(80):
        row = poses.instance[drawn.hints[n, drawn.mask[n]]]
        matches = match[n, : len(row)]
        assert ((matches >= 0) == (row >= 0)).all()
        known += int((row >= 0).sum())
        right += int((matches[row >= 0] + parts.starts[cells[n]] == row[row >= 0]).sum())
    assert known > 20
    assert right / known > 0.9, "parts of one instance may be told apart wrongly, others not"


@pytest.mark.slow
def test_both_methods_overfit_a_few_positions(city, source, text_encoder) -> None:
    positions = city.locations_m[np.random.default_rng(4).choice(len(city.locations_m), 12, replace=False)]
    training = TrainingSet(source.statements_at(positions), text_encoder)
    examples = FineSet(training, pmc="none").batch(12, np.random.default_rng(0))
    for method, config in (
        ("regressor", RegressorConfig(width=32, dropout=0.0)),
        ("matching", FINE_METHODS["matching"].config_type(width=32, dropout=0.0, refine=True, iterations=10)),
    ):
        torch.manual_seed(0)
        task = FineTask(
            FINE_METHODS[method](text_encoder, config), [TrainingData(training, None, None, {})], 12, pmc="none"
        )
        optimizer = torch.optim.Adam(task.model.parameters(), 5e-3)
        losses = []
        for _ in range(40):
            loss = task.loss((0, examples))
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
            losses.append(loss.item())
        assert losses[-1] < losses[0] / 2, method
        if method == "regressor":
            with torch.no_grad():
                task.model.config = config.model_copy(update={"match_weight": 0.0})
                error_m = 15 * (2 * task.loss((0, examples)).item()) ** 0.5
            assert error_m < 3


@pytest.mark.slow
def test_training_is_seeded_saved_and_says_how_far_it_errs(regions, tmp_path) -> None:
    config = TrainingConfig(steps=4, batch_size=8, validate_every=2, spacing_m=20.0)
    steps = []

    def load(encoder, rng):
        return [TrainingData.from_sources(*regions, encoder, config, rng)]

    figures = [
        train_fine(load, tmp_path / name, "regressor", RegressorConfig(width=32), config, progress=steps.append)
        for name in "ab"
    ]
    assert figures[0] == figures[1]
    models = [load_fine(tmp_path / name) for name in "ab"]
    assert isinstance(models[0], Regressor)
    assert models[0].fingerprint == models[1].fingerprint
    assert models[0].error_m is not None
    assert 0 < models[0].error_m < 15
    assert [p.step for p in steps if p.figures] == [2, 4, 2, 4]
    source = json.loads((tmp_path / "a" / "config.json").read_text())["training"]["sources"][0]
    assert source["validation"]["cell_center"]["within_5m"] > 0


@pytest.mark.slow
def test_a_data_set_trains_either_method(streets, tmp_path) -> None:
    def load(encoder, rng):
        return [load_training_data(streets, ("train", "val"), encoder, TrainingConfig(), rng)] * 2

    for method, kind in FINE_METHODS.items():
        config = TrainingConfig(steps=2, batch_size=8, validate_every=2, pmc="none")
        figures = train_fine(load, tmp_path / method, method, kind.config_type(width=32), config)
        assert 0 <= figures["within_5m"] <= figures["within_10m"] <= 1
        assert load_fine(tmp_path / method).method == method
