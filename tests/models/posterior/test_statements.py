import numpy as np
import pytest
import torch
from scipy.sparse import csc_array

from models.errors import IndexBroken
from models.posterior import statements as statements_module
from models.posterior.likelihood import BoundHints, Likelihood
from models.posterior.neighbours.neighbour_index import build_neighbour_index
from models.posterior.node_batch import NodeBatch
from models.posterior.statements import _SECTOR_OF_RELATION, FILE, MIN_HINT_SHARE, SECTORS, Statements


@pytest.fixture(scope="module")
def given(source):
    """Return the arguments of `statement_rows`."""
    surroundings = build_neighbour_index(source.geometry(), source.data.cells)
    rgb, likelihood = torch.from_numpy(surroundings.objects.rgb), Likelihood()
    label = torch.from_numpy(surroundings.objects.labels(source.data.gallery)[1])
    return likelihood, surroundings, label, rgb, likelihood.colour_word_p(rgb, source.data.palette)


@pytest.fixture(scope="module")
def statements(given):
    return Statements.from_gallery(*given)


def _holds(statements: Statements) -> csc_array:
    """[N, F] how much of each cell's nodes a statement holds at."""
    columns = statements.share.astype(np.float32), statements.cell, statements.starts
    return csc_array(columns, (statements.cells, len(statements.number)))


@torch.inference_mode()
def test_a_statement_holds_in_a_cell_as_far_as_what_it_says_is_told_of_there(given, statements) -> None:
    likelihood, surroundings, label, rgb, words = given
    for cell in (0, 17, 60):
        nodes = np.arange(surroundings.cell_starts[cell], surroundings.cell_starts[cell + 1])
        around = surroundings.around(nodes)
        batch = NodeBatch.from_neighbours(
            around, len(nodes), label, rgb, torch.from_numpy(surroundings.objects.is_vague)
        )
        share = likelihood.mention_share(batch, likelihood.log_pi()).mean(dim=1)
        naive = {}
        for part, (east, north), p in zip(around.part, around.offset_m, share.tolist(), strict=True):
            word = statements.words if rgb[part].isnan().any() else int(words[part].argmax())
            sector = 8 if np.hypot(east, north) < 1.5 else round(float(np.degrees(np.arctan2(east, north))) / 45) % 8
            key = (int(label[part]) * (statements.words + 1) + word) * SECTORS + sector
            naive[key] = naive.get(key, 0.0) + p / len(nodes)
        row = _holds(statements).toarray()[cell]
        assert set(statements.number[row > 0].tolist()) == set(naive)
        assert row[row > 0] == pytest.approx([naive[int(n)] for n in statements.number[row > 0]], rel=1e-3)


@pytest.mark.parametrize("cells_per_slice", [10**6, 7])
def test_scores_are_those_of_a_naive_sum(statements, cells_per_slice, monkeypatch) -> None:
    monkeypatch.setattr(statements_module, "CELLS_PER_SLICE", cells_per_slice)
    rng, labels, words = np.random.default_rng(0), int(statements.label.max()) + 1, statements.words
    relation, label, colour = (torch.from_numpy(rng.dirichlet([0.3] * n, 3)).float() for n in (10, labels, words + 1))
    absent = torch.tensor([0.0, 0.2, 1.0])
    reading = BoundHints(relation, label, colour, torch.full((3,), torch.nan), absent)
    scores = statements.scores(reading)
    of_sector = relation @ _SECTOR_OF_RELATION
    holds, naive = _holds(statements).toarray(), np.full((holds_rows := statements.cells, 3), MIN_HINT_SHARE)
    for n, (class_number, word, sector) in enumerate(
        zip(statements.label, statements.word, statements.sector, strict=True)
    ):
        is_stated = 0.3 * torch.ones(3) if word == words else colour[:, word] + colour[:, words]
        naive += holds[:, [n]] * (label[:, class_number] * is_stated * of_sector[:, sector]).numpy()
    truth = np.log(naive) @ (1 - absent.numpy())
    assert len(scores) == holds_rows
    assert scores == pytest.approx(truth, abs=0.2), "but for what is faint"
    assert np.abs(scores - truth).mean() < 0.02 < truth.std()
    for subset in (range(3, 12), range(20, 21), range(5, statements.cells), range(0)):
        alone = statements.scores(reading, subset)
        assert (alone[subset.start : subset.stop] == scores[subset.start : subset.stop]).all()
        assert np.isneginf(np.delete(alone, subset)).all()


def test_several_processes_make_what_one_makes(given, statements, monkeypatch) -> None:
    monkeypatch.setattr(statements_module, "CELLS_PER_BLOCK", 20)
    again = Statements.from_gallery(*given)
    assert (again.number == statements.number).all()
    assert (_holds(again) != _holds(statements)).nnz == 0


def test_saved_statements_come_back_for_the_model_that_made_them(statements, tmp_path) -> None:
    statements.save(tmp_path, "this model")
    again = Statements.load(tmp_path, "this model")
    assert again is not None
    assert (_holds(again) != _holds(statements)).nnz == 0
    assert again.cells == statements.cells
    for name in ("number", "label", "word", "sector"):
        assert (getattr(again, name) == getattr(statements, name)).all()
    assert Statements.load(tmp_path, "another model") is None
    (tmp_path / FILE).write_bytes(b"no")
    with pytest.raises(IndexBroken, match="hereabouts index"):
        Statements.load(tmp_path, "this model")
