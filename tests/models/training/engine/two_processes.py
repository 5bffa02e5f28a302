"""What the processes of test_distributed.py run; a module of its own, because each of them imports it."""

import os
from types import SimpleNamespace
from typing import Any

import numpy as np
import torch
import torch.distributed as dist
from safetensors.torch import save_file
from torch import nn

from models.language.text_encoder import TokenFeatures
from models.paper.instance_encoder import GEOMETRY_WIDTH, CellBatch
from models.paper.mncl import Mncl, MnclConfig
from models.training.engine import distributed
from models.training.engine.loop import LoopConfig, run_training
from models.training.fit_retriever import RetrievalTask, SourceBatch
from models.training.retrieval_data import Batch

WIDTH, SENTENCES, LABELS = 12, 9, 4
CONFIG = MnclConfig(width=16, dropout=0.0, loss_temperature=0.5)
LOOP = LoopConfig(steps=6, batch_size=8, validate_every=2, learning_rate=1e-2)


class Vocabulary:
    """Sentences of random token features."""

    def __init__(self) -> None:
        rng = torch.Generator().manual_seed(1)
        self.values = torch.randn(SENTENCES, 5, WIDTH, generator=rng)

    def tokens(self, sentences):
        shape = (len(sentences), 5)
        return TokenFeatures(self.values[sentences], torch.ones(shape, dtype=torch.bool), torch.zeros(shape).long())


class Training:
    """What a task looks up while training."""

    def __init__(self) -> None:
        self.vocabulary = Vocabulary()
        self.label_embeddings = torch.randn(LABELS, WIDTH, generator=torch.Generator().manual_seed(2))

    def __len__(self) -> int:
        return 1

    def to(self, device) -> None:
        pass


class Task(RetrievalTask):
    """Random examples; in training, each process draws its own."""

    def __init__(self) -> None:
        torch.manual_seed(distributed.rank())  # so that broadcasting is needed
        if not dist.is_initialized():
            torch.manual_seed(0)
        sources: Any = [SimpleNamespace(training=Training())]
        model = Mncl(SimpleNamespace(width=WIDTH, source="random", fingerprint=""), CONFIG)
        super().__init__(model, sources, LOOP.batch_size, 1)
        self.times_validated = 0

    def batch(self, rng):
        return SourceBatch(0, part(whole_batch(rng), slice(0, self.share)))

    def validate(self):
        self.times_validated += 1
        return {"recall@5": float(self.times_validated)}


def whole_batch(rng) -> Batch:
    """8 examples; the cells of the second half are larger, two rows are of one cell, sentences come twice."""
    sizes = np.array([1, 3, 2, 3, 5, 4, 2, 6])
    mask = torch.from_numpy(np.arange(6) < sizes[:, None])
    geometry = torch.from_numpy(rng.normal(size=(8, 6, GEOMETRY_WIDTH)).astype(np.float32)) * mask[..., None]
    label = torch.from_numpy(rng.integers(LABELS, size=(8, 6)))
    hint_mask = torch.from_numpy(np.arange(4) < rng.integers(2, 5, size=(8, 1)))
    sentences = torch.from_numpy(rng.integers(SENTENCES, size=(8, 4)))
    cell = torch.tensor([0, 1, 2, 3, 4, 1, 6, 7])
    return Batch(CellBatch(geometry, label, mask, torch.zeros(8, 6, 0)), sentences, hint_mask, cell)


def part(batch: Batch, rows: slice) -> Batch:
    """Some rows, padded to the largest cell of them only."""
    largest = int(batch.cells.mask[rows].sum(dim=1).max())
    part = batch.cells
    cells = (x[rows, :largest] for x in (part.geometry, part.label, part.mask, part.point_features))
    return Batch(CellBatch(*cells), batch.sentences[rows], batch.hint_mask[rows], batch.cell[rows])


def one_step(out) -> None:
    """Loss, gradients and batch norm's memory on the whole batch, or on this process's part of it, into a file."""
    task = Task()
    if distributed.world_size() > 1:
        distributed.prepare(task.model)
    batch = whole_batch(np.random.default_rng(5))
    rows = slice(distributed.rank() * task.share, (distributed.rank() + 1) * task.share)
    task.model.train()
    loss = task.loss(SourceBatch(0, part(batch, rows)))
    loss.backward()
    distributed.average_gradients(task.model)
    found = {f"gradient.{name}": p.grad for name, p in task.model.named_parameters() if p.grad is not None}
    found |= {f"buffer.{name}": buffer for name, buffer in task.model.named_buffers()}
    save_file({"loss": loss.detach(), **found}, out / f"step-{distributed.world_size()}-{distributed.rank()}")


def train(out) -> None:
    """A run and, from a kill in its middle, another that ends the same; their weights into files."""

    def weights(task: Task, name: str) -> None:
        save_file(task.model.state_dict(), out / f"{name}-{distributed.rank()}")

    task = Task()
    shown = []
    history = run_training(task, LOOP, out / "run", progress=lambda at: shown.append(at.step))
    first = distributed.is_first()
    assert task.times_validated == (3 if first else 0)
    assert shown == (list(range(1, 7)) if first else [])
    assert (history.best_step, history.best) == (6, 3.0), "every process knows"
    weights(task, "unbroken")

    class Killed(Exception):
        pass

    class Broken(Task):
        drawn = 0

        def batch(self, rng):
            self.drawn += 1
            if self.drawn == 4:
                raise Killed
            return super().batch(rng)

    try:
        run_training(Broken(), LOOP, out / "killed")
    except Killed:
        distributed.gather_objects(None)  # the first has written what stands at step 2
    resumed = Task()
    run_training(resumed, LOOP, out / "killed", resume=True)
    weights(resumed, "resumed")


def unused_parameter() -> None:
    """The mean of gradients that only some of the processes have, or none."""
    layers = nn.ModuleList(nn.Linear(1, 1, bias=False) for _ in range(3))
    layers[0].weight.grad = torch.full((1, 1), float(distributed.rank()))
    if distributed.is_first():
        layers[1].weight.grad = torch.ones(1, 1)
    distributed.average_gradients(layers)
    assert [None if x.weight.grad is None else x.weight.grad.item() for x in layers] == [0.5, 0.5, None]


def run(rank: int, out) -> None:
    """The work of one process of two."""
    torch.set_num_threads(1)
    dist.init_process_group("gloo", init_method=f"file://{out / 'meet'}", rank=rank, world_size=2)
    try:
        one_step(out)
        unused_parameter()
        train(out)
        assert distributed.from_first(lambda: rank) == 0
        dist.barrier()  # who leaves first breaks what the other still sends
    finally:
        dist.destroy_process_group()
    os._exit(0)  # gloo's threads end some processes with SIGABRT as they go, when all is done and written
