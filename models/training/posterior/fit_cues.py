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
from models.training.posterior.cue_texts import CueText, augment, collect_names

EPOCHS: Final = 12
TEXTS_PER_BATCH: Final = 16
BATCHES_PER_SORT: Final = 16  # batches whose texts are sorted by length together
LOW_RANK_LEARNING_RATE, HEAD_LEARNING_RATE = 1e-3, 2e-3
WARM_UP_STEPS: Final = 40
LABEL_SMOOTHING: Final = 0.03
RELATION_WEIGHT, FLAG_WEIGHT = 0.6, 0.3  # in the loss, relative to the angle
MAX_ANGLE_ERROR_DEG: Final = 30.0  # of an angle that counts as correct


def fit_cues(
    reader: CueReader,
    texts: Sequence[CueText],
    epochs: int,
    rng: np.random.Generator,
    progress: Callable[[int, int, float], None] | None = None,
) -> float:
    """Train an untrained cue reader in place, and return the mean loss of the last epoch.

    `rng` draws the order of the texts and their augmentation; `progress` is called with (steps done, steps, mean loss).
    """
    if not texts:
        raise TrainingError("no labelled texts")
    low = [*reader.down, *reader.up]
    high = [*reader.mark.parameters(), *reader.head.parameters()]
    optimizer = torch.optim.AdamW(
        [{"params": low, "rate": LOW_RANK_LEARNING_RATE}, {"params": high, "rate": HEAD_LEARNING_RATE}],
        weight_decay=0.01,
    )
    reader.train()
    batches, names = -(-len(texts) // TEXTS_PER_BATCH), collect_names(texts)
    losses: list[float] = []
    for epoch in range(epochs):
        for n, rows in enumerate(_batches(texts, rng)):
            step = epoch * batches + n
            for group in optimizer.param_groups:
                group["lr"] = (
                    group["rate"] * min(1.0, (step + 1) / WARM_UP_STEPS) * max(0.02, 1 - step / (epochs * batches))
                )
            loss = _loss(reader, [augment(texts[row], names, rng) for row in rows])
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
    """Yield batches of all texts in random order, with texts of similar length together to save padding."""
    order = rng.permutation(len(texts))
    length = np.array([len(text.text) for text in texts])
    groups = [
        order[start : start + BATCHES_PER_SORT * TEXTS_PER_BATCH]
        for start in range(0, len(order), BATCHES_PER_SORT * TEXTS_PER_BATCH)
    ]
    order = np.concatenate([rows[np.argsort(length[rows], kind="stable")] for rows in groups])
    starts = np.arange(0, len(order), TEXTS_PER_BATCH)
    for start in rng.permutation(starts):
        yield order[start : start + TEXTS_PER_BATCH]


def _loss(reader: CueReader, texts: Sequence[CueText]) -> Tensor:
    tokens, characters = reader.encode([text.text for text in texts])
    tokens_of = [
        [(mention, token_span(offsets, mention.start, mention.end)) for mention in text.mentions]
        for text, offsets in zip(texts, characters, strict=True)
    ]
    spans = [[(*span, mention.form) for mention, span in of_text if span is not None] for of_text in tokens_of]
    mentions = [mention for of_text in tokens_of for mention, span in of_text if span is not None]
    angle, relation, flags = reader(tokens, spans)
    tensor = partial(torch.tensor, device=flags.device)
    meant = tensor([mention.is_meant for mention in mentions])
    true_flags = tensor([[mention.has_wind, mention.is_meant] for mention in mentions]).float()
    if not mentions:
        return flags.sum()
    cross = nn.functional.cross_entropy
    total: Tensor = cross(angle, tensor([mention.angle for mention in mentions]), label_smoothing=LABEL_SMOOTHING)
    if bool(meant.any()):
        rows = tensor([mention.relation for mention in mentions])
        total = total + RELATION_WEIGHT * cross(relation[meant], rows[meant], label_smoothing=LABEL_SMOOTHING)
    flagged = nn.functional.binary_cross_entropy_with_logits(flags, true_flags)
    return total + FLAG_WEIGHT * flagged


def accuracy(reader: CueReader, texts: Sequence[CueText]) -> dict[str, float]:
    """Return the shares of correct mentions: "angle" (None, or within 30 degrees), "relation", each of FLAGS."""
    correct = dict.fromkeys(("angle", "relation", *FLAGS), 0)
    count = 0
    for text in texts:
        meant = [mention for mention in text.mentions if mention.is_meant]
        read = reader.read(text.text, [(mention.start, mention.end, FORMS[mention.form]) for mention in meant])
        for mention, cue in zip(meant, read, strict=True):
            angle = ANGLES[mention.angle]
            correct["angle"] += _is_near(angle, cue.angle)
            correct["relation"] += RELATIONS[mention.relation] == cue.relation
            correct["wind"] += mention.has_wind == cue.has_wind
            correct["meant"] += cue.is_meant
            count += 1
    return {name: value / max(1, count) for name, value in correct.items()}


def _is_near(one: float | None, other: float | None) -> bool:
    if one is None or other is None:
        return one is other
    return abs((one - other + 180.0) % 360.0 - 180.0) <= MAX_ANGLE_ERROR_DEG
