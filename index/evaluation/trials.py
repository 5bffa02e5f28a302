"""The trials of the robustness evaluation: harder descriptions and outdated maps."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from models.citymap.gallery import MapData
from models.citymap.templates import TEMPLATES, render_hint
from models.citymap.types import DIRECTIONS, Direction, Hint
from models.language.grammar.labelled_text import LabelledText, ObjectFact
from models.language.grammar.typos import typos
from models.language.grammar.wording import Wording

TEMPLATE_TEXT, FREE_WORDING = CANDIDATE_TRIALS = ("template text", "free wording, unseen grammar")
INVERSE_TEMPLATE = TEMPLATES.index("There is {a} {o} of me.")
Say = Callable[[tuple[Hint, ...], np.random.Generator], tuple[str, ...]]
Change = Callable[[tuple[Hint, ...], np.random.Generator], tuple[Hint, ...]]


@dataclass(frozen=True, slots=True)
class Trial:
    """One trial."""

    name: str
    say: Say  # turns a query's hints into sentences
    hints: int | None = None  # number of nearest objects to describe instead of the query's own hints
    dropped: float = 0.0  # shares of the map's instances that are missing, or have a wrong label
    relabelled: float = 0.0


def all_trials(data: MapData) -> list[Trial]:
    """Return all trials."""
    words = sorted(set(data.palette.words))
    free = Wording("test")
    trials = [Trial(TEMPLATE_TEXT, _say_template)]
    trials += [Trial(f"{n} hints", _say_in_templates(_random_hints(n))) for n in range(1, 6)]
    trials += [
        Trial("12 hints", _say_template, hints=12),
        Trial("one hint of six wrong", _say_in_templates(_with_one_wrong(words))),
        Trial("two colours of six wrong", _say_in_templates(_with_wrong_colours(words, 2))),
        Trial("hints in another order", _say_in_templates(_random_hints(None))),
        Trial("inverse phrasing", lambda hints, _rng: tuple(render_hint(hint, INVERSE_TEMPLATE) for hint in hints)),
        Trial(FREE_WORDING, lambda hints, rng: _text_lines(_write(free, hints, rng))),
        Trial("free wording, three typos", lambda hints, rng: _text_lines(typos(_write(free, hints, rng), 3, rng))),
    ]
    trials += [Trial(f"free wording, {n} hints", _say_freely(free, _random_hints(n))) for n in (2, 3, 4)]
    trials += [
        Trial(
            "free wording, 3 hints, no colours",
            _say_freely(free, lambda hints, rng: tuple(replace(h, colour=None) for h in _random_hints(3)(hints, rng))),
        ),
        Trial("free wording, one hint of six wrong", _say_freely(free, _with_one_wrong(words))),
    ]
    trials += [Trial(f"{share:.0%} of the instances gone", _say_template, dropped=share) for share in (0.1, 0.2)]
    trials += [Trial(f"{share:.0%} of the labels wrong", _say_template, relabelled=share) for share in (0.1, 0.2)]
    return trials


def _say_template(hints: tuple[Hint, ...], _rng: np.random.Generator) -> tuple[str, ...]:
    return tuple(render_hint(hint) for hint in hints)


def _say_in_templates(change: Change) -> Say:
    return lambda hints, rng: _say_template(change(hints, rng), rng)


def _random_hints(count: int | None) -> Change:
    """Return a change that draws some hints, or all of them, in random order."""
    return lambda hints, rng: tuple(hints[i] for i in rng.permutation(len(hints))[:count])


def _say_freely(wording: Wording, change: Change) -> Say:
    return lambda hints, rng: _text_lines(_write(wording, change(hints, rng), rng))


def _with_one_wrong(words: Sequence[str]) -> Change:
    """Return a change that gives one hint a wrong direction and colour."""

    def change(hints: tuple[Hint, ...], rng: np.random.Generator) -> tuple[Hint, ...]:
        row = int(rng.integers(len(hints)))
        others: list[Direction] = [d for d in DIRECTIONS[:4] if d != hints[row].direction]
        wrong = replace(
            hints[row], direction=others[int(rng.integers(len(others)))], colour=_other_colour(words, hints[row], rng)
        )
        return (*hints[:row], wrong, *hints[row + 1 :])

    return change


def _with_wrong_colours(words: Sequence[str], count: int) -> Change:
    def change(hints: tuple[Hint, ...], rng: np.random.Generator) -> tuple[Hint, ...]:
        rows = set(rng.permutation(len(hints))[:count].tolist())
        return tuple(replace(h, colour=_other_colour(words, h, rng)) if n in rows else h for n, h in enumerate(hints))

    return change


def _other_colour(words: Sequence[str], hint: Hint, rng: np.random.Generator) -> str:
    others = [word for word in words if word != hint.colour]
    return others[int(rng.integers(len(others)))]


def _write(wording: Wording, hints: tuple[Hint, ...], rng: np.random.Generator) -> LabelledText:
    return wording.write([ObjectFact(hint.label, hint.direction, hint.colour) for hint in hints], rng)


def _text_lines(text: LabelledText) -> tuple[str, ...]:
    return tuple(line for line in text.text.split("\n") if line.strip())
