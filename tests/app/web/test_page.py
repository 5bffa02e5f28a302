import json

import pytest

from app.settings import Settings
from tests.app.web.conftest import CHIPS, served

pytestmark = pytest.mark.slow

SURE = "I am at Café Sirius on East Street 2."
VAGUE = "There is a tree to my north."


CONTRASTS = """() => {
    const part = (value) => (value /= 255) <= .04045 ? value / 12.92 : ((value + .055) / 1.055) ** 2.4;
    const light = (colour) => {
        const [r, g, b] = colour.match(/[\\d.]+/g).map(Number).map(part);
        return .2126 * r + .7152 * g + .0722 * b;
    };
    const ground = (element) => {
        for (let e = element; e; e = e.parentElement) {
            const colour = getComputedStyle(e).backgroundColor;
            if (!colour.startsWith("rgba(") || !colour.endsWith(" 0)")) return colour;
        }
    };
    const seen = [...document.querySelectorAll("#panel *")].filter((e) => e.innerText && e.checkVisibility());
    return seen.map((e) => {
        const [a, b] = [light(getComputedStyle(e).color), light(ground(e))];
        return [(Math.max(a, b) + .05) / (Math.min(a, b) + .05), e.outerHTML.slice(0, 80)];
    });
}"""


def drawn(visitor):
    visitor.page.wait_for_timeout(400)
    return visitor.page.evaluate("document.querySelector('#map .over').toDataURL()")


def test_a_prior_is_put_on_the_map_and_taken_off(visit):
    visitor = visit().open()
    visitor.ask(VAGUE)
    page = visitor.page
    page.click("text=Say where to look")
    page.click("text=I am near")
    x, y = visitor.middle()
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 40, y)
    with page.expect_response("**/localize") as response:
        page.mouse.up()
    prior = visitor.posted[-1][1]["prior"]
    assert 3 < prior["sigma_m"] < 500
    estimate = response.value.json()["estimate"]["position"]
    assert max(abs(a - b) for a, b in zip(estimate, prior["position"], strict=True)) < 3 * prior["sigma_m"]
    page.wait_for_url("**#*near=*")
    with page.expect_response("**/localize"):
        page.click("text=Remove")
    assert "prior" not in visitor.posted[-1][1]


@pytest.mark.parametrize("tool", ["circle", "box"])
def test_nothing_outside_an_area_is_answered(visit, tool):
    visitor = visit().open()
    visitor.ask(VAGUE)
    page = visitor.page
    page.click("text=Say where to look")
    page.click(f"text=Inside a {tool}")
    x, y = visitor.middle()
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y + 60, steps=4)
    with page.expect_response("**/localize") as response:
        page.mouse.up()
    within = visitor.posted[-1][1]["within"]
    for candidate in response.value.json()["candidates"]:
        east, north = candidate["position"]
        if tool == "circle":
            middle, radius = within["circle"]["center"], within["circle"]["radius_m"]
            assert (east - middle[0]) ** 2 + (north - middle[1]) ** 2 <= (radius + 1) ** 2
        else:
            west, south, right, top = within["bbox"]
            assert west - 1 <= east <= right + 1
            assert south - 1 <= north <= top + 1


def test_the_keyboard_asks_moves_the_map_and_sets_an_area(visit):
    visitor = visit().open()
    visitor.ask(VAGUE)  # by Enter
    page = visitor.page
    page.focus("#map .over")
    before = drawn(visitor)
    page.keyboard.press("ArrowLeft")
    moved = drawn(visitor)
    assert moved != before
    page.keyboard.press("+")
    assert drawn(visitor) != moved
    page.focus("#look summary")
    page.keyboard.press("Enter")
    page.focus("text=Inside a circle")
    page.keyboard.press("Enter")
    assert page.inner_text("#tip")
    page.focus("#map .over")
    with page.expect_response("**/localize"):
        page.keyboard.press("Enter")
    assert "circle" in visitor.posted[-1][1]["within"]


def test_the_address_says_all_and_is_enough_to_see_the_same(visit):
    visitor = visit().open()
    visitor.ask(SURE)
    page = visitor.page
    page.click("text=Show more on the map")
    page.click("text=Heat: where it might be")
    page.click("text=Cells that were found")
    page.wait_for_url("**#*cells=*")
    fragment = page.evaluate("location.hash")
    other = visit()
    with other.page.expect_response("**/localize"):
        other.open(fragment)
    other.page.wait_for_selector("#answer h2")
    assert other.page.inner_text("#answer h2") == page.inner_text("#answer h2")
    assert other.page.input_value("#said") == SURE
    assert other.page.is_checked("text=Heat: where it might be")


def test_heat_and_cells_are_drawn_when_they_are_wanted(visit):
    visitor = visit().open()
    visitor.ask(VAGUE)
    pictures = [drawn(visitor)]
    visitor.page.click("text=Show more on the map")
    for wanted in ("Heat: where it might be", "Cells that were found"):
        visitor.page.click(f"text={wanted}")
        pictures.append(drawn(visitor))
    assert len(set(pictures)) == 3


def test_a_service_that_went_away_is_told_of_and_asked_again(visit):
    visitor = visit(errors=["ERR_FAILED"]).open()
    page = visitor.page
    page.route("**/localize", lambda route: route.abort())
    page.fill("#said", SURE)
    page.keyboard.press("Enter")
    page.wait_for_selector("[role=alert]")
    assert "does not answer" in page.inner_text("[role=alert]")
    page.unroute("**/localize")
    page.click("button >> text=Try again")
    page.wait_for_selector("text=nine times out of ten")


def test_a_full_queue_says_when_to_try_again_with_the_request_id(visit):
    visitor = visit(errors=["429"]).open()
    body = {"title": "Too many requests wait", "detail": "Ask again.", "code": "queue_full", "request_id": "abc-1"}
    headers = {"Retry-After": "2", "Content-Type": "application/problem+json"}
    page = visitor.page
    page.route("**/localize", lambda route: route.fulfill(status=429, headers=headers, body=json.dumps(body)))
    page.fill("#said", SURE)
    page.keyboard.press("Enter")
    again = page.wait_for_selector("button >> text=Try again in")
    assert again.is_disabled()
    assert "Too many requests wait" in page.inner_text("[role=alert]")
    assert "abc-1" in page.inner_text("#answer")
    page.unroute("**/localize")
    page.wait_for_selector("#answer button:has-text('Try again'):enabled").click()
    page.wait_for_selector("text=nine times out of ten")


def test_a_key_is_asked_for_once(visit, town_index, warm):
    with served(Settings(index_dir=town_index, read_key="opensesame"), warm) as url:
        visitor = visit(url, errors=["401"])
        page = visitor.page
        page.goto(url)
        page.fill("#key", "openbarley")
        page.click("text=Use it")
        page.wait_for_selector("text=wrong")
        page.fill("#key", "opensesame")
        page.click("text=Use it")
        page.wait_for_selector(CHIPS)
        assert visitor.ask(SURE)["status"] == "ok"
        page.wait_for_url("**#*q=*")
        page.reload()
        page.wait_for_selector("text=nine times out of ten")


def test_on_a_phone_the_sheet_leaves_the_map_visible(visit):
    visitor = visit(viewport={"width": 390, "height": 780}, has_touch=True).open()
    page = visitor.page
    heights = set()
    for _ in range(3):
        page.click("#grip")
        page.wait_for_timeout(400)
        box = page.locator("#panel").bounding_box()
        heights.add(round(box["height"]))
        assert box["width"] == 390
        assert box["y"] > 90
    assert len(heights) == 3
    visitor.ask(SURE)
    assert page.locator("#answer h2").is_visible()
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    legend = page.locator("#legend").bounding_box()
    assert legend["y"] + legend["height"] < page.locator("#panel").bounding_box()["y"]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_is_legible_in_light_and_dark(visit, scheme):
    visitor = visit(color_scheme=scheme).open()
    visitor.ask("I am at Café Sirius on East Street 2. There is a helicopter to my east.")
    contrasts = visitor.page.evaluate(CONTRASTS)
    assert len(contrasts) > 20
    assert [each for each in contrasts if each[0] < 4.5] == []


def test_everything_has_a_name_for_who_hears_the_page(visit):
    visitor = visit().open()
    visitor.ask(VAGUE)
    nameless = visitor.page.evaluate(
        """() => [...document.querySelectorAll("button, input, select, textarea, [role=img]")].filter((e) =>
            !(e.textContent || e.getAttribute("aria-label") || e.labels?.length)).map((e) => e.outerHTML)"""
    )
    assert nameless == []
    assert visitor.page.inner_text("#status").startswith(visitor.page.inner_text("#answer h2"))


def test_an_evaluation_is_followed_and_its_errors_are_on_the_map(visit):
    visitor = visit().open()
    page = visitor.page
    page.click("text=Measure how well it does")
    page.click("button >> text='Measure'")
    assert "Give descriptions" in page.inner_text(".report")
    page.fill("#own", "no JSON")
    page.click("button >> text='Measure'")
    assert "not JSON" in page.inner_text(".report")
    before = drawn(visitor)
    page.fill(
        "#own", json.dumps([{"description": SURE, "position": [7, -33]}, {"description": VAGUE, "position": [0, 0]}])
    )
    page.click("button >> text='Measure'")
    page.wait_for_selector(".report table", timeout=90_000)
    assert "2 queries" in page.inner_text(".report")
    assert page.locator(".curve polyline").count() == 1
    assert drawn(visitor) != before


def test_a_saved_report_opens_and_what_is_none_is_refused(visit, tmp_path):
    visitor = visit().open()
    page = visitor.page
    page.click("text=Measure how well it does")
    (tmp_path / "none.json").write_text("[1, 2]")
    page.set_input_files("input[accept*=json]", tmp_path / "none.json")
    page.wait_for_selector("text=This file is no report")
    report = {
        "data": "<b>town</b>", "split": "test", "model": "m", "method": "posterior", "queries": 3, "cells": 9,
        "retrieval": {"1": 0.5, "3": 0.75}, "localization": {"1": {"5": 0.25, "10": 0.5}},
        "places": {"truth": [[0, 0], [0, 0], [0, 0]], "estimate": [[3, 4], [30, 40], None]},
    }  # fmt: skip
    (tmp_path / "report.json").write_text(json.dumps(report))
    page.set_input_files("input[accept*=json]", tmp_path / "report.json")
    page.wait_for_selector(".report table")
    text = page.inner_text(".report")
    assert "<b>town</b>, test" in text
    assert "0.250" in text
    assert "Half are within 50 m, nine tenths within no distance." in text
