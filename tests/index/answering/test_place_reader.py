"""Free descriptions on a map with names: the tiny town has streets from west to east and paths from south to north."""

from dataclasses import replace

import numpy as np
import pytest

from index.answering import place_reader
from index.answering.place_reader import near_hints, with_one_owner
from index.answering.query import Prior, Query
from models.language.measures import find_measures
from models.language.mentions.cues import Cue
from models.language.mentions.mentions import Mention

BLOCK_M = 60.0


def corner_m(localizer, street, path):
    """[2] where a street and a path cross: the town's south-west corner is at (-150, -150)."""
    lat, lon = 60.0 + street * BLOCK_M / 111_412.0, 25.0 + path * BLOCK_M / 55_800.0
    return localizer.frame.from_wgs84(lat, lon)


def answer(localizer, text: str, **given):
    [result] = localizer.localize([Query(text, **given)])
    return result


@pytest.mark.parametrize(
    "text", ["I'm at the corner of East Street 2 and North Path 3", "east street 2 at north path 3"]
)
def test_a_corner_is_found_and_said(localizer, text) -> None:
    result = answer(localizer, text)
    assert result.estimate is not None
    assert np.hypot(*(result.estimate.position - corner_m(localizer, 2, 3))) < 8.0
    assert result.estimate.place is not None
    assert "corner of" in result.estimate.place
    assert all(name in result.estimate.place for name in ("East Street 2", "North Path 3"))
    assert result.estimate.heading is None, "nothing tells where the speaker looks"


def test_a_span_lies_between_its_paths(localizer) -> None:
    result = answer(localizer, "I'm on East Street 2 between North Path 1 and North Path 2")
    west, east = corner_m(localizer, 2, 1), corner_m(localizer, 2, 2)
    assert result.estimate is not None
    x, y = result.estimate.position
    assert west[0] - 10 < x < east[0] + 10
    assert abs(y - west[1]) < 12


def test_a_heading_is_told_by_left_and_ahead(localizer) -> None:
    result = answer(
        localizer, "I'm at East Street 2 and North Path 3. East Street 3 is straight ahead, North Path 2 is on my left."
    )
    assert result.estimate is not None
    heading = result.estimate.heading
    assert heading is not None
    assert min(heading.mean_deg, 360 - heading.mean_deg) < 40, "the next street lies to the north"


def test_a_text_that_comes_again_is_not_read_again(localizer, monkeypatch) -> None:
    text = "I'm on East Street 2 where North Path 1 begins, and it rains"
    first = answer(localizer, text)
    monkeypatch.setattr(place_reader, "find_mentions", None)
    again = answer(localizer, text)
    assert first.estimate is not None
    assert again.estimate is not None
    assert again.estimate.position == first.estimate.position
    assert again.evidence == first.evidence
    with pytest.raises(TypeError):
        answer(localizer, f"{text} no more")


def test_what_is_remembered_is_bounded_by_its_size(localizer) -> None:
    owned = localizer.posterior.places._cache
    owned.clear()
    answer(localizer, "a bench by some trees, a building across the street, at a crossing")
    [mentions] = owned.values()
    arrays = sum(mention.objects.nbytes + mention.weights.nbytes for mention in mentions)
    assert arrays > 0
    assert arrays < owned.currsize < arrays + 20_000
    assert owned.maxsize < 2**25


def test_a_contradiction_is_told_of(localizer) -> None:
    result = answer(localizer, "I'm on the north side of East Street 2 and on the south side of East Street 2.")
    assert result.estimate is not None
    assert any("its north side and its south side" in warning for warning in result.warnings)
    assert result.status == "ambiguous"


def test_evidence_names_what_explains_and_warns_of_what_is_not_there(localizer) -> None:
    result = answer(localizer, "I'm on East Street 2, next to Zorba's Taverna, at North Path 3")
    by_text = {hint.text: hint for hint in result.evidence}
    assert any("Zorba" in warning for warning in result.warnings)
    street = next(hint for text, hint in by_text.items() if "East Street 2" in text)
    assert street.explained > 0.5
    unknown = next(hint for text, hint in by_text.items() if "Zorba" in text)
    assert unknown.explained == 0.0
    assert unknown.exact is False
    assert unknown.fit == f"{unknown.text}: not on this map"
    assert result.estimate is not None
    assert np.hypot(*(result.estimate.position - corner_m(localizer, 2, 3))) < 15.0, (
        "a name that is unknown does no harm"
    )


def test_each_place_has_what_speaks_for_and_against_it(localizer) -> None:
    result = answer(localizer, "I'm on East Street 2, next to Zorba's Taverna")
    assert len(result.places) > 1, "a street is long"
    assert result.places[0].position == result.estimate.position
    assert result.places[0].place == result.estimate.place
    for place in result.places:
        assert [text.partition(":")[0] for text in place.supports] == ["East Street 2"]
        assert place.contradicts == tuple(one.fit for one in result.evidence if not one.explained)
        assert place.source_id == next(one.source_id for one in result.evidence if one.text == "East Street 2")
    assert sum(place.probability for place in result.places) <= 1.0 + 1e-9


def test_directions_follow_a_known_heading(localizer) -> None:
    text = "I'm at East Street 2 and North Path 3. East Street 3 is straight ahead, North Path 2 is on my left."
    fits = [one.fit for one in answer(localizer, text).evidence]
    assert any(fit.startswith("East Street 3: ") and fit.endswith("ahead of you") for fit in fits), fits
    assert any(fit.startswith("North Path 2: ") and "your left" in fit for fit in fits), fits


def test_evidence_says_where_what_explains_it_is(localizer) -> None:
    text = "I'm at the corner of East Street 2 and North Path 3, a post box on my left, a cafe across the street"
    result = answer(localizer, text)
    away = [hint for hint in result.evidence if hint.at and hint.bearing_deg is not None and hint.away_m > 1.0]
    assert away
    for hint in away:
        east, north = np.subtract(hint.at, result.estimate.position)
        assert np.hypot(east, north) == pytest.approx(hint.away_m, abs=0.1)
        assert np.degrees(np.arctan2(east, north)) % 360 == pytest.approx(hint.bearing_deg, abs=3)


def test_another_language_is_read_by_its_table(localizer) -> None:
    text = "Ich stehe an der Ecke East Street 2 und North Path 3, links von mir ist ein Briefkasten"
    result = answer(localizer, text)
    assert result.warnings == ()
    assert result.evidence[0].relation == "corner"
    assert result.evidence[-1].relation == "left"
    assert np.hypot(*(result.estimate.position - corner_m(localizer, 2, 3))) < 40.0


def test_a_language_without_a_table_is_answered_by_names_with_a_warning(localizer) -> None:
    result = answer(localizer, "Az East Street 2 és a North Path 3 sarkán állok, balra tőlem egy postaláda van")
    assert any("Hungarian" in warning for warning in result.warnings)
    assert result.estimate is not None


def test_winds_are_seen_from_the_listener(localizer) -> None:
    start = tuple(corner_m(localizer, 2, 2).tolist())
    text = "Meet me on North Path 2, {} of you."
    positions = {}
    for wind in ("north", "south"):
        estimate = answer(localizer, text.format(wind), prior=Prior(start, 100.0), listener=start).estimate
        assert estimate is not None
        positions[wind] = estimate.position[1]
    assert positions["north"] > start[1] > positions["south"]


def test_a_start_off_the_map_is_a_prior_too(localizer) -> None:
    result = answer(
        localizer, "Meet me at the corner of East Street 2 and North Path 3.", prior=Prior((5000.0, 0.0), 800.0)
    )
    assert result.estimate is not None
    assert np.isfinite(result.estimate.position).all()


@pytest.mark.parametrize(
    "text",
    ["East Street 2 " * 280, "5 km 5 km 5 km", "no, none, nothing", "meet me at the", "1/2 3/4", "at at at on on on"],
)
def test_odd_texts_are_answered_without_numbers_that_are_none(localizer, text) -> None:
    result = answer(localizer, text)
    assert result.estimate is None or np.isfinite([*result.estimate.position, result.estimate.radius_m.p90]).all()


def test_what_is_near_stays_a_hint_and_what_the_heading_tells_is_a_mention(localizer) -> None:
    posterior = localizer.posterior
    for text, owned in (("I am north of a bench.", 1), ("There is a bench on my left.", 0)):
        [hints] = posterior.chunk_reader.parse([text])
        trust = posterior.binding.bind(hints).label.amax(dim=1).tolist()
        mentions = posterior.places.read(text, ("en",), to_listener=False)
        near, places = near_hints(hints, trust, mentions)
        assert (len(near), len(places)) == (owned, 1 - owned)


@pytest.mark.parametrize(("hint", "mention"), [("bench", "Kiosk"), ("Kiosk", "bench")])
def test_a_measure_that_both_claim_is_of_the_nearer(localizer, hint, mention) -> None:
    text = "A bench is 20 m to my west, and there is a Kiosk."
    [measure] = find_measures(text)
    [read] = localizer.posterior.chunk_reader.parse(["The pose is south of a bench."])[0]
    hint_start, other = text.index(hint), text.index(mention)
    noticed = replace(read, start=hint_start, end=hint_start + len(hint), measure=measure)
    named = Mention(mention, other, other + len(mention), "thing", cue=Cue(measure=measure))
    [owned], [place] = with_one_owner(text, [noticed], [named])
    assert (owned.measure, place.cue.measure) == ((measure, None) if hint == "bench" else (None, measure))
    apart = replace(named, cue=Cue(measure=replace(measure, start=0, end=1)))
    assert with_one_owner(text, [noticed], [apart]) == ([noticed], [apart])


def test_a_measure_is_of_one_hint_or_mention_of_an_answer(localizer) -> None:
    result = answer(localizer, "I'm on East Street 2, twenty-five meters from a bench, and a tree is west of me.")
    assert [hint.text for hint in result.evidence if hint.distance_m is not None] == ["bench"]
    assert {hint.distance_m for hint in result.evidence} == {25.0, None}


def test_a_class_that_the_gazetteer_lacks_stays_a_hint(localizer) -> None:
    posterior = localizer.posterior
    [hints] = posterior.chunk_reader.parse(["The pose is south of a bench."])
    lacks = Mention("bench", 23, 28, "unknown", kinds=("amenity/bench",), cue=Cue("wind", wind=0.0))
    assert near_hints(hints, [1.0], [lacks]) == ([0], [])
    assert near_hints(hints, [1.0], [replace(lacks, kinds=())])[0] == [], "a name is no class"


def test_nouns_are_read_where_they_stand_in_the_text(localizer, monkeypatch) -> None:
    given, read = [], localizer.posterior.places.read

    def watched(text, language, nouns, **rest):
        given.extend(text[start:end] for start, end in nouns)
        return read(text, language, nouns, **rest)

    monkeypatch.setattr(localizer.posterior.places, "read", watched)
    answer(localizer, "I'm on East Street 2.\n- A gray bench is to my west\n- I see a tree")
    assert {"bench", "tree"} <= set(given)


def test_certainty_is_calibrated_by_how_the_text_was_understood(localizer) -> None:
    known, doubtful = (
        answer(localizer, text).estimate
        for text in ("I'm at East Street 2 and North Path 3", "I'm at East Street 2 and North Path 3, by Hotel Astoria")
    )
    assert known.within_m[30] > doubtful.within_m[30]
    assert known.radius_m.p90 < doubtful.radius_m.p90
    assert list(known.within_m.values()) == sorted(known.within_m.values())


def test_what_is_said_of_a_place_to_meet_at_is_not_what_is_near(localizer) -> None:
    """Classes of the map are hints about the speaker's surroundings, but not where somebody else is told to come."""
    hints_text = "a bench is south of it, and a building west of it."
    meeting = answer(localizer, "Meet me on East Street 2: " + hints_text)
    own = answer(localizer, "I'm on East Street 2: " + hints_text)
    assert {one.exact for one in own.evidence} > {None}, "hints about what is near have no exact name"
    assert None not in {one.exact for one in meeting.evidence}


def test_a_flat_prior_changes_nothing(localizer) -> None:
    text = "I'm on East Street 2, near North Path 3, a bench on my right"
    plain = answer(localizer, text)
    biased = answer(localizer, text, prior=Prior((0.0, 0.0), 1e7))
    assert biased.estimate.position == pytest.approx(plain.estimate.position, abs=1.0)
    assert biased.estimate.radius_m.p90 == pytest.approx(plain.estimate.radius_m.p90, rel=0.05)
    assert [item.relation for item in biased.evidence] == [item.relation for item in plain.evidence]


def test_evidence_is_calibrated_by_how_sure_the_answer_is(localizer) -> None:
    text = "I'm at East Street 2 and North Path 3"
    [raw] = localizer.posterior.find([Query(text)])
    shown = answer(localizer, text).evidence
    before, after = ([item.explained for item in items] for items in (raw.views[0].evidence, shown))
    assert all(0.5 < one < other < 1.0 for one, other in zip(after, before, strict=True))


def test_an_object_with_another_name_explains_no_more_than_half(localizer) -> None:
    result = answer(localizer, "I'm on East Street 2 by the Astoria bench")
    [bench] = [item for item in result.evidence if "bench" in item.text]
    assert bench.text == "Astoria bench"
    assert 0.0 < bench.explained <= 0.5
    assert any("Astoria bench" in warning for warning in result.warnings)
