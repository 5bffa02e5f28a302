"""The house rules on imports: app -> index -> models, which folder may import which, which library lives where."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
LAYERS = ("models", "index", "app")
FILES = [path for layer in LAYERS for path in sorted((ROOT / layer).rglob("*.py"))]
# Which packages the modules of a package may import besides their own; "models" are the modules right in models/.
MAY_IMPORT = {
    "models": ("models.language",),
    "models.citymap": ("models",),
    "models.sources": ("models", "models.citymap"),
    "models.language": ("models", "models.citymap"),
    "models.paper": ("models", "models.citymap", "models.language"),
    "models.posterior": ("models", "models.citymap", "models.language"),
    "models.training": (
        "models",
        "models.citymap",
        "models.language",
        "models.paper",
        "models.posterior",
        "models.sources",
    ),
    "index": (),
    "index.stores": ("models", "models.citymap", "index.build", "index.answering"),
    "index.build": ("models", "models.*", "index.stores", "index.answering", "index.asking"),
    "index.answering": ("models", "models.*", "index.stores", "index.build", "index.asking"),
    "index.asking": ("models", "models.*", "index.answering"),
    "index.evaluation": ("models", "models.*", "models.training", "index.*"),
    "app": ("models", "models.*", "index.*", "app.http", "app.jobs", "app.workers"),
    "app.public": ("app", "index.answering"),
    "app.http": ("models", "models.*", "index.*", "app", "app.jobs"),
    "app.jobs": ("models", "models.*", "index.*", "index.evaluation", "app", "app.http"),
    "app.workers": ("models", "models.*", "index.*", "app"),
    "app.benchmark": ("models", "models.*", "index.*", "index.evaluation", "app"),
    "app.cli": ("models", "models.*", "models.training", "index.*", "index.evaluation", "app", "app.*"),
}
# What trains, measures or only makes training data: a star above does not include it.
NOT_SERVED = ("models.training", "index.evaluation")
# Modules that may not be imported by anything that serves, though their package may be.
OFFLINE_ONLY = ("models.language.grammar", "models.sources.synthetic")
ONLY_IN = {
    "transformers": "models/language/text_encoder.py",
    "faiss": "index/stores",
    "pymilvus": "index/stores",
    "grpc": "index/stores",
    "ray": "index/build/ray_shards.py",
    "marisa_trie": "models/strings.py",
    "fastapi": "app",
    "starlette": "app",
    "uvicorn": "app",
    "typer": "app",
}
WITHOUT_TORCH = [
    ROOT / "models/citymap",
    ROOT / "models/compiled.py",
    ROOT / "models/processes.py",
    ROOT / "models/spool.py",
    ROOT / "models/strings.py",
    ROOT / "models/training/metrics.py",
    ROOT / "app/http/schemas/requests.py",
    ROOT / "index/answering/answers.py",
    ROOT / "index/answering/query.py",
]


def imported(path: Path) -> set[str]:
    """The modules that a file imports anywhere in it; of `from a import b`, a.b where that is a module."""
    result = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            result |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: imports are absolute"
            result |= {
                node.module if not _is_module(f"{node.module}.{a.name}") else f"{node.module}.{a.name}"
                for a in node.names
            }
    return result


def _is_module(name: str) -> bool:
    place = ROOT / name.replace(".", "/")
    return place.is_dir() or place.with_suffix(".py").is_file()


def package_of(module: str) -> str:
    """The package of a module by the first two parts of its name: "models.citymap" of "models.citymap.osm.map"."""
    parts = module.split(".")
    is_package = (ROOT / "/".join(parts[:2])).is_dir()
    return ".".join(parts[:2]) if is_package else parts[0]


def may_import(home: str, package: str) -> bool:
    """Whether modules of a package may import those of another."""
    allowed = MAY_IMPORT[home]
    star = f"{package.partition('.')[0]}.*"
    return package in (home, *allowed) or (star in allowed and package not in NOT_SERVED)


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(ROOT)))
def test_imports_run_one_way(path: Path) -> None:
    place = path.relative_to(ROOT)
    module = ".".join(place.with_suffix("").parts)
    home = package_of(module)
    modules = imported(path)
    ours = {name for name in modules if name.partition(".")[0] in LAYERS}
    refused = sorted(name for name in ours if not may_import(home, package_of(name)))
    assert not refused, f"{module} may not import {', '.join(refused)}"
    if home not in (*NOT_SERVED, "app.cli") and not module.startswith(OFFLINE_ONLY):
        assert not [name for name in ours if name.startswith(OFFLINE_ONLY)], f"{module} is served"
    libraries = {module.partition(".")[0] for module in modules}
    for library, layer in ONLY_IN.items():
        assert library not in libraries or place.is_relative_to(layer), f"{library} belongs in {layer}/"
    if any(path == p or p in path.parents for p in WITHOUT_TORCH):
        assert "torch" not in libraries


def test_transformers_are_imported_when_they_are_asked_for() -> None:
    for path in FILES:
        for node in ast.parse(path.read_text()).body:
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else [getattr(node, "module", None)]
            assert not any((name or "").startswith("transformers") for name in names), (
                f"{path}: seven seconds a process"
            )


def test_the_city_model_loads_without_torch() -> None:
    city = [".".join(p.relative_to(ROOT).with_suffix("").parts) for p in FILES if ROOT / "models/citymap" in p.parents]
    code = f"""
import sys, {", ".join(city)}, models.training.metrics, index.answering.answers
sys.exit("torch" in sys.modules)
"""
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False).returncode == 0


def test_every_package_says_what_is_inside() -> None:
    for path in FILES:
        if path.name == "__init__.py":
            assert ast.get_docstring(ast.parse(path.read_text())), f"{path}: say what is inside"
