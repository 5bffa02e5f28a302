import ast
from pathlib import Path
from string import Formatter

import pytest

from models.citymap.colours import PALETTES
from models.language.languages.detect import LANGUAGE_NAMES
from models.language.languages.translation import (
    REPLY_LANGUAGES,
    choose_language,
    load_catalogue,
    nearest_noun,
    noun_with_article,
    replies_in,
    reply_language,
    translate,
)
from models.language.lexicon.question_classes import load_question_classes
from models.language.measures import COMPASS
from models.posterior.nearby_objects import QUARTERS

ROOT = Path(__file__).resolve().parents[4]
FOREIGN = [code for code in REPLY_LANGUAGES if code != "en"]


def templates():
    """The templates of the code, and those that it takes from lists."""
    words = {word.capitalize() for palette in PALETTES.values() for word in palette.words}
    listed = {*words, *COMPASS, *(quarter.capitalize() for quarter in QUARTERS), *LANGUAGE_NAMES.values()}
    for folder in ("app", "index", "models"):
        for path in (ROOT / folder).rglob("*.py"):
            source = path.read_text(encoding="utf-8")
            if "translat" in source:
                listed |= {
                    node.args[0].value
                    for node in ast.walk(ast.parse(source))
                    if isinstance(node, ast.Call)
                    and isinstance(node.func, ast.Name)
                    and node.func.id in ("translate", "translatable")
                    and isinstance(node.args[0], ast.Constant)
                }
    return listed


def placeholders(template):
    return sorted((name, spec) for _, name, spec, _ in Formatter().parse(template) if name is not None)


@pytest.mark.parametrize("code", FOREIGN)
def test_every_text_of_the_code_is_translated(code) -> None:
    messages = load_catalogue(code).messages
    assert set(messages) == templates()
    assert {key: placeholders(text) for key, text in messages.items()} == {key: placeholders(key) for key in messages}


@pytest.mark.parametrize("code", FOREIGN)
def test_every_noun_of_questions_is_translated(code) -> None:
    assert set(load_catalogue(code).nouns) == set(load_question_classes().things.values())


def test_a_reply_is_in_the_language_of_its_context_only() -> None:
    with replies_in("fi"):
        assert translate("at {name}", name="{Kiasma}") == "kohteen {Kiasma} kohdalla"
        with replies_in("en"):
            assert translate("at {name}", name="Kiasma") == "at Kiasma"
        assert reply_language() == "fi"
    assert translate("at {name}", name="Kiasma") == "at Kiasma"


@pytest.mark.parametrize(
    ("code", "one", "nearest"),
    [
        ("en", "an advertising board", "the nearest advertising board"),
        ("de", "eine Werbetafel", "die nächste Werbetafel"),
        ("fr", "un panneau publicitaire", "le panneau publicitaire le plus proche"),
    ],
)
def test_nouns_have_the_articles_of_their_language(code, one, nearest) -> None:
    with replies_in(code):
        assert (noun_with_article("advertising board"), nearest_noun("advertising board")) == (one, nearest)


@pytest.mark.parametrize(
    ("preferred", "languages", "chosen"),
    [
        (None, ("fi",), "fi"),
        (None, ("da",), "en"),
        (None, ("da", "sv"), "sv"),
        ("de", ("fi",), "de"),
        ("ja", ("fi",), "fi"),
        (None, (), "en"),
    ],
)
def test_the_language_of_a_reply(preferred, languages, chosen) -> None:
    assert choose_language(preferred, languages) == chosen
