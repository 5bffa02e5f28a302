"""The shards of an index as tasks of a Ray cluster; needs the extra: pip install 'hereabouts[ray]'."""

import socket
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from index.build.build import IndexJob, no_progress
from index.build.shard import Shard
from models.citymap.types import Progress
from models.errors import ClusterUnavailable, DataError, HereaboutsError
from models.processes import one_process

CONNECT_TIMEOUT_S: Final = 5.0
RETRY_ADVICE: Final = "repeat the command: finished shards are kept"


def build_on_ray(job: IndexJob, count: int | None, address: str | None, report: Progress = no_progress) -> Path:
    """Build an index whose shards are made in a Ray cluster; the merge runs on this machine.

    Every machine needs this version of hereabouts, the map and the weights under the same paths, and the shared index
    directory (NFS, CephFS). A shard uses one CPU; the default count is the number of CPUs in the cluster, by default of
    this machine. Raise ClusterUnavailable if Ray is not installed, does not answer or lost a shard.
    """
    try:
        import ray  # noqa: PLC0415  # an extra, which few have
    except ImportError as error:
        raise ClusterUnavailable("--engine ray needs Ray: pip install 'hereabouts[ray]'") from error
    if current := job.current_version():
        return current
    weights_dir = job.weights_dir and job.weights_dir.resolve()
    job = replace(job, map_path=job.map_path.resolve(), out_dir=job.out_dir.resolve(), weights_dir=weights_dir)
    report("find the cluster", 0, 0)
    try:
        _check_reachable(address)
        ray.init(address=address or "auto", log_to_driver=False)
    except (ray.exceptions.RayError, OSError, ValueError, RuntimeError, ImportError) as error:
        where = f"at {address}" if address else "on this machine"
        raise ClusterUnavailable(f"no Ray cluster {where} ({error}); start one with: ray start --head") from error
    try:
        count = count or max(1, int(ray.cluster_resources().get("CPU", 1)))
        _make_shards(ray, job, count, report)
    finally:
        ray.shutdown()
    return job.merge(count, report)


def _check_reachable(address: str | None) -> None:
    """Raise OSError within seconds if nothing listens at the address; Ray itself would wait for minutes."""
    host, colon, port = (address or "").removeprefix("ray://").partition(":")
    if colon and port.isdigit():
        socket.create_connection((host, int(port)), CONNECT_TIMEOUT_S).close()


def _make_shards(ray: Any, job: IndexJob, count: int, report: Progress) -> None:
    """Make the data of all shards; if one fails, the data of the others stays."""
    make = ray.remote(_make_shard).options(num_cpus=1)
    waiting = [make.remote(job, shard) for shard in Shard.all(count)]
    try:
        while waiting:
            report("make shards", count - len(waiting), count)
            [done], waiting = ray.wait(waiting)
            path = ray.get(done)
            if not path.exists():
                raise DataError(f"{path} was made but is not visible here: all machines must share {job.out_dir}")
    except ray.exceptions.RayTaskError as error:
        if isinstance(error.cause, HereaboutsError):
            raise error.cause from None
        raise
    except ray.exceptions.RayError as error:
        raise ClusterUnavailable(f"Ray lost a shard ({error}); {RETRY_ADVICE}") from error


def _make_shard(job: IndexJob, shard: Shard) -> Path:
    with one_process():
        return job.make_shard(shard)
