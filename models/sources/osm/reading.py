"""Shared by the readers and writers of OpenStreetMap files: suffixes, errors, batches, geometry and ids."""

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from shutil import disk_usage
from typing import Any, Final, TypeVar

import osmium

from models.errors import DataError, MapError
from models.spool import disk_errors, spool_directory

SUFFIXES = (".osm.pbf", ".pbf", ".osm", ".osm.bz2", ".osm.gz")
ELEMENTS_PER_BATCH = 20_000
MIN_LARGE_FILE_BYTES: Final = 2**28  # a PBF of 40 million nodes, about
POSITION_BYTES_PER_BYTE: Final = 4.0  # of a PBF; Andorra has 2.4, midtown Manhattan 1.1
TYPE_NAMES = {"n": "node", "w": "way", "r": "relation"}  # by osmium's letter
FIRST_RENUMBERED: Final = 2**40  # ids from here on stand for negative ones; OpenStreetMap has reached 2**34
Element = TypeVar("Element")


def batched(elements: Iterator[Element]) -> Iterator[list[Element]]:
    """Yield elements in batches, because those of a file do not fit in memory."""
    while batch := list(islice(elements, ELEMENTS_PER_BATCH)):
        yield batch


@contextmanager
def explained_errors(path: Path) -> Iterator[None]:
    """Raise a MapError that names the file if osmium fails in the block."""
    try:
        yield
    except (RuntimeError, ValueError, OSError, osmium.InvalidLocationError) as error:
        raise MapError(
            f"{path}: cannot be read as OpenStreetMap ({error}); correct it, or download it again if it was cut short"
        ) from error


@contextmanager
def located_elements(path: Path, entities: Any = osmium.osm.ALL) -> Iterator[Any]:
    """Yield a processor of a file's elements whose ways have the positions of their nodes.

    Those of a large file are in a temporary file, because they take 16 bytes each: gigabytes for a country.

    Raises:
        DataError: there is no room for them.
    """
    processor, size = osmium.FileProcessor(str(path), entities), path.stat().st_size
    if size < MIN_LARGE_FILE_BYTES:
        yield processor.with_locations()
        return
    with spool_directory() as directory:
        needed, free = POSITION_BYTES_PER_BYTE * size, disk_usage(directory).free
        if free < needed:  # osmium maps the file, so a full disk would kill the process
            raise DataError(
                f"{directory.parent} has {free / 1e9:,.1f} GB left, but indexing {path.name} needs "
                f"{needed / 1e9:,.1f} GB there for a while; make room, or take a part of the map (--within)"
            )
        yield processor.with_locations(f"sparse_file_array,{directory / 'positions'}")


def read_osm(path: Path, *filters: Any, entities: Any = osmium.osm.ALL) -> Iterator[Any]:
    """Yield the elements of a file that pass filters, each valid until the next; errors as `explained_errors`."""
    processor = osmium.FileProcessor(str(path), entities)
    for each in filters:
        processor.with_filter(each)
    with explained_errors(path):
        yield from processor


@contextmanager
def open_writer(out: Path, header: Any = None) -> Iterator[Any]:
    """Open a new OpenStreetMap file, to which the block adds elements; raise DataError if it cannot be written."""
    writer = None
    try:
        writer = osmium.SimpleWriter(str(out), header=header or osmium.io.Header())
        yield writer
        writer.close()
    except BaseException as error:
        if writer is not None:
            try:
                writer.close()
            except RuntimeError:  # its destructor would fail like this, too, and end the process: keep it from running
                ctypes.pythonapi.Py_IncRef(ctypes.py_object(writer))
        if not isinstance(error, RuntimeError):
            raise
        with disk_errors():
            raise OSError(str(error)) from error


def geometry_factories() -> dict[str, Any]:
    """Return, by osmium's letter of an element type, the function that makes its geometry: a point, a line or areas."""
    factory = osmium.geom.WKBFactory()
    return {"n": factory.create_point, "w": factory.create_linestring, "a": factory.create_multipolygon}


def source_id(element: Any, kind: str) -> str:
    """Return the source of an element, "way/1234"; `kind` is osmium's letter."""
    if kind == "a":
        return f"{'way' if element.from_way() else 'relation'}/{original_id(element.orig_id())}"
    return f"{TYPE_NAMES[kind]}/{original_id(element.id)}"


def positive_id(number: int) -> int:
    """Return an id that stands for a negative one, because osmium ignores those."""
    return number if number >= 0 else FIRST_RENUMBERED - number


def original_id(number: int) -> int:
    """Undo `positive_id`."""
    return number if number <= FIRST_RENUMBERED else FIRST_RENUMBERED - number
