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


def imported(path: Path) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            found.add(node.module.split(".")[0])
    return found


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(ROOT)))
def test_imports_run_one_way(path: Path) -> None:
    layer = path.relative_to(ROOT).parts[0]
    imports = imported(path)
    assert imports & set(LAYERS) <= LAYERS[layer] | {layer}
    for library, home in ONLY_IN.items():
        assert library not in imports or layer == home, f"{library} belongs in {home}/"
    if any(path == p or p in path.parents for p in WITHOUT_TORCH):
        assert "torch" not in imports


def test_the_city_model_loads_without_torch() -> None:
    code = """
import sys, models.city.source, models.training.metrics, index.answers
sys.exit("torch" in sys.modules)
"""
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False).returncode == 0
