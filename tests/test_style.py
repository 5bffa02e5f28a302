"""Checks of the writing style that a machine can make; CONTRIBUTING.md describes the rest."""

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FILES = sorted(file for name in ("app", "index", "models", "tests", "docs") for file in (ROOT / name).rglob("*.py"))
TREES = {str(file.relative_to(ROOT)): ast.parse(file.read_text(encoding="utf-8")) for file in FILES}
VAGUE_NAMES = {"told", "said", "heard", "asked", "found", "some", "at", "of", "held", "kept", "seen", "worth", "beside"}
FIXED_NAMES = {("index/answering/answers.py", "at")}  # a field of the HTTP API
POOR_FIRST_WORDS = re.compile(r"(What|That|Those|See|Of|Who|Which|Why)\b")
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.MULTILINE | re.DOTALL)
FIGURE = re.compile(r"(?<![\w.])0?(\.\d{2,3})(?![\w.])")  # such as .738
MAX_README_FIGURES = 5


def defined_names(tree: ast.Module) -> Iterator[str]:
    """Yield the names of functions, classes, arguments, variables, attributes and imports that a module defines."""
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) | ast.ClassDef(name=name):
                yield name
            case ast.arg(arg=name) | ast.Name(id=name, ctx=ast.Store()) | ast.Attribute(attr=name, ctx=ast.Store()):
                yield name
            case ast.alias(asname=str(name)) | ast.ExceptHandler(name=str(name)) | ast.MatchAs(name=str(name)):
                yield name


def figures(page: str) -> set[str]:
    """Return the figures in the text of a page, without those in code."""
    return set(FIGURE.findall(CODE.sub("", (ROOT / page).read_text(encoding="utf-8"))))


def test_names_say_what_they_stand_for() -> None:
    vague = {
        (file, name)
        for file, tree in TREES.items()
        for name in defined_names(tree)
        if name.strip("_").lower() in VAGUE_NAMES
    }
    assert vague - FIXED_NAMES == set()


def test_docstrings_begin_with_a_phrase() -> None:
    documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
    docstrings = [
        (file, ast.get_docstring(node) or "")
        for file, tree in TREES.items()
        for node in ast.walk(tree)
        if isinstance(node, documented)
    ]
    assert len(docstrings) > 1000
    assert [(file, text) for file, text in docstrings if POOR_FIRST_WORDS.match(text)] == []


def test_a_class_name_has_one_meaning() -> None:
    modules = defaultdict(list)
    for file, tree in TREES.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.ClassDef) and not file.startswith("tests/"):
                modules[node.name].append(file)
    assert {name: where for name, where in modules.items() if len(where) > 1} == {}


def test_readme_quotes_few_figures_and_only_current_ones() -> None:
    quoted = figures("README.md")
    assert len(quoted) <= MAX_README_FIGURES
    assert quoted <= figures("docs/results.md")
