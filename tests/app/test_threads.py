import os

import pytest
from typer.testing import CliRunner

from app import threads as threads_module
from app.cli.main import app
from app.threads import THREAD_VARIABLES, set_thread_env, usable_cpus

MANY = 64


@pytest.fixture
def root(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda pid: set(range(MANY)))

    def write(files):
        for path, content in files.items():
            (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / path).write_text(content)
        return tmp_path

    return write


V1 = "sys/fs/cgroup/cpu/docker/x/"


@pytest.mark.parametrize(
    ("files", "cpus"),
    [
        ({}, MANY),
        ({"proc/self/cgroup": "0::/\n", "sys/fs/cgroup/cpu.max": "max 100000\n"}, MANY),
        ({"proc/self/cgroup": "0::/\n", "sys/fs/cgroup/cpu.max": "250000 100000\n"}, 2),
        ({"proc/self/cgroup": "0::/\n", "sys/fs/cgroup/cpu.max": "50000 100000\n"}, 1),
        ({"proc/self/cgroup": "0::/a/b\n", "sys/fs/cgroup/a/cpu.max": "300000 100000\n"}, 3),
        (
            {
                "proc/self/cgroup": "3:memory:/docker/x\n4:cpu,cpuacct:/docker/x\n",
                V1 + "cpu.cfs_quota_us": "400000\n",
                V1 + "cpu.cfs_period_us": "100000\n",
            },
            4,
        ),
        (
            {
                "proc/self/cgroup": "4:cpu,cpuacct:/docker/x\n",
                V1 + "cpu.cfs_quota_us": "-1\n",
                V1 + "cpu.cfs_period_us": "100000\n",
            },
            MANY,
        ),
    ],
)
def test_quota_of_the_cgroup_counts(root, files, cpus):
    assert usable_cpus(root(files)) == cpus


def test_affinity_counts(root, monkeypatch):
    directory = root({"proc/self/cgroup": "0::/\n", "sys/fs/cgroup/cpu.max": "800000 100000\n"})
    monkeypatch.setattr(os, "sched_getaffinity", lambda pid: {0, 1, 2})
    assert usable_cpus(directory) == 3


def test_what_the_operator_has_set_stays():
    environ = {"OMP_NUM_THREADS": "7", "MKL_NUM_THREADS": "3"}
    set_thread_env(2, environ)
    assert environ == {"OMP_NUM_THREADS": "7", "MKL_NUM_THREADS": "3", "OPENBLAS_NUM_THREADS": "7"}


def test_a_process_has_one_thread():
    environ = {}
    set_thread_env(environ=environ)
    assert environ == dict.fromkeys(THREAD_VARIABLES, "1")


@pytest.mark.parametrize(("command", "threads"), [("train", "3"), ("localize", "1"), ("index", "1"), ("evaluate", "1")])
def test_training_alone_takes_all_cpus(monkeypatch, command, threads):
    environ = {}
    monkeypatch.setattr(threads_module, "usable_cpus", lambda: 3)
    monkeypatch.setattr(threads_module.set_thread_env, "__defaults__", (1, environ))
    assert CliRunner().invoke(app, [command, "--no-such-option"]).exit_code == 2
    assert environ == dict.fromkeys(THREAD_VARIABLES, threads)
