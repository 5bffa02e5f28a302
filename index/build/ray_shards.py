"""The shards of an index as tasks of a Ray cluster, an extra: pip install 'hereabouts[ray]'."""

import socket
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from index.build.build import IndexJob, silent
from index.build.shard import Shard
from models.citymap.types import Progress
from models.errors import ClusterUnavailable, DataError, HereaboutsError
from models.processes import one_process

KNOCK_S: Final = 5.0
AGAIN: Final = "give the same command again: what shards have done is kept"


def build_on_ray(job: IndexJob, count: int | None, address: str | None, report: Progress = silent) -> Path:
    """Build an index whose shards are made in a cluster; the last step is made here.

    Every machine of the cluster has this version of hereabouts, the map and the weights under the same paths, and the
    same index directory (NFS, CephFS). A shard takes a CPU.

    Args:
        job: the map, and how.
        count: how many shards; None for as many as the cluster has CPUs.
        address: of the cluster; None for the one that this machine belongs to.
        report: called as the work goes on.

    Returns:
        The version's directory.

    Raises:
        ClusterUnavailable: Ray is not installed, does not answer, or lost a shard.
        HereaboutsError: as `IndexJob.make_part` and `IndexJob.merge`.
    """
    try:
        import ray  # noqa: PLC0415  # an extra, which few have
    except ImportError as error:
        raise ClusterUnavailable("--engine ray takes Ray: pip install 'hereabouts[ray]'") from error
    if current := job.current():
        return current
    weights_dir = job.weights_dir and job.weights_dir.resolve()
    job = replace(job, map_path=job.map_path.resolve(), out_dir=job.out_dir.resolve(), weights_dir=weights_dir)
    report("find the cluster", 0, 0)
    try:
        _knock(address)
        ray.init(address=address or "auto", log_to_driver=False)
    except (ray.exceptions.RayError, OSError, ValueError, RuntimeError, ImportError) as error:
        where = f"at {address}" if address else "that this machine belongs to"
        raise ClusterUnavailable(f"no Ray cluster {where} ({error}); start one with: ray start --head") from error
    try:
        count = count or max(1, int(ray.cluster_resources().get("CPU", 1)))
        _make_parts(ray, job, count, report)
    finally:
        ray.shutdown()
    return job.merge(count, report)


def _knock(address: str | None) -> None:
    """Fail within seconds where nothing listens, of which Ray itself makes minutes and ends the process.

    Raises:
        OSError: nothing does.
    """
    host, colon, port = (address or "").removeprefix("ray://").partition(":")
    if colon and port.isdigit():
        socket.create_connection((host, int(port)), KNOCK_S).close()


def _make_parts(ray: Any, job: IndexJob, count: int, report: Progress) -> None:
    """Have all parts made; those of other shards stay if one cannot be."""
    make = ray.remote(_make_part).options(num_cpus=1)
    waiting = [make.remote(job, shard) for shard in Shard.all(count)]
    try:
        while waiting:
            report("make shards", count - len(waiting), count)
            [done], waiting = ray.wait(waiting)
            path = ray.get(done)
            if not path.exists():
                raise DataError(f"{path} was made and is not here: all machines must have {job.out_dir} in common")
    except ray.exceptions.RayTaskError as error:
        if isinstance(error.cause, HereaboutsError):
            raise error.cause from None
        raise
    except ray.exceptions.RayError as error:
        raise ClusterUnavailable(f"Ray lost a shard ({error}); {AGAIN}") from error


def _make_part(job: IndexJob, shard: Shard) -> Path:
    """What a worker does."""
    with one_process():
        return job.make_part(shard)
