"""The tables and figures of MNCL (AAAI 2025) as runs to make: what is trained, and what the paper says of it.

Published figures are of KITTI360Pose's test split, by the same protocol (docs/formats.md, protocol); on other data they
are for comparison of order, not of height.
"""

from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class Run:
    """One training.

    Attributes:
        method: key of models.retrieval.checkpoint.METHODS.
        changes: fields of its configuration that differ from its defaults.
    """

    method: str
    changes: tuple[tuple[str, Any], ...] = ()

    @property
    def name(self) -> str:
        """A name for its directory: the method and what differs."""
        parts = [f"{key}={'+'.join(value) if isinstance(value, tuple) else value}" for key, value in self.changes]
        return "-".join([self.method, *parts])

    @property
    def settings(self) -> tuple[str, ...]:
        """What differs, as `load_settings` takes it."""
        return tuple(
            f"model.{key}={','.join(value) if isinstance(value, tuple) else value}" for key, value in self.changes
        )


@dataclass(frozen=True, slots=True)
class Row:
    """A row of a table, or a point of a curve.

    Attributes:
        name: as the paper calls it.
        run: what is trained for it.
        published: figures by name, such as "R@1" or "k=1: 5/10/15 m"; those that the paper has.
    """

    name: str
    run: Run
    published: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Experiment:
    """A table or a curve.

    Attributes:
        title: which one, and of what.
        metrics: columns.
        rows: rows, or points in order.
        every_seed: whether it is made with every seed, as the tables are, or with the first alone.
    """

    title: str
    metrics: tuple[str, ...]
    rows: tuple[Row, ...]
    every_seed: bool = True


def _mncl(**changes: Any) -> Run:
    return Run("mncl", tuple(sorted(changes.items())))


MNCL = _mncl()
RETRIEVAL = ("R@1", "R@3", "R@5")
LOCALIZATION = ("k=1", "k=5", "k=10")

TABLE_1 = Experiment(
    "Table 1: localization recall within 5/10/15 m",
    LOCALIZATION,
    (
        Row("Text2Pos", Run("text2pos"), {"k=1": ".13/.21/.25", "k=5": ".33/.48/.52", "k=10": ".43/.61/.65"}),
        Row("RET", Run("ret"), {"k=1": ".16/.25/.29", "k=5": ".35/.51/.56", "k=10": ".46/.65/.71"}),
        Row("Text2Loc", Run("text2loc"), {"k=1": ".33/.48/.52", "k=5": ".61/.75/.78", "k=10": ".71/.84/.86"}),
        Row("MNCL", MNCL, {"k=1": ".50/.66/.68", "k=5": ".76/.87/.89", "k=10": ".83/.93/.94"}),
    ),
)
TABLE_2 = Experiment(
    "Table 2: retrieval recall",
    RETRIEVAL,
    (
        Row("Text2Pos", Run("text2pos"), {"R@1": ".12", "R@3": ".25", "R@5": ".33"}),
        Row("RET", Run("ret")),
        Row("Text2Loc", Run("text2loc"), {"R@1": ".28", "R@3": ".49", "R@5": ".58"}),
        Row("MNCL", MNCL, {"R@1": ".44", "R@3": ".67", "R@5": ".75"}),
    ),
)
TABLE_3 = Experiment(
    "Table 3: levels",
    RETRIEVAL,
    (
        Row("global", _mncl(levels=("global",)), {"R@1": ".38"}),
        Row("global + instance", _mncl(levels=("global", "instance")), {"R@1": ".42"}),
        Row("global + relation", _mncl(levels=("global", "relation")), {"R@1": ".42"}),
        Row("all three", MNCL, {"R@1": ".44"}),
    ),
)
TABLE_4 = Experiment(
    "Table 4: loss",
    RETRIEVAL,
    (
        Row("vanilla contrastive", _mncl(loss="contrastive"), {"R@1": ".41"}),
        Row("negative contrastive", MNCL, {"R@1": ".44"}),
    ),
)
FIGURE_4A = Experiment(
    "Figure 4: layers of the graph",
    RETRIEVAL,
    tuple(Row(f"{m} layers", MNCL if m == 3 else _mncl(graph_layers=m)) for m in range(6)),
    every_seed=False,
)
FIGURE_4B = Experiment(
    "Figure 4: exponent a of the negative loss",
    RETRIEVAL,
    tuple(
        Row(f"a = {a}", MNCL if a == 2 else _mncl(loss="contrastive") if a == 0 else _mncl(exponent=float(a)))
        for a in range(5)
    ),
    every_seed=False,
)
CODE = Experiment(
    "Where the paper and its released code differ",
    RETRIEVAL,
    (
        Row("nodes pass on their own state (code; our default)", MNCL),
        Row("nodes gather their edges (the paper's GCN)", _mncl(aggregate="gcn")),
    ),
    every_seed=False,
)
POINTS = Experiment(
    "What an instance is seen by",
    RETRIEVAL,
    (
        Row("label, colour, place, size, number of points (our default)", MNCL),
        Row("and its points, by PointNet++ (the paper)", _mncl(point_encoder="pointnet")),
    ),
    every_seed=False,
)
EXPERIMENTS = (TABLE_1, TABLE_2, TABLE_3, TABLE_4, FIGURE_4A, FIGURE_4B, CODE, POINTS)
# The fine stage of each method of table 1.
REGRESSOR = Run("regressor")
FINE = {
    "text2pos": Run("matching"),
    "ret": Run("matching", (("refine", True),)),
    "text2loc": REGRESSOR,
    "mncl": REGRESSOR,
}
# Figure 5: change of recall@1 as the gallery grows from 200 m to 300, 400 and 500 m round one centre.
GROWTH = {"Text2Loc": (Run("text2loc"), "-14.3/-16.8/-19.2 %"), "MNCL": (MNCL, "-4.9/-6.8/-9.6 %")}
# What the paper's tables say of recall@1: (claim, the worse, the better).
ORDERS = (
    ("Text2Loc above Text2Pos", Run("text2pos"), Run("text2loc")),
    ("MNCL above Text2Loc", Run("text2loc"), MNCL),
    ("global + instance above global", _mncl(levels=("global",)), _mncl(levels=("global", "instance"))),
    ("global + relation above global", _mncl(levels=("global",)), _mncl(levels=("global", "relation"))),
    ("all levels above global + instance", _mncl(levels=("global", "instance")), MNCL),
    ("all levels above global + relation", _mncl(levels=("global", "relation")), MNCL),
    ("negative contrastive above vanilla", _mncl(loss="contrastive"), MNCL),
)


@dataclass(frozen=True, slots=True)
class Scale:
    """How much is trained, and how far a gallery grows.

    Attributes:
        retriever, fine: settings that differ from those in configs/, as `load_settings` takes them.
        growth_radii_m: of figure 5.
    """

    retriever: tuple[str, ...]
    fine: tuple[str, ...]
    growth_radii_m: tuple[float, ...]


_ALL = ("training.batch_size=64", "training.wording=published")
# Batches without near neighbours, as the paper's; ours by default have them, which helps the vanilla loss more.
_RETRIEVER = (*_ALL, "training.cluster=1")
SCALES = {
    "demo": Scale(
        (*_RETRIEVER, "model.width=128", "training.steps=400", "training.validate_every=100"),
        (*_ALL, "training.steps=400", "training.validate_every=100"),
        (80.0, 110.0, 140.0, 200.0),
    ),
    # 32 epochs of KITTI360Pose's 28,807 training poses.
    "full": Scale(
        (*_RETRIEVER, "training.steps=14400", "training.validate_every=450"),
        (*_ALL, "training.steps=14400", "training.validate_every=450"),
        (200.0, 300.0, 400.0, 500.0),
    ),
}


def runs_of(every_seed: bool) -> tuple[Run, ...]:
    """The trainings that the tables need, each once, methods first; those of the first seed also make the figures."""
    experiments = [experiment for experiment in EXPERIMENTS if experiment.every_seed or not every_seed]
    runs = [row.run for experiment in experiments for row in experiment.rows]
    return tuple(dict.fromkeys([*(row.run for row in TABLE_2.rows), *FINE.values(), *runs]))
