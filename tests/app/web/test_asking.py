import json
import re

import pytest
from playwright.sync_api import expect

from models.citymap.scenery.reading import LOOK_FILE
from tests.app.web.conftest import CHROMIUM, EVIL, SOFTWARE, Visitor

pytestmark = pytest.mark.slow

SURE = "I am at Café Sirius on East Street 2."
ACCENT = (200, 16, 46)
MENTIONS = json.loads(LOOK_FILE.read_text())["light"]["mentions"]


def test_who_asks_sees_the_answer_in_words_and_on_the_map(visit):
    visitor = visit().open()
    answer = visitor.ask(SURE)
    assert answer["status"] == "ok"
    page = visitor.page
    assert "East Street 2" in page.inner_text("#answer h2")
    assert "nine times out of ten" in page.inner_text("#answer")
    assert visitor.shows(*visitor.middle(), ACCENT), "the first candidate stands in the middle of the map"


def test_a_mention_lights_its_object_up_and_the_object_its_mention(visit):
    visitor = visit().open()
    answer = visitor.ask(SURE)
    page = visitor.page
    mention = page.locator(".mention", has_text="Café Sirius")
    before = page.evaluate("document.querySelector('#map .over').toDataURL()")
    mention.hover()
    page.wait_for_timeout(200)
    assert page.evaluate("document.querySelector('#map .over').toDataURL()") != before
    assert "lit" in mention.get_attribute("class")
    number = mention.get_attribute("data-mention")
    red, green, blue = bytes.fromhex(MENTIONS[int(number)][1:])
    assert mention.evaluate("e => getComputedStyle(e).textDecorationColor") == f"rgb({red}, {green}, {blue})"
    assert "lit" in page.locator(f"[data-evidence='{number}']").get_attribute("class")
    assert answer["evidence"][int(number)]["name"] == "Café Sirius"
    page.mouse.move(600, 20)
    assert page.locator(".lit").count() == 0
    mention.focus()
    assert page.locator(".lit").count() == 2, "for who has no mouse"
    x, y = visitor.middle()
    mention.evaluate("element => element.blur()")
    is_lit = False
    for dx in range(-90, 91, 6):
        for dy in range(-90, 91, 6):
            page.mouse.move(x + dx, y + dy)
            is_lit = is_lit or page.locator(f"[data-mention='{number}'].lit").count() > 0
        if is_lit:
            break
    assert is_lit, "the object under the mouse lights its words up"


def test_a_pressed_mention_shows_where_it_is(visit):
    visitor = visit().open()
    answer = visitor.ask(SURE)
    visitor.page.locator(".mention", has_text="Café Sirius").click()
    cafe = next(each for each in answer["evidence"] if each["name"] == "Café Sirius")
    x, y = ((a + b) / 2 for a, b in zip(answer["estimate"]["position"], cafe["at"], strict=True))
    visitor.page.wait_for_function(
        "([x, y]) => { const at = (new URLSearchParams(location.hash.slice(1)).get('at') ?? '').split(',');"
        " return Math.hypot(at[0] - x, at[1] - y) < 1; }",
        arg=[x, y],
    )


def test_what_was_not_understood_and_not_found_says_so(visit):
    visitor = visit().open()
    visitor.ask("I am at Café Sirius on East Street 2. There is a helicopter to my east. Blorb quux.")
    missed = visitor.page.locator(".evidence li.none")
    assert "helicopter" in missed.first.inner_text()
    assert "was not understood" in missed.first.inner_text()
    visitor.ask("I am on East Street 1, right outside the museum.")
    assert visitor.page.locator(".mention.none", has_text="museum").count() == 1
    visitor.ask("Hello, how do you do?")
    assert visitor.page.inner_text("#answer h2") == "Nothing to go by"


def test_markup_is_shown_as_text_in_what_is_typed_and_in_what_the_map_calls_things(visit):
    visitor = visit().open()
    typed = f"{EVIL} I am on East Street 1. <b>There</b> is a tree to my north."
    visitor.ask(typed)
    assert typed in visitor.page.inner_text("#answer .told")
    answer = visitor.ask("I am on East Street 1, and a book shop is on my left.")
    assert EVIL in answer["estimate"]["place"], "else this tests nothing"
    assert EVIL in visitor.page.inner_text("#answer")
    assert visitor.page.locator("#answer img, #answer b b").count() == 0
    assert visitor.page.title() == "Hereabouts"


def test_a_place_that_is_pinned_is_described_and_found_again(visit):
    visitor = visit().open()
    page = visitor.page
    page.click("#describe")
    assert page.get_attribute("#describe", "aria-pressed") == "true"
    with page.expect_response("**/describe") as response:
        page.mouse.click(*visitor.middle())
    described = response.value.json()
    expect(page.locator("#said")).to_have_value(described["description"])
    with page.expect_response("**/localize") as response:
        page.keyboard.press("Enter")
    estimate = response.value.json()["estimate"]["position"]
    away = sum((a - b) ** 2 for a, b in zip(estimate, described["position"], strict=True)) ** 0.5
    assert away < 20


def test_a_surprise_is_a_place_that_the_map_describes(visit):
    visitor = visit().open()
    with visitor.page.expect_response("**/localize"):
        visitor.page.click("text=Surprise me")
    visitor.page.wait_for_selector("#answer h2")
    described = [body for path, body in visitor.posted if path == "/localize"]
    assert len(described[-1]["description"]) > 20


def test_a_question_narrows_and_its_answer_can_be_taken_back(visit):
    visitor = visit().open()
    first = visitor.ask("There is a tree to my north. There is a bench to my east.")
    assert first["status"] == "ambiguous"
    question = first["question"]
    page = visitor.page
    assert page.inner_text(".question p") == question["text"]
    choice = question["choices"][0]
    with page.expect_response("**/localize") as response:
        page.click(f".question button >> text='{choice['text']}'")
    second = response.value.json()
    assert visitor.posted[-1][1]["answers"] == [{"question": question["id"], "choice": choice["value"]}]
    assert second["estimate"]["probability"] > first["estimate"]["probability"]
    page.wait_for_selector("text=You answered")
    with page.expect_response("**/localize") as response:
        page.click("#answer .chip")
    assert response.value.json()["question"]["id"] == question["id"]


def test_a_text_that_is_refused_is_rescued_by_a_reply(visit):
    visitor = visit().open()
    page = visitor.page
    refused = visitor.ask("There is a building near me, and a road.")
    assert refused["status"] == "no_match"
    assert page.inner_text(".question p") == refused["question"]["text"]
    with page.expect_response("**/localize") as response:
        page.click(f".question button >> text='{refused['question']['choices'][0]['text']}'")
    assert response.value.json()["estimate"] is not None
    page.wait_for_selector("text=You answered")


def test_a_name_that_is_not_offered_is_typed_and_one_that_the_map_has_not_is_taken_back(visit):
    visitor = visit(errors=["422"]).open()
    page = visitor.page
    first = visitor.ask("There is a tree to my north. There is a bench to my east.")
    assert first["question"]["is_open"], "else this tests nothing"
    for name in ("Elm = Street", "EAST street 3"):
        page.fill(".question input", name)
        with page.expect_response("**/localize") as response:
            page.keyboard.press("Enter")
        bodies = visitor.posted[-1][1]["answers"]
        assert bodies == [{"question": first["question"]["id"], "choice": name}]
        if "=" in name:
            assert response.value.status == 422
            assert "on this map" in page.inner_text("#answer [role=alert]")
            with page.expect_response("**/localize"):
                page.click("#answer .chip")
            page.wait_for_selector(".question input")
    assert response.value.json()["estimate"]["probability"] > first["estimate"]["probability"]


def test_the_other_places_are_a_click_away(visit):
    visitor = visit().open()
    answer = visitor.ask("There is a tree to my north. There is a bench to my east.")
    assert answer["status"] == "ambiguous"
    places = visitor.page.locator(".place")
    assert places.count() > 1
    places.nth(1).click()
    assert places.nth(1).get_attribute("aria-pressed") == "true"
    assert visitor.shows(visitor.middle()[0] - 9, visitor.middle()[1], ACCENT), "beside the letter"


def test_places_stand_in_order_of_probability_with_what_speaks_for_and_against(visit):
    visitor = visit().open()
    answer = visitor.ask("I am on East Street 2, right outside the bakery.")
    page, places = visitor.page, answer["places"]
    assert len(places) > 1, "else this tests nothing"
    shares = page.locator(".place .share").all_text_contents()
    assert shares == [f"{100 * place['probability']:.0f} %" for place in places]
    assert page.locator(".place .letter").all_text_contents() == list("ABCDE"[: len(places)])
    for n, place in enumerate(places[1:]):
        fits = page.locator(".fits").nth(n).locator("li").all_text_contents()
        assert fits == [
            *(f"✓for it: {fit}" for fit in place["supports"]),
            *(f"✗against it: {fit}" for fit in place["contradicts"]),
        ]


def test_no_webgl_is_no_obstacle(playwright, service):
    browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*SOFTWARE[:1], "--disable-3d-apis"])
    visitor = Visitor(browser.new_page(viewport={"width": 1200, "height": 760}), service)
    visitor.open().ask(SURE)
    assert visitor.shows(*visitor.middle(), ACCENT)
    drawn = visitor.page.evaluate(
        """() => {
            const canvas = document.querySelector("#map canvas"), pen = canvas.getContext("2d");
            const pixels = new Uint32Array(pen.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
            return new Set(pixels).size;
        }"""
    )
    assert drawn > 4, "houses, streets and greens have colours"
    assert [wrong for wrong in visitor.wrong if "WebGL" not in wrong] == []
    browser.close()


def test_coordinates_are_copied(visit):
    visitor = visit(permissions=["clipboard-read", "clipboard-write"]).open()
    answer = visitor.ask(SURE)
    visitor.page.click(".spot .copy")
    visitor.page.wait_for_selector("text=Copied")
    lat, lon = map(float, visitor.page.evaluate("navigator.clipboard.readText()").split(","))
    assert lat == pytest.approx(answer["estimate"]["wgs84"]["lat"], abs=1e-6)
    assert lon == pytest.approx(answer["estimate"]["wgs84"]["lon"], abs=1e-6)
    assert re.search(r"60\.\d{6}, 25\.\d{6}", visitor.page.inner_text(".spot"))


def test_what_is_typed_stays_whatever_else_is_pressed(visit):
    visitor = visit().open()
    page = visitor.page
    page.fill("#said", "I am at Café")
    page.click("text=Say where to look")
    page.click("text=Inside a circle")
    page.click("text=Show more on the map")
    page.click("text=Heat: where it might be")
    assert page.input_value("#said") == "I am at Café"


def test_who_asks_before_the_map_is_there_is_answered_and_the_map_is_loaded_once(visit):
    visitor = visit()
    page, loaded = visitor.page, []

    def late(route):
        loaded.append(route.request.url)
        page.wait_for_timeout(600)
        route.continue_()

    page.route("**/points?part=0", late)
    page.goto(visitor.url)
    page.fill("#said", SURE)
    page.keyboard.press("Enter")
    page.wait_for_selector("text=nine times out of ten")
    assert len(loaded) == 1
    assert [path for path, _ in visitor.posted].count("/localize") == 1


def test_an_empty_text_takes_the_answer_away(visit):
    visitor = visit().open()
    visitor.ask(SURE)
    visitor.page.fill("#said", "")
    visitor.page.keyboard.press("Enter")
    expect(visitor.page.locator("#answer")).to_be_empty()
    assert visitor.page.get_attribute("#answer", "aria-busy") == "false"


def test_an_area_off_the_map_says_so(visit):
    visitor = visit()
    visitor.page.goto(visitor.url + "#q=I+am+at+Caf%C3%A9+Sirius&circle=90000,90000,50")
    visitor.page.wait_for_selector("text=No place inside the area")


def test_garbage_in_the_address_is_left_out(visit):
    visitor = visit()
    visitor.open("#q=I+am+at+Caf%C3%A9+Sirius&near=1,2,-5&circle=,,&box=a,b,c,d&k=x&a=nothing&at=1,2")
    visitor.page.wait_for_selector("#answer h2")
    bodies = [body for path, body in visitor.posted if path == "/localize"]
    assert set(bodies[-1]) == {"description", "top_k", "heat_map"}
