"""Attacks as names on the map, and as what people type: the page shows them to the letter, and nothing of them runs."""

import json
from urllib.parse import quote

import pytest
from playwright.sync_api import expect

from app.settings import Settings
from tests.app.hostile import ATTRIBUTE, IMAGE, KINDS, MAP, SCRIPT, STREETS, hostile_index
from tests.app.web.conftest import served

pytestmark = pytest.mark.slow

VAGUE = "There is a tree to my north. There is a bench to my east."
LISTEN = "window.violations = []; addEventListener('securitypolicyviolation', (e) => violations.push(e.blockedURI));"
MARKUP = "script:not([src='page.js']), img, iframe, a[href^='javascript'], svg:not(.curve), b b, [onload], [onerror]"
TOUCH = "document.querySelectorAll('#panel *').forEach((e) => e.dispatchEvent(new MouseEvent('mouseover')))"


@pytest.fixture(scope="module")
def hostile_service(made_once, warm):
    with served(Settings(index_dir=hostile_index(made_once)), warm) as url:
        yield url


@pytest.fixture
def enter(visit, hostile_service):
    """(fragment) -> a visitor of the town; in the end nothing may have run of its names. See also `visit`."""
    visitors = []

    def enter(fragment="", errors=()):
        visitor = visit(hostile_service, errors)
        visitor.page.add_init_script(LISTEN)
        visitors.append(visitor)
        return visitor.open(fragment)

    yield enter
    for visitor in visitors:
        page = visitor.page
        page.evaluate(TOUCH)
        assert page.evaluate("[typeof window.hacked, violations]") == ["undefined", []]
        assert page.evaluate(f'[...document.querySelectorAll("{MARKUP}")].map((e) => e.outerHTML)') == []
        assert page.title() == "Hereabouts"


def text_of(visitor, selector):
    return " ".join(visitor.page.locator(selector).all_text_contents())


def address(visitor, name, value):
    """The address, once it has what was asked."""
    script = "([name, value]) => new URLSearchParams(location.hash.slice(1)).get(name) === value && location.hash"
    return visitor.page.wait_for_function(script, arg=[name, value]).json_value()


def test_an_answer_and_its_evidence_have_the_names_to_the_letter(enter):
    visitor = enter()
    for kind, name in KINDS.items():
        answer = visitor.ask(f"I am on the street, right outside a {kind}.")
        assert [one["name"] for one in answer["evidence"]] == [name], "else this tests nothing"
        assert name in text_of(visitor, ".evidence li")
        assert name in visitor.page.locator(".mention").get_attribute("aria-label")
        street, *details = answer["estimate"]["place"].split(", ")
        place = text_of(visitor, "#answer h2, #answer p, .place")
        assert street[1:] in place
        assert ", ".join(details) in place
        assert name in answer["estimate"]["place"]
        visitor.page.locator(".mention").click()


def test_questions_choices_replies_and_candidates_have_the_names_to_the_letter(enter):
    visitor = enter(errors=["422"])
    page = visitor.page
    answer = visitor.ask(VAGUE)
    choices = [choice["text"] for choice in answer["question"]["choices"]]
    hostile = [choice for choice in choices if choice in STREETS]
    assert hostile, "else this tests nothing"
    assert page.locator(".question .row button").all_text_contents()[: len(choices)] == choices
    places = page.locator(".place > span:nth-child(2)").all_text_contents()
    assert any(street in place for place in places for street in STREETS)
    with page.expect_response("**/localize"):
        page.locator(".question .row button", has_text=hostile[0]).first.click()
    page.wait_for_selector("text=You answered")
    assert hostile[0] in text_of(visitor, "#answer .chip")
    again = enter(address(visitor, "a", f"{answer['question']['id']}={hostile[0]}"))
    again.page.wait_for_selector("text=You answered")
    assert hostile[0] in text_of(again, "#answer .chip")
    with page.expect_response("**/localize"):
        page.locator("#answer .chip", has_text=hostile[0]).click()
    page.fill(".question input", f"Elm {IMAGE}")
    page.keyboard.press("Enter")
    page.wait_for_selector("#answer [role=alert]")
    assert f"Elm {IMAGE}" in text_of(visitor, "#answer .chip")


@pytest.mark.parametrize("place", [(-113, -145, SCRIPT), (112, -84, ATTRIBUTE)])
def test_a_place_that_is_clicked_is_described_with_its_names_to_the_letter(enter, place):
    x, y, name = place
    visitor = enter(f"#at={x},{y},60,0,0")
    page = visitor.page
    page.click("#describe")
    with page.expect_response("**/describe") as response:
        page.mouse.click(*visitor.middle())
    described = response.value.json()["description"]
    assert name in described, "else this tests nothing"
    expect(page.locator("#said")).to_have_value(described)
    with page.expect_response("**/localize"):
        page.keyboard.press("Enter")
    page.wait_for_selector("#answer[aria-busy=false] h2")
    assert described in text_of(visitor, "#answer .told")


def test_what_is_typed_is_shown_to_the_letter_and_again_from_the_address(enter):
    visitor = enter()
    for name in KINDS.values():
        typed = f"{name} I am on the street, right outside a bakery. {name}"
        visitor.ask(typed)
        assert text_of(visitor, "#answer .told") == typed
    again = enter(address(visitor, "q", typed))
    again.page.wait_for_selector("#answer[aria-busy=false] h2")
    expect(again.page.locator("#said")).to_have_value(typed)
    assert text_of(again, "#answer .told") == typed


def test_no_address_runs_anything(enter):
    every = quote(" ".join(KINDS.values()))
    visitor = enter(f"#q={every}&a={every}={every}&at={every}&near={every}&k={every}&{every}={every}", errors=["422"])
    for attack in KINDS.values():
        coded = quote(attack)
        for fragment in (attack, f"q={attack}", f"q={coded}&a={coded}={coded}"):
            visitor.page.evaluate("(fragment) => location.hash = fragment", fragment)
            visitor.page.wait_for_function("() => document.querySelector('#answer').ariaBusy === 'false'")


def test_a_report_is_shown_to_the_letter(enter, tmp_path):
    visitor = enter()
    report = {
        "data": SCRIPT, "split": IMAGE, "model": MAP, "method": ATTRIBUTE, "queries": IMAGE, "cells": SCRIPT,
        "retrieval": {SCRIPT: 0.5}, "localization": {IMAGE: {SCRIPT: 0.25}},
    }  # fmt: skip
    (tmp_path / "report.json").write_text(json.dumps(report))
    visitor.page.click("text=Measure how well it does")
    visitor.page.set_input_files("input[accept*=json]", tmp_path / "report.json")
    visitor.page.wait_for_selector(".report table")
    shown = text_of(visitor, ".report")
    assert f"{SCRIPT}, {IMAGE}" in shown
    assert f"{MAP} ({ATTRIBUTE})" in shown
    assert f"k = {IMAGE}" in shown
