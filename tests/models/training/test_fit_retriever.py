import itertools
import json
from dataclasses import replace

import numpy as np
import pytest
import torch
from safetensors.torch import load_file

from index.answering.ranking import Ranker
from models.citymap.hints import direction_index
from models.citymap.point_sample import PointSampling
from models.citymap.types import DIRECTIONS
from models.errors import DataError, WeightsError
from models.paper import point_encoder
from models.paper.checkpoint import METHODS, load_retriever
from models.paper.fine.checkpoint import load_fine
from models.paper.fine.matching import MatchingConfig
from models.paper.instance_encoder import PAPER_INPUTS, CellFeatures
from models.paper.mncl import Mncl, MnclConfig
from models.paper.text2loc import Text2Loc, Text2LocConfig
from models.paper.text2pos import Text2Pos, Text2PosConfig
from models.sources.source import open_sources
from models.training import fit_points
from models.training.fit_fine import train_fine
from models.training.fit_points import train_points
from models.training.fit_retriever import RetrievalTask, train_retriever
from models.training.retrieval_data import (
    DIRECTION_UNDER_SYMMETRY,
    HARD_NEGATIVE_RADIUS_M,
    SYMMETRIES,
    TrainingSet,
    reflect_cells,
)
from models.training.settings import TrainingConfig, load_settings
from models.training.training_data import TrainingCells, TrainingData, load_training_data
from models.training.validation import Validation
from tests.models.sources.raw_scenes import TRAIN_STREETS, VAL_STREET


@pytest.fixture(scope="module")
def region(source, text_encoder):
    return TrainingSet(source.statements(30.0, np.random.default_rng(0)), text_encoder)


def test_directions_turn_with_the_map() -> None:
    for matrix, moved in zip(SYMMETRIES, DIRECTION_UNDER_SYMMETRY, strict=True):
        for offset in ((0, 5), (0, -5), (5, 0), (-5, 0), (0, 0)):
            before, after = direction_index(np.array(offset)), direction_index(matrix @ np.array(offset))
            assert moved[before] == after
    assert len({tuple(m) for m in DIRECTION_UNDER_SYMMETRY.tolist()}) == 8


def test_turning_a_cell_keeps_distances_and_turns_directions(cells, city) -> None:
    features = CellFeatures.from_cells(cells, np.array([i.label for i in city.instances]))
    batch = features.batch(np.arange(8))
    turned = reflect_cells(batch, torch.from_numpy(SYMMETRIES))
    assert torch.equal(turned.geometry[0], batch.geometry[0]), "the first symmetry is none"
    assert torch.allclose(turned.geometry[..., 3:5].norm(dim=-1), batch.geometry[..., 3:5].norm(dim=-1))
    assert (turned.geometry[..., 8:11] >= 0).all()
    swap = 4  # (east, north) becomes (north, east)
    assert torch.equal(turned.geometry[swap][:, [8, 9]], batch.geometry[swap][:, [9, 8]])


def test_batches_are_seeded_and_say_what_is_true(region, city) -> None:
    drawn = [region.batch(region.draw(16, 4, np.random.default_rng(5)), np.random.default_rng(6)) for _ in range(2)]
    assert torch.equal(drawn[0].sentences, drawn[1].sentences)
    batch = drawn[0]
    assert batch.hint_mask.sum(dim=1).min() >= 2
    assert (batch.sentences[batch.hint_mask] >= 0).all(), "every sentence is in the vocabulary"
    assert batch.same_cell.diagonal().all()


def test_a_batch_has_groups_of_positions_near_each_other(region) -> None:
    positions_m = region.statements.positions_m[:, :2]
    for group in region.draw(16, 4, np.random.default_rng(5)).reshape(4, 4):
        away_m = np.linalg.norm(positions_m[region.usable][:, None] - positions_m[group], axis=-1)
        assert away_m.max(axis=1).min() <= HARD_NEGATIVE_RADIUS_M
    assert len(region.draw(16, 1, np.random.default_rng(5))) == 16


def test_published_wording_says_what_is_there_in_the_benchmarks_words(source, text_encoder) -> None:
    region = TrainingSet(source.statements(60.0, np.random.default_rng(0)), text_encoder, "published")
    chosen = region.usable[:20]
    drawn = region.draw_hints(chosen, np.zeros(len(chosen), int), np.random.default_rng(0))
    vocabulary, table = region.vocabulary, region.table
    for row, position in enumerate(chosen):
        hints = np.arange(table.starts[position], min(table.starts[position + 1], table.starts[position] + 6))
        label = region.label_of[table.instance[hints]]
        expected = vocabulary.sentence(label, table.colour[hints], table.direction[hints], 0)
        assert drawn.sentences[row, drawn.mask[row]].tolist() == expected.tolist()
        assert drawn.hints[row, drawn.mask[row]].tolist() == hints.tolist()


def test_wrong_hints_are_hints_of_other_positions(source, text_encoder) -> None:
    statements = source.statements(10.0, np.random.default_rng(0))
    right, wrong = (TrainingSet(statements, text_encoder, "published", share) for share in (0.0, 0.4))
    chosen = right.usable
    true, noisy = (
        region.draw_hints(chosen, np.zeros(len(chosen), int), np.random.default_rng(0)) for region in (right, wrong)
    )
    assert (true.mask == noisy.mask).all()
    assert (noisy.hints[~noisy.mask] == -1).all()
    replaced = (true.hints != noisy.hints) & true.mask
    assert replaced[true.mask].mean() == pytest.approx(0.4, abs=0.06)
    table = right.table
    for row, column in np.argwhere(replaced):
        owner = np.searchsorted(table.starts, noisy.hints[row, column], "right") - 1
        assert owner in chosen
        assert owner != chosen[row]
        label = right.label_of[table.instance[noisy.hints[row, column]]]
        colour, direction = table.colour[noisy.hints[row, column]], table.direction[noisy.hints[row, column]]
        assert noisy.sentences[row, column] == wrong.vocabulary.sentence(label, colour, direction, 0)


def test_the_vocabulary_numbers_its_sentences(region) -> None:
    vocabulary = region.vocabulary
    numbers = [
        int(vocabulary.sentence(label, -1, d, t))
        for label, d, t in itertools.product(np.unique(region.label_of), range(len(DIRECTIONS)), range(2))
    ]
    assert len(set(numbers)) == len(numbers)
    assert max(numbers) < len(vocabulary.mask)


@pytest.mark.slow
def test_training_learns_is_seeded_and_is_saved(regions, text_encoder, tmp_path) -> None:
    config = TrainingConfig(steps=12, batch_size=16, spacing_m=15.0, validate_every=6, learning_rate=3e-3)
    progress = []

    def load(encoder, rng):
        return [TrainingData.from_sources(*regions, encoder, config, rng)]

    recalls = [
        train_retriever(load, tmp_path / name, Mncl, MnclConfig(width=32), config, progress=progress.append)
        for name in "ab"
    ]
    assert recalls[0] == recalls[1]
    assert load_retriever(tmp_path / "a").fingerprint == load_retriever(tmp_path / "b").fingerprint
    losses = [p.loss for p in progress[:12]]
    assert np.mean(losses[6:]) < np.mean(losses[:6])
    assert [p.step for p in progress if p.figures] == [6, 12, 6, 12]
    assert load_retriever(tmp_path / "a").temperature(6) > 0


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_every_method_trains_in_half_precision(regions, text_encoder, method) -> None:
    source = TrainingData.from_sources(*regions, text_encoder, TrainingConfig(spacing_m=30.0), np.random.default_rng(0))
    torch.manual_seed(0)
    task = RetrievalTask(method(text_encoder, method.config_type(width=32)), [source], batch_size=16, cluster=4)
    task.model.eval()  # no dropout
    batch = task.batch(np.random.default_rng(1))
    whole = task.loss(batch)
    with torch.autocast("cpu", dtype=torch.bfloat16):
        half = task.loss(batch)
    half.backward()
    assert half.dtype == torch.float32
    assert half.item() == pytest.approx(whole.item(), rel=0.05)
    assert all(torch.isfinite(p.grad).all() for p in task.model.parameters() if p.grad is not None)


@pytest.mark.parametrize("logarithms", ["two", "one"])
def test_validation_reports_the_pairs_clamped_since_the_last_one(
    regions, text_encoder, logarithms, monkeypatch
) -> None:
    source = TrainingData.from_sources(*regions, text_encoder, TrainingConfig(spacing_m=30.0), np.random.default_rng(0))
    model = Mncl(text_encoder, MnclConfig(width=32, levels=("global", "instance"), logarithms=logarithms))
    task = RetrievalTask(model, [source], batch_size=8, cluster=1)
    shares = iter((0.5, 0.25, 0.125, 0.125))  # of two levels and two steps
    monkeypatch.setattr("models.paper.mncl.clamped_share", lambda *_: torch.tensor(next(shares)))
    recalls = {f"recall@{k}": 0.9 for k in (1, 3, 5)}
    monkeypatch.setattr(Validation, "recall", lambda *_: {1: 0.9, 3: 0.9, 5: 0.9})
    for _ in range(2):
        task.loss(task.batch(np.random.default_rng(1)))
    assert task.validate() == recalls | ({"clamped_pairs": 0.25} if logarithms == "one" else {})
    assert task.validate() == recalls


@pytest.mark.slow
def test_a_run_directory_goes_on(regions, tmp_path) -> None:
    config = TrainingConfig(steps=6, batch_size=16, spacing_m=30.0, validate_every=2)

    def load(encoder, rng):
        return [TrainingData.from_sources(*regions, encoder, config, rng) for _ in range(2)]

    def kill(report):
        if report.step == 5:
            raise KeyboardInterrupt

    model = MnclConfig(width=32, levels=("global", "instance"))
    train_retriever(load, tmp_path / "a", Mncl, model, config)
    with pytest.raises(KeyboardInterrupt):
        train_retriever(load, tmp_path / "b", Mncl, model, config, tmp_path / "run", progress=kill)
    train_retriever(load, tmp_path / "b", Mncl, model, config, tmp_path / "run", resume=True)
    unbroken, resumed = ((tmp_path / name / "config.json").read_text() for name in "ab")
    assert unbroken == resumed, "the fingerprint of the weights is in it, and the temperature"
    assert json.loads((tmp_path / "run" / "config.json").read_text())["model"]["levels"] == ["global", "instance"]


@pytest.fixture(scope="module")
def strip(strip_file):
    """As `regions`, and all of the strip."""
    return open_sources(strip_file, ("train", "val", None))


@pytest.fixture
def coarse(monkeypatch):
    """Point encoders that look at few points."""
    levels = ((16, 0.2, 8, (32, 64)), (4, 0.4, 8, (64, 128)))
    for name, layers in point_encoder.ARCHITECTURES.items():
        few = replace(layers, levels=levels, pooled=(128, 256), head=(256,) if layers.head else ())
        monkeypatch.setitem(point_encoder.ARCHITECTURES, name, few)


@pytest.mark.slow
def test_a_point_encoder_is_trained_first_and_saved_along(strip, coarse, tmp_path, monkeypatch) -> None:
    *regions, whole = strip
    few = ("training.steps=40", "training.validate_every=20", "training.batch_size=32")
    monkeypatch.setattr(fit_points, "load_settings", lambda name, changes: load_settings(name, [*few, *changes]))
    config = TrainingConfig(steps=4, batch_size=16, spacing_m=30.0, validate_every=2)

    def load(encoder, rng):
        return [TrainingData.from_sources(*regions, encoder, config, rng)]

    def kill(report):
        if (report.step, report.steps) == (3, 4):
            raise KeyboardInterrupt

    model = MnclConfig(width=32, levels=("global",), inputs=PAPER_INPUTS)
    train_retriever(load, tmp_path / "a", Mncl, model, config)
    figures = json.loads((tmp_path / "a" / "config.json").read_text())["training"]["point_encoder"]
    cells, labels = whole.data.cells, np.array(whole.data.gallery.labels)
    commonest = np.unique(labels[cells.parts.instance], return_counts=True)[1].max() / len(cells.parts.instance)
    assert figures["label"] > commonest
    with pytest.raises(KeyboardInterrupt):
        train_retriever(load, tmp_path / "b", Mncl, model, config, tmp_path / "run", progress=kill)
    monkeypatch.setattr(fit_points._PointTask, "loss", None)  # it is not trained again
    train_retriever(load, tmp_path / "b", Mncl, model, config, tmp_path / "run", resume=True)
    assert (tmp_path / "a" / "config.json").read_text() == (tmp_path / "b" / "config.json").read_text()
    retriever = load_retriever(tmp_path / "a")
    assert retriever.points is not None
    store = Ranker.from_cells(retriever, cells, labels).store
    assert store.vectors(np.arange(len(cells))).shape == (len(cells), 32)


@pytest.mark.slow
def test_a_point_encoder_made_before_serves_retrievers_and_fine_stages(strip, coarse, tmp_path, monkeypatch) -> None:
    *regions, _ = strip
    config = TrainingConfig(steps=4, batch_size=16, spacing_m=30.0, validate_every=2)

    def load(encoder, rng):
        return [TrainingData.from_sources(*regions, encoder, config, rng)]

    figures = train_points([TrainingCells.from_sources(*regions)], tmp_path / "points", config)
    monkeypatch.setattr(fit_points, "fit_points", None)  # none is trained again
    given = config.model_copy(update={"points": tmp_path / "points"})
    train_retriever(load, tmp_path / "coarse", Text2Loc, Text2LocConfig(width=32, inputs=PAPER_INPUTS), given)
    train_fine(load, tmp_path / "fine", "matching", MatchingConfig(width=32, inputs=PAPER_INPUTS, plain=False), given)
    wanted = load_file(tmp_path / "points" / "model.safetensors")
    for directory, loaded in (("coarse", load_retriever), ("fine", load_fine)):
        loaded_state = loaded(tmp_path / directory).points.state_dict()
        assert all(torch.allclose(loaded_state[name], tensor, atol=1e-3) for name, tensor in wanted.items())
        record = json.loads((tmp_path / directory / "config.json").read_text())["training"]
        assert record["point_encoder"] == figures
    nowhere = config.model_copy(update={"points": tmp_path / "nowhere"})
    with pytest.raises(WeightsError, match="--method points"):
        train_retriever(load, tmp_path / "w", Text2Loc, Text2LocConfig(width=32, inputs=PAPER_INPUTS), nowhere)


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "frozen"), list(itertools.product(["small", "official"], [True, False])))
def test_a_point_encoder_is_trained_further_unless_it_is_frozen(strip, coarse, tmp_path, kind, frozen) -> None:
    *regions, whole = strip
    config = TrainingConfig(steps=4, batch_size=8, spacing_m=30.0, validate_every=2)
    train_points([TrainingCells.from_sources(*regions)], tmp_path / "p", config, architecture=kind)
    config = config.model_copy(update={"points": tmp_path / "p"})
    batches = []

    def load(encoder, rng):
        data = TrainingData.from_sources(*regions, encoder, config, rng)
        draw = data.training.batch
        data.training.batch = lambda *given: batches.append(draw(*given)) or batches[-1]
        return [data]

    options = {"width": 32, "inputs": PAPER_INPUTS, "point_encoder": kind, "points_frozen": frozen}
    train_retriever(load, tmp_path / "w", Mncl, MnclConfig(**options), config)
    train_fine(load, tmp_path / "fine", "matching", MatchingConfig(**options, plain=False), config)
    before = load_file(tmp_path / "p" / "model.safetensors")
    for loaded in (load_retriever(tmp_path / "w"), load_fine(tmp_path / "fine")):
        assert (loaded.config.point_encoder, loaded.config.points_frozen) == (kind, frozen)
        for name, tensor in loaded.points.state_dict().items():
            assert torch.allclose(tensor, before[name], atol=1e-3 * (frozen or 1e-6)) == frozen, name
    assert len(batches) == config.steps
    drawn = [batch.cells.points for batch in batches]
    assert all((points is None) == (frozen and kind == "small") for points in drawn)
    retriever, labels = load_retriever(tmp_path / "w"), np.array(whole.data.gallery.labels)
    few = whole.data.cells.take(np.arange(20))
    store = Ranker.from_cells(retriever, few, labels).store
    features = CellFeatures.from_cells(few, labels)
    sampling = PointSampling(retriever.points.frame)
    with torch.inference_mode():
        batch = retriever.encode_points(features.batch(np.array([7]), sampling))
        alone = retriever.embed_cells(batch, retriever.text_encoder.embed(features.labels)).global_vectors
    assert np.allclose(store.vectors(np.array([7])), alone, atol=1e-4), "an index has the trained encoder's features"
    other = {"small": "official", "official": "small"}[kind]
    with pytest.raises(WeightsError, match=f"kind '{kind}', but model.point_encoder is '{other}'"):
        train_retriever(load, tmp_path / "x", Mncl, MnclConfig(**options | {"point_encoder": other}), config)
    if kind == "small" and frozen:  # the configuration of a checkpoint from before these options
        record = json.loads((tmp_path / "w" / "config.json").read_text())
        for name in ("point_encoder", "points_frozen", "point_relations"):
            del record["retriever"][name]
        (tmp_path / "w" / "config.json").write_text(json.dumps(record))
        assert load_retriever(tmp_path / "w").config == retriever.config


def test_gradients_reach_the_point_encoder_through_points_drawn_anew(region, text_encoder, coarse, monkeypatch) -> None:
    torch.manual_seed(0)
    options = {"inputs": PAPER_INPUTS, "point_encoder": "official", "points_frozen": False, "point_relations": True}
    model = Mncl(text_encoder, MnclConfig(width=32, **options)).eval()
    model.points.requires_grad_(True)
    monkeypatch.setattr(region, "point_frame", model.points.frame)
    positions = region.usable[:4]
    drawn = [region.batch(positions, np.random.default_rng(seed)) for seed in (0, 1)]
    assert not torch.equal(drawn[0].cells.points, drawn[1].cells.points)
    cells = model.encode_points(drawn[0].cells)
    model.embed_cells(cells, region.label_embeddings).global_vectors.square().mean(dim=1).sum().backward()
    assert all(p.grad is not None for p in model.points.parameters())
    assert sum(float(p.grad.abs().sum()) for p in model.points.parameters()) > 0


def test_points_turn_with_their_cell(region) -> None:
    rows = np.array([1, 0])
    batch = region.features.batch(rows, PointSampling("cell"))
    turned = reflect_cells(batch, torch.from_numpy(SYMMETRIES[[4, 1]]))  # east and north change places; north is south
    assert batch.points is not None
    assert turned.points is not None
    row = 0
    for cell, size in enumerate(batch.mask.sum(dim=1).tolist()):
        for _ in range(size):
            x, y = batch.points[row, :, 0], batch.points[row, :, 1]
            expected = torch.stack([y, x] if cell == 0 else [x, -y], dim=-1)
            assert torch.equal(turned.points[row, :, :2], expected)
            row += 1
    assert row == len(turned.points)
    assert torch.equal(turned.points[..., 2:], batch.points[..., 2:]), "height and colour stay"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "model"),
    [(Mncl, MnclConfig(width=32)), (Text2Pos, Text2PosConfig(width=32, text="whole"))],
)
def test_a_data_set_trains_as_a_map_does(streets, tmp_path, method, model) -> None:
    config = TrainingConfig(steps=4, batch_size=16, validate_every=4)

    def load(encoder, rng):
        source = load_training_data(streets, ("train", "val"), encoder, config, rng)
        with pytest.raises(DataError, match="0042"):
            load_training_data(streets, ("0042", "val"), encoder, config, rng)
        batch = source.training.batch(source.training.draw(16, 4, rng), rng)
        assert batch.hint_mask.sum(dim=1).min() >= 2
        assert (batch.sentences[batch.hint_mask] >= 0).all()
        assert source.facts["scenes"] == {"train": [*TRAIN_STREETS], "val": [VAL_STREET]}
        return [source, source]

    recall = train_retriever(load, tmp_path / "w", method, model, config)
    assert 0 <= recall[1] <= recall[5] <= 1
    record = json.loads((tmp_path / "w" / "config.json").read_text())["training"]
    assert [source["positions"] > 0 for source in record["sources"]] == [True, True]
