import ctypes
import gc
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from models.memory import drop_pages, frozen_objects, map_file, trim_heap


def anonymous_mib() -> float:
    [line] = [line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("RssAnon")]
    return int(line.split()[1]) / 1024


@pytest.mark.skipif(not hasattr(ctypes.CDLL(None), "malloc_trim"), reason="the C library is not glibc")
def test_free_memory_below_blocks_in_use_is_returned() -> None:
    lists = [bytearray(5000) for _ in range(20_000)]
    survivors = lists[::1000]
    del lists
    before = anonymous_mib()
    trim_heap()
    assert anonymous_mib() < before - 50
    assert len(survivors) == 20


def test_dropped_pages_are_read_again_and_private_changes_are_lost(tmp_path) -> None:
    path = tmp_path / "numbers"
    np.arange(100_000, dtype=np.int32).tofile(path)
    private, shared = map_file(path, np.int32), map_file(path, np.int32, (100_000,), "r+")
    private[0], shared[1] = 7, 8
    drop_pages()
    assert private[:3].tolist() == [0, 8, 2]
    assert shared[-1] == 99_999


def test_objects_are_frozen_only_inside_the_block() -> None:
    gc.unfreeze()
    with frozen_objects():
        assert gc.get_freeze_count() > 0
    assert gc.get_freeze_count() == 0


CODE = """
import re
import torch
from models.memory import drop_code_pages

def mapped_kib():
    regions = re.split(r"^(?=[0-9a-f]+-[0-9a-f]+ )", open("/proc/self/smaps").read(), flags=re.M)
    code = [region for region in regions if re.match(r"\\S+ r-xp .*libtorch_cpu", region)]
    return sum(int(re.search(r"^Rss: +(\\d+)", region, re.M)[1]) for region in code)

before = mapped_kib()
drop_code_pages()
print(before, mapped_kib(), int((torch.ones(9) * 2).sum()))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux lists mappings")
def test_code_runs_again_after_its_pages_were_dropped() -> None:
    run = subprocess.run([sys.executable, "-c", CODE], check=True, timeout=120, capture_output=True, text=True)
    before, after, total = map(int, run.stdout.split())
    assert total == 18
    assert after < before / 2
