"""The house rules on imports: app -> index -> models, which folder may import which, which library lives where."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
LAYERS = ("models", "index", "app")
FILES = [path for layer in LAYERS for path in sorted((ROOT / layer).rglob("*.py"))]
CITY = ("models", "models.citymap")
LANGUAGE = (*CITY, "models.language", "models.language.lexicon")
GRAMMAR = "models.language.grammar"  # trains and measures alone: what is served must not change with a phrase of it
RETRIEVAL = (*LANGUAGE, "models.paper")
# What is served; it knows of the data that come to it as files, too.
SOURCES = ("models.sources.osm", "models.sources.kitti360", "models.sources.kitti360pose", "models.sources.store")
NAMES = ("models.citymap.gazetteer", "models.citymap.kinds")
PLACES = (*NAMES, "models.language.mentions", "models.posterior.places")
SERVED = (
    *RETRIEVAL,
    "models.citymap.geometry",
    *SOURCES,
    *PLACES,
    "models.citymap.scenery",
    "models.paper.fine",
    "models.posterior",
    "models.posterior.neighbours",
)
TRAINED = (*SERVED, GRAMMAR, "models.sources.synthetic", "models.training", "models.training.engine")
FITTED = (*TRAINED, "models.training.posterior")
INDEX = (
    "index",
    "index.build",
    "index.asking",
    "index.posterior",
    "index.remote",
    "index.stores",
    "index.words",
)
ANSWERS = (*SERVED, *INDEX)
MEASURES = (*FITTED, *INDEX, "index.evaluation")
REPRODUCES = (*MEASURES, "index.evaluation.reproduction")
# A package: whose modules it may import, beside its own. "models" stands for the modules right in models/.
MAY_IMPORT = {
    "models": ("models.language",),
    "models.citymap": ("models", "models.citymap.scenery", "models.citymap.geometry"),
    "models.citymap.geometry": CITY,
    "models.citymap.kinds": ("models",),
    "models.citymap.gazetteer": CITY,
    "models.citymap.scenery": CITY,
    "models.sources.osm": (*CITY, *NAMES, "models.citymap.scenery", "models.citymap.geometry"),
    "models.sources.kitti360pose": CITY,
    "models.sources.kitti360": (*CITY, "models.sources.kitti360pose"),
    "models.sources.store": (*CITY, "models.sources.kitti360pose"),
    "models.sources.synthetic": (*CITY, "models.sources.kitti360", "models.sources.kitti360pose"),
    "models.language": LANGUAGE,
    "models.language.lexicon": LANGUAGE,
    "models.language.mentions": (*LANGUAGE, *NAMES),
    "models.language.grammar": LANGUAGE,
    "models.paper": LANGUAGE,
    "models.paper.fine": RETRIEVAL,
    "models.posterior": (
        *LANGUAGE,
        *SOURCES,
        "models.citymap.geometry",
        "models.paper.fine",
        "models.posterior.places",
        "models.posterior.neighbours",
        "models.language.mentions",
    ),
    "models.posterior.neighbours": (*CITY, "models.citymap.geometry"),
    "models.posterior.places": (*LANGUAGE, "models.citymap.gazetteer", "models.language.mentions"),
    "models.training": TRAINED,
    "models.training.posterior": FITTED,
    "models.training.engine": RETRIEVAL,
    "index": ANSWERS,
    "index.build": ANSWERS,
    "index.asking": (*SERVED, "index"),
    "index.stores": (*CITY, "index"),
    "index.remote": (*CITY, "index"),
    "index.posterior": ANSWERS,
    "index.words": (*SERVED, "index"),
    "index.evaluation": MEASURES,
    "index.evaluation.reproduction": REPRODUCES,
    "app": ("app.http", "app.http.formats", "app.http.routes", "app.http.schemas", "app.jobs", "app.workers", *ANSWERS),
    "app.workers": ("app", *ANSWERS),
    "app.http": ("app", "app.http.formats", "app.http.schemas", "app.jobs", *ANSWERS),
    "app.http.schemas": ("app", "app.http", *ANSWERS),
    "app.http.formats": ("app", "app.http", "app.http.schemas", *ANSWERS),
    "app.http.routes": ("app", "app.http", "app.http.formats", "app.http.schemas", "app.jobs", *ANSWERS),
    "app.jobs": ("app", "app.http", "app.http.schemas", *MEASURES),
    "app.benchmark": ("app", *MEASURES),
    "app.cli": ("app", "app.benchmark", "app.http", "app.jobs", "app.workers", *REPRODUCES),
}
# Of a package that may be imported, the modules that may be; (importing, imported), sub-packages included.
ONLY = {
    ("models.citymap", "models"): {
        "models.compiled",
        "models.errors",
        "models.files",
        "models.processes",
        "models.spool",
        "models.strings",
    },
    ("models.posterior", "models.paper.fine"): {"models.paper.fine.located"},
    ("index.remote", "index"): {"index.build.artifact", "index.build.manifest"},
    ("index.remote", "models.citymap"): {"models.citymap.types"},
    ("index.stores", "index"): {
        "index.build.manifest",
        "index.answering.query",
    },  # where they are, and the box of a filter
    ("index.stores", "models.citymap"): {"models.citymap.types"},
}
EXCEPT = {
    "models/sources/source.py": (
        *SOURCES,
        "models.citymap.gazetteer",
        "models.citymap.scenery",
    ),  # the one door to data; the rest of models/citymap knows no source
}
ONLY_IN = {
    "transformers": "models/language/text_encoder.py",
    "faiss": "index/stores",
    "pymilvus": "index/stores",
    "grpc": "index/stores",
    "ray": "index/build/ray_shards.py",
    "fsspec": "index/remote",
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
    ROOT / "app/http/schemas/evaluate_requests.py",
    ROOT / "index/answering/answers.py",
    ROOT / "index/answering/query.py",
]


def imported(path: Path) -> set[str]:
    """The modules that a file imports anywhere in it; of `from a import b`, a.b where that is a module."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: imports are absolute"
            found |= {
                node.module if not _is_module(f"{node.module}.{a.name}") else f"{node.module}.{a.name}"
                for a in node.names
            }
    return found


def _is_module(name: str) -> bool:
    place = ROOT / name.replace(".", "/")
    return place.is_dir() or place.with_suffix(".py").is_file()


def package_of(module: str) -> str:
    """The package that a module of ours lies in; a package is its own."""
    return module if (ROOT / module.replace(".", "/")).is_dir() else module.rpartition(".")[0]


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(ROOT)))
def test_imports_run_one_way(path: Path) -> None:
    place = path.relative_to(ROOT)
    home = ".".join(place.parent.parts)
    assert home in MAY_IMPORT, f"say in MAY_IMPORT what {home} may import"
    modules = imported(path)
    ours = {package_of(module) for module in modules if module.partition(".")[0] in LAYERS}
    allowed = {home, *MAY_IMPORT[home], *EXCEPT.get(place.as_posix(), ())}
    assert ours <= allowed, f"{home} may not import {', '.join(sorted(ours - allowed))}"
    for (importing, package), named in ONLY.items():
        if f"{home}.".startswith(f"{importing}."):
            assert {module for module in modules if package_of(module) == package} <= named
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
            said = ast.get_docstring(ast.parse(path.read_text())) or ""
            assert "May import" in " ".join(said.split()), f"{path}: say what is inside, and what it may import"
