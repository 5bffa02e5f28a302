"""Read scenery to draw a map without a browser, and the colours of a map."""

import gzip
import json
import struct
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from safetensors.numpy import load

from models.citymap.scenery.shapes import UNITS_PER_M, NamedPoint
from models.citymap.types import Floats

LOOK_FILE: Final = Path(__file__).with_name("look.json")
POINT, LINE, AREA = 0, 1, 2  # the form of an outline


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """An object of a map."""

    label: str
    form: int  # POINT, LINE or AREA
    width_m: float  # of a line
    name: str | None
    paths: list[Floats]  # [V, 2] each, metres, map frame


@dataclass(frozen=True, slots=True, eq=False)
class DecodedScenery:
    """The content of a part of scenery: outlines and named points, or scanned points."""

    outlines: list[Outline]  # the topmost first
    places: list[NamedPoint]  # named objects that are drawn as a point
    xyz_m: Floats  # [P, 3]
    rgb: npt.NDArray[np.uint8]  # [P, 3]


def read_scenery(path: Path) -> DecodedScenery:
    """Read a part that `save_scenery` wrote."""
    blob = gzip.decompress(path.read_bytes())
    (size,) = struct.unpack("<Q", blob[:8])
    metadata = json.loads(blob[8 : 8 + size])["__metadata__"]
    tensors = load(blob)
    positions_m = tensors["steps"].cumsum(axis=0, dtype=np.int64) / UNITS_PER_M
    no_points = np.zeros((0, 3))
    if metadata["kind"] == "points":
        return DecodedScenery([], [], positions_m, tensors["rgb"])
    places = [
        NamedPoint((x / UNITS_PER_M, y / UNITS_PER_M), name, kind)
        for x, y, name, kind in json.loads(metadata["places"])
    ]
    return DecodedScenery(_outlines(metadata, tensors, positions_m), places, no_points, no_points.astype(np.uint8))


def _outlines(metadata: dict[str, str], tensors: dict[str, npt.NDArray[Any]], positions_m: Floats) -> list[Outline]:
    labels, names = json.loads(metadata["labels"]), json.loads(metadata["names"])
    paths = np.split(positions_m, tensors["size"].cumsum()[:-1])
    last = tensors["paths"].cumsum().tolist()
    return [
        Outline(
            label=labels[tensors["label"][n]],
            form=int(tensors["form"][n]),
            width_m=float(tensors["width"][n]) / UNITS_PER_M,
            name=names.get(str(n)),
            paths=paths[first:end],
        )
        for n, (first, end) in enumerate(pairwise([0, *last]))
    ]


@cache
def load_look() -> dict[str, Any]:
    """Load the colours of the page: "light" and "dark" by use; "ground", "rising" and "walls" by label."""
    return json.loads(LOOK_FILE.read_text())
