"""Read files of any tool as osmium needs them: sorted by type and id, each id once, and none below zero.

JOSM numbers new elements from -1 down and marks what is to be deleted, history files have all versions of an element,
and hand-made files have any order. Of such a file a sorted copy is read, which is written by runs that fit in memory.
"""

import bz2
import gzip
import heapq
import re
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any, Final
from xml.parsers import expat

import osmium

from models.errors import MapError
from models.sources.osm.reading import (
    SUFFIXES,
    TYPE_NAMES,
    explained_errors,
    open_writer,
    positive_id,
    read_osm,
)
from models.spool import spool_directory

ELEMENTS_PER_RUN: Final = 1_000_000  # sorted in memory, some 200 MB
SORTED: Final = "Type_then_ID"  # of the header's field "sorting"
ENTITIES: Final = {"n": osmium.osm.NODE, "w": osmium.osm.WAY, "r": osmium.osm.RELATION}  # in a file's order
BYTES_PER_BLOCK: Final = 2**20
BOX_ATTRIBUTES: Final = (b"minlon", b"minlat", b"maxlon", b"maxlat")
MARGIN_BYTES: Final = 64  # a match is shorter, unless somebody indents an attribute by a line of spaces
_DELETION: Final = re.compile(rb"\saction\s*=\s*[\"']delete[\"']")
_BOUNDS: Final = re.compile(rb"<bounds\s[^>]*>")
_ATTRIBUTE: Final = re.compile(rb"(\w+)\s*=\s*[\"']([^\"']*)[\"']")


@contextmanager
def ordered_file(path: Path) -> Iterator[Path]:
    """Yield a file that osmium can read: `path`, or a temporary copy of it, which names `path` in errors.

    A path that is no OpenStreetMap file is left to the reader to refuse.

    Raises:
        MapError: the file cannot be read.
        DataError: the copy cannot be written.
    """
    suffix = next((suffix for suffix in SUFFIXES if path.name.lower().endswith(suffix)), None)
    if suffix is None or not path.is_file() or not path.stat().st_size:
        yield path
        return
    is_lower = path.name.endswith(suffix)
    if is_lower and _is_ordered_file(path):
        yield path
        return
    with spool_directory() as directory:
        link, copy = (directory / (path.name.split(".")[0] + suffix) for suffix in (suffix, ".sorted.osm.pbf"))
        link.symlink_to(path.resolve())  # osmium knows lower-case suffixes only
        try:
            if is_lower or not _is_ordered_file(link):
                _write_ordered(link, copy, directory)
                yield copy
            else:
                yield link
        except MapError as error:
            raise MapError(str(error).replace(str(copy), str(path)).replace(str(link), str(path))) from error


def _is_ordered_file(path: Path) -> bool:
    status = path.stat()
    with explained_errors(path):
        return _is_ordered(path, status.st_size, status.st_mtime_ns)


@lru_cache(maxsize=64)  # a map is read by several functions
def _is_ordered(path: Path, _size: int, _changed: int) -> bool:
    header = osmium.io.Reader(str(path), osmium.osm.NOTHING).header()
    if header.has_multiple_object_versions or _has_deletions(path) or len(_xml_bounds(path)) > 1:
        return False
    if header.get("sorting") == SORTED:  # then negative ids are first
        return all(_first_id(path, entity) >= 0 for entity in ENTITIES.values())
    ranks, last = {kind: rank for rank, kind in enumerate(ENTITIES)}, (0, -1)
    elements: Any = osmium.FileProcessor(str(path), osmium.osm.NODE | osmium.osm.WAY | osmium.osm.RELATION)
    for element in elements:
        rank = ranks[element.type_str()], element.id
        if rank <= last or element.id < 0 or element.deleted:
            return False
        last = rank
    return True


def _first_id(path: Path, entity: Any) -> int:
    elements: Any = osmium.FileProcessor(str(path), entity)
    for element in elements:
        return int(element.id)
    return 0


def _open_xml(path: Path) -> Any:
    """Open a file for reading its XML; return None if it is in another format."""
    match path.suffix:
        case ".osm":
            return path.open("rb")
        case ".gz":
            return gzip.open(path)
        case ".bz2":
            return bz2.open(path)
    return None


def _xml_blocks(path: Path) -> Iterator[bytes]:
    file = _open_xml(path)
    if file is not None:
        try:
            with file:
                while block := file.read(BYTES_PER_BLOCK):
                    yield block
        except (EOFError, zlib.error) as error:
            raise OSError(str(error)) from error


def _has_deletions(path: Path) -> bool:
    """Whether an XML file marks elements as deleted in the way of JOSM, of which osmium knows nothing."""
    tail = b""
    for block in _xml_blocks(path):
        if _DELETION.search(tail + block):
            return True
        tail = block[-MARGIN_BYTES:]
    return False


def _xml_bounds(path: Path) -> list[tuple[float, float, float, float]]:
    """Return the boxes at the beginning of an XML file; JOSM writes one for each download, osmium reads the first."""
    boxes = []
    for match in _BOUNDS.findall(next(_xml_blocks(path), b"")):
        value = dict(_ATTRIBUTE.findall(match))
        west, south, east, north = (float(value.get(key, "nan")) for key in BOX_ATTRIBUTES)
        boxes.append((west, south, east, north))
    return boxes


def _deleted_elements(path: Path) -> set[tuple[str, int]]:
    """Return the elements, by letter and id, that an XML file marks as deleted."""
    letters, deleted = {name: letter for letter, name in TYPE_NAMES.items()}, set[tuple[str, int]]()

    def note(name: str, attributes: dict[str, str]) -> None:
        if attributes.get("action") == "delete" and name in letters:
            deleted.add((letters[name], int(attributes["id"])))

    parser, file = expat.ParserCreate(), _open_xml(path)
    parser.StartElementHandler = note
    assert file is not None
    with file:
        try:
            parser.ParseFile(file)
        except expat.ExpatError as error:
            raise ValueError(str(error)) from error
    return deleted


def _write_ordered(path: Path, out: Path, directory: Path) -> None:
    """Write the newest version of each element, unless it is deleted, in osmium's order and with its header's box."""
    with explained_errors(path):
        header, deleted = osmium.io.Header(), _deleted_elements(path) if _has_deletions(path) else set()
        box, boxes = osmium.io.Reader(str(path), osmium.osm.NOTHING).header().box(), _xml_bounds(path)
    if len(boxes) > 1:
        west, south, east, north = zip(*boxes, strict=True)
        box = osmium.osm.Box(min(west), min(south), max(east), max(north))
    if box.valid():
        header.add_box(box)
    header.set("sorting", SORTED)
    with open_writer(out, header) as writer:
        for kind in ENTITIES:
            elements = (item for item in read_osm(path, entities=ENTITIES[kind]) if (kind, item.id) not in deleted)
            runs = list(_write_runs(elements, directory))
            last = None
            for item in heapq.merge(*(read_osm(run) for run in runs), key=lambda one: (one.id, -one.version)):
                if item.id != last and not item.deleted:
                    writer.add(item)
                last = item.id
            for run in runs:
                run.unlink()


def _write_runs(elements: Iterator[Any], directory: Path) -> Iterator[Path]:
    """Write elements into sorted files of at most ELEMENTS_PER_RUN each, which keep deleted elements as such."""
    number = 0
    while (first := next(elements, None)) is not None:
        unsorted, run = directory / "unsorted.osh.pbf", directory / f"run{number}.osh.pbf"
        with open_writer(unsorted) as writer:
            writer.add(_renumber(first))
            for element in islice(elements, ELEMENTS_PER_RUN - 1):
                writer.add(_renumber(element))
        merger = osmium.MergeInputReader()
        merger.add_file(str(unsorted))
        with open_writer(run) as writer:
            merger.apply(writer, simplify=True)
        unsorted.unlink()
        yield run
        number += 1


def _renumber(element: Any) -> Any:
    """Return an element without negative ids."""
    kind, changes = element.type_str(), dict[str, Any]()
    if element.id < 0:
        changes["id"] = positive_id(element.id)
    if kind == "w" and any(node.ref < 0 for node in element.nodes):
        changes["nodes"] = [positive_id(node.ref) for node in element.nodes]
    if kind == "r" and any(member.ref < 0 for member in element.members):
        changes["members"] = [(member.type, positive_id(member.ref), member.role) for member in element.members]
    return element.replace(**changes) if changes else element
