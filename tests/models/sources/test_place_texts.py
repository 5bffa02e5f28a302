import gzip
import json

import pytest

from models.errors import DataError
from models.sources.place_texts import PlaceText, load_place_texts

ROWS = [
    {"text": "At 25th and 10th", "goal": [40.75, -74.0], "start": [40.76, -73.99], "id": 5},
    {"text": "Кафе Пушкин", "goal": [0, 180]},
    {"text": "北京", "goal": [-90.0, -180.0], "start": None},
]
EXPECTED = [
    PlaceText("At 25th and 10th", (40.75, -74.0), (40.76, -73.99)),
    PlaceText("Кафе Пушкин", (0.0, 180.0)),
    PlaceText("北京", (-90.0, -180.0)),
]
GOOD = json.dumps(ROWS[0])


def lines(*rows: object) -> bytes:
    return "\n".join(json.dumps(row, ensure_ascii=False) for row in rows).encode()


def test_texts_are_read_from_plain_and_packed_files(tmp_path) -> None:
    plain, packed = tmp_path / "texts.jsonl", tmp_path / "texts.jsonl.gz"
    plain.write_bytes(lines(*ROWS))
    packed.write_bytes(gzip.compress(lines(*ROWS)))
    assert load_place_texts(plain) == load_place_texts(packed) == EXPECTED


def test_blank_lines_are_left_out(tmp_path) -> None:
    path = tmp_path / "texts.jsonl"
    path.write_bytes(b"\n" + lines(ROWS[0]) + b"\r\n\n  \n" + lines(ROWS[1]) + b"\n")
    assert load_place_texts(path) == EXPECTED[:2]


@pytest.mark.parametrize(
    "line",
    [
        "no JSON",
        "[1, 2]",
        "5",
        "null",
        '{"goal": [60, 25]}',
        '{"text": "hello"}',
        '{"text": "!!!", "goal": [60, 25]}',
        '{"text": "", "goal": [60, 25]}',
        '{"text": "hello", "goal": [60]}',
        '{"text": "hello", "goal": [60, 25, 3]}',
        '{"text": "hello", "goal": 60}',
        '{"text": "hello", "goal": null}',
        '{"text": "hello", "goal": ["north", 25]}',
        '{"text": "hello", "goal": [90.1, 25]}',
        '{"text": "hello", "goal": [60, -180.1]}',
        '{"text": "hello", "goal": [NaN, 25]}',
        '{"text": "hello", "goal": [Infinity, 25]}',
        '{"text": "hello", "goal": [60, 25], "start": [600, 25]}',
        '{"text": "hello", "goal": [60, 25], "start": "here"}',
        '{"text": null, "goal": [60, 25]}',
        '{"text": {"a": 1}, "goal": [60, 25]}',
    ],
)
def test_a_wrong_line_is_named_by_its_number(tmp_path, line) -> None:
    path = tmp_path / "texts.jsonl"
    path.write_text(f"{GOOD}\n\n{line}\n{GOOD}\n")
    with pytest.raises(DataError, match=r"texts\.jsonl, line 3: .*'goal'"):
        load_place_texts(path)


@pytest.mark.parametrize("content", [b"", b"\n\n  \n"])
def test_a_file_without_texts_is_refused(tmp_path, content) -> None:
    for name, packed in (("a.jsonl", content), ("a.jsonl.gz", gzip.compress(content))):
        (tmp_path / name).write_bytes(packed)
        with pytest.raises(DataError, match="no texts"):
            load_place_texts(tmp_path / name)


def flipped(packed: bytes) -> bytes:
    return packed[:12] + bytes(255 - b for b in packed[12:40]) + packed[40:]


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("gone.jsonl", None),
        ("gone.jsonl.gz", None),
        ("latin.jsonl", b'{"text": "Caf\xe9", "goal": [60, 25]}'),
        ("plain.jsonl.gz", GOOD.encode()),
        ("cut.jsonl.gz", gzip.compress(lines(*ROWS * 50))[:-20]),
        ("flipped.jsonl.gz", flipped(gzip.compress(lines(*ROWS * 50)))),
    ],
)
def test_files_that_cannot_be_read_are_refused(tmp_path, name, content) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(DataError, match="cannot be read"):
        load_place_texts(tmp_path / name)


def test_a_folder_is_no_file(tmp_path) -> None:
    with pytest.raises(DataError):
        load_place_texts(tmp_path)
