"""Reading the files of a version again while it answers: `python -m app.workers.checksums DIRECTORY`.

A process of its own, which gives way to all others: a gigabyte takes a second of a CPU that has nothing else to do. A
thread of the service would make requests wait whenever it is put off while it holds the interpreter.
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
NICENESS: Final = 19  # the last of all
SHOWN_BYTES: Final = 1000  # of a crashed process's last words


async def check_version(index_dir: Path, version: str) -> None:
    """Compare all files of a version with its manifest; a process that it started ends with it.

    Args:
        index_dir: an index directory, or the version itself.
        version: of it.

    Raises:
        IndexBroken: one is not what was written; the message names it by its version, not by its place on this machine.
        HereaboutsError: nobody knows, as the process was killed or crashed.
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
        said = crashed[-SHOWN_BYTES:].decode(errors="replace")
        raise HereaboutsError(f"exit status {process.returncode}; check it with 'hereabouts verify'. {said}")


def main(directory: Path) -> None:
    """Print what is wrong with a version, if anything."""
    os.nice(NICENESS)
    try:
        open_version(directory)
    except IndexBroken as error:
        print(str(error).replace(f"{directory.parent}{os.sep}", ""))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
