"""POST /localize/batch with a table."""

import csv
import io
from dataclasses import replace

import pytest
import shapely
from fake_localizer import FakeLocalizer

from app.http.formats.darwin_core import COLUMNS
from index.answering.answers import LatLon, LikelyPlace
from models.citymap.frame import Frame

CSV = {"Content-Type": "text/csv"}
ADDED = ",".join(COLUMNS)


def post(api, content, params="?text=narrative", headers=CSV):
    content = content if isinstance(content, bytes) else content.encode()
    return api.post(f"/localize/batch{params}", content=content, headers=headers)


def rows_of(response, delimiter=","):
    assert response.status_code == 200, response.text
    assert response.headers["content-type"] == "text/csv; charset=utf-8"
    return list(csv.DictReader(io.StringIO(response.text, newline=""), delimiter=delimiter, strict=True))


def test_columns_are_kept_and_a_sure_answer_is_georeferenced(api):
    response = post(api, "id,narrative,note\r\n7,a tree,x\r\n")
    assert response.text.startswith(f"id,narrative,note,{ADDED}\r\n7,a tree,x,60.1700000,24.9400000,EPSG:4326,21,")
    [row] = rows_of(response)
    outline = shapely.from_wkt(row["footprintWKT"])
    assert outline.contains(shapely.Point(24.94, 60.17))
    x, y = FakeLocalizer().frame.from_wgs84(*reversed(outline.exterior.xy)).T
    assert shapely.Polygon(zip(x, y, strict=True)).area == pytest.approx(3.14 * 21**2, rel=0.02)
    assert row["georeferenceSources"] == "fakeville | © nobody | index v1 | model posterior/fake"
    assert row["georeferenceRemarks"] == "tree: 3 m to the east"
    assert row["georeferenceVerificationStatus"] == "requires verification"
    assert row["localizationStatus"] == "ok"


def test_a_row_without_a_sure_position_has_a_reason(api, fake, monkeypatch):
    def answer(query):
        plain = FakeLocalizer._answer(fake, query)
        places = (LikelyPlace(0.6, (0.0, 0.0), LatLon(60.17, 24.94), 9.0, "on Main Street"),)
        return replace(plain, status="ambiguous", places=places) if "two" in query.description else plain

    monkeypatch.setattr(fake, "_answer", answer)
    rows = rows_of(post(api, 'narrative\ntwo trees\nnowhere\n""\n...\n"a tree\x07"\n' + "a" * 4001))
    assert [(row["localizationStatus"], row["georeferenceRemarks"]) for row in rows] == [
        ("ambiguous", "60 % 60.17000, 24.94000 on Main Street"),
        ("no_match", "nothing there"),
        ("error", "the text contains no words; describe what is around you"),
        ("error", "the text contains no words; describe what is around you"),
        ("error", "the text contains a control character; send plain text"),
        ("error", "the text must have 4000 or fewer characters"),
    ]
    assert {row["georeferenceVerificationStatus"] for row in rows} == {
        "requires georeference",
        "unable to georeference",
    }
    assert {row[name] for row in rows for name in COLUMNS[:7]} == {""}


@pytest.mark.parametrize(
    "cell",
    [
        "=1+1",
        "+A1",
        "-A1",
        "@SUM(1)",
        "\t=1",
        "\r=1",
        "\n=1",
        "\uff1d1",
        '=cmd|"/c calc"!A0',
        "-1-1",
        "+",
        " =1",
        "\xa0=1",
    ],
)
def test_a_formula_gets_an_apostrophe(api, fake, monkeypatch, cell):
    def answer(query):
        plain = FakeLocalizer._answer(fake, query)
        return replace(plain, estimate=replace(plain.estimate, place=cell))

    monkeypatch.setattr(fake, "_answer", answer)
    quoted = f'"{cell}"'.replace('cmd|"/c calc"', 'cmd|""/c calc""')
    response = post(api, f"{quoted},narrative\r\n{quoted},a tree\r\n")
    header, row = csv.reader(io.StringIO(response.text, newline=""), strict=True)
    assert header[0] == row[0] == f"'{cell}"
    assert row[2 + COLUMNS.index("georeferenceRemarks")] == f"'{cell} | tree: 3 m to the east"


@pytest.mark.parametrize("cell", ["-12.5", "+3", "-0,5", "-1e-5", "a=b", "'=1", " 1", "<b>&amp;"])
def test_numbers_and_text_stay(api, cell):
    assert rows_of(post(api, f'note,narrative\n"{cell}",a tree\n'))[0]["note"] == cell


@pytest.mark.parametrize(
    ("content", "delimiter"),
    [
        ("\ufeffid,narrative\r\n1,a tree\r\n", ","),
        ('\ufeff"narrative","id"\r\n"a tree",1\r\n', ","),
        ('"id";"narrative"\n1;"a tree"', ";"),
        ("a, b;c, d, e;narrative\n1;2, 3;a tree\n", ";"),
        ("id\tnarrative\n1\ta tree, a bank; a lamp\n", "\t"),
        ('id,narrative\n1,"a tree,\r\n\r\na ""green"" one"\n', ","),
        ("id,narrative\r1,a tree\r", ","),
        ("\n id , narrative \n\n1,a tree\n\n", ","),
        ("narrative\na tree\u2028a bank\n", ","),
        ("narrative\nå träd\n", ","),
    ],
)
def test_tables_of_spreadsheets_are_read(api, fake, content, delimiter):
    response = post(api, content)
    assert (response.content[:3] == b"\xef\xbb\xbf") == content.startswith("\ufeff")
    [_, row] = csv.reader(io.StringIO(response.text.removeprefix("\ufeff"), newline=""), delimiter=delimiter)
    assert row[-1] == "ok"
    [[query]] = fake.batches
    [before] = [cells for cells in csv.reader(io.StringIO(content, newline=""), delimiter=delimiter) if cells][1:]
    assert row[: len(before)] == before
    assert query.description in before


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("id,narrative\n1,a tree\n2,a tree, a bank\n", "row 3: has 3 cells, but the header has 2; correct the row"),
        ("id,narrative\n1\n", "row 2: has 1 cells"),
        ('id,narrative\n1,"a\ntree"\n\n3\n', "row 4: has 1 cells"),
        ("id,text\n1,a tree\n", "row 1: no column has the name given for the text; the columns are id, text"),
        ("narrative,narrative\n1,a tree\n", "row 1: 2 columns"),
        ("narrative,decimalLatitude\na tree,1\n", "row 1: the columns decimalLatitude would be added; rename"),
        ('id,narrative\n1,"a tree\n2,a tree\n', "row 2: cannot be read"),
        ('id,narrative\n1,"a "tree"\n', "row 2: cannot be read"),
        ("id,narrative\n1,a tree\n2,a träd\n".encode("latin-1"), "row 3: is not UTF-8; save"),
        ("id,narrative\n1,a tree\n".encode("utf-16"), "row 1: is not UTF-8"),
        ("\n\n", "row 1: no column"),
        ("narrative\n" + "a" * 140_000, "row 2: cannot be read (field larger"),
    ],
)
def test_a_table_that_cannot_be_read_is_refused_before_any_work(api, fake, problem, content, words):
    assert words in problem(post(api, content), 422, "invalid_request", "(body)")["detail"]
    assert not fake.batches


def test_languages_come_from_the_column_or_the_header(api, fake):
    content = "narrative,lang\na,sv\nb,fi-FI\nc,xx\nd,\n"
    response = post(api, content, "?text=narrative&lang=lang", {**CSV, "Accept-Language": "de"})
    assert response.headers["content-language"] == "sv, fi, de"
    languages = {query.description: query.language for [query] in fake.batches}
    assert languages == {"a": "sv", "b": "fi", "c": "de", "d": "de"}


def test_requests_that_do_not_fit_a_table(api, problem):
    table = "narrative\na tree\n"
    assert "?text=NAME" in problem(post(api, table, ""), 422, "invalid_request", "text")["detail"]
    problem(post(api, table, "?text=narrative&lang=other"), 422, "invalid_request", "(body)")
    problem(post(api, table, "?text=narrative&index=paris"), 404, "index_not_found")
    problem(post(api, table, "?text=narrative&index=../x"), 422, "invalid_request", "index")
    problem(post(api, ""), 422, "invalid_request", "(body)")
    problem(post(api, "narrative" + "\na" * 1001), 413, "body_too_large")
    problem(post(api, "narrative\n" + "a" * 1_048_576), 413, "body_too_large")
    problem(post(api, table, headers={"Content-Type": "text/csv; charset=latin-1"}), 415, "unsupported_media_type")
    problem(api.post("/localize", content=table, headers=CSV), 415, "unsupported_media_type")
    assert post(api, "narrative\n").text == f"narrative,{ADDED}\r\n"


def test_a_map_without_georeference_has_no_table(settings, start, problem):
    with start(settings, FakeLocalizer(Frame())) as api:
        problem(post(api, "narrative\na tree\n"), 406, "no_georeference")
