"""Everything that is trained, with no tensor left behind on the CPU; no GPU is needed to tell."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from torch.utils import backend_registration

from models.paper.checkpoint import METHODS
from models.paper.fine.checkpoint import FINE_METHODS

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        not hasattr(backend_registration, "_setup_privateuseone_for_python_backend"),
        reason="this torch cannot have a device written in Python",
    ),
]
ROOT = Path(__file__).parents[3]
NAMES = [
    "device",
    "lending",
    *METHODS,
    *FINE_METHODS,
    "mncl-points",
    "matching-points",
    "trained-points",
    "points",
    "measuring",
    "posterior",
]


@pytest.fixture(scope="module")
def report(made_once, strip_file):
    """The errors of each training, from a process that no other test shares."""

    def make(out: Path) -> None:
        command = [sys.executable, "-m", "tests.models.training.on_fake_device", str(strip_file), str(out)]
        subprocess.run(command, cwd=ROOT, check=True)

    return json.loads((made_once("devices", make) / "report.json").read_text())


@pytest.mark.parametrize("name", NAMES)
def test_all_of_it_is_on_one_device(report, name) -> None:
    assert report.keys() == set(NAMES)
    assert not report[name], report[name]
