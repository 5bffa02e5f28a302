"""The directory of a training run.

    config.json          the settings
    metrics.csv          one row per validation
    curves.png           the loss and the metrics over the steps
    best.safetensors     the weights of the best validation so far
    state.safetensors    model, best weights, optimiser, schedule, random generators and counters, to resume the run

All files are safetensors, JSON, CSV or PNG, so reading them runs no code. Each file is replaced atomically.
"""

import csv
import io
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Protocol

import torch
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from safetensors import SafetensorError, safe_open
from safetensors.torch import save
from torch import Tensor, nn

from models.errors import TrainingError
from models.files import replace_file

CONFIG_FILE, METRICS_FILE, CURVES_FILE = "config.json", "metrics.csv", "curves.png"
BEST_FILE, STATE_FILE = "best.safetensors", "state.safetensors"
_OPTIMIZER, _MODEL, _BEST, _GENERATOR = "optimizer.", "model.", "best.", "generator."


@dataclass(frozen=True, slots=True)
class ValidationRow:
    """The results of a validation, a row of metrics.csv."""

    step: int
    seconds: float  # since the start, with validations but without the pauses of a resumed run
    loss: float  # mean loss since the last validation
    learning_rate: float  # of the last step
    descriptions_per_second: float  # examples trained on since the last validation
    figures: dict[str, float]  # metrics of the task's `validate`

    def flat(self) -> dict[str, float]:
        """Return the columns of metrics.csv."""
        values = asdict(self)
        figures: dict[str, float] = values.pop("figures")
        return values | figures


class _Stateful(Protocol):
    def state_dict(self) -> dict[str, Any]: ...
    def load_state_dict(self, state_dict: dict[str, Any]) -> Any: ...


@dataclass(frozen=True, slots=True, eq=False)
class RunState:
    """The state from which a run can be resumed."""

    tensors: dict[str, Tensor]
    facts: dict[str, Any]  # everything else, in the form of JSON

    @classmethod
    def capture(
        cls,
        model: nn.Module,
        best_weights: dict[str, Tensor],
        optimizer: torch.optim.Optimizer,
        others: Sequence[_Stateful],
        numpy_generator: Mapping[str, Any],
        torch_generators: list[Tensor],
        rows: Sequence[ValidationRow],
        counters: dict[str, Any],
    ) -> "RunState":
        """Return the state of a run; `others` are the schedule and the scaler."""
        state = optimizer.state_dict()
        tensors = {_MODEL + name: tensor for name, tensor in model.state_dict().items()}
        tensors |= {_BEST + name: tensor for name, tensor in best_weights.items()}
        tensors |= {f"{_OPTIMIZER}{n}.{key}": t for n, values in state["state"].items() for key, t in values.items()}
        tensors |= {f"{_GENERATOR}{n}": t for n, t in enumerate(torch_generators)}
        facts = {
            "groups": state["param_groups"],
            "others": [other.state_dict() for other in others],
            "generator": numpy_generator,
            "rows": [asdict(row) for row in rows],
            "counters": counters,
        }
        return cls(tensors, facts)

    @property
    def counters(self) -> dict[str, Any]:
        """The counters of the loop."""
        return self.facts["counters"]

    @property
    def rows(self) -> list[ValidationRow]:
        """Validations so far."""
        return [ValidationRow(**row) for row in self.facts["rows"]]

    def load_into(self, model: nn.Module, optimizer: torch.optim.Optimizer, others: Sequence[_Stateful]) -> None:
        """Restore model, optimiser, schedule and scaler."""
        model.load_state_dict(self._part(_MODEL))
        moments: dict[int, dict[str, Tensor]] = {}
        for name, tensor in self._part(_OPTIMIZER).items():
            number, key = name.split(".", 1)
            moments.setdefault(int(number), {})[key] = tensor
        optimizer.load_state_dict({"state": moments, "param_groups": self.facts["groups"]})
        for other, state in zip(others, self.facts["others"], strict=True):
            other.load_state_dict(state)

    def best_weights(self, device: torch.device) -> dict[str, Tensor]:
        """Return the best weights so far, on a device."""
        return {name: tensor.to(device) for name, tensor in self._part(_BEST).items()}

    def generators(self) -> tuple[dict[str, Any], list[Tensor]]:
        """Return the states of NumPy's generator and of torch's."""
        return self.facts["generator"], list(self._part(_GENERATOR).values())

    def _part(self, prefix: str) -> dict[str, Tensor]:
        return {name[len(prefix) :]: self.tensors[name] for name in sorted(self.tensors) if name.startswith(prefix)}


class RunDir:
    """A run directory, created by `open`; the module describes its files."""

    def __init__(self, path: Path) -> None:
        self.path = path

    @classmethod
    def open(cls, path: Path, resume: bool, record: dict[str, Any]) -> "RunDir":
        """Create a run directory, or open one to resume its run.

        Raises:
            TrainingError: the directory has a run that is not to be resumed, or one with other settings.
        """
        path.mkdir(parents=True, exist_ok=True)
        run_dir = cls(path)
        record = json.loads(json.dumps(record))  # as it will be loaded
        if (path / STATE_FILE).is_file():
            if not resume:
                raise TrainingError(f"{path} already has a run; continue it with --resume, or use another directory")
            try:
                before = json.loads((path / CONFIG_FILE).read_text())
            except (OSError, ValueError) as error:
                raise TrainingError(f"{path / CONFIG_FILE} cannot be read ({error}); use another directory") from error
            if before != record:
                changed = ", ".join(sorted(_differences(before, record)))
                raise TrainingError(
                    f"{path} has a run with other settings ({changed}); use the same settings, or another directory"
                )
        replace_file(path / CONFIG_FILE, (json.dumps(record, indent=2) + "\n").encode())
        return run_dir

    def load_state(self) -> RunState | None:
        """Load the state of the run; None if there is none.

        Raises:
            TrainingError: the file is broken.
        """
        path = self.path / STATE_FILE
        if not path.is_file():
            return None
        try:
            with safe_open(path, framework="pt") as file:
                return RunState(
                    {n: file.get_tensor(n) for n in list(file.keys())}, json.loads(file.metadata()["facts"])
                )
        except (SafetensorError, ValueError, KeyError) as error:
            raise TrainingError(f"{path} cannot be read ({error}); start again in another directory") from error

    def write(
        self, rows: Sequence[ValidationRow], criterion: str, best_weights: dict[str, Tensor], state: RunState
    ) -> None:
        """Write the results of all validations so far, and the state last; `criterion` is for the curves."""
        replace_file(self.path / METRICS_FILE, _table(rows))
        replace_file(self.path / CURVES_FILE, _curves(rows, criterion))
        replace_file(self.path / BEST_FILE, save(_plain(best_weights)))
        metadata = {"facts": json.dumps(state.facts)}
        replace_file(self.path / STATE_FILE, save(_plain(state.tensors), metadata))


def _plain(tensors: dict[str, Tensor]) -> dict[str, Tensor]:
    return {name: tensor.detach().cpu().contiguous() for name, tensor in tensors.items()}


def _differences(before: Any, now: Any, prefix: str = "") -> Iterable[str]:
    if not (isinstance(before, dict) and isinstance(now, dict)):
        return [prefix] if before != now else []
    return [
        name
        for key in before.keys() | now.keys()
        for name in _differences(before.get(key), now.get(key), f"{prefix}.{key}".lstrip("."))
    ]


def _table(rows: Sequence[ValidationRow]) -> bytes:
    lines = io.StringIO()
    writer = csv.DictWriter(lines, list(rows[0].flat()), lineterminator="\n")
    writer.writeheader()
    writer.writerows(row.flat() for row in rows)
    return lines.getvalue().encode()


def _curves(rows: Sequence[ValidationRow], criterion: str) -> bytes:
    """Draw the loss, and the recalls or the criterion, over the steps; return a PNG."""
    figure = Figure(figsize=(9.0, 3.8), layout="constrained", dpi=150)
    loss_axes, metric_axes = figure.subplots(1, 2)
    steps = [row.step for row in rows]
    loss_axes.plot(steps, [row.loss for row in rows], marker="o", ms=3, color="#1d3557")
    loss_axes.set(xlabel="step", ylabel="loss")
    shown = [name for name in rows[0].figures if name == criterion or "recall" in name]
    for name in shown:
        style = "-" if name == criterion else ":"
        metric_axes.plot(steps, [row.figures[name] for row in rows], style, marker="o", ms=3, label=name)
    metric_axes.set(xlabel="step", title="validation")
    metric_axes.legend(frameon=False, fontsize=8)
    for axes in (loss_axes, metric_axes):
        axes.grid(alpha=0.3)
    picture = io.BytesIO()
    FigureCanvasAgg(figure).print_png(picture)
    return picture.getvalue()
