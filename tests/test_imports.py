"""The house rules on imports: app -> index -> models, and which library lives where."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
LAYERS = {"models": set(), "index": {"models"}, "app": {"models", "index"}}
FILES = [path for layer in LAYERS for path in sorted((ROOT / layer).rglob("*.py"))]
ONLY_IN = {
    "faiss": "index",
    "pymilvus": "index",
    "fastapi": "app",
    "starlette": "app",
    "uvicorn": "app",
    "typer": "app",
}
WITHOUT_TORCH = [
    ROOT / "models/city",
    ROOT / "models/training/metrics.py",
    ROOT / "app/http/requests.py",
    ROOT / "index/answers.py",
]
# What trains and measures; all else serves, and must not change with a phrase that is trained on.
MAY_USE_THE_GRAMMAR = [ROOT / "models/language/grammar", ROOT / "models/training", ROOT / "index/evaluation"]


def modules(path: Path) -> set[str]:
    nodes = list(ast.walk(ast.parse(path.read_text())))
    found = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    return found | {
        node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.module and not node.level
    }


def imported(path: Path) -> set[str]:
    return {module.split(".")[0] for module in modules(path)}


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(ROOT)))
def test_imports_run_one_way(path: Path) -> None:
    layer = path.relative_to(ROOT).parts[0]
    imports = imported(path)
    assert imports & set(LAYERS) <= LAYERS[layer] | {layer}
    for library, home in ONLY_IN.items():
        assert library not in imports or layer == home, f"{library} belongs in {home}/"
    if any(path == p or p in path.parents for p in WITHOUT_TORCH):
        assert "torch" not in imports


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(ROOT)))
def test_what_serves_knows_the_lexicon_and_no_grammar(path: Path) -> None:
    if not any(home in path.parents for home in MAY_USE_THE_GRAMMAR):
        assert not [m for m in modules(path) if m.startswith("models.language.grammar")]


def test_the_city_model_loads_without_torch() -> None:
    code = """
import sys, models.city.osm.map, models.city.hints, models.training.metrics, index.answers
sys.exit("torch" in sys.modules)
"""
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False).returncode == 0
