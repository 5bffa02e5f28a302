from dataclasses import replace

import numpy as np
import pytest

from index.answering import posterior_localizer
from index.answering.posterior_localizer import WELL_LOCATED_M
from index.answering.query import MAX_REPLIES, Box, Circle, Prior, Query, Reply
from index.asking.known_facts import KnownFacts
from index.asking.question_spec import QuestionSpec
from index.asking.questions import Questions
from models.citymap.gazetteer.gazetteer import ADDRESS_KIND, EMPTY_GAZETTEER
from models.citymap.gazetteer.name_columns import GazetteerObject, ObjectTableBuilder
from models.errors import ReplyError
from models.posterior.questions import expected_entropy
from tests.conftest import LAT, LAT_M, LON, LON_M

VAGUE = Query("I am north of a tree.")
SAYS_NOTHING = Query("There is a building near me, and a road.")
FITS_NOTHING = Query("There is a volcano near me.")


def mass_of_cells(located):
    """[N] probability of each cell that is listed."""
    return dict(zip(located.rows.tolist(), located.probability.tolist(), strict=True))


def entropy_of(located, cells):
    """Bits over cells; those that are not listed share what is left."""
    left = np.full(cells - len(located.rows), located.other / max(1, cells - len(located.rows)))
    mass = np.concatenate([located.probability, left])
    return -(mass * np.log2(mass.clip(1e-300))).sum()


@pytest.fixture(scope="module")
def posterior(localizer):
    return localizer.posterior


@pytest.fixture(scope="module")
def questions_asked(posterior):
    [finding] = posterior.find([VAGUE])
    return finding.question


@pytest.mark.parametrize(
    "one",
    [
        QuestionSpec("near", ("bench",)),
        QuestionSpec("way", ("street lamp",)),
        QuestionSpec("colour", ("building", "red", "white")),
    ],
)
def test_the_chances_of_all_answers_add_up_to_one_everywhere(posterior, one):
    nodes = np.arange(posterior.surroundings.cell_starts[-1])
    evidence = [posterior.questions.reply_evidence([Reply(one.id, value)]) for value in one.values]
    assert sum(np.exp(each.log_p(nodes)) for each in evidence) == pytest.approx(np.ones(len(nodes)))
    assert sum(np.exp(each.cell_log_p) for each in evidence) == pytest.approx(np.ones(len(posterior.gallery.cells)))


def test_an_answer_is_true_where_the_map_says_so(posterior):
    nodes_m = posterior.surroundings.positions_m(np.arange(posterior.surroundings.cell_starts[-1]))
    on_first = posterior.frame.from_wgs84(LAT + 60 * LAT_M, LON + 150 * LON_M)  # half way along it
    nodes = np.flatnonzero(np.hypot(*(nodes_m - on_first).T) < 5.0)
    one, other = (posterior.questions.reply_evidence([Reply("street", f"East Street {n}")]) for n in (1, 2))
    assert len(nodes) > 10
    assert (one.log_p(nodes) > other.log_p(nodes) + 1).all()


def test_the_chances_of_all_names_add_up_to_one_where_there_is_a_street(posterior):
    evidence = [posterior.questions.reply_evidence([Reply("street", f"East Street {n}")]).cell_log_p for n in range(6)]
    evidence += [posterior.questions.reply_evidence([Reply("street", f"North Path {n}")]).cell_log_p for n in range(6)]
    assert len(posterior.questions.reply_evidence([Reply("street", "East Street 1")]).cell_log_p) == len(
        posterior.gallery.cells
    )
    chance = np.exp(evidence).sum(axis=0)
    assert chance.max() == pytest.approx(1.0, abs=1e-3)  # to half precision
    assert np.median(chance) > 0.9


def test_a_name_is_compared_without_case_and_accents(posterior):
    nodes = np.arange(500)
    plain, spelt = (
        posterior.questions.reply_evidence([Reply("street", s)]) for s in ("East Street 3", "EÁST  street, 3")
    )
    assert (plain.log_p(nodes) == spelt.log_p(nodes)).all()


def test_an_open_reply_narrows_and_a_wrong_one_is_survived(posterior):
    [plain], [evidence] = (
        posterior.find([q]) for q in (VAGUE, replace(VAGUE, replies=(Reply("street", "East Street 3"),)))
    )
    cells = len(posterior.gallery.cells)
    assert entropy_of(evidence.located, cells) < entropy_of(plain.located, cells) - 1.0
    on_third = posterior.frame.from_wgs84(LAT + 180 * LAT_M, LON)[1]
    assert abs(evidence.located.positions[0][1] - on_third) < 30
    before, after = mass_of_cells(plain.located), mass_of_cells(evidence.located)
    shared = [row for row in before if row in after and before[row] > 1e-4]
    assert min(after[row] / before[row] for row in shared) > 0.001  # nothing is ruled out
    assert evidence.question is None or evidence.question.id != "street"


def test_several_answers_multiply(posterior):
    replies = [Reply("near:bench", "yes"), Reply("way:tree", "north"), Reply("near:bollard", "unknown")]
    nodes = np.arange(500)
    apart = [posterior.questions.reply_evidence([reply]) for reply in replies]
    together = posterior.questions.reply_evidence(replies)
    assert together.log_p(nodes) == pytest.approx(apart[0].log_p(nodes) + apart[1].log_p(nodes))
    assert apart[2] is None


def test_the_question_leaves_the_least_entropy_of_all_that_could_be_asked(posterior):
    """Against the posterior itself: every answer is given, and cells' masses are compared before and after."""
    [finding] = posterior.find([VAGUE])
    located, questions = finding.located, questions_about(posterior, EMPTY_GAZETTEER)  # so all answers are listed
    cell_of = np.repeat(np.arange(len(posterior.gallery.cells)), np.diff(posterior.surroundings.cell_starts))

    def mass(weight):
        return np.array([weight[cell_of[located.points] == row].sum() for row in located.rows])

    def left(one):
        evidence = [questions.reply_evidence([Reply(one.id, value)]).log_p(located.points) for value in one.values]
        before = mass(located.weight)
        chance = np.stack([mass(located.weight * np.exp(log_p)) for log_p in evidence], axis=1)
        return expected_entropy(before / before.sum(), (chance / before[:, None].clip(1e-300))[None])[0]

    others = [QuestionSpec("near", ("bench",)), QuestionSpec("near", ("bollard",)), QuestionSpec("near", ("post box",))]
    best = QuestionSpec.parse(questions.ask(located, KnownFacts(labels=frozenset(["tree"])), []).id)
    assert best.values
    assert left(best) < min(left(one) for one in others)


def test_a_house_number_is_asked_for_where_a_word_would_tell_too_little(posterior):
    """A reply of a word is preferred as long as it leaves no bit more."""
    numbered = with_house_numbers(posterior)
    everywhere = np.zeros(len(posterior.gallery.cells))
    questions_asked = numbered.ask_anywhere(everywhere, KnownFacts(), [])
    assert questions_asked.id == "address"
    assert [choice.value for choice in questions_asked.choices][-1] == "unknown"
    evidence = numbered.reply_evidence([Reply("address", "17, east street 3")])
    assert evidence.cell_log_p.argmax() == 16
    two = np.where(np.isin(np.arange(len(everywhere)), evidence.cell_log_p.argsort()[[0, -1]]), 0.0, -np.inf)
    assert numbered.ask_anywhere(two, KnownFacts(), []).id != "address"
    given_replies = [Reply("address", "17 East Street 3")]
    assert numbered.ask_anywhere(everywhere, KnownFacts(), given_replies).id not in {"address", "street"}


def with_house_numbers(posterior):
    """The questions about the map if a house stood in the middle of each of its cells, numbered from 1."""
    gazetteer = posterior.places.gazetteer
    centers_m = posterior.gallery.cells.center_m[:, :2]
    houses = [GazetteerObject((ADDRESS_KIND,), (), str(n + 1), "East Street 3") for n in range(len(centers_m))]
    builder = ObjectTableBuilder()
    builder.add([*gazetteer.objects, *houses])
    town = replace(
        gazetteer,
        objects=builder.build(),
        segments_m=np.concatenate([gazetteer.segments_m, np.tile(centers_m, 2).astype(np.float32)]),
        starts=np.concatenate([gazetteer.starts, gazetteer.starts[-1] + 1 + np.arange(len(centers_m))]),
        is_area=np.concatenate([gazetteer.is_area, np.zeros(len(centers_m), bool)]),
    )
    return questions_about(posterior, town)


def questions_about(posterior, gazetteer):
    """Return the questions about the map if it had these names."""
    nodes = posterior.nodes
    return Questions(nodes.nearby_objects, list(posterior.labels), nodes._palette, gazetteer, posterior.gallery.cells)


def test_what_the_text_says_is_not_asked(posterior, questions_asked):
    assert not questions_asked.id.startswith(("near:tree", "way:tree"))
    for text in ("I am on East Street 2.", "I am on East Street 2. There is a bench."):
        [finding] = posterior.find([Query(text)])
        assert finding.question is None or finding.question.id != "street"
    facts = KnownFacts(labels=frozenset(["bench"]), has_winds=False)
    [finding] = posterior.find([VAGUE])
    ids, before = [], []
    while question := posterior.questions.ask(finding.located, facts, before):
        ids.append(question.id)
        before.append(Reply(question.id, "unknown"))
    assert len(ids) == len(set(ids)) > 3
    assert "near:bench" not in ids
    assert not any(one.startswith("way:") for one in ids)
    assert ids.count("street") == 1
    assert "corner" not in ids  # of a street that is not known
    assert "name" not in ids  # nothing has one here


def test_who_has_given_all_replies_that_are_taken_is_asked_nothing_more(posterior):
    [finding] = posterior.find([VAGUE])
    before = [Reply("near:tree", "unknown")] * MAX_REPLIES
    assert posterior.questions.ask(finding.located, KnownFacts(), before[1:]) is not None
    assert posterior.questions.ask(finding.located, KnownFacts(), before) is None


def test_the_cross_street_is_asked_for_when_the_street_is_known():
    def open_of(facts, *replies):
        return [one.kind for one in facts.open_questions(replies)]

    assert open_of(KnownFacts()) == ["street", "name", "address"]
    assert open_of(KnownFacts(), Reply("street", "unknown")) == ["name", "address"]
    assert open_of(KnownFacts(), Reply("street", "A"), Reply("name", "unknown")) == ["corner", "address"]
    assert open_of(KnownFacts(is_on_street=True, is_at_name=True)) == ["corner", "address"]
    assert open_of(KnownFacts(is_on_street=True, is_at_corner=True, is_at_house=True)) == ["name"]
    assert open_of(KnownFacts(), Reply("address", "1 A")) == ["name", "corner"]  # of the street that was said with it
    assert open_of(KnownFacts(), Reply("address", "unknown")) == ["street", "name"]


def test_an_answer_narrows_and_a_wrong_one_is_survived(posterior, questions_asked):
    entropy = []
    for choice in questions_asked.choices:
        [finding] = posterior.find([replace(VAGUE, replies=(Reply(questions_asked.id, choice.value),))])
        entropy.append(entropy_of(finding.located, len(posterior.gallery.cells)))
    assert np.mean(entropy[:-1]) < entropy[-1] - 0.1  # the last is unknown
    [plain] = posterior.find([VAGUE])
    [wrong] = posterior.find([replace(VAGUE, replies=(Reply(questions_asked.id, questions_asked.choices[0].value),))])
    before, after = mass_of_cells(plain.located), mass_of_cells(wrong.located)
    shared = [row for row in before if row in after and before[row] > 1e-4]
    assert min(after[row] / before[row] for row in shared) > 0.01  # nothing is ruled out


def test_unknown_changes_nothing_but_the_question(posterior, questions_asked):
    [plain], [unsure] = (
        posterior.find([q]) for q in (VAGUE, replace(VAGUE, replies=(Reply(questions_asked.id, "unknown"),)))
    )
    assert (plain.located.weight == unsure.located.weight).all()
    assert unsure.question != plain.question


@pytest.mark.parametrize(
    ("reply", "field"),
    [
        (Reply("nonsense", "yes"), "question"),
        (Reply("near:dragon", "yes"), "question"),
        (Reply("name:Stockmann", "yes"), "question"),
        (Reply("name", "Stockmann"), "question"),  # nothing has a name here but streets
        (Reply("street:East Street 1", "East Street 1"), "question"),
        (Reply("street", "Elm Street"), "choice"),
        (Reply("street", "?!"), "choice"),
        (Reply("corner", "Elm Street"), "choice"),
        (Reply("colour:building|mauve", "other"), "question"),
        (Reply("near:bench", "maybe"), "choice"),
    ],
)
def test_what_cannot_have_been_asked_is_refused(posterior, reply, field):
    with pytest.raises(ReplyError, match=rf"^answers\[1\]\.{field}: ") as raised:
        posterior.questions.reply_evidence([Reply("near:bench", "yes"), reply])
    assert (raised.value.number, raised.value.field) == (1, field)


def test_nothing_is_asked_of_a_sure_answer_or_of_a_place_to_meet_at(localizer):
    sure = localizer.localize([VAGUE])[0].estimate.position
    answers = localizer.localize(
        [
            Query("Meet me north of a tree."),
            Query("I am north of a tree.", prior=Prior(sure, 3.0)),
            Query("I am north of a tree.", refine="none"),
        ]
    )
    assert [answer.question for answer in answers] == [None, None, None]
    assert answers[1].status == "ok"


@pytest.mark.parametrize("refused", [SAYS_NOTHING, FITS_NOTHING])
def test_a_refused_text_has_a_question_and_its_reply_is_an_answer(localizer, refused):
    [before] = localizer.localize([refused])
    assert (before.status, before.estimate, before.question.id) == ("no_match", None, "street")
    [after] = localizer.localize([replace(refused, replies=(Reply("street", "East Street 3"),))])
    assert after.status != "no_match"
    on_third = localizer.frame.from_wgs84(LAT + 180 * LAT_M, LON)[1]
    assert abs(after.estimate.position[1] - on_third) < 30
    assert any("replies alone" in warning for warning in after.warnings)


def test_replies_alone_look_along_a_whole_street(posterior, monkeypatch):
    """However few cells a text would be looked at in."""
    monkeypatch.setattr(posterior_localizer, "CANDIDATE_CELLS", 2)
    y_m = posterior.gallery.cells.center_m[:, 1]
    on_third = posterior.frame.from_wgs84(LAT + 180 * LAT_M, LON)[1]
    [finding] = posterior.find([replace(SAYS_NOTHING, replies=(Reply("street", "East Street 3"),))])
    there = np.flatnonzero(np.abs(y_m - on_third) < 5)
    assert len(there) > 5
    assert set(there.tolist()) <= set(finding.located.rows.tolist())
    [finding] = posterior.find([VAGUE])
    assert len(finding.located.rows) < len(y_m)


def test_a_text_that_says_something_is_no_answer_of_replies_alone(localizer):
    [answer] = localizer.localize([replace(VAGUE, replies=(Reply("street", "East Street 3"),))])
    assert not answer.warnings


def test_who_knows_nothing_is_asked_other_things_and_then_nothing(localizer):
    query, ids = SAYS_NOTHING, []
    while (answer := localizer.localize([query])[0]).question is not None:
        assert answer.status == "no_match"
        ids.append(answer.question.id)
        query = replace(query, replies=(*query.replies, Reply(answer.question.id, "unknown")))
    assert answer.status == "no_match"
    assert ids[0] == "street"
    assert len(ids) == len(set(ids)) == MAX_REPLIES


def test_what_is_offered_to_a_refused_text_is_where_it_may_have_been_said(localizer):
    x, y = localizer.frame.from_wgs84(LAT + 240 * LAT_M, LON + 90 * LON_M)[:2]
    near = {"East Street 3", "East Street 4", "East Street 5", "North Path 1", "North Path 2", "unknown"}
    for where in ({"within": Box(x - 50, y - 50, x + 50, y + 50)}, {"prior": Prior((x, y), 25.0)}):
        [answer] = localizer.localize([replace(SAYS_NOTHING, **where)])
        assert answer.question.id == "street"
        assert {choice.value for choice in answer.question.choices} <= near


def test_not_every_refused_text_has_a_question(localizer):
    """None that lies outside the map, or is of a place to meet at."""
    queries = [
        replace(SAYS_NOTHING, within=Circle((1e6, 1e6), 50.0)),
        Query("Meet me near a building."),
    ]
    answers = localizer.localize(queries)
    assert [(answer.status, answer.question) for answer in answers] == [("no_match", None)] * 2


def test_a_refused_text_in_another_language_has_a_question_in_it(localizer):
    [answer] = localizer.localize([Query("Seison talon ja tien vieressä, enkä tiedä missä olen.")])
    assert (answer.status, answer.question.text) == ("no_match", "Millä kadulla olet?")


def test_who_has_begun_to_reply_is_asked_until_the_place_is_good(localizer):
    query, p50 = SAYS_NOTHING, np.inf
    replies = {"street": "East Street 3", "corner": "North Path 2"}
    while (question := localizer.localize([query])[0].question) is not None and len(query.replies) < MAX_REPLIES:
        reply = Reply(question.id, replies.get(question.id, "unknown"))
        query = replace(query, replies=(*query.replies, reply))
        p50 = localizer.localize([query])[0].estimate.radius_m.p50
    assert {reply.question for reply in query.replies} >= {"street", "corner"}
    assert p50 <= WELL_LOCATED_M or len(query.replies) == MAX_REPLIES


def test_the_middle_of_a_cell_is_the_node_nearest_to_its_centre(posterior) -> None:
    once = questions_about(posterior, EMPTY_GAZETTEER)._middle_nodes
    surroundings, centers = posterior.surroundings, posterior.gallery.cells.center_m[:, :2]
    owner = surroundings.owner(once)
    apart = np.hypot(*(surroundings.positions_m(once) - centers[owner]).T)
    assert len(np.unique(owner)) == len(once) == np.count_nonzero(np.diff(surroundings.cell_starts))
    assert apart.max() < 1.5, "half a diagonal of the nodes' grid"
