import numpy as np
import pytest
import torch

from models.citymap.gazetteer.closest_points import PointGroups
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, WALKED_KIND, build_gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.language.measures import Measure
from models.language.mentions.cues import Cue
from models.language.mentions.mentions import Mention
from models.posterior.places.field import PlaceEvidence, PlaceField
from models.posterior.places.kernels import HEADINGS, TYPES, PlaceKernels, kernel_of
from tests.models.citymap.gazetteer.made_town import BENCHES, line, made_gazetteer, numbered, point

GRID_M = 10.0
CENTERS = np.stack(np.meshgrid(np.arange(-45, 446, GRID_M), np.arange(-45, 206, GRID_M)), axis=-1).reshape(-1, 2)
NODES = np.stack(np.meshgrid(np.arange(-48, 450, 6.0), np.arange(-48, 210, 6.0)), axis=-1).reshape(-1, 2)
ANYWHERE = np.zeros(len(NODES), np.int64)
TOWN = made_gazetteer()


@pytest.fixture(scope="module")
def field() -> PlaceField:
    return PlaceField(PlaceKernels(), TOWN, CENTERS, GRID_M)


def thing(*names: str, cue: Cue = Cue(), **more) -> Mention:  # noqa: B008  # frozen
    objects = np.array([numbered(TOWN, name) for name in names])
    more = {"is_exact": True, "weights": np.ones(len(objects))} | more
    return Mention(names[0], 0, 1, "thing", objects, cue=cue, **more)


def street(name: str, **more) -> Mention:
    return Mention(name, 0, 1, "street", np.array([numbered(TOWN, name)]), np.ones(1), **more)


def corner(x: float, y: float) -> Mention:
    lines = np.array([[x, y, x, y]])
    return Mention("corner", 0, 1, "corner", lines_m=lines, weights=np.ones(1), is_exact=True, cue=Cue("at"))


def best(evidence: PlaceEvidence) -> np.ndarray:
    return np.asarray(NODES[evidence.log_p(NODES, ANYWHERE).argmax()])


def test_the_field_of_a_corner_peaks_at_the_corner(field) -> None:
    evidence = field.evidence([corner(200, 80)])
    assert np.hypot(*(best(evidence) - (200, 80))) < 6
    assert np.hypot(*(CENTERS[evidence.cell_log_p.argmax()] - (200, 80))) <= 2 * GRID_M
    log_p = evidence.log_p(
        np.array([(200.0, 80.0), (215.0, 80.0), (260.0, 80.0), (400.0, 80.0)]), np.zeros(4, np.int64)
    )
    assert (np.diff(log_p) < 0).all()
    assert log_p[0] > 1
    assert log_p[-1] < 0


def test_between_a_thing_on_the_left_and_one_on_the_right(field) -> None:
    """Elmo is at (120, 148), T-Optik at (120, 92)."""
    evidence = field.evidence([thing("Elmo", cue=Cue(angle=-90.0)), thing("T-Optik", cue=Cue(angle=90.0))])
    x, y = best(evidence)
    assert abs(x - 120) <= 15
    assert 92 < y < 148
    with torch.inference_mode():
        by_heading = field.by_heading(evidence.placed, np.array([[120.0, 120.0]]), np.zeros(1, np.int64))[0]
    assert by_heading.argmax() == HEADINGS // 4, "Elmo in the north is on the left of who looks east"
    assert by_heading[HEADINGS // 4] - by_heading[3 * HEADINGS // 4] > 2


@pytest.mark.parametrize(("angle", "heading"), [(0.0, 0), (90.0, 12), (180.0, 8), (-90.0, 4)])
def test_headings_are_clockwise_from_north(field, angle, heading) -> None:
    placed = field.evidence([thing("Elmo", cue=Cue(angle=angle))]).placed
    with torch.inference_mode():
        by_heading = field.by_heading(placed, np.array([[120.0, 120.0]]), np.zeros(1, np.int64))[0]
    assert by_heading.argmax() == heading


def test_an_angle_that_is_not_sure_is_summed_over(field) -> None:
    elmo, points_m = numbered(TOWN, "Elmo"), np.array([[120.0, 120.0]])
    either = Cue(angle=-90.0, angles=((-90.0, 0.6), (90.0, 0.4)))
    shares = []
    for cue in (Cue(angle=-90.0), Cue(angle=90.0), either):
        placed = field.evidence([thing("Elmo", cue=cue), thing("T-Optik", cue=Cue("at"))]).placed
        with torch.inference_mode():
            ways = field.closest_points(placed.mentions[0], PointGroups.from_groups(points_m, np.zeros(1, np.int64)))
            shares.append(field.fits(placed.mentions[0], ways, 1)[0])
    assert placed.mentions[0].objects.tolist() == [elmo]
    assert torch.allclose(shares[2], 0.6 * shares[0] + 0.4 * shares[1], atol=1e-6)


def test_people_stand_where_they_walk() -> None:
    town = build_gazetteer(
        [GazetteerObject(("amenity/bench",)), GazetteerObject((WALKED_KIND,))],
        [point(100.0, 100.0), line((0.0, 110.0), (200.0, 110.0))],
        [False, False],
    )
    field = PlaceField(PlaceKernels(), town, CENTERS, GRID_M)
    bench = Mention("bench", 0, 1, "thing", np.array([0]), np.ones(1), kinds=("amenity/bench",), cue=Cue("beside"))
    near_bench = np.array([(100.0, 110.0), (100.0, 90.0)])  # as far from the bench
    walks, other = field.evidence([bench]).log_p(near_bench, np.zeros(2, np.int64))
    assert walks > other + 1
    walks, other = field.evidence([bench], is_meeting=True).log_p(near_bench, np.zeros(2, np.int64))
    assert walks == pytest.approx(other, abs=1e-5), "where to meet may be anywhere"


def test_a_wind_tells_the_side(field) -> None:
    evidence = field.evidence([thing("Elmo", cue=Cue("wind", wind=0.0))])  # it is in the north
    south, north = evidence.log_p(np.array([(120.0, 120.0), (120.0, 176.0)]), np.zeros(2, np.int64))
    assert south - north > 1


def test_a_distance_is_a_ring(field) -> None:
    evidence = field.evidence([thing("Elmo", cue=Cue(measure=Measure(0, 4, 50.0)))])
    points_m = np.array([(120.0, 143.0), (120.0, 98.0), (120.0, 18.0)])
    near, there, far = evidence.log_p(points_m, np.zeros(3, np.int64))
    assert there > near
    assert there > far


def test_rare_things_tell_more_than_common_ones(field) -> None:
    benches = np.array([n for n, words in enumerate(TOWN.objects) if words.kinds == ("amenity/bench",)])
    assert len(benches) == len(BENCHES)
    bench = Mention("bench", 0, 1, "thing", benches, np.ones(len(benches)), kinds=("amenity/bench",), cue=Cue("near"))
    common, rare = (
        field.evidence([mention]).log_p(NODES, ANYWHERE) for mention in (bench, thing("Elmo", cue=Cue("near")))
    )
    assert np.ptp(common) < np.ptp(rare) / 2
    assert common.max() < rare.max() / 2


def test_what_is_everywhere_tells_nothing() -> None:
    grid = NODES[::5]
    everywhere = build_gazetteer(
        [GazetteerObject(("natural/tree",))] * len(grid), [point(*position) for position in grid], [False] * len(grid)
    )
    field = PlaceField(PlaceKernels(), everywhere, CENTERS, GRID_M)
    tree = Mention("tree", 0, 1, "thing", np.arange(len(grid)), np.ones(len(grid)), kinds=("natural/tree",))
    evidence = field.evidence([tree])
    assert np.abs(evidence.cell_log_p).max() < 0.1
    assert np.abs(evidence.log_p(NODES[::9], ANYWHERE[::9])).max() < 0.3


def test_the_north_side_of_a_street(field) -> None:
    points_m = np.array([(100.0, 92.0), (100.0, 68.0)])
    north, south = field.evidence([street("West 25th Street", side=0.0)]).log_p(points_m, np.zeros(2, np.int64))
    assert north - south > 1
    north, south = field.evidence([street("West 25th Street", side=180.0)]).log_p(points_m, np.zeros(2, np.int64))
    assert south - north > 1
    north, south = field.evidence([street("West 25th Street")]).log_p(points_m, np.zeros(2, np.int64))
    assert north == pytest.approx(south, abs=1e-3)


def test_the_wind_from_a_listener(field) -> None:
    evidence = field.evidence([], np.array([200.0, 80.0]), 90.0)
    east, west, north = evidence.log_p(np.array([(300.0, 80.0), (100.0, 80.0), (200.0, 180.0)]), np.zeros(3, np.int64))
    assert east > north > west
    assert east - west > 2
    cells = [np.hypot(*(CENTERS - place).T).argmin() for place in ((300, 80), (100, 80))]
    assert evidence.cell_log_p[cells[0]] - evidence.cell_log_p[cells[1]] == pytest.approx(east - west, abs=0.2)
    assert not field.evidence([], np.array([200.0, 80.0])).cell_log_p.any(), "no wind, no news"
    assert not field.evidence([], None, 90.0).cell_log_p.any()


def test_places_off_the_map_leave_everything_even(field) -> None:
    evidence = field.evidence([corner(9000, 9000)])
    assert evidence.placed.mentions == ()
    assert not evidence.cell_log_p.any()
    assert not evidence.log_p(NODES, ANYWHERE).any()


def test_no_mentions_and_unknown_ones_leave_everything_even(field) -> None:
    for mentions in ([], [Mention("Blarney", 0, 7, "unknown")]):
        evidence = field.evidence(mentions)
        assert not evidence.cell_log_p.any()
        assert not evidence.log_p(NODES, ANYWHERE).any()
    assert field.evidence([]).log_p(NODES[:0], ANYWHERE[:0]).shape == (0,)


def test_a_map_where_nothing_is_named() -> None:
    field = PlaceField(PlaceKernels(), EMPTY_GAZETTEER, CENTERS, GRID_M)
    evidence = field.evidence([corner(200, 80)])
    assert np.hypot(*(best(evidence) - (200, 80))) < 6


def test_answers_do_not_depend_on_the_grouping(field) -> None:
    evidence = field.evidence([
        corner(200, 80), street("West 25th Street", side=0.0), thing("Bottino", "Elmo", cue=Cue(angle=-90.0)),
        thing("Whole Foods", cue=Cue("wind", wind=90.0)), thing("Chelsea Park", cue=Cue("across")),
    ])  # fmt: skip
    one = evidence.log_p(NODES, ANYWHERE)
    alone = evidence.log_p(NODES, np.arange(len(NODES)))
    tiles = (NODES // 50) @ (100, 1)
    order = np.argsort(tiles, kind="stable")
    tiled = evidence.log_p(NODES[order], np.unique(tiles[order], return_inverse=True)[1])
    assert np.allclose(one, alone, atol=1e-4)
    assert np.allclose(one[order], tiled, atol=1e-4)


def test_more_that_fits_makes_a_place_likelier(field) -> None:
    points_m, group = np.array([[200.0, 80.0]]), np.zeros(1, np.int64)
    one = field.evidence([corner(200, 80)]).log_p(points_m, group)
    two = field.evidence([corner(200, 80), thing("Bottino", cue=Cue("near"))]).log_p(points_m, group)
    wrong = field.evidence([corner(200, 80), thing("Duane Reade", cue=Cue("near"))]).log_p(points_m, group)
    assert two > one > wrong
    assert one - wrong < 3, "one thing that is wrong does not rule a place out"


def test_what_is_trusted_less_tells_less(field) -> None:
    sure, unsure, none = (
        field.evidence([thing("Elmo", trust=trust)]).log_p(NODES, ANYWHERE) for trust in (1.0, 0.3, 0.0)
    )
    assert np.ptp(sure) > np.ptp(unsure) > 0
    assert np.abs(none).max() < 1e-5


def test_the_weightier_of_two_is_likelier(field) -> None:
    evidence = field.evidence([thing("Elmo", "Bottino", cue=Cue("beside"), weights=np.array([1.0, 0.3]))])
    elmo, bottino = evidence.log_p(np.array([(120.0, 148.0), (215.0, 92.0)]), np.zeros(2, np.int64))
    assert elmo > bottino > 0


def test_a_mentionis_explained_by_what_is_near(field) -> None:
    mention = thing("Elmo", "Bottino", cue=Cue("beside"))
    placed = field.evidence([mention]).placed
    points_m = np.array([[215.0, 95.0]])
    [[explained]] = field.explain(placed, points_m)
    assert explained.probability > 0.8
    assert explained.item == 1, "Bottino"
    assert explained.offset_m == pytest.approx([0, -3])
    [[nothing]] = field.explain(placed, np.array([[3000.0, 95.0]]))
    assert (nothing.probability, nothing.item) == (0.0, -1)


def test_what_is_denied_counts_against(field) -> None:
    near, far = np.array([[120.0, 146.0], [350.0, 20.0]])
    one, denied = thing("Rossi Bakery", cue=Cue("seen")), thing("Elmo", is_denied=True)
    plain, without = (
        field.evidence(mentions).log_p(np.array([near, far]), np.zeros(2, np.int64))
        for mentions in ([one], [one, denied])
    )
    assert without[0] < plain[0] - 0.5
    assert without[1] == pytest.approx(plain[1], abs=0.05)


def test_positions_explained_together_are_explained_as_alone(field) -> None:
    mentions = [thing("Elmo", "Bottino", cue=Cue("beside")), thing("Rossi Bakery", cue=Cue("seen", 90.0))]
    placed = field.evidence(mentions).placed
    points_m = np.array([[215.0, 95.0], [3000.0, 95.0], [118.0, 150.0], [60.0, 150.0]])
    together = field.explain(placed, points_m)
    for explanations, point_m in zip(together, points_m, strict=True):
        [alone] = field.explain(placed, point_m[None])
        for one, other in zip(explanations, alone, strict=True):
            assert (one.item, one.heading_deg) == (other.item, other.heading_deg)
            assert one.probability == pytest.approx(other.probability, rel=1e-5)
            assert one.offset_m == pytest.approx(other.offset_m)
    assert len({tuple(one.item for one in explanations) for explanations in together}) > 2, "else this tests little"


def test_inside_a_park_is_all_of_it(field) -> None:
    evidence = field.evidence([thing("Chelsea Park", cue=Cue("inside"))])
    inside = evidence.log_p(np.array([(245.0, 15.0), (285.0, 40.0)]), np.zeros(2, np.int64))
    assert inside[0] == pytest.approx(inside[1])
    assert evidence.log_p(np.array([[285.0, 100.0]]), np.zeros(1, np.int64)) < inside[0] - 1


@pytest.mark.parametrize(
    ("mention", "kind"),
    [
        (thing("Elmo"), "seen"),
        (thing("Elmo", cue=Cue(angle=0.0)), "ahead"),
        (thing("Elmo", cue=Cue(angle=-90.0)), "side"),
        (thing("Elmo", cue=Cue(angle=-170.0)), "behind"),
        (thing("Elmo", cue=Cue("across", 90.0)), "across"),
        (street("West 25th Street"), "street"),
        (street("West 25th Street", cue=Cue("near")), "street near"),
        (street("West 25th Street", cue=Cue(angle=0.0)), "street near"),
        (corner(0, 0), "corner"),
        (Mention("s", 0, 1, "span", cue=Cue("on")), "span"),
        (Mention("a", 0, 1, "address", cue=Cue("at")), "address"),
    ],
)
def test_which_kernel(mention, kind) -> None:
    assert TYPES[kernel_of(mention, mention.cue.angle)] == kind


def test_a_long_street_is_near_along_all_of_it() -> None:
    town = build_gazetteer([GazetteerObject((STREET_KIND,), ("Main Street",))], [line((-50, 80), (450, 80))], [False])
    evidence = PlaceField(PlaceKernels(), town, CENTERS, GRID_M).evidence(
        [Mention("m", 0, 1, "street", np.array([0]), np.ones(1))]
    )
    along = evidence.log_p(np.stack([np.arange(0, 400, 40.0), np.full(10, 80.0)], axis=1), np.zeros(10, np.int64))
    assert np.ptp(along) < 1e-4
    assert along[0] > evidence.log_p(np.array([[200.0, 160.0]]), np.zeros(1, np.int64)) + 1


@pytest.mark.parametrize(("one", "other"), [(0.0, 90.0), (-90.0, 45.0), (180.0, None), (None, -135.0)])
def test_angles_that_are_not_sure_are_summed_over(field, one, other) -> None:
    around = PointGroups.from_groups(np.array([[120.0, 120.0], [131.0, 124.0]]), np.zeros(2, np.int64))

    def fits(cue):
        mention = thing("Elmo", cue=cue)
        return field.fits(mention, field.closest_points(mention, around), 2)

    both = fits(Cue(angle=one, angles=((one, 0.7), (other, 0.3))))
    torch.testing.assert_close(both, 0.7 * fits(Cue(angle=one)) + 0.3 * fits(Cue(angle=other)))


@torch.inference_mode()
def test_cells_have_what_they_would_have_if_each_were_looked_at(field) -> None:
    """In a town that is wide against what is looked at cell by cell."""
    rng = np.random.default_rng(2)
    centers = np.stack(np.meshgrid(np.arange(0, 3000, GRID_M), np.arange(0, 1500, GRID_M)), axis=-1).reshape(-1, 2)
    words = [GazetteerObject(("shop",), (name,)) for name in ("One", "Other", "Third")]
    town = build_gazetteer(
        words, [point(*position) for position in rng.uniform((0, 0), (3000, 1500), (3, 2))], [False] * 3
    )
    wide = PlaceField(PlaceKernels(), town, centers, GRID_M)
    cues = Cue(), Cue(relation="near"), Cue(measure=Measure(0, 5, 100.0))
    mentions = [
        Mention(name, 0, 1, "thing", np.array(objects), np.linspace(1.0, 0.3, len(objects)), cue=cue, is_exact=True)
        for name, objects, cue in zip("abc", ([0], [1], [0, 2]), cues, strict=True)
    ]
    evidence, total = wide.evidence(mentions), np.zeros(len(centers))
    assert len(evidence.placed.mentions) == len(mentions)
    for mention, common in zip(mentions, evidence.placed.kernel_means, strict=True):
        rough = wide.coarse_distances(mention, np.arange(len(centers)))
        assert float(common) == pytest.approx(float(wide.coarse_kernel_mean(mention, rough)), rel=1e-4)
        total += wide.log_evidence(mention, wide.coarse_kernel(mention, rough), common).numpy()
    assert np.abs(evidence.cell_log_p - total).max() < 1e-4
