import pytest
import torch
from safetensors.torch import load_file
from torch import nn

from models.errors import TrainingError
from models.training.engine import distributed
from tests.models.training.engine import two_processes

pytestmark = pytest.mark.slow  # processes of their own


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    """What two processes over gloo wrote, and one alone."""
    directory = tmp_path_factory.mktemp("processes")
    torch.multiprocessing.spawn(two_processes.run, args=(directory,), nprocs=2)
    two_processes.one_step(directory)
    return directory


def test_two_processes_have_the_loss_and_the_gradients_of_one(out) -> None:
    alone = load_file(out / "step-1-0")
    assert alone["loss"] > 0
    assert sum(name.startswith("gradient.") for name in alone) > 50
    for rank in (0, 1):
        together = load_file(out / f"step-2-{rank}")
        assert together.keys() == alone.keys()
        for name, expected in alone.items():
            assert torch.allclose(together[name], expected, rtol=1e-4, atol=1e-5), name


def test_two_processes_end_with_the_same_weights_broken_or_not(out) -> None:
    first = load_file(out / "unbroken-0")
    for name in ("unbroken-1", "resumed-0", "resumed-1"):
        other = load_file(out / name)
        assert all(torch.equal(first[key], other[key]) for key in first), name
    assert (out / "run" / "metrics.csv").read_text().count("\n") == 4


def test_two_processes_draw_different_examples(out) -> None:
    from safetensors import safe_open

    with safe_open(out / "run" / "state.safetensors", framework="pt") as file:
        assert {"generator.0.0", "generator.1.0"} <= set(file.keys())
        one, two = (file.get_tensor(f"generator.{rank}.0") for rank in (0, 1))
    assert not torch.equal(one, two)


def test_the_number_of_processes_is_part_of_a_run(out) -> None:
    with pytest.raises(TrainingError, match="2 processes"):
        two_processes.run_training(two_processes.Task(), two_processes.LOOP, out / "run", resume=True)


def test_a_batch_must_split_evenly(monkeypatch) -> None:
    monkeypatch.setattr(distributed, "world_size", lambda: 3)
    with pytest.raises(TrainingError, match="batch_size=128"):
        distributed.share_of(128)
    assert distributed.share_of(126) == 42


def test_alone_nothing_is_gathered_and_batch_norm_is_torchs(tmp_path) -> None:
    x = torch.randn(6, 4, generator=torch.Generator().manual_seed(0))
    assert distributed.gather(x) is x
    inner = nn.Sequential(nn.BatchNorm1d(4))
    model = nn.Sequential(nn.Linear(4, 4), inner)
    expected = model(x)
    names = list(model.state_dict())
    torch.distributed.init_process_group("gloo", init_method=f"file://{tmp_path}/meet", rank=0, world_size=1)
    try:
        distributed.prepare(model)
    finally:
        torch.distributed.destroy_process_group()
    assert isinstance(inner[0], distributed.SynchronisedBatchNorm)
    assert list(model.state_dict()) == names
    assert torch.equal(model(x), expected)
