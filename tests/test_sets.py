"""Every set of texts has an entry in models/reports/sets.toml, and nothing is trained on a test set."""

import json
import tomllib
from pathlib import Path
from typing import Any

import pytest

from models.training.posterior.cue_texts import LABELLED_DIR

ROOT = Path(__file__).parents[1]
REPORTS = ROOT / "models" / "reports"
SETS = tomllib.loads((REPORTS / "sets.toml").read_text())["set"]


def texts_of(path: Path) -> list[dict[str, Any]]:
    if path.suffix == ".json":
        return list(json.loads(path.read_text())["queries"])
    return [json.loads(line) for line in path.read_text().splitlines()]


@pytest.mark.parametrize("entry", SETS, ids=lambda entry: entry["file"])
def test_a_set_is_what_its_manifest_says(entry) -> None:
    path = REPORTS / entry["file"]
    assert entry["role"] in ("fitted", "validation", "test")
    assert len(texts_of(path)) == entry["texts"]


def test_every_file_of_texts_is_in_the_manifest() -> None:
    files = [*REPORTS.glob("texts/**/*.jsonl"), *REPORTS.glob("towns/*.json")]
    assert {str(path.relative_to(REPORTS)) for path in files} == {entry["file"] for entry in SETS}


def test_nothing_is_trained_on_a_test_set() -> None:
    recipe = (ROOT / "Makefile").read_text() + (ROOT / "models/weights/posterior/MODEL_CARD.md").read_text()
    fitted = {entry["file"] for entry in SETS if Path(entry["file"]).name in recipe}
    assert "texts/cities" in recipe
    fitted |= {entry["file"] for entry in SETS if entry["file"].startswith("texts/cities/")}
    assert fitted
    assert fitted == {entry["file"] for entry in SETS if entry["role"] == "fitted"}


def test_sets_of_different_roles_share_no_text() -> None:
    """A text that is fitted to, or chosen by, is in no test set."""
    by_role: dict[str, set[str]] = {}
    for entry in SETS:
        for text in texts_of(REPORTS / entry["file"]):
            words = text.get("description") or text.get("text") or " ".join(text["hints"])
            by_role.setdefault(entry["role"], set()).add(words)
    assert not by_role["test"] & (by_role["fitted"] | by_role["validation"])
    assert not by_role["fitted"] & by_role["validation"]


def test_the_reader_of_cues_has_not_read_what_was_written_as_a_test() -> None:
    read = {json.loads(line)["text"] for path in LABELLED_DIR.glob("*.jsonl") for line in path.read_text().splitlines()}
    for path in REPORTS.glob("texts/*_test*.jsonl"):
        assert not read & {text["text"] for text in texts_of(path)}
