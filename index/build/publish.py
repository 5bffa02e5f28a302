"""The last step of the offline job: write a version directory and point the alias to it."""

import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager, nullcontext
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import NamedTuple

from index.answering.hint_features import save_hint_features, template_hints
from index.answering.meanings import Meanings, embed_phrases
from index.asking.questions import build_landmarks
from index.build.artifact import set_alias
from index.build.manifest import FrameRecord, Manifest, StoreName, new_version, write_manifest
from index.build.shard_data import ShardData, explain_write_errors
from index.stores.faiss_store import FaissStore
from index.stores.milvus_store import MilvusStore
from index.stores.opening import VECTORS_FILE
from index.stores.store import Floats
from models.citymap.gallery import MapData
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.kinds.vocabulary import load_vocabulary
from models.citymap.scenery.files import save_scenery
from models.citymap.summary import MapSummary
from models.citymap.types import Progress
from models.files import file_records, new_directory
from models.language.mentions.lookup import Lookup
from models.language.mentions.name_table import NameTable
from models.language.text_encoder import load_text_encoder
from models.memory import release_memory
from models.paper.level_table import LevelTable
from models.paper.retriever import Retriever
from models.posterior.neighbours.neighbour_index import NeighbourIndex
from models.posterior.node_batch import colour_words
from models.posterior.statements import Statements
from models.sources.extras.layer import ExtraLayer
from models.sources.source import Source, open_gazetteer
from models.spool import spooled


class SavedNames(NamedTuple):
    """The names of a map, as `save_names` wrote them."""

    directory: Path
    summary: MapSummary | None  # of the map; None for a data set


@dataclass(frozen=True, slots=True, eq=False)
class Publisher:
    """Writes index versions."""

    out_dir: Path
    retriever: Retriever  # the model that made the vectors
    posterior_fingerprint: str  # of the model that made the statements
    map_sha256: str
    store: StoreName

    def publish(
        self,
        source: Source,
        parts: Sequence[ShardData],
        surroundings: NeighbourIndex,
        names: Callable[[], SavedNames],
        report: Progress,
    ) -> Path:
        """Write a version, point the alias "default" to it, and return its directory.

        `names` waits for `save_names` and returns its result. Raise DataError if the version cannot be written
        (older versions stay), StoreUnavailable if Milvus does not accept the vectors (nothing is left there).
        """
        data, origin = source.data, new_version(self.map_sha256, self.retriever.fingerprint)
        report("read names", 0, 0)
        with explain_write_errors(self.out_dir):
            saved_names = names()
        report("write index", 0, 0)
        columns = ({"vectors": part.vectors} for part in parts)
        vectors = parts[0].vectors if len(parts) == 1 else spooled(columns)["vectors"]
        with (
            explain_write_errors(self.out_dir),
            _milvus_collection(origin["version"], vectors, data)
            if self.store == "milvus"
            else nullcontext() as collection,
            new_directory(self.out_dir / origin["version"]) as directory,
        ):
            if collection is None:
                FaissStore.from_vectors(vectors).save(directory / VECTORS_FILE)
            release_memory()
            self._save_parts(directory, parts, data, surroundings)
            release_memory()
            data.gallery.save(directory, with_parts=not surroundings.cuts)
            surroundings.save(directory)
            for file in saved_names.directory.iterdir():
                shutil.move(file, directory)
            gazetteer = Gazetteer.load(directory)
            build_landmarks(gazetteer, data.cells).save(directory)
            release_memory()
            save_scenery(directory, source.scenery(gazetteer))
            manifest = Manifest(
                **origin,
                **_map_fields(data),
                model=self.retriever.name,
                dim=vectors.shape[1],
                store=self.store,
                collection=collection,
                summary=saved_names.summary,
                files=file_records(directory),
            )
            write_manifest(directory, manifest)
        with explain_write_errors(self.out_dir):
            set_alias(self.out_dir, "default", manifest.version)
        return self.out_dir / manifest.version

    def _save_parts(
        self, directory: Path, parts: Sequence[ShardData], data: MapData, surroundings: NeighbourIndex
    ) -> None:
        levels = LevelTable.concatenate([part.levels for part in parts])
        if not levels.is_empty:
            levels.save(directory)
        save_hint_features(directory, self.retriever, template_hints(data.gallery, surroundings.objects, data.palette))
        statements = Statements.concatenate([part.rows for part in parts], len(colour_words(data.palette)))
        statements.save(directory, self.posterior_fingerprint)


def save_names(path: Path, directory: Path, extras: Sequence[ExtraLayer] = ()) -> SavedNames:
    """Write the gazetteer of a map, its name table and the vectors of its phrases."""
    gazetteer, summary = open_gazetteer(path, extras)
    gazetteer.save(directory)
    del gazetteer
    release_memory()
    gazetteer, vocabulary, encoder = Gazetteer.load(directory), load_vocabulary(), load_text_encoder()
    table = NameTable.from_gazetteer(gazetteer, vocabulary, encoder.is_everyday)
    table.save(directory)
    phrases = Lookup(gazetteer, vocabulary, encoder.is_everyday, table).phrases()
    Meanings.from_vectors(*embed_phrases(phrases, encoder.embed), encoder.embed).save(directory)
    return SavedNames(directory, summary)


@contextmanager
def _milvus_collection(version: str, vectors: Floats, data: MapData) -> Iterator[str]:
    """Write a Milvus collection and yield its name; the collection is dropped if the block raises."""
    centers_m = data.cells.center_m[:, :2]
    with MilvusStore.create(version, vectors, centers_m, data.cells.scenes) as written, closing(written):
        yield written.collection


def _map_fields(data: MapData) -> dict[str, object]:
    return {
        "map_name": data.name,
        "attribution": data.attribution,
        "frame": FrameRecord(**asdict(data.frame)),
        "palette": data.palette.name,
        "cell_size_m": data.cells.size_m,
        "grid_m": data.grid_m,
        "cells": len(data.cells),
        "instances": len(data.gallery.labels),
    }
