"""Where things are computed while training.

`loop.pick_device` picks. What `run_training` trains is moved there, and a task brings each batch along in its `loss`.
The frozen text encoder, and what else a run needs there, is lent to the device by `lent_to`. Examples and frozen
features are kept on the CPU.

All else is on the CPU: the likelihood, the kernels of places and all of `train_places`, and whatever answers.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import torch
from torch import nn


@contextmanager
def lent_to(device: torch.device, *modules: nn.Module) -> Iterator[None]:
    """Have modules on a device, and on the CPU again afterwards: others in this process use them."""
    try:
        for module in modules:
            module.to(device)
        yield
    finally:
        for module in modules:
            module.cpu()
