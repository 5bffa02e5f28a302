"""Scenery as it was written, for what draws a map without a browser; and the look of a map."""

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
    """An object of a map.

    Attributes:
        label: its class.
        form: POINT, LINE or AREA.
        width_m: of a line.
        name: if it has one.
        paths: [V, 2] each, metres, map frame.
        is_hole: of each path, whether it is a hole of the area before it.
    """

    label: str
    form: int
    width_m: float
    name: str | None
    paths: list[Floats]
    is_hole: list[bool]


@dataclass(frozen=True, slots=True, eq=False)
class DecodedScenery:
    """What a part of scenery holds: outlines and places, or points.

    Attributes:
        outlines: what lies on top of others first.
        places: what has a name and is found at one point.
        xyz_m: [P, 3].
        rgb: [P, 3].
    """

    outlines: list[Outline]
    places: list[NamedPoint]
    xyz_m: Floats
    rgb: npt.NDArray[np.uint8]


def read_scenery(path: Path) -> DecodedScenery:
    """A part, as `Outlines.encode` or `encode_cloud` wrote it and `save_scenery` compressed it."""
    blob = gzip.decompress(path.read_bytes())
    (size,) = struct.unpack("<Q", blob[:8])
    told = json.loads(blob[8 : 8 + size])["__metadata__"]
    tensors = load(blob)
    walked = tensors["steps"].cumsum(axis=0, dtype=np.int64) / UNITS_PER_M
    nothing = np.zeros((0, 3))
    if told["kind"] == "points":
        return DecodedScenery([], [], walked, tensors["rgb"])
    places = [
        NamedPoint((x / UNITS_PER_M, y / UNITS_PER_M), name, kind) for x, y, name, kind in json.loads(told["places"])
    ]
    return DecodedScenery(_outlines(told, tensors, walked), places, nothing, nothing.astype(np.uint8))


def _outlines(told: dict[str, str], tensors: dict[str, npt.NDArray[Any]], walked: Floats) -> list[Outline]:
    labels, names = json.loads(told["labels"]), json.loads(told["names"])
    paths = np.split(walked, tensors["size"].cumsum()[:-1])
    hole = tensors["hole"].astype(bool).tolist()
    last = tensors["paths"].cumsum().tolist()
    return [
        Outline(
            label=labels[tensors["label"][n]],
            form=int(tensors["form"][n]),
            width_m=float(tensors["width"][n]) / UNITS_PER_M,
            name=names.get(str(n)),
            paths=paths[first:end],
            is_hole=hole[first:end],
        )
        for n, (first, end) in enumerate(pairwise([0, *last]))
    ]


@cache
def load_look() -> dict[str, Any]:
    """Colours of a map, as the page has them: "light" and "dark" by use; "ground", "rising" and "walls" by label."""
    found: dict[str, Any] = json.loads(LOOK_FILE.read_text())
    return found
