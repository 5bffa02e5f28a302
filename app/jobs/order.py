"""An evaluation as it is asked for, in a request or in a file, and the work itself; HTTP and command line share it."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from app.http.bodies import check_json
from app.http.errors import Problem, field_name
from app.http.schemas.evaluate_requests import EvaluateQuery, EvaluateRequest
from app.settings import Settings
from index.answering.query import DEFAULT_REFINE, Refine
from index.build.artifact import open_version
from models.citymap.frame import Frame
from models.citymap.types import Progress
from models.errors import DataError

if TYPE_CHECKING:  # torch takes seconds, and the service itself does without SciPy and Numba too
    from index.answering.posterior_localizer import PosteriorLocalizer
    from index.answering.ranking import Ranker
    from index.answering.result import CellLocalizer
    from index.answering.vector_localizer import VectorLocalizer
    from models.citymap.queries import Queries
    from models.paper.retriever import Retriever
    from models.sources.source import Source

MAP_SUFFIXES = (".osm.pbf", ".osm")
WEIGHTS_DIRS = ("weights_dir", "fine_weights_dir", "posterior_weights_dir")  # of Settings and of Evaluation


class Evaluation(BaseModel):
    """What to ask of what: a data set, or queries of one's own of an index.

    Attributes:
        weights_dir: the model; None for the weights that ship with the package.
        grow_m: radii of a growing gallery.
        refine: what finds positions inside the retrieved cells.
        fine_weights_dir, posterior_weights_dir: its model, as weights_dir.
        data, split: as `models.sources.source.open_sources`; None for queries of one's own.
        index_dir: an index directory or a version of it, which queries of one's own are asked of.
        descriptions, positions_m: what was said, and where, map frame.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    weights_dir: Path | None
    grow_m: list[float] = []
    refine: Refine = DEFAULT_REFINE
    fine_weights_dir: Path | None = None
    posterior_weights_dir: Path | None = None
    data: Path | None = None
    split: str | None = None
    index_dir: Path | None = None
    descriptions: list[str] = []
    positions_m: list[tuple[float, float]] = []

    def run(self, report_dir: Path | None, progress: Progress) -> dict[str, Any]:
        """Do the work.

        Args:
            report_dir: as `index.evaluation.evaluation.evaluate`, which gives the report.
            progress: called as the work goes on.

        Raises:
            HereaboutsError: the data, the index or the model cannot be used.
        """
        from index.answering.localizer import Localizer  # noqa: PLC0415
        from index.evaluation.evaluation import evaluate  # noqa: PLC0415  # brings torch, which takes seconds
        from index.evaluation.localizers import with_raw_texts  # noqa: PLC0415
        from models.citymap.queries import Queries  # noqa: PLC0415

        if self.data is not None:
            source, queries = self._open(progress)
            return evaluate(source.data, queries, self._localizer(source, progress), report_dir, self.grow_m, progress)
        assert self.index_dir is not None
        progress("open index", 0, 0)
        dirs = self.weights_dir, self.fine_weights_dir, self.posterior_weights_dir
        localizer = Localizer.open(self.index_dir, *dirs)
        data = localizer.map_data()
        sentences = [(description,) for description in self.descriptions]
        queries = Queries.from_text(sentences, np.array(self.positions_m), data.cells)
        measured: CellLocalizer = localizer.posterior
        if self.refine != "posterior":
            measured = with_raw_texts(localizer.vector_localizer(self.refine))
        return evaluate(data, queries, measured, report_dir, self.grow_m, progress)

    def _open(self, progress: Progress) -> "tuple[Source, Queries]":
        from models.sources.source import open_source  # noqa: PLC0415

        assert self.data is not None
        source = open_source(self.data, self.split, progress)
        progress("describe positions", 0, 0)
        return source, source.queries()

    def _localizer(self, source: "Source", progress: Progress) -> "CellLocalizer":
        return self._posterior(source, progress) if self.refine == "posterior" else self._vectors(source, progress)

    def _posterior(self, source: "Source", progress: Progress) -> "PosteriorLocalizer":
        """The hint posterior of a data set."""
        from index.evaluation.localizers import posterior_of_map  # noqa: PLC0415
        from models.paper.checkpoint import load_retriever  # noqa: PLC0415
        from models.posterior.model import load_posterior  # noqa: PLC0415
        from models.posterior.neighbours.neighbour_index import surroundings_of  # noqa: PLC0415

        ranker = self._ranker(source, load_retriever(self.weights_dir).global_only(), progress)
        surroundings = surroundings_of(source.geometry(), source.data.cells, progress)
        model = load_posterior(self.posterior_weights_dir)
        return posterior_of_map(model, source.data, ranker, surroundings, source.gazetteer())

    def _vectors(self, source: "Source", progress: Progress) -> "VectorLocalizer":
        """Vector search of a data set: raw text, all levels."""
        from index.evaluation.localizers import vectors_of_map  # noqa: PLC0415
        from models.paper.checkpoint import load_retriever  # noqa: PLC0415
        from models.paper.fine.checkpoint import load_refiner  # noqa: PLC0415

        refiner = None
        if self.refine == "matching" or self.refine == "regressor":  # noqa: PLR1714, which mypy does not see through
            refiner = load_refiner(self.refine, self.fine_weights_dir)
        ranker = self._ranker(source, load_retriever(self.weights_dir), progress)
        return vectors_of_map(source.data, ranker, refiner)

    @staticmethod
    def _ranker(source: "Source", retriever: "Retriever", progress: Progress) -> "Ranker":
        from index.answering.ranking import Ranker  # noqa: PLC0415

        progress("encode cells", 0, 0)
        return Ranker.from_cells(retriever, source.data.cells, source.data.gallery.labels)

    def run_robustness(self, report_dir: Path | None, progress: Progress) -> dict[str, Any]:
        """Retriever and posterior side by side under every trial of `robustness`, and where candidates come from.

        Args:
            report_dir: where robustness.json and robustness.md go; None to write nothing.
            progress: called as the work goes on.

        Raises:
            HereaboutsError: as `run`; or there is text alone, whose hints nobody knows.
        """
        from index.evaluation.report import as_markdown  # noqa: PLC0415  # brings torch, which takes seconds
        from index.evaluation.robustness import robustness, robustness_tables, sample_queries  # noqa: PLC0415

        if self.data is None:
            raise DataError(
                "--robustness needs a data set or a map: nobody knows what the hints of one's own text mean"
            )
        source, queries = self._open(progress)
        vectors = self.model_copy(update={"refine": "none"})._vectors(source, progress)
        posterior = self._posterior(source, progress)
        found: dict[str, Any] = {
            "data": source.data.name,
            "split": source.data.split,
            "queries": len(sample_queries(queries)),
            "cells": len(source.data.cells),
            **robustness(source.data, queries, vectors, posterior, progress),
        }
        if report_dir:
            report_dir.mkdir(parents=True, exist_ok=True)
            (report_dir / "robustness.json").write_text(json.dumps(found, indent=1) + "\n")
            tables = "\n\n".join(as_markdown(table) for table in robustness_tables(found))
            (report_dir / "robustness.md").write_text(tables + "\n")
        return found

    def public(self, message: str) -> str:
        """A message without the directories of the machine."""
        weights = self.weights_dir, self.fine_weights_dir, self.posterior_weights_dir
        for path in (self.data, self.index_dir, *weights):
            message = message.replace(str(path), path.name) if path else message
        return message


def to_evaluation(asked: EvaluateRequest, settings: Settings, index_dir: Path, frame: Frame) -> Evaluation:
    """A request as the work takes it.

    Args:
        asked: a request that passed its model.
        settings: the model, and where data sets are.
        index_dir: what queries of one's own are asked of.
        frame: of the index's map.

    Raises:
        Problem: no such data set, or a query that cannot be asked of this map; the field is named.
    """
    weights = {name: getattr(settings, name) for name in WEIGHTS_DIRS}
    common: dict[str, Any] = {name: path and path.absolute() for name, path in weights.items()}
    common |= {"grow_m": asked.grow or [], "refine": asked.refine}
    if asked.data is not None:
        return Evaluation(**common, data=find_data(settings.data_dir, asked.data).absolute(), split=asked.split)
    queries = asked.queries or []
    return Evaluation(
        **common,
        index_dir=index_dir.absolute(),
        descriptions=[query.text() for query in queries],
        positions_m=_positions_m(queries, frame) if asked.crs == "wgs84" else [query.position for query in queries],
    )


def read_evaluation(path: Path, settings: Settings, split: str | None, grow_m: list[float]) -> Evaluation:
    """An evaluation from a file with the body of an inline `POST /evaluate`, asked of settings.index_dir.

    Args:
        path: of the file.
        settings: the model, the index.
        split: None; such a file has none.
        grow_m: radii in place of those in the file, if any.

    Raises:
        DataError: the file cannot be read, or is no such body; the message names the field.
        IndexUnusable: there is no index to ask.
    """
    if split is not None:
        raise DataError(f"{path}: queries of one's own have no split; leave --split out")
    try:
        body = path.read_bytes()
        check_json(body)
        asked = EvaluateRequest.model_validate(json.loads(body))
        if asked.data is not None:
            raise DataError(f"{path}: data: names a data set of a service; give its path to --data")
        frame = Frame(**open_version(settings.index_dir)[1].frame.model_dump())
        found = to_evaluation(asked, settings, settings.index_dir, frame)
        return found.model_copy(update={"grow_m": grow_m or found.grow_m})
    except OSError as error:
        raise DataError(f"{path}: cannot be read ({error.strerror})") from None
    except ValidationError as error:
        first = error.errors()[0]
        field = field_name(("file", *first["loc"]), first.get("ctx", {}))
        raise DataError(f"{path}: {field}: {first['msg']}") from None
    except Problem as problem:
        raise DataError(f"{path}: {problem.detail}") from None


def data_sets(data_dir: Path | None) -> list[Path]:
    """What an operator offers by name: the folders and OpenStreetMap files of a directory."""
    if data_dir is None or not data_dir.is_dir():
        return []
    entries = sorted(path for path in data_dir.iterdir() if not path.name.startswith("."))
    return [path for path in entries if path.is_dir() or path.name.endswith(MAP_SUFFIXES)]


def find_data(data_dir: Path | None, name: str) -> Path:
    """A data set by its name, with or without the suffix; it is compared with what there is, never used as a path.

    Raises:
        Problem: there is none of that name.
    """
    offered = {path.name: path for path in data_sets(data_dir)}
    for known in (name, *(name + suffix for suffix in MAP_SUFFIXES)):
        if known in offered:
            return offered[known]
    raise Problem.of_field("data", "is no data set of this service; /info lists those there are")


def _positions_m(queries: Sequence[EvaluateQuery], frame: Frame) -> list[tuple[float, float]]:
    """[Q] positions given as (lon, lat), in the map's metres."""
    if not frame.is_georeferenced:
        raise Problem.of_field("crs", "this map has no georeference; give positions in metres, with crs map")
    lon, lat = np.array([query.position for query in queries]).T
    wrong = np.flatnonzero((np.abs(lon) > 180) | (np.abs(lat) > 90))
    if len(wrong):
        advice = "is not [longitude -180..180, latitude -90..90]; or did you mean crs map?"
        raise Problem.of_field(f"queries[{wrong[0]}].position", advice)
    positions_m = frame.from_wgs84(lat, lon)
    wrong = np.flatnonzero(~np.isfinite(positions_m).all(axis=1))
    if len(wrong):
        advice = "is too far from the map; give [longitude, latitude] near it"
        raise Problem.of_field(f"queries[{wrong[0]}].position", advice)
    return [(x, y) for x, y in positions_m.tolist()]
