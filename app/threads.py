"""Thread counts of numeric libraries, which read them once: set them before torch is imported."""

import os
from collections.abc import Iterator, MutableMapping
from pathlib import Path

THREAD_VARIABLES = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS")


def set_thread_env(threads: int = 1, environ: MutableMapping[str, str] = os.environ) -> None:
    """Set the thread variables, unless the operator has set them.

    The default is one thread per process: a description is little work, and each of its many parallel regions would
    wait for threads that other processes keep from running. Other CPUs serve other requests. If OMP_NUM_THREADS is set,
    it also applies to the other libraries.
    """
    for name in THREAD_VARIABLES:
        environ.setdefault(name, environ.get("OMP_NUM_THREADS", str(threads)))


def usable_cpus(root: Path = Path("/")) -> int:
    """Return the number of CPUs by affinity or cgroup quota, whichever is less; `root` has proc/ and sys/."""
    affinity = len(os.sched_getaffinity(0))
    return max(1, int(min([float(affinity), *_quotas(root)])))


def _quotas(root: Path) -> Iterator[float]:
    """Yield the CPU quotas of this process's cgroups and their parents (versions 1 and 2)."""
    for line in _read(root / "proc/self/cgroup").splitlines():
        _, controllers, path = line.split(":", 2)
        relative = Path(path.lstrip("/"))
        for group in (relative, *relative.parents):
            if not controllers:
                quota, _, period = _read(root / "sys/fs/cgroup" / group / "cpu.max").strip().partition(" ")
            elif "cpu" in controllers.split(","):
                directory = root / "sys/fs/cgroup/cpu" / group
                quota = _read(directory / "cpu.cfs_quota_us").strip()
                period = _read(directory / "cpu.cfs_period_us").strip()
            else:
                continue
            if quota.isdigit() and period.isdigit() and int(period):
                yield int(quota) / int(period)


def _read(path: Path) -> str:
    try:
        return path.read_text()
    except OSError:
        return ""
