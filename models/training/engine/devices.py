"""Devices in training.

`loop.pick_device` selects the device. `run_training` moves the model there; a task moves each batch in its `loss`. The
frozen text encoder is there only inside `on_device`. Examples and frozen features stay on the CPU, and so do the
likelihood, the place kernels, all of `train_places`, and everything that answers queries, except in `reproduce`: it
encodes the cells and texts that it measures on the device of the training.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import torch
from torch import nn


@contextmanager
def on_device(device: torch.device, *modules: nn.Module) -> Iterator[None]:
    """Move modules to a device, and back to the CPU at the end, where other code of this process uses them."""
    try:
        for module in modules:
            module.to(device)
        yield
    finally:
        for module in modules:
            module.cpu()
