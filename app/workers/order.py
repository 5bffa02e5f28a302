"""What is said between the service and the processes that hold a model."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from index.build.artifact import open_version

if TYPE_CHECKING:
    from index.answering.localizer import Localizer

FORK: Final = "fork"


class WorkerFault(Exception):
    """A fault in a worker, with its traceback.

    Attributes:
        where: the same without its words, which may quote a description.
    """

    def __init__(self, said: str, where: str = "") -> None:
        super().__init__(said)
        self.where = where


@dataclass(frozen=True, slots=True)
class OpenOrder:
    """What to open; as `index.answering.localizer.Localizer.open`."""

    index_dir: Path
    weights_dir: Path | None = None
    fine_weights_dir: Path | None = None
    posterior_weights_dir: Path | None = None

    def open(self) -> "Localizer":
        """The localizer, with everything read that its usual queries need; `app.workers.checksums` checks the files.

        Raises:
            HereaboutsError: as `Localizer.open`.
        """
        from index.answering.localizer import Localizer  # noqa: PLC0415  # brings torch, which takes seconds

        dirs = self.weights_dir, self.fine_weights_dir, self.posterior_weights_dir
        try:
            localizer = Localizer.open(self.index_dir, *dirs, with_sums=False)
            localizer.warm()
        except Exception:
            open_version(self.index_dir)  # which names the file, if one was changed
            raise
        return localizer
