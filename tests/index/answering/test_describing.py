import re
from dataclasses import replace

import numpy as np
import pytest

from index.answering.describing import (
    FAR_VISIBLE_M,
    MAX_FACTS,
    VISIBLE_M,
    Describer,
    NamedFacts,
    VisibleObject,
    hint_text,
    named_text,
    street_facts,
)
from index.answering.query import Query
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, build_gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.citymap.types import Hint
from models.language.measures import first_bearing
from models.posterior.neighbours.neighbour_index import build_neighbour_index
from tests.models.citymap.gazetteer.made_town import line, made_gazetteer, point, ring

WIND = re.compile(r"to my (\w+)\.|(\w+) of me\.")
OFF_M = 1.5  # what is stored of ways is rounded, and of the node beside a position


@pytest.fixture(scope="module")
def surroundings(source, cells):
    return build_neighbour_index(source.geometry(), cells)


@pytest.fixture(scope="module")
def bare(surroundings):
    """As if nothing were near any node."""
    return replace(surroundings, objects=replace(surroundings.objects, parts=0 * surroundings.objects.parts))


@pytest.fixture(scope="module")
def nameless(source, surroundings):
    """Describes the town as if nothing had a name."""
    data = source.data
    return Describer(data.gallery, data.palette, data.frame, surroundings, EMPTY_GAZETTEER)


@pytest.fixture(scope="module")
def positions(cells):
    """[40, 2] at random, near cells."""
    rng = np.random.default_rng(11)
    return rng.permutation(cells.center_m[:, :2])[:40] + rng.uniform(-5, 5, (40, 2))


def apart(bearing_deg, other_deg):
    """Degrees from one direction to another, -180..180."""
    return (bearing_deg - other_deg + 180) % 360 - 180


def test_positions_are_found_again_without_names_too(localizer, nameless, positions):
    plain = [nameless.describe(position).description for position in positions]
    assert not any("Street" in text or "Path" in text for text in plain)
    answers = localizer.localize([Query(text) for text in plain])
    errors = [np.hypot(*(np.array(a.estimate.position) - p)) for a, p in zip(answers, positions, strict=True)]
    assert (np.array(errors) <= 10).mean() >= 0.95


def test_what_is_said_is_true(localizer, scan, positions):
    points = {i.source_id: i.points_m[:, :2] for i in scan.instances}
    checked = 0
    for x, y in positions.tolist():
        for fact in localizer.describe((x, y)).hints:
            way = np.array(fact.at) - (x, y)
            assert np.hypot(*way) == pytest.approx(fact.away_m, abs=0.06)
            if fact.instance != STREET_KIND:
                assert fact.away_m <= VISIBLE_M
                assert np.hypot(*(points[fact.source_id] - fact.at).T).min() <= OFF_M
            if fact.bearing_deg is not None:
                assert abs(apart(fact.bearing_deg, np.degrees(np.arctan2(*way)))) <= 5 / fact.away_m
            wind = WIND.search(fact.text)
            if wind and fact.bearing_deg is not None:
                assert abs(apart(fact.bearing_deg, first_bearing(wind[1] or wind[2]))) <= 45.1
                checked += 1
    assert checked > 50


def test_three_to_six_sentences_each_of_another_thing(localizer, nameless, positions):
    for position in positions:
        for described in (localizer.describe((float(position[0]), float(position[1]))), nameless.describe(position)):
            assert 3 <= len(described.hints) <= MAX_FACTS
            assert described.description == " ".join(fact.text for fact in described.hints)
            for values in ([f.source_id for f in described.hints], [f.text for f in described.hints]):
                assert len(set(values)) == len(values)
            names = [fact.name for fact in described.hints if fact.name]
            assert len(set(names)) == len(names)


def test_the_same_words_each_time(localizer, nameless, positions):
    for x, y in positions[:5].tolist():
        assert localizer.describe((x, y)) == localizer.describe((x, y))
        assert nameless.describe(np.array([x, y])) == nameless.describe(np.array([x, y]))


def test_a_described_position_knows_its_cell_and_place(localizer, cells):
    described = localizer.describe((60.0, 61.0))
    nearest = np.hypot(*(localizer.gallery.cells.center_m[:, :2] - (60.0, 61.0)).T).argmin()
    assert described.cell_id == localizer.gallery.cells.ids[nearest]
    assert described.position == (60.0, 61.0)
    assert described.place.startswith("at the corner of ") or described.place.startswith("on ")
    assert localizer.frame.from_wgs84(described.wgs84.lat, described.wgs84.lon) == pytest.approx([60.0, 61.0], abs=0.02)


def test_the_place_is_in_the_language_of_the_reply(localizer):
    english, finnish = localizer.describe((60.0, 61.0)), localizer.describe((60.0, 61.0), "fi")
    assert english.place != finnish.place
    assert replace(finnish, place=english.place) == english
    assert english.address["road"] in english.place


def test_an_object_has_a_position_on_it(localizer):
    street = localizer.describe((60.0, 61.0)).hints[0]
    x, y = localizer.position_of(street.source_id)
    assert localizer.describe((x, y)).hints[0].name == street.name
    assert localizer.position_of("way/0") is None


@pytest.mark.parametrize("position", [(-400.0, 0.0), (1e8, 1e8), (-1e8, 0.0)])
def test_there_is_nothing_to_say_off_the_map(localizer, position):
    assert localizer.describe(position) is None


def test_there_is_nothing_to_say_where_nothing_is_near(source, bare):
    data = source.data
    empty = Describer(data.gallery, data.palette, data.frame, bare, EMPTY_GAZETTEER)
    assert empty.describe(data.cells.center_m[0, :2]) is None


def test_names_are_told_from_farther_where_little_else_can_be_told(source, surroundings, bare, nameless, positions):
    data = source.data
    place_m = next(position for position in positions if len(nameless.describe(position).hints) == MAX_FACTS)
    x, y = place_m.tolist()
    town = named(
        ("amenity/cafe", "Elmo", point(x, y + 20)),
        ("amenity/pub", "Anna", point(x, y + 50)),
        ("amenity/bar", "Berta", point(x, y + 60)),
        ("amenity/pub", "Otto", point(x + 100, y)),
        ("shop/books", "Arkadia", point(x, y - FAR_VISIBLE_M - 1)),
    )
    full, empty = (Describer(data.gallery, data.palette, data.frame, near, town) for near in (surroundings, bare))
    assert [fact.name for fact in full.describe(place_m).hints if fact.name in {"Elmo", "Anna", "Berta", "Otto"}] == [
        "Elmo"
    ]
    # each side in turn
    assert [fact.name for fact in empty.describe(place_m).hints] == ["Elmo", "Anna", "Otto", "Berta"]


def test_the_street_and_what_has_a_name():
    town = made_gazetteer()
    place_m = np.array([215.0, 84.0])
    [street] = street_facts(town, place_m, 2)
    assert street.text == "I am at the corner of West 25th Street and 10th Avenue."
    assert (street.instance, street.name, street.at) == (STREET_KIND, "West 25th Street", (215.0, 80.0))
    facts = NamedFacts(town).facts(place_m, VISIBLE_M)
    assert [fact.text for fact in facts] == ["Bottino is 8 m to my north.", "Chelsea Park is 29 m to my southeast."]
    assert (facts[0].at, facts[0].away_m, facts[0].bearing_deg) == ((215.0, 92.0), 8.0, 0.0)


@pytest.mark.parametrize(
    ("place_m", "most_crossing", "phrase"),
    [
        ((90, 84), 0, ["I am on West 25th Street, between 11th Avenue and 10th Avenue."]),
        ((90, 84), 1, ["I am on West 25th Street.", "11th Avenue is 90 m to my west."]),
        (
            (90, 84),
            3,
            ["I am on West 25th Street.", "11th Avenue is 90 m to my west.", "10th Avenue is 110 m to my east."],
        ),
        ((100, 104), 0, ["West 25th Street is 24 m to my south."]),
        ((100, 300), 3, []),
    ],
)
def test_where_on_a_street(place_m, most_crossing, phrase):
    facts = street_facts(made_gazetteer(), np.array(place_m, dtype=float), most_crossing)
    assert [fact.text for fact in facts] == phrase


def named(*objects):
    """A gazetteer of (kind, name, segments)."""
    words = [GazetteerObject((kind,), (name,)) for kind, name, _ in objects]
    return build_gazetteer(words, [shape for *_, shape in objects], [len(shape) > 1 for *_, shape in objects])


def texts(gazetteer):
    return [fact.text for fact in NamedFacts(gazetteer).facts(np.zeros(2), VISIBLE_M)]


def test_what_nobody_sees_is_not_told():
    kinds = ("office/company", "entrance/main", "amenity/parking/underground", "public_transport/stop_position_tram")
    assert texts(named(*((kind, f"Thing {n}", point(0, 5)) for n, kind in enumerate(kinds)))) == []
    assert texts(named(("shop/books", "Arkadia", point(0, VISIBLE_M + 1)))) == []


def test_a_name_is_told_once_and_never_that_of_a_street():
    town = named(
        ("amenity/cafe", "Elmo", point(0, 20)),
        ("amenity/pub", "ELMO", point(9, 0)),
        ("highway/bus_stop", "Main Street & Elm", point(0, 4)),
        (STREET_KIND, "Main Street", line((-50, 2), (50, 2))[:1]),
    )
    assert texts(town) == ["ELMO is 9 m to my east."]


def test_rare_names_come_before_frequent_ones_and_things_before_the_park_they_are_in():
    often = [("amenity/atm", "Otto", point(0, 6 + 900 * n)) for n in range(9)]
    assert texts(named(*often, ("amenity/cafe", "Elmo", point(12, 0))))[0] == "Elmo is 12 m to my east."
    park = ("leisure/park", "Great Park", ring(-90, -90, 90, 90))
    assert texts(named(park, ("amenity/cafe", "Elmo", point(-12, 0)))) == [
        "Elmo is 12 m to my west.",
        "I am at Great Park.",
    ]


@pytest.mark.parametrize(
    ("hint", "is_ground", "turn", "text"),
    [
        (Hint("south", "building", "gray"), False, 0, "A gray building is 7 m to my north."),
        (Hint("south", "building", "gray"), False, 1, "There is a gray building 7 m north of me."),
        (Hint("east", "advertising column"), False, 0, "An advertising column is 7 m to my west."),
        (Hint("east", "bench", "orange"), False, 1, "There is an orange bench 7 m west of me."),
        (Hint("north", "steps"), False, 0, "Steps are 7 m to my south."),
        (Hint("north", "bushes", "green"), False, 1, "There are green bushes 7 m south of me."),
        (Hint("west", "water"), False, 0, "Water is 7 m to my east."),
        (Hint("on-top", "road", "gray"), True, 0, "I stand on the gray road."),
        (Hint("on-top", "pole"), False, 1, "A pole is right beside me."),
    ],
)
def test_hints_in_words(hint, is_ground, turn, text):
    assert hint_text(hint, 6.6, is_ground=is_ground, turn=turn) == text


def test_what_is_just_west_of_north_has_no_bearing_of_360():
    fact = VisibleObject("tree", None, None, np.array([-0.001, 10.0])).fact("A tree.", np.zeros(2))
    assert fact.bearing_deg == 0.0


def test_names_in_words():
    assert named_text("Elmo", np.array([0.3, -0.4])) == "I am at Elmo."
    assert named_text("Elmo", np.array([10.0, -10.0])) == "Elmo is 14 m to my southeast."
