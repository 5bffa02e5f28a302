"""Train the cue reader on labelled texts (docs/method.md, fitting)."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Final

import numpy as np
import torch
from torch import Tensor, nn

from models.citymap.points import Ints
from models.errors import TrainingError
from models.language.mentions.cue_reader import ANGLES, FLAGS, FORMS, RELATIONS, CueReader, token_span
from models.training.posterior.cue_texts import CueText, names_of, varied

EPOCHS: Final = 12
BATCH: Final = 16
DRAWN: Final = 16  # batches that are sorted by length together
RATE, HEAD_RATE = 1e-3, 2e-3
WARM_UP: Final = 40  # steps
SMOOTHING: Final = 0.03  # of labels
RELATION_WEIGHT, FLAG_WEIGHT = 0.6, 0.3
NEAR: Final = 30.0  # degrees: read right


def fit_cues(
    reader: CueReader,
    texts: Sequence[CueText],
    epochs: int,
    rng: np.random.Generator,
    progress: Callable[[int, int, float], None] | None = None,
) -> float:
    """Train a reader of cues, in place.

    Args:
        reader: as it was made, on any device, with what it stands on.
        texts: labelled.
        epochs: over all texts.
        rng: draws their order, and what is changed in them.
        progress: called with (steps done, steps, mean loss).

    Returns:
        The mean loss of the last epoch.
    """
    if not texts:
        raise TrainingError("no labelled texts")
    low = [*reader.down, *reader.up]
    high = [*reader.mark.parameters(), *reader.head.parameters()]
    optimizer = torch.optim.AdamW(
        [{"params": low, "rate": RATE}, {"params": high, "rate": HEAD_RATE}], weight_decay=0.01
    )
    reader.train()
    batches, names = -(-len(texts) // BATCH), names_of(texts)
    losses: list[float] = []
    for epoch in range(epochs):
        for n, rows in enumerate(_batches(texts, rng)):
            step = epoch * batches + n
            for group in optimizer.param_groups:
                group["lr"] = group["rate"] * min(1.0, (step + 1) / WARM_UP) * max(0.02, 1 - step / (epochs * batches))
            loss = _loss(reader, [varied(texts[row], names, rng) for row in rows])
            optimizer.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_([*low, *high], 1.0)
            optimizer.step()
            losses.append(loss.item())
            if progress:
                progress(step + 1, epochs * batches, float(np.mean(losses[-batches:])))
    reader.eval()
    return float(np.mean(losses[-batches:]))


def _batches(texts: Sequence[CueText], rng: np.random.Generator) -> Iterator[Ints]:
    """All texts once, at random; those of like length together, as what is padded costs time."""
    order = rng.permutation(len(texts))
    length = np.array([len(text.text) for text in texts])
    some = [order[start : start + DRAWN * BATCH] for start in range(0, len(order), DRAWN * BATCH)]
    order = np.concatenate([rows[np.argsort(length[rows], kind="stable")] for rows in some])
    starts = np.arange(0, len(order), BATCH)
    for start in rng.permutation(starts):
        yield order[start : start + BATCH]


def _loss(reader: CueReader, texts: Sequence[CueText]) -> Tensor:
    tokens, characters = reader.encode([text.text for text in texts])
    at = [
        [(item, token_span(where, item.start, item.end)) for item in text.items]
        for text, where in zip(texts, characters, strict=True)
    ]
    spans = [[(*span, item.form) for item, span in some if span is not None] for some in at]
    items = [item for some in at for item, span in some if span is not None]
    angle, relation, flags = reader(tokens, spans)
    tensor = partial(torch.tensor, device=flags.device)
    meant = tensor([item.is_meant for item in items])
    told = tensor([[item.has_wind, item.is_meant] for item in items]).float()
    if not items:
        none: Tensor = flags.sum()
        return none
    cross = nn.functional.cross_entropy
    total: Tensor = cross(angle, tensor([item.angle for item in items]), label_smoothing=SMOOTHING)
    if bool(meant.any()):
        rows = tensor([item.relation for item in items])
        total = total + RELATION_WEIGHT * cross(relation[meant], rows[meant], label_smoothing=SMOOTHING)
    flagged = nn.functional.binary_cross_entropy_with_logits(flags, told)
    loss: Tensor = total + FLAG_WEIGHT * flagged
    return loss


def accuracy(reader: CueReader, texts: Sequence[CueText]) -> dict[str, float]:
    """Shares of mentions read right: "angle" (told or not, and within 30 degrees), "relation", each of FLAGS."""
    right = dict.fromkeys(("angle", "relation", *FLAGS), 0)
    count = 0
    for text in texts:
        meant = [item for item in text.items if item.is_meant]
        read = reader.read(text.text, [(item.start, item.end, FORMS[item.form]) for item in meant])
        for item, cue in zip(meant, read, strict=True):
            angle = ANGLES[item.angle]
            right["angle"] += _is_near(angle, cue.angle)
            right["relation"] += RELATIONS[item.relation] == cue.relation
            right["wind"] += item.has_wind == cue.has_wind
            right["meant"] += cue.is_meant
            count += 1
    return {name: value / max(1, count) for name, value in right.items()}


def _is_near(one: float | None, other: float | None) -> bool:
    if one is None or other is None:
        return one is other
    return abs((one - other + 180.0) % 360.0 - 180.0) <= NEAR
