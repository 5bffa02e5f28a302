import re
from dataclasses import replace

import numpy as np
import pytest
import torch

from index.answering.localizer import Localizer
from index.answering.query import Box, Circle, Prior, Query
from index.answering.ranking import Ranker
from index.answering.result import to_answer
from index.evaluation.evaluation import evaluate
from index.evaluation.localizers import posterior_of_map
from index.stores.faiss_store import FaissStore
from models.language.parsed_hint import RELATIONS, ParsedHint
from models.language.reader import COLOURS
from models.paper.checkpoint import load_retriever
from models.posterior.model import PosteriorConfig, PosteriorModel, load_posterior, save_posterior
from models.posterior.neighbours.neighbour_index import build_neighbour_index

SENTENCE = re.compile(r"The pose is (\S+) of a ([^.]+)\.")


def read_exactly(texts):
    """The benchmark's sentences, understood."""
    return [[_noticed(*m.groups(), m.start(2)) for m in SENTENCE.finditer(text)] for text in texts]


def _noticed(relation, thing, start):
    colour = next((c for c in COLOURS if thing.startswith(c + " ")), None)
    noun = thing.removeprefix(f"{colour} ")
    start += len(thing) - len(noun)
    colours = torch.eye(len(COLOURS) + 1)[COLOURS.index(colour) if colour else -1]
    return ParsedHint(
        noun, start, start + len(noun), torch.eye(len(RELATIONS))[RELATIONS.index(relation)], colours, 0.0, None
    )


@pytest.fixture(scope="module")
def posterior_model(text_encoder):
    torch.manual_seed(0)
    model = PosteriorModel(text_encoder, PosteriorConfig(width=32)).eval()
    model.matcher = load_posterior().matcher  # knows the names already
    model.reader.read = read_exactly
    return model


@pytest.fixture(scope="module")
def posterior(posterior_model, model, source):
    data = source.data
    ranker = Ranker.from_cells(model, data.cells, data.gallery.labels)
    return posterior_of_map(posterior_model, data, ranker, build_neighbour_index(source.geometry(), data.cells))


@pytest.fixture(scope="module")
def answer(posterior):
    def answer(query):
        [finding] = posterior.find([query])
        return to_answer(query, finding, posterior, posterior.gallery.cells, posterior.frame)

    return answer


@pytest.fixture(scope="module")
def surest(posterior, data_and_queries):
    """Return the query whose first candidate is the most probable, because the town repeats itself."""
    results = posterior.find([Query(" ".join(hints)) for hints in data_and_queries[1].sentences[:30]])
    return int(np.argmax([finding.located.probability[0] for finding in results]))


@pytest.fixture(scope="module")
def query(data_and_queries, surest):
    return Query(" ".join(data_and_queries[1].sentences[surest]))


def test_an_answer_is_whole_and_says_why(answer, query, data_and_queries, surest, scan):
    answer = answer(replace(query, heat_map=True, top_k=3))
    truth = data_and_queries[1].positions_m[surest]
    assert answer.status == "ok"
    assert answer.estimate.method == "posterior"
    assert np.hypot(*(np.array(answer.estimate.position) - truth)) < 15
    assert len(answer.candidates) == 3
    total = sum(c.probability for c in answer.candidates) + answer.other_probability
    assert total == pytest.approx(1.0)
    assert answer.estimate.wgs84 is not None
    assert 0 < answer.estimate.radius_m.p50 <= answer.estimate.radius_m.p90
    assert len(answer.evidence) == len(data_and_queries[1].sentences[surest])
    assert np.mean([hint.explained > 0.5 for hint in answer.evidence]) > 0.6
    shown = [hint for hint in answer.evidence if hint.instance]
    assert shown
    assert all(hint.away_m <= 15.1 for hint in shown)
    for hint in shown:  # away from the node nearest to the estimate
        assert np.hypot(*np.subtract(hint.at, answer.estimate.position)) == pytest.approx(hint.away_m, abs=1.1)
    things = {instance.source_id: instance.points_m[:, :2] for instance in scan.instances}
    for hint in shown:  # stands on the thing itself
        assert np.hypot(*(things[hint.source_id] - hint.at).T).min() < 0.75
    text = query.description
    assert [text[slice(*hint.span)] for hint in answer.evidence] == [hint.text for hint in answer.evidence]
    points = np.array(answer.heat_map.points)
    assert (np.diff(points[:, 2]) <= 0).all()
    assert points[:, 2].sum() <= 1.0 + 1e-9


def test_a_heat_map_holds_what_is_known_however_vague_the_text(answer, posterior, data_and_queries):
    vague = Query(data_and_queries[1].sentences[0][0], heat_map=True)
    heat, located = answer(vague).heat_map, posterior.find([vague])[0].located
    assert heat.spacing_m > located.spacing_m
    assert len(heat.points) <= 500
    assert sum(p for _, _, p in heat.points) >= 0.95 * located.weight.sum()


def test_a_filter_holds_for_every_position(answer, query, city):
    whole = answer(query)
    x, y = whole.estimate.position
    boxed = answer(replace(query, within=Box(x - 60, y - 60, x - 20, y + 60)))
    for candidate in boxed.candidates:
        assert x - 61 <= candidate.position[0] <= x - 19
    lat, lon = city.frame.to_wgs84(np.array([x, y]))
    round_it = answer(replace(query, within=Circle((float(lon), float(lat)), 40.0), crs="wgs84"))
    assert round_it.candidates[0].cell_id == whole.candidates[0].cell_id
    off = answer(replace(query, within=Box(1e6, 1e6, 2e6, 2e6)))
    assert (off.status, off.estimate, off.other_probability) == ("no_match", None, 1.0)
    assert "within" in off.warnings[0]


def test_radii_hold_the_share_that_validation_said(answer, query, posterior, monkeypatch):
    plain = answer(query).estimate.radius_m
    monkeypatch.setattr(posterior.weights, "config", PosteriorConfig(width=32, radius_held=(0.3, 0.5)))
    assert answer(query).estimate.radius_m.p90 == pytest.approx(plain.p50)


def test_a_prior_pulls(answer, query):
    x, y = answer(query).estimate.position
    pulled = answer(replace(query, prior=Prior((x + 80, y), 8.0)))
    assert abs(pulled.estimate.position[0] - x - 80) < 40


def test_a_text_about_nothing_is_no_match(answer):
    results = answer(Query("It rains and I like it."))
    assert (results.status, results.estimate) == ("no_match", None)
    assert "north of a gray building" in results.warnings[0]
    assert results.question is None  # no name could be asked for on this map


def test_things_that_the_map_has_not_are_no_match(answer):
    results = answer(Query("The pose is north of a pink giraffe. The pose is east of a purple elephant."))
    assert results.status == "no_match" or results.estimate.probability < 0.1


def test_the_evaluation_asks_it_and_measures_its_coverage(posterior, data_and_queries, tmp_path):
    data, queries = data_and_queries
    rows = np.arange(0, len(queries), max(1, len(queries) // 40))
    subset = replace(queries.take(rows), hints=None)
    report = evaluate(data, subset, posterior, tmp_path, grow_m=[60, 120])
    assert report["retrieval"]["1"] > 0.4
    assert report["method"] == "posterior"
    texts = ["\n".join(sentences) for sentences in subset.sentences]
    retrieved = [posterior.find([Query(text)])[0].located.is_retrieved for text in texts]
    assert report["retrieved_share"] == sum(retrieved) / len(texts)
    assert set(report["coverage"]) == {"p50", "p90"}
    assert 0 < report["coverage"]["p50"]["median_m"] <= report["coverage"]["p90"]["median_m"]
    assert [step["cells"] for step in report["growth"]] == sorted(step["cells"] for step in report["growth"])


def test_long_descriptions_are_read_in_pieces(posterior):
    text = " ".join(f"The pose is north of a gray bench number{n}." for n in range(60))
    [hints] = posterior.chunk_reader.parse([text])
    assert len(hints) == 60
    assert {text[hint.start : hint.end] for hint in hints[::10]} == {hint.noun for hint in hints[::10]}
    assert posterior.chunk_reader.parse(["no full stop"]) == [()]


def test_weights_are_saved_and_read_back(text_encoder, tmp_path):
    torch.manual_seed(1)
    model = PosteriorModel(text_encoder, PosteriorConfig(width=32, radius_held=(0.4, 0.8))).eval()
    save_posterior(model, tmp_path, {"note": "made up"})
    again = load_posterior(tmp_path)
    assert again.fingerprint == model.fingerprint
    assert again.config.radius_held == (0.4, 0.8)
    text = "I am north of a gray pole."
    for one, other in zip(model.reader.read([text])[0], again.reader.read([text])[0], strict=True):
        assert torch.equal(one.relation, other.relation)


def test_a_localizer_answers_by_either_way(index_dir, weights_dir, posterior_model, tmp_path, query):
    save_posterior(posterior_model, tmp_path, {})
    localizer = Localizer.open(index_dir, weights_dir, posterior_weights_dir=tmp_path)
    localizer.posterior.weights.reader.read = read_exactly
    by_vectors, by_posterior = localizer.localize([replace(query, refine="none"), query])
    assert by_vectors.estimate.method == "cell_center"
    assert by_posterior.estimate.method == "posterior"
    assert by_posterior.timings_ms.keys() == {"encode", "search", "estimate"}


@pytest.fixture(scope="module")
def trained(source):
    """The shipped models on the town."""
    data, retriever = source.data, load_retriever().global_only()
    ranker = Ranker.from_cells(retriever, data.cells, data.gallery.labels)
    return posterior_of_map(load_posterior(), data, ranker, build_neighbour_index(source.geometry(), data.cells))


def test_vectors_propose_and_the_list_does_where_they_are_shuffled(trained, data_and_queries, monkeypatch):
    queries = [Query(" ".join(hints)) for hints in data_and_queries[1].sentences[::10] if len(hints) == 6]
    assert len(queries) >= 20
    own = [result.located for result in trained.find(queries)]
    assert np.mean([located.is_retrieved for located in own]) > 0.5
    mixed = np.random.default_rng(0).permutation(len(trained.ranker.store))
    monkeypatch.setattr(trained.ranker, "store", FaissStore.from_vectors(trained.ranker.store.vectors(mixed)))
    shuffled = [result.located for result in trained.find(queries)]
    pairs = list(zip(own, shuffled, strict=True))
    affected = [not b.is_retrieved or not np.allclose(a.positions[0], b.positions[0]) for a, b in pairs]
    assert np.mean(affected) >= 0.3
    assert np.mean([located.is_retrieved for located in shuffled]) < 0.3


def test_the_list_proposes_where_the_margin_is_low(trained, data_and_queries, monkeypatch):
    text, store = " ".join(data_and_queries[1].sentences[0]), trained.ranker.store
    hints = trained.chunk_reader.parse([text])[0]
    bound_hints = trained.binding.bind(hints)
    sentences = trained.binding.sentences(hints, bound_hints)
    retriever = trained.ranker.retriever
    encoded = retriever.encode_description(sentences).global_vectors[0].numpy()
    cosines = sorted((float(vector @ encoded) for vector in store.vectors(np.arange(len(store)))), reverse=True)
    config = retriever.config
    temperature = config.global_temperature / len(sentences) ** config.global_temperature_decay
    margin_nats = (cosines[0] - cosines[99]) / temperature
    for limit, is_used in ((margin_nats - 0.01, True), (margin_nats + 0.01, False)):
        monkeypatch.setattr("index.answering.posterior_localizer.MIN_MARGIN_NATS", limit)
        assert (trained.search(hints, bound_hints) is not None) == is_used


def test_the_list_proposes_where_the_retriever_understands_nothing_or_more_is_known(trained, data_and_queries):
    text = " ".join(data_and_queries[1].sentences[0])
    [plain, pulled] = trained.find([Query(text), Query(text, prior=Prior((0.0, 0.0), 500.0))])
    assert plain.located.is_retrieved
    assert not pulled.located.is_retrieved
    hints = trained.chunk_reader.parse(["I am north of a flurble."])[0]
    assert hints
    assert trained.search(hints, trained.binding.bind(hints)) is None
