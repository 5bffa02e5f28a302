"""The offline job: map -> cells -> vectors -> an index version on disk, in one process or in shards."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import NamedTuple

from index.build.artifact import check_store, open_version
from index.build.manifest import StoreName, check_model, fingerprint
from index.build.publish import Publisher, save_names
from index.build.shard import Shard
from index.build.shard_data import ShardData, explain_write_errors
from index.build.shard_store import Origin, ShardStore
from models.citymap.cells import CELLS_PER_BLOCK
from models.citymap.types import Progress
from models.errors import DataError, IndexUnusable
from models.paper.checkpoint import load_retriever
from models.paper.level_table import FILE as LEVELS_FILE
from models.paper.retriever import Retriever
from models.posterior.model import PosteriorModel, load_posterior
from models.posterior.neighbours.neighbour_index import build_neighbour_index
from models.posterior.neighbours.scan_index import ScanNeighbourIndex
from models.processes import forked
from models.sources.extras.layer import ExtraLayer
from models.sources.osm.extent import read_extent
from models.sources.osm.extract import Region, extracted_file
from models.sources.source import open_source
from models.spool import spool_directory, spooling_in


def no_progress(_stage: str, _done: int, _total: int) -> None:
    """Do nothing."""


class _LoadedModels(NamedTuple):
    retriever: Retriever
    posterior: PosteriorModel
    map_sha256: str


@dataclass(frozen=True, slots=True)
class IndexJob:
    """The indexing of one map: in one process (`build`), or in shards (`make_shard` for each, then `merge`).

    Both ways give the same bytes on the same kind of processor.
    """

    map_path: Path
    out_dir: Path  # the index directory; older versions in it are kept
    weights_dir: Path | None = None
    split: str | None = None
    keep_current: bool = False  # build nothing if the default version was built from this map by this model
    levels: bool = True  # also store the retriever's other levels, which every `refine` but the default ranks by
    store: StoreName = "faiss"  # where the vectors go: a file, or the Milvus server that HEREABOUTS_MILVUS_URI names
    within: Region | None = None  # the region of an OpenStreetMap file to index; None for all of it
    extras: tuple[ExtraLayer, ...] = ()  # a city's own data, which joins the map

    def build(self, report: Progress = no_progress) -> Path:
        """Build a version in this process and return its directory; after an error, older versions stay.

        Raise DataError if the map or the index directory cannot be used, WeightsError, or StoreUnavailable.
        """
        models = self._load_models(report)
        if current := self._current_version(models):
            return current
        with (
            self._working_directory(),
            spool_directory() as names_directory,
            self._map_file(report) as (path, extras),
            forked(partial(save_names, path, names_directory, extras)) as names,
        ):
            source = open_source(path, self.split, report, extras)
            surroundings = build_neighbour_index(source.geometry(), source.data.cells, report)
            rows = range(len(source.data.cells))
            encoder, likelihood = self._encoder(models), models.posterior.likelihood
            shard_data = ShardData.build(encoder, likelihood, source, surroundings, rows, report)
            return self._publisher(models).publish(source, [shard_data], surroundings, names, report)

    def make_shard(self, shard: Shard, report: Progress = no_progress) -> Path:
        """Make the data of a shard unless it exists, and return its directory; errors as `build`."""
        models = self._load_models(report)
        shards = self._shard_store(models)
        if shards.fault(shard) is None:
            return shards.path(shard)
        with explain_write_errors(self.out_dir):
            shards.check_writable()
        with self._working_directory(), self._map_file(report) as (path, extras):
            source = open_source(path, self.split, report, extras)
            count = len(source.data.cells)
            rows = shard.rows(count, CELLS_PER_BLOCK)
            surroundings = build_neighbour_index(source.geometry(), source.data.cells, report, rows)
            encoder, likelihood = self._encoder(models), models.posterior.likelihood
            shard_data = ShardData.build(encoder, likelihood, source, surroundings, rows, report)
            report("write part", 0, 0)
            with explain_write_errors(self.out_dir):
                shards.write(shard, shard_data, rows, count)
        return shards.path(shard)

    def merge(self, count: int, report: Progress = no_progress) -> Path:
        """Build a version from the data of `count` shards, and remove that data; errors as `build`.

        If data is missing, damaged, or of another map or model, raise IndexBroken and remove nothing.
        """
        models = self._load_models(report)
        shards = self._shard_store(models)
        version = self._current_version(models)
        if version is None:
            report("check parts", 0, 0)
            shards.check(count)
            with (
                self._working_directory(),
                spool_directory() as names_directory,
                self._map_file(report) as (path, extras),
            ):
                source = open_source(path, self.split, report, extras)
                shards_data = shards.read(count, self._encoder(models).levels, source.data.cells)
                scanned = [shard_data.scanned for shard_data in shards_data if shard_data.scanned is not None]
                surroundings = (
                    ScanNeighbourIndex.concatenate(scanned)
                    if scanned
                    else build_neighbour_index(source.geometry(), source.data.cells)
                )
                names = partial(save_names, path, names_directory, extras)
                version = self._publisher(models).publish(source, shards_data, surroundings, names, report)
        shards.remove()
        return version

    def current_version(self) -> Path | None:
        """Return the default version's directory if it is up to date; None without `keep_current`."""
        return self._current_version(self._load_models(no_progress)) if self.keep_current else None

    def _load_models(self, report: Progress) -> _LoadedModels:
        report("load model", 0, 0)
        region = None if self.within is None else self.within.shape.wkt
        extras = [f"{layer} {layer.sha256}" for layer in self.extras]
        map_sha256 = fingerprint(self.map_path, self.split, region, extras)
        return _LoadedModels(load_retriever(self.weights_dir), load_posterior(), map_sha256)

    def _encoder(self, models: _LoadedModels) -> Retriever:
        return models.retriever if self.levels else models.retriever.global_only()

    def _shard_store(self, models: _LoadedModels) -> ShardStore:
        origin = Origin(
            map_sha256=models.map_sha256,
            model_fingerprint=models.retriever.fingerprint,
            posterior_fingerprint=models.posterior.fingerprint,
            levels=self._encoder(models).levels != ("global",),
        )
        return ShardStore(self.out_dir, origin)

    def _publisher(self, models: _LoadedModels) -> Publisher:
        models_used = models.retriever, models.posterior.fingerprint
        return Publisher(self.out_dir, *models_used, models.map_sha256, self.store)

    @contextmanager
    def _working_directory(self) -> Iterator[None]:
        """Create the index directory for temporary files; remove it again if it stays empty."""
        with explain_write_errors(self.out_dir):
            self.out_dir.mkdir(parents=True, exist_ok=True)
        try:
            with spooling_in(self.out_dir):
                yield
        finally:
            with suppress(OSError):  # it is not empty
                self.out_dir.rmdir()

    @contextmanager
    def _map_file(self, report: Progress) -> Iterator[tuple[Path, Sequence[ExtraLayer]]]:
        """Yield the file of the region, and what is there of the extra data."""
        if self.within is not None:
            report("take the region", 0, 0)
        with extracted_file(self.map_path, self.within) as path:
            if not self.extras:
                yield path, ()
                return
            if path.is_dir():
                raise DataError(f"{path}: --extra needs an OpenStreetMap file; leave it out, or give such a file")
            box = read_extent(path).bounds
            yield path, [layer.clip(box) for layer in self.extras]

    def _current_version(self, models: _LoadedModels) -> Path | None:
        if not self.keep_current:
            return None
        try:
            directory, manifest = open_version(self.out_dir)
            check_model(manifest, models.retriever.fingerprint)
            check_store(manifest)
        except IndexUnusable:
            return None
        is_rich = LEVELS_FILE in manifest.files or models.retriever.levels == ("global",) or not self.levels
        is_same = manifest.store == self.store and manifest.map_sha256 == models.map_sha256
        return directory if is_rich and is_same else None
