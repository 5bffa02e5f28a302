"""The local copy of an index that is elsewhere: a directory that a service opens as any other."""

import hashlib
import shutil
from contextlib import suppress
from pathlib import Path
from typing import Final

from filelock import FileLock, Timeout

from index.build.artifact import DEFAULT, Aliases, read_aliases, write_aliases
from index.build.manifest import MANIFEST, check_files, check_sums, read_manifest
from index.remote.place import Place
from models.errors import IndexBroken, RemoteUnavailable
from models.files import new_directory, remove_unheld

FETCHING: Final = ".fetching"  # held by the one process of this machine that does


def copy_directory(cache: Path, url: str) -> Path:
    """Where in a cache directory the copy of an index is."""
    return cache / "indexes" / hashlib.sha256(url.encode()).hexdigest()[:16]


class LocalCopy:
    """Keeps an index directory here as it is there, of the versions that its aliases name.

    Args:
        place: where it is.
        root: the directory here; nobody else changes its aliases.
    """

    def __init__(self, place: Place, root: Path) -> None:
        self.place, self._root = place, root

    def refresh(self) -> None:
        """Fetch what the aliases there name, let those here name it once it is whole, remove what nothing serves.

        If another process of this machine does so, nothing: it is done for both.

        Raises:
            RemoteUnavailable: the place does not answer, or has no index; what is here stays.
            IndexBroken: a version there is not whole; its aliases here stay as they are, the others move.
            OSError: it cannot be written here.
        """
        self._root.mkdir(parents=True, exist_ok=True)
        with suppress(Timeout), FileLock(self._root / FETCHING, timeout=0):
            self._refresh()

    def _refresh(self) -> None:
        there, here = self.place.aliases(), self._here()
        if there is None or not there.aliases:
            raise RemoteUnavailable(
                f"there is no index in {self.place.url}; send one there with 'hereabouts push --index DIR URL'"
            )
        named = {alias: version for alias, version in here.aliases.items() if alias in there.aliases}
        broken: IndexBroken | None = None
        for alias in sorted(there.aliases, key=lambda alias: alias != DEFAULT):  # which most ask for
            version = there.aliases[alias]
            try:
                self._fetch(version, there.versions.get(version))
            except IndexBroken as error:
                broken = broken or error
                continue
            named[alias] = version
            here = self._name(here, named, there.versions)
        self._name(here, named, there.versions)  # some aliases may be gone from there
        self._remove_unused(set(named.values()))
        if broken is not None:
            raise broken

    def _here(self) -> Aliases:
        """The aliases here; none if they are broken: it is but a copy."""
        with suppress(IndexBroken):
            return read_aliases(self._root)
        return Aliases()

    def _name(self, here: Aliases, named: dict[str, str], sums: dict[str, str]) -> Aliases:
        """Write the aliases here, if they are others; with the sums of what they name alone."""
        known = here.versions | sums
        wanted = Aliases(
            aliases=named, versions={version: known[version] for version in named.values() if version in known}
        )
        if wanted != here:
            write_aliases(self._root, wanted)
        return wanted

    def _fetch(self, version: str, manifest_sum: str | None) -> None:
        """Have a version here, whole or not at all."""
        directory = self._root / version
        if manifest_sum is None:
            raise IndexBroken(f"{self.place.url} names {version}, but has no sum of it; send it there again")
        if self._is_here(directory, manifest_sum):
            return
        shutil.rmtree(directory, ignore_errors=True)  # a part of it, or of another content
        with new_directory(directory) as beside:
            self.place.fetch(f"{version}/{MANIFEST}", beside / MANIFEST)
            try:
                manifest = read_manifest(beside, manifest_sum, version)
                for name in manifest.files:
                    self.place.fetch(f"{version}/{name}", beside / name)
                check_files(beside, manifest)
                check_sums(beside, manifest)
            except IndexBroken as error:
                raise IndexBroken(str(error).replace(str(beside), f"{self.place.url}/{version}")) from error

    @staticmethod
    def _is_here(directory: Path, manifest_sum: str) -> bool:
        """Whether a version is here; its sums were checked when it came, and are again when it is served."""
        try:
            check_files(directory, read_manifest(directory, manifest_sum))
        except IndexBroken:
            return False
        return True

    def _remove_unused(self, named: set[str]) -> None:
        """Remove the versions that no alias names, but for those that a process still answers from."""
        for path in self._root.iterdir():
            if path.is_dir() and not path.name.startswith(".") and path.name not in named:
                remove_unheld(path)
