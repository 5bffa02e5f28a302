"""What `pip install .` takes along: everything that runs."""

import tomllib
from pathlib import Path

from setuptools import find_packages

ROOT = Path(__file__).parent.parent
SETUPTOOLS = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]
TOP = ("app", "index", "models")


def test_every_package_is_named() -> None:
    found = {
        str(init.parent.relative_to(ROOT)).replace("/", ".")
        for top in TOP
        for init in ROOT.glob(f"{top}/**/__init__.py")
    }
    assert set(find_packages(ROOT, **SETUPTOOLS["packages"]["find"])) == found


def test_every_file_that_is_read_is_taken_along() -> None:
    taken = {
        path
        for package, patterns in SETUPTOOLS["package-data"].items()
        for pattern in patterns
        for path in (ROOT / package.replace(".", "/")).glob(pattern)
    }
    read = {p for top in TOP for kind in ("toml", "safetensors", "pbf") for p in ROOT.glob(f"{top}/**/*.{kind}")}
    assert read - taken == set()
