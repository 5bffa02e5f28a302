"""The retriever's vectors of every template hint about a map: a small closed set, encoded while indexing."""

import json
from pathlib import Path

import numpy as np
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save_file

from models.citymap.colours import Palette
from models.citymap.gallery import Gallery
from models.citymap.templates import render_hint
from models.citymap.types import DIRECTIONS, Hint
from models.errors import IndexBroken
from models.paper.retriever import Retriever
from models.posterior.neighbours.map_objects import MapObjects

FILE = "hints.safetensors"


def template_hints(gallery: Gallery, objects: MapObjects, palette: Palette) -> tuple[str, ...]:
    """Return every template hint about the map's visible classes, in each of their colours and without colour."""
    labels, number = objects.labels(gallery)
    shown, words = objects.parts > 0, [*palette.words, None]
    colour = palette.word_index(objects.rgb[shown]) % len(words)  # -1 is the last
    shown_pairs = np.unique(number[shown] * len(words) + colour)
    pairs = {(str(labels[row // len(words)]), words[row % len(words)]) for row in shown_pairs.tolist()}
    pairs |= {(label, None) for label, _ in pairs}
    ordered = sorted(pairs, key=lambda pair: (pair[0], pair[1] or ""))
    return tuple(render_hint(Hint(direction, *pair)) for pair in ordered for direction in DIRECTIONS)


def save_hint_features(directory: Path, retriever: Retriever, sentences: tuple[str, ...]) -> None:
    """Encode hints and write them into an index version."""
    features = {"features": retriever.encode_sentences(sentences)}
    save_file(features, directory / FILE, {"sentences": json.dumps(sentences)})


def load_hint_features(directory: Path, retriever: Retriever) -> frozenset[str]:
    """Load the hints of an index version into the retriever's cache, and return their sentences."""
    try:
        with safe_open(directory / FILE, framework="numpy") as file:
            sentences = json.loads(file.metadata()["sentences"])
            retriever.cache_features(sentences, file.get_tensor("features"))
    except (OSError, SafetensorError, ValueError, KeyError, TypeError) as error:
        raise IndexBroken(f"the hints in {directory} cannot be read; rebuild it with 'hereabouts index'") from error
    return frozenset(sentences)
