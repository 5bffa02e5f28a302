"""The offline job: map -> cells -> vectors -> an index version on disk."""

from collections.abc import Iterator
from contextlib import closing, contextmanager, nullcontext
from pathlib import Path

import numpy as np
from safetensors import SafetensorError

from index.artifact import check_store, open_version, set_alias
from index.hint_features import save_hint_features, template_hints
from index.manifest import FrameRecord, Manifest, StoreName, check_model, fingerprint, new_version, write_manifest
from index.posterior.meaning import Meanings
from index.ranking import Ranker
from index.stores.faiss_store import FaissStore
from index.stores.milvus_store import MilvusStore
from index.stores.opening import VECTORS_FILE
from index.stores.store import Floats
from models.city.gallery import MapData
from models.city.kinds.vocabulary import load_vocabulary
from models.city.osm.extract import Region, extracted
from models.city.scenery.files import save_scenery
from models.city.source import Source, open_source
from models.city.types import Progress
from models.errors import DataError, IndexUnusable
from models.files import file_records, new_directory
from models.language.places.lookup import Lookup
from models.language.text_encoder import load_text_encoder
from models.posterior.model import load_posterior
from models.posterior.posterior import HintPosterior
from models.posterior.statements import Statements
from models.posterior.surroundings.surroundings import Surroundings, surroundings_of
from models.retrieval.checkpoint import load_retriever
from models.retrieval.level_table import STARTS_FILE
from models.retrieval.retriever import Retriever


def build_index(
    map_path: Path,
    out_dir: Path,
    weights_dir: Path | None = None,
    split: str | None = None,
    keep_current: bool = False,
    levels: bool = False,
    progress: Progress | None = None,
    store: StoreName = "faiss",
    within: Region | None = None,
) -> Path:
    """Build an index version of a map and let the alias "default" name it.

    Args:
        map_path: as `models.city.source.open_sources`.
        out_dir: index directory; older versions in it are kept.
        weights_dir: the retriever's weights; None for those that ship with the package.
        split: as `models.city.source.open_sources`.
        keep_current: build nothing if the default version is of this map and this model.
        levels: keep the retriever's other levels too: any `refine` but the default ranks by them.
        progress: called as the work goes on.
        store: where the vectors go: a file of the version, or the Milvus that HEREABOUTS_MILVUS_URI names.
        within: the part of an OpenStreetMap file that is wanted; None for all of it.

    Returns:
        The version's directory.

    Raises:
        MapError, DataError: the map cannot be read or cut, or the index cannot be written; what is there stays.
        WeightsError: the model cannot be loaded.
        StoreUnavailable: Milvus does not take the vectors; nothing is left there.
    """
    report = progress or (lambda stage, done, total: None)
    report("load model", 0, 0)
    retriever = load_retriever(weights_dir)
    map_sha256 = fingerprint(map_path, split, None if within is None else within.shape.wkt)
    current = _current(out_dir, map_sha256, retriever, levels, store) if keep_current else None
    if current:
        return current
    if within is not None:
        report("take the region", 0, 0)
    with extracted(map_path, within) as path:
        source = open_source(path, split, report)
        return _build(source, out_dir, new_version(map_sha256, retriever.fingerprint), retriever, levels, report, store)


def _build(
    source: Source,
    out_dir: Path,
    origin: dict[str, str],
    retriever: Retriever,
    levels: bool,
    report: Progress,
    store: StoreName,
) -> Path:
    """As `build_index`, of a source."""
    data = source.data
    report("encode cells", 0, 0)
    ranker = Ranker.of(retriever if levels else retriever.global_alone(), data.cells, data.gallery.labels)
    surroundings = surroundings_of(source.bodies(), data.cells, report)
    report("tabulate statements", 0, 0)
    statements, posterior = _statements(data, surroundings)
    report("read names", 0, 0)
    gazetteer, encoder = source.gazetteer(), load_text_encoder()
    meanings = Meanings.of(Lookup(gazetteer, load_vocabulary(), encoder.is_everyday), encoder.embed)
    report("write index", 0, 0)
    vectors = ranker.store.vectors(np.arange(len(data.cells)))
    with (
        _writing(out_dir),
        _in_milvus(origin["version"], vectors, data) if store == "milvus" else nullcontext() as collection,
        new_directory(out_dir / origin["version"]) as directory,
    ):
        if collection is None:
            FaissStore.of(vectors).save(directory / VECTORS_FILE)
        ranker.save_levels(directory)
        save_hint_features(directory, retriever, template_hints(data.gallery, data.palette))
        data.gallery.save(directory, with_parts=not surroundings.cuts)
        surroundings.save(directory)
        statements.save(directory, posterior)
        gazetteer.save(directory)
        meanings.save(directory)
        save_scenery(directory, source.scenery(gazetteer))
        manifest = Manifest(
            **origin,
            **_describe(data),
            model=retriever.name,
            dim=ranker.store.dim,
            store=store,
            collection=collection,
            files=file_records(directory),
        )
        write_manifest(directory, manifest)
    with _writing(out_dir):
        set_alias(out_dir, "default", manifest.version)
    return out_dir / manifest.version


def _statements(data: MapData, surroundings: Surroundings) -> tuple[Statements, str]:
    """The statements about a map, by the hint posterior that ships, and its fingerprint."""
    model, label = load_posterior(), surroundings.things.labels(data.gallery)[1]
    posterior = HintPosterior(model.likelihood, surroundings, data.cells, label, data.palette)
    return posterior.statements, model.fingerprint


@contextmanager
def _in_milvus(version: str, vectors: Floats, data: MapData) -> Iterator[str]:
    """The collection of a version, which stays if the block ends well."""
    centers_m = data.cells.center_m[:, :2]
    with MilvusStore.written(version, vectors, centers_m, data.cells.scenes) as written, closing(written):
        yield written.collection


@contextmanager
def _writing(out_dir: Path) -> Iterator[None]:
    """Say so where an index cannot be written."""
    try:
        yield
    except (OSError, SafetensorError) as error:
        raise DataError(f"{out_dir} cannot be written: {error}; make room, or give another directory") from error


def _describe(data: MapData) -> dict[str, object]:
    """The manifest's fields that say what was indexed."""
    return {
        "map_name": data.name,
        "attribution": data.attribution,
        "frame": FrameRecord(
            frame_id=data.frame.frame_id,
            origin_lat=data.frame.origin_lat,
            origin_lon=data.frame.origin_lon,
            epsg=data.frame.epsg,
        ),
        "palette": data.palette.name,
        "cell_size_m": data.cells.size_m,
        "grid_m": data.grid_m,
        "cells": len(data.cells),
        "instances": len(data.gallery.labels),
    }


def _current(out_dir: Path, map_sha256: str, retriever: Retriever, levels: bool, store: StoreName) -> Path | None:
    """The default version's directory if it is whole, of this map, model and store, with levels if they are wanted."""
    try:
        directory, manifest = open_version(out_dir)
        check_model(manifest, retriever.fingerprint)
        check_store(manifest)
    except IndexUnusable:
        return None
    is_rich = STARTS_FILE in manifest.files or retriever.levels == ("global",) or not levels
    is_same = manifest.store == store and manifest.map_sha256 == map_sha256
    return directory if is_rich and is_same else None
