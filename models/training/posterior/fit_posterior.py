"""Training of the hint posterior: the hint reader on the grammar, then the likelihood on training towns."""

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch

from models.checkpoint import CONFIG_FILE, round_weights
from models.language.grammar.files import Grammar, load_grammar
from models.language.text_encoder import load_text_encoder
from models.posterior.distribution import RADIUS_MASSES
from models.posterior.likelihood import Likelihood
from models.posterior.locate import locate
from models.posterior.model import PosteriorConfig, PosteriorModel, load_posterior, save_posterior
from models.posterior.posterior import PositionEvidence
from models.sources.source import open_sources
from models.training.engine.devices import on_device
from models.training.engine.loop import Progress, pick_device, run_training
from models.training.posterior.cue_texts import load_training_texts
from models.training.posterior.fit_cues import EPOCHS, fit_cues
from models.training.posterior.fit_likelihood import SiteTexts, fit_likelihood
from models.training.posterior.fit_reader import ReadingSet, ReadingTask, reading_metrics
from models.training.posterior.training_sites import TrainingSite
from models.training.settings import TrainingConfig, settings_record

READER_TEXTS, READER_VALIDATION_TEXTS = 28_000, 500
FIT_TEXTS_PER_SITE, CALIBRATION_TEXTS_PER_SITE = 1200, 500
FIT_STEPS, CALIBRATION_STEPS = 400, 60
CALIBRATED_WEIGHTS = ("temper", "background")
TEMPER_SCALES = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4)  # candidate factors of `temper`
Columns = np.ndarray[tuple[int, int], np.dtype[np.float64]]

# "val" is new to the reader, which is less certain about it, as about the texts of users.
_FIT_WORDING: tuple[Grammar | None, ...] = (None, "train", "val")


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
    """Train, calibrate and save a posterior; the readers on `config.device`, the likelihood on the CPU.

    `data` are maps and data sets for the likelihood, `splits` the split for the fit and the additional split for the
    calibration (see `open_sources`), `out` gets model.safetensors and config.json. Other arguments are those of the
    reader's `run_training`. Returns validation metrics.

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
        training = ReadingSet(encoder, depth, "train", READER_TEXTS, config.seed)
        validation = ReadingSet(encoder, depth, "val", READER_VALIDATION_TEXTS, config.seed + 1)
        task = ReadingTask(trained.reader, training, validation, config.batch_size)
        record = settings_record(trained.method, model, config)
        history = run_training(task, config, run_dir, resume, progress, record=record)
        round_weights(trained)  # as `refit_posterior` loads it
        fit_cues(trained.cues, load_training_texts(), EPOCHS, np.random.default_rng(config.seed))
    return fit_and_save(trained, validation, data, splits, out, config, history.best_step)


def refit_posterior(
    reader: Path, data: Sequence[Path], splits: tuple[str, str], out: Path, config: TrainingConfig
) -> dict[str, float]:
    """Fit and calibrate a new likelihood for a trained reader, and save both.

    `reader` is the directory of its weights, and may be `out`. Of `config`, only the seed is used. Other arguments and
    result as `train_posterior`.

    Raises:
        WeightsError: the reader cannot be loaded.
        MapError, DataError: see `open_sources`.
    """
    trained = load_posterior(reader)
    trained.likelihood = Likelihood()
    validation = ReadingSet(
        trained.text_encoder, trained.config.frozen_layers, "val", READER_VALIDATION_TEXTS, config.seed + 1
    )
    record = json.loads((reader / CONFIG_FILE).read_text())["training"]
    places = {name: record[name] for name in ("places",) if name in record}
    return fit_and_save(trained, validation, data, splits, out, config, record["best_step"], places)


def fit_and_save(
    trained: PosteriorModel,
    validation: ReadingSet,
    data: Sequence[Path],
    splits: tuple[str, str],
    out: Path,
    config: TrainingConfig,
    best_step: int,
    facts: Mapping[str, Any] | None = None,
) -> dict[str, float]:
    """Fit, calibrate and save a likelihood for a trained reader; arguments and result as `train_posterior`.

    `facts` are the training records of unchanged parts.
    """
    trained.eval()
    rng = np.random.default_rng(config.seed)
    sites = [[TrainingSite.from_source(source) for source in open_sources(path, splits)] for path in data]
    loss = fit_near_factor(trained, [site for site, _ in sites], rng)
    measured = calibrate_near_factor(trained, [site for both in sites for site in both], rng)
    metrics = reading_metrics(trained.reader, validation) | measured
    record: dict[str, Any] = {
        "config": config.model_dump(mode="json"),
        "data": [path.resolve().name for path in data],
        "best_step": best_step,
        "lexicon_sha256": trained.matcher.lexicon.sha256,
        "surprise": loss,
        "validation": metrics,
        **(facts or {}),
    }
    save_posterior(trained, out, record)
    return metrics


def fit_near_factor(model: PosteriorModel, sites: Sequence[TrainingSite], rng: np.random.Generator) -> float:
    """Fit the likelihood of a model in place; return the mean loss at the end."""
    texts = [_texts(model, site, FIT_TEXTS_PER_SITE, rng) for site in sites]
    last = [0.0]
    fit_likelihood(model.likelihood, texts, FIT_STEPS, rng, lambda _done, _steps, loss: last.append(loss))
    return last[-1]


def calibrate_near_factor(
    model: PosteriorModel, sites: Sequence[TrainingSite], rng: np.random.Generator
) -> dict[str, float]:
    """Calibrate probabilities and radii on new texts, and return the metrics of these.

    The sites include those of the fit, because their maps are as large as maps in service.
    """
    texts = [_texts(model, site, CALIBRATION_TEXTS_PER_SITE, rng) for site in sites]
    for name, parameter in model.likelihood.named_parameters():
        parameter.requires_grad_(name in CALIBRATED_WEIGHTS)
    fit_likelihood(model.likelihood, texts, CALIBRATION_STEPS, rng)
    for parameter in model.likelihood.parameters():
        parameter.requires_grad_(True)
    _calibrate_temper(model.likelihood, texts)
    error, share, hit, _ = np.concatenate([_outcomes(model.likelihood, part) for part in texts]).T
    half, most = (float(mass) for mass in np.quantile(share, RADIUS_MASSES).clip(0.01, 0.999))
    model.config = model.config.model_copy(update={"radius_held": (half, most)})
    metrics = {"recall@1": float(hit.mean()), "within_5m": float((error <= 5).mean())}
    return metrics | {"held_p50": half, "held_p90": most}


def _calibrate_temper(likelihood: Likelihood, texts: Sequence[SiteTexts]) -> None:
    """Scale `temper` so that the mean probability of the best cell matches its hit rate."""
    fitted = likelihood.temper.detach().clone()
    gaps = []
    with torch.no_grad():
        for scale in TEMPER_SCALES:
            likelihood.temper.copy_(fitted + np.log(scale))
            means = [_outcomes(likelihood, part).mean(axis=0) for part in texts]
            gaps.append(sum(abs(mean[3] - mean[2]) for mean in means))
        likelihood.temper.copy_(fitted + np.log(TEMPER_SCALES[int(np.argmin(gaps))]))


def _texts(model: PosteriorModel, site: TrainingSite, count: int, rng: np.random.Generator) -> SiteTexts:
    rows = rng.choice(len(site.hints), min(count, len(site.hints)), replace=False)
    return SiteTexts(site, rows, site.read(model, rows, _FIT_WORDING, rng))


def _outcomes(likelihood: Likelihood, texts: SiteTexts) -> Columns:
    """Return [Q, 4]: error, mass within that radius, whether the best cell is the true one, its probability."""
    site, posterior = texts.site, texts.site.posterior(likelihood)
    scenes = np.array(site.cells.scenes)
    outcomes = []
    for row, hints in zip(texts.rows, texts.bound_hints, strict=True):
        located = locate(posterior, PositionEvidence(hints))
        assert located is not None
        same = scenes[located.rows[0]] == scenes[site.truth[row]]
        error = float(np.linalg.norm(located.positions[0] - site.positions_m[row])) if same else np.inf
        is_first = float(located.rows[0] == site.truth[row])
        outcomes.append((error, located.share_within(error), is_first, located.probability[0]))
    return np.array(outcomes)
