"""What `pip install .` takes along: everything that runs."""

import tomllib
from fnmatch import fnmatch
from pathlib import Path

from app.http.routes.page import PAGE_DIR

ROOT = Path(__file__).parent.parent
SETUPTOOLS = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]
TOP = ("app", "index", "models")
MOST_BYTES = 20_000_000  # of weights that ship


def test_every_package_is_named() -> None:
    named = SETUPTOOLS["packages"]["find"]["include"]
    for folder in {path.parent for top in TOP for path in ROOT.glob(f"{top}/**/*.py")}:
        package = folder.relative_to(ROOT)
        assert any(fnmatch(".".join(package.parts), pattern) for pattern in named), package
        for part in (package, *package.parents[:-1]):
            assert (ROOT / part / "__init__.py").is_file(), "or setuptools does not find it"


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
