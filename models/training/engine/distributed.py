"""Training in several processes that end where one process with the whole batch would end.

Each process encodes its share of the batch. The encodings are gathered with their gradients, so that every process has
the loss over all pairs; batch norm sees the whole batch; the gradients, averaged, are those of the whole batch.
In a single process every function here does nothing.
"""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import timedelta
from typing import Any, TypeVar

import torch
import torch.distributed as dist
from torch import Tensor, nn

from models.errors import TrainingError
from models.paper.levels import Levels

LONGEST_WAIT = timedelta(hours=4)  # the others wait while the first validates or encodes sentences
T = TypeVar("T")


@contextmanager
def process_group() -> Iterator[None]:
    """Join the processes that torchrun started, over nccl with GPUs and gloo without; alone, do nothing."""
    if int(os.environ.get("WORLD_SIZE", "1")) == 1:
        yield
        return
    if torch.cuda.is_available():
        torch.cuda.set_device(int(os.environ["LOCAL_RANK"]))
    dist.init_process_group("nccl" if torch.cuda.is_available() else "gloo", timeout=LONGEST_WAIT)
    try:
        yield
        dist.barrier()  # who leaves first breaks what the others still send
    finally:
        dist.destroy_process_group()


def world_size() -> int:
    """Number of processes."""
    return dist.get_world_size() if dist.is_initialized() else 1


def rank() -> int:
    """Number of this process, from 0."""
    return dist.get_rank() if dist.is_initialized() else 0


def is_first() -> bool:
    """Whether this is the process that validates, saves and shows progress."""
    return rank() == 0


def share_of(batch_size: int) -> int:
    """How much of a batch each process makes.

    Raises:
        TrainingError: it cannot be split evenly.
    """
    share, rest = divmod(batch_size, world_size())
    if rest:
        raise TrainingError(f"training.batch_size={batch_size} is no multiple of {world_size()} processes; change one")
    return share


def from_first(make: Callable[[], T]) -> T:
    """What `make` gives in the first process, in all of them; the others wait."""
    if world_size() == 1:
        return make()
    made: list[Any] = [make() if is_first() else None]
    dist.broadcast_object_list(made)
    value: T = made[0]
    return value


def gather_objects(own: T) -> list[T]:
    """Every process's object, in all of them."""
    if world_size() == 1:
        return [own]
    found: list[Any] = [None] * world_size()
    dist.all_gather_object(found, own)
    return found


def prepare(model: nn.Module) -> None:
    """Give every process the first one's weights, and batch norm the whole batch's mean and variance."""
    with torch.no_grad():
        for tensor in model.state_dict().values():
            dist.broadcast(tensor, src=0)
    _synchronise_batch_norm(model)


def average_gradients(model: nn.Module) -> None:
    """Replace each gradient by its mean over the processes; one that no process has stays None."""
    if world_size() == 1:
        return
    parameters = [p for p in model.parameters() if p.requires_grad]
    device = parameters[0].device
    present = torch.tensor([p.grad is not None for p in parameters], dtype=torch.float32, device=device)
    flat = torch.cat([(torch.zeros_like(p) if p.grad is None else p.grad).reshape(-1) for p in parameters] + [present])
    dist.all_reduce(flat)
    *means, present = (flat / world_size()).split([p.numel() for p in parameters] + [len(parameters)])
    for parameter, mean, anywhere in zip(parameters, means, present.tolist(), strict=True):
        parameter.grad = mean.view_as(parameter).clone() if anywhere else None


def gather(x: Tensor) -> Tensor:
    """[W * B, ...] the rows of all W processes in their order, with gradient; every process has [B, ...]."""
    if world_size() == 1:
        return x
    if x.is_floating_point():
        return _apply(_Gather, x)
    return _gathered(x)


def gather_levels(levels: Levels) -> Levels:
    """The descriptions or cells of all processes in their order, padded to the largest set of them, with gradient."""
    if world_size() == 1:
        return levels
    longest = torch.tensor(levels.mask.shape[1], device=levels.mask.device)
    dist.all_reduce(longest, dist.ReduceOp.MAX)
    missing = int(longest) - levels.mask.shape[1]

    def sets(x: Tensor | None) -> Tensor | None:
        return None if x is None else gather(nn.functional.pad(x, (0, 0, 0, missing)))

    # Numbers travel as bytes: not every backend has booleans.
    mask = gather(nn.functional.pad(levels.mask, (0, missing)).to(torch.uint8)).bool()
    return Levels(gather(levels.global_vectors), mask, sets(levels.instance), sets(levels.relation))


def gather_features(sentences: Tensor, features: Callable[[Tensor], Tensor]) -> tuple[Tensor, Tensor]:
    """Features of the different sentences of all processes, each read once, by one of them.

    Args:
        sentences: [B, H] int64, -1 where there is none; the same shape in every process.
        features: [s] sentences to [s, D].

    Returns:
        [S] the different sentences in ascending order, and [S, D] their features, with gradient.
    """
    different = torch.unique(gather(sentences))
    different = different[different >= 0]
    processes = world_size()
    if processes == 1:
        return different, features(different)
    if len(different) < processes:
        raise TrainingError(f"a batch of {len(different)} different sentences is too small for {processes} processes")
    own = features(different[rank() :: processes])
    share = -(-len(different) // processes)
    gathered = gather(nn.functional.pad(own, (0, 0, 0, share - len(own))))
    in_order = gathered.view(processes, share, -1).transpose(0, 1).reshape(processes * share, -1)
    return different, in_order[: len(different)]


def _gathered(x: Tensor) -> Tensor:
    parts = [torch.empty_like(x, memory_format=torch.contiguous_format) for _ in range(world_size())]
    dist.all_gather(parts, x.contiguous())
    return torch.cat(parts)


def _apply(function: type[torch.autograd.Function], x: Tensor) -> Tensor:
    result: Tensor = function.apply(x)
    return result


class _Gather(torch.autograd.Function):
    """Concatenation over the processes; backward, each process sums what all of them ask of its rows."""

    @staticmethod
    def forward(ctx: Any, x: Tensor) -> Tensor:
        ctx.rows = len(x)
        return _gathered(x)

    @staticmethod
    def backward(ctx: Any, gradient: Tensor) -> Tensor:
        total = gradient.contiguous().clone()
        dist.all_reduce(total)
        return total[rank() * ctx.rows : (rank() + 1) * ctx.rows]


class _Sum(torch.autograd.Function):
    """Sum over the processes, forward and backward."""

    @staticmethod
    def forward(ctx: Any, x: Tensor) -> Tensor:
        total = x.contiguous().clone()
        dist.all_reduce(total)
        return total

    @staticmethod
    def backward(ctx: Any, gradient: Tensor) -> Tensor:
        total = gradient.contiguous().clone()
        dist.all_reduce(total)
        return total


class SynchronisedBatchNorm(nn.modules.batchnorm._BatchNorm):
    """Batch norm over the rows of all processes; torch's own needs a GPU."""

    def forward(self, x: Tensor) -> Tensor:
        """Normalised [R, C, ...]; the number of rows R may differ between the processes."""
        if not self.training or world_size() == 1:
            return super().forward(x)
        dims = [d for d in range(x.ndim) if d != 1]
        shape = [1, -1] + [1] * (x.ndim - 2)
        values = x.float()
        count = _apply(_Sum, values.new_tensor(float(x.numel() // x.shape[1])))
        mean = _apply(_Sum, values.sum(dims)) / count
        centred = values - mean.view(shape)
        variance = _apply(_Sum, centred.square().sum(dims)) / count
        self._remember(mean.detach(), variance.detach() * count / (count - 1))
        normal = centred * torch.rsqrt(variance + self.eps).view(shape)
        if self.affine:
            normal = normal * self.weight.view(shape) + self.bias.view(shape)
        return normal.to(x.dtype)

    def _remember(self, mean: Tensor, variance: Tensor) -> None:
        if self.running_mean is None or self.running_var is None or self.num_batches_tracked is None:
            return
        self.num_batches_tracked += 1
        share = 1 / float(self.num_batches_tracked) if self.momentum is None else self.momentum
        self.running_mean.lerp_(mean, share)
        self.running_var.lerp_(variance, share)

    def _check_input_dim(self, input: Tensor) -> None:
        """Any number of dimensions."""


def _synchronise_batch_norm(model: nn.Module) -> None:
    """Replace batch norm by the synchronised kind, with the same parameters and names."""
    for name, child in model.named_children():
        if isinstance(child, nn.modules.batchnorm._BatchNorm):
            norm = SynchronisedBatchNorm(
                child.num_features, child.eps, child.momentum, child.affine, child.track_running_stats
            )
            for key, parameter in child._parameters.items():
                norm._parameters[key] = parameter
            for key, buffer in child._buffers.items():
                norm._buffers[key] = buffer
            setattr(model, name, norm.train(child.training))
        else:
            _synchronise_batch_norm(child)
