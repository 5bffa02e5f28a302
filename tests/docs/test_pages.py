"""The pages: links lead somewhere, and what the code cites is there."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
PAGES = [*sorted(ROOT.glob("docs/*.md")), *(ROOT / f"{name}.md" for name in ("README", "CONTRIBUTING", "CHANGELOG"))]
CODE = [path for layer in ("app", "index", "models") for path in sorted((ROOT / layer).rglob("*.py"))]


def anchors(page: Path) -> set[str]:
    """Names of a page's headings, as links give them."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for link in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
        if not link.startswith("http"):
            path, _, anchor = link.partition("#")
            target = page.parent / path if path else page
            assert target.exists(), link
            assert not anchor or anchor in anchors(target), link


def test_files_that_pages_and_the_picture_name_are_there():
    named = set()
    for page in (*PAGES, ROOT / "docs/draw_flows.py"):
        references = re.findall(
            r"\b((?:app|index|models|docs|tests)/[\w./]*\w\.(?:py|toml|md|json))\b", page.read_text()
        )
        named |= {name for name in references if "/NAME." not in name}
    assert len(named) > 30
    assert [name for name in sorted(named) if not (ROOT / name).exists()] == []


def test_the_table_of_changes_names_files_that_are_there():
    page = (ROOT / "docs/architecture.md").read_text()
    rows = page.partition("## Where do I change X?")[2].partition("\n## ")[0].strip().splitlines()[2:]
    assert len(rows) >= 20
    for row in rows:
        paths = re.findall(r"`((?:app|index|models|docs|tests)/[^`]+)`", row)
        assert paths, row
        assert [path for path in paths if not (ROOT / path).exists()] == [], row


def test_pages_and_rules_that_the_code_cites_are_there():
    rules = set(re.findall(r"^\*\*Rule (\d)", (ROOT / "docs/formats.md").read_text(), re.M))
    assert rules == set("12345678")
    cited = 0
    for path in CODE:
        for name, rest in re.findall(r"([\w/]+\.md)((?:, rules? [\d, and]+)?)", path.read_text()):
            if name.startswith("docs/"):
                assert (ROOT / name).is_file(), f"{path}: {name}"
                assert set(re.findall(r"\d", rest)) <= rules, f"{path}: {name}{rest}"
                cited += 1
            assert not name.endswith(("method.md", "kitti360pose.md")) or name == "docs/method.md", f"{path}: {name}"
    assert cited > 20


def test_equations_are_where_the_index_says():
    index = (ROOT / "docs/method.md").read_text().partition("## Equation index")[2].partition("\n## ")[0]
    rows = re.findall(r"^- (M[M\d, to]+): `([\w/]+\.py)`: (.+)$", index, re.M)
    assert len(rows) > 15
    for numbers, path, names in rows:
        source = (ROOT / path).read_text()
        for name in re.findall(r"`(\w+)`", names):
            assert re.search(rf"^\s*(?:def|class) {name}\b", source, re.M), f"equation {numbers}: {path} has no {name}"
