"""How many threads numeric libraries may use; they read it once, so set it before torch is imported."""

import os
from collections.abc import Iterator, MutableMapping
from pathlib import Path

THREAD_VARIABLES = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS")


def set_thread_env(threads: int = 1, environ: MutableMapping[str, str] = os.environ) -> None:
    """Set the thread variables; what the operator has set stays.

    One thread a process is the default: a description is small work, and its many parallel regions would each wait for
    a thread that a busy neighbour keeps from running. Other CPUs are for other processes and other requests.
    OMP_NUM_THREADS, where it is set, speaks for the others too.
    """
    for name in THREAD_VARIABLES:
        environ.setdefault(name, environ.get("OMP_NUM_THREADS", str(threads)))


def usable_cpus(root: Path = Path("/")) -> int:
    """CPUs by affinity and by the cgroup's quota, whichever is less; at least 1.

    Args:
        root: where /proc and /sys are.
    """
    affinity = len(os.sched_getaffinity(0))
    return max(1, int(min([float(affinity), *_quotas(root)])))


def _quotas(root: Path) -> Iterator[float]:
    """CPU quotas of this process's cgroups and all their parents, version 2 and version 1."""
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
