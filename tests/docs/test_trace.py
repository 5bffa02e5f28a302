"""The tracer of docs/: what runs for a description, and for a map."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
SMALL = 20  # lines
TEXT = "I am north of a street lamp. There is a brown building to my east."

pytestmark = pytest.mark.slow  # traces the whole program


def trace(weights_dir, *arguments):
    """What the tracer prints: its lines, and the rows of its table as (file, entered first, functions, lines)."""
    found = subprocess.run(
        [sys.executable, "docs/trace.py", *map(str, arguments)],
        cwd=ROOT,
        env={
            **os.environ,
            "HEREABOUTS_WEIGHTS_DIR": str(weights_dir),
            "HEREABOUTS_READ_KEY": "of-a-service",
            "OMP_NUM_THREADS": "1",
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert found.returncode == 0, found.stderr
    rows = re.findall(r"^ *\d+  (\S+\.py) +(\S+) +(\d+) +(\d+)$", found.stdout, re.M)
    return found.stdout.splitlines(), [(name, first, int(functions), int(n)) for name, first, functions, n in rows]


@pytest.fixture(scope="module")
def description(index_dir, weights_dir):
    return trace(weights_dir, "description", "--index", index_dir, TEXT)


def test_a_description_begins_at_its_route_and_goes_on_where_the_model_is(description):
    lines, rows = description
    assert lines[0].startswith(f"POST /localize '{TEXT}': 200, ")
    assert rows[0][0] == "app/http/routes/localize.py"
    files = [row[0] for row in rows]
    order = [
        "app/http/queue.py",
        "index/answering/posterior_localizer.py",
        "models/language/reader.py",
        "models/posterior/locate.py",
    ]
    assert [name for name in files if name in order] == order


def test_what_imports_run_does_not_count(description):
    _, rows = description
    assert all("<module>" not in first for _, first, _, _ in rows)
    assert all(functions >= 1 for _, _, functions, _ in rows)


def test_few_lines_make_a_helper(description):
    lines, rows = description
    assert min(ran for *_, ran in rows) >= SMALL
    [helpers] = [line for line in lines if line.startswith("helpers")]
    assert max(map(int, re.findall(r"\((\d+)\)", helpers))) < SMALL
    functions, ran = (sum(row[column] for row in rows) for column in (2, 3))
    assert f"{len(rows)} files, {functions} functions, {ran} lines" in lines


def test_a_map_begins_at_its_command_and_ends_with_files(strip_file, weights_dir):
    lines, rows = trace(weights_dir, "map", strip_file)
    files = [row[0] for row in rows]
    [helpers] = [line for line in lines if line.startswith("helpers")]
    assert helpers.split(": ")[1].startswith("app/cli/main.py")
    order = [
        "models/sources/osm/map.py",
        "models/citymap/geometry/cutting.py",
        "index/build/publish.py",
        "models/sources/osm/gazetteer.py",
    ]
    assert [name for name in files if name in order] == order
    assert "manifest.json" in lines[-1]
    assert "pieces.safetensors" in lines[-1]
