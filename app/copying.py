"""Keeping the copy of an index that is elsewhere like it, on a thread beside the service."""

import threading
from pathlib import Path
from typing import TYPE_CHECKING, Final

import structlog

from models.errors import HereaboutsError
from models.files import cache_directory

if TYPE_CHECKING:
    from index.remote.copy import LocalCopy

LOOKED_AT_S: Final = 5.0  # how often the aliases there are read: a bucket counts each time
LONGEST_S: Final = 60.0  # between two tries while it does not answer; each is twice as long as the one before
ENDS_S: Final = 1.0  # that the end of the service waits for a file that is being fetched; the next start removes it

log = structlog.get_logger()


class Copying:
    """Refreshes a local copy now and then; what goes wrong is logged once, and tried again.

    Args:
        copy: what to refresh.
        directory: where it is, for whoever serves it.
    """

    def __init__(self, copy: "LocalCopy", directory: Path) -> None:
        self._copy, self.directory = copy, directory
        self._ends = threading.Event()
        self._thread: threading.Thread | None = None
        self._failed = False

    @classmethod
    def of(cls, url: str) -> "Copying":
        """That of the index behind a URL, in the cache directory.

        Raises:
            RemoteUnavailable: it is no URL, or what speaks its protocol is not installed.
        """
        from index.remote.copy import LocalCopy, copy_directory  # noqa: PLC0415  # few have an index elsewhere
        from index.remote.place import Place  # noqa: PLC0415

        directory = copy_directory(cache_directory(), url)
        return cls(LocalCopy(Place(url), directory), directory)

    def start(self) -> None:
        """Begin to fetch."""
        self._ends.clear()
        self._thread = threading.Thread(target=self._run, name="copying", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End, and leave what is half fetched."""
        self._ends.set()
        if self._thread is not None:
            self._thread.join(ENDS_S)

    def _run(self) -> None:
        wait_s = 0.0
        while not self._ends.wait(wait_s):
            wait_s = LOOKED_AT_S if self._refreshed() else min(max(LOOKED_AT_S, 2 * wait_s), LONGEST_S)

    def _refreshed(self) -> bool:
        try:
            self._copy.refresh()
        except Exception as error:
            if self._ends.is_set():
                return False
            if not self._failed:
                self._say(error)
            self._failed = True
            return False
        if self._failed:
            log.info("index fetched again", index=self._copy.place.url)
        self._failed = False
        return True

    def _say(self, error: Exception) -> None:
        url, remedy = self._copy.place.url, "make room there, or name another directory by HEREABOUTS_CACHE_DIR"
        if isinstance(error, HereaboutsError):
            log.error("index not fetched", index=url, reason=str(error))
        elif isinstance(error, OSError):
            log.error("index not fetched", index=url, reason=f"{error}; {remedy}")
        else:
            log.exception("index not fetched", index=url)
