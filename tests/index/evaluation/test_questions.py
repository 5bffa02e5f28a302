import numpy as np
import pytest

from index.evaluation.questions import evaluate_questions, questions_table, vague_texts
from models.errors import DataError
from models.sources.source import open_source


def test_vague_texts_have_two_hints(data_and_queries) -> None:
    rng = np.random.default_rng(0)
    [template] = vague_texts(data_and_queries[1], [0], rng, is_plain=False)
    [plain] = vague_texts(data_and_queries[1], [0], rng, is_plain=True)
    assert template.count("The pose is") == 2
    assert plain.startswith("There is a ")
    assert not any(wind in plain for wind in ("north", "east", "south", "west"))


@pytest.mark.slow
def test_the_report_tells_of_every_number_of_questions(localizer, source) -> None:
    report = evaluate_questions(localizer, source, 5, 0, lambda *_: None)
    assert report == evaluate_questions(localizer, source, 5, 0, lambda *_: None)
    after = report["after"]
    assert [row["questions"] for row in after] == [0, 1, 2, 3]
    assert sum(row["asked"] for row in after) == sum(report["kinds"].values()) > 0
    assert after[1]["asked"] >= after[2]["asked"] >= after[3]["asked"]
    assert all(0 <= row[name] <= 1 for row in after for name in ("within_10_m", "probability", "ok"))
    head, rows = questions_table(report)
    assert all(len(row) == len(head) for row in rows)


def test_the_index_must_be_of_the_data(localizer, osm_file) -> None:
    with pytest.raises(DataError, match="other cells"):
        evaluate_questions(localizer, open_source(osm_file, "val"), 1, 0, lambda *_: None)
