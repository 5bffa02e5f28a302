"""Sending an index to where services fetch it from."""

from pathlib import Path

from index.build.artifact import Aliases, find_version, open_version, read_aliases
from index.build.manifest import ADVICE, MANIFEST
from index.remote.place import Place
from models.citymap.types import Progress
from models.errors import IndexBroken
from models.files import sha256


def push(root: Path, place: Place, report: Progress) -> Aliases:
    """Send the versions that the aliases of an index directory name, then let the aliases there name them.

    A version is read before it is sent, its manifest comes last, and the aliases last of all: whoever looks meanwhile
    finds what was there before. What is there already is not sent again; other aliases and versions there stay.

    Args:
        root: the index directory.
        place: where to.
        report: called as the files go.

    Returns:
        The aliases and versions that are there now.

    Raises:
        IndexBroken: there is no index, or one of its files was changed.
        RemoteUnavailable: it cannot be written there; give the command again, the aliases there have not moved.
    """
    here = read_aliases(root)
    if not here.aliases:
        raise IndexBroken(f"no index in {root}; {ADVICE}")
    there = place.aliases() or Aliases()
    versions = {version: _manifest_sum(root / version) for version in {*here.aliases.values()}}
    for version, manifest_sum in versions.items():
        if there.versions.get(version) != manifest_sum:
            _send(root / version, place, report)
    there = place.aliases() or Aliases()  # again, as sending takes its time
    aliases = Aliases(aliases=there.aliases | here.aliases, versions=there.versions | versions)
    place.name(aliases)
    return aliases


def _manifest_sum(directory: Path) -> str:
    """The sha256 of a version's manifest, which is the one that was registered."""
    find_version(directory)
    return sha256(directory / MANIFEST)


def _send(directory: Path, place: Place, report: Progress) -> None:
    report(f"check {directory.name}", 0, 0)
    _, manifest = open_version(directory)
    place.begin(directory.name)
    names = [*manifest.files, MANIFEST]
    for n, name in enumerate(names):
        report(f"send {directory.name}", n, len(names))
        place.send(directory / name, f"{directory.name}/{name}")
