"""Messages between the service and its worker processes."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from index.build.artifact import open_version

if TYPE_CHECKING:
    from index.answering.localizer import Localizer

FORK: Final = "fork"


class WorkerFault(Exception):
    """An internal error in a worker; its redacted traceback has no messages, which may quote a description."""

    def __init__(self, message: str, redacted_traceback: str = "") -> None:
        super().__init__(message)
        self.redacted_traceback = redacted_traceback


@dataclass(frozen=True, slots=True)
class LocalizerSpec:
    """The arguments of `index.answering.localizer.Localizer.open`."""

    index_dir: Path
    weights_dir: Path | None = None
    fine_weights_dir: Path | None = None
    posterior_weights_dir: Path | None = None

    def open(self) -> "Localizer":
        """Open and warm up the localizer. `app.workers.checksums` verifies its files later."""
        from index.answering.localizer import Localizer  # noqa: PLC0415  # imports torch, which takes seconds

        dirs = self.weights_dir, self.fine_weights_dir, self.posterior_weights_dir
        try:
            localizer = Localizer.open(self.index_dir, *dirs, with_sums=False)
            localizer.warm()
        except Exception:
            open_version(self.index_dir)  # if a file is corrupt, this error names it
            raise
        return localizer
