import json

import pytest
import torch

from models.posterior.model import load_posterior
from models.training.posterior import train_places as train_places_module
from models.training.posterior.train_places import train_places
from tests.models.training.in_process import InProcess

TEXTS = {
    "I'm at East Street 2 and North Path 3": (60.00215, 25.0032),
    "on East Street 1, North Path 2 is on my left": (60.0016, 25.0030),
    "East Street 2 is behind me, a bench ahead": (60.0022, 25.0010),
    "just off North Path 1, near East Street 3": (60.0026, 25.0011),
}


@pytest.mark.slow
def test_readers_and_kernels_are_trained_and_saved(osm_file, tmp_path, monkeypatch) -> None:
    """Three readers, one of them for what answers; the kernels are fitted to the texts."""
    monkeypatch.setattr(train_places_module, "ProcessPoolExecutor", InProcess)
    monkeypatch.setattr(train_places_module, "LABELLED_DIR", tmp_path)
    monkeypatch.setattr(train_places_module, "EPOCHS", 1)
    mention = {"start": 0, "end": 5, "form": "thing", "relation": "seen", "angle": 90}
    for name in ("real_places", "invented", "meeting"):
        rows = [{"text": f"bank{n} on my right", "mentions": [mention]} for n in range(4)]
        (tmp_path / f"{name}.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
    texts, out = tmp_path / "said.jsonl", tmp_path / "weights"
    rows_of_texts: list[dict[str, object]] = [
        {"id": n, "text": text, "goal": goal} for n, (text, goal) in enumerate(TEXTS.items())
    ]
    meeting = {"text": "Meet me on East Street 3, north of you", "goal": [60.0027, 25.002], "start": [60.001, 25.002]}
    rows_of_texts += [{"id": n, **meeting} for n in (8, 9)]
    texts.write_text("".join(json.dumps(row) + "\n" for row in rows_of_texts))
    done: list[tuple[str, int, int, float]] = []
    figures = train_places([(osm_file, [texts])], None, out, 2, 0, lambda *row: done.append(row))
    assert 0.0 <= figures["angle_right"] <= 1.0
    assert [row[1:3] for row in done if row[0] == "train cue readers"] == [(1, 3), (2, 3), (3, 3)]
    before, after = load_posterior(), load_posterior(out)
    assert not torch.equal(before.places.scale, after.places.scale)
    assert not torch.equal(before.cues.head[0].weight, after.cues.head[0].weight)
    assert torch.equal(before.likelihood.temper, after.likelihood.temper), "the rest is kept"
    assert json.loads((out / "config.json").read_text())["training"]["places"]["steps"] == 2
