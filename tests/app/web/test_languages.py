"""The page's languages: complete catalogues, the choice between them, and names that run from right to left."""

import json
import re
from pathlib import Path

import pytest
from playwright.sync_api import expect

from app.http.routes import page as page_route

SOURCE = Path(page_route.__file__).parents[2] / "web" / "source"
CATALOGUES = {file.stem: json.loads(file.read_text("utf-8")) for file in (SOURCE / "src/languages").glob("*.json")}
ENGLISH = CATALOGUES["en"]
QUESTIONS = {name: catalogue["question"] for name, catalogue in CATALOGUES.items()}
SURE = "I am at Café Sirius on East Street 2."
HEBREW = "בית קפה אור"
WIDER_THAN_SHOWN = """() => {
    const shown = "button, label, summary, select, h2, p:not(.heard), td, th";
    const isCut = (e) => e.checkVisibility() && e.clientWidth && e.scrollWidth > e.clientWidth + 1;
    return [...document.querySelectorAll(shown)].filter(isCut).map((e) => e.outerHTML);
}"""
NOT_ISOLATED = """() => {
    const walk = document.createTreeWalker(document.querySelector("#answer"), NodeFilter.SHOW_TEXT), texts = [];
    while (walk.nextNode()) if (/[\\u0590-\\u05ff]/.test(walk.currentNode.data)) texts.push(walk.currentNode);
    return texts.filter((text) => !text.parentElement.matches("bdi")).map((text) => text.data);
}"""


def shape(text):
    """Return what has to agree between languages: the placeholders of a text, the length of a list."""
    return len(text) if isinstance(text, list) else sorted(re.findall(r"\{(\w+)\}", text))


def test_there_are_six_languages():
    assert set(CATALOGUES) == {"en", "fi", "sv", "de", "fr", "es"}


@pytest.mark.parametrize("name", CATALOGUES)
def test_catalogues_have_the_same_keys_and_placeholders(name):
    catalogue = CATALOGUES[name]
    assert {key: shape(text) for key, text in catalogue.items()} == {key: shape(text) for key, text in ENGLISH.items()}
    assert all(catalogue.values())


def test_every_text_is_used():
    code = "\n".join(file.read_text("utf-8") for file in [*SOURCE.glob("src/*.ts"), SOURCE / "index.html"])
    unused = [key for key in ENGLISH if not re.search(rf'"{key}"|\bcatalogue\.{key}\b', code)]
    assert unused == []


def test_the_page_without_its_script_has_the_english_texts():
    html = (SOURCE / "index.html").read_text("utf-8")
    texts = re.findall(r'data-text="(\w+)"[^>]*>([^<]+)<', html)
    labels = re.findall(r'aria-label="([^"]+)" data-label="(\w+)"', html)
    assert len(texts) == html.count("data-text")
    assert len(labels) == html.count("data-label")
    assert [text for key, text in texts] == [ENGLISH[key] for key, _ in texts]
    assert [label for label, key in labels] == [ENGLISH[key] for _, key in labels]


@pytest.mark.slow
@pytest.mark.parametrize(("locale", "name"), [("fi-FI", "fi"), ("fr-CA", "fr"), ("pl-PL", "en")])
def test_the_page_and_its_requests_have_the_language_of_the_browser(visit, locale, name):
    visitor = visit(locale=locale)
    languages = set()
    visitor.page.on(
        "request",
        lambda request: request.resource_type == "fetch" and languages.add(request.headers["accept-language"]),
    )
    visitor.open().ask(SURE)
    assert visitor.page.get_attribute("html", "lang") == name
    assert visitor.page.inner_text("#question") == QUESTIONS[name]
    assert languages == {name}


@pytest.mark.slow
def test_examples_are_in_the_language_of_the_page(visit):
    visitor = visit(locale="fi-FI")

    def crowd(route):
        """Put two named places near every position of the map."""
        body = route.fetch().body()
        size = 8 + int.from_bytes(body[:8], "little")
        header = json.loads(body[8:size])
        grid = range(-4000, 4001, 200)  # decimetres
        places = [[x, y, name, "cafe"] for x in grid for y in grid for name in ("Aurora", "Sirius")]
        header["__metadata__"]["places"] = json.dumps(places)
        head = json.dumps(header).encode()
        route.fulfill(body=len(head).to_bytes(8, "little") + head + body[size:])

    visitor.page.route("**/points?part=0", crowd)
    visitor.open()
    near = "(Aurora|Sirius)"
    pattern = CATALOGUES["fi"]["example"].format(street=".+ Street.*", first=near, second=near)
    texts = [chip.get_attribute("title") for chip in visitor.page.locator("#chips .chip[title]").all()]
    assert len(texts) == 2
    assert all(re.fullmatch(pattern, text) for text in texts), texts
    assert visitor.page.get_attribute("#said", "placeholder") == texts[0]


@pytest.mark.slow
def test_the_example_of_every_language_is_understood(visit):
    visitor = visit().open()
    names = {"street": "East Street 2", "first": "Café Sirius", "second": "Vega Pharmacy"}
    for name, catalogue in CATALOGUES.items():
        evidence = visitor.ask(catalogue["example"].format(**names))["evidence"]
        assert sorted(each["text"] for each in evidence) == sorted(names.values()), name


@pytest.mark.slow
def test_a_chosen_language_stays_with_what_was_asked_and_typed(visit):
    visitor = visit().open()
    visitor.ask(SURE)
    page = visitor.page
    page.fill("#said", "not yet sent")
    page.select_option("#language", "sv")
    expect(page.locator("#question")).to_have_text(QUESTIONS["sv"])
    page.wait_for_selector("text=nio gånger av tio")
    assert page.input_value("#said") == "not yet sent"
    assert page.locator("#answer .told").text_content() == SURE
    page.goto("about:blank")
    visitor.open()
    assert page.inner_text("#question") == QUESTIONS["sv"]


@pytest.mark.slow
@pytest.mark.parametrize("viewport", [{"width": 1280, "height": 800}, {"width": 360, "height": 740}])
def test_no_text_is_cut_off_in_any_language(visit, viewport):
    for name in CATALOGUES:
        visitor = visit(locale=name, viewport=viewport).open()
        visitor.ask("There is a tree to my north. There is a bench to my east. Blorb quux.")
        table = {"name": "a.csv", "mimeType": "text/csv", "buffer": b"id,narrative\n1,a tree\n"}
        visitor.page.set_input_files("#table input", files=[table])
        visitor.page.wait_for_selector("#column >> visible=true")
        visitor.page.click("#move-pin")
        visitor.page.evaluate("document.querySelectorAll('details').forEach((e) => e.open = true)")
        assert visitor.page.evaluate(WIDER_THAN_SHOWN) == [], name
        assert visitor.page.evaluate("document.documentElement.scrollWidth") == viewport["width"]


@pytest.mark.slow
def test_a_right_to_left_name_leaves_the_order_beside_it(visit):
    visitor = visit().open()
    page = visitor.page

    def rename(route):
        route.fulfill(body=route.fetch().text().replace("Café Sirius", HEBREW), content_type="application/json")

    page.route("**/localize", rename)
    visitor.ask(SURE)
    row = page.locator(".evidence li", has_text=HEBREW)
    assert row.locator("bdi").first.text_content() == HEBREW
    assert page.evaluate(NOT_ISOLATED) == []
    assert page.inner_text("#status").startswith(page.inner_text("#answer h2 > span"))
