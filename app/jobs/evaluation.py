"""An evaluation: built from a request, a file or command-line options, and run by a job or the command line."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from app.http.bodies import check_json
from app.http.errors import Problem, field_message, field_name
from app.http.schemas.requests import EvaluateQuery, EvaluateRequest
from app.settings import Settings
from index.answering.query import DEFAULT_REFINE, Refine, Rerank
from index.build.artifact import open_version
from models.citymap.frame import Frame
from models.citymap.types import Progress
from models.errors import DataError

if TYPE_CHECKING:  # importing torch takes seconds, and the service process needs no SciPy or Numba
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
    """An evaluation of a data set, or of given queries on an index; None stands for the shipped weights."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    weights_dir: Path | None
    grow_m: list[float] = []
    refine: Refine = DEFAULT_REFINE
    rerank: Rerank | None = None
    fine_weights_dir: Path | None = None
    posterior_weights_dir: Path | None = None
    data: Path | None = None
    split: str | None = None
    index_dir: Path | None = None
    descriptions: list[str] = []
    positions_m: list[tuple[float, float]] = []

    def run(self, report_dir: Path | None, progress: Progress) -> dict[str, Any]:
        """Run the evaluation, and return and write the report of `index.evaluation.evaluation.evaluate`."""
        from index.answering.localizer import Localizer  # noqa: PLC0415
        from index.evaluation.evaluation import evaluate  # noqa: PLC0415  # brings torch, which takes seconds
        from index.evaluation.localizers import map_of_index, with_raw_texts  # noqa: PLC0415
        from models.citymap.queries import Queries  # noqa: PLC0415

        if self.data is not None:
            source, queries = self._open(progress)
            build = self._posterior if self.refine == "posterior" else self._vectors
            return evaluate(source.data, queries, build(source, progress), report_dir, self.grow_m, progress)
        assert self.index_dir is not None
        progress("open index", 0, 0)
        localizer = Localizer.open(self.index_dir, *(getattr(self, name) for name in WEIGHTS_DIRS))
        data = map_of_index(localizer)
        sentences = [(description,) for description in self.descriptions]
        queries = Queries.from_text(sentences, np.array(self.positions_m), data.cells)
        evaluated: CellLocalizer = localizer.posterior
        if self.refine != "posterior":
            evaluated = with_raw_texts(localizer.vector_localizer(self.refine), data, self.rerank)
        return evaluate(data, queries, evaluated, report_dir, self.grow_m, progress)

    def _open(self, progress: Progress) -> "tuple[Source, Queries]":
        from models.sources.source import open_source  # noqa: PLC0415

        assert self.data is not None
        source = open_source(self.data, self.split, progress)
        progress("describe positions", 0, 0)
        return source, source.queries()

    def _posterior(self, source: "Source", progress: Progress) -> "PosteriorLocalizer":
        from index.evaluation.localizers import posterior_of_map  # noqa: PLC0415
        from models.paper.checkpoint import load_retriever  # noqa: PLC0415
        from models.posterior.model import load_posterior  # noqa: PLC0415
        from models.posterior.neighbours.neighbour_index import build_neighbour_index  # noqa: PLC0415

        ranker = self._ranker(source, load_retriever(self.weights_dir).global_only(), progress)
        surroundings = build_neighbour_index(source.geometry(), source.data.cells, progress)
        model = load_posterior(self.posterior_weights_dir)
        return posterior_of_map(model, source.data, ranker, surroundings, source.gazetteer())

    def _vectors(self, source: "Source", progress: Progress) -> "VectorLocalizer":
        """Build the vector localizer of a data set: raw text, all levels."""
        from index.evaluation.localizers import vectors_of_map  # noqa: PLC0415
        from models.paper.checkpoint import load_retriever  # noqa: PLC0415
        from models.paper.fine.checkpoint import load_refiner  # noqa: PLC0415

        refiner = None
        if self.refine == "matching" or self.refine == "regressor":  # noqa: PLR1714  # mypy cannot narrow `in`
            refiner = load_refiner(self.refine, self.fine_weights_dir)
        ranker = self._ranker(source, load_retriever(self.weights_dir), progress)
        return vectors_of_map(source.data, ranker, refiner, self.rerank)

    @staticmethod
    def _ranker(source: "Source", retriever: "Retriever", progress: Progress) -> "Ranker":
        from index.answering.ranking import Ranker  # noqa: PLC0415

        progress("encode cells", 0, 0)
        return Ranker.from_cells(retriever, source.data.cells, source.data.gallery.labels)

    def run_robustness(self, report_dir: Path | None, progress: Progress) -> dict[str, Any]:
        """Compare retriever and posterior in every trial of `index.evaluation.robustness`, and write both reports."""
        from index.evaluation.report import as_markdown  # noqa: PLC0415  # brings torch, which takes seconds
        from index.evaluation.robustness import robustness, robustness_tables, sample_queries  # noqa: PLC0415

        if self.data is None:
            raise DataError("--robustness needs a data set or a map: the true hints of other texts are unknown")
        source, queries = self._open(progress)
        vectors = self.model_copy(update={"refine": "none"})._vectors(source, progress)
        posterior = self._posterior(source, progress)
        report: dict[str, Any] = {
            "data": source.data.name,
            "split": source.data.split,
            "queries": len(sample_queries(queries)),
            "cells": len(source.data.cells),
            **robustness(source.data, queries, vectors, posterior, progress),
        }
        if report_dir:
            report_dir.mkdir(parents=True, exist_ok=True)
            (report_dir / "robustness.json").write_text(json.dumps(report, indent=1) + "\n")
            tables = "\n\n".join(as_markdown(table) for table in robustness_tables(report))
            (report_dir / "robustness.md").write_text(tables + "\n")
        return report

    def hide_paths(self, message: str) -> str:
        """Return a message with paths shortened to their last component."""
        for path in (self.data, self.index_dir, *(getattr(self, name) for name in WEIGHTS_DIRS)):
            message = message.replace(str(path), path.name) if path else message
        return message


def build_evaluation(body: EvaluateRequest, settings: Settings, index_dir: Path, frame: Frame) -> Evaluation:
    """Build an evaluation from a request; 422 for an unknown data set or a position too far from the map."""
    weights = {name: getattr(settings, name) for name in WEIGHTS_DIRS}
    common: dict[str, Any] = {name: path and path.absolute() for name, path in weights.items()}
    common |= {"grow_m": body.grow or [], "refine": body.refine}
    if body.data is not None:
        return Evaluation(**common, data=find_data(settings.data_dir, body.data).absolute(), split=body.split)
    queries = body.queries or []
    return Evaluation(
        **common,
        index_dir=index_dir.absolute(),
        descriptions=[query.text() for query in queries],
        positions_m=_positions_m(queries, frame) if body.crs == "wgs84" else [query.position for query in queries],
    )


def read_evaluation(path: Path, settings: Settings, split: str | None, grow_m: list[float]) -> Evaluation:
    """Read an evaluation from a file with the body of a `POST /evaluate`; `grow_m` replaces its radii."""
    if split is not None:
        raise DataError(f"{path}: a file of queries has no splits; leave out --split")
    try:
        content = path.read_bytes()
        check_json(content)
        body = EvaluateRequest.model_validate(json.loads(content))
        if body.data is not None:
            raise DataError(f"{path}: data: names a data set of a service; pass its path as --data instead")
        frame = Frame(**open_version(settings.index_dir)[1].frame.model_dump())
        evaluation = build_evaluation(body, settings, settings.index_dir, frame)
        return evaluation.model_copy(update={"grow_m": grow_m or evaluation.grow_m})
    except OSError as error:
        raise DataError(f"{path}: cannot be read ({error.strerror})") from None
    except ValidationError as error:
        first = error.errors()[0]
        field = field_name(("file", *first["loc"]), first.get("ctx", {}))
        raise DataError(f"{path}: {field}: {field_message(first)}") from None
    except Problem as problem:
        raise DataError(f"{path}: {problem.detail}") from None


def list_data_sets(data_dir: Path | None) -> list[Path]:
    """Return the data sets in a directory: its folders and OpenStreetMap files."""
    if data_dir is None or not data_dir.is_dir():
        return []
    entries = sorted(path for path in data_dir.iterdir() if not path.name.startswith("."))
    return [path for path in entries if path.is_dir() or path.name.endswith(MAP_SUFFIXES)]


def find_data(data_dir: Path | None, name: str) -> Path:
    """Return a data set by name, with or without its suffix. The name is only compared, never used as a path."""
    paths = {path.name: path for path in list_data_sets(data_dir)}
    for known in (name, *(name + suffix for suffix in MAP_SUFFIXES)):
        if known in paths:
            return paths[known]
    raise Problem.for_field("data", "is not a data set of this service; GET /info lists them")


def _positions_m(queries: Sequence[EvaluateQuery], frame: Frame) -> list[tuple[float, float]]:
    if not frame.is_georeferenced:
        raise Problem.for_field("crs", "this map has no georeference; send positions in metres with crs map")
    lon, lat = np.array([query.position for query in queries]).T
    invalid = np.flatnonzero((np.abs(lon) > 180) | (np.abs(lat) > 90))
    if len(invalid):
        advice = "must be [longitude -180..180, latitude -90..90]; for metres, send crs map"
        raise Problem.for_field(f"queries[{invalid[0]}].position", advice)
    positions_m = frame.from_wgs84(lat, lon)
    invalid = np.flatnonzero(~np.isfinite(positions_m).all(axis=1))
    if len(invalid):
        advice = "is too far from the map; send [longitude, latitude] near it"
        raise Problem.for_field(f"queries[{invalid[0]}].position", advice)
    return [(x, y) for x, y in positions_m.tolist()]
