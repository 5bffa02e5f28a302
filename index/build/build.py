"""The offline job: map -> cells -> vectors -> an index version on disk, in one process or in shards."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import NamedTuple

from index.build.artifact import check_store, open_version
from index.build.manifest import StoreName, check_model, fingerprint
from index.build.publish import Publisher, save_names
from index.build.shard import Shard
from index.build.shard_data import Part, writing
from index.build.shard_store import Origin, Parts
from models.citymap.cells import CELLS_PER_BLOCK
from models.citymap.types import Progress
from models.errors import IndexUnusable
from models.paper.checkpoint import load_retriever
from models.paper.level_table import STARTS_FILE
from models.paper.retriever import Retriever
from models.posterior.model import PosteriorModel, load_posterior
from models.posterior.neighbours.neighbour_index import surroundings_of
from models.posterior.neighbours.scan_index import ScanSurroundings
from models.processes import forked
from models.sources.osm.extract import Region, extracted_file
from models.sources.source import open_source
from models.spool import scratch, spooling_in


def silent(_stage: str, _done: int, _total: int) -> None:
    """Progress of which nobody wants to know."""


class _Ready(NamedTuple):
    """What every piece of the work begins with."""

    retriever: Retriever
    posterior: PosteriorModel
    map_sha256: str


@dataclass(frozen=True, slots=True)
class IndexJob:
    """A map that is to be indexed: at once (`build`), or in shards (`make_part` of each, anywhere, then `merge`).

    Both ways give the same bytes, on processors of one kind.

    Attributes:
        map_path: as `models.sources.source.open_sources`.
        out_dir: index directory; older versions in it are kept.
        weights_dir: the retriever's weights; None for those that ship with the package.
        split: as `models.sources.source.open_sources`.
        keep_current: build nothing if the default version is of this map and this model.
        levels: keep the retriever's other levels too: any `refine` but the default ranks by them.
        store: where the vectors go: a file of the version, or the Milvus that HEREABOUTS_MILVUS_URI names.
        within: the part of an OpenStreetMap file that is wanted; None for all of it.
    """

    map_path: Path
    out_dir: Path
    weights_dir: Path | None = None
    split: str | None = None
    keep_current: bool = False
    levels: bool = False
    store: StoreName = "faiss"
    within: Region | None = None

    def build(self, report: Progress = silent) -> Path:
        """Build a version in this process.

        Args:
            report: called as the work goes on.

        Returns:
            The version's directory.

        Raises:
            MapError, DataError: the map cannot be read or cut, or the index cannot be written; what is there stays.
            WeightsError: a model cannot be loaded.
            StoreUnavailable: Milvus does not take the vectors; nothing is left there.
        """
        ready = self._ready(report)
        if current := self._current(ready):
            return current
        with (
            self._room(),
            scratch() as named,
            self._map(report) as path,
            forked(partial(save_names, path, named)) as names,
        ):
            source = open_source(path, self.split, report)
            surroundings = surroundings_of(source.geometry(), source.data.cells, report)
            rows = range(len(source.data.cells))
            encoder, likelihood = self._encoder(ready), ready.posterior.likelihood
            part = Part.of(encoder, likelihood, source, surroundings, rows, report)
            return self._publisher(ready).publish(source, [part], surroundings, names, report)

    def make_part(self, shard: Shard, report: Progress = silent) -> Path:
        """Make the part of a shard, if it is not there; arguments and errors as `build`.

        Returns:
            Its directory.
        """
        ready = self._ready(report)
        parts = self._parts(ready)
        if parts.fault(shard) is None:
            return parts.path(shard)
        with writing(self.out_dir):
            parts.claim()
        with self._room(), self._map(report) as path:
            source = open_source(path, self.split, report)
            count = len(source.data.cells)
            rows = shard.rows(count, CELLS_PER_BLOCK)
            surroundings = surroundings_of(source.geometry(), source.data.cells, report, rows)
            encoder, likelihood = self._encoder(ready), ready.posterior.likelihood
            part = Part.of(encoder, likelihood, source, surroundings, rows, report)
            report("write part", 0, 0)
            with writing(self.out_dir):
                parts.write(shard, part, rows, count)
        return parts.path(shard)

    def merge(self, count: int, report: Progress = silent) -> Path:
        """Build a version of the parts of so many shards, and remove these; arguments and errors as `build`.

        Raises:
            IndexBroken: parts are missing, damaged, or of another map or model; nothing is removed.
        """
        ready = self._ready(report)
        parts = self._parts(ready)
        version = self._current(ready)
        if version is None:
            report("check parts", 0, 0)
            parts.check(count)
            with self._room(), scratch() as named, self._map(report) as path:
                source = open_source(path, self.split, report)
                made = parts.read(count, self._encoder(ready).levels, source.data.cells)
                scanned = [part.scanned for part in made if part.scanned is not None]
                surroundings = (
                    ScanSurroundings.joined(scanned)
                    if scanned
                    else surroundings_of(source.geometry(), source.data.cells)
                )
                names = partial(save_names, path, named)
                version = self._publisher(ready).publish(source, made, surroundings, names, report)
        parts.remove()
        return version

    def current(self) -> Path | None:
        """The default version's directory if nothing has to be built; None also unless `keep_current`."""
        return self._current(self._ready(silent)) if self.keep_current else None

    def _ready(self, report: Progress) -> _Ready:
        report("load model", 0, 0)
        region = None if self.within is None else self.within.shape.wkt
        return _Ready(
            load_retriever(self.weights_dir), load_posterior(), fingerprint(self.map_path, self.split, region)
        )

    def _encoder(self, ready: _Ready) -> Retriever:
        """The model that makes the levels that are wanted."""
        return ready.retriever if self.levels else ready.retriever.global_only()

    def _parts(self, ready: _Ready) -> Parts:
        origin = Origin(
            map_sha256=ready.map_sha256,
            model_fingerprint=ready.retriever.fingerprint,
            posterior_fingerprint=ready.posterior.fingerprint,
            levels=self._encoder(ready).levels != ("global",),
        )
        return Parts(self.out_dir, origin)

    def _publisher(self, ready: _Ready) -> Publisher:
        of_models = ready.retriever, ready.posterior.fingerprint
        return Publisher(self.out_dir, *of_models, ready.map_sha256, self.store)

    @contextmanager
    def _room(self) -> Iterator[None]:
        """The index directory, where what is made meanwhile lies; if nothing comes of it, it is not there either."""
        with writing(self.out_dir):
            self.out_dir.mkdir(parents=True, exist_ok=True)
        try:
            with spooling_in(self.out_dir):
                yield
        finally:
            with suppress(OSError):  # there is something in it
                self.out_dir.rmdir()

    @contextmanager
    def _map(self, report: Progress) -> Iterator[Path]:
        """The map's file, of the region that is wanted, until the block ends."""
        if self.within is not None:
            report("take the region", 0, 0)
        with extracted_file(self.map_path, self.within) as path:
            yield path

    def _current(self, ready: _Ready) -> Path | None:
        """The default version's directory if it is kept, whole, of this map, model and store, with levels if wanted."""
        if not self.keep_current:
            return None
        try:
            directory, manifest = open_version(self.out_dir)
            check_model(manifest, ready.retriever.fingerprint)
            check_store(manifest)
        except IndexUnusable:
            return None
        is_rich = STARTS_FILE in manifest.files or ready.retriever.levels == ("global",) or not self.levels
        is_same = manifest.store == self.store and manifest.map_sha256 == ready.map_sha256
        return directory if is_rich and is_same else None
