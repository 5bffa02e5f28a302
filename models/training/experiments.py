"""Tables and curves as runs to make: what is trained, in which variants, and how much."""

from dataclasses import dataclass, field
from typing import Any, Literal

from models.paper.instance_encoder import PAPER_INPUTS

Changes = tuple[tuple[str, Any], ...]
Metric = Literal["retrieval", "localization"]
# What an instance is seen by: a name, and the fields that say so.
VARIANTS: dict[str, Changes] = {"our inputs": (), "the paper's inputs": (("inputs", PAPER_INPUTS),)}
POINTS = "points"  # the method name of the point encoder


@dataclass(frozen=True, slots=True)
class Run:
    """One training.

    Attributes:
        method: key of METHODS or FINE_METHODS, or POINTS.
        changes: fields of its configuration that differ from its defaults, by name.
    """

    method: str
    changes: Changes = ()

    def changed(self, changes: Changes) -> "Run":
        """The same with further fields."""
        return Run(self.method, tuple(sorted((dict(self.changes) | dict(changes)).items())))

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

    @property
    def sees_points(self) -> bool:
        """Whether it needs the point encoder."""
        return "points" in dict(self.changes).get("inputs", ())


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """A row of a table, or a point of a curve.

    Attributes:
        name: as the paper calls it.
        run: what is trained for it.
        published: figures by column, on the test split; those that the paper has.
        validation: the same on the validation split.
        fine: its fine stage, in tables of localization.
        only: the variant that it is made of; None for all that its table has.
    """

    name: str
    run: Run
    published: dict[str, str] = field(default_factory=dict)
    validation: dict[str, str] = field(default_factory=dict)
    fine: Run | None = None
    only: str | None = None


@dataclass(frozen=True, slots=True)
class Experiment:
    """A table or a curve.

    Attributes:
        key: "1" to "4", "4a", "4b", or a word for what the paper does not have.
        title: which one, and of what.
        rows: rows, or points in order.
        metric: what is measured.
        variants: names of VARIANTS, each of which is made of every row.
        every_seed: whether it is made with every seed, as the tables are, or with the first alone.
        note: what a reader must know of it.
        best: name of the row that is best in the paper, of curves without figures.
    """

    key: str
    title: str
    rows: tuple[Row, ...]
    metric: Metric = "retrieval"
    variants: tuple[str, ...] = tuple(VARIANTS)
    every_seed: bool = True
    note: str = ""
    best: str | None = None

    def made(self) -> list[tuple[Row, str]]:
        """Its rows with the variant of each."""
        return [(row, variant) for row in self.rows for variant in self.variants if row.only in (None, variant)]

    def orders(self) -> list[tuple[Row, Row]]:
        """(worse, better) of each two rows whose order the paper has, by their first figures."""
        if self.best:
            best = next(row for row in self.rows if row.name == self.best)
            return [(row, best) for row in self.rows if row is not best]
        told = [row for row in self.rows if row.published or row.validation]
        on_test = all(row.published for row in told)
        figure = {
            row: float(next(iter((row.published if on_test else row.validation).values())).split("/")[0])
            for row in told
        }
        return [(worse, better) for better in told for worse in told if figure[worse] < figure[better]]


@dataclass(frozen=True, slots=True)
class Scale:
    """How much is trained, and how far a gallery grows.

    Attributes:
        retriever, fine, points: settings that differ from those in configs/, as `load_settings` takes them.
        growth_radii_m: of figure 5.
    """

    retriever: tuple[str, ...]
    fine: tuple[str, ...]
    growth_radii_m: tuple[float, ...]
    points: tuple[str, ...] = ()


_ALL = ("training.batch_size=64", "training.wording=published")
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


def made_of(run: Run, variant: str) -> Run:
    """A run of a variant; a run that says its inputs itself stays as it is."""
    return run if "inputs" in dict(run.changes) else run.changed(VARIANTS[variant])


def pairs_of(experiments: tuple[Experiment, ...]) -> tuple[tuple[Run, Run], ...]:
    """(retriever, fine stage) of each row of localization, each once."""
    found = [
        (made_of(row.run, variant), made_of(row.fine, variant))
        for experiment in experiments
        for row, variant in experiment.made()
        if row.fine is not None
    ]
    return tuple(dict.fromkeys(found))


def runs_of(experiments: tuple[Experiment, ...], every_seed: bool) -> tuple[Run, ...]:
    """The trainings that experiments need, each once, methods first; those of the first seed also make the figures."""
    wanted = [experiment for experiment in experiments if experiment.every_seed or not every_seed]
    runs = [made_of(row.run, variant) for experiment in wanted for row, variant in experiment.made()]
    fine = [stage for _, stage in pairs_of(tuple(wanted))]
    return tuple(dict.fromkeys([*runs, *fine]))
