import dataclasses
import gzip
import json
from hashlib import sha256

import numpy as np
import pytest
from safetensors.numpy import load

from index.answering.localizer import Localizer
from index.answering.query import Box, Circle, Prior, Query
from models.paper.checkpoint import load_retriever
from tests.encoding import encode_descriptions

TEXT = "I am north of a red building. A bench is to my west. I stand on the road."
CORNER = Box(-154, -154, 4, 4)


def ask(localizer, **changes):
    return localizer.localize([dataclasses.replace(Query(TEXT, refine="none"), **changes)])[0]


def naive_posterior(localizer, vector, rows, prior=None):
    """The definition, over every row."""
    store = localizer.ranker.store
    scores = store.score(vector, np.arange(len(store))).astype(float)
    logits = scores / localizer.retriever.temperature(3)
    if prior:
        distance = np.linalg.norm(localizer.gallery.cells.center_m[:, :2] - np.array(prior.position), axis=1)
        logits -= distance**2 / (2 * prior.sigma_m**2)
    keep = np.zeros(len(scores), dtype=bool)
    keep[rows] = True
    logits[~keep] = -np.inf
    weights = np.exp(logits - logits.max())
    return weights / weights.sum()


@pytest.mark.parametrize("prior", [None, Prior((40.0, -30.0), 25.0)])
@pytest.mark.parametrize("within", [None, CORNER, Circle((10.0, 10.0), 60.0)])
def test_candidates_are_the_posteriors_best(localizer, within, prior) -> None:
    answer = ask(localizer, within=within, prior=prior, top_k=7)
    centers = localizer.gallery.cells.center_m[:, :2]
    allowed = np.arange(len(centers))
    if isinstance(within, Box):
        allowed = allowed[((centers >= -154) & (centers <= 4)).all(axis=1)]
    elif within:
        allowed = allowed[np.linalg.norm(centers - 10, axis=1) <= 60]
    [sentences] = localizer.sentences([TEXT])
    assert sentences[1] == "The pose is east of a bench."
    vector = encode_descriptions(localizer.retriever, [sentences])[0]
    posterior = naive_posterior(localizer, vector, allowed, prior)
    best = np.argsort(-posterior, kind="stable")[:7]
    assert [c.cell_id for c in answer.candidates] == [localizer.gallery.cells.ids[n] for n in best]
    assert [c.probability for c in answer.candidates] == pytest.approx(posterior[best], rel=1e-4)
    assert answer.other_probability == pytest.approx(1 - posterior[best].sum(), abs=1e-5)
    assert [c.rank for c in answer.candidates] == list(range(1, 8))


def test_the_estimate_is_the_best_cells_centre_and_says_so(localizer) -> None:
    answer = ask(localizer)
    best = answer.candidates[0]
    assert answer.estimate.method == "cell_center"
    assert answer.estimate.position == best.center == best.position
    assert answer.estimate.probability == best.probability
    west, south, east, north = best.bbox
    assert ((west + east) / 2, (south + north) / 2) == pytest.approx(best.center)
    back = localizer.frame.from_wgs84(answer.estimate.wgs84.lat, answer.estimate.wgs84.lon)
    assert back == pytest.approx(best.center, abs=0.02)


def test_uncertainty_is_wide_when_unsure_and_narrow_when_told(localizer) -> None:
    unsure, inside = ask(localizer), ask(localizer, within=Circle((0.0, 0.0), 1.0))
    assert len(inside.candidates) == 1
    assert inside.candidates[0].probability == pytest.approx(1)
    assert inside.status == "ok"
    assert unsure.status == "ambiguous", "an untrained model knows nothing"
    assert unsure.estimate.radius_m.p90 > 60
    assert 0 < inside.estimate.radius_m.p90 < 15
    for answer in (unsure, inside):
        covariance = np.array(answer.estimate.covariance)
        assert np.isfinite(covariance).all()
        assert (np.linalg.eigvalsh(covariance) > 0).all()
        assert answer.estimate.radius_m.p50 <= answer.estimate.radius_m.p90


def test_cells_beyond_the_search_depth_count_as_doubt(localizer, monkeypatch) -> None:
    whole = ask(localizer)
    monkeypatch.setattr(localizer.vector_localizer("none"), "depth", 20)
    shallow = ask(localizer)
    assert [c.cell_id for c in shallow.candidates] == [c.cell_id for c in whole.candidates]
    assert shallow.estimate.probability <= whole.estimate.probability
    assert shallow.other_probability >= whole.other_probability
    assert np.isfinite(shallow.estimate.radius_m.p90)


def test_a_filter_off_the_map_matches_nothing(localizer) -> None:
    answer = ask(localizer, within=Box(9000, 9000, 9100, 9100))
    assert (answer.status, answer.estimate, answer.candidates, answer.other_probability) == ("no_match", None, (), 1.0)
    assert "within" in answer.warnings[0]


def test_wgs84_means_the_same_place(localizer) -> None:
    lat, lon = localizer.frame.to_wgs84(np.array([[-154.0, -154.0], [4.0, 4.0]]))
    degrees = ask(localizer, within=Box(lon[0], lat[0], lon[1], lat[1]), crs="wgs84")
    assert degrees.candidates == ask(localizer, within=CORNER).candidates
    circle = ask(localizer, within=Circle((lon[1], lat[1]), 50), prior=Prior((lon[1], lat[1]), 20), crs="wgs84")
    metres = ask(localizer, within=Circle((4, 4), 50), prior=Prior((4, 4), 20))
    assert [c.cell_id for c in circle.candidates] == [c.cell_id for c in metres.candidates]


def test_ten_times_the_same_answer(localizer) -> None:
    texts = [Query(f"I am west of tree {i}. {TEXT}", refine="none") for i in range(5)]
    backwards = "I stand on the road. A bench is to my west. I am north of a red building."
    first = ask(localizer)
    for _ in range(9):
        again = localizer.localize([*texts, Query(backwards, refine="none"), *texts])[5]
        assert again.candidates == first.candidates
        assert again.estimate == first.estimate


@pytest.mark.parametrize(
    "text",
    [
        "Olen puun pohjoispuolella.",
        "木の北にいます",
        "🙂 tree 🙂",
        "asdf qwer",
        "a" * 4000,
        "The stock market fell today.",
        "x. " * 32,
    ],
)
def test_odd_texts_get_an_honest_answer(localizer, text) -> None:
    (answer,) = localizer.localize([Query(text, refine="none")])
    assert answer.status in ("ok", "ambiguous")
    assert 0 <= answer.estimate.probability <= 1
    assert np.isfinite(answer.estimate.covariance).all()


def test_templates_and_what_cannot_be_read_are_encoded_as_they_are(localizer) -> None:
    template = "The pose is on-top of a road. The pose is north of a tree."
    unread = "Hm. The weather is fine."
    split = localizer.sentences([template, unread, "a tree stands south of where I am"])
    assert split[0] == ("The pose is on-top of a road.", "The pose is north of a tree.")
    assert split[1] == ("Hm.", "The weather is fine.")
    assert split[2] == ("The pose is north of a tree.",)


def test_template_hints_are_never_read_again(index_dir, weights_dir, monkeypatch) -> None:
    hints = ("The pose is on-top of a road.", "The pose is north of a tree.")
    expected = encode_descriptions(load_retriever(weights_dir), [hints])  # that never saw the index
    fresh = Localizer.open(index_dir, weights_dir)
    monkeypatch.setattr(fresh.retriever, "embed_hints", None)  # what would run the text encoder
    assert encode_descriptions(fresh.retriever, [hints]) == pytest.approx(expected, abs=1e-5)
    assert fresh.localize([Query(" ".join(hints), refine="none")])[0].estimate


@pytest.mark.parametrize("refine", ["none", "posterior"])
def test_several_texts_together_are_where_each_alone_is(localizer, refine) -> None:
    texts = [
        TEXT,
        "a lamp south of me and a tree to the east, the street right here",
        "There is a yellow post box north of me.",
        "no bench anywhere. Brown house to the west, footpath below my feet and two lamps on the south side.",
    ]
    together = localizer.localize([Query(text, refine=refine) for text in texts])
    for text, one in zip(texts, together, strict=True):
        localizer.posterior.chunk_reader._cache.clear()
        (alone,) = localizer.localize([Query(text, refine=refine)])
        assert alone.estimate.position == pytest.approx(one.estimate.position, abs=1e-3)
        assert [c.cell_id for c in alone.candidates] == [c.cell_id for c in one.candidates]


def test_an_answer_names_the_model_that_made_it(localizer) -> None:
    by_vectors, by_posterior = localizer.localize([Query(TEXT, refine="none"), Query(TEXT)])
    assert by_vectors.model == localizer.facts.model
    assert by_posterior.model.name.startswith("posterior/")
    assert by_posterior.model.sha256 == localizer.posterior.weights.fingerprint != by_vectors.model.sha256


NUMBERS = (
    "99999999999999999999999999", "9" * 400, "1e309", "1e-400", "0", "-0", "-5", "1,000", "1.2.3", "5-10",
    "0.0000000001", "٣", "१२", "½", "5½", "NaN", "inf", "Infinity", "0x10", "five hundred million",
    "a thousand thousand", "one hundred and twenty-three", "twenty twenty", "IV", "²", "1" + "0" * 4000,
)  # fmt: skip
UNITS = ("meters", "km", "steps", "m", "miles", "feet", "blocks", "minutes", "light years")


def test_no_number_in_a_text_breaks_an_answer(localizer) -> None:
    texts = [
        " ".join(f"A building is {number} {unit} north of me." for unit in UNITS) + f" There is a tree {number} m east."
        for number in NUMBERS
    ]
    doors = [f"I am at number {number}, {number} doors down from {number} Main Street." for number in NUMBERS]
    answers = localizer.localize([Query(text) for text in texts + doors])
    for text, answer in zip(texts + doors, answers, strict=True):
        json.dumps(dataclasses.asdict(answer), allow_nan=False)
        assert answer.evidence or answer.status == "no_match", text
    for text, answer in zip(texts, answers[: len(texts)], strict=True):
        assert len(answer.evidence) >= len(UNITS) - 1, f"not all of it was heard: {text}"


def test_cells_a_page_at_a_time(localizer, cells) -> None:
    listed = [cell for first in range(0, len(cells) + 7, 7) for cell in localizer.cells(first, 7)]
    assert [cell.cell_id for cell in listed] == list(cells.ids)
    detail = localizer.cell(listed[3].cell_id)
    assert (listed[3].center, listed[3].bbox, listed[3].wgs84) == (detail.center, detail.bbox, detail.wgs84)
    assert listed[3].instances == len(detail.instances)


def test_a_cell_in_detail(localizer, cells, city) -> None:
    detail = localizer.cell("tinytown_00003")
    begin, end = cells.parts.starts[3:5]
    assert [i.label for i in detail.instances] == [city.instances[i].label for i in cells.parts.instance[begin:end]]
    assert detail.center == pytest.approx(cells.center_m[3])
    assert {i.colour for i in detail.instances if i.label == "tree"} <= {None}
    assert all(i.source_id for i in detail.instances)
    assert localizer.cell("tinytown_99999") is None


def test_an_index_knows_what_its_map_looks_like(localizer) -> None:
    part = localizer.scenery(0)
    assert sha256(part.path.read_bytes()).hexdigest() == part.sha256
    assert len(load(gzip.decompress(part.path.read_bytes()))["steps"]) > 0
    assert localizer.scenery(1) is None
    assert localizer.facts.scenery_parts == 1
