"""A version of an index in one file, to keep or to carry elsewhere: it is unpacked in an index directory there."""

import tarfile
from pathlib import Path
from typing import Final

from models.files import open_atomic, sha256

SNAPSHOTS: Final = "snapshots"


def snapshot(root: Path, version: str) -> tuple[Path, str]:
    """Write a version, which is checked, as a tar file; whole or not at all, and the same bytes each time.

    Args:
        root: an index directory.
        version: one of its versions.

    Returns:
        The file, and its sha256.
    """
    path = root / SNAPSHOTS / f"{version}.tar"
    with open_atomic(path) as file, tarfile.open(fileobj=file, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for item in sorted((root / version).iterdir()):
            member = archive.gettarinfo(item, arcname=f"{version}/{item.name}")
            member.uid = member.gid = member.mtime = 0
            member.uname = member.gname = ""
            with item.open("rb") as content:
                archive.addfile(member, content)
    return path, sha256(path)
