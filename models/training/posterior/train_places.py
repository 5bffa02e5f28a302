"""Training of the cue reader and the place kernels on texts about real places."""

import json
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from functools import partial
from math import log
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import torch

from models.checkpoint import CONFIG_FILE, SHIPPED_WEIGHTS_DIR
from models.language.mentions.cue_reader import CueReader
from models.posterior.model import PosteriorModel, load_posterior, save_posterior
from models.posterior.places.kernels import PlaceKernels
from models.sources.place_texts import load_place_texts
from models.sources.source import open_source
from models.training.posterior.cue_texts import LABELLED_DIR, OTHER_SETS, REAL_PLACES, CueText, load_labelled
from models.training.posterior.fit_cues import EPOCHS, accuracy, fit_cues
from models.training.posterior.fit_kernels import MapTexts, calibrate_kernels, fit_kernels, read_examples


def train_places(
    maps: Sequence[tuple[Path, Sequence[Path]]],
    weights: Path | None,
    out: Path,
    steps: int,
    seed: int,
    progress: Callable[[str, int, int, float], None] | None = None,
) -> dict[str, float]:
    """Train the cue reader, fit and calibrate the kernels on maps with texts, and save the weights; on the CPU.

    Two cue readers are trained on half of the texts each. The kernels are fitted to every text as read by the reader
    that was not trained on it. The calibration takes twice the steps of the fit.

    Args:
        maps: OpenStreetMap files, each with files of texts about it (`load_place_texts`).
        weights: of the posterior whose other parts stay; None for the shipped ones. May be the same as `out`.
        out: directory for model.safetensors and config.json.
        steps: see `fit_kernels`.
        seed: of all random choices.
        progress: called with the name of the phase, steps done, steps, and the mean loss.

    Returns:
        Accuracy of the two cue readers on new texts, and the mean loss of the kernels.

    Raises:
        WeightsError, MapError, DataError: an input cannot be read.
        TrainingError: no text mentions anything of its map.
    """
    model = load_posterior(weights)
    record = json.loads(((weights or SHIPPED_WEIGHTS_DIR / "posterior") / CONFIG_FILE).read_text())["training"]
    torch.manual_seed(seed)
    rng, kernels = np.random.default_rng(seed), PlaceKernels()
    cues_for, figures = _train_readers(model, weights, seed, rng, progress)
    map_texts = [_load_texts(path, files) for path, files in maps]
    examples = [
        example for texts in map_texts for example in read_examples(kernels, texts, model.text_encoder, cues_for, rng)
    ]
    temper = calibrate_kernels(kernels, examples, steps, rng)
    loss = fit_kernels(kernels, examples, steps, rng, progress and partial(progress, "fit kernels"))
    with torch.no_grad():
        kernels.temper.add_(log(temper))
    model.places = kernels
    figures |= {"surprise": loss, "temper_scale": temper}
    fitted_to = {path.name: [file.name for file in files] for path, files in maps}
    save_posterior(model, out, record | {"places": figures | {"texts": fitted_to, "seed": seed, "steps": steps}})
    return figures


def _load_texts(path: Path, files: Sequence[Path]) -> MapTexts:
    source = open_source(path)
    centers_m = source.data.cells.center_m[:, :2].astype(np.float64)
    texts = [text for file in files for text in load_place_texts(file)]
    return MapTexts(source.gazetteer(), source.data.frame, centers_m, source.data.grid_m, texts)


def _train_readers(
    model: PosteriorModel,
    weights: Path | None,
    seed: int,
    rng: np.random.Generator,
    progress: Callable[[str, int, int, float], None] | None,
) -> tuple[Callable[[str], CueReader], dict[str, float]]:
    """Train the cue reader of a model on all labelled texts, and one reader on each half of those about real places.

    Returns:
        A function from a text to a reader that was not trained on it, and the accuracy of the two on the other half.
    """
    real = load_labelled(LABELLED_DIR / f"{REAL_PLACES}.jsonl")
    others = [text for name in OTHER_SETS for text in load_labelled(LABELLED_DIR / f"{name}.jsonl")]
    half = rng.permutation(len(real)) % 2
    halves = [[text for text, side in zip(real, half, strict=True) if side == n] for n in (0, 1)]
    trained_on = [[*part, *others] for part in (*halves, real)]
    losses = [0.0] * len(trained_on)
    readers = [_new_reader(model) for _ in trained_on]
    with ProcessPoolExecutor(len(readers), get_context("spawn")) as pool:
        fits = {pool.submit(_fit_reader, weights, texts, EPOCHS, (seed, n)): n for n, texts in enumerate(trained_on)}
        for done, fit in enumerate(as_completed(fits), 1):
            state, losses[fits[fit]] = fit.result()
            readers[fits[fit]].load_state_dict(state)
            if progress:
                progress("train cue readers", done, len(readers), losses[fits[fit]])
    *crossed, model.cues = (reader.eval() for reader in readers)
    accuracies = [accuracy(reader, halves[1 - n]) for n, reader in enumerate(crossed)]
    by_text = {text.text: crossed[1 - n] for n, part in enumerate(halves) for text in part}
    figures = {f"{name}_right": (accuracies[0][name] + accuracies[1][name]) / 2 for name in accuracies[0]}
    return lambda text: by_text.get(text, model.cues), figures


def _fit_reader(
    weights: Path | None, texts: Sequence[CueText], epochs: int, seed: tuple[int, int]
) -> tuple[dict[str, torch.Tensor], float]:
    """Train a cue reader in a process of its own; return its weights and last loss."""
    torch.set_num_threads(1)
    torch.manual_seed(seed[0] + seed[1])
    reader = _new_reader(load_posterior(weights))
    loss = fit_cues(reader, texts, epochs, np.random.default_rng(seed))
    return reader.state_dict(), loss


def _new_reader(model: PosteriorModel) -> CueReader:
    return CueReader(model.text_encoder, model.reader.tuned, model.config.frozen_layers)
