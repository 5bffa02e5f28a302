"""The training runs behind the tables and curves of the reproduction."""

from dataclasses import dataclass, field
from typing import Any, Literal

from models.paper.instance_encoder import PAPER_INPUTS

Changes = tuple[tuple[str, Any], ...]
Metric = Literal["retrieval", "localization"]
# Instance inputs by name, as changes of a configuration. The paper trains a larger point encoder with the rest.
OUR_INPUTS, PAPERS_INPUTS = "our inputs", "the paper's inputs, smaller and frozen"
VARIANTS: dict[str, Changes] = {OUR_INPUTS: (), PAPERS_INPUTS: (("inputs", PAPER_INPUTS),)}
POINTS = "points"  # the method name of the point encoder


@dataclass(frozen=True, slots=True)
class TrainingRun:
    """One training run."""

    method: str  # key of METHODS or FINE_METHODS, or POINTS
    # settings that differ from the defaults, sorted by name: fields of the model, or "training." and a field
    changes: Changes = ()

    def with_changes(self, changes: Changes) -> "TrainingRun":
        """Return the run with further changes."""
        return TrainingRun(self.method, tuple(sorted((dict(self.changes) | dict(changes)).items())))

    @property
    def name(self) -> str:
        """Name of the run's directory: the method and the changes."""
        parts = [f"{key}={'+'.join(value) if isinstance(value, tuple) else value}" for key, value in self.changes]
        return "-".join([self.method, *parts])

    @property
    def settings(self) -> tuple[str, ...]:
        """The changes in the form that `load_settings` takes."""
        return tuple(
            f"{key if '.' in key else f'model.{key}'}={','.join(value) if isinstance(value, tuple) else value}"
            for key, value in self.changes
        )

    @property
    def needs_points(self) -> bool:
        """Whether the run needs the point encoder."""
        return "points" in dict(self.changes).get("inputs", ())

    @property
    def point_run(self) -> "TrainingRun":
        """The training of the point encoder that the run needs."""
        return TrainingRun(POINTS, tuple(change for change in self.changes if change[0] == "point_encoder"))


@dataclass(frozen=True, slots=True, eq=False)
class TableRow:
    """A row of a table, or a point of a curve."""

    name: str
    run: TrainingRun
    published: dict[str, str] = field(default_factory=dict)  # figures by column, on the test split
    validation: dict[str, str] = field(default_factory=dict)  # the same on the validation split
    fine: TrainingRun | None = None  # the fine stage, in localization tables
    at_center: bool = False  # whether positions are the centres of the cells instead of those of the fine stage
    rerank: bool = False  # whether the first cells are ranked again by partial transport
    only: str | None = None  # the one variant to compute; None for all variants of the table


@dataclass(frozen=True, slots=True)
class Experiment:
    """A table or a curve."""

    key: str  # "1" to "4", "4a", "4b", or a word for an experiment that is not in the paper
    title: str
    rows: tuple[TableRow, ...]  # of a curve: its points in order
    metric: Metric = "retrieval"
    variants: tuple[str, ...] = tuple(VARIANTS)  # the VARIANTS that are computed for each row
    seeds: int | None = None  # how many of the seeds to run, the first ones; None for all of them
    note: str = ""
    best: str | None = None  # name of the row that is best in the paper, for curves without published figures
    long: bool = False  # whether it takes hours, so that it is run only when asked for by its key

    def row_variants(self) -> list[tuple[TableRow, str]]:
        """Return each row with each of its variants."""
        return [(row, variant) for row in self.rows for variant in self.variants if row.only in (None, variant)]

    def published_orders(self) -> list[tuple[TableRow, TableRow]]:
        """Return the pairs (worse, better) of rows whose order the paper publishes, by their first figures."""
        if self.best:
            best = next(row for row in self.rows if row.name == self.best)
            return [(row, best) for row in self.rows if row is not best]
        published = [row for row in self.rows if row.published or row.validation]
        on_test = all(row.published for row in published)
        figure = {
            row: float(next(iter((row.published if on_test else row.validation).values())).split("/")[0])
            for row in published
        }
        return [(worse, better) for better in published for worse in published if figure[worse] < figure[better]]


@dataclass(frozen=True, slots=True)
class TrainingScale:
    """The extent of a reproduction."""

    retriever: tuple[str, ...]  # changes of the settings in configs/, in the form that `load_settings` takes
    fine: tuple[str, ...]
    growth_radii_m: tuple[float, ...]  # radii of the growing gallery of figure 5
    points: tuple[str, ...] = ()


_ALL = ("training.batch_size=64", "training.wording=published")
_RETRIEVER = (*_ALL, "training.cluster=1")
SCALES = {
    "demo": TrainingScale(
        (*_RETRIEVER, "model.width=128", "training.steps=400", "training.validate_every=100"),
        (*_ALL, "training.steps=400", "training.validate_every=100"),
        (80.0, 110.0, 140.0, 200.0),
    ),
    # 32 epochs of KITTI360Pose's 28,807 training poses.
    "full": TrainingScale(
        (*_RETRIEVER, "training.steps=14400", "training.validate_every=450"),
        (*_ALL, "training.steps=14400", "training.validate_every=450"),
        (200.0, 300.0, 400.0, 500.0),
    ),
}


def apply_variant(run: TrainingRun, variant: str) -> TrainingRun:
    """Return the run with the inputs of a variant; a run with inputs of its own is unchanged."""
    return run if "inputs" in dict(run.changes) else run.with_changes(VARIANTS[variant])


def _selected(experiments: tuple[Experiment, ...], nth_seed: int) -> list[Experiment]:
    return [experiment for experiment in experiments if experiment.seeds is None or nth_seed < experiment.seeds]


def fine_pairs(experiments: tuple[Experiment, ...], nth_seed: int = 0) -> tuple[tuple[TrainingRun, TrainingRun], ...]:
    """Return the distinct pairs (retriever, fine stage) of the localization rows, as `required_runs`."""
    pairs = [
        (apply_variant(row.run, variant), apply_variant(row.fine, variant))
        for experiment in _selected(experiments, nth_seed)
        for row, variant in experiment.row_variants()
        if row.fine is not None
    ]
    return tuple(dict.fromkeys(pairs))


def reranked_pairs(
    experiments: tuple[Experiment, ...], nth_seed: int = 0
) -> tuple[tuple[TrainingRun, TrainingRun | None], ...]:
    """Return the distinct pairs (retriever, fine stage or None) of the re-ranked rows, as `required_runs`."""
    pairs = [
        (apply_variant(row.run, variant), row.fine and apply_variant(row.fine, variant))
        for experiment in _selected(experiments, nth_seed)
        for row, variant in experiment.row_variants()
        if row.rerank
    ]
    return tuple(dict.fromkeys(pairs))


def required_runs(experiments: tuple[Experiment, ...], nth_seed: int = 0) -> tuple[TrainingRun, ...]:
    """Return the distinct training runs of experiments for the n-th of the seeds, counted from 0."""
    selected = _selected(experiments, nth_seed)
    runs = [apply_variant(row.run, variant) for experiment in selected for row, variant in experiment.row_variants()]
    fine = [stage for _, stage in fine_pairs(experiments, nth_seed)]
    return tuple(dict.fromkeys([*runs, *fine]))
