"""The report of `reproduce`: own and published figures in Markdown, with plots."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from index.evaluation.report import Table, as_markdown
from index.evaluation.reproduction.figures import draw_figure_4, draw_figure_5
from index.evaluation.reproduction.jobs import AT_CENTER, MEASURED_SPLITS, TEST, VALIDATION
from models.training.experiments import VARIANTS, Experiment, TableRow, apply_variant
from models.training.metrics import LOCALIZATION_KS, RETRIEVAL_KS
from models.training.paper_tables import EXPERIMENTS, GROWTH, MNCL

RECALL_NAMES = tuple(f"R@{k}" for k in RETRIEVAL_KS)
PUBLISHED, VALIDATED = " (paper)", ", validation"
COSTS = ("best_step", "steps"), ("seconds_to_best", "seconds")
ORDERS = (
    "By recall@1, or the share of first positions within 5 m, on the test scenes. Of table 2 the paper's order is that "
    "of its validation split, where it has RET. Undecided: the difference is within the sampling error (95 %) over "
    "seeds and queries, or both rows are at chance."
)
FIGURE_4_AXES = {"4a": "layers m", "4b": "exponent a"}
GROWTH_NOTE = (
    "The same queries in a gallery of the cells within a radius. A scene's centre is the query position nearest to the "
    "mean of all of them; the paper's is the centre of the trajectory, which the data do not have. All test scenes: "
    "each round its own centre, in one gallery."
)
Results = dict[str, Any]
DEVIATES_OF_95_PERCENT = 1.96  # standard errors on either side of an estimate
Numbers = np.ndarray[Any, np.dtype[np.float64]]


def write_reproduction(directory: Path, results: Results, name: str, figure_3: Path | None = None) -> None:
    """Write results.json, report.md and the figures; `figure_3` is the picture of a job, if there is one."""
    directory.mkdir(parents=True, exist_ok=True)
    for n in (3, 4, 5):
        (directory / f"figure{n}.png").unlink(missing_ok=True)  # of an earlier report
    if figure_3:
        (directory / "figure3.png").write_bytes(figure_3.read_bytes())
    results = results | {"figure_3": figure_3 is not None}
    (directory / "results.json").write_text(json.dumps(results, indent=1) + "\n")
    (directory / "report.md").write_text(markdown(results, name))
    curves = [experiment for experiment in chosen_experiments(results) if experiment.key in FIGURE_4_AXES]
    if curves:
        recalls = [[_recalls(row, variant, results) for row, variant in e.row_variants()] for e in curves]
        draw_figure_4(directory / "figure4.png", [FIGURE_4_AXES[e.key] for e in curves], recalls)
    if grown := _growth_curves(results):
        draw_figure_5(directory / "figure5.png", {
            title: ([row["cells"] for row in of_form[0][2][0]], [
                (name, np.array([[row["R@1"] for row in rows] for rows in by_seed])) for name, _, by_seed in of_form
            ]) for title, of_form in grown.items()
        })  # fmt: skip


def chosen_experiments(results: Results) -> list[Experiment]:
    """Return the chosen tables and figures."""
    return [EXPERIMENTS[key] for key in results["experiments"]]


def markdown(results: Results, name: str) -> str:
    """Return the report as a page."""
    parts = [f"# The paper's tables and figures on {name}", *_head(results)]
    last_curve = next((e for e in reversed(chosen_experiments(results)) if e.key in FIGURE_4_AXES), None)
    for experiment in chosen_experiments(results):
        parts += [f"## {experiment.title}", *([experiment.note] if experiment.note else [])]
        parts.append(as_markdown(_table(experiment, results)))
        if experiment.key in FIGURE_4_AXES and experiment is last_curve:
            parts.append("Dashed: validation. ![figure 4](figure4.png)")
    if results["figure_3"]:
        parts += [
            "## Figure 3: queries and what is retrieved",
            "The first three cells of Text2Loc and of MNCL for queries drawn at random; our inputs, first seed. A cell "
            "is positive (green) if it contains the true position, as in the paper. Numbers are the error of the "
            "position that the papers' head predicts in the cell. ![figure 3](figure3.png)",
        ]
    if grown := _growth_curves(results):
        parts += ["## Figure 5: a growing gallery", GROWTH_NOTE]
        parts += [as_markdown(_growth_table(*form)) for form in grown.items()] + ["![figure 5](figure5.png)"]
    if (orders := _orders_table(results))[1]:
        parts += ["## Does the order hold?", ORDERS, as_markdown(orders)]
    if rankings := _ranking_rows(results):
        parts += ["## Ranking of MNCL, validation scenes", as_markdown((("", *RECALL_NAMES), rankings))]
    if fine := _fine_rows(results):
        head = "", "5 m", "10 m", "5 m, neighbour cell", "10 m, neighbour cell"
        parts += ["## Fine stages, true cell given, validation scenes", as_markdown((head, fine))]
    parts += ["## What training costs", as_markdown(_cost_table(results))]
    return "\n\n".join(parts) + "\n"


def _head(results: Results) -> list[str]:
    data, seeds, runs = results["data"], results["seeds"], results["runs"]
    exact = ", ".join(f"R@{k} {value:.3f}" for k, value in data["exact_matching"].items())
    spread = "mean ± standard deviation over them; figure 4 shows the first" if len(seeds) > 1 else "one run each"
    hours = sum(result["training"]["seconds"] for results in runs.values() for result in results) / 3600
    return [
        f"Test scenes: {data['cells']} cells, {data['queries']} queries. Exact matching of the true "
        f"hints: {exact}. Seeds {', '.join(map(str, seeds))}; {spread}. {hours:.1f} hours of training in "
        "all.",
        as_markdown(_settings_table(results)),
        "Our inputs: an instance's label, mean colour, centre, point closest to the cell's centre, size and number of "
        "points. The paper's inputs: its points by a frozen PointNet++, mean colour, centre and number of points; no "
        "label. Columns marked (paper) are published figures on KITTI360Pose, with the paper's inputs and T5: other "
        "data and perhaps another text encoder, so only their order is comparable.",
    ]


def _settings_table(results: Results) -> Table:
    rows: dict[tuple[str, ...], list[str]] = {}
    for name, by_seed in results["runs"].items():
        settings = by_seed[0]["settings"]
        steps = f"{settings['steps']}, best of validation" + (
            f", patience {settings['patience']}" if settings["patience"] else ""
        )
        rate = f"{settings['learning_rate']:g}, {settings['schedule']}"
        key = (
            steps,
            str(settings["batch_size"]),
            str(settings.get("width", "-")),
            rate,
            settings.get("text_encoder", "-"),
            settings["wording"],
        )
        rows.setdefault(key, []).append(name.split("-")[0])
    head = "trained", "steps", "batch", "width", "learning rate", "text encoder", "wording"
    return head, [(", ".join(dict.fromkeys(names)), *key) for key, names in rows.items()]


def _table(experiment: Experiment, results: Results) -> Table:
    metrics = RECALL_NAMES if experiment.metric == "retrieval" else tuple(f"k={k}" for k in LOCALIZATION_KS)
    validated = metrics if experiment.metric == "retrieval" else metrics[:1]
    published = [m for m in metrics if any(m in row.published for row in experiment.rows)]
    published_validated = [m for m in validated if any(m in row.validation for row in experiment.rows)]
    rows = []
    for row, variant in experiment.row_variants():
        test, validation = _recalls(row, variant, results)
        name = f"{row.name}, {variant}" if len(experiment.variants) > 1 else row.name
        rows.append((
            name, *_columns(test, experiment), *_columns(validation, experiment)[: len(validated)],
            *(row.published.get(m, "-") for m in published), *(row.validation.get(m, "-") for m in published_validated),
        ))  # fmt: skip
    head = ("", *metrics, *(m + VALIDATED for m in validated), *(m + PUBLISHED for m in published))
    return (*head, *(m + VALIDATED + PUBLISHED for m in published_validated)), rows


def _recalls(row: TableRow, variant: str, results: Results) -> tuple[Numbers, Numbers]:
    """Return recalls [seeds, metrics] on test and validation scenes; for localization [seeds, k, metres]."""
    by_seed = results["runs"][apply_variant(row.run, variant).name]
    stage = apply_variant(row.fine, variant).name if row.fine else ""
    if row.rerank:
        metric = "localization" if row.fine else "retrieval"
        reranked = [result["reranked"][stage] for result in by_seed if stage in result.get("reranked", {})]
        by_seed = [{split: by_split[split][metric] for split in MEASURED_SPLITS} for by_split in reranked]
    elif row.fine:
        by_seed = [result["localization"][stage] for result in by_seed if stage in result["localization"]]
        by_seed = [by[AT_CENTER] for by in by_seed] if row.at_center else by_seed
    else:
        by_seed = [{TEST: result["retrieval"], VALIDATION: result["validation_retrieval"]} for result in by_seed]
    test, validation = (
        [[list(by.values()) if row.fine else by for by in result[split].values()] for result in by_seed]
        for split in MEASURED_SPLITS
    )
    return np.array(test), np.array(validation)


def _columns(recalls: Numbers, experiment: Experiment) -> list[str]:
    recalls = recalls[: experiment.seeds]
    if experiment.metric == "retrieval":
        return [_spread(column) for column in recalls.T]
    return ["/".join(_spread(recalls[:, k, metres]) for metres in range(3)) for k in range(recalls.shape[1])]


def _spread(values: Sequence[float] | Numbers) -> str:
    text = f"{np.mean(values):.3f}"
    return text if len(values) < 2 else f"{text} ± {np.std(values, ddof=1):.3f}"


def _orders_table(results: Results) -> Table:
    """Return the table of the paper's orders: all pairs of rows with different first figures."""
    rows: list[tuple[str, ...]] = []
    for experiment in chosen_experiments(results):
        place = experiment.title.split(":")[0]
        for variant in experiment.variants:
            for worse, better in experiment.published_orders():
                below, above = _first_figures(worse, better, variant, results)
                gain, verdict = above - below, order_verdict(below, above, results["data"])
                name = f"{better.name} above {worse.name}"
                rows.append((place, name, variant, verdict, f"{(gain > 0).sum()} of {len(gain)}", _spread(gain)))
    return ("", "the paper's order", "of", "does it hold", "seeds where it holds", "difference"), rows


def order_verdict(below: Numbers, above: Numbers, data: dict[str, Any]) -> str:
    """Return whether a recall is above another one, each for the same seeds: "yes", "no" or "undecided".

    Undecided are differences within 1.96 standard errors, and rows that are both at chance. The error has two parts:
    seeds differ, and all of them are measured on one sample of queries, so its binomial error does not average out.
    """
    queries, chance = data["queries"], 1 / data["cells"]
    gain, means = above - below, np.array([below.mean(), above.mean()])
    variance = float((means * (1 - means)).sum() / queries)
    if len(gain) > 1:
        variance += float(gain.var(ddof=1)) / len(gain)
    most_by_chance = chance + DEVIATES_OF_95_PERCENT * (chance * (1 - chance) / queries) ** 0.5
    if abs(gain.mean()) <= DEVIATES_OF_95_PERCENT * variance**0.5 or (means <= most_by_chance).all():
        return "undecided"
    return "yes" if gain.mean() > 0 else "no"


def _first_figures(worse: TableRow, better: TableRow, variant: str, results: Results) -> tuple[Numbers, Numbers]:
    """Return the first figure [seeds] of two rows: recall@1, or the share of first positions within 5 m."""
    first = [_recalls(row, variant, results)[0] for row in (worse, better)]
    seeds = min(len(recalls) for recalls in first)
    below, above = (recalls[:seeds].reshape(seeds, -1)[:, 0] for recalls in first)
    return below, above


# Name, published figures, and rows [seeds] of a curve of figure 5
GrowthCurve = tuple[str, str, list[list[dict[str, Any]]]]


def _growth_curves(results: Results) -> dict[str, list[GrowthCurve]]:
    """Return the curves of figure 5 that were made: of one scene, as in the paper, and of all test scenes."""
    curves: dict[str, list[GrowthCurve]] = {}
    for form in ("growth_of_scene", "growth"):
        for name, (run, published) in GROWTH.items():
            for variant in VARIANTS:
                by_seed = results["runs"].get(apply_variant(run, variant).name, [])
                if by_seed and all(form in result for result in by_seed):  # older results have the second form alone
                    rows = [result[form] for result in by_seed]
                    title = f"scene {rows[0][0]['scene']}" if "scene" in rows[0][0] else "all test scenes"
                    curves.setdefault(title, []).append((f"{name}, {variant}", published, rows))
    return curves


def _growth_table(form: str, grown: Sequence[GrowthCurve]) -> Table:
    rows: list[tuple[str, ...]] = []
    for name, published, by_seed in grown:
        recalls = np.mean([[row["R@1"] for row in rows_] for rows_ in by_seed], axis=0)
        loss = "/".join(f"{100 * x:+.1f}" for x in recalls[1:] / max(recalls[0], 1e-9) - 1) + " %"
        rows.append((name, *(f"{r:.3f}" for r in recalls), loss, published))
    first = grown[0][2][0]
    head = (f"{row['radius_m']:g} m, {row['cells']} cells" for row in first)
    return (
        f"R@1 of {form}, {first[0]['queries']} queries, within",
        *head,
        "against the first",
        "against the first" + PUBLISHED,
    ), rows


def _ranking_rows(results: Results) -> list[tuple[str, ...]]:
    rows = []
    for variant in VARIANTS:
        by_seed = [result["rankings"] for result in results["runs"].get(apply_variant(MNCL, variant).name, [])]
        rows += [
            (f"{name}, {variant}", *(_spread([result[name][str(k)] for result in by_seed]) for k in RETRIEVAL_KS))
            for name in (by_seed[0] if by_seed else ())
        ]
    return rows


def _fine_rows(results: Results) -> list[tuple[str, ...]]:
    names = ("within_5m", "within_10m", "neighbour_within_5m", "neighbour_within_10m")
    measured = [
        (name, [result["validation"] for result in by_seed])
        for name, by_seed in results["runs"].items()
        if "within_5m" in by_seed[0].get("validation", {})
    ]
    if not measured:
        return []
    center = measured[0][1][0]["cell_center"]
    rows = [("cell's centre", *(f"{center[name]:.3f}" for name in names))]
    return rows + [(name, *(_spread([f[key] for f in figures]) for key in names)) for name, figures in measured]


def _cost_table(results: Results) -> Table:
    rows: list[tuple[str, ...]] = []
    for name, by_seed in results["runs"].items():
        training = [result["training"] for result in by_seed]
        # The median over the seeds, because one may have shared the machine.
        typical = {key: float(np.median([facts[key] for facts in training])) for key in training[0]}
        size = f"{by_seed[0]['parameters'] / 1e6:.2f} M" if "parameters" in by_seed[0] else "-"
        cell = f"{by_seed[0]['bytes_a_cell']:.0f}" if "bytes_a_cell" in by_seed[0] else "-"
        steps, seconds = (f"{typical[best]:.0f} of {typical[total]:.0f}" for best, total in COSTS)
        speed, memory = f"{typical['descriptions_per_second']:.0f}", f"{typical['peak_memory_mb']:.0f} MB"
        rows.append((name, speed, steps, f"{seconds} s", memory, size, cell))
    return ("", "descriptions/s", "best step", "until then", "peak memory", "parameters", "bytes a cell"), rows
