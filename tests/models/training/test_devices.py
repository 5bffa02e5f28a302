"""Everything that is trained, with no tensor left behind on the CPU; no GPU is needed to tell."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from torch.utils import backend_registration

from models.paper.checkpoint import METHODS
from models.paper.fine.checkpoint import FINE_METHODS
from models.paper.instance_encoder import DEFAULT_INPUTS, PAPER_INPUTS

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        not hasattr(backend_registration, "_setup_privateuseone_for_python_backend"),
        reason="this torch cannot have a device written in Python",
    ),
]
ROOT = Path(__file__).parents[3]
MODELS = [f"{method}-{inputs[0]}" for method in (*METHODS, *FINE_METHODS) for inputs in (DEFAULT_INPUTS, PAPER_INPUTS)]


@pytest.fixture(scope="module")
def report(made_once, strip_file):
    """The errors of each training, from a process that no other test shares."""

    def make(out: Path) -> None:
        command = [sys.executable, "-m", "tests.models.training.on_fake_device", str(strip_file), str(out)]
        subprocess.run(command, cwd=ROOT, check=True)

    return json.loads((made_once("devices", make) / "report.json").read_text())


@pytest.mark.parametrize("name", ["device", "lending", *MODELS, "points", "posterior"])
def test_all_of_it_is_on_one_device(report, name) -> None:
    assert not report[name], report[name]
