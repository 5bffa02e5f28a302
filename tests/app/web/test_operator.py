"""The page for an operator: paste transcripts, correct answers, save them, and locate tables."""

import json

import pytest
from playwright.sync_api import expect

from models.sources.place_texts import load_place_texts

pytestmark = pytest.mark.slow

VAGUE = "There is a tree to my north. There is a bench to my east."
TABLE = 'id;narrative;note\n1;"a tree, ""tall""\nby a bench";x\n\n2;Café;y\n3;park;5" pipe\n'
DROP = """([name, text]) => {
    const data = new DataTransfer();
    data.items.add(new File([text], name));
    const drop = new DragEvent("drop", {dataTransfer: data, bubbles: true, cancelable: true});
    document.querySelector("#map").dispatchEvent(drop);
}"""


def test_a_transcript_is_pasted_as_it_is(visit):
    visitor = visit().open()
    page = visitor.page
    lines = "00:12 Caller: I am at Café Sirius.\n00:15 Dispatcher: On East Street 2?\n"
    answer = visitor.ask(lines)
    assert page.locator(".told").text_content() == lines
    assert {evidence["text"] for evidence in answer["evidence"]} == {"Café Sirius", "East Street 2"}
    page.fill("#said", lines * 40)
    box = page.locator("#said")
    assert box.evaluate("e => e.scrollHeight > e.clientHeight && e.clientHeight < innerHeight / 2")


def test_a_text_above_the_limit_stays_and_is_not_sent(visit):
    visitor = visit(locale="de", viewport={"width": 360, "height": 700})
    page = visitor.page
    page.goto(visitor.url)
    page.fill("#said", "a tree 🌳 " * 500)
    page.keyboard.press("Enter")
    length = page.locator("#length")
    expect(length).to_contain_text("500 Zeichen zu viel; höchstens 4000")
    assert page.input_value("#said") == "a tree 🌳 " * 500
    page.fill("#said", "a tree")
    expect(length).to_be_hidden()
    assert "/localize" not in [path for path, _ in visitor.posted]


def test_the_right_place_is_stored_and_the_answer_saved_as_a_record(visit, corrections_file):
    visitor = visit().open()
    answer = visitor.ask(VAGUE)
    page = visitor.page
    page.locator(".place").nth(1).click()
    with page.expect_response("**/corrections") as response:
        page.get_by_text("It is at B").click()
    assert response.value.status == 201
    page.wait_for_selector("text=The correction is stored.")
    expect(page.locator("#correct")).to_be_disabled()
    row = json.loads(corrections_file.read_text().splitlines()[-1])
    assert row["request"]["description"] == VAGUE
    assert row["place_rank"] == 2
    place = answer["places"][1]["wgs84"]
    assert load_place_texts(corrections_file)[-1].goal == pytest.approx((place["lat"], place["lon"]), abs=1e-6)
    with page.expect_download() as download:
        page.click("#save")
    assert download.value.suggested_filename == f"hereabouts-{answer['request_id']}.json"
    record = json.loads(download.value.path().read_text("utf-8"))
    sent = [body for path, body in visitor.posted if path == "/localize"][-1]
    assert record == {"record_version": 1, "request": sent, "answer": answer}


def test_the_pin_is_dragged_or_put_by_keys(visit):
    visitor = visit(viewport={"width": 1000, "height": 700}).open()
    answer = visitor.ask("I am at Café Sirius on East Street 2.")
    page = visitor.page
    page.wait_for_timeout(600)  # the map flies to the answer
    page.click("#move-pin")
    x, y = visitor.middle()
    page.mouse.move(x, y - 26)
    page.mouse.down()
    page.mouse.move(x + 60, y - 26, steps=4)
    page.mouse.up()
    with page.expect_request("**/corrections") as request:
        page.get_by_text("It is at the pin").click()
    body = request.value.post_data_json
    (east, north), (from_east, from_north) = body["position"], answer["places"][0]["position"]
    assert east - from_east > 5
    assert abs(north - from_north) < 3
    assert body["place_rank"] is None
    page.wait_for_selector("text=The correction is stored.")
    page.focus("#move-pin")
    page.keyboard.press("Enter")
    page.focus("#map .over")
    page.keyboard.press("Enter")
    with page.expect_request("**/corrections") as request:
        page.focus("#correct")
        page.keyboard.press("Enter")
    assert abs(request.value.post_data_json["position"][0] - from_east) < 3
    page.wait_for_selector("text=The correction is stored.")


def test_a_refused_correction_says_why_and_a_service_without_a_file_offers_none(visit):
    visitor = visit(errors=["403"]).open()
    page = visitor.page
    problem = {"title": "No key is set", "detail": "Set a key.", "code": "key_not_set"}
    page.route("**/corrections", lambda route: route.fulfill(status=403, json=problem))
    visitor.ask(VAGUE)
    page.click("#correct")
    page.wait_for_selector(".actions >> text=No key is set. Set a key.")
    expect(page.locator("#correct")).to_be_enabled()
    page.route("**/info", lambda route: route.fulfill(json=route.fetch().json() | {"corrections": False}))
    page.reload()
    visitor.ask(VAGUE)
    page.wait_for_selector("#save")
    assert page.locator("#correct, #move-pin").count() == 0


@pytest.fixture
def tables(visit):
    """(answers to the requests with a table) -> (a visitor, the tables that were sent)."""

    def open_page(answer, **options):
        visitor = visit(**options)
        sent = []

        def locate(route):
            request = route.request
            sent.append(request.post_data)
            assert request.headers["content-type"] == "text/csv"
            assert request.url.endswith("/localize/batch?text=narrative")
            answer(route, len(sent))

        def few_rows(route):
            info = route.fetch().json()
            route.fulfill(json=info | {"limits": info["limits"] | {"max_rows": 2}})

        visitor.page.route("**/info", few_rows)
        visitor.page.route("**/localize/batch?*", locate)
        return visitor.open(), sent

    return open_page


def with_positions(route, _number):
    """Answer as the service does: the same rows with a column more."""
    rows = route.request.post_data.replace("\nby", "_by").split("\n")
    lines = [f"{row.replace('_by', chr(10) + 'by')};{'1.5' if n else 'decimalLatitude'}" for n, row in enumerate(rows)]
    route.fulfill(body="\r\n".join(lines) + "\r\n", content_type="text/csv")


def test_a_table_is_dropped_sent_in_parts_and_comes_back(tables):
    visitor, sent = tables(with_positions)
    page = visitor.page
    page.evaluate(DROP, ["calls.csv", "\ufeff" + TABLE])
    options = page.locator("#column option")
    expect(options).to_have_count(4)
    assert options.all_text_contents()[1:] == ["id", "narrative", "note"]
    page.select_option("#column", "narrative")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    with page.expect_download() as download:
        page.get_by_text("Save the table (3 of 3 rows)").click()
    assert sent == [
        'id;narrative;note\n1;"a tree, ""tall""\nby a bench";x\n2;Café;y',
        'id;narrative;note\n3;park;5" pipe',
    ]
    assert download.value.suggested_filename == "calls-places.csv"
    assert download.value.path().read_bytes().decode() == (
        '\ufeffid;narrative;note;decimalLatitude\r\n1;"a tree, ""tall""\nby a bench";x;1.5\r\n'
        '2;Café;y;1.5\r\n3;park;5" pipe;1.5\r\n'
    )


def test_a_failed_part_is_shown_a_busy_service_is_tried_again_and_what_is_done_is_offered(tables):
    def busy_then_wrong(route, number):
        problem = {"title": "Too many", "detail": "Wait.", "code": "queue_full"}
        if number == 1:
            route.fulfill(status=429, json=problem, headers={"Retry-After": "1"})
        elif number == 2:
            with_positions(route, number)
        else:
            route.fulfill(status=422, json=problem | {"title": "Row 3 is ragged", "detail": "Correct it."})

    visitor, sent = tables(busy_then_wrong, errors=["422", "429"])
    page = visitor.page
    page.set_input_files("#table input", files=[{"name": "a.csv", "mimeType": "text/csv", "buffer": TABLE.encode()}])
    page.select_option("#column", "narrative")
    page.click("#table button[type=submit]")
    page.wait_for_selector("#table [role=alert] >> text=Row 3 is ragged. Correct it.")
    page.wait_for_selector("text=Save the table (2 of 3 rows)")
    assert sent[0] == sent[1]


def test_a_table_is_cancelled(tables):
    visitor, _ = tables(lambda route, number: None)
    page = visitor.page
    page.evaluate(DROP, ["calls.csv", TABLE])
    page.select_option("#column", "narrative")
    page.click("#table button[type=submit]")
    page.wait_for_selector("#table progress")
    page.click("#table button[type=submit]")
    page.wait_for_selector("#table [role=alert] >> text=Cancelled.")


def test_a_file_that_is_no_table_is_refused(visit):
    page = visit().open().page
    for content, words in ((b"a;b\n\xe4;1\n", "CSV UTF-8"), (b"", "no rows"), (b"narrative\n\n", "no rows")):
        page.set_input_files("#table input", files=[{"name": "a.csv", "mimeType": "text/csv", "buffer": content}])
        expect(page.locator("#table [role=alert]")).to_contain_text(words)
        expect(page.locator("#column")).to_be_hidden()
