"""A device that computes on the CPU and mixes with nothing that lies there, as a GPU; to be imported once a process.

Its tensors hold CPU tensors. Every operation comes by `_run`, which refuses what CUDA refuses: a tensor of each kind in
one operation, unless the CPU's is a single number or an index.
"""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import torch
from torch import Tensor
from torch.utils.backend_registration import _DummyBackendModule, _setup_privateuseone_for_python_backend

aten = torch.ops.aten
COPIES = {aten._to_copy, aten.copy_, aten._copy_from}
INDEXING = {aten.index, aten.index_put, aten.index_put_, aten._index_put_impl_, aten._unsafe_index_put}
PACKED = {aten._pack_padded_sequence, aten.lstm}  # lengths and sizes of steps are always on the CPU
MAKERS = ("arange", "arange.start", "arange.start_step", "eye")  # resize what torch makes empty for them
TAKE_NUMBERS = {aten.where, aten.masked_fill, aten.masked_fill_, *INDEXING}  # beside what works a number at a time


class Backend(_DummyBackendModule):
    """The device module that torch requires."""

    def get_amp_supported_dtype(self) -> list[torch.dtype]:
        return [torch.bfloat16]


_setup_privateuseone_for_python_backend("fake", backend_module=Backend())
FAKE = torch.device("fake", 0)


class Away(Tensor):
    """A tensor on the device; `made` counts them."""

    made = 0
    on_cpu: Tensor

    @staticmethod
    def __new__(cls, on_cpu: Tensor) -> "Away":
        with torch.inference_mode(False):  # views of others must be as these
            layout = {"strides": on_cpu.stride(), "storage_offset": on_cpu.storage_offset(), "dtype": on_cpu.dtype}
            made = torch.Tensor._make_wrapper_subclass(cls, on_cpu.size(), device=FAKE, **layout)
        made.on_cpu = on_cpu
        Away.made += 1
        return made

    @classmethod
    def __torch_dispatch__(cls, func: Any, types: Any, args: Any = (), kwargs: Any = None) -> Any:  # type: ignore[override]
        return _run(func, *args, **(kwargs or {}))

    def tolist(self) -> Any:
        return self.on_cpu.tolist()

    def __repr__(self, *, tensor_contents: Any = None) -> str:  # type: ignore[override]
        return f"Away({self.on_cpu})"


def _run(operation: Any, *args: Any, **kwargs: Any) -> Any:
    """Compute on the CPU what is asked of the device."""
    tensors = list(_tensors([*args, *kwargs.values()]))
    away = [x for x in tensors if isinstance(x, Away)]
    if away and len(away) < len(tensors):
        _refuse(operation, [*args, *kwargs.values()])
    device = torch.device(kwargs.get("device") or (FAKE if away else "cpu"))
    if kwargs.get("device") is not None:
        kwargs["device"] = torch.device("cpu")
    if operation.overloadpacket in PACKED and isinstance(args[1], Away):
        raise RuntimeError(f"{operation} wants its lengths on the CPU")
    compute = LSTM.get(operation.overloadpacket, operation)
    result = compute(*_map(_unwrap, args), **{name: _map(_unwrap, x) for name, x in kwargs.items()})
    if operation.overloadpacket is aten._pack_padded_sequence:
        return Away(result[0]), result[1]
    assert all(x.shape == x.on_cpu.shape for x in away), f"{operation} resizes a tensor, which is not told of it"
    if device.type != "fake":
        return result
    same = {id(x.on_cpu): x for x in away}
    return _map(lambda x: (same[id(x)] if id(x) in same else Away(x)) if isinstance(x, Tensor) else x, result)


def _tensors(given: Any) -> Iterator[Tensor]:
    for x in given:
        if isinstance(x, Tensor):
            yield x
        elif isinstance(x, list | tuple):
            yield from _tensors(x)


def _map(function: Callable[[Any], Any], x: Any) -> Any:
    """Apply a function to each leaf of the arguments or results of an operation."""
    return type(x)([_map(function, part) for part in x]) if type(x) in (list, tuple) else function(x)


def _unwrap(x: Any) -> Any:
    return x.on_cpu if isinstance(x, Away) else x


def _refuse(operation: Any, operands: list[Any]) -> None:
    """Raise where a GPU would."""
    packet = operation.overloadpacket
    if packet in COPIES:
        return
    if packet in INDEXING | PACKED and isinstance(operands[0], Away):
        operands = [operands[0], *operands[2:]]
    behind = [x for x in _tensors(operands) if not isinstance(x, Away)]
    numbers = torch.Tag.pointwise in operation.tags or packet in TAKE_NUMBERS
    written = operation._schema.is_mutable and not isinstance(operands[0], Away)
    if behind and (written or not numbers or any(x.dim() for x in behind)):
        raise RuntimeError(f"{operation} of tensors on {FAKE} and on the CPU {[tuple(x.shape) for x in behind]}")


def _lstm_cell(x: Tensor, h: Tensor, c: Tensor, *biases: Tensor) -> tuple[Tensor, ...]:
    """New hidden and cell state, and the gates, which the CPU has no such operation for."""
    i, f, g, o = sum(biases, x + h).chunk(4, dim=1)
    i, f, g, o = i.sigmoid(), f.sigmoid(), g.tanh(), o.sigmoid()
    cell = f * c + i * g
    return o * cell.tanh(), cell, torch.cat([i, f, g, o], dim=1)


def _lstm_cell_backward(
    by_hidden: Tensor | None, by_cell: Tensor | None, before: Tensor, cell: Tensor, gates: Tensor, has_bias: bool
) -> tuple[Tensor, ...]:
    """Gradients by the gates, the cell state before and the bias."""
    i, f, g, o = gates.chunk(4, dim=1)
    h = torch.zeros_like(cell) if by_hidden is None else by_hidden
    c = h * o * (1 - cell.tanh() ** 2) + (0.0 if by_cell is None else by_cell)
    by_gates = [c * g * i * (1 - i), c * before * f * (1 - f), c * i * (1 - g**2), h * cell.tanh() * o * (1 - o)]
    whole = torch.cat(by_gates, dim=1)
    return whole, c * f, whole.sum(dim=0)


LSTM = {aten._thnn_fused_lstm_cell: _lstm_cell, aten._thnn_fused_lstm_cell_backward_impl: _lstm_cell_backward}


def _copy_from(source: Tensor, target: Tensor, non_blocking: bool = False) -> Tensor:
    _unwrap(target).copy_(_unwrap(source))
    return target


OTHERS = torch.library.Library("_", "IMPL")
OTHERS.fallback(_run, "PrivateUse1")  # what makes tensors out of none
OURS = torch.library.Library("aten", "IMPL")
OURS.impl("_copy_from", _copy_from, "PrivateUse1")
for name in MAKERS:
    packet, _, overload = name.partition(".")
    OURS.impl(name, partial(_run, getattr(getattr(aten, packet), overload or "default")), "PrivateUse1")
