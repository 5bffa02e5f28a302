from pathlib import Path

import numpy as np
import pytest

from models import spool
from models.errors import DataError
from models.files import TEMP_PREFIX
from models.memory import drop_pages
from models.spool import row_blocks, spool_directory, spooled, spooled_zeros, spooling_in, starts_of


def parts(sizes):
    rng = np.random.default_rng(0)
    return [
        {"wide": rng.normal(size=(n, 3)).astype(np.float32), "number": rng.integers(0, 99, n, np.int16)} for n in sizes
    ]


@pytest.mark.parametrize("stored", [0, 40, 2**30])
@pytest.mark.parametrize("sizes", [[5], [0, 3, 0, 7], [0, 0]])
def test_columns_are_those_of_the_parts_on_disk_or_not(stored, sizes, monkeypatch) -> None:
    monkeypatch.setattr(spool, "MAX_BYTES_IN_MEMORY", stored)
    result = spooled(iter(parts(sizes)))
    assert set(result) == {"wide", "number"}
    for name, column in result.items():
        expected = np.concatenate([part[name] for part in parts(sizes)])
        assert column.dtype == expected.dtype
        assert np.array_equal(column, expected)
        column[:] = 0  # which may be written


def test_what_lies_on_disk_takes_no_memory_but_while_it_is_looked_at(monkeypatch, tmp_path) -> None:
    monkeypatch.setattr(spool, "MAX_BYTES_IN_MEMORY", 10)
    monkeypatch.setattr(spool, "ROWS_PER_BLOCK", 20_000)
    with spooling_in(tmp_path):
        columns = spooled(parts([100_000] * 3))
    visited = [(resident(tmp_path), subset["wide"].sum(), len(subset["number"])) for subset in row_blocks(columns)]
    assert sum(rows for _, _, rows in visited) == 300_000
    assert max(kib for kib, _, _ in visited) < 500, "of 3.6 MB"
    assert columns["wide"].sum() == pytest.approx(sum(total for _, total, _ in visited), abs=1)
    assert resident(tmp_path) > 3000
    drop_pages()
    assert resident(tmp_path) == 0


def resident(directory: Path) -> int:
    """KiB of files of a directory that are in this process's memory."""
    result, is_ours = 0, False
    for line in Path("/proc/self/smaps").read_text().splitlines():
        if not line.split(maxsplit=1)[0].endswith(":"):
            is_ours = str(directory) in line
        elif is_ours and line.startswith("Rss:"):
            result += int(line.split()[1])
    return result


@pytest.mark.parametrize("stored", [1000, 2**30])
def test_numbers_are_written_in_any_order(stored, monkeypatch) -> None:
    monkeypatch.setattr(spool, "MAX_BYTES_IN_MEMORY", stored)
    result = spooled_zeros(50_000, np.int32)
    assert not result.any()
    order = np.random.default_rng(0).permutation(50_000)
    result[order] = np.arange(50_000)
    drop_pages()
    assert np.array_equal(result[order], np.arange(50_000)), "what was written stays when its pages go"


@pytest.mark.parametrize("stored", [1, 2**30])
@pytest.mark.parametrize("sizes", [[], [3], [0, 2, 0, 5, 1, 0, 0, 4]])
def test_runs_begin_where_those_before_them_end(stored, sizes, monkeypatch) -> None:
    monkeypatch.setattr(spool, "MAX_BYTES_IN_MEMORY", stored)
    monkeypatch.setattr(spool, "ROWS_PER_BLOCK", 3)
    result = starts_of(np.array(sizes, np.int16))
    assert result.dtype == np.int32
    assert result.tolist() == [sum(sizes[:n]) for n in range(len(sizes) + 1)]


def test_more_rows_than_can_be_numbered_are_said() -> None:
    assert starts_of(np.array([2**31 - 2, 1])).tolist() == [0, 2**31 - 2, 2**31 - 1]
    with pytest.raises(DataError, match=r"2147483648 rows .*--within"):
        starts_of(np.array([2**31 - 2, 2]))


def test_a_full_disk_is_said(monkeypatch, tmp_path) -> None:
    monkeypatch.setattr(spool, "MAX_BYTES_IN_MEMORY", 10)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "missing"))
    with pytest.raises(DataError, match=r"missing cannot be written: .*TMPDIR"):
        spooled(parts([1000]))


def test_a_full_index_directory_is_said_and_scratch_is_removed(tmp_path) -> None:
    with spooling_in(tmp_path), spool_directory() as directory:
        assert directory.parent == tmp_path
        (directory / "strip").write_text("some")
    assert not list(tmp_path.iterdir())
    (tmp_path / f"{TEMP_PREFIX}0").mkdir()
    with spooling_in(tmp_path), spool_directory() as directory:
        assert list(tmp_path.iterdir()) == [directory], "what a killed process left is gone"
    with (
        spooling_in(tmp_path / "missing"),
        pytest.raises(DataError, match=r"missing cannot be written: .*another directory"),
        spool_directory(),
    ):
        pass
