"""Tests that `pip install .` installs everything that runs."""

import os
import subprocess
import sys
import tomllib
from pathlib import Path

from setuptools import find_packages

from app.http.routes.page import PAGE_DIR

ROOT = Path(__file__).parent.parent
SETUPTOOLS = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]
TOP = ("app", "index", "models")
ENV = os.environ | {"PYTHONPATH": str(ROOT)}
MOST_BYTES = 20_000_000  # of weights that ship


def test_every_package_is_found() -> None:
    packages = {p for where in SETUPTOOLS["packages"]["find"]["where"] for p in _packages(where)}
    ours = {".".join(p.parent.relative_to(ROOT).parts) for top in TOP for p in ROOT.glob(f"{top}/**/*.py")}
    assert packages == ours - {"app.public.hereabouts"} | {"hereabouts"}


def _packages(where: str) -> list[str]:
    find = SETUPTOOLS["packages"]["find"]
    assert find["namespaces"] is False
    return list(find_packages(str(ROOT / where), include=find["include"]))


def test_the_public_package_offers_a_client_without_torch() -> None:
    assert _printed("import sys, hereabouts; hereabouts.AsyncClient; print('torch' in sys.modules)") == "False"


def test_the_public_localizer_is_that_of_the_service() -> None:
    code = "import hereabouts, index.answering.localizer as ours; print(hereabouts.Localizer is ours.Localizer)"
    assert _printed(code) == "True"


def _printed(code: str) -> str:
    """Return the output of Python with the public package on its path, as after an installation."""
    place = ROOT / "app" / "public"
    run = subprocess.run([sys.executable, "-c", code], cwd=place, env=ENV, capture_output=True, check=True, text=True)
    return run.stdout.strip()


def test_every_file_that_is_read_is_taken_along() -> None:
    taken = {
        path
        for package, patterns in SETUPTOOLS["package-data"].items()
        for pattern in patterns
        for path in (ROOT / package.replace(".", "/")).glob(pattern)
    }
    page = PAGE_DIR / "index.html"  # there once it is built
    assert any(page.match(f"app/{pattern}") for pattern in SETUPTOOLS["package-data"]["app"])
    read = {p for top in TOP for kind in ("toml", "xz", "safetensors", "pbf") for p in ROOT.glob(f"{top}/**/*.{kind}")}
    of_reports = set((ROOT / "models" / "reports").rglob("*.toml"))  # nothing that runs reads them
    assert read - taken - of_reports == set()


def test_the_weights_that_ship_are_no_larger_than_agreed() -> None:
    assert sum(path.stat().st_size for path in (ROOT / "models" / "weights").rglob("*") if path.is_file()) < MOST_BYTES
