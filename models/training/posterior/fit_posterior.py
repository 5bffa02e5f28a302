"""Training the hint posterior: the reader on the paraphrase grammar, then the likelihood on training towns."""

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch

from models.checkpoint import CONFIG_FILE, round_weights
from models.language.grammar.files import Grammar, load_grammar
from models.language.text_encoder import load_text_encoder
from models.posterior.distribution import TOLD
from models.posterior.likelihood import Likelihood
from models.posterior.locate import locate
from models.posterior.model import PosteriorConfig, PosteriorModel, load_posterior, save_posterior
from models.sources.source import open_sources
from models.training.engine.devices import on_device
from models.training.engine.loop import Progress, pick_device, run_training
from models.training.posterior.cue_texts import labelled_texts
from models.training.posterior.fit_cues import EPOCHS, fit_cues
from models.training.posterior.fit_likelihood import Texts, fit_likelihood
from models.training.posterior.fit_reader import ReadingSet, ReadingTask, reading_figures
from models.training.posterior.training_sites import Place
from models.training.settings import TrainingConfig, settings_record

TEXTS, VALIDATION_TEXTS = 28_000, 500  # that the reader is trained on, and chosen by
FITTED_TEXTS, CALIBRATED_TEXTS = 1200, 500  # of each place
FIT_STEPS, CALIBRATION_STEPS = 400, 60
CALIBRATED = ("temper", "background")  # weights that validation places decide
TEMPERS = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4)  # what `temper` is scaled with
Columns = np.ndarray[tuple[int, int], np.dtype[np.float64]]

_FIT_WORDING: tuple[Grammar | None, ...] = (
    None,
    "train",
    "val",
)  # the reader is less sure of itself where it was not trained


def train_posterior(
    data: Sequence[Path],
    splits: tuple[str, str],
    out: Path,
    model: PosteriorConfig,
    config: TrainingConfig,
    run_dir: Path | None = None,
    resume: bool = False,
    progress: Callable[[Progress], None] | None = None,
) -> dict[str, float]:
    """Train, calibrate on validation places, save; the readers on `config.device`, the likelihood on the CPU.

    Args:
        data: maps and data sets, see `open_sources`; nothing of them is needed to train the reader.
        splits: what the likelihood is fitted to, and what it is calibrated on.
        out: directory for model.safetensors and config.json.
        model: shape of the reader.
        config: how to train it.
        run_dir: as `run_training`, for the reader.
        resume: as `run_training`.
        progress: called at every step of the reader.

    Returns:
        Figures on validation.

    Raises:
        TrainingError: see `run_training`.
        MapError, DataError: see `open_sources`.
    """
    torch.manual_seed(config.seed)
    encoder = load_text_encoder(model.text_encoder)
    model = model.model_copy(update={"grammar_sha256": load_grammar("train").sha256})
    trained = PosteriorModel(encoder, model)
    depth = model.frozen_layers
    with on_device(pick_device(config.device), encoder, trained):
        training = ReadingSet(encoder, depth, "train", TEXTS, config.seed)
        validation = ReadingSet(encoder, depth, "val", VALIDATION_TEXTS, config.seed + 1)
        task = ReadingTask(trained.reader, training, validation, config.batch_size)
        record = settings_record(trained.method, model, config)
        history = run_training(task, config, run_dir, resume, progress, record=record)
        round_weights(trained)  # as `refit_posterior` reads it
        fit_cues(trained.cues, labelled_texts(), EPOCHS, np.random.default_rng(config.seed))
    return fit_and_save(trained, validation, data, splits, out, config, history.best_step)


def refit_posterior(
    reader: Path, data: Sequence[Path], splits: tuple[str, str], out: Path, config: TrainingConfig
) -> dict[str, float]:
    """Fit and calibrate a new likelihood for a reader that is trained, save both; what `train_posterior` does after it.

    Args:
        reader: directory of weights with it.
        data: as `train_posterior`.
        splits: as there.
        out: as there; may be the same directory.
        config: its seed is all that counts.

    Returns:
        Figures on validation.

    Raises:
        WeightsError: the reader cannot be loaded.
        MapError, DataError: see `open_sources`.
    """
    trained = load_posterior(reader)
    trained.likelihood = Likelihood()
    validation = ReadingSet(
        trained.text_encoder, trained.config.frozen_layers, "val", VALIDATION_TEXTS, config.seed + 1
    )
    record = json.loads((reader / CONFIG_FILE).read_text())["training"]
    kept = {name: record[name] for name in ("places",) if name in record}
    return fit_and_save(trained, validation, data, splits, out, config, record["best_step"], kept)


def fit_and_save(
    trained: PosteriorModel,
    validation: ReadingSet,
    data: Sequence[Path],
    splits: tuple[str, str],
    out: Path,
    config: TrainingConfig,
    best_step: int,
    kept: Mapping[str, Any] | None = None,
) -> dict[str, float]:
    """What is left to do when the reader is trained; arguments and return as `train_posterior`.

    `kept` is what is known of the training of parts that stay as they are.
    """
    trained.eval()
    rng = np.random.default_rng(config.seed)
    places = [[Place.of(source) for source in open_sources(path, splits)] for path in data]
    fitted = fit_places(trained, [of_fit for of_fit, _ in places], rng)
    measured = calibrate_places(trained, [place for both in places for place in both], rng)
    figures = reading_figures(trained.reader, validation) | measured
    facts: dict[str, Any] = {
        "config": config.model_dump(mode="json"),
        "data": [path.resolve().name for path in data],
        "best_step": best_step,
        "lexicon_sha256": trained.matcher.lexicon.sha256,
        "surprise": fitted,
        "validation": figures,
        **(kept or {}),
    }
    save_posterior(trained, out, facts)
    return figures


def fit_places(model: PosteriorModel, places: Sequence[Place], rng: np.random.Generator) -> float:
    """Fit the likelihood to places, in place; the mean surprise at the end."""
    texts = [_texts(model, place, FITTED_TEXTS, rng) for place in places]
    last = [0.0]
    fit_likelihood(model.likelihood, texts, FIT_STEPS, rng, lambda _done, _steps, loss: last.append(loss))
    return last[-1]


def calibrate_places(model: PosteriorModel, places: Sequence[Place], rng: np.random.Generator) -> dict[str, float]:
    """Fit what makes probabilities and radii honest, to texts that nothing was fitted to; figures of these.

    Places are those that nothing was fitted to, and those that something was: their maps are as large as in service.
    """
    texts = [_texts(model, place, CALIBRATED_TEXTS, rng) for place in places]
    for name, parameter in model.likelihood.named_parameters():
        parameter.requires_grad_(name in CALIBRATED)
    fit_likelihood(model.likelihood, texts, CALIBRATION_STEPS, rng)
    for parameter in model.likelihood.parameters():
        parameter.requires_grad_(True)
    _temper(model.likelihood, texts)
    error, share, hit, _ = _all_answers(model.likelihood, texts)
    half, most = (float(held) for held in np.quantile(share, TOLD).clip(0.01, 0.999))
    model.config = model.config.model_copy(update={"radius_held": (half, most)})
    figures = {"recall@1": float(hit.mean()), "within_5m": float((error <= 5).mean())}
    return figures | {"held_p50": half, "held_p90": most}


def _temper(likelihood: Likelihood, texts: Sequence[Texts]) -> None:
    """Scale `temper` so that the probability of the best cell is honest: what is claimed, and how often it is true."""
    fitted = likelihood.temper.detach().clone()
    gaps = []
    with torch.no_grad():
        for scale in TEMPERS:
            likelihood.temper.copy_(fitted + np.log(scale))
            means = [_answers(likelihood, part).mean(axis=0) for part in texts]
            gaps.append(sum(abs(mean[3] - mean[2]) for mean in means))
        likelihood.temper.copy_(fitted + np.log(TEMPERS[int(np.argmin(gaps))]))


def _texts(model: PosteriorModel, place: Place, count: int, rng: np.random.Generator) -> Texts:
    rows = rng.choice(len(place.hints), min(count, len(place.hints)), replace=False)
    return Texts(place, rows, place.read(model, rows, _FIT_WORDING, rng))


def _all_answers(likelihood: Likelihood, texts: Sequence[Texts]) -> Columns:
    """[4, Q] of `_answers`, of all texts."""
    return np.concatenate([_answers(likelihood, part) for part in texts]).T


def _answers(likelihood: Likelihood, texts: Texts) -> Columns:
    """[Q, 4] error, mass of the circle with that radius, whether the best cell is the first, its probability."""
    place, posterior = texts.place, texts.place.posterior(likelihood)
    scenes = np.array(place.cells.scenes)
    found = []
    for row, reading in zip(texts.rows, texts.readings, strict=True):
        located = locate(posterior, reading)
        assert located is not None
        same = scenes[located.rows[0]] == scenes[place.truth[row]]
        error = float(np.linalg.norm(located.positions[0] - place.positions_m[row])) if same else np.inf
        is_first = float(located.rows[0] == place.truth[row])
        found.append((error, located.share_within(error), is_first, located.probability[0]))
    return np.array(found)
