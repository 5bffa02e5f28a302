"""Draw the pictures of the page in docs/page/ and time it: `hereabouts serve`, then `python docs/draw_page.py`.

Needs Chromium and Playwright. The pictures show the shipped map of Helsinki; the times are printed as JSON.
"""

import argparse
import json
import shutil
import sys
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Literal

from PIL import Image
from playwright.sync_api import Browser, Page, ViewportSize, sync_playwright

OUT = Path(__file__).parent / "page"
ARGUMENTS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]  # works without a GPU
WIDE, PHONE = ViewportSize(width=1280, height=800), ViewportSize(width=390, height=844)
PRECISE = (
    "I stand on a gray road. There is a park to my west, and I am east of a cycle path. A building and a wall are to "
    "my east; a gray footpath is south of me."
)
STREET = "I'm on Bulevardi between Annankatu and Fredrikinkatu, a pharmacy on my right."
VAGUE = "I can see a church and there is a tram stop near me."
FRAMES = 40
Scheme = Literal["light", "dark"]
QUALITY = 88

FIRST_PAINT = """() => new Promise((done) => {
  const seen = () => document.querySelector("#attribution").textContent
    ? requestAnimationFrame(() => done(performance.now())) : requestAnimationFrame(seen);
  seen();
})"""
FRAME = """(frames) => new Promise((done) => {
  const map = document.querySelector("#map .over"), times = [];
  map.focus();
  let last = performance.now();
  const step = (now) => {
    times.push(now - last);
    last = now;
    if (times.length > frames) return done(times.slice(1).sort((a, b) => a - b));
    map.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", shiftKey: true, bubbles: true }));
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
})"""


def ask(page: Page, text: str) -> None:
    """Type, press Enter, and wait until the map has flown to the answer."""
    page.fill("#said", text)
    page.keyboard.press("Enter")
    page.wait_for_selector("#answer[aria-busy=false] h2")
    page.evaluate("document.activeElement.blur()")
    page.wait_for_timeout(1200)


def answer(page: Page) -> None:
    """Show README's answer with its last mention highlighted."""
    ask(page, STREET)
    page.hover(".mention >> nth=2")


def ambiguous(page: Page) -> None:
    """Show several fitting places and the question about them."""
    ask(page, VAGUE)


def heat(page: Page) -> None:
    """Show the heat map of an ambiguous description."""
    ask(page, VAGUE)
    page.click("text=Show more on the map")
    page.click("text=Heat: where it might be")
    page.evaluate("document.querySelector('#panel').scrollTop = 0")


def report(page: Page) -> None:
    """Show the report of an evaluation."""
    page.click("text=Measure how well it does")
    texts = Path(__file__).parents[1] / "models/reports/texts/helsinki_west.jsonl"
    rows = [json.loads(line) for line in texts.read_text().splitlines()[:40]]
    queries = [{"description": row["text"], "position": row["goal"][::-1]} for row in rows]
    page.fill("#own", json.dumps({"queries": queries, "crs": "wgs84"}))
    page.click("button >> text='Measure'")
    page.wait_for_selector(".report table", timeout=120_000)
    page.locator(".report").scroll_into_view_if_needed()


STATES: dict[str, tuple[ViewportSize, Scheme, Callable[[Page], None]]] = {
    "start": (WIDE, "light", lambda page: None),
    "answer": (WIDE, "light", answer),
    "which": (WIDE, "light", ambiguous),
    "heat": (WIDE, "dark", heat),
    "phone": (PHONE, "light", lambda page: ask(page, PRECISE)),
    "report": (WIDE, "light", report),
}


def open_page(browser: Browser, url: str, size: ViewportSize, scheme: Scheme) -> Page:
    """Open the page and wait for its map and examples."""
    context = browser.new_context(viewport=size, color_scheme=scheme, device_scale_factor=1)
    page = context.new_page()
    page.goto(url)
    page.wait_for_selector("#chips .chip >> nth=2", timeout=60_000)
    page.wait_for_timeout(800)
    return page


def draw(browser: Browser, url: str) -> None:
    """Write one picture per state."""
    OUT.mkdir(exist_ok=True)
    for name, (size, scheme, act) in STATES.items():
        page = open_page(browser, url, size, scheme)
        act(page)
        page.wait_for_timeout(600)
        Image.open(BytesIO(page.screenshot())).save(OUT / f"{name}.webp", quality=QUALITY, method=6)
        page.context.close()


def times(browser: Browser, url: str) -> dict[str, float]:
    """Return milliseconds to the first paint of the map and the median and 95th percentile of a frame while turning."""
    first = []
    for _ in range(3):
        page = browser.new_context(viewport=WIDE).new_page()
        page.goto(url, wait_until="commit")
        first.append(page.evaluate(FIRST_PAINT))
        page.wait_for_timeout(1500)
        frames = page.evaluate(FRAME, FRAMES)
        page.context.close()
    figures = {"first_paint_ms": sorted(first)[1], "frame_p50_ms": frames[FRAMES // 2], "frame_p95_ms": frames[-2]}
    return {name: round(value, 1) for name, value in figures.items()}


def main() -> None:
    """Draw and time the page, or only time it with --times."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--url", default="http://127.0.0.1:8000/")
    arguments.add_argument("--times", action="store_true", help="only time the page")
    options = arguments.parse_args()
    chromium = shutil.which("chromium")
    if chromium is None:
        sys.exit("chromium is not installed: apt-get install chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        json.dump(times(browser, options.url), sys.stdout)
        if not options.times:
            draw(browser, options.url)
        browser.close()


if __name__ == "__main__":
    main()
