"""localize --record and replay, with a fake localizer; one test draws the page of the tiny town."""

import json
import sys
from dataclasses import replace
from html.parser import HTMLParser
from types import SimpleNamespace

import pytest
from fake_localizer import FakeLocalizer
from typer.testing import CliRunner

from app.cli.main import app
from index.answering.answers import Evidence, ModelName
from models.citymap.frame import Frame

TEXT = "I am north of a gray building. A black pole is to my west."
HOSTILE = "<script>alert(1)</script>\"'&{{ 7*7 }}"


class Translated(FakeLocalizer):
    """Names places in the language of the query."""

    def _answer(self, query):
        answer = super()._answer(query)
        return replace(answer, places=tuple(replace(p, place=f"in {query.language}") for p in answer.places))


@pytest.fixture
def use(monkeypatch):
    """Puts a fake localizer where commands look for the real one."""

    def put(localizer):
        opened = SimpleNamespace(open=lambda *_: localizer)
        monkeypatch.setitem(sys.modules, "index.answering.localizer", SimpleNamespace(Localizer=opened))
        return localizer

    return put


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments], env={"COLUMNS": "200"})


@pytest.fixture
def record(tmp_path, use):
    """A record of a fake localizer's answer."""
    use(FakeLocalizer())
    path = tmp_path / "r.json"
    result = run("localize", TEXT, "--top-k", 1, "--record", path)
    assert result.exit_code == 0, result.output
    return path


def change(path, **fields):
    document = json.loads(path.read_text())
    path.write_text(json.dumps(document | fields))


def test_a_record_is_a_request_and_its_whole_answer(record, api):
    document = json.loads(record.read_text())
    assert document["record_version"] == 1
    assert document["request"] == {"description": TEXT, "top_k": 1, "refine": "posterior"}
    served = api.post("/localize", json=document["request"]).json()
    for answer in (served, document["answer"]):
        del answer["request_id"], answer["timings_ms"]
    assert document["answer"] == served


def test_the_same_answer_is_the_same(record):
    result = run("replay", record)
    assert (result.exit_code, result.output) == (0, "the answer is the same, to the digit\n")


def test_a_record_of_the_service_can_be_replayed(record, api, use):
    use(Translated())
    request = {"description": TEXT, "ros": True, "answers": [{"question": "street", "choice": "unknown"}]}
    answer = api.post("/localize", json=request).json()
    for place in answer["places"]:
        place["place"] = "in fi"  # as a client with Accept-Language: fi gets it
    answer["language"] = "fi"
    record.write_text(json.dumps({"record_version": 1, "request": request, "answer": answer}))
    result = run("replay", record)
    assert result.exit_code == 0, result.output


def test_the_last_digit_counts(record):
    document = json.loads(record.read_text())
    document["answer"]["estimate"]["radius_m"]["p90"] = 21.000000000000004
    change(record, answer=document["answer"])
    result = run("replay", record)
    assert result.exit_code == 1
    assert result.output == "the answer differs in\n  estimate.radius_m.p90: 21.000000000000004 -> 21.0\n"


def test_another_index_or_model_comes_first(record, use):
    other = use(FakeLocalizer())
    other.facts = replace(other.facts, version="v2")
    other._answer = lambda query: replace(FakeLocalizer._answer(other, query), model=ModelName("m", "ef" * 32))
    (record.parent / "v1").mkdir()
    result = run("replay", record, "--index", record.parent)
    first, second, third, *_ = result.output.splitlines()
    assert result.exit_code == 1
    assert first == "another index: v2, the record is of v1"
    assert second == f"to replay it with its own: --index {record.parent / 'v1'}"
    assert third == f"another model: m {'ef' * 32}, the record is of posterior/fake {'cd' * 32}"
    assert 'provenance.index_version: "v1" -> "v2"' in result.output


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "give a file that 'localize --record' wrote"),
        ("[]", "is not a record"),
        ("{", "is not a record"),
        ("\ufeff{}", "is not a record"),
        ({"record_version": 2}, "record_version"),
        ({"request": {"description": "..."}}, "request.description: contains no words"),
        ({"request": {"description": TEXT, "top_k": 99}}, "request.top_k"),
        ({"answer": {}}, "answer.request_id"),
        ({"more": 1}, "more"),
        ({"request": {"description": TEXT, "index": "other"}}, "no index other in"),
        ({"request": {"description": TEXT, "prior": {"position": [24.94, 60.17], "sigma_m": 9}}}, "looks like degrees"),
    ],
)
def test_another_file_is_refused_in_one_line(record, content, message):
    if content is None:
        record.unlink()
    elif isinstance(content, str):
        record.write_text(content)
    else:
        change(record, **content)
    result = run("replay", record, "--index", record.parent)
    assert result.exit_code == 1
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert message in result.output
    assert len(result.output.splitlines()) == 1


def test_a_text_that_the_service_refuses_is_not_recorded(tmp_path, use):
    use(FakeLocalizer())
    result = run("localize", "A tree. " * 201, "--record", tmp_path / "r.json")
    assert result.exit_code == 1
    assert "has 201 sentences" in result.output
    assert "one description" in run("localize", "-", "--record", tmp_path / "r.json").output
    assert not (tmp_path / "r.json").exists()


def test_a_file_that_cannot_be_written_is_named(record):
    impossible = record / "file"  # the record is no directory
    for result in (run("localize", TEXT, "--record", impossible), run("replay", record, "--html", impossible)):
        assert result.exit_code == 1
        assert "r.json/file cannot be written" in result.output


class Visible(HTMLParser):
    """The elements of a page, and what it refers to."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.addresses, self.text = set(), [], ""
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.addresses += [value for name, value in attrs if name in ("src", "href")]

    def handle_data(self, data):
        self.text += data


def test_the_page_escapes_everything_and_needs_nothing_else(record, use):
    fake = use(FakeLocalizer(Frame()))
    fake.facts = replace(fake.facts, attribution=HOSTILE, map_name=HOSTILE)
    mention = Evidence(HOSTILE, (0, 4), HOSTILE, None, HOSTILE, None, False, 1.0, name=HOSTILE, fit=HOSTILE)

    def answer(query):
        plain = FakeLocalizer._answer(fake, query)
        places = tuple(replace(p, place=HOSTILE, supports=(HOSTILE,), contradicts=(HOSTILE,)) for p in plain.places)
        return replace(plain, places=places, warnings=(HOSTILE,), evidence=(mention, replace(mention, span=(2, 9))))

    fake._answer = answer
    assert run("localize", HOSTILE, "--record", record).exit_code == 0
    html = record.with_suffix(".html")
    assert run("replay", record, "--html", html).exit_code == 0
    page = Visible(html.read_text())
    assert {"script", "link", "iframe", "svg", "img"} & page.tags == set()
    assert page.addresses == []
    assert page.text.count(HOSTILE) >= 12
    assert "the same answer, to the digit" in page.text


def test_the_page_of_no_answer_says_so(tmp_path, use):
    use(FakeLocalizer())
    run("localize", "nowhere", "--record", tmp_path / "r.json")
    assert run("replay", tmp_path / "r.json", "--html", tmp_path / "r.html").exit_code == 0
    text = Visible((tmp_path / "r.html").read_text()).text
    assert "No position" in text
    assert "nothing there" in text


def test_the_page_has_a_map(record, localizer, use, monkeypatch):
    fake = use(FakeLocalizer())
    monkeypatch.setattr(fake, "scenery", localizer.scenery)
    html = record.with_suffix(".html")
    result = run("replay", record, "--html", html)
    assert result.exit_code == 0, result.output
    page = Visible(html.read_text())
    [address] = page.addresses
    assert address.startswith("data:image/png;base64,iVBOR")
