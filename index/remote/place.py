"""An index directory behind a URL, read and written by fsspec, with one kind of error."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final
from urllib.parse import urlsplit

import fsspec
from fsspec.registry import known_implementations
from fsspec.utils import get_protocol

from index.build.artifact import ALIASES, Aliases, parse_aliases
from models.errors import RemoteUnavailable

OWN: Final = "fsspec"  # where protocols lie that need another library at most


class Place:
    """Where an index is that is not here: the same files under the same names as in an index directory.

    Args:
        url: of any protocol of fsspec: s3://bucket/town, gs://bucket/town, https://host/town, file:///shared/town.

    Raises:
        RemoteUnavailable: no such protocol, or what speaks it is not installed.
    """

    def __init__(self, url: str) -> None:
        self._user = urlsplit(url).netloc.rpartition("@")[0]  # may have a password
        self.url = self._shown(url)
        protocol = get_protocol(url)
        # Directories are made as they are needed; a bucket is not, or a slip of the pen would make one.
        options = {"auto_mkdir": True} if protocol in {"file", "local"} else {}
        try:
            self._files, root = fsspec.url_to_fs(url, **options)
        except ImportError as error:
            package = known_implementations[protocol]["class"].partition(".")[0]
            remedy = str(error) if package == OWN else f"pip install {package}"
            raise RemoteUnavailable(f"{self.url} takes what is not installed: {remedy}") from error
        except ValueError as error:
            known = "s3://bucket/town or file:///shared/town for example"
            raise RemoteUnavailable(f"{self.url} is no URL of an index: {error}; give {known}") from error
        self._root = root.rstrip("/")

    def aliases(self) -> Aliases | None:
        """The aliases and versions there; None if there are none yet.

        Raises:
            RemoteUnavailable: it does not answer.
            IndexBroken: they cannot be read.
        """
        with self._asking(ALIASES):
            self._files.invalidate_cache()
            try:
                content: bytes = self._files.cat_file(self._path(ALIASES))
            except FileNotFoundError:
                return None
        return parse_aliases(content, self.url)

    def fetch(self, name: str, path: Path) -> None:
        """Copy a file from there.

        Raises:
            RemoteUnavailable: it is not there, or there is no room for it here.
        """
        with self._asking(name):
            self._files.get_file(self._path(name), str(path))

    def send(self, path: Path, name: str) -> None:
        """Copy a file there.

        Raises:
            RemoteUnavailable: it cannot be written.
        """
        with self._asking(name):
            self._files.put_file(str(path), self._path(name))

    def begin(self, version: str) -> None:
        """Make the directory of a version, where there are any; if that fails, so will sending its files."""
        with suppress(Exception):
            self._files.mkdir(self._path(version), create_parents=False)

    def name(self, aliases: Aliases) -> None:
        """Write the aliases and versions there.

        Raises:
            RemoteUnavailable: it cannot be written.
        """
        with self._asking(ALIASES):
            self._files.pipe_file(self._path(ALIASES), aliases.as_file())

    def _path(self, name: str) -> str:
        return f"{self._root}/{name}"

    def _shown(self, text: str) -> str:
        """A text without the user and password of the URL."""
        return text.replace(f"{self._user}@", "") if self._user else text

    @contextmanager
    def _asking(self, name: str) -> Iterator[None]:
        try:
            yield
        except Exception as error:  # each protocol has errors of its own
            said = self._shown(str(error)) or type(error).__name__
            remedy = "look whether it is there, whether this machine may reach it, and whether there is room"
            raise RemoteUnavailable(f"{self.url}/{name}: {said}; {remedy}") from error
