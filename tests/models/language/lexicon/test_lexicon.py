from dataclasses import replace

import pytest

from models.language.grammar.files import load_grammar
from models.language.lexicon.lexicon import load_lexicon
from models.language.reader import COLOURS
from models.sources.kitti360.rules import CLASSES
from models.sources.osm.classes import load_classes

KITTI = ("building", "lamp", "pole", "road", "stop", "terrain", "trash bin", "vegetation")


def test_map_classes_lexicon_and_grammars_agree() -> None:
    lexicon = load_lexicon()
    of_maps = {rule.label for rule in CLASSES} | {row.label for row in load_classes()}
    named = lexicon.labels.keys() - lexicon.elsewhere
    assert of_maps - named - lexicon.unnamed == set(), "classes of maps without names: add them to lexicon/labels.toml"
    assert (named | lexicon.unnamed) - of_maps == set(), "names without a class of any map: move them to 'elsewhere'"
    assert not lexicon.unnamed & lexicon.labels.keys()
    assert [label for label, names in lexicon.labels.items() if not names] == []
    assert {label for group in lexicon.related for label in group} <= named
    assert tuple(lexicon.colours) == COLOURS
    for grammar in ("train", "val", "test"):
        tables = load_grammar(grammar)
        assert tables.labels.keys() <= lexicon.labels.keys(), grammar
        assert tables.colours.keys() <= lexicon.colours.keys(), grammar
    assert load_grammar("train").labels is lexicon.labels


@pytest.mark.parametrize(
    "change",
    [
        lambda lexicon: {"labels": {**lexicon.labels, "bench": [*lexicon.labels["bench"], "perch"]}},
        lambda lexicon: {"colours": {**lexicon.colours, "red": ["crimson"]}},
        lambda lexicon: {"related": lexicon.related[1:]},
        lambda lexicon: {"sizes": [*lexicon.sizes, "huge"]},
    ],
)
def test_whatever_changes_the_hash_tells(change) -> None:
    lexicon = load_lexicon()
    assert replace(lexicon).sha256 == lexicon.sha256
    assert replace(lexicon, **change(lexicon)).sha256 != lexicon.sha256


def test_what_a_class_means_in_a_map() -> None:
    lexicon = load_lexicon()
    assert lexicon.find_map_label(KITTI, "lamp") == "lamp"
    assert lexicon.find_map_label(KITTI, "street lamp") == "lamp"
    assert lexicon.find_map_label(KITTI, "hedge") == "vegetation"
    assert lexicon.find_map_label(KITTI, "lifebuoy") is None
    meant = dict(zip(*lexicon.map_names_to_labels(KITTI), strict=True))
    assert meant["bus stop"] == KITTI.index("stop")
    assert meant["lifebuoy"] == len(KITTI)


def test_names_of_what_the_map_has_stand_for_nothing_else() -> None:
    meant = {}
    for phrase, number in zip(*load_lexicon().map_names_to_labels(("bushes", "building", "tree")), strict=True):
        meant.setdefault(phrase, set()).add(number)
    assert meant["tree"] == {2}
    assert meant.get("trees", set()) <= {2}
    assert meant["thicket"] == {0}, "vegetation, which this map calls bushes"
