"""Verification of a served version: `python -m app.workers.checksums DIRECTORY`.

It runs in its own process at the lowest priority; a gigabyte takes about a second of an idle CPU. A thread of the
service would delay requests by holding the interpreter lock.
"""

import asyncio
import os
import sys
from asyncio.subprocess import DEVNULL, PIPE
from contextlib import suppress
from pathlib import Path
from typing import Final

from app.workers.launch import ROOT
from index.build.artifact import open_version
from index.build.manifest import MANIFEST
from models.errors import HereaboutsError, IndexBroken

PROCESS: Final = (sys.executable, "-m", "app.workers.checksums")
NICENESS: Final = 19  # the lowest priority
MAX_SHOWN_STDERR_BYTES: Final = 1000  # the end of a crashed process's stderr


async def check_version(index_dir: Path, version: str) -> None:
    """Compare all files of a version with its manifest, in a process that ends with this call.

    Raise IndexBroken with the path of a corrupt file, or HereaboutsError if the process was killed or crashed.
    """
    directory = index_dir if (index_dir / MANIFEST).is_file() else index_dir / version
    process = await asyncio.create_subprocess_exec(
        *PROCESS, str(directory.absolute()), stdin=DEVNULL, stdout=PIPE, stderr=PIPE, cwd=ROOT, start_new_session=True
    )
    try:
        broken, crashed = await process.communicate()
    finally:
        if process.returncode is None:
            with suppress(ProcessLookupError):
                process.kill()
            await process.communicate()
    if broken:
        raise IndexBroken(broken.decode().strip())
    if process.returncode:
        stderr_text = crashed[-MAX_SHOWN_STDERR_BYTES:].decode(errors="replace")
        raise HereaboutsError(f"exit status {process.returncode}; check it with 'hereabouts verify'. {stderr_text}")


def main(directory: Path) -> None:
    """Print the error of a corrupt version; print nothing if it is intact."""
    os.nice(NICENESS)
    try:
        open_version(directory)
    except IndexBroken as error:
        print(str(error).replace(f"{directory.parent}{os.sep}", ""))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
