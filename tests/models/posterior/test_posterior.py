import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
import torch

from models.language.parsed_hint import RELATIONS
from models.posterior import locate as locate_module
from models.posterior.area_filter import AreaFilter
from models.posterior.likelihood import BoundHints, Likelihood
from models.posterior.locate import MEAN_RADIUS_M, locate
from models.posterior.node_batch import colour_words
from models.posterior.posterior import HintPosterior, PositionEvidence
from models.sources.source import VALIDATION_SEED
from models.training.posterior.fit_likelihood import SiteTexts, fit_likelihood, negative_log_density, nodes_of_cells
from models.training.posterior.training_sites import TrainingSite


@dataclass
class Town:
    site: TrainingSite
    posterior: HintPosterior
    bound_hints: list[BoundHints]

    def texts(self) -> SiteTexts:
        return SiteTexts(self.site, np.arange(len(self.bound_hints)), self.bound_hints)


def exact(hints: Any, labels: tuple[str, ...], words: list[str]) -> BoundHints:
    """Return hints bound without doubt."""
    relation, label = torch.zeros(len(hints), len(RELATIONS)), torch.zeros(len(hints), len(labels))
    colour = torch.zeros(len(hints), len(words) + 1)
    for n, hint in enumerate(hints):
        relation[n, RELATIONS.index(hint.direction)] = 1.0
        label[n, labels.index(hint.label)] = 1.0
        colour[n, words.index(hint.colour) if hint.colour else -1] = 1.0
    return BoundHints(relation, label, colour, torch.full((len(hints),), math.nan), torch.zeros(len(hints)))


@pytest.fixture(scope="module")
def town(source) -> Town:
    place = TrainingSite.from_source(source, 25.0)
    words = colour_words(place.palette)
    bound_hints = [exact(hints, place.labels, words) for hints in place.hints]
    return Town(place, place.posterior(Likelihood()), bound_hints)


def test_a_map_is_told_of_as_it_is_and_as_a_scan_shows_it(town, source) -> None:
    queries_of_sources = [each.queries(VALIDATION_SEED, 25.0) for each in (source, source.as_scan())]
    assert town.site.hints == [hints for queries in queries_of_sources for hints in queries.hints]


def all_nodes_m(town):
    """Return the positions [M, 2] of all nodes."""
    return town.site.surroundings.positions_m(np.arange(town.site.surroundings.cell_starts[-1]))


def test_the_field_is_the_likelihood_of_its_nodes(town):
    cells = np.array([3, 40, 11])
    for hints in town.bound_hints[:3]:
        field = town.posterior.field(PositionEvidence(hints), cells)
        nodes, around = nodes_of_cells(town.site, cells)
        assert (field.nodes == nodes).all()
        with torch.no_grad():
            direct = town.posterior.likelihood(hints, around, town.site.palette, town.posterior.mean_statements)
        assert np.allclose(field.log_p, direct.numpy(), atol=1e-3)


def test_the_mass_of_a_likely_cell_is_that_of_all_its_nodes(town):
    for hints in town.bound_hints[:5]:
        located = locate(town.posterior, PositionEvidence(hints))
        likely = int((located.score > located.score[0] - 5).sum())
        field = town.posterior.field(PositionEvidence(hints), located.rows[:likely])
        mass = [np.logaddexp.reduce(field.log_p[field.cell == n]) for n in range(likely)]
        assert np.allclose(located.score[:likely], mass, atol=1e-3)
        assert np.isin(field.nodes, located.points).all()
        assert len(np.unique(located.points)) == len(located.points)


def test_descriptions_are_found_where_they_were_said(town):
    hits, near, candidates = [], [], []
    for q, hints in enumerate(town.bound_hints[:60]):
        located = locate(town.posterior, PositionEvidence(hints))
        hits.append(located.rows[0] == town.site.truth[q])
        near.append(np.linalg.norm(located.positions[0] - town.site.positions_m[q]) <= 5)
        scores = town.posterior.cell_scores(hints)
        candidates.append((scores > scores[town.site.truth[q]]).sum() < 50)
    assert np.mean(candidates) > 0.95
    assert np.mean(hits) > 0.4, "a repetitive toy town; chance is 1 in some hundreds"
    assert np.mean(near) > 0.5


def test_probabilities_add_up_and_radii_are_in_order(town):
    for hints in town.bound_hints[:20]:
        located = locate(town.posterior, PositionEvidence(hints), candidates=30)
        assert located.probability.sum() + located.other == pytest.approx(1.0)
        assert located.weight.sum() + located.other == pytest.approx(1.0)
        assert (np.diff(located.score) <= 1e-12).all()
        p50, p90 = located.radii_m(0.5, 0.9)
        assert 0 < p50 <= p90 <= located.extent_m
        eigenvalues = np.linalg.eigvalsh(located.covariance_m2())
        assert (eigenvalues > 0).all()


def test_proposed_cells_are_evaluated_instead_of_those_of_the_list(town):
    cells = np.arange(len(town.posterior.cells))
    for hints in town.bound_hints[:10]:
        part, whole = (locate(town.posterior, PositionEvidence(hints), candidates=n) for n in (20, len(cells)))
        joined = locate(town.posterior, PositionEvidence(hints), candidates=20, proposed=cells[::-1])
        assert (joined.is_retrieved, part.is_retrieved) == (True, False)
        assert part.other > 0
        assert joined.other == whole.other == 0
        assert joined.rows.tolist() == whole.rows.tolist()
        assert np.allclose(joined.probability, whole.probability)
        assert len(np.unique(joined.points)) == len(joined.points)


def test_each_candidate_has_a_position_of_its_own(town):
    surroundings = town.posterior.surroundings
    for hints in town.bound_hints[:20]:
        located = locate(town.posterior, PositionEvidence(hints))
        for row, position in zip(located.rows[1:], located.positions[1:], strict=True):
            own = surroundings.positions_m(np.arange(surroundings.cell_starts[row], surroundings.cell_starts[row + 1]))
            assert np.linalg.norm(own - position, axis=1).min() < 2 * MEAN_RADIUS_M


def test_a_prior_may_rule_places_out(town):
    east = np.median(all_nodes_m(town)[:, 0])
    prior = PositionEvidence(
        town.bound_hints[0], log_prior=lambda positions_m: np.where(positions_m[:, 0] > east, 0.0, -np.inf)
    )
    located = locate(town.posterior, prior)
    assert located.positions[0, 0] > east
    assert located.probability.sum() + located.other == pytest.approx(1.0)


def test_cells_far_behind_may_be_looked_at_roughly(town, monkeypatch):
    rough = [locate(town.posterior, PositionEvidence(hints)) for hints in town.bound_hints[:30]]
    monkeypatch.setattr(locate_module, "MAX_GAP_NATS", np.inf)
    exact = [locate(town.posterior, PositionEvidence(hints)) for hints in town.bound_hints[:30]]
    assert any(len(a.points) < len(b.points) for a, b in zip(rough, exact, strict=True)), "some cells are left rough"
    for a, b in zip(rough, exact, strict=True):
        assert a.rows[0] == b.rows[0]
        assert a.probability[0] == pytest.approx(b.probability[0], abs=0.02)
        assert np.allclose(a.positions[0], b.positions[0], atol=0.01)


def test_one_hint_leaves_much_open(town):
    whole = town.bound_hints[0]
    one = BoundHints(whole.relation[:1], whole.label[:1], whole.colour[:1], whole.distance_m[:1], whole.absent[:1])
    wide, narrow = (locate(town.posterior, PositionEvidence(hints)) for hints in (one, whole))
    assert wide.probability[0] < narrow.probability[0]
    assert wide.other > narrow.other
    assert wide.radii_m(0.9) > narrow.radii_m(0.9)


def test_a_filter_is_exact(town):
    nodes_m = all_nodes_m(town)
    for q in range(0, 30, 3):
        truth = town.site.positions_m[q]
        is_inside = np.abs(nodes_m - truth).max(axis=1) <= 20.0
        cells = np.repeat(np.arange(len(town.site.cells)), np.diff(town.site.surroundings.cell_starts))[is_inside]
        has_one = np.bincount(cells, minlength=len(town.site.cells)) > 0
        area = AreaFilter(has_one, lambda points_m, truth=truth: np.abs(points_m - truth).max(axis=1) <= 20.0)
        located = locate(town.posterior, PositionEvidence(town.bound_hints[q], area=area), candidates=10)
        assert (np.abs(located.points_m - truth).max(axis=1) <= 20.0).all()
        every = locate(town.posterior, PositionEvidence(town.bound_hints[q], area=area), candidates=10_000)
        assert located.rows[0] == every.rows[0]
        assert set(every.rows.tolist()) == set(cells.tolist()), "nothing inside is lost"
    nowhere = AreaFilter(np.zeros(len(town.site.cells), np.bool_), lambda points_m: np.zeros(len(points_m), np.bool_))
    assert locate(town.posterior, PositionEvidence(town.bound_hints[0], area=nowhere)) is None


def test_a_prior_is_multiplied_in(town):
    center = town.site.positions_m[5] + 4.0

    def log_prior(positions_m):
        return -((positions_m - center) ** 2).sum(axis=1) / (2 * 6.0**2)

    cells, hints = np.arange(len(town.site.cells)), town.bound_hints[5]
    plain, biased = (
        town.posterior.field(PositionEvidence(hints, log_prior=prior), cells) for prior in (None, log_prior)
    )
    assert np.allclose(biased.log_p - plain.log_p, log_prior(town.posterior.surroundings.positions_m(plain.nodes)))
    located = locate(town.posterior, PositionEvidence(town.bound_hints[5], log_prior=log_prior))
    assert np.linalg.norm(located.positions[0] - center) < 20.0


def test_the_instance_that_was_meant_explains_a_hint(town, city, cells):
    number = {instance.id: n for n, instance in enumerate(city.instances)}
    right = total = 0
    for q in range(0, 60, 3):
        node = int(np.linalg.norm(all_nodes_m(town) - town.site.positions_m[q], axis=1).argmin())
        for hint, explanation in zip(
            town.site.hints[q], town.posterior.explain(town.bound_hints[q], node), strict=True
        ):
            total += 1
            meant = (
                explanation.part >= 0
                and town.site.surroundings.objects.instance[explanation.part] == number[hint.instance_id]
            )
            right += meant and explanation.probability > 0.5
    assert right / total > 0.7, "things alike stand side by side in this town"


def test_what_fits_only_because_a_label_may_be_wrong_does_not_explain(town):
    node = int(np.linalg.norm(all_nodes_m(town) - town.site.positions_m[0], axis=1).argmin())
    doubted = replace(town.bound_hints[0], label=0.05 * town.bound_hints[0].label)
    surely, hardly = (
        np.array([explanation.probability for explanation in town.posterior.explain(hints, node)])
        for hints in (town.bound_hints[0], doubted)
    )
    assert surely.max() > 0.5
    assert hardly.max() <= 2 * 0.05 + 1e-6


@pytest.mark.slow
def test_fitting_makes_the_truth_likelier(town):
    texts, cells = town.texts(), np.arange(0, len(town.site.cells), 3)

    def surprised(likelihood):
        cell_sets = [np.union1d(cells, town.site.truth[q : q + 1]) for q in range(0, 40, 4)]
        with torch.no_grad():
            return np.mean(
                [
                    float(negative_log_density(likelihood, texts, 4 * n, part, town.posterior.mean_statements))
                    for n, part in enumerate(cell_sets)
                ]
            )

    fitted = [Likelihood() for _ in range(2)]
    for likelihood in fitted:
        with torch.no_grad():
            likelihood.border_m.add_(2.0)  # far too soft
        before = surprised(likelihood)
        fit_likelihood(likelihood, [texts], 4, np.random.default_rng(0))
    assert all(torch.equal(a, b) for a, b in zip(*(f.parameters() for f in fitted), strict=True)), "seeded"
    assert surprised(fitted[0]) < before - 0.05
