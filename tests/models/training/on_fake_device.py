"""All training and measuring on a device that does not mix with the CPU; test_devices.py runs it in its own process."""

import json
import sys
import traceback
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import nn
from torch.nn.utils.rnn import pack_padded_sequence

from index.evaluation.reproduction import jobs
from index.evaluation.reproduction.jobs import ReproductionJob
from models.language.text_encoder import load_text_encoder
from models.paper import point_encoder
from models.paper.checkpoint import METHODS, load_retriever, save_retriever
from models.paper.fine.checkpoint import FINE_METHODS, load_fine, save_fine
from models.paper.instance_encoder import DEFAULT_INPUTS, PAPER_INPUTS, Input
from models.paper.point_encoder import PointLayers
from models.posterior.model import PosteriorConfig, PosteriorModel, load_posterior
from models.sources.source import open_source
from models.training import fit_fine, fit_points, fit_retriever, validation
from models.training.engine import loop
from models.training.engine.devices import on_device
from models.training.experiments import TrainingRun, TrainingScale
from models.training.paper_tables import MNCL
from models.training.posterior import fit_posterior
from models.training.posterior.fit_reader import ReadingSet
from models.training.settings import TrainingConfig
from models.training.training_data import TrainingCells, TrainingData
from tests.encoding import encode_descriptions
from tests.models.training.fake_device import FAKE, Away

CPU = torch.device("cpu")
# Every method, and one of each family with the paper's inputs, which take a point encoder.
MODELS = {method: (method, DEFAULT_INPUTS) for method in (*METHODS, *FINE_METHODS)} | {
    f"{method}-points": (method, PAPER_INPUTS) for method in ("mncl", "matching")
}
CONFIG = TrainingConfig(steps=1, batch_size=8, spacing_m=30.0)
SMALL: dict[Any, dict[str, Any]] = {
    fit_points: {"load_settings": lambda *_: (None, CONFIG), "TRAINING_CELLS_PER_SOURCE": 10,
        "VALIDATION_CELLS_PER_SOURCE": 10},
    point_encoder: {"ARCHITECTURES": {
        "small": PointLayers(((8, 0.2, 4, (32, 64)), (4, 0.4, 4, (64, 128))), (128, 256), (), "part"),
        "official": PointLayers(((8, 0.2, 4, (32,)), (4, 0.4, 4, (32,))), (32,), (256,), "cell"),
    }},
    validation: {"CALIBRATION_QUERIES": 8},
    fit_posterior: {
        "READER_TEXTS": 33, "READER_VALIDATION_TEXTS": 9, "FIT_TEXTS_PER_SITE": 2, "CALIBRATION_TEXTS_PER_SITE": 2,
        "FIT_STEPS": 1, "CALIBRATION_STEPS": 1, "EPOCHS": 1,
    },
}  # fmt: skip


def load(sources: Any, encoder: Any, rng: np.random.Generator) -> list[TrainingData]:
    assert next(encoder.parameters()).device == FAKE, "frozen features are computed on the device"
    data = TrainingData.from_sources(*sources, encoder, CONFIG, rng)
    assert data.training.vocabulary.mask.device == CPU, "and kept on the CPU"
    return [replace(data, queries=data.queries.take(np.arange(8)))]


def retriever(sources: Any, method: str, inputs: tuple[Input, ...], out: Path) -> None:
    config = METHODS[method].config_type(width=32, inputs=inputs)
    fit_retriever.train_retriever(partial(load, sources), out, METHODS[method], config, CONFIG)
    assert encode_descriptions(load_retriever(out), [["A tree is north of me."]]).shape == (1, 32)


def fine(sources: Any, method: str, inputs: tuple[Input, ...], out: Path) -> None:
    """Train a fine stage; the one that takes points is resumed, too."""
    config = FINE_METHODS[method].config_type(width=32, inputs=inputs)
    for resume in (False, True) if inputs == PAPER_INPUTS else (False,):
        fit_fine.train_fine(partial(load, sources), out, method, config, CONFIG, out / "run", resume)
    assert load_fine(out).error_m


def trained_points(sources: Any, out: Path) -> None:
    """A point encoder that is trained with the retriever."""
    options = {"inputs": PAPER_INPUTS, "point_encoder": "official", "points_frozen": False, "point_relations": True}
    config = METHODS["mncl"].config_type(width=32, **options)
    fit_retriever.train_retriever(partial(load, sources), out, METHODS["mncl"], config, CONFIG)


def shared_points(sources: Any, out: Path) -> None:
    """A point encoder that was made before."""
    fit_points.train_points([TrainingCells.from_sources(*sources)], out / "points", CONFIG)
    given = CONFIG.model_copy(update={"points": out / "points"})
    config = METHODS["text2loc"].config_type(width=32, inputs=PAPER_INPUTS)
    fit_retriever.train_retriever(partial(load, sources), out, METHODS["text2loc"], config, given)


def measuring(sources: Any, osm_file: Path, out: Path) -> None:
    """Growth, rankings and localization of a reproduction, as far as models are asked."""
    scale = TrainingScale(("model.width=32",), ("model.width=32",), (60.0, 120.0))
    job, fine_job = (ReproductionJob(run, 0, osm_file, out, scale, "key") for run in (MNCL, TrainingRun("regressor")))
    encoder, record = load_text_encoder(), {"sources": [{"validation": {"retrieval": {}}}]}
    save_retriever(METHODS["mncl"](encoder, job.settings()[0]), job.directory / jobs.WEIGHTS_DIR, record)
    save_fine(FINE_METHODS["regressor"](encoder, fine_job.settings()[0]), fine_job.directory / jobs.WEIGHTS_DIR, record)
    few = [source.queries().take(np.arange(0, len(source.queries()), 5)) for source in sources]
    parts = [(source.data, replace(queries, hints=None)) for source, queries in zip(sources, few, strict=True)]
    jobs.open_queries = lambda _, *splits: iter(parts[: len(splits)])
    assert jobs._measure_retriever(job, job.directory / jobs.WEIGHTS_DIR)["growth"]
    jobs.localize(job, fine_job, None)
    jobs.measure_reranked(job, fine_job, None)
    assert jobs.read_localization(job, fine_job)


def posterior(sources: Any, out: Path) -> None:
    """The reader of hints and that of cues; the likelihood on the CPU."""
    labelled = fit_posterior.load_training_texts()[:16]
    given = {"load_training_texts": lambda: labelled, "PosteriorModel": with_names, "open_sources": lambda *_: sources}
    given["ReadingSet"] = reading_set
    for name, value in given.items():
        setattr(fit_posterior, name, value)
    fit_posterior.train_posterior([Path("town")], ("train", "val"), out, PosteriorConfig(width=32), CONFIG)
    assert load_posterior(out).reader.read(["A tree is north of me."])


def with_names(encoder: Any, config: PosteriorConfig) -> PosteriorModel:
    """An untrained model with the vectors of names that ship, which take seconds to make."""
    model = PosteriorModel(encoder, config)
    model.matcher.load_state_dict(load_posterior().matcher.state_dict())
    return model


def reading_set(*given: Any) -> ReadingSet:
    made = ReadingSet(*given)
    assert {values.device for values in made._values} == {CPU}
    return made


def device() -> None:
    """The fake device accepts and refuses the same operations as a GPU."""
    here, there, row = torch.ones(3, 4), torch.ones(3, 4).to(FAKE), torch.tensor([0])
    refused: list[Callable[[], Any]] = [
        lambda: here + there,
        lambda: there[0, 0] + here,
        lambda: here[row.to(FAKE)],
        lambda: torch.cat([here, there]),
        lambda: torch.stack([here[0, 0], there[0, 0]]),
        lambda: there.masked_fill(here > 0, 0.0),
        lambda: there.index_add(0, row, there[:1]),
        lambda: there.__setitem__(row, here[:1]),
        lambda: torch.zeros(()).add_(there[0, 0]),
        lambda: nn.functional.embedding(row, there),
        there.numpy,
        lambda: pack_padded_sequence(there[None], torch.tensor([3]).to(FAKE), batch_first=True),
    ]
    for n, mixed in enumerate(refused):
        try:
            mixed()
        except RuntimeError:
            continue
        raise AssertionError(f"number {n} of what mixes devices passes")
    there[row] = torch.tensor(2.0)
    assert (there[row] * torch.tensor(3.0)).tolist() == [[6.0] * 4]


def lending() -> None:
    """Modules come back to the CPU, also after an error."""
    module = nn.Linear(2, 2)
    try:
        with on_device(FAKE, module):
            assert module.weight.device == FAKE
            raise KeyboardInterrupt
    except KeyboardInterrupt:
        assert module.weight.device == CPU
    encoder = load_text_encoder()
    with on_device(FAKE, encoder):
        assert encoder.read(["A tree."], 1)[0].mask.device == FAKE
    assert encoder.read(["A tree."], 1)[0].mask.device == CPU, "it remembers what it read last"


def tried(run: Callable[[], None]) -> str:
    """Return the traceback of an error, if there is one."""
    before, encoder = Away.made, load_text_encoder()
    try:
        run()
        assert run in (device, lending) or Away.made > before + 1000, "it was trained on the CPU"
        assert next(encoder.parameters()).device == CPU, "others in this process use the text encoder"
    except Exception:
        return traceback.format_exc()
    finally:
        encoder.to(CPU)
    return ""


def main(osm_file: Path, out: Path) -> None:
    """Run everything; out/report.json says of each what went wrong."""
    for module in (loop, fit_retriever, fit_fine, fit_points, fit_posterior, jobs):
        module.pick_device = lambda wanted: CPU if wanted == "cpu" else FAKE
    for module, values in SMALL.items():
        for name, value in values.items():
            setattr(module, name, value)
    sources = [open_source(osm_file, split) for split in ("train", "val")]
    cases: dict[str, Callable[[], None]] = {"device": device, "lending": lending}
    for name, (method, inputs) in MODELS.items():
        train = retriever if method in METHODS else fine
        cases[name] = partial(train, sources, method, inputs, out / name)
    cases["trained-points"] = partial(trained_points, sources, out / "trained-points")
    cases["points"] = partial(shared_points, sources, out / "points")
    cases["measuring"] = partial(measuring, sources, osm_file, out / "measuring")
    cases["posterior"] = partial(posterior, sources, out / "posterior")
    (out / "report.json").write_text(json.dumps({name: tried(run) for name, run in cases.items()}))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
